// Coarser levels of a surface with a seam: vertices that stand twice at one place, as exporters write them.
#include "runtime/world/detail.h"
#include <gtest/gtest.h>
#include <map>

namespace starbow::simplifier_test {
namespace {

constexpr int rows = 90, columns = 180;

/// A ball of radius 1 whose rows of vertices begin and end at the same meridian, at angles of 0 and of 2 pi. more: added to
/// the coordinates of the last column, in roundings of 1.
World ball(double more)
{
    World world;
    world.materials = {Material{}};
    for (int i = 0; i <= rows; ++i)
        for (int k = 0; k <= columns; ++k) {
            const double v = 3.14159265358979324 * i / rows, u = 2 * 3.14159265358979324 * k / columns;
            const glm::dvec3 place(std::sin(v) * std::cos(u), std::cos(v), std::sin(v) * std::sin(u));
            const double off = k == columns ? more * 0x1p-24 : 0;
            world.vertices.push_back({glm::vec3(place + off), glm::vec3(place), {float(k) / columns, 0}, 0xffffffff});
        }
    const auto at = [](int i, int k) { return std::uint32_t(i * (columns + 1) + k); };
    for (int i = 0; i < rows; ++i)
        for (int k = 0; k < columns; ++k) {
            if (i > 0)
                world.indices.insert(world.indices.end(), {at(i, k), at(i, k + 1), at(i + 1, k)});
            if (i < rows - 1)
                world.indices.insert(world.indices.end(), {at(i + 1, k), at(i, k + 1), at(i + 1, k + 1)});
        }
    world.primitives.push_back({.first_index = 0,
        .index_count = std::uint32_t(world.indices.size()),
        .vertex_offset = 0,
        .material = 0,
        .low = glm::dvec3(-1),
        .high = glm::dvec3(1),
        .centre = glm::dvec3(0),
        .radius = 1,
        .coarser = {}});
    world.instances.push_back({glm::dmat4(1), 0});
    world.nodes.push_back({"ball", -1});
    return world;
}

/// The number of a vertex's place: both ends of a row are one, and so is each pole.
int place_of(std::uint32_t vertex)
{
    const int row = int(vertex) / (columns + 1), column = int(vertex) % (columns + 1) % columns;
    return row == 0 ? -1 : row == rows ? -2 : row * columns + column;
}

TEST(Simplifier, ASeamStaysClosed)
{
    for (const double more : {0.0, 1.0, -2.0, 4.0}) {
        World world = ball(more);
        add_detail_levels(world);
        const std::vector<DetailLevel>& levels = world.primitives[0].coarser;
        EXPECT_GE(levels.size(), 6u) << "a seam stops no level";
        for (const DetailLevel& level : levels) {
            std::map<std::pair<int, int>, int> edges; // the triangles on each side
            for (std::uint32_t i = 0; i < level.index_count; i += 3) {
                int place[3];
                for (std::uint32_t k = 0; k < 3; ++k)
                    place[k] = place_of(world.indices[level.first_index + i + k]);
                if (place[0] == place[1] || place[1] == place[2] || place[2] == place[0])
                    continue; // without area
                for (int k = 0; k < 3; ++k)
                    ++edges[{place[k], place[(k + 1) % 3]}];
            }
            int open = 0;
            for (const auto& [edge, count] : edges) {
                const auto other = edges.find({edge.second, edge.first});
                open += other == edges.end() || other->second != count;
            }
            EXPECT_EQ(open, 0) << level.index_count / 3 << " triangles, the seam's ends " << more << " roundings apart";
        }
    }
}

} // namespace
} // namespace starbow::simplifier_test
