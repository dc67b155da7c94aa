// The last step of an output, from light to the bytes that its screen gets. Every pixel is computed again in double from the
// light that the same pixel has in the numbers.
#include "tests/support/small_world.h"
#include <functional>
#include <stb/stb_image_write.h>

namespace starbow::gpu_test::finish_gpu_test {
namespace {

/// From nearly black to nearly the tone curve's knee in every channel, so that no two hues are alike.
const Json wide_sky = {{"zenith", {0.70, 0.01, 0.20}}, {"horizon", {0.02, 0.60, 0.002}}, {"nadir", {0.003, 0.10, 0.70}}};

class Finish : public ::testing::Test {
protected:
    static void SetUpTestSuite()
    {
        Doc doc;
        quad(doc, {0, 0, 900}, {0.01, 0, 0}, {0, 0.01, 0}, unlit(doc, {1, 1, 1})); // far behind, small, and turned away
        world = std::make_unique<GpuWorld>(open_world("wide_sky", doc, {{"sky", wide_sky}}));
    }
    static void TearDownTestSuite()
    {
        device().device.waitIdle();
        world.reset();
    }

public:
    static inline std::unique_ptr<GpuWorld> world;
};

Layout all_round(ivec2 size = {96, 48}) { return one_view(Equirectangular{}, size); }

Shot at_rest(double exposure_ev = 0)
{
    Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
    shot.exposure_ev = exposure_ev;
    return shot;
}

/// The light of each pixel without any colour conversion, mask or blend.
std::vector<dvec3> light_of(Layout layout, std::size_t output = 0)
{
    for (Output& out : layout.outputs) {
        out.colour = {};
        for (Viewport& viewport : out.viewports)
            viewport.alpha_mask.clear(), viewport.black_level.clear();
    }
    layout.blend = {};
    OffscreenRenderer offscreen = renderer(*Finish::world, layout);
    const Numbers numbers(offscreen, at_rest(), output);
    std::vector<dvec3> light;
    for (int i = 0; i < numbers.count(); ++i)
        light.push_back(numbers.shown(i) ? numbers.light(i) : dvec3(0));
    return light;
}

std::filesystem::path picture(
    const std::string& name, ivec2 size, int channels, const std::function<double(int, int, int)>& value)
{
    std::vector<std::uint8_t> bytes;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            for (int k = 0; k < channels; ++k)
                bytes.push_back(std::uint8_t(std::lround(255 * value(x, y, k))));
    const auto file = testing::scratch(name);
    stbi_write_png(file.c_str(), size.x, size.y, channels, bytes.data(), size.x * channels);
    return file;
}

/// A value as the 8-bit file holds it.
double byte(double value) { return std::lround(255 * value) / 255.0; }

/// Compares every pixel of an output with expected(light, x, y), the screen's input from 0 to 1.
void expect_pixels(const Layout& layout, const std::function<dvec3(dvec3, int, int)>& expected, std::size_t output = 0,
    double exposure_ev = 0)
{
    OffscreenRenderer offscreen = renderer(*Finish::world, layout, false);
    const auto bytes = offscreen.picture(at_rest(exposure_ev)).at(output);
    const std::vector<dvec3> light = light_of(layout, output);
    const ivec2 size = layout.outputs[output].size;
    double worst = 0, least = 1, most = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const std::size_t i = std::size_t(y) * size.x + x;
            const dvec3 right = expected(light[i] * std::exp2(exposure_ev), x, y);
            ASSERT_EQ(bytes[4 * i + 3], 255);
            for (int k = 0; k < 3; ++k) {
                worst = std::max(worst, std::abs(bytes[4 * i + k] - 255 * right[k]));
                least = std::min(least, right[k]), most = std::max(most, right[k]);
            }
        }
    // Rounding adds half a byte, dither another half. fp16 keeps light and weights to 2^-11 of themselves. A gamma's inverse
    // reduces that; a matrix or a table multiplies it by up to four: 255 * 4 * 2^-11. The device's sRGB table adds a little.
    EXPECT_LE(worst, 1.55);
    EXPECT_GT(most - least, 0.3); // otherwise the picture is too even for a test
}

dvec3 each(const dvec3& v, const std::function<double(double)>& of) { return {of(v.r), of(v.g), of(v.b)}; }
dvec3 within(const dvec3& v) { return glm::clamp(v, 0.0, 1.0); }
dvec3 encoded(const dvec3& v) { return each(within(v), srgb); }

// ---------------------------------------------------------------- colour

TEST_F(Finish, TheSkyFollowsItsFormula)
{
    // The other tests of this file rely on this.
    OffscreenRenderer offscreen = renderer(*Finish::world, all_round());
    const Numbers numbers(offscreen, at_rest());
    for (int i = 0; i < numbers.count(); ++i)
        EXPECT_LT(glm::length(numbers.light(i) - sky_colour(numbers.camera(i), wide_sky)), 0.01);
    expect_pixels(all_round(), [](dvec3 light, int, int) { return encoded(light); });
}

TEST_F(Finish, GammaEncodesTheLight)
{
    for (double gamma : {1.0, 1.8, 2.2, 2.6}) {
        SCOPED_TRACE(gamma);
        Layout layout = all_round();
        layout.outputs[0].colour.gamma = gamma;
        expect_pixels(layout,
            [&](dvec3 light, int, int) { return each(within(light), [&](double v) { return std::pow(v, 1 / gamma); }); });
    }
}

TEST_F(Finish, TablesInterpolateLinearlyByChannel)
{
    Layout layout = all_round();
    for (const std::vector<dvec3>& lut : {std::vector<dvec3>{{0, 0.1, 1}, {1, 0.9, 0}},
             {{0, 0, 0}, {0.5, 0.3, 0.7}, {0.6, 0.95, 0.75}, {1, 1, 0.8}, {1, 0.5, 0.9}}}) {
        layout.outputs[0].colour.lut = lut;
        expect_pixels(layout, [&](dvec3 light, int, int) {
            dvec3 input;
            for (int k = 0; k < 3; ++k) {
                const double at = std::clamp(light[k], 0.0, 1.0) * double(lut.size() - 1);
                const std::size_t i = std::min(std::size_t(at), lut.size() - 2);
                input[k] = lut[i][k] * (1 - (at - double(i))) + lut[i + 1][k] * (at - double(i));
            }
            return input;
        });
    }
}

TEST_F(Finish, TablesKeepTheirLastEntryAboveWhite)
{
    // Four stops above white, the table's last entry holds.
    Layout layout = all_round({16, 8});
    layout.outputs[0].colour.lut = {{0.25, 0.25, 0.25}, {0.5, 0.5, 0.5}, {0.75, 0.75, 0.75}};
    OffscreenRenderer offscreen = renderer(*Finish::world, layout, false);
    const auto bright = offscreen.picture(at_rest(14)).front(), dark = offscreen.picture(at_rest(-60)).front();
    for (const std::uint8_t value : bright)
        EXPECT_TRUE(value == 255 || (value >= 190 && value <= 192))
            << int(value); // alpha; or 191.25 with dither, and the tone curve just below white
    for (const std::uint8_t value : dark)
        EXPECT_TRUE(value == 255 || value == 63 || value == 64) << int(value); // 63.75 and dither
}

// Rows make red, green and blue; values outside the screen's range are cut off.
TEST_F(Finish, AMatrixMultipliesTheLightByRows)
{
    Layout layout = all_round();
    const double rows[3][3] = {{0.8, 0.3, -0.1}, {-0.2, 1.1, 0.1}, {0.05, -0.15, 1.3}};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            layout.outputs[0].colour.matrix[j][i] = rows[i][j];
    auto through = [&](dvec3 light) {
        dvec3 out;
        for (int i = 0; i < 3; ++i)
            out[i] = rows[i][0] * light.r + rows[i][1] * light.g + rows[i][2] * light.b;
        return glm::max(out, dvec3(0));
    };
    expect_pixels(layout, [&](dvec3 light, int, int) { return encoded(through(light)); });
    layout.outputs[0].colour.gamma = 2.4; // after the matrix
    expect_pixels(layout,
        [&](dvec3 light, int, int) { return each(within(through(light)), [](double v) { return std::pow(v, 1 / 2.4); }); });
}

TEST_F(Finish, AMatrixInALayoutFileIsGivenByRows)
{
    const auto file = testing::write_text("matrix.json",
        R"({"outputs": [{"name": "a", "size": [96, 48], "colour": {"matrix": [[0, 1, 0], [0, 0, 1], [1, 0, 0]]},
            "viewports": [{"projection": {"type": "equirectangular"}}]}]})");
    expect_pixels(load_layout(file), [](dvec3 light, int, int) { return encoded({light.g, light.b, light.r}); });
}

