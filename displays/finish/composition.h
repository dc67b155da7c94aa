#pragma once
#include "shade.h"

namespace starbow {

/// The combination of overlapping viewports. A pixel's light is the sum of its views' light, each times its share. The
/// views of the highest order take theirs first: the mask where they show something, 0 elsewhere, and 1 without a mask.
/// Views of one order add theirs. The rest, 1 less their sum and no less than 0, is left to the next lower order.
///
/// Shade::shares has for each view rgb: its share times its brightness; a: its part, the share without colours and without
/// brightness, so that the parts of a pixel add up to 1 wherever any view shows something. A black level is added in the
/// proportion in which the higher orders leave light.
///
/// views: of one output, all of its canvases. bare: rgb is the part too, for pictures without shading.
Shade composed(const Layout& layout, glm::ivec2 size, std::span<const ViewShade> views, bool bare);

} // namespace starbow
