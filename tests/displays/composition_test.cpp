// Overlapping viewports: each pixel's shares, computed by hand from the rule in docs/displays.md.
#include "displays/finish/shade.h"
#include "tests/support/warp_fixture.h"
#include <numeric>

namespace composition_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

using glm::vec4;
using warp_test::png;

/// The rounding of floats between 0 and 1.
constexpr float rounding = 1e-6f;

std::filesystem::path grey(const std::string& name, double value)
{
    return write_text(name, png(1, 1, 1, {(unsigned char)std::lround(255 * value)}));
}

/// An output of 8 x 4 pixels with these viewports.
Layout over_each_other(std::vector<Viewport> viewports)
{
    Layout layout;
    layout.outputs.resize(1);
    layout.outputs[0].size = {8, 4};
    layout.outputs[0].viewports = std::move(viewports);
    return layout;
}

Shade shade(const Layout& layout, std::size_t output = 0)
{
    MapStore store{std::filesystem::path()};
    const auto views = compile_output(store, layout, output, layout.outputs[output].size);
    return layout.outputs[output].preview ? preview_shade(layout, layout.outputs[output].size, views)
                                          : shade_of(layout, output, layout.outputs[output].size, views, {});
}

void expect_share(const Shade& s, std::size_t layer, int x, int y, double factor, double part)
{
    const vec4 share = s.shares.at(layer)[std::size_t(y * 8 + x)];
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(share[c], factor, rounding) << "layer " << layer << " at " << x << " " << y;
    EXPECT_NEAR(share.a, part, rounding) << "layer " << layer << " at " << x << " " << y;
}

/// A Bourke mesh over the right half of its viewport, half as bright.
std::filesystem::path right_half()
{
    return write_text("right.data", "2\n2 2\n0 -1 0 0 0.5\n1 -1 1 0 0.5\n0 1 0 1 0.5\n1 1 1 1 0.5\n");
}

} // namespace

TEST(CompositionTest, ViewportsSideBySideHaveOneLayer)
{
    const Shade s = shade(over_each_other({{.rect = {0, 0, 0.5, 1}}, {.rect = {0.5, 0, 0.5, 1}}}));
    EXPECT_TRUE(s.empty() && s.shares.empty() && s.foremost.empty());
    EXPECT_EQ(s.layers, 1);
}

TEST(CompositionTest, AHigherOrderHidesWhatLiesBelowIt)
{
    for (const bool listed_first : {false, true}) {
        std::vector<Viewport> viewports = {{}, {.rect = {0.25, 0.25, 0.5, 0.5}, .order = 3}};
        if (listed_first)
            std::swap(viewports[0], viewports[1]);
        const Shade s = shade(over_each_other(viewports));
        ASSERT_EQ(s.layers, 2);
        const std::size_t lower = listed_first ? 1 : 0;
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 8; ++x) {
                const bool inside = x >= 2 && x < 6 && y >= 1 && y < 3;
                expect_share(s, lower, x, y, !inside, !inside);
                expect_share(s, 1 - lower, x, y, inside, inside);
                EXPECT_EQ(s.foremost[std::size_t(y * 8 + x)], inside ? 1 - lower : lower);
            }
    }
}

TEST(CompositionTest, AMaskIsAShareOfWhatHigherOrdersLeave)
{
    const Shade s = shade(over_each_other({{.alpha_mask = grey("low.png", 0.6)},
        {.alpha_mask = grey("top.png", 0.2), .order = 2}, {.alpha_mask = grey("middle.png", 0.8), .order = 1}}));
    ASSERT_EQ(s.layers, 3);
    const double low = 0.8 * 0.2 * 0.6, top = 0.2, middle = 0.8 * 0.8, sum = low + top + middle;
    expect_share(s, 0, 3, 2, low, low / sum);
    expect_share(s, 1, 3, 2, top, top / sum);
    expect_share(s, 2, 3, 2, middle, middle / sum);
    EXPECT_EQ(s.foremost[0], 2);
}

TEST(CompositionTest, ViewportsOfOneOrderAddTheirMasksAndLeaveNoLessThanNothing)
{
    const Shade s = shade(over_each_other(
        {{}, {.alpha_mask = grey("a.png", 0.8), .order = 1}, {.alpha_mask = grey("b.png", 0.4), .order = 1}}));
    expect_share(s, 0, 0, 0, 0, 0);
    expect_share(s, 1, 0, 0, 0.8, 0.8 / 1.2);
    expect_share(s, 2, 0, 0, 0.4, 0.4 / 1.2);
    const Shade blended = shade(over_each_other({{.alpha_mask = grey("a.png", 0.8)}, {.alpha_mask = grey("b.png", 0.2)}}));
    expect_share(blended, 0, 0, 0, 0.8, 0.8);
    expect_share(blended, 1, 0, 0, 0.2, 0.2);
}

