// The head-up display is parallel to a flat screen that shows it, and faces the visitor on all other screens.
#include "displays/projections/views.h"
#include "runtime/hud/hud_place.h"
#include "tests/support/view.h"
#include <gtest/gtest.h>

namespace hud_place_test {

using namespace starbow;
using glm::dvec3;

namespace {

glm::dmat3 placed(const HudPlacement& hud, const std::vector<Projection>& screens)
{
    Layout layout;
    MapStore store{std::filesystem::path()};
    std::vector<std::vector<CompiledView>> views;
    for (const Projection& projection : screens) {
        Output output;
        output.size = {80, 60};
        output.viewports = {{.projection = projection}};
        layout.outputs.push_back(output);
        views.push_back(compile_output(store, layout, layout.outputs.size() - 1, output.size));
    }
    return panel_from_cockpit(hud, views);
}

dvec3 towards(double azimuth_deg, double elevation_deg)
{
    const double a = glm::radians(azimuth_deg), e = glm::radians(elevation_deg);
    return {std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)};
}

/// The point of the panel in a direction.
glm::dvec2 panel_point(const glm::dmat3& panel, const dvec3& direction)
{
    const dvec3 at = panel * direction;
    return glm::dvec2(at) / at.z;
}

} // namespace

TEST(HudPlaceTest, ItsMiddleIsInTheLayoutsDirection)
{
    for (const HudPlacement& hud : {HudPlacement{0, 0, 40}, HudPlacement{30, -20, 40}, HudPlacement{-150, 60, 20}})
        for (const Projection& screen :
            std::initializer_list<Projection>{Planar{60}, Fisheye{180, 30}, Planar{90, {}, {25, -10, 5}}}) {
            const dvec3 middle = placed(hud, {screen}) * towards(hud.azimuth_deg, hud.elevation_deg);
            EXPECT_NEAR(middle.x, 0, 1e-12);
            EXPECT_NEAR(middle.y, 0, 1e-12);
            EXPECT_GT(middle.z, 0.1);
        }
}

TEST(HudPlaceTest, OnAFlatScreenItsLinesAreParallelToTheScreens)
{
    // Along a row of the screen the panel's height is constant, however the screen is turned.
    for (const dvec3& turn : {dvec3(0, 0, 0), dvec3(0.1, 0, 0), dvec3(40, 0, 0), dvec3(20, 0.1, 0)}) {
        const Planar screen{60, {}, {turn.x, turn.y, turn.z}};
        const glm::dmat3 panel = placed({turn.x, -20, 40}, {Fisheye{120, 90}, screen});
        const Picture picture{screen, {80, 60}};
        const double height = panel_point(panel, *direction(picture, {40, 50})).y;
        for (double x : {5.0, 20.0, 75.0})
            EXPECT_NEAR(panel_point(panel, *direction(picture, {x, 50})).y, height, 1e-9) << turn.x << " " << turn.y;
    }
}

TEST(HudPlaceTest, ItMovesContinuouslyWithTheScreen)
{
    const auto corner = [](double yaw) { return placed({0, -24.5, 62}, {Planar{60, {}, {yaw, 0, 0}}}) * towards(20, -28); };
    EXPECT_LT(glm::distance(corner(0), corner(0.1)), 0.002); // 0.1 degrees are 0.0017
}

TEST(HudPlaceTest, ElsewhereItFacesTheVisitor)
{
    for (const auto& [azimuth, elevation] : {std::pair(0.0, -30.0), {100.0, 20.0}, {180.0, 0.0}}) {
        const glm::dmat3 panel = placed({azimuth, elevation, 40}, {Planar{20, {}, {-60, 70, 0}}, Fisheye{180, 0}});
        const dvec3 middle = towards(azimuth, elevation);
        EXPECT_NEAR(glm::length(panel * middle - dvec3(0, 0, 1)), 0, 1e-12);
        EXPECT_NEAR(panel_point(panel, towards(azimuth + 5, elevation)).y,
            panel_point(panel, towards(azimuth - 5, elevation)).y, 1e-12);
        EXPECT_GT(panel_point(panel, towards(azimuth + 5, elevation)).x, 0);
        EXPECT_GT(panel_point(panel, towards(azimuth, elevation + 5)).y, 0);
    }
}

TEST(HudPlaceTest, TheBoxHoldsThePanelsPixelsAndFewOthers)
{
    for (const auto& [projection, size] : {std::pair<Projection, glm::ivec2>(Planar{60}, {400, 300}),
             {Fisheye{180, 30}, {300, 300}}, {Equirectangular{}, {400, 200}}})
        for (const HudPlacement& hud : {HudPlacement{0, -15, 30}, {10, 5, 12}})
            for (const glm::dvec2& shape : {glm::dvec2(1, 0.2), {0.2, 1}, {1, 1}}) {
                const CompiledView view = starbow::testing::view_of(projection, size);
                const glm::dmat3 panel = placed(hud, {projection});
                const glm::dvec2 half = shape * std::tan(glm::radians(hud.width_deg) / 2);
                glm::ivec2 low = size, high(0); // around the pixels whose centres the panel covers
                for (int y = 0; y < size.y; ++y)
                    for (int x = 0; x < size.x; ++x) {
                        const auto way = direction(view.view.picture, {x + 0.5, y + 0.5});
                        if (!way || (panel * *way).z <= 0)
                            continue;
                        const glm::dvec2 at = panel_point(panel, *way);
                        if (std::abs(at.x) < half.x && std::abs(at.y) < half.y)
                            low = glm::min(low, glm::ivec2(x, y)), high = glm::max(high, glm::ivec2(x, y) + 1);
                    }
                const PixelBox box = panel_box(*view.cones, panel, half);
                EXPECT_TRUE(glm::all(glm::lessThanEqual(box.low, low)) && glm::all(glm::greaterThanEqual(box.high, high)))
                    << hud.azimuth_deg << ' ' << shape.x << ' ' << shape.y;
                // Squares of pixels are in it as a whole.
                EXPECT_TRUE(
                    glm::all(glm::greaterThanEqual(box.low, low - 17)) && glm::all(glm::lessThanEqual(box.high, high + 17)))
                    << hud.azimuth_deg << ' ' << shape.x << ' ' << shape.y << ": " << low.x - box.low.x << ' '
                    << low.y - box.low.y << ' ' << box.high.x - high.x << ' ' << box.high.y - high.y;
            }
}

} // namespace hud_place_test
