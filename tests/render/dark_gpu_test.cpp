// Pixels at which no light shows: left out of the picture, and nobody can tell; whatever reads light as numbers still gets
// it.
#include "config/model/angles.h"
#include "config/model/shipped.h"
#include "runtime/light/exposure.h"
#include "tests/support/small_world.h"
#include <algorithm>

namespace starbow::gpu_test::dark_gpu_test {
namespace {

Shot fast(double gamma, double exposure_ev = 0)
{
    Shot shot = shot_at({0, 0, -8}, {0, 0, -u_of_gamma(gamma)});
    shot.effects = {};
    shot.exposure_ev = exposure_ev;
    return shot;
}

/// Without a limit of texels, a lit pixel's density is the same whether others are dark or not.
Quality unlimited() { return within(device(), {.texels_per_pixel = 1, .max_texels_per_pixel = 1e6}); }

double texels(OffscreenRenderer& offscreen)
{
    double sum = 0;
    for (const CubeMapPlan& plan : offscreen.frame().plans())
        sum += plan.texels;
    return sum;
}

/// Compares a layout's pictures with those in which all light counts. True if nine tenths of them are black at a gamma
/// above 50.
bool expect_the_same_picture(const Layout& layout, const Shot& shot, double bloom, const std::string& name)
{
    OffscreenRenderer offscreen(device(), pipelines(), avenue().world, layout, unlimited(), false);
    offscreen.frame().bloom(bloom, 0);
    const auto pictures = offscreen.picture(shot);
    const double with = texels(offscreen);
    offscreen.frame().count_all_light(true);
    const auto all = offscreen.picture(shot);
    const double without = texels(offscreen);
    double dark = 0, shown = 0;
    for (std::size_t output = 0; output < all.size(); ++output) {
        long black = 0, lit_in_black = 0, differ = 0;
        double sum = 0;
        const std::size_t pixels = all[output].size() / 4;
        for (std::size_t i = 0; i < pixels; ++i) {
            int most = 0, now = 0, off = 0;
            for (std::size_t c = 4 * i; c < 4 * i + 3; ++c) {
                most = std::max<int>(most, all[output][c]), now = std::max<int>(now, pictures[output][c]);
                off = std::max(off, std::abs(all[output][c] - pictures[output][c]));
            }
            black += most == 0, lit_in_black += most == 0 && now > 1, differ += off > 8, sum += off;
        }
        dark += double(black), shown += double(pixels);
        std::printf("  %s: %.0f %% black, %.2f %% differ by more than 8, mean %.3f, %.2f of the texels\n", name.c_str(),
            100.0 * double(black) / double(pixels), 100.0 * double(differ) / double(pixels), sum / double(pixels),
            with / without);
        EXPECT_GT(black, 0.2 * double(pixels)) << name;
        // The planned images have other edges, so that texels on them have other mips.
        EXPECT_LE(lit_in_black, 2e-4 * double(pixels)) << name;
        EXPECT_LT(differ, 2e-4 * double(pixels)) << name;
        EXPECT_LT(sum / double(pixels), 0.01) << name;
    }
    // A face's image is the rectangle around its lit texels. Where light fills a tenth of the pixels, the rectangles have
    // room to shrink; a narrow field (34 degrees at gamma 100 are black in 38 % only) has light in every corner of its
    // image.
    EXPECT_LE(with, without) << name;
    const bool mostly_dark = dark > 0.9 * shown && glm::length(shot.u) > 50;
    if (mostly_dark) {
        EXPECT_LT(with, 0.72 * without) << name; // at most 0.71: a dome that is tilted by 30 degrees
    }
    return mostly_dark;
}

} // namespace

TEST(Dark, NobodySeesIt)
{
    const glm::ivec2 size(240, 180);
    Layout gamma_curve = one_view(Planar{60}, size);
    gamma_curve.outputs[0].colour.gamma = 2.2;
    for (double gamma : {20.0, 100.0}) {
        const std::string at = " at gamma " + std::to_string(int(gamma));
        expect_the_same_picture(one_view(Planar{60}, size), fast(gamma, -3), 0, "window" + at);
        expect_the_same_picture(one_view(Fisheye{180, 0}, {200, 200}), fast(gamma, -3), 0, "dome" + at);
        expect_the_same_picture(one_view(Equirectangular{}, {256, 128}), fast(gamma, -3), 0, "whole sky" + at);
        expect_the_same_picture(gamma_curve, fast(gamma, -3), 0, "gamma 2.2" + at);
        expect_the_same_picture(one_view(Planar{60}, size), fast(gamma, -3), 0.2, "with glow" + at);
    }
}

TEST(Dark, EveryShippedLayoutShowsTheSame)
{
    const auto files = testing::shipped("config/layouts");
    EXPECT_GE(files.size(), 15u);
    int mostly_dark = 0;
    for (const auto& file : files) {
        Layout layout = load_layout(file);
        for (Output& output : layout.outputs)
            output.size = glm::ivec2(glm::dvec2(output.size) * std::sqrt(40000.0 / (double(output.size.x) * output.size.y)));
        mostly_dark += expect_the_same_picture(layout, fast(100, -3), 0, file.stem().string());
    }
    EXPECT_GE(mostly_dark, 10) << "layouts whose images must shrink";
}

TEST(Dark, TheExposureIsMeteredAsBefore)
{
    for (const Projection& projection : {Projection(Planar{60}), Projection(Fisheye{180, 0})})
        for (double gamma : {1.0, 4.0, 20.0, 100.0})
            for (double ev : {-6.0, 0.0, 4.0}) {
                OffscreenRenderer offscreen(
                    device(), pipelines(), avenue().world, one_view(projection, {200, 200}), unlimited(), false);
                offscreen.frame().meter(true);
                offscreen.picture(fast(gamma, ev));
                const std::optional<double> own = offscreen.frame().metered();
                offscreen.frame().count_all_light(true);
                offscreen.picture(fast(gamma, ev));
                const std::optional<double> all = offscreen.frame().metered();
                ASSERT_EQ(own.has_value(), all.has_value());
                std::printf("  gamma %g at EV %g: %.3f, %.3f\n", gamma, ev, own.value_or(0), all.value_or(0));
                // A step of exposure that the eye sees is a tenth.
                EXPECT_NEAR(own.value_or(0), all.value_or(0), 0.1) << gamma << " at EV " << ev;
            }
}

TEST(Dark, NumbersHaveAllLight)
{
    OffscreenRenderer offscreen(device(), pipelines(), avenue().world, one_view(Planar{60}, {160, 120}), unlimited(), true);
    const Shot shot = fast(100);
    offscreen.frame().count_all_light(true);
    offscreen.picture(shot);
    const double all = texels(offscreen);
    offscreen.frame().count_all_light(false);
    offscreen.picture(shot);
    EXPECT_LT(texels(offscreen), 0.9 * all);
    const Numbers numbers(offscreen, shot);
    EXPECT_EQ(texels(offscreen), all);
    offscreen.metered(shot);
    EXPECT_EQ(texels(offscreen), all);
    offscreen.picture(shot);
    EXPECT_LT(texels(offscreen), 0.9 * all);
    // An overlay's lines follow surfaces also where these are dark.
    offscreen.frame().measure(Measuring{.over = {.overlay = Overlay::grid}});
    offscreen.picture(shot);
    EXPECT_EQ(texels(offscreen), all);
}

} // namespace starbow::gpu_test::dark_gpu_test
