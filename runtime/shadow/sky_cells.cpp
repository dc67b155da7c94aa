#include "fill.h"
#include "runtime/world/parallel.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>

namespace starbow {
namespace {

constexpr int most_cells = 1'000'000, cells_along = 160; // of the grid; along its longest side
constexpr int sky_rays = 1536; // from a cell's middle

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
    /// Rays that are close to each other, and their numbers.
    struct Bundle {
        Occluders::Vectors ways;
        std::array<int, Occluders::bundle> rays;
    };
    std::array<Bundle, sky_rays / Occluders::bundle> bundles;

    SkyRays()
    {
        for (int i = 0; i < sky_rays; ++i) {
            const double y = 1 - 2 * (i + 0.5) / sky_rays, turn = 2 * std::numbers::pi * 0.6180339887498949 * i;
            const double level = std::sqrt(1 - y * y);
            way[i] = {level * std::cos(turn), y, level * std::sin(turn)};
            for (int side = 0; side < 2; ++side)
                all[side] += cosine[i][side] = glm::max(side == 0 ? way[i] : -way[i], 0.0);
        }
        // By six strips of the same height, then by azimuth: a bundle is about as high as it is wide.
        std::array<int, sky_rays> order;
        std::iota(order.begin(), order.end(), 0);
        std::ranges::sort(
            order, {}, [&](int i) { return std::pair(int(3 * (1 - way[i].y)), std::atan2(way[i].z, way[i].x)); });
        for (std::size_t i = 0; i < sky_rays; ++i) {
            Bundle& bundle = bundles[i / Occluders::bundle];
            bundle.rays[i % Occluders::bundle] = order[i];
            bundle.ways.set(i % Occluders::bundle, way[order[i]]);
        }
    }
};

Cell cell_at(const Occluders& occluders, const glm::dvec3& place)
{
    static const SkyRays rays;
    std::array<glm::dvec3, 2> seen{};
    int backs = 0;
    Occluders::Vectors from;
    for (std::size_t i = 0; i < Occluders::bundle; ++i)
        from.set(i, place);
    std::array<bool, sky_rays> free;
    int hits = 0;
    for (const SkyRays::Bundle& bundle : rays.bundles) {
        const Occluders::Hits met = occluders.first(from, bundle.ways);
        for (std::size_t i = 0; i < Occluders::bundle; ++i) {
            const bool hit = met.distance[i] < std::numeric_limits<float>::infinity();
            free[std::size_t(bundle.rays[i])] = !hit;
            hits += hit, backs += met.back[i];
        }
    }
    if (hits == 0)
        return {.s = glm::dvec3(1)};
    for (int i = 0; i < sky_rays; ++i)
        if (free[i])
            for (int side = 0; side < 2; ++side)
                seen[side] += rays.cosine[i][side];
    const glm::dvec3 plus = seen[0] / rays.all[0], minus = seen[1] / rays.all[1];
    return {0.5 * (plus - minus), 0.5 * (plus + minus), backs > sky_rays / 5};
}

/// The index of a cell of a grid.
std::size_t index_in(const glm::ivec3& count, const glm::ivec3& at)
{
    return (std::size_t(at.z) * std::size_t(count.y) + std::size_t(at.y)) * std::size_t(count.x) + std::size_t(at.x);
}

/// The greatest difference between two cells' visible parts of the sky, along any axis.
double difference(const Cell& a, const Cell& b)
{
    const glm::dvec3 plus = glm::abs(a.b + a.s - b.b - b.s), minus = glm::abs(a.s - a.b - b.s + b.b);
    return std::max({plus.x, plus.y, plus.z, minus.x, minus.y, minus.z});
}

/// The mean of some cells that see much the same of the sky; nullopt for others.
std::optional<Cell> mean_of(std::span<const Cell* const> around)
{
    constexpr double alike = 0.02;
    Cell mean = *around.front();
    for (const Cell* one : around.subspan(1)) {
        if (one->inside != mean.inside || difference(*one, *around.front()) > alike)
            return {};
        mean.b += one->b, mean.s += one->s;
    }
    mean.b /= double(around.size()), mean.s /= double(around.size());
    return mean;
}

/// The cells with even indices around another cell, itself among them if it has such.
std::vector<const Cell*> even_around(const std::vector<Cell>& cells, const glm::ivec3& count, const glm::ivec3& at)
{
    std::vector<const Cell*> around;
    for (int k = 0; k < 8; ++k) {
        const glm::ivec3 side(k & 1, k >> 1 & 1, k >> 2), odd = at & 1;
        if (glm::any(glm::greaterThan(side, odd)))
            continue; // along an even index there is one
        const glm::ivec3 one = glm::min(at - odd + 2 * side, (count - 1) & ~1);
        around.push_back(&cells[index_in(count, one)]);
    }
    return around;
}

/// Cells within bodies take the mean of their neighbours, until all have a value.
void spread(std::vector<Cell>& cells, const glm::ivec3& count)
{
    for (bool changed = true; changed;) {
        changed = false;
        std::vector<std::pair<std::size_t, Cell>> found;
        for (int z = 0; z < count.z; ++z)
            for (int y = 0; y < count.y; ++y)
                for (int x = 0; x < count.x; ++x) {
                    if (!cells[index_in(count, {x, y, z})].inside)
                        continue;
                    Cell sum;
                    int neighbours = 0;
                    for (int side = 0; side < 6; ++side) {
                        glm::ivec3 at(x, y, z);
                        at[side / 2] += side % 2 ? 1 : -1;
                        if (at[side / 2] < 0 || at[side / 2] >= count[side / 2] || cells[index_in(count, at)].inside)
                            continue;
                        sum.b += cells[index_in(count, at)].b, sum.s += cells[index_in(count, at)].s;
                        ++neighbours;
                    }
                    if (neighbours > 0)
                        found.push_back(
                            {index_in(count, {x, y, z}), {sum.b / double(neighbours), sum.s / double(neighbours), false}});
                }
        for (const auto& [at, cell] : found)
            cells[at] = cell, changed = true;
    }
}

/// Look-ups are one cell above a surface. Gives each cell the values of surfaces that lie so much lower, by the change from
/// the cell above them; but not where something parts the two.
void lower(std::vector<Cell>& cells, const glm::ivec3& count)
{
    constexpr double parted = 0.15; // a greater change is not the sky's own
    const std::vector<Cell> before = cells;
    for (int z = 0; z < count.z; ++z)
        for (int y = 0; y < count.y; ++y)
            for (int x = 0; x < count.x; ++x) {
                const std::size_t own = index_in(count, {x, y, z});
                for (int k = 0; k < 3; ++k) {
                    double seen[2]; // facing along the axis, and against it
                    for (int side = 0; side < 2; ++side) {
                        const double sign = side == 0 ? 1 : -1;
                        const auto part = [&](const Cell& cell) { return cell.s[k] + sign * cell.b[k]; };
                        glm::ivec3 up(0);
                        up[k] = int(sign);
                        seen[side] = part(before[own]);
                        // The mean change of the cells beside it: rays are few.
                        double sum = 0;
                        int changes = 0;
                        for (int beside = 0; beside < 5; ++beside) {
                            glm::ivec3 at(x, y, z);
                            if (beside > 0)
                                at[(k + 1 + (beside & 1)) % 3] += beside > 2 ? 1 : -1;
                            const glm::ivec3 above = at + up;
                            if (glm::any(glm::lessThan(glm::min(at, above), glm::ivec3(0)))
                                || glm::any(glm::greaterThanEqual(glm::max(at, above), count)))
                                continue;
                            const double change = part(before[index_in(count, at)]) - part(before[index_in(count, above)]);
                            if (std::abs(change) < parted)
                                sum += change, ++changes;
                            else if (beside == 0)
                                break;
                        }
                        if (changes > 0)
                            seen[side] = std::clamp(seen[side] + sum / changes, 0.0, 1.0);
                    }
                    cells[own].b[k] = 0.5 * (seen[0] - seen[1]), cells[own].s[k] = 0.5 * (seen[0] + seen[1]);
                }
            }
}

/// The part of the lower half of the sky that a ground hides far outside the grid, as high as a row of cells.
double ground_far_away(const Shadows& shadows, const Occluders& occluders, int y)
{
    const glm::dvec3 size = shadows.cell * glm::dvec3(shadows.cells);
    const double far = 2 * std::max(size.x, size.z);
    constexpr int places = 8;
    double hidden = 0;
    for (int i = 0; i < places; ++i) {
        const double turn = 2 * std::numbers::pi * (i + 0.5) / places;
        const glm::dvec3 middle
            = shadows.low + 0.5 * size,
            from(middle.x + far * std::cos(turn), shadows.low.y + shadows.cell * y, middle.z + far * std::sin(turn));
        const Cell cell = cell_at(occluders, from);
        hidden += 1 - (cell.s.y - cell.b.y);
    }
    return hidden / places;
}

/// The least distance from things to the sides of the box around them.
double margin_of(const AlignedBox& box, const AlignedBox& things)
{
    const glm::dvec3 low = things.low - box.low, high = box.high - things.high;
    return std::min({low.x, low.z, high.x, high.z});
}

} // namespace

