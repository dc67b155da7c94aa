#pragma once
#include "config/layout.h"
#include <glm/glm.hpp>
#include <optional>

namespace starbow {

/// A rectangle of pixels, what it shows, and where the eye is that looks at it (cockpit's frame, metres; only walls and
/// mirrors ask). `size` need not be that of a screen: a squeezed or small picture is one whose pixels are read elsewhere.
struct Picture {
    Projection projection;
    glm::ivec2 size; ///< pixels, square ones
    glm::dvec3 eye_m{0};
};

enum class Channel { red, green, blue };

/// Unit direction in the cockpit's frame that the point `pixel` shows. The top left corner is (0, 0), a pixel's centre is at
/// +0.5. Nothing where the projection shows nothing (outside the dome's circle, beyond the mirror). Only lenses tell channels
/// apart.
std::optional<glm::dvec3> direction(const Picture& picture, glm::dvec2 pixel, Channel channel = Channel::green);

/// The pixel that shows a direction: the inverse. Nothing where no pixel of the projection shows it; the point may lie
/// outside the picture where the projection goes on beyond its edge.
std::optional<glm::dvec2> pixel(
    const Picture& picture, const glm::dvec3& direction, Channel channel = Channel::green);

/// For projections whose direction is linear in the pixel: direction is along M (x, y, 1). Nothing for the others.
std::optional<glm::dmat3> planar_matrix(const Picture& picture);

/// Angle that one pixel covers around `pixel`, radians: the square root of its solid angle. 0 where nothing is shown.
double pixel_angle(const Picture& picture, glm::dvec2 pixel, Channel channel = Channel::green);

/// Whether the three channels of a pixel look different ways.
bool splits_colours(const Projection& projection);

} // namespace starbow
