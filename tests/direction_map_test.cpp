#include "displays/direction_map.h"
#include <gtest/gtest.h>

using namespace starbow;

TEST(DirectionMapTest, CompiledMapsAreTheFunctions)
{
    struct Case {
        Projection projection;
        glm::ivec2 size;
    };
    const Case cases[]{{Planar{60}, {80, 60}}, {Planar{179}, {101, 100}}, {Fisheye{180, 30}, {64, 48}},
        {Fisheye{360, 90}, {255, 256}}, {Fisheye{1, 180}, {64, 65}}};
    for (const Case& c : cases) {
        const DirectionMap map = compile(c.projection, c.size), again = compile(c.projection, c.size);
        ASSERT_EQ(map.size, c.size);
        ASSERT_EQ(map.texels.size(), std::size_t(c.size.x) * c.size.y);
        EXPECT_EQ(map.texels, again.texels);
        for (int y = 0; y < c.size.y; y += 3)
            for (int x = 0; x < c.size.x; x += 7) {
                const glm::dvec2 centre(x + 0.5, y + 0.5);
                const auto seen = direction(c.projection, c.size, centre);
                const glm::vec4 texel = map.texels[std::size_t(y) * c.size.x + x];
                ASSERT_EQ(
                    texel, seen ? glm::vec4(glm::dvec4(*seen, pixel_angle(c.projection, c.size, centre))) : glm::vec4(0));
                ASSERT_TRUE(!seen || texel.w > 0);
            }
    }
}

TEST(DirectionMapTest, SmallestMaps)
{
    EXPECT_NEAR(compile(Planar{60}, {1, 1}).texels.at(0).z, -1, 1e-7);
    EXPECT_EQ(compile(Fisheye{180, 0}, {1, 3}).texels.at(0), glm::vec4(0));
    EXPECT_NEAR(compile(Fisheye{180, 0}, {1, 3}).texels.at(1).y, 1, 1e-7);
}
