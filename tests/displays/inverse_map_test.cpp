// For every direction that a picture shows, the inverse map begins the search near by, on the right side of every seam.
#include "displays/compile/inverse_map.h"
#include "tests/support/files.h"
#include "tests/support/view.h"
#include <cmath>
#include <set>

namespace inverse_map_test {

using namespace starbow;

namespace {

/// The cell of a direction in the octahedron's net.
glm::ivec2 cell_of(const glm::dvec3& n, int side)
{
    const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    double x = n.x / sum, y = n.y / sum;
    if (n.z < 0) {
        const double folded_x = (x < 0 ? -1 : 1) * (1 - std::abs(y)), folded_y = (y < 0 ? -1 : 1) * (1 - std::abs(x));
        x = folded_x, y = folded_y;
    }
    return glm::min(glm::ivec2((x + 1) / 2 * side, (y + 1) / 2 * side), side - 1);
}

} // namespace

TEST(InverseMapTest, TheSearchBeginsNearEveryPixel)
{
    struct Case {
        const char* name;
        Projection projection;
        glm::ivec2 size;
        double pole_deg; ///< elevation beyond which a row of pixels shows nearly one point
    };
    for (const Case& c : {Case{"fisheye", Fisheye{180, 30}, {400, 400}, 90}, {"small", Fisheye{220, 30}, {60, 60}, 90},
             {"panorama", Equirectangular{}, {600, 300}, 60}, {"cylinder", Cylinder{}, {600, 190}, 90},
             {"cube", CubeFaces{}, {900, 150}, 90}}) {
        const auto map = starbow::testing::view_of(c.projection, c.size).map;
        const InverseMap inverse = starbow::inverse(*map);
        ASSERT_EQ(inverse.cells.size(), std::size_t(inverse.side) * inverse.side);
        double farthest = 0;
        for (int y = 0; y < c.size.y; ++y)
            for (int x = 0; x < c.size.x; ++x) {
                const glm::dvec3 n(map->at(x, y));
                if (map->at(x, y).w == 0 || std::abs(n.y) > std::sin(glm::radians(c.pole_deg)))
                    continue;
                const glm::ivec2 at = cell_of(n, inverse.side);
                const glm::uvec4 cell = inverse.cells[std::size_t(at.y) * inverse.side + at.x];
                double off = 1e9;
                for (int i = 0; i < 4 && cell[i] != InverseMap::none; ++i)
                    off = std::min(off, glm::distance(glm::dvec2(cell[i] & 0xffff, cell[i] >> 16), glm::dvec2(x, y)));
                farthest = std::max(farthest, off);
            }
        // Cells hold 16 pixels on average. The octahedron's cells differ in size by up to five, a panorama's pixels by two.
        std::printf("  %s: %d cells a side, %.1f pixels at most\n", c.name, inverse.side, farthest);
        EXPECT_LT(farthest, 25) << c.name;
    }
}

TEST(InverseMapTest, APixelReachesTwoCellsFarAlsoOverTheNetsEdges)
{
    DirectionMap map;
    map.size = {1, 1};
    map.texels = {glm::vec4(0, 0, 1, 0.06f)}; // 4 pi / (16 * 0.06^2): 14 cells a side
    const int side = starbow::inverse(map).side;
    ASSERT_EQ(side, 14);
    const auto direction_of = [&](double x, double y) { // of a place of the net, in cells
        const double a = 2 * x / side - 1, b = 2 * y / side - 1, z = 1 - std::abs(a) - std::abs(b);
        return glm::normalize(z >= 0
                ? glm::dvec3(a, b, z)
                : glm::dvec3((a < 0 ? -1 : 1) * (1 - std::abs(b)), (b < 0 ? -1 : 1) * (1 - std::abs(a)), z));
    };
    // The cells that share a side with a cell: those of directions a little off the middles of its sides.
    const auto beside = [&](glm::ivec2 cell) {
        std::set<std::pair<int, int>> found;
        for (const glm::dvec2& middle : {glm::dvec2(0, 0.5), {1, 0.5}, {0.5, 0}, {0.5, 1}}) {
            const glm::dvec3 n = direction_of(cell.x + middle.x, cell.y + middle.y);
            for (int axis = 0; axis < 3; ++axis)
                for (const double off : {-1e-6, 1e-6}) {
                    glm::dvec3 there = n;
                    there[axis] += off;
                    const glm::ivec2 at = cell_of(there, side);
                    found.insert({at.x, at.y});
                }
        }
        return found;
    };
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            map.texels[0] = glm::vec4(glm::vec3(direction_of(x + 0.5, y + 0.5)), 0.06f);
            std::set<std::pair<int, int>> reached = beside({x, y});
            for (const auto& [near_x, near_y] : beside({x, y}))
                reached.merge(beside({near_x, near_y}));
            const InverseMap inverse = starbow::inverse(map);
            for (int j = 0; j < side; ++j)
                for (int i = 0; i < side; ++i)
                    EXPECT_EQ(inverse.cells[std::size_t(j * side + i)].x != InverseMap::none, reached.contains({i, j}))
                        << "from " << x << ' ' << y << " to " << i << ' ' << j;
        }
}

TEST(InverseMapTest, CellsOutsideThePictureAreEmpty)
{
    const auto map = starbow::testing::view_of(Fisheye{180, 90}, {400, 400}).map; // the half of the sky ahead
    const InverseMap inverse = starbow::inverse(*map);
    int empty = 0;
    for (const glm::uvec4& cell : inverse.cells)
        empty += cell.x == InverseMap::none;
    // Half of the cells are empty, minus two rows beyond the rim.
    EXPECT_GT(empty, int(0.35 * double(inverse.cells.size())));
    EXPECT_LT(empty, int(0.5 * double(inverse.cells.size())));
}

} // namespace inverse_map_test
