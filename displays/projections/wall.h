#pragma once
#include "config/model/layout.h"
#include "plane.h"

namespace starbow {

/// The wall as seen by an eye at `eye_m` (Kooima, Generalized Perspective Projection, 2008). nullopt if the eye is behind
/// the wall, or nearer to its plane than a billionth of its size. Corners that are no rectangle make a parallelogram.
std::optional<Plane> wall_plane(const Wall& wall, glm::ivec2 size, const glm::dvec3& eye_m);

} // namespace starbow
