#pragma once
#include "config/layout.h"
#include <optional>

namespace starbow {

/// A domemaster: the dome as seen from its middle looking up at the zenith, in a circle inscribed in the picture, with the
/// angle from the zenith growing evenly from the centre to aperture / 2 at the rim. Who faces the front and tilts the head
/// back sees the front below the zenith and the right hand still on the right; so in the picture (no mirror image) the
/// visitor's front is at the bottom and the right is on the right. See direction_map.h for what each function returns.
std::optional<glm::dvec3> dome_direction(const Fisheye& dome, glm::ivec2 size, glm::dvec2 pixel);
std::optional<glm::dvec2> dome_pixel(const Fisheye& dome, glm::ivec2 size, const glm::dvec3& direction);

/// 0 where the dome shows nothing. Taken at the point `pixel`; up to 170 degrees from the zenith the solid angle over the
/// whole pixel differs from its square by less than a tenth of step² of itself, step being the angle from one pixel to the
/// next along the radius: 5e-6 in a domemaster of 1024 pixels.
double dome_pixel_angle(const Fisheye& dome, glm::ivec2 size, glm::dvec2 pixel);

} // namespace starbow
