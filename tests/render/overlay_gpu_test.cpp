// What is laid over the picture, found in its pixels, and what the probe reads, beside the EXR's numbers. Where a line
// should be is worked out from where pixels look, by the tests' own boosts.
#include "config/model/angles.h"
#include "runtime/exhibit/still_measurement.h"
#include "runtime/hud/lab_panel.h"
#include "tests/support/quad.h"
#include "tests/support/small_world.h"

namespace starbow::gpu_test {
namespace {

/// A grey sky, and a wall that faces the origin from 8 units.
GpuWorld wall_world()
{
    Doc doc;
    quad(doc, {0, 0, -8}, {30, 0, 0}, {0, 30, 0}, unlit(doc, {0.2, 0.2, 0.2}));
    const Json grey = {{"zenith", {0.2, 0.2, 0.2}}, {"horizon", {0.2, 0.2, 0.2}}, {"nadir", {0.2, 0.2, 0.2}}};
    return open_world("wall", doc, {{"sky", grey}, {"light_speed_m_s", 1}});
}

struct Pixels {
    ivec2 size;
    std::vector<std::uint8_t> rgba;
    /// Rises with how much lighter than grey a pixel is in all channels.
    double white(int i) const { return std::min({rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]}) / 255.0; }
    dvec3 colour(int i) const { return dvec3(rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]) / 255.0; }
};

Pixels picture(OffscreenRenderer& stage, const Shot& shot, Overlay overlay, const OverlayScale& scale = {})
{
    stage.frame().measure(Measuring{.over = {overlay, {}, scale}});
    Pixels pixels{stage.layout().outputs[0].size, stage.picture(shot)[0]};
    stage.frame().measure({});
    return pixels;
}

Layout dome(ivec2 size) { return one_view(Fisheye{180, 30}, size); }
Layout window(ivec2 size) { return one_view(Planar{70}, size); }
Layout two_eyes(ivec2 size)
{
    Layout layout = one_view(Planar{70}, size);
    layout.outputs[0].packing = Packing::anaglyph_red_cyan;
    return layout;
}

/// Whether it is not drawn over: the crosshair takes 14 pixels around the look, some degrees of these coarse views.
bool free_of_aim(const Shot& shot, const dvec3& n)
{
    return between(n, shot.ship_from_cockpit * dvec3(0, 0, -1)) > 7 * degree;
}

TEST(Overlay, TheRingIsWhereNothingIsShiftedAndAsWideEverywhere)
{
    const GpuWorld world = wall_world();
    for (const Layout& layout : {window({320, 240}), dome({320, 320}), two_eyes({320, 240})})
        for (const auto& [beta, angle_deg] : {std::pair(0.5, 74.45773), std::pair(0.8, 60.0), std::pair(0.99, 29.81806)}) {
            OffscreenRenderer stage = renderer(world, layout);
            const Shot shot = shot_at({0, 0, 0}, {0.8 * u_of_beta(beta), 0, -0.6 * u_of_beta(beta)}, {0.5, 0.1, -1});
            const Numbers numbers(stage, shot);
            const Pixels pixels = picture(stage, shot, Overlay::ring);
            double on = 0;
            int off_line = 0, on_line = 0;
            for (int i = 0; i < numbers.count(); ++i) {
                if (!numbers.shown(i) || !free_of_aim(shot, numbers.camera(i)))
                    continue;
                const int x = i % pixels.size.x;
                if (x == 0 || x + 1 == pixels.size.x || !numbers.shown(i + 1))
                    continue;
                // In pixels: how far a neighbour looks away.
                const double pixel = between(numbers.camera(i), numbers.camera(i + 1));
                const double off = std::abs(between(numbers.camera(i), shot.u) - angle_deg * degree) / pixel;
                if (off < 0.3) {
                    on += pixels.white(i);
                    ++on_line;
                } else if (off > 4 && pixels.white(i) > 0.8) {
                    ++off_line;
                }
            }
            EXPECT_EQ(off_line, 0) << beta;
            if (on_line > 20) { // the ring is in this view
                EXPECT_GT(on / on_line, 0.9) << beta;
            }
            if (beta == 0.8) {
                EXPECT_GT(on_line, 20);
            }
        }
}

TEST(Overlay, AtRestThereIsNoRing)
{
    const GpuWorld world = wall_world();
    OffscreenRenderer stage = renderer(world, window({160, 120}));
    const Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
    EXPECT_EQ(picture(stage, shot, Overlay::ring).rgba, picture(stage, shot, Overlay::aim).rgba);
}

// Orange is the horizon alone, wherever a world direction lies level.
TEST(Overlay, TheGridIsTheWorlds)
{
    const GpuWorld world = wall_world();
    for (const Layout& layout : {window({320, 240}), dome({320, 320})})
        for (double gamma : {1.0, 4.0}) {
            OffscreenRenderer stage = renderer(world, layout);
            const Shot shot
                = shot_at({0, 0, 0}, {0, 0.3 * u_of_gamma(gamma), -std::sqrt(0.91) * u_of_gamma(gamma)}, {0.1, 0.2, -1});
            const Numbers numbers(stage, shot);
            const Pixels pixels = picture(stage, shot, Overlay::grid);
            int level = 0, orange_level = 0, orange_elsewhere = 0;
            for (int i = 0; i + 1 < numbers.count(); ++i) {
                if (!numbers.shown(i) || !numbers.shown(i + 1) || i % pixels.size.x + 1 == pixels.size.x
                    || !free_of_aim(shot, numbers.camera(i)))
                    continue;
                const double pixel = between(numbers.camera(i), numbers.camera(i + 1));
                const quad::Light in_world = quad::camera_from_world(quad::of(numbers.camera(i)), quad::of(-shot.u));
                const double off = std::abs(double(asinq(in_world.n.y))) / (numbers.D(i) * pixel);
                const dvec3 c = pixels.colour(i);
                const bool orange = c.r > 0.85 && c.b < 0.65 && c.r > c.g + 0.12;
                if (off < 0.6)
                    ++level, orange_level += orange;
                else if (off > 4)
                    orange_elsewhere += orange;
            }
            EXPECT_GT(level, 50) << gamma;
            EXPECT_GT(orange_level, 0.85 * level); // the main meridians cross it
            EXPECT_EQ(orange_elsewhere, 0);
        }
}

