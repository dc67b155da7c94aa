#pragma once
#include "config/layout.h"
#include <optional>

namespace starbow {

/// A flat window looked at from its axis; see direction_map.h for what each function returns.
glm::dmat3 planar_direction_matrix(const Planar& planar, glm::ivec2 size);
glm::dvec3 planar_direction(const Planar& planar, glm::ivec2 size, glm::dvec2 pixel);
std::optional<glm::dvec2> planar_pixel(const Planar& planar, glm::ivec2 size, const glm::dvec3& direction);
double planar_pixel_angle(const Planar& planar, glm::ivec2 size, glm::dvec2 pixel);

} // namespace starbow