// The mesh hides the left picture only where it shows something; its brightness dims its light, and not its share.
TEST(CompositionTest, AMeshHidesOnlyWhatItCovers)
{
    const Shade s = shade(over_each_other({{}, {.warp = Warp{.file = right_half()}, .order = 1}}));
    expect_share(s, 0, 1, 2, 1, 1);
    expect_share(s, 1, 1, 2, 0, 0);
    expect_share(s, 0, 6, 2, 0, 0);
    expect_share(s, 1, 6, 2, 0.5, 1);
}

TEST(CompositionTest, BlackMasksStillLeaveAForemostViewport)
{
    const Shade s
        = shade(over_each_other({{.alpha_mask = grey("no.png", 0)}, {.alpha_mask = grey("no.png", 0), .order = 1}}));
    expect_share(s, 0, 0, 0, 0, 0);
    expect_share(s, 1, 0, 0, 0, 1);
    EXPECT_EQ(s.foremost[0], 1);
}

TEST(CompositionTest, ABlackLevelCountsAsFarAsHigherOrdersLeaveLight)
{
    const Shade s = shade(over_each_other({{.black_level = grey("low.png", 0.2)},
        {.rect = {0, 0, 0.5, 1}, .alpha_mask = grey("mask.png", 0.8), .black_level = grey("top.png", 0.4), .order = 1}}));
    EXPECT_NEAR(s.black[0].g, 0.4 + 0.2 * 0.2, rounding);
    EXPECT_NEAR(s.black[7].g, 0.2, rounding);
    const Shade all[] = {s};
    EXPECT_NEAR(headroom(all), 1 - 0.44, rounding);
}

TEST(CompositionTest, EachEyesCanvasHasItsShares)
{
    Layout layout = over_each_other({{}, {.rect = {0, 0, 0.5, 1}, .order = 1}});
    layout.outputs[0].packing = Packing::rows;
    const Shade s = shade(layout);
    ASSERT_EQ(s.shares.size(), 4u);
    for (std::size_t canvas : {0, 1}) {
        expect_share(s, 2 * canvas, 0, 0, 0, 0);
        expect_share(s, 2 * canvas + 1, 0, 0, 1, 1);
        expect_share(s, 2 * canvas, 7, 0, 1, 1);
    }
}

// Without shading, but the picture must not be twice as bright where masks overlap.
TEST(CompositionTest, APreviewShowsThePartsAlone)
{
    Layout layout
        = over_each_other({{.alpha_mask = grey("a.png", 0.2)}, {.rect = {0, 0, 0.5, 1}, .alpha_mask = grey("b.png", 0.6)}});
    layout.outputs[0].name = "a";
    Output preview;
    preview.size = {48, 32};
    preview.preview = true;
    layout.outputs.push_back(preview);
    const Shade s = shade(layout, 1);
    ASSERT_EQ(s.layers, 2);
    double sum[2] = {0, 0};
    for (std::size_t i = 0; i < 48 * 32; ++i)
        if (s.foremost[i] != 255) {
            EXPECT_NEAR(s.shares[0][i].r + s.shares[1][i].r, 1, rounding);
            for (std::size_t layer : {0, 1})
                sum[layer] += s.shares[layer][i].r;
        }
    EXPECT_GT(sum[0], sum[1]); // it has the right half alone, and a quarter of the left
}

TEST(CompositionTest, OverlapsWithoutOrderAndMasksAreRefused)
{
    const auto why
        = [](std::vector<Viewport> viewports) { return complaint([&] { shade(over_each_other(std::move(viewports))); }); };
    EXPECT_NE(why({{}, {}}).find("/outputs/0/viewports/1: overlaps viewport 0 of this output"), std::string::npos);
    EXPECT_NE(why({{.alpha_mask = grey("a.png", 0.5)}, {}}).find("overlaps viewport 0"), std::string::npos);
    // A warp file may bring a mask, which the layout's reader can't know; a Bourke mesh brings none.
    const Warp warp{.file = right_half()};
    EXPECT_NE(why({{.warp = warp}, {.warp = warp}}).find("overlaps viewport 0"), std::string::npos);
    const auto mask = grey("a.png", 0.5);
    EXPECT_NO_THROW(shade(over_each_other({{.warp = warp}, {.warp = warp, .order = -1}})));
    EXPECT_NO_THROW(shade(over_each_other({{.warp = warp, .alpha_mask = mask}, {.warp = warp, .alpha_mask = mask}})));
}

// An MPCDI file brings its masks: here black at the left and white at the right.
TEST(CompositionTest, MasksOfAWarpFileAreSharesToo)
{
    const Viewport calibrated{.projection_given = false, .warp = Warp{.file = write_text("a.mpcdi", warp_test::mpcdi_3d())}};
    const Shade s = shade(over_each_other({calibrated, calibrated}));
    ASSERT_EQ(s.layers, 2);
    for (std::size_t layer : {0, 1}) {
        expect_share(s, layer, 0, 2, 0, layer);
        expect_share(s, layer, 7, 2, 1, 0.5);
    }
    EXPECT_EQ(s.foremost[7], 1); // the later of equals
}

} // namespace composition_test