// ---------------------------------------------------------------- masks and black level

TEST_F(Finish, MasksMultiplyLinearLight)
{
    Layout layout = all_round();
    const ivec2 size = layout.outputs[0].size;
    auto grey = [&](int x, int, int) { return double(x) / (size.x - 1); };
    auto rgb = [&](int x, int y, int k) {
        return k == 0 ? double(x) / (size.x - 1) : k == 1 ? double(y) / (size.y - 1) : 0.5;
    };
    for (double mask_gamma : {1.0, 2.2}) {
        layout.outputs[0].viewports[0].mask_gamma = mask_gamma;
        auto masked = [&](const auto& value, dvec3 light, int x, int y) {
            for (int k = 0; k < 3; ++k)
                light[k] *= std::pow(byte(value(x, y, k)), mask_gamma);
            return encoded(light);
        };
        layout.outputs[0].viewports[0].alpha_mask = picture("grey_mask.png", size, 1, grey);
        expect_pixels(layout, [&](dvec3 light, int x, int y) { return masked(grey, light, x, y); });
        layout.outputs[0].viewports[0].alpha_mask = picture("rgb_mask.png", size, 3, rgb);
        expect_pixels(layout, [&](dvec3 light, int x, int y) { return masked(rgb, light, x, y); });
    }
}

