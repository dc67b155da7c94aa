#include "displays/compile/compiled_view.h"
#include <bit>
#include <gtest/gtest.h>

namespace direction_map_test {

using namespace starbow;

namespace {

View view_of(const Projection& projection, glm::ivec2 size)
{
    Layout layout;
    layout.outputs.resize(1);
    layout.outputs[0].size = size;
    layout.outputs[0].viewports = {{.projection = projection}};
    return views_of(layout, 0, size).front();
}

} // namespace

TEST(DirectionMapTest, CompiledMapsEqualTheProjections)
{
    struct Case {
        Projection projection;
        glm::ivec2 size;
        bool long_pixels; ///< some of its pixels are very long: their angle is half their length
    };
    const Case cases[]{{Planar{60}, {80, 60}, false}, {Planar{179}, {101, 100}, true}, {Fisheye{180, 30}, {64, 48}, false},
        {Fisheye{360, 90}, {255, 256}, true}, {Fisheye{1, 180}, {64, 65}, false}};
    for (const Case& c : cases) {
        const View view = view_of(c.projection, c.size);
        const DirectionMap map = compile_direction_map(view), again = compile_direction_map(view);
        ASSERT_EQ(map.size, c.size);
        ASSERT_EQ(map.texels.size(), std::size_t(c.size.x) * c.size.y);
        EXPECT_EQ(map.texels, again.texels);
        for (int y = 0; y < c.size.y; y += 3)
            for (int x = 0; x < c.size.x; x += 7) {
                const glm::dvec2 centre(x + 0.5, y + 0.5);
                const auto seen = direction(view.picture, centre);
                const glm::vec4 texel = map.at(x, y);
                ASSERT_EQ(glm::vec3(texel), seen ? glm::vec3(*seen) : glm::vec3(0));
                const float angle = float(pixel_angle(view.picture, centre));
                ASSERT_TRUE(!seen       ? texel.w == 0
                        : c.long_pixels ? texel.w >= angle
                                        : texel.w == angle)
                    << x << " " << y << " " << texel.w << " " << angle;
            }
    }
}

TEST(DirectionMapTest, TheSmallestMapsAreRight)
{
    EXPECT_NEAR(compile_direction_map(view_of(Planar{60}, {1, 1})).texels.at(0).z, -1, 1e-7);
    EXPECT_EQ(compile_direction_map(view_of(Fisheye{180, 0}, {1, 3})).texels.at(0), glm::vec4(0));
    EXPECT_NEAR(compile_direction_map(view_of(Fisheye{180, 0}, {1, 3})).texels.at(1).y, 1, 1e-7);
}

// Decodes the octahedron's net step by step: a texel's coordinates are a point on one of eight triangles.
TEST(DirectionMapTest, PackedTexelsKeepTheirDirectionAndAngle)
{
    DirectionMap map;
    for (int i = 0; i < 20000; ++i) {
        const double z = 1 - (i + 0.5) / 10000, azimuth = i * 2.399963; // a Fibonacci sphere
        const double r = std::sqrt(1 - z * z);
        map.texels.push_back({r * std::cos(azimuth), r * std::sin(azimuth), z, std::pow(10.0, -6 + 7.0 * i / 20000)});
    }
    for (int axis = 0; axis < 3; ++axis)
        for (float sign : {-1.0f, 1.0f}) {
            glm::vec4 along(0, 0, 0, 1e-3f);
            along[axis] = sign;
            map.texels.push_back(along);
        }
    map.texels.push_back(glm::vec4(0));
    map.size = {int(map.texels.size()), 1};
    std::vector<glm::uvec2> all(map.texels.size());
    pack_rows(map, 0, 0, map.size.y, all);
    double worst = 0;
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
        const double x = (double(all[i].x >> 8) - 8388608) / 8388607, y = (double(all[i].y >> 8) - 8388608) / 8388607;
        glm::dvec3 n(x, y, 1 - std::abs(x) - std::abs(y));
        if (n.z < 0) // the outer triangles hold the lower half, mirrored at the inner edges
            n = {(x < 0 ? -1 : 1) * (1 - std::abs(y)), (y < 0 ? -1 : 1) * (1 - std::abs(x)), n.z};
        worst = std::max(worst, glm::distance(glm::normalize(n), glm::normalize(glm::dvec3(map.texels[i]))));
        const float angle = std::bit_cast<float>((all[i].x & 255) << 16 | (all[i].y & 255) << 24);
        ASSERT_NEAR(angle / map.texels[i].w, 1, 1 / 256.0) << i; // 8 bits with the implicit one, rounded
    }
    // Half a step of 2^-23 in x and y, twice that in z, enlarged on the sphere over the face's middle: sqrt(6 * 3) / 2
    // steps.
    EXPECT_LE(worst, std::sqrt(18.0) / 2 / 8388607);
    EXPECT_EQ(all.back(), glm::uvec2(0));
}

} // namespace direction_map_test
