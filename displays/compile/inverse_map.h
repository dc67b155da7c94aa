#pragma once
#include "direction_map.h"

namespace starbow {

/// Where in a map to begin looking for the pixel that shows a direction: the directions' octahedron (as direction_map.cpp's
/// packed) is cut into cells of a few pixels, and each tells up to four pixels, far from one another, that look into it or
/// close by: a panorama's ends look the same way from opposite edges of the picture, and three faces of a cube meet in a
/// corner.
struct InverseMap {
    int side = 0; ///< cells
    int channels = 1;
    bool closes = false; ///< somewhere the same way is looked from more than one place
    std::vector<glm::uvec4> cells; ///< pixels as x + 65536 y; from the first `none` on there are no more
    static constexpr std::uint32_t none = ~0u;
};
InverseMap inverse(const DirectionMap& map);

} // namespace starbow
