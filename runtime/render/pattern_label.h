#pragma once
#include "displays/compile/compiled_view.h"
#include "resources.h"

namespace starbow {

/// What the test patterns write on a view: its output, viewport, eye and pixels, as a picture of letters (r of R8G8).
/// sent: the pixels that its projector gets, where the view is a preview of them.
Image make_label(Device& device, const Layout& layout, const View& view, glm::ivec2 sent);

/// How much of a view, of its shape and around its middle, shows something all along its edge: 1 for a whole rectangle, 0.7
/// for a circle. 1 too where the middle is dark.
float shown_part(const CompiledView& view);

/// Colours that tell outputs, and eyes, apart; linear. Where outputs overlap theirs add up to a third.
glm::vec3 output_tint(std::size_t output);
glm::vec3 eye_tint(Eye eye);

} // namespace starbow
