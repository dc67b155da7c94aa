// Masks, black levels, and the light that they leave for the picture, calculated by hand for each pixel.
#include "displays/finish/shade.h"
#include "tests/support/warp_fixture.h"

namespace shade_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

using glm::ivec2;
using glm::vec3;
using warp_test::png;

std::filesystem::path picture(
    const std::string& name, int width, int height, int channels, std::vector<unsigned char> values)
{
    return write_text(name, png(width, height, channels, values));
}

Layout one(ivec2 size)
{
    Layout layout;
    layout.outputs.resize(1);
    layout.outputs[0].size = size;
    layout.outputs[0].viewports = {{.projection = Planar{60}}};
    return layout;
}

Shade shade(const Layout& layout, const std::vector<std::vector<float>>& ramps = {})
{
    MapStore store{std::filesystem::path()};
    return shade_of(layout, 0, layout.outputs[0].size, compile_output(store, layout, 0, layout.outputs[0].size), ramps);
}

/// The rounding of float and of powf.
constexpr float rounding = 1e-6f;

void expect_near(const vec3& a, const vec3& b, const std::string& where = "")
{
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(a[k], b[k], rounding) << where << " channel " << k;
}

} // namespace

TEST(ShadeTest, WithoutMasksShadesAreEmpty)
{
    EXPECT_TRUE(shade(one({8, 6})).empty());
    EXPECT_EQ(headroom({}), 1);
    const Shade none[1];
    EXPECT_EQ(headroom(none), 1);
}

TEST(ShadeTest, GreyMaskMultipliesLinearLight)
{
    Layout layout = one({3, 2});
    layout.outputs[0].viewports[0].alpha_mask = picture("grey.png", 3, 2, 1, {0, 51, 102, 153, 204, 255});
    for (double gamma : {1.0, 2.2}) {
        layout.outputs[0].viewports[0].mask_gamma = gamma;
        const Shade s = shade(layout);
        ASSERT_EQ(s.weight.size(), 6u);
        EXPECT_TRUE(s.black.empty());
        for (int i = 0; i < 6; ++i)
            expect_near(s.weight[i], vec3(std::pow(i / 5.0, gamma)), std::to_string(i));
    }
}

TEST(ShadeTest, ColouredMaskAndBlackLevelKeepTheirChannelsAndRows)
{
    Layout layout = one({2, 2});
    layout.outputs[0].viewports[0].alpha_mask = picture("rgb.png", 2, 2, 3, {255, 0, 0, 0, 255, 0, 0, 0, 255, 51, 102, 204});
    layout.outputs[0].viewports[0].black_level
        = picture("black.png", 2, 2, 4, {51, 0, 0, 9, 0, 51, 0, 9, 0, 0, 51, 9, 0, 0, 0, 9});
    const Shade s = shade(layout);
    const vec3 weights[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.2f, 0.4f, 0.8f}};
    const vec3 blacks[] = {{0.2f, 0, 0}, {0, 0.2f, 0}, {0, 0, 0.2f}, {0, 0, 0}};
    for (int i = 0; i < 4; ++i) {
        expect_near(s.weight[i], weights[i]);
        expect_near(s.black[i], blacks[i]);
    }
    const Shade all[] = {Shade(), s};
    EXPECT_NEAR(headroom(all), 0.8, rounding);
}

// A mask of another size covers the same viewport: linear between the centres of its pixels, constant beyond them.
TEST(ShadeTest, MasksAreScaledToTheirViewport)
{
    Layout layout = one({8, 1});
    layout.outputs[0].viewports[0].alpha_mask = picture("two.png", 2, 1, 1, {0, 255});
    const Shade s = shade(layout);
    for (int x = 0; x < 8; ++x) {
        const double place = (x + 0.5) / 8; // the mask's centres are at 1/4 and 3/4
        expect_near(s.weight[x], vec3(std::clamp((place - 0.25) / 0.5, 0.0, 1.0)), std::to_string(x));
    }
}

