// The warnings that `check` gives for a layout; a shipped layout has none.
#include "displays/check/lint.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>

namespace lint_test {

using namespace starbow;

namespace {

Layout of(std::vector<std::pair<Projection, glm::ivec2>> views)
{
    Layout layout;
    for (const auto& [projection, size] : views) {
        Output output;
        output.name = std::string(1, char('a' + layout.outputs.size()));
        output.size = size;
        output.viewports = {{.projection = projection}};
        layout.outputs.push_back(output);
    }
    return layout;
}

std::string warnings(const Layout& layout)
{
    std::string all;
    for (const std::string& line : lint(layout, coverages(layout)))
        all += line + "\n";
    return all;
}

bool has(const std::string& all, const std::string& part) { return all.find(part) != all.npos; }

} // namespace

TEST(LintTest, ShippedLayoutsHaveNoWarnings)
{
    for (const auto& entry : std::filesystem::directory_iterator(starbow::testing::source_dir() / "config/layouts")) {
        if (entry.path().extension() != ".json" || entry.path().stem() == "dome2") // its meshes would need compiling
            continue;
        const Layout layout = load_layout(entry.path());
        for (const std::string& line : lint(layout, coverages(layout)))
            EXPECT_TRUE(has(line, "monitors are not looked for")) << entry.path() << ": " << line;
    }
}

TEST(LintTest, WrongUnitsPixelsAndOverlapsGiveWarnings)
{
    const Wall metres{{-2, -1, -3}, {2, -1, -3}, {-2, 1, -3}};
    EXPECT_EQ(warnings(of({{metres, {400, 200}}})), "");
    const Wall millimetres{{-2000, -1000, -3000}, {2000, -1000, -3000}, {-2000, 1000, -3000}};
    EXPECT_TRUE(has(warnings(of({{millimetres, {400, 200}}})), "a: its wall is 4000 m wide; lengths are in metres"));
    EXPECT_TRUE(has(warnings(of({{Planar{1.0472}, {400, 300}}})), "angles are in degrees"));
    EXPECT_TRUE(has(warnings(of({{Fisheye{.aperture_deg = 3.1416}, {300, 300}}})), "angles are in degrees"));
    EXPECT_TRUE(has(warnings(of({{metres, {400, 225}}})), "12.5 % wider than high"));
    EXPECT_TRUE(has(warnings(of({{metres, {400, 190}}})), "higher than wide"));

    Layout twice = of({{Planar{60, {}, {-30, 0, 0}}, {400, 300}}, {Planar{60, {}, {30, 0, 0}}, {400, 300}}});
    EXPECT_TRUE(has(warnings(twice), "light it twice"));
    twice.blend.ramps = true;
    EXPECT_EQ(warnings(twice), "");
}

TEST(LintTest, ExchangedCornersGiveWarnings)
{
    const std::string head = "stands on its head", side = "lies on its side";
    const auto said = [&](const Wall& wall) { return warnings(of({{wall, {400, 200}}})); };
    const auto square = [&](const Wall& wall) {
        const std::string all = warnings(of({{wall, {200, 200}}}));
        return has(all, "corners may be exchanged");
    };
    EXPECT_FALSE(has(said({{-2, -1, -3}, {2, -1, -3}, {-2, 1, -3}}), "corners"));
    EXPECT_TRUE(has(said({{2, 1, -3}, {-2, 1, -3}, {2, -1, -3}}), head)); // right above for left below: the front is kept
    EXPECT_TRUE(has(said({{2, -1, -3}, {2, 1, -3}, {-2, -1, -3}}), side)); // each corner one place on
    EXPECT_TRUE(has(said({{-2, 1, -3}, {-2, -1, -3}, {2, 1, -3}}), side));
    EXPECT_FALSE(square({{-1, -1, 1}, {-1, -1, -1}, {-1, 1, 1}})); // the left wall of a CAVE
    EXPECT_FALSE(square({{-1, -1, 1}, {1, -1, 1}, {-1, -1, -1}})); // its floor
    EXPECT_TRUE(square({{1, -1, -1}, {-1, -1, -1}, {1, -1, 1}})); // its floor, turned about
    EXPECT_FALSE(square({{-1, 1, -1}, {1, 1, -1}, {-1, 1, 1}})); // its ceiling
    EXPECT_TRUE(square({{1, 1, 1}, {-1, 1, 1}, {1, 1, -1}}));
}

TEST(LintTest, CornersByTapeGiveTheirResiduals)
{
    // 20 mm askew on 2 m: half of the miss at each end of the shorter side's edge.
    const std::string tape = warnings(of({{Wall{{-2, -1, -2}, {2, -1, -2}, {-1.98, 1, -2}}, {800, 400}}}));
    EXPECT_TRUE(has(tape,
        "a: its corners make no rectangle; the nearest one is shown, at the lower left 8.9 mm off, the lower right 4 mm "
        "off, the upper left 8 mm off"))
        << tape;
    const std::string askew
        = warnings(of({{Wall{{-1, -1, -2.01}, {1, -1, -1.99}, {-1, 1, -1.99}, {{1, 1, -2.01}}}, {400, 400}}}));
    EXPECT_TRUE(has(askew, "a: its corners lie in no plane; the nearest one is shown, at the lower left 10 mm off"))
        << askew;
}

TEST(LintTest, EyesAndTheirTrackerGiveWarnings)
{
    const Wall wall{{-2, -1, -3}, {2, -1, -3}, {-2, 1, -3}};
    Layout layout = of({{wall, {400, 200}}});
    layout.head_tracker = HeadTracking{4243, "0.0.0.0"};
    EXPECT_EQ(warnings(layout), "a head tracker is expected at UDP port 4243 of 0.0.0.0, in opentrack's format\n");
    layout.outputs[0].viewports[0].projection = Planar{60};
    EXPECT_TRUE(has(warnings(layout), "no viewport is a wall"));

    Layout two = of({{wall, {400, 200}}});
    two.outputs[0].packing = Packing::anaglyph_dubois;
    EXPECT_TRUE(has(warnings(two), "two eyes show no depth in worlds whose unit is a light-second"));
    two.stereo.hyper_stereo = 1.5e8;
    EXPECT_EQ(warnings(two), "");
    two.stereo.separation_m = 6.5;
    EXPECT_TRUE(has(warnings(two), "the eyes are 6.5 m apart; lengths are in metres"));

    Layout far = of({{wall, {400, 200}}});
    far.outputs[0].viewports[0].eye_m = {0, 0, 65};
    EXPECT_TRUE(has(warnings(far), "a: its eye is 65 m from the cockpit's middle; lengths are in metres"));
}

} // namespace lint_test
