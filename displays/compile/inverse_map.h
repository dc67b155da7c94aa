#pragma once
#include "direction_map.h"

namespace starbow {

/// Start points of the search for the pixel that shows a direction in a map. The directions' octahedron (as
/// direction_map.cpp's packed) is divided into cells of a few pixels. Each cell lists up to four pixels, far from one
/// another, that look into it or close by. A panorama's opposite edges show the same direction, and three faces of a cube
/// meet in a corner.
struct InverseMap {
    int side = 0; ///< cells
    int channels = 1;
    bool closes = false; ///< some direction is shown at more than one place
    std::vector<glm::uvec4> cells; ///< pixels as x + 65536 y; the first `none` ends a cell's list
    static constexpr std::uint32_t none = ~0u;
};
InverseMap inverse(const DirectionMap& map);

} // namespace starbow
