// The cone hierarchy of a direction map, compared with every pixel, and the search for a direction's pixel, compared with
// the projections' formulas.
#include "config/model/turn.h"
#include "displays/compile/cone_hierarchy.h"
#include "tests/support/sphere.h"
#include <functional>
#include <random>

namespace cone_hierarchy_test {

using namespace starbow;

namespace {

using glm::dvec2;
using glm::dvec3;
using glm::ivec2;

View view_of(const Projection& projection, ivec2 size)
{
    Layout layout;
    layout.outputs.resize(1);
    layout.outputs[0].size = size;
    layout.outputs[0].viewports = {{.projection = projection}};
    return views_of(layout, 0, size).front();
}

/// All pixels' directions and angles; the angle is 0 where nothing is shown.
std::vector<std::pair<dvec3, double>> pixels(const View& view)
{
    const DirectionMap map = compile_direction_map(view);
    std::vector<std::pair<dvec3, double>> all;
    for (const glm::vec4& texel : map.texels)
        all.push_back({dvec3(texel), texel.w});
    return all;
}

/// The rounding of a unit vector in float.
constexpr double rounding = 1e-6;

void expect_cones_enclose(const View& view, const ConeHierarchy& cones)
{
    // A flat view has the angle of a pixel's centre, a map that of its whole area. They differ by the next order in the
    // pixel's longer side, which is longer than its angle where the pixel is oblong.
    const PictureRays rays(view.picture);
    const auto longer_side = [&](int x, int y) {
        const dvec2 middle(x + 0.5, y + 0.5);
        const auto side
            = [&](dvec2 half) { return glm::distance(*rays.direction(middle - half), *rays.direction(middle + half)); };
        return std::max(side({0.5, 0}), side({0, 0.5}));
    };
    const auto all = pixels(view);
    ASSERT_EQ(cones.size(), view.size);
    EXPECT_EQ(cones.count(0), ivec2(1));
    for (int level = 0; level < cones.levels(); ++level) {
        const int side = cones.side(level);
        const ivec2 count = cones.count(level);
        for (int j = 0; j < count.y; ++j)
            for (int i = 0; i < count.x; ++i) {
                const BoundingCone cone = cones.cone(level, {i, j});
                bool any = false;
                double finest = 1e9, coarsest = 0, widest = 0, longest = 0;
                for (int y = j * side; y < std::min((j + 1) * side, view.size.y); ++y)
                    for (int x = i * side; x < std::min((i + 1) * side, view.size.x); ++x) {
                        const auto& [n, angle] = all[std::size_t(y) * view.size.x + x];
                        if (angle == 0)
                            continue;
                        any = true;
                        finest = std::min(finest, angle), coarsest = std::max(coarsest, angle);
                        longest = std::max(longest, cones.flat() ? longer_side(x, y) : 0);
                        widest = std::max(widest, sphere::angle(glm::normalize(n), glm::normalize(dvec3(cone.centre))));
                    }
                ASSERT_EQ(cone.empty(), !any) << level << " " << i << " " << j;
                if (!any)
                    continue;
                ASSERT_LE(widest, cone.radius + rounding);
                const double room = 1 + rounding + longest * longest;
                ASSERT_LE(cone.finest, finest * room);
                ASSERT_GE(cone.coarsest * room, coarsest);
                // A leaf's cone must be about as narrow as the leaf.
                if (level + 1 == cones.levels()) {
                    ASSERT_LE(cone.radius, 1.2 * widest + 1e-5) << level << " " << i << " " << j;
                }
            }
    }
}

const Projection projections[]
    = {Planar{60}, Planar{120, {}, {30, -20, 10}}, Planar{60, Sides{-50, 10, -5, 40}}, Fisheye{180, 30}, Fisheye{360, 90},
        Cylinder{}, Equirectangular{}, Wall{{-1, -1, -2}, {1.2, -0.5, -2}, {-0.2, 1.5, -2}, {{0.9, 1.1, -2}}},
        Wall{{-1.5, -1, -1}, {0.5, -0.8, -2}, {-1.5, 0.8, -1}, {{0.5, 1.4, -2}}}};

} // namespace

TEST(ConeHierarchyTest, ConesEncloseEveryPixel)
{
    for (const Projection& projection : projections)
        for (ivec2 size : {ivec2(61, 40), ivec2(8, 8), ivec2(1, 33)}) {
            SCOPED_TRACE(std::to_string(projection.index()) + " " + std::to_string(size.x));
            const View view = view_of(projection, size);
            expect_cones_enclose(view, ConeHierarchy(compile_direction_map(view)));
            if (const auto matrix = view_matrix(view)) {
                EXPECT_TRUE(ConeHierarchy(*matrix, size).flat());
                if (size.x > 1) // a single column makes very narrow pixels in the map
                    expect_cones_enclose(view, ConeHierarchy(*matrix, size));
            }
        }
}

TEST(ConeHierarchyTest, FindReturnsTheProjectionsPixel)
{
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    struct Case {
        Projection projection;
        ivec2 size;
        std::function<std::optional<dvec2>(const dvec3&)> expected;
    };
    const double half = std::tan(glm::radians(30.0));
    const dvec3 zenith(0, std::cos(glm::radians(30.0)), -std::sin(glm::radians(30.0))),
        front(0, -std::sin(glm::radians(30.0)), -std::cos(glm::radians(30.0)));
    const Case cases[] = {
        {Planar{60}, {200, 150},
            [&](const dvec3& d) -> std::optional<dvec2> {
                if (d.z >= 0)
                    return {};
                return dvec2(100, 75) + dvec2(d.x, -d.y) / -d.z * (75 / half);
            }},
        {Fisheye{180, 30}, {300, 300},
            [&](const dvec3& d) -> std::optional<dvec2> {
                const double up = glm::dot(d, zenith), angle = std::acos(up);
                const dvec2 flat(d.x, glm::dot(d, front));
                if (up < 0)
                    return {};
                return dvec2(150) + flat / glm::length(flat) * (angle / (sphere::pi / 2) * 150);
            }},
        {Equirectangular{}, {360, 180},
            [&](const dvec3& d) -> std::optional<dvec2> {
                return dvec2(180 + glm::degrees(std::atan2(d.x, -d.z)), 90 - glm::degrees(std::asin(d.y)));
            }},
    };
    for (const Case& c : cases) {
        const DirectionMap map = compile_direction_map(view_of(c.projection, c.size));
        const ConeHierarchy cones(map);
        int found = 0;
        double worst = 0;
        for (int k = 0; k < 20000; ++k) {
            const dvec3 d = glm::normalize(dvec3(normal(random), normal(random), normal(random)));
            const auto at = find_pixel(map, cones, d), expected = c.expected(d);
            const bool inside = expected && glm::all(glm::greaterThan(*expected, dvec2(1)))
                && glm::all(glm::lessThan(*expected, dvec2(c.size) - 1.0));
            const bool outside = !expected || glm::any(glm::lessThan(*expected, dvec2(-1)))
                || glm::any(glm::greaterThan(*expected, dvec2(c.size) + 1.0));
            if (c.projection.index() == Projection(Equirectangular{}).index() && std::abs(d.y) > 0.98)
                continue; // near the poles, where a row is one direction
            if (c.projection.index() == Projection(Fisheye{}).index() && std::abs(glm::dot(d, zenith)) < 0.02)
                continue; // the rim, where the circle cuts pixels
            if (inside) {
                ASSERT_TRUE(at) << d.x << " " << d.y << " " << d.z;
                worst = std::max(worst, glm::distance(*at, *expected));
                ++found;
            }
            if (outside) {
                ASSERT_FALSE(at) << d.x << " " << d.y << " " << d.z;
            }
        }
        std::printf("  find: worst %.3f pixels of %d\n", worst, found);
        EXPECT_LT(worst, 0.02); // linear over half a pixel of a degree: off by 0.5^2 / 2 of a degree's curvature, 0.002
        EXPECT_GT(found, 1000);
    }
}

TEST(ConeHierarchyTest, AnEmptyMapHasNoPixels)
{
    DirectionMap dark;
    dark.size = {16, 16};
    dark.texels.assign(256, glm::vec4(0));
    EXPECT_FALSE(find_pixel(dark, ConeHierarchy(dark), {0, 0, -1}));
    EXPECT_TRUE(ConeHierarchy(dark).cone(0, {0, 0}).empty());
    const dvec3 side(0, 0, -1);
    EXPECT_EQ(pixels_in_pyramid(ConeHierarchy(dark), {&side, 1}).high, ivec2(0));
}

TEST(ConeHierarchyTest, BoxesEncloseThePixelsOfAPyramid)
{
    for (const Projection& projection : projections) {
        const View view = view_of(projection, {96, 72});
        const auto all = pixels(view);
        const auto matrix = view_matrix(view);
        for (const ConeHierarchy& cones : {ConeHierarchy(compile_direction_map(view)),
                 matrix ? ConeHierarchy(*matrix, view.size) : ConeHierarchy(compile_direction_map(view))})
            for (const Turn& turn : {Turn{0, 0, 0}, Turn{70, 30, 0}, Turn{180, -40, 20}}) {
                // The pyramid reaches 20 degrees to each side of the turn's axis.
                const glm::dmat3 axes = cockpit_from_picture(turn);
                const double s = std::sin(glm::radians(20.0)), c = std::cos(glm::radians(20.0));
                const dvec3 sides[]
                    = {axes * dvec3(c, 0, -s), axes * dvec3(-c, 0, -s), axes * dvec3(0, c, -s), axes * dvec3(0, -c, -s)};
                const PixelBox box = pixels_in_pyramid(cones, sides);
                ivec2 low(1000), high(0);
                double finest = 1;
                for (int y = 0; y < view.size.y; ++y)
                    for (int x = 0; x < view.size.x; ++x) {
                        const auto& [n, angle] = all[std::size_t(y) * view.size.x + x];
                        bool in = angle > 0;
                        for (const dvec3& side : sides)
                            in &= glm::dot(side, n) >= 0;
                        if (!in)
                            continue;
                        finest = std::min(finest, angle);
                        low = glm::min(low, ivec2(x, y)), high = glm::max(high, ivec2(x, y) + 1);
                    }
                if (high.x == 0)
                    continue;
                EXPECT_TRUE(glm::all(glm::lessThanEqual(box.low, low)) && glm::all(glm::greaterThanEqual(box.high, high)));
                EXPECT_LE(box.finest, finest * (1 + rounding));
                // The box is at most a block of 8 and its neighbours larger than needed. At the rim of the whole sphere's
                // fisheye a block covers all azimuths.
                if (const auto* fisheye = std::get_if<Fisheye>(&projection); fisheye && fisheye->aperture_deg == 360)
                    continue;
                const ivec2 more = glm::max(low - box.low, box.high - high);
                EXPECT_LE(std::max(more.x, more.y), 24);
            }
    }
}

} // namespace cone_hierarchy_test