// The order is matrix, weight, black level, curve. The light is scaled to leave room for the highest black level of all
// outputs.
TEST_F(Finish, BlackLevelsAreAddedAndScaleAllOutputs)
{
    Layout layout = all_round();
    const ivec2 size = layout.outputs[0].size;
    layout.outputs.push_back(layout.outputs[0]);
    layout.outputs[1].name = "neighbour";
    auto lift = [&](int x, int, int k) { return k == 1 ? 0.2 * x / (size.x - 1) : 0.05; };
    auto weight = [&](int, int y, int) { return 1 - 0.5 * y / (size.y - 1); };
    layout.outputs[0].viewports[0].black_level = picture("lift.png", size, 3, lift);
    layout.outputs[0].viewports[0].alpha_mask = picture("weight.png", size, 1, weight);
    layout.outputs[0].colour.gamma = 2.2;
    const double room = 1 - byte(0.2);
    const auto finished = [&](dvec3 light, int x, int y) {
        for (int k = 0; k < 3; ++k)
            light[k] = std::pow(std::min(light[k] * room * byte(weight(x, y, k)) + byte(lift(x, y, k)), 1.0), 1 / 2.2);
        return light;
    };
    expect_pixels(layout, finished, 0);
    expect_pixels(
        layout, [&](dvec3 light, int, int) { return encoded(light * room); }, 1);

    // Without light the black level stays, because no weight multiplies it.
    OffscreenRenderer offscreen = renderer(*Finish::world, layout, false);
    const auto dark = offscreen.picture(at_rest(-60));
    for (int x = 0; x < size.x; ++x)
        EXPECT_NEAR(dark[0][4 * x + 1], 255 * std::pow(byte(lift(x, 0, 1)), 1 / 2.2), 1) << x;
    for (std::size_t i = 0; i < dark[1].size(); i += 4)
        EXPECT_EQ(dark[1][i], 0);
    // White light above the black level is exactly white.
    const auto bright = offscreen.picture(at_rest(14))[0];
    EXPECT_GE(bright[4 * (size.x - 1) + 1], 254);
}

TEST_F(Finish, AllOutputsHaveOneExposure)
{
    Layout layout = all_round();
    layout.outputs.push_back(one_view(Planar{60}, {64, 48}).outputs[0]);
    layout.outputs[1].colour.gamma = 2;
    layout.outputs.push_back(one_view(Planar{60, {}, {0, 80, 0}}, {64, 48}).outputs[0]);
    for (double ev : {-3.0, -1.0, 0.0}) {
        expect_pixels(
            layout, [](dvec3 light, int, int) { return encoded(light); }, 0, ev);
        OffscreenRenderer offscreen = renderer(*Finish::world, layout, false);
        const auto pictures = offscreen.picture(at_rest(ev));
        // Straight ahead is the horizon, which must have equal light in every output.
        const dvec3 horizon = sky_colour({0, 0, -1}, wide_sky) * std::exp2(ev);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(pictures[1][4 * (24 * 64 + 32) + k], 255 * std::sqrt(horizon[k]), 2) << ev;
        const dvec3 high = sky_colour({0, std::sin(glm::radians(80.0)), 0}, wide_sky) * std::exp2(ev);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(pictures[2][4 * (24 * 64 + 32) + k], 255 * srgb(high[k]), 2) << ev;
    }
}

// ---------------------------------------------------------------- blend

