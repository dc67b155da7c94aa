#pragma once
#include "direction_map.h"

namespace starbow {

/// Where in a map to begin looking for the pixel that shows a direction: the directions' octahedron (as direction_map.cpp's
/// packed) is cut into cells of a few pixels, and each tells two pixels that look into it or close by. Two, because a
/// panorama's ends look the same way from opposite edges of the picture.
struct InverseMap {
    int side = 0; ///< cells
    int channels = 1;
    std::vector<glm::u16vec4> cells; ///< x, y of either pixel; x = none where no pixel is near
    static constexpr std::uint16_t none = 0xffff;
};
InverseMap inverse(const DirectionMap& map);

} // namespace starbow
