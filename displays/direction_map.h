#pragma once
#include "config/layout.h"
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace starbow {

/// Unit direction in the cockpit's frame that the point `pixel` of a picture of `size` pixels shows. The top left corner is
/// (0, 0), a pixel's centre is at +0.5. Nothing where the projection shows nothing (outside the dome's circle).
std::optional<glm::dvec3> direction(const Projection& projection, glm::ivec2 size, glm::dvec2 pixel);

/// The pixel that shows a direction: the inverse. Nothing where no pixel of the projection shows it; the point may lie
/// outside the picture where the projection goes on beyond its edge.
std::optional<glm::dvec2> pixel(const Projection& projection, glm::ivec2 size, const glm::dvec3& direction);

/// For projections whose direction is linear in the pixel: direction is along M (x, y, 1). Nothing for the others.
std::optional<glm::dmat3> planar_matrix(const Projection& projection, glm::ivec2 size);

/// Angle that one pixel covers around `pixel`, radians: the square root of its solid angle.
double pixel_angle(const Projection& projection, glm::ivec2 size, glm::dvec2 pixel);

/// The length in radians that a pixel keeps in one direction wherever it is, 0 where none does. Towards the rim of a fisheye
/// that shows the whole sky a pixel becomes a sliver: its solid angle goes to nothing, this length stays.
double pixel_length(const Projection& projection, glm::ivec2 size);

/// Rows from the top; xyz: unit direction of the pixel's centre, w: pixel angle in radians, or all 0 where nothing is shown.
struct DirectionMap {
    glm::ivec2 size;
    std::vector<glm::vec4> texels;
};

/// Compiles a projection for the device, in double, on all cores.
DirectionMap compile(const Projection& projection, glm::ivec2 size);

} // namespace starbow