// On the wall, distance is 8 over the cosine: 10 lies 36.87 degrees aside, a heavy contour, 9 at 27.27, a finer one.
TEST(Overlay, ContoursLieAtTheirDistances)
{
    const GpuWorld world = wall_world();
    OffscreenRenderer stage = renderer(world, window({640, 480}));
    const Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
    const Pixels pixels = picture(stage, shot, Overlay::distance, {1, 100, 1});
    const double per_tangent = 240 / std::tan(35 * degree);
    const auto darkness_at = [&](double distance) { // of the middle row, both sides; the extreme against what is beside it
        const double aside = std::tan(std::acos(8 / distance)) * per_tangent;
        double contrast = 0;
        for (const double x : {320 + aside, 320 - aside}) {
            const int row = 240 * 640;
            double least = 9, most = 0;
            for (int i = int(x) - 1; i <= int(x) + 1; ++i) {
                const dvec3 here = pixels.colour(row + i), beside = pixels.colour(row + int(x) - 5);
                least = std::min(least, here.g - beside.g), most = std::max(most, here.g - beside.g);
            }
            contrast += 0.5 * std::max(most, -least);
        }
        return contrast;
    };
    EXPECT_GT(darkness_at(10), 0.3);
    EXPECT_GT(darkness_at(9), 0.05);
    EXPECT_GT(darkness_at(9.5), 0.05);
    EXPECT_LT(darkness_at(9.23), 0.03);
    EXPECT_LT(darkness_at(10.4), 0.03);
}

// The probe's pixel is the picture's: beside the EXR's numbers in the same direction.
TEST(Overlay, TheProbeReadsThePicture)
{
    RenderContext& context = avenue();
    const WithoutStars no_stars;
    OffscreenRenderer stage = renderer(context.world, window({320, 240}));
    for (double gamma : {1.0, 2.0, 20.0}) {
        Shot shot = shot_at({0.1, 0.3, -8}, {0, 0, -u_of_gamma(gamma)}, {0.2, 0, -1});
        shot.effects = {true, true, true};
        const Numbers numbers(stage, shot);
        Measuring what;
        std::vector<int> at;
        for (int i = 50 * 320 + 17; i < 200 * 320; i += 433)
            at.push_back(i), what.probes.push_back(*stage.frame().views().direction(0, numbers.centre(i)));
        stage.frame().measure(what);
        const std::vector<Probed> probed = stage.probed(shot);
        ASSERT_EQ(probed.size(), at.size());
        int surfaces = 0;
        for (std::size_t k = 0; k < at.size(); ++k) {
            EXPECT_LT(between(probed[k].ray.ship, numbers.camera(at[k])), 1e-6);
            EXPECT_LT(between(probed[k].ray.world, numbers.world(at[k])), 1e-6 * (1 + numbers.D(at[k])));
            EXPECT_NEAR(probed[k].ray.D / numbers.D(at[k]), 1, 1e-5);
            const Ray exact = ray_from_ship(stage.frame().observer(), probed[k].ray.ship);
            EXPECT_NEAR(exact.D / probed[k].ray.D, 1, 1e-5);
            // Between texels and at their middle: half a texel of a slanting surface. At an edge they may be of either side.
            const double depth = numbers.depth(at[k]);
            bool edge = !std::isfinite(depth);
            for (int beside : {-320, -1, 1, 320})
                edge = edge || !(std::abs(numbers.depth(at[k] + beside) / depth - 1) < 0.05);
            if (!edge && std::isfinite(probed[k].distance)) {
                ++surfaces;
                EXPECT_NEAR(probed[k].distance / numbers.depth(at[k]), 1, 0.05);
            }
        }
        EXPECT_GT(surfaces, 3) << gamma;
        stage.frame().measure({});
    }
}

// On a slanting plane distances between texels are exact: to the float's accuracy and to where in a texel its sample lies.
TEST(Overlay, DistancesOnPlanesAreExact)
{
    const GpuWorld world = wall_world();
    OffscreenRenderer stage(device(), pipelines(), world, window({160, 120}), default_quality(device(), false), false);
    const Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
    Measuring what;
    for (double a = 3; a < 34; a += 3.1)
        what.probes.push_back({std::sin(a * degree), 0, -std::cos(a * degree)});
    stage.frame().measure(what);
    for (const Probed& probed : stage.probed(shot))
        EXPECT_NEAR(probed.distance / (8 / -probed.ray.world.z), 1, 2e-5);
}

// Nobody measures: nothing is drawn, and where only numbers are read the picture stays as it is to the byte.
TEST(Overlay, WhatIsOffDrawsNothing)
{
    const GpuWorld world = wall_world();
    OffscreenRenderer stage = renderer(world, window({160, 120}));
    const Shot shot = shot_at({0, 0, 0}, {0, 0, -1}, {0, 0, -1});
    const auto plain = stage.picture(shot)[0];
    EXPECT_EQ(picture(stage, shot, Overlay::off).rgba, plain);
    EXPECT_NE(picture(stage, shot, Overlay::aim).rgba, plain);
    EXPECT_EQ(stage.picture(shot)[0], plain);
}

} // namespace
} // namespace starbow::gpu_test