TEST(ShadeTest, MasksAreScaledInBothDirections)
{
    Layout layout = one({4, 4});
    layout.outputs[0].viewports[0].alpha_mask = picture("four.png", 2, 2, 1, {0, 51, 102, 255});
    const Shade s = shade(layout);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            const double i = std::clamp(((x + 0.5) / 4 - 0.25) / 0.5, 0.0, 1.0);
            const double j = std::clamp(((y + 0.5) / 4 - 0.25) / 0.5, 0.0, 1.0);
            const double value = (1 - j) * 0.2 * i + j * (0.4 * (1 - i) + i);
            expect_near(s.weight[std::size_t(4 * y + x)], vec3(value), std::to_string(x) + " " + std::to_string(y));
        }
}

TEST(ShadeTest, EachViewportHasItsOwnMaskAndBlackLevel)
{
    Layout layout = one({4, 1});
    const auto half = picture("half.png", 1, 1, 1, {51}), dim = picture("dim.png", 1, 1, 1, {102});
    layout.outputs[0].viewports = {{.rect = {0, 0, 0.5, 1}, .projection = Planar{60}, .alpha_mask = half},
        {.rect = {0.5, 0, 0.25, 1}, .projection = Planar{60}, .black_level = dim}};
    const Shade s = shade(layout);
    const float weights[] = {0.2f, 0.2f, 1, 1}, blacks[] = {0, 0, 0.4f, 0};
    for (int x = 0; x < 4; ++x) {
        expect_near(s.weight[x], vec3(weights[x]));
        expect_near(s.black[x], vec3(blacks[x]));
    }
}

TEST(ShadeTest, RampMaskAndCalibrationMultiply)
{
    // A mesh that shows its whole picture, with brightness from 0.5 on the left to 1 on the right.
    const auto mesh = write_text("shade.data", "2\n2 2\n-1 -1 0 0 0.5\n1 -1 1 0 1\n-1 1 0 1 0.5\n1 1 1 1 1\n");
    Layout layout = one({4, 4});
    layout.outputs[0].viewports[0].warp = Warp{mesh};
    layout.outputs[0].viewports[0].alpha_mask = picture("fifth.png", 1, 1, 1, {51});
    const std::vector<std::vector<float>> ramps = {std::vector<float>(16, 0.25f)};
    const Shade s = shade(layout, ramps);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            expect_near(s.weight[4 * y + x], vec3((0.5 + 0.5 * (x + 0.5) / 4) * 0.2 * 0.25), std::to_string(x));
}

TEST(ShadeTest, EyesThatShareAPixelShareItsMask)
{
    Layout layout = one({2, 2});
    layout.outputs[0].packing = Packing::rows;
    layout.outputs[0].viewports[0].alpha_mask = picture("shared.png", 1, 1, 1, {51});
    for (const vec3& w : shade(layout).weight)
        expect_near(w, vec3(0.2f)); // applied once, not for each eye
}

// Even under the brightest black level the picture keeps a tenth of the light.
TEST(ShadeTest, HeadroomIsAtLeastATenth)
{
    Shade bright;
    bright.black.assign(4, vec3(0, 1, 0));
    const Shade all[] = {bright};
    EXPECT_NEAR(headroom(all), 0.1, rounding);
}

TEST(ShadeTest, WrongPicturesAreNamed)
{
    Layout layout = one({2, 2});
    layout.outputs[0].viewports[0].alpha_mask = write_text("none.png", "no picture");
    EXPECT_NE(complaint([&] { shade(layout); }).find("none.png"), std::string::npos);
    layout.outputs[0].viewports[0].alpha_mask = scratch("missing.png");
    EXPECT_NE(complaint([&] { shade(layout); }).find("missing.png"), std::string::npos);
    std::string torn = png(64, 64, 1, std::vector<unsigned char>(64 * 64, 7));
    layout.outputs[0].viewports[0].alpha_mask = write_text("torn.png", torn.substr(0, 60));
    EXPECT_NE(complaint([&] { shade(layout); }).find("torn.png"), std::string::npos);
}

} // namespace shade_test
