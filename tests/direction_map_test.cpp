#include "displays/compiled.h"
#include <gtest/gtest.h>

using namespace starbow;

namespace {

Pane pane_of(const Projection& projection, glm::ivec2 size)
{
    Layout layout;
    layout.outputs.resize(1);
    layout.outputs[0].size = size;
    layout.outputs[0].viewports = {{.projection = projection}};
    return panes(layout, 0, size).front();
}

} // namespace

TEST(DirectionMapTest, CompiledMapsAreTheFunctions)
{
    struct Case {
        Projection projection;
        glm::ivec2 size;
        bool slivers; ///< some of its pixels are drawn out: these count by half their length
    };
    const Case cases[]{{Planar{60}, {80, 60}, false}, {Planar{179}, {101, 100}, true},
        {Fisheye{180, 30}, {64, 48}, false}, {Fisheye{360, 90}, {255, 256}, true}, {Fisheye{1, 180}, {64, 65}, false}};
    for (const Case& c : cases) {
        const Pane pane = pane_of(c.projection, c.size);
        const DirectionMap map = compile(pane), again = compile(pane);
        ASSERT_EQ(map.size, c.size);
        ASSERT_EQ(map.texels.size(), std::size_t(c.size.x) * c.size.y);
        EXPECT_EQ(map.texels, again.texels);
        for (int y = 0; y < c.size.y; y += 3)
            for (int x = 0; x < c.size.x; x += 7) {
                const glm::dvec2 centre(x + 0.5, y + 0.5);
                const auto seen = direction(pane.picture, centre);
                const glm::vec4 texel = map.at(x, y);
                ASSERT_EQ(glm::vec3(texel), seen ? glm::vec3(*seen) : glm::vec3(0));
                const float angle = float(pixel_angle(pane.picture, centre));
                ASSERT_TRUE(!seen ? texel.w == 0 : c.slivers ? texel.w >= angle : texel.w == angle)
                    << x << " " << y << " " << texel.w << " " << angle;
            }
    }
}

TEST(DirectionMapTest, SmallestMaps)
{
    EXPECT_NEAR(compile(pane_of(Planar{60}, {1, 1})).texels.at(0).z, -1, 1e-7);
    EXPECT_EQ(compile(pane_of(Fisheye{180, 0}, {1, 3})).texels.at(0), glm::vec4(0));
    EXPECT_NEAR(compile(pane_of(Fisheye{180, 0}, {1, 3})).texels.at(1).y, 1, 1e-7);
}
