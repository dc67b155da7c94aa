// The head-up display is parallel to a flat screen that shows it, and faces the visitor on all other screens.
#include "config/model/shipped.h"
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

namespace {

/// A layout of one output with these viewports.
Layout one_output(std::vector<Viewport> viewports, glm::ivec2 size)
{
    Layout layout;
    layout.outputs.resize(1);
    layout.outputs[0].size = size;
    layout.outputs[0].viewports = std::move(viewports);
    return layout;
}

std::vector<std::vector<CompiledView>> compiled(const Layout& layout, glm::ivec2 size)
{
    MapStore store{std::filesystem::path()};
    return {compile_output(store, layout, 0, size)};
}

/// The direction of a point of the display by its definition: it lies on a plane across the direction that it faces, its
/// middle in the placement's direction, x and y in halves of its width and height.
dvec3 on_display(const HudPlacement& hud, const dvec3& faces, double x, double y)
{
    const dvec3 across = glm::normalize(glm::cross(faces, dvec3(0, 1, 0))), up = glm::cross(across, faces);
    const dvec3 middle = towards(hud.azimuth_deg, hud.elevation_deg);
    const double half = std::tan(glm::radians(hud.width_deg / 2));
    return glm::normalize(middle / glm::dot(middle, faces) + half * (x * across + y * 0.2 * up));
}

} // namespace

// The test has the pictures' borders in its own form: a flat picture's from its angle and its shape, a dome's from its rim.
TEST(HudPlaceTest, ALayoutWithoutAPlacementShowsTheWholeDisplayOnAnyShape)
{
    for (const glm::ivec2 size : {glm::ivec2(160, 90), {120, 90}, {90, 120}, {90, 160}, {600, 1067}, {256, 96}, {64, 192}})
        for (const double fov_y_deg : {20.0, 40.0, 60.0, 90.0}) {
            SCOPED_TRACE(std::to_string(size.x) + " x " + std::to_string(size.y) + ", " + std::to_string(fov_y_deg));
            const Layout layout = one_output({{.projection = Planar{fov_y_deg}}}, size);
            const HudPlacement hud = placed_hud(layout, std::vector{size}, compiled(layout, size));
            const double high = std::tan(glm::radians(fov_y_deg / 2)), wide = high * size.x / size.y;
            const double middle = std::tan(glm::radians(hud.elevation_deg)),
                         half = std::tan(glm::radians(hud.width_deg / 2));
            EXPECT_EQ(hud.azimuth_deg, 0);
            EXPECT_LE(half, 0.9 * wide) << "5 % of the width at either edge stay free";
            EXPECT_GE(middle - 0.2 * half, -0.9 * high);
            EXPECT_LE(middle + 0.2 * half, 0) << "below the middle, where the flight leads";
            EXPECT_GE(half, 0.9 * std::min({0.9 * wide, std::tan(glm::radians(24.0)), 0.28 * high / 0.2}))
                << "as wide as it may be";
            EXPECT_EQ(hud_warning(layout, hud, compiled(layout, size)), "");
        }
    for (const double tilt : {0.0, 15.0, 30.0, 60.0, 90.0})
        for (const double aperture : {120.0, 180.0, 220.0}) {
            SCOPED_TRACE(std::to_string(tilt) + " tilted, " + std::to_string(aperture));
            const Layout layout = one_output({{.projection = Fisheye{aperture, tilt}}}, {400, 400});
            const HudPlacement hud = placed_hud(layout, std::vector{glm::ivec2(400)}, compiled(layout, {400, 400}));
            const dvec3 zenith = towards(0, 90 - tilt);
            for (const double x : {-1.0, 0.0, 1.0})
                for (const double y : {-1.0, 0.0, 1.0})
                    EXPECT_LE(glm::degrees(std::acos(
                                  glm::dot(zenith, on_display(hud, towards(hud.azimuth_deg, hud.elevation_deg), x, y)))),
                        aperture / 2);
            EXPECT_EQ(hud.azimuth_deg, 0);
            EXPECT_GE(hud.width_deg, 40);
        }
}

