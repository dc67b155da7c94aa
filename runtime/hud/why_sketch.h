#pragma once
#include "why.h"

namespace starbow {

struct Panel;

/// A straight line of a sketch. The sketch's square is from -1 to 1, x to the right, y up; the ship is at its middle and
/// flies up.
struct Stroke {
    glm::dvec2 from{0}, to{0};
    double width = 0.02, strength = 1; ///< 0 to 1 of white
};

/// The sketch of a page at the ship's speed, at a time of its animation. gamma_beta: the ship's proper velocity. t_s:
/// seconds for whoever looks on.
///
/// aberration: light of equal directions in the world, in the directions in which it reaches the ship. doppler: its crests,
/// as far apart as they arrive. headlight: the same light, as wide as it is bright (D^4 for all light together). delay: a
/// thing that flies past, where it is (filled) and where it is seen (a ring), and its light on the way. dilation: a light
/// clock on board, and as it is from outside. length: a rod at rest and as it is in the ship that flies past.
std::vector<Stroke> why_sketch(Why why, double gamma_beta, double t_s);

/// Draws strokes on a panel. middle: of the square, pixels; unit: pixels to 1.
void draw_strokes(Panel& panel, const std::vector<Stroke>& strokes, const glm::dvec2& middle, double unit);

} // namespace starbow