void fill_sky(Shadows& shadows, const Boxes& boxes, const Occluders& occluders, const std::function<void(double)>& progress,
    double from)
{
    const AlignedBox &box = boxes.around_middle, &inner = boxes.middle;
    const glm::dvec3 size = box.high - box.low;
    shadows.cell = std::max({size.x, size.y, size.z, 1e-6}) / cells_along;
    const auto cells_of = [&] { return glm::max(glm::ivec3(glm::ceil(size / shadows.cell)) + 2, 2); };
    while (std::size_t(cells_of().x) * std::size_t(cells_of().y) * std::size_t(cells_of().z) > most_cells)
        shadows.cell *= 1.1;
    shadows.cells = cells_of();
    shadows.low = 0.5 * (box.low + box.high) - 0.5 * shadows.cell * glm::dvec3(shadows.cells - 1);
    const glm::ivec3& count = shadows.cells;
    std::vector<Cell> cells(std::size_t(count.x) * std::size_t(count.y) * std::size_t(count.z));
    // Every second cell along each axis first. Between such cells that see much the same of the sky, the others see it, too.
    const auto row = [&](std::size_t line, bool even) {
        for (int x = 0; x < count.x; ++x) {
            const glm::ivec3 at(x, int(line) % count.y, int(line) / count.y);
            if ((at & 1) == glm::ivec3(0) ? !even : even)
                continue;
            const auto mean = even ? std::nullopt : mean_of(even_around(cells, count, at));
            cells[index_in(count, at)] = mean ? *mean : cell_at(occluders, shadows.low + shadows.cell * glm::dvec3(at));
        }
    };
    const std::size_t lines = std::size_t(count.y) * std::size_t(count.z);
    const double between = 0.7 * from + 0.3; // an eighth of the cells, and about a third of the others
    in_parallel(
        lines, [&](std::size_t line) { row(line, true); }, progress, from, between);
    in_parallel(
        lines, [&](std::size_t line) { row(line, false); }, progress, between, 1);
    spread(cells, count);
    lower(cells, count);
    std::vector<std::uint8_t> grounds;
    const auto byte = [](double value) { return std::uint8_t(std::lround(255 * std::clamp(value, 0.0, 1.0))); };
    for (int y = 0; y < count.y; ++y)
        grounds.push_back(byte(ground_far_away(shadows, occluders, y)));
    const double margin = std::clamp(std::round(margin_of(box, inner) / shadows.cell), 1.0, 255.0);
    const std::size_t plane = std::size_t(count.x) * std::size_t(count.y);
    for (std::size_t z = 0; z < std::size_t(count.z); ++z)
        for (const bool straight : {true, false})
            for (std::size_t i = z * plane; i < (z + 1) * plane; ++i) {
                for (int k = 0; k < 3; ++k)
                    shadows.sky.push_back(byte(straight ? 0.5 + cells[i].b[k] : cells[i].s[k]));
                shadows.sky.push_back(straight ? grounds[i % plane / std::size_t(count.x)] : std::uint8_t(margin));
            }
}

} // namespace starbow