// Two walls overlap by half. In the row at eye height the ramp follows the distances to the two edges; both outputs' light
// adds up to that of one.
TEST_F(Finish, BlendedOutputsAddUpToOne)
{
    Layout layout;
    for (double left : {-1.5, -0.5}) {
        Layout one = one_view(Wall{{left, -0.9, -2}, {left + 2, -0.9, -2}, {left, 0.9, -2}}, {200, 180});
        one.outputs[0].name = left < -1 ? "left" : "right";
        one.outputs[0].colour.gamma = left < -1 ? 2.2 : 1.8;
        layout.outputs.push_back(one.outputs[0]);
    }
    const auto plain = light_of(layout, 0);
    layout.blend.ramps = true;
    for (double power : {1.0, 2.0}) {
        layout.blend.power = power;
        OffscreenRenderer offscreen = renderer(*Finish::world, layout, false);
        const auto pictures = offscreen.picture(at_rest());
        const int y = 89;
        double worst = 0;
        for (int x = 0; x < 200; ++x) {
            const double own = std::min(200 - (x + 0.5), 89.5), other = std::clamp(x + 0.5 - 100, 0.0, 89.5);
            const double weight = std::pow(own, power) / (std::pow(own, power) + std::pow(other, power));
            const std::size_t i = 4 * std::size_t(y * 200 + x);
            const dvec3 light = plain[i / 4];
            for (int k = 0; k < 3; ++k) {
                // Half a pixel is a hundredth of the ramp; where light is bright, bytes resolve less than that.
                const double expected = x < 100 ? light[k] : light[k] * weight;
                const double shown = std::pow(pictures[0][i + k] / 255.0, 2.2);
                EXPECT_NEAR(shown, expected, 0.01 * light[k] + 0.01) << x << " " << k;
                if (x < 100 || light[k] < 0.1)
                    continue;
                const double both = shown + std::pow(pictures[1][i + k - 400] / 255.0, 1.8);
                worst = std::max(worst, std::abs(both / light[k] - 1));
            }
        }
        // The bytes alone: each is off by half of 1/255, times gamma, for light above 0.1 (a byte of 90 or 71).
        EXPECT_LT(worst, 0.5 * (2.2 / 90 + 1.8 / 71));
        EXPECT_GT(worst, 0);
    }
}

// ---------------------------------------------------------------- preview

TEST_F(Finish, ThePreviewShowsEveryOutputSmallAndUnshaded)
{
    Layout layout;
    const Turn turns[] = {{0, 0, 0}, {0, 70, 0}, {0, -70, 0}};
    for (int i = 0; i < 3; ++i) {
        Layout one = one_view(Planar{30, {}, turns[i]}, i == 1 ? ivec2(100, 200) : ivec2(160, 120));
        one.outputs[0].name = std::string(1, char('a' + i));
        one.outputs[0].colour.gamma = 1.5;
        one.outputs[0].viewports[0].alpha_mask = picture("dim.png", {1, 1}, 1, [](int, int, int) { return 0.3; });
        layout.outputs.push_back(one.outputs[0]);
    }
    Output preview;
    preview.name = "preview";
    preview.size = {240, 200};
    preview.preview = true;
    layout.outputs.insert(layout.outputs.begin() + 1, preview);
    OffscreenRenderer offscreen = renderer(*Finish::world, layout, false);
    const auto bytes = offscreen.picture(at_rest()).at(1);
    const auto cells = preview_cells(layout, 1, preview.size);
    ASSERT_EQ(cells.size(), 4u);
    EXPECT_EQ(cells[1], glm::ivec4(0));
    std::vector<int> owner(240 * 200, -1);
    for (int i : {0, 2, 3}) {
        const glm::ivec4 cell = cells[i];
        const Output& shown = layout.outputs[i];
        EXPECT_GE(cell.z * cell.w, 1500) << "a cell must be large enough to see something";
        EXPECT_NEAR(double(cell.z) / cell.w, double(shown.size.x) / shown.size.y,
            0.03); // the cell's size rounds to a pixel of fifty
        for (int y = cell.y; y < cell.y + cell.w; ++y)
            for (int x = cell.x; x < cell.x + cell.z; ++x) {
                ASSERT_TRUE(x >= 0 && y >= 0 && x < 240 && y < 200);
                ASSERT_EQ(owner[y * 240 + x], -1) << "cells do not overlap";
                owner[y * 240 + x] = i;
                const double pitch = glm::radians(std::get<Planar>(shown.viewports[0].projection).turn.pitch_deg);
                const double half = std::tan(glm::radians(15.0)), scale = 2 * half / cell.w;
                const double right = (x + 0.5 - cell.x - 0.5 * cell.z) * scale,
                             up = -(y + 0.5 - cell.y - 0.5 * cell.w) * scale;
                const dvec3 d = glm::normalize(
                    dvec3(right, std::sin(pitch) + up * std::cos(pitch), -std::cos(pitch) + up * std::sin(pitch)));
                const dvec3 light = sky_colour(d, wide_sky);
                // A pixel of the preview is half a degree wide, and filtered over that; the sky's greatest slope is 1 for
                // each radian.
                for (int k = 0; k < 3; ++k)
                    ASSERT_NEAR(bytes[4 * (y * 240 + x) + k], 255 * srgb(light[k]), 4) << shown.name << " " << x << " " << y;
            }
    }
    for (int i = 0; i < 240 * 200; ++i)
        if (owner[i] < 0) {
            ASSERT_EQ(bytes[4 * i] + bytes[4 * i + 1] + bytes[4 * i + 2], 0) << "between the cells";
        }
}

} // namespace
} // namespace starbow::gpu_test::finish_gpu_test
