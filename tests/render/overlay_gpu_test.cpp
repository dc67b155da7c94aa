// Overlays, found in the picture's pixels, and the probe's values, compared with the EXR's numbers. The tests' own boosts
// give a line's expected place from the pixels' directions.
#include "config/model/angles.h"
#include "runtime/exhibit/still_measurement.h"
#include "runtime/hud/lab_panel.h"
#include "tests/support/quad.h"
#include "tests/support/small_world.h"

namespace starbow::gpu_test::overlay_gpu_test {
namespace {

/// A grey sky, and a wall 8 units in front of the origin.
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
    /// The darkest channel: white lines are far above the grey of the world.
    double white(int i) const { return std::min({rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]}) / 255.0; }
    dvec3 colour(int i) const { return dvec3(rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]) / 255.0; }
};

Pixels picture(OffscreenRenderer& offscreen, const Shot& shot, Overlay overlay, const OverlayScale& scale = {})
{
    offscreen.frame().measure(Measuring{.over = {overlay, {}, scale}});
    Pixels pixels{offscreen.layout().outputs[0].size, offscreen.picture(shot)[0]};
    offscreen.frame().measure({});
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

/// False near the crosshair, which covers 14 pixels around the look, some degrees of these coarse views.
bool free_of_aim(const Shot& shot, const dvec3& n)
{
    return between(n, shot.ship_from_cockpit * dvec3(0, 0, -1)) > 7 * degree;
}

TEST(Overlay, TheRingLiesWhereDIsOneAndIsEvenlyWide)
{
    const GpuWorld world = wall_world();
    for (const Layout& layout : {window({320, 240}), dome({320, 320}), two_eyes({320, 240})})
        for (const auto& [beta, angle_deg] : {std::pair(0.5, 74.45773), std::pair(0.8, 60.0), std::pair(0.99, 29.81806)}) {
            OffscreenRenderer offscreen = renderer(world, layout);
            const Shot shot = shot_at({0, 0, 0}, {0.8 * u_of_beta(beta), 0, -0.6 * u_of_beta(beta)}, {0.5, 0.1, -1});
            const Numbers numbers(offscreen, shot);
            const Pixels pixels = picture(offscreen, shot, Overlay::ring);
            double on = 0;
            int off_line = 0, on_line = 0;
            for (int i = 0; i < numbers.count(); ++i) {
                if (!numbers.shown(i) || !free_of_aim(shot, numbers.camera(i)))
                    continue;
                const int x = i % pixels.size.x;
                if (x == 0 || x + 1 == pixels.size.x || !numbers.shown(i + 1))
                    continue;
                // The distance to the ring in pixels; the neighbour's direction gives a pixel's size.
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
            if (on_line > 20) { // otherwise the ring is outside this view
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
    OffscreenRenderer offscreen = renderer(world, window({160, 120}));
    const Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
    EXPECT_EQ(picture(offscreen, shot, Overlay::ring).rgba, picture(offscreen, shot, Overlay::aim).rgba);
}

// Only the horizon is orange, in every direction that is level in the world.
TEST(Overlay, TheGridFollowsTheWorldsDirections)
{
    const GpuWorld world = wall_world();
    for (const Layout& layout : {window({320, 240}), dome({320, 320})})
        for (double gamma : {1.0, 4.0}) {
            OffscreenRenderer offscreen = renderer(world, layout);
            const Shot shot
                = shot_at({0, 0, 0}, {0, 0.3 * u_of_gamma(gamma), -std::sqrt(0.91) * u_of_gamma(gamma)}, {0.1, 0.2, -1});
            const Numbers numbers(offscreen, shot);
            const Pixels pixels = picture(offscreen, shot, Overlay::grid);
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

// The wall's distance is 8 over the cosine. 10 lies 36.87 degrees aside and has a heavy contour; 9 lies at 27.27 and has a
// finer one.
TEST(Overlay, ContoursLieAtTheirDistances)
{
    const GpuWorld world = wall_world();
    OffscreenRenderer offscreen = renderer(world, window({640, 480}));
    const Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
    const Pixels pixels = picture(offscreen, shot, Overlay::distance, {1, 100, 1});
    const double per_tangent = 240 / std::tan(35 * degree);
    const auto darkness_at
        = [&](double distance) { // the greatest contrast to the neighbouring pixels in the middle row, on both sides
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

// The probe must read the picture's own pixel: it is compared with the EXR's numbers in the same direction.
TEST(Overlay, TheProbeReadsThePicture)
{
    RenderContext& context = avenue();
    const WithoutStars no_stars;
    OffscreenRenderer offscreen = renderer(context.world, window({320, 240}));
    for (double gamma : {1.0, 2.0, 20.0}) {
        Shot shot = shot_at({0.1, 0.3, -8}, {0, 0, -u_of_gamma(gamma)}, {0.2, 0, -1});
        shot.effects = {true, true, true};
        const Numbers numbers(offscreen, shot);
        Measuring measuring;
        std::vector<int> at;
        for (int i = 50 * 320 + 17; i < 200 * 320; i += 433)
            at.push_back(i), measuring.probes.push_back(*offscreen.frame().views().direction(0, numbers.centre(i)));
        offscreen.frame().measure(measuring);
        const std::vector<Probed> probed = offscreen.probed(shot);
        ASSERT_EQ(probed.size(), at.size());
        int surfaces = 0;
        for (std::size_t k = 0; k < at.size(); ++k) {
            EXPECT_LT(between(probed[k].ray.ship, numbers.camera(at[k])), 1e-6);
            EXPECT_LT(between(probed[k].ray.world, numbers.world(at[k])), 1e-6 * (1 + numbers.D(at[k])));
            EXPECT_NEAR(probed[k].ray.D / numbers.D(at[k]), 1, 1e-5);
            const Ray exact = ray_from_ship(offscreen.frame().observer(), probed[k].ray.ship);
            EXPECT_NEAR(exact.D / probed[k].ray.D, 1, 1e-5);
            // The samples differ by up to half a texel of a slanting surface. At an edge they may belong to either side.
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
        offscreen.frame().measure({});
    }
}

// On a slanting plane the distance is exact to the float's accuracy, at any place between texels.
TEST(Overlay, DistancesOnPlanesAreExact)
{
    const GpuWorld world = wall_world();
    OffscreenRenderer offscreen(device(), pipelines(), world, window({160, 120}), default_quality(device(), false), false);
    const Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
    Measuring measuring;
    for (double a = 3; a < 34; a += 3.1)
        measuring.probes.push_back({std::sin(a * degree), 0, -std::cos(a * degree)});
    offscreen.frame().measure(measuring);
    for (const Probed& probed : offscreen.probed(shot))
        EXPECT_NEAR(probed.distance / (8 / -probed.ray.world.z), 1, 2e-5);
}

// Without a measurement nothing is drawn over the picture, to the byte.
TEST(Overlay, AnOverlayThatIsOffDrawsNothing)
{
    const GpuWorld world = wall_world();
    OffscreenRenderer offscreen = renderer(world, window({160, 120}));
    const Shot shot = shot_at({0, 0, 0}, {0, 0, -1}, {0, 0, -1});
    const auto plain = offscreen.picture(shot)[0];
    EXPECT_EQ(picture(offscreen, shot, Overlay::off).rgba, plain);
    EXPECT_NE(picture(offscreen, shot, Overlay::aim).rgba, plain);
    EXPECT_EQ(offscreen.picture(shot)[0], plain);
}

} // namespace
} // namespace starbow::gpu_test::overlay_gpu_test