TEST(HudPlaceTest, OnADividedWallTheDisplayIsWholeOnOneScreenAndForBothEyes)
{
    const auto wall = [](double left, double right) { return Wall{{left, -0.5, -1}, {right, -0.5, -1}, {left, 0.5, -1}}; };
    // Three upright screens with frames of 0.1 m between them.
    const Layout three = one_output(
        {{.rect = {0, 0, 0.3, 1}, .projection = wall(-1, -0.4)}, {.rect = {0.33, 0, 0.34, 1}, .projection = wall(-0.3, 0.3)},
            {.rect = {0.7, 0, 0.3, 1}, .projection = wall(0.4, 1)}},
        {300, 150});
    const HudPlacement hud = placed_hud(three, {}, compiled(three, {300, 150}));
    EXPECT_EQ(hud.azimuth_deg, 0);
    EXPECT_LT(std::tan(glm::radians(hud.width_deg / 2)), 0.9 * 0.3);
    EXPECT_GT(std::tan(glm::radians(hud.width_deg / 2)), 0.9 * 0.26);
    // A screen to the right alone.
    const Layout right = one_output({{.projection = Planar{40, {}, {70, 0, 0}}}}, {160, 120});
    EXPECT_NEAR(placed_hud(right, {}, compiled(right, {160, 120})).azimuth_deg, 70, 27);
    EXPECT_EQ(hud_warning(right, placed_hud(right, {}, compiled(right, {160, 120})), compiled(right, {160, 120})), "");
    // Two eyes 0.4 m apart at 1 m before a wall 0.8 m wide: what both see is from -31 to 31 degrees for neither alone.
    Layout two = one_output({{.projection = wall(-0.4, 0.4)}}, {160, 200});
    two.outputs[0].packing = Packing::side_by_side;
    two.stereo.separation_m = 0.4;
    const HudPlacement shared = placed_hud(two, {}, compiled(two, {320, 200}));
    EXPECT_LT(std::tan(glm::radians(shared.width_deg / 2)), 0.2 + 0.01) << "the left eye sees 0.2 m of it on its left";
    // A viewport on top of the picture's lower half.
    const Layout covered = one_output(
        {{.projection = Planar{60}}, {.rect = {0, 0.5, 1, 0.5}, .projection = Planar{30, {}, {180, 0, 0}}, .order = 1}},
        {160, 120});
    const HudPlacement above = placed_hud(covered, {}, compiled(covered, {160, 120}));
    EXPECT_GT(std::tan(glm::radians(above.elevation_deg)), 0.2 * std::tan(glm::radians(above.width_deg / 2)));
}

// A pixel's direction and the display by its definition: no matrix, no search for a pixel.
TEST(HudPlaceTest, NoShippedWindowOrWallHasTheDisplayInItsOutermostTwentieth)
{
    int outputs = 0;
    for (const std::string& name : shipped_names("layouts")) {
        const Layout layout = load_layout(shipped_file("layouts", name));
        MapStore store{std::filesystem::path()};
        std::vector<std::vector<CompiledView>> views;
        std::vector<glm::ivec2> sizes;
        for (std::size_t i = 0; i < layout.outputs.size(); ++i) {
            sizes.push_back(glm::max(layout.outputs[i].size / 8, 1));
            views.push_back(compile_output(store, layout, i, sizes[i]));
        }
        const HudPlacement hud = placed_hud(layout, sizes, views);
        const glm::dmat3 panel = panel_from_cockpit(hud, views);
        const glm::dvec2 half = std::tan(glm::radians(hud.width_deg / 2)) * glm::dvec2(1, 0.2);
        for (std::size_t output = 0; output < views.size(); ++output)
            for (const CompiledView& view : views[output]) {
                if (!view.matrix || layout.outputs[output].preview)
                    continue; // domes and lenses have bands of their own
                ++outputs;
                const glm::dvec2 size(view.view.size);
                for (int i = 0; i <= 400; ++i)
                    for (const bool far : {false, true}) {
                        const double along = i / 400.0, across = far ? 0.951 : 0.049;
                        for (const glm::dvec2& at : {glm::dvec2(along, across), {across, along}}) {
                            const dvec3 way
                                = panel * *direction(view.view.picture, at * size * view.view.picture_from_pixel);
                            const bool inside
                                = way.z > 0 && std::abs(way.x) < half.x * way.z && std::abs(way.y) < half.y * way.z;
                            EXPECT_FALSE(inside)
                                << name << " " << layout.outputs[output].name << " at " << at.x << ", " << at.y;
                            if (inside)
                                i = 400;
                        }
                    }
            }
    }
    EXPECT_GT(outputs, 15);
}

TEST(HudPlaceTest, ALayoutsOwnPlacementIsKeptAndItsCutIsSaid)
{
    Layout layout = one_output({{.projection = Planar{60}}}, {540, 960});
    layout.hud = HudPlacement{0, 0, 48};
    const auto views = compiled(layout, {540, 960});
    const std::vector own{glm::ivec2(540, 960)};
    EXPECT_EQ(placed_hud(layout, own, views).width_deg, 48);
    EXPECT_NE(hud_warning(layout, *layout.hud, views).find("is cut: "), std::string::npos)
        << hud_warning(layout, *layout.hud, views);
    layout.hud->elevation_deg = 60;
    EXPECT_NE(hud_warning(layout, *layout.hud, views).find("is seen nowhere"), std::string::npos);
    layout.hud = HudPlacement{0, 20, 30};
    EXPECT_EQ(hud_warning(layout, *layout.hud, views), "");
    // The same layout in a window of another shape, where its own place would be cut.
    layout.hud = HudPlacement{0, -26, 34};
    const glm::ivec2 narrow(300, 960);
    EXPECT_LT(placed_hud(layout, std::vector{narrow}, compiled(layout, narrow)).width_deg, 21);
    EXPECT_EQ(placed_hud(layout, std::vector{glm::ivec2(270, 480)}, compiled(layout, {270, 480})).width_deg, 34);
}

} // namespace hud_place_test
