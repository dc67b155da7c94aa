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

/// 0 where the dome shows nothing. Taken at the point `pixel`; over the whole pixel the solid angle differs from that by
/// less than (pixel angle)² / 10 of itself, but within a few pixels of the point opposite to the zenith.
double dome_pixel_angle(const Fisheye& dome, glm::ivec2 size, glm::dvec2 pixel);

} // namespace starbow
