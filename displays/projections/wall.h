#pragma once
#include "config/model/layout.h"
#include "keystone.h"
#include "plane.h"
#include <array>

namespace starbow {

/// A wall's corners, metres: lower left, lower right, upper right, upper left.
struct WallCorners {
    std::array<glm::dvec3, 4> at; ///< of the nearest rectangle; of a wall that is none, in the nearest plane
    std::array<double, 4> moved_m{}; ///< each corner's distance from its measured place; 0 where none was measured
};

/// Fits a wall to its measured corners, by least squares.
WallCorners fitted_corners(const Wall& wall);

/// The wall as seen by an eye at `eye_m` (Kooima, Generalized Perspective Projection, 2008). nullopt if the eye is behind
/// the wall, or nearer to its plane than a billionth of its size.
std::optional<Plane> wall_plane(const Wall& wall, glm::ivec2 size, const glm::dvec3& eye_m);

/// The same for a wall whose picture is no rectangle.
std::optional<Keystone> wall_keystone(const Wall& wall, glm::ivec2 size, const glm::dvec3& eye_m);

} // namespace starbow
