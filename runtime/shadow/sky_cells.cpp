#include "fill.h"
#include "runtime/world/parallel.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace starbow {
namespace {

constexpr int most_cells = 1'000'000, cells_along = 160; // of the grid; along its longest side
constexpr int sky_rays = 64; // from a cell's middle

/// A cell of the grid, as Shadows::sky has it; `inside`: the cell is within a body.
struct Cell {
    glm::dvec3 b{0}, s{0};
    bool inside = false;
};

/// The rays of every cell, evenly over the sphere: a Fibonacci lattice. Side 0 of a ray's cosines is for surfaces that face
/// along each axis, side 1 for those that face against it; and the sums over all rays.
struct SkyRays {
    std::array<glm::dvec3, sky_rays> way;
    std::array<std::array<glm::dvec3, 2>, sky_rays> cosine;
    std::array<glm::dvec3, 2> all{};

    SkyRays()
    {
        for (int i = 0; i < sky_rays; ++i) {
            const double y = 1 - 2 * (i + 0.5) / sky_rays, turn = 2 * std::numbers::pi * 0.6180339887498949 * i;
            const double level = std::sqrt(1 - y * y);
            way[i] = {level * std::cos(turn), y, level * std::sin(turn)};
            for (int side = 0; side < 2; ++side)
                all[side] += cosine[i][side] = glm::max(side == 0 ? way[i] : -way[i], 0.0);
        }
    }
};

Cell cell_at(const Occluders& occluders, const glm::dvec3& place)
{
    static const SkyRays rays;
    std::array<glm::dvec3, 2> seen{};
    int backs = 0;
    for (int i = 0; i < sky_rays; ++i) {
        const auto hit = occluders.first(place, rays.way[i], 1e37);
        if (hit)
            backs += hit->back;
        else
            for (int side = 0; side < 2; ++side)
                seen[side] += rays.cosine[i][side];
    }
    const glm::dvec3 plus = seen[0] / rays.all[0], minus = seen[1] / rays.all[1];
    return {0.5 * (plus - minus), 0.5 * (plus + minus), backs > sky_rays / 5};
}

/// Cells within bodies take the mean of their neighbours, until all have a value.
void spread(std::vector<Cell>& cells, const glm::ivec3& count)
{
    const auto index = [&](const glm::ivec3& at) {
        return (std::size_t(at.z) * std::size_t(count.y) + std::size_t(at.y)) * std::size_t(count.x) + std::size_t(at.x);
    };
    for (bool changed = true; changed;) {
        changed = false;
        std::vector<std::pair<std::size_t, Cell>> found;
        for (int z = 0; z < count.z; ++z)
            for (int y = 0; y < count.y; ++y)
                for (int x = 0; x < count.x; ++x) {
                    if (!cells[index({x, y, z})].inside)
                        continue;
                    Cell sum;
                    int neighbours = 0;
                    for (int side = 0; side < 6; ++side) {
                        glm::ivec3 at(x, y, z);
                        at[side / 2] += side % 2 ? 1 : -1;
                        if (at[side / 2] < 0 || at[side / 2] >= count[side / 2] || cells[index(at)].inside)
                            continue;
                        sum.b += cells[index(at)].b, sum.s += cells[index(at)].s;
                        ++neighbours;
                    }
                    if (neighbours > 0)
                        found.push_back({index({x, y, z}), {sum.b / double(neighbours), sum.s / double(neighbours), false}});
                }
        for (const auto& [at, cell] : found)
            cells[at] = cell, changed = true;
    }
}

} // namespace

void fill_sky(Shadows& shadows, const AlignedBox& box, const Occluders& occluders,
    const std::function<void(double)>& progress, double from)
{
    const glm::dvec3 size = box.high - box.low;
    shadows.cell = std::max({size.x, size.y, size.z, 1e-6}) / cells_along;
    const auto cells_of = [&] { return glm::max(glm::ivec3(glm::ceil(size / shadows.cell)) + 2, 2); };
    while (std::size_t(cells_of().x) * std::size_t(cells_of().y) * std::size_t(cells_of().z) > most_cells)
        shadows.cell *= 1.1;
    shadows.cells = cells_of();
    shadows.low = 0.5 * (box.low + box.high) - 0.5 * shadows.cell * glm::dvec3(shadows.cells - 1);
    const glm::ivec3& count = shadows.cells;
    std::vector<Cell> cells(std::size_t(count.x) * std::size_t(count.y) * std::size_t(count.z));
    const auto row = [&](std::size_t line) {
        for (int x = 0; x < count.x; ++x) {
            const std::size_t y = line % std::size_t(count.y), z = line / std::size_t(count.y);
            const glm::dvec3 at(x, double(y), double(z));
            cells[line * std::size_t(count.x) + std::size_t(x)] = cell_at(occluders, shadows.low + shadows.cell * at);
        }
    };
    in_parallel(std::size_t(count.y) * std::size_t(count.z), row, progress, from, 1);
    spread(cells, count);
    const auto byte = [](double value) { return std::uint8_t(std::lround(255 * std::clamp(value, 0.0, 1.0))); };
    const std::size_t plane = std::size_t(count.x) * std::size_t(count.y);
    for (std::size_t z = 0; z < std::size_t(count.z); ++z)
        for (const bool straight : {true, false})
            for (std::size_t i = z * plane; i < (z + 1) * plane; ++i) {
                for (int k = 0; k < 3; ++k)
                    shadows.sky.push_back(byte(straight ? 0.5 + cells[i].b[k] : cells[i].s[k]));
                shadows.sky.push_back(0);
            }
}

} // namespace starbow
