#pragma once
#include "config/model/layout.h"
#include "plane.h"

namespace starbow {

/// A flat window that turns with its Turn about the eye.
Plane planar_plane(const Planar& planar, glm::ivec2 size);

} // namespace starbow
