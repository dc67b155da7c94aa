#include "inverse_map.h"
#include "config/model/angles.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr double pixels_per_cell = 16; // few enough that the path to the pixel is nearly straight
constexpr int least_side = 8, most_side = 256;
constexpr int spread = 2; // cells: a star's spot may reach in from beyond the picture's edge
constexpr int far = 64; // pixels between places that show the same direction

/// The cell of a direction; the same as star.vert's cell_of.
glm::ivec2 cell_of(const glm::vec3& n, int side)
{
    glm::vec2 at = glm::vec2(n) / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    if (n.z < 0)
        at = {std::copysign(1 - std::abs(at.y), at.x), std::copysign(1 - std::abs(at.x), at.y)};
    return glm::clamp(glm::ivec2((at * 0.5f + 0.5f) * float(side)), glm::ivec2(0), glm::ivec2(side - 1));
}

/// The cell at a place of the octahedron's net, whose edges are folded together.
glm::ivec2 folded(glm::ivec2 cell, int side)
{
    if (cell.x < 0 || cell.x >= side)
        cell = {cell.x < 0 ? -1 - cell.x : 2 * side - 1 - cell.x, side - 1 - cell.y};
    if (cell.y < 0 || cell.y >= side)
        cell = {side - 1 - cell.x, cell.y < 0 ? -1 - cell.y : 2 * side - 1 - cell.y};
    return cell;
}

void put(glm::uvec4& cell, std::uint32_t pixel)
{
    const glm::ivec2 at(pixel & 0xffff, pixel >> 16);
    for (int i = 0; i < 4; ++i) {
        if (cell[i] == InverseMap::none) {
            cell[i] = pixel;
            return;
        }
        const glm::ivec2 off = glm::abs(glm::ivec2(cell[i] & 0xffff, cell[i] >> 16) - at);
        if (std::max(off.x, off.y) <= far)
            return;
    }
}

} // namespace

InverseMap inverse(const DirectionMap& map)
{
    std::vector<float> angles; // of some pixels
    for (std::size_t i = 0; i < map.texels.size(); i += 7)
        if (map.texels[i].w > 0)
            angles.push_back(map.texels[i].w);
    double pixel = 1; // the median, because angles at the picture's seams are too large
    if (!angles.empty()) {
        std::nth_element(angles.begin(), angles.begin() + angles.size() / 2, angles.end());
        pixel = angles[angles.size() / 2];
    }
    InverseMap inverse;
    inverse.channels = map.channels;
    const double cells = 4 * pi / (pixels_per_cell * pixel * pixel);
    inverse.side = int(std::clamp(std::sqrt(cells), double(least_side), double(most_side)));
    const int side = inverse.side;
    const std::size_t count = std::size_t(side) * side;
    inverse.cells.assign(count * map.channels, glm::uvec4(InverseMap::none));
    for (int channel = 0; channel < map.channels; ++channel) {
        glm::uvec4* cells = inverse.cells.data() + count * channel;
        for (int y = 0; y < map.size.y; ++y)
            for (int x = 0; x < map.size.x; ++x)
                if (const glm::vec4& texel = map.at(x, y, channel); texel.w > 0) {
                    const glm::ivec2 at = cell_of(glm::vec3(texel), side);
                    put(cells[std::size_t(at.y) * side + at.x], std::uint32_t(x) | std::uint32_t(y) << 16);
                }
        for (int round = 0; round < spread; ++round) {
            const std::vector<glm::uvec4> before(cells, cells + count);
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x)
                    for (const glm::ivec2& step : {glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
                        const glm::ivec2 beside = folded(glm::ivec2(x, y) + step, side);
                        const glm::uvec4& there = before[std::size_t(beside.y) * side + beside.x];
                        for (int i = 0; i < 4 && there[i] != InverseMap::none; ++i)
                            put(cells[std::size_t(y) * side + x], there[i]);
                    }
        }
    }
    for (const glm::uvec4& cell : inverse.cells)
        inverse.closes |= cell[1] != InverseMap::none;
    return inverse;
}

} // namespace starbow
