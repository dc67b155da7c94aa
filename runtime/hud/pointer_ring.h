#pragma once
#include "hud.h"

namespace starbow {

/// The outer diameter of the guide's pointer, degrees.
constexpr double pointer_deg = 3;

/// A bright ring with soft edges on a soft dark one, so that it is seen before a bright picture, too. strength: from 0 to 1.
/// degree_px: pixels to a degree. The panel is wider than the ring, by its soft edge.
Panel draw_pointer(double strength, double degree_px);

} // namespace starbow
