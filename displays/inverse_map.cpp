#include "inverse_map.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr double pixels_per_cell = 16; // few enough that the way to the pixel is nearly straight
constexpr int least_side = 8, most_side = 256;
constexpr int spread = 2; // cells: a star's spot may reach in from beyond the picture's edge
constexpr int far = 64; // pixels between places that look the same way

/// The cell of a direction: star.vert's cell_of.
glm::ivec2 cell_of(const glm::vec3& n, int side)
{
    glm::vec2 at = glm::vec2(n) / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    if (n.z < 0)
        at = {std::copysign(1 - std::abs(at.y), at.x), std::copysign(1 - std::abs(at.x), at.y)};
    return glm::clamp(glm::ivec2((at * 0.5f + 0.5f) * float(side)), glm::ivec2(0), glm::ivec2(side - 1));
}

/// Which cell lies there: the net's edges are folded together, each half onto its other.
glm::ivec2 folded(glm::ivec2 cell, int side)
{
    if (cell.x < 0 || cell.x >= side)
        cell = {cell.x < 0 ? -1 - cell.x : 2 * side - 1 - cell.x, side - 1 - cell.y};
    if (cell.y < 0 || cell.y >= side)
        cell = {side - 1 - cell.x, cell.y < 0 ? -1 - cell.y : 2 * side - 1 - cell.y};
    return cell;
}

bool apart(const glm::u16vec4& cell, int x, int y)
{
    return std::max(std::abs(int(cell.x) - x), std::abs(int(cell.y) - y)) > far;
}

void put(glm::u16vec4& cell, int x, int y)
{
    const glm::u16vec2 pixel(x, y);
    if (cell.x == InverseMap::none)
        cell = {pixel, InverseMap::none, InverseMap::none};
    else if (cell.z == InverseMap::none && apart(cell, x, y))
        cell = {cell.x, cell.y, pixel};
}

} // namespace

InverseMap inverse(const DirectionMap& map)
{
    double sky = 0;
    std::size_t shown = 0;
    for (const glm::vec4& texel : map.texels) {
        sky += double(texel.w) * texel.w;
        shown += texel.w > 0;
    }
    InverseMap inverse;
    inverse.channels = map.channels;
    const double cell = pixels_per_cell * sky / double(std::max<std::size_t>(shown, 1));
    inverse.side = std::clamp(int(std::sqrt(4 * 3.14159265358979323846 / std::max(cell, 1e-9))), least_side, most_side);
    const int side = inverse.side;
    const std::size_t count = std::size_t(side) * side;
    inverse.cells.assign(count * map.channels, glm::u16vec4(InverseMap::none));
    for (int channel = 0; channel < map.channels; ++channel) {
        glm::u16vec4* cells = inverse.cells.data() + count * channel;
        for (int y = 0; y < map.size.y; ++y)
            for (int x = 0; x < map.size.x; ++x)
                if (const glm::vec4& texel = map.at(x, y, channel); texel.w > 0) {
                    const glm::ivec2 at = cell_of(glm::vec3(texel), side);
                    put(cells[std::size_t(at.y) * side + at.x], x, y);
                }
        for (int round = 0; round < spread; ++round) {
            const std::vector<glm::u16vec4> before(cells, cells + count);
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x)
                    for (const glm::ivec2& step : {glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
                        const glm::ivec2 beside = folded(glm::ivec2(x, y) + step, side);
                        const glm::u16vec4& there = before[std::size_t(beside.y) * side + beside.x];
                        glm::u16vec4& here = cells[std::size_t(y) * side + x];
                        if (there.x != InverseMap::none)
                            put(here, there.x, there.y);
                        if (there.z != InverseMap::none)
                            put(here, there.z, there.w);
                    }
        }
    }
    return inverse;
}

} // namespace starbow
