#pragma once
#include "displays/compile/compiled_view.h"

namespace starbow {

/// Blend ramps from the views' directions. Where several views light a direction, each has a share that grows with its
/// distance from the edge at which it ends and another continues; the shares add up to 1. Edges beyond which nothing is
/// lit (the top of a wall, a dome's rim) fade no view. Views that share pixels of one output do not light the same place,
/// nor do different eyes. A view lights nothing where one of a higher order hides it. Views with an alpha mask of their own
/// are left out. Returns one weight for each pixel of each view, linear light; empty for a view without ramps. power: see
/// Blend.
std::vector<std::vector<float>> blend_ramps(const Layout& layout, std::span<const CompiledView> views, double power);

} // namespace starbow
