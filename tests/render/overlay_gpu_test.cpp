// Overlays, found in the picture's pixels, and the probe's values, compared with the EXR's numbers. The tests' own boosts
// give a line's expected place from the pixels' directions.
#include "config/model/angles.h"
#include "runtime/exhibit/still_measurement.h"
#include "runtime/hud/lab_panel.h"
#include "runtime/world/detail.h"
#include "runtime/world/sky_names.h"
#include "runtime/world/stars.h"
#include "shaders/tone.h"
#include "tests/support/layouts.h"
#include "tests/support/quad.h"
#include "tests/support/small_world.h"
#include <map>
#include <random>
#include <set>

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
    const std::vector<Layout> layouts = {window({320, 240}), dome({320, 320}), two_eyes({320, 240})};
    for (const Layout& layout : layouts)
        for (const auto& [beta, angle_deg] : {std::pair(0.5, 74.45773), std::pair(0.8, 60.0), std::pair(0.99, 29.81806)}) {
            if (!testing::all_cases() && beta != 0.8 && &layout != &layouts.front())
                continue;
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

// The protractor's circles lie every 10 degrees from the motion and are orange at 90. Beside
// its scale, which leads from the motion through the crosshair, the picture is elsewhere that of the crosshair.
TEST(Overlay, TheProtractorMeasuresTheAngleFromTheMotion)
{
    const GpuWorld world = wall_world();
    OffscreenRenderer offscreen = renderer(world, dome({480, 480}));
    const Shot shot = shot_at({0, 0, 0}, {0.8, 0.2, -0.6}, {0.5, 0.1, -1});
    const Numbers numbers(offscreen, shot);
    const Pixels pixels = picture(offscreen, shot, Overlay::protractor), plain = picture(offscreen, shot, Overlay::aim);
    const dvec3 motion = normalize(shot.u), look = shot.ship_from_cockpit * dvec3(0, 0, -1),
                pole = normalize(cross(motion, look));
    std::array<int, 2> on{}; // circles, of them at 90 degrees
    int drawn = 0, orange = 0, wrong = 0;
    for (int i = 0; i < numbers.count(); ++i) {
        const int x = i % pixels.size.x;
        if (x == 0 || x + 1 == pixels.size.x || !numbers.shown(i) || !numbers.shown(i + 1)
            || !free_of_aim(shot, numbers.camera(i)))
            continue;
        const dvec3 n = numbers.camera(i);
        const double pixel = between(n, numbers.camera(i + 1)) / degree, angle = between(n, motion) / degree;
        const double circle = std::abs(angle - 10 * std::round(angle / 10)) / pixel;
        const double across = std::abs(std::asin(dot(n, pole))) / degree;
        const bool differs = length(pixels.colour(i) - plain.colour(i)) > 0.05;
        if (across > 2 && circle < 0.3) {
            ++on[0], drawn += differs;
            if (std::round(angle / 10) == 9)
                ++on[1], orange += pixels.colour(i).r > pixels.colour(i).b + 0.3;
        } else if (across > 2 && circle > 4) {
            wrong += differs;
        }
    }
    EXPECT_GT(on[0], 300);
    EXPECT_EQ(drawn, on[0]);
    EXPECT_GT(on[1], 30);
    EXPECT_EQ(orange, on[1]);
    EXPECT_EQ(wrong, 0);
    const Shot resting = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
    EXPECT_EQ(picture(offscreen, resting, Overlay::protractor).rgba, picture(offscreen, resting, Overlay::aim).rgba);
}

/// The scale along a great circle has a tick at every whole degree from `first` on, and none between: seen at the side of
/// its line, which is wider than the crosshair's alone.
void expect_ticks(const Numbers& numbers, const Shot& shot, const Pixels& ruled, const Pixels& plain, const dvec3& first,
    const dvec3& second)
{
    const dvec3 pole = normalize(cross(first, second));
    std::array<int, 2> whole{}, half{}; // pixels at whole degrees and at half ones, and of them those that are drawn
    for (int i = 0; i + 1 < numbers.count(); ++i) {
        const dvec3 n = numbers.camera(i);
        const double along = std::atan2(dot(cross(first, n), pole), dot(first, n)) / degree;
        const double across = std::abs(std::asin(dot(n, pole))) / degree;
        constexpr double sign_deg = 2; // around a mark its sign is drawn in both pictures
        if (i % ruled.size.x + 1 == ruled.size.x || along < sign_deg || across < 0.15 || across > 0.28
            || !free_of_aim(shot, n))
            continue;
        const double pixel = between(n, numbers.camera(i + 1)) / degree, off = std::abs(along - std::round(along));
        const bool differs = length(ruled.colour(i) - plain.colour(i)) > 0.05;
        if (off < 0.3 * pixel)
            ++whole[0], whole[1] += differs;
        else if (off > 6 * pixel)
            ++half[0], half[1] += differs;
    }
    EXPECT_GT(whole[0], 10);
    EXPECT_EQ(whole[1], whole[0]);
    EXPECT_GT(half[0], 50);
    EXPECT_EQ(half[1], 0);
}

// Between two marks lies a ruler from the first one on. In flight a scale leads from the motion through the crosshair.
TEST(Overlay, RulerAndProtractorHaveATickEveryDegree)
{
    const GpuWorld world = wall_world();
    OffscreenRenderer offscreen = renderer(world, one_view(Planar{20}, {960, 720}));
    const Shot resting = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
    const auto direction
        = [](double right) { return normalize(dvec3(std::sin(right * degree), 0.05, -std::cos(right * degree))); };
    const auto marked = [&](Overlay overlay) {
        OverlayPass::Content over{overlay, {}, {}};
        over.marks = {Spot{.at = direction(-13), .sky = true}, Spot{.at = direction(14.6), .sky = true}};
        offscreen.frame().measure(Measuring{.over = over});
        Pixels pixels{offscreen.layout().outputs[0].size, offscreen.picture(resting)[0]};
        offscreen.frame().measure({});
        return pixels;
    };
    expect_ticks(Numbers(offscreen, resting), resting, marked(Overlay::protractor), marked(Overlay::aim), direction(-13),
        direction(14.6));
    const Shot flying = shot_at({0, 0, 0}, {0.6, 0, -1}, {0, 0, -1}); // the motion is 31 degrees to the right
    expect_ticks(Numbers(offscreen, flying), flying, picture(offscreen, flying, Overlay::protractor),
        picture(offscreen, flying, Overlay::aim), normalize(flying.u), dvec3(0, 0, -1));
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
    for (double gamma : {1.0, 1.1, 2.0, 20.0}) { // at 1.1 the cube map has the cockpit's axes
        Shot shot = shot_at({0.1, 0.3, -8}, {0, 0, -u_of_gamma(gamma)}, {0.2, 0, -1});
        shot.effects = {};
        const Numbers numbers(offscreen, shot);
        Measuring measuring;
        std::vector<int> at;
        for (int i = 50 * 320 + 17; i < 200 * 320; i += 433)
            at.push_back(i), measuring.probes.push_back({*offscreen.frame().views().direction(0, numbers.centre(i))});
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
            EXPECT_LT(between(exact.world, probed[k].ray.world), 1e-6 * (1 + exact.D));
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
        measuring.probes.push_back({dvec3(std::sin(a * degree), 0, -std::cos(a * degree))});
    offscreen.frame().measure(measuring);
    for (const Probed& probed : offscreen.probed(shot))
        EXPECT_NEAR(probed.distance / (8 / -probed.ray.world.z), 1, 2e-5);
}

/// Light in linear units of a pixel of an sRGB picture: IEC 61966-2-1.
dvec3 linear(const dvec3& encoded)
{
    dvec3 out;
    for (int c = 0; c < 3; ++c)
        out[c] = encoded[c] <= 0.04045 ? encoded[c] / 12.92 : std::pow((encoded[c] + 0.055) / 1.055, 2.4);
    return out;
}

/// How far a pixel's encoded colour is from that of a distance in front of the plain picture. A contour darkens or lightens
/// the colour by up to four fifths.
double off_colour(const dvec3& seen, const dvec3& plain, double distance_s, const OverlayScale& scale)
{
    const auto encoded = [](const dvec3& light) { return dvec3(srgb(light.r), srgb(light.g), srgb(light.b)); };
    if (std::isinf(distance_s))
        return glm::length(encoded(0.65 * linear(plain)) - seen);
    const double part = std::log(distance_s / scale.nearest_s) / std::log(scale.farthest_s / scale.nearest_s);
    const dvec3 colour = tone_double::scale_colour(part), base = 0.72 * colour + 0.28 * linear(plain);
    const dvec3 contour = glm::dot(colour, dvec3(0.2, 0.7, 0.1)) > 0.25 ? dvec3(0) : dvec3(1);
    double least = 9;
    for (int ink = 0; ink <= 40; ++ink)
        least = std::min(least, glm::length(encoded(glm::mix(base, contour, 0.02 * ink)) - seen));
    return least;
}

/// A layout with small outputs whose screens have no colours, blends or masks of their own.
Layout bare_layout(const std::filesystem::path& file, int side)
{
    Layout layout = starbow::testing::small_layout(file, side);
    layout.blend = {};
    for (Output& output : layout.outputs) {
        output.colour = {};
        for (Viewport& viewport : output.viewports)
            viewport.alpha_mask.clear(), viewport.black_level.clear();
    }
    return layout;
}

/// Compares an overlay's colours at random pixels of each output with what the probe of the same frame reads there.
void expect_colours_of_probes(const GpuWorld& world, const Layout& layout, const Shot& shot, Overlay overlay, int count)
{
    Quality quality = default_quality(device(), testing::all_cases());
    quality.image_cost_texels = 64; // a plan of many images, as large pictures have
    OffscreenRenderer offscreen(device(), pipelines(), world, layout, quality, true);
    std::mt19937 random(7);
    for (std::size_t output = 0; output < layout.outputs.size(); ++output) {
        if (layout.outputs[output].preview || canvas_count(layout.outputs[output].packing) > 1)
            continue; // a preview is the same view again; of two pictures in one, no pixel is one view's
        const ivec2 size = layout.outputs[output].size;
        Measuring measuring;
        std::vector<std::size_t> at;
        for (int k = 0; k < count; ++k) {
            const ivec2 pixel(random() % unsigned(size.x), random() % unsigned(size.y));
            const dvec2 centre = dvec2(pixel) + 0.5;
            const auto direction = offscreen.frame().views().direction(output, centre);
            // The crosshair covers 14 pixels around the look.
            if (!direction || between(*direction, {0, 0, -1}) < 20 * degree)
                continue;
            at.push_back(std::size_t(pixel.y * size.x + pixel.x));
            measuring.probes.push_back({*direction, offscreen.frame().views().view_at(output, centre)});
        }
        ASSERT_GT(at.size(), std::size_t(count / 8));
        const double seconds = world.scene.seconds_per_time_unit();
        const OverlayScale scale = overlay_scale(world.world, shot.position, seconds);
        measuring.over = {Overlay::off, {}, scale};
        offscreen.frame().measure(measuring);
        const auto plain = offscreen.picture(shot)[output];
        measuring.over.overlay = overlay;
        offscreen.frame().measure(measuring);
        const auto seen = offscreen.picture(shot)[output];
        const std::vector<Probed> probed = offscreen.frame().probed();
        ASSERT_EQ(probed.size(), at.size());
        int off = 0, surfaces = 0;
        for (std::size_t k = 0; k < at.size(); ++k) {
            const auto colour
                = [&](const auto& rgba) { return dvec3(rgba[4 * at[k]], rgba[4 * at[k] + 1], rgba[4 * at[k] + 2]) / 255.0; };
            surfaces += std::isfinite(probed[k].distance);
            off += off_colour(colour(seen), colour(plain), probed[k].distance * seconds, scale) > 0.03; // bytes round twice
        }
        // A probe is as wide as the view's finest pixel, so that edges may fall to another surface.
        std::printf("  %s: %d of %zu off, %d surfaces\n", layout.outputs[output].name.c_str(), off, at.size(), surfaces);
        EXPECT_LE(off, int(at.size()) / 20) << layout.file << ", " << layout.outputs[output].name;
    }
}

std::map<std::string, std::vector<std::filesystem::path>> shots_by_scene()
{
    std::map<std::string, std::vector<std::filesystem::path>> all;
    for (const auto& file : testing::shipped("config/shots"))
        all[load_shot(file).scene].push_back(file);
    return all;
}

// Without light delay a pixel shows the world's time at the ship's present, later ahead: the contours of time lie there.
TEST(Overlay, WithoutLightDelayContoursAreTheWorldsTimesAtTheShipsPresent)
{
    const ivec2 size(240, 180);
    OffscreenRenderer offscreen = renderer(avenue().world, one_view(Planar{60}, size), true);
    Shot shot = load_shot(testing::source_dir() / "config/shots/avenue-gamma4.json");
    shot.u *= 0.2;
    shot.effects.comparison = Comparison::no_light_delay;
    const Numbers numbers(offscreen, shot);
    const double seconds = avenue().world.scene.seconds_per_time_unit();
    std::vector<double> later(std::size_t(numbers.count()));
    for (int i = 0; i < numbers.count(); ++i)
        later[std::size_t(i)] = seconds * (shot.time + numbers.depth(i) * glm::dot(shot.u, numbers.camera(i)));
    const auto footprint = [&](std::size_t i) {
        return std::abs(later[i + 1] - later[i]) + std::abs(later[i + std::size_t(size.x)] - later[i]);
    };
    std::vector<double> all;
    for (std::size_t i = 0; i + std::size_t(size.x) < later.size(); ++i)
        if (std::isfinite(footprint(i)))
            all.push_back(footprint(i));
    ASSERT_GT(all.size(), 1000u);
    std::sort(all.begin(), all.end());
    const double step = 20 * all[all.size() / 2];
    Measuring measuring;
    measuring.over = {Overlay::emission, {}, {seconds, 1000 * seconds, step}};
    offscreen.frame().measure(measuring);
    const auto seen = offscreen.picture(shot)[0];
    double on = 0, off = 0;
    int ons = 0, offs = 0;
    for (int y = 1; y + 1 < size.y; ++y)
        for (int x = 1; x + 1 < size.x; ++x) {
            const auto i = std::size_t(y * size.x + x);
            const double wide = footprint(i);
            if (!std::isfinite(wide) || wide > step / 12)
                continue; // the sky, edges, and contours too close together to be drawn
            const double beside = std::abs(later[i] - step * std::round(later[i] / step)) / wide;
            const double bright = seen[4 * i] + seen[4 * i + 1] + seen[4 * i + 2];
            if (beside < 0.4)
                on += bright, ++ons;
            else if (beside > 4)
                off += bright, ++offs;
        }
    ASSERT_GT(ons, 50);
    ASSERT_GT(offs, 50);
    std::printf("  %d pixels on contours: %.0f bright, %d off them: %.0f\n", ons, on / ons, offs, off / offs);
    EXPECT_LT(on / ons, 0.6 * off / offs);
}

// An overlay asks which surface a pixel shows, and so does the probe.
TEST(Overlay, ItsColoursAreWhatTheProbeReadsInEveryLayout)
{
    const WithoutStars no_stars;
    const Shot shot = load_shot(testing::source_dir() / "config/shots/avenue-gamma4.json");
    // In short a window, a dome, walls beside each other, two observers and a headset's lenses.
    const std::set<std::string> some = {"desk", "dome", "wall3", "alice-bob", "headset"};
    Overlay overlay = Overlay::distance;
    for (const auto& file : testing::shipped("config/layouts")) {
        if (!testing::all_cases() && !some.contains(file.stem()))
            continue;
        SCOPED_TRACE(file.stem().string());
        expect_colours_of_probes(avenue().world, bare_layout(file, testing::all_cases() ? 400 : 120), shot, overlay,
            testing::all_cases() ? 1000 : 100);
        overlay = overlay == Overlay::distance ? Overlay::emission : Overlay::distance;
    }
}

TEST(Overlay, ItsColoursAreWhatTheProbeReadsInEveryShot)
{
    const Layout layout = bare_layout(testing::source_dir() / "config/layouts/desk.json", testing::all_cases() ? 640 : 160);
    for (const auto& [name, files] : shots_by_scene()) {
        if (!testing::all_cases() && name != "clocks" && name != "gamow")
            continue;
        const SceneFile scene = load_scene_file(testing::source_dir() / "config/scenes" / (name + ".json"));
        World world = load_world(scene);
        add_detail_levels(world);
        const GpuWorld gpu = upload(device(), pipelines(), std::move(world), scene, {}, SpectralLevel::colours);
        const std::size_t count = testing::all_cases() ? files.size() : 1;
        for (const auto& file : std::vector(files.begin(), files.begin() + std::ptrdiff_t(count)))
            for (Overlay overlay : {Overlay::distance, Overlay::emission}) {
                if (overlay == Overlay::emission && !testing::all_cases())
                    continue;
                SCOPED_TRACE(file.stem().string());
                Shot shot = load_shot(file);
                shot.effects.on.set(Effect::doppler, false),
                    shot.effects.on.set(Effect::headlight, false); // bright pixels would hide nothing and cost digits
                expect_colours_of_probes(gpu, layout, shot, overlay, testing::all_cases() ? 1000 : 100);
            }
    }
}

// In a viewport of somebody else's, a point is read as that observer sees it: at rest nothing is shifted.
TEST(Overlay, APointIsReadByItsViewsOwnObserver)
{
    Layout layout = load_layout(testing::source_dir() / "config/layouts/alice-bob.json");
    layout.outputs[0].size = {320, 140};
    OffscreenRenderer offscreen = renderer(avenue().world, layout);
    Shot shot = shot_at({0, 0.3, -8}, {0, 0, -u_of_gamma(2)}, {0, 0, -1});
    const Numbers numbers(offscreen, shot);
    for (const dvec2& point : {dvec2(60, 70), dvec2(250, 70)}) {
        const StillMeasurement measured
            = measure_still(offscreen, avenue().world, shot, {Point(point)}, "off", "none", testing::words());
        const int i = int(point.y) * 320 + int(point.x);
        const SpotReading& reading = measured.points.at(1).aim;
        // The point is the corner of a pixel of half a degree.
        EXPECT_NEAR(reading.ray.D / numbers.D(i), 1, 0.02);
        EXPECT_LT(between(reading.ray.world, numbers.world(i)), 3 * degree);
        EXPECT_EQ(point.x < 160, std::abs(reading.ray.D - 1) < 1e-12);
        offscreen.frame().measure({});
    }
    // The ring of D = 1 is drawn for who moves alone.
    const Pixels ring = picture(offscreen, shot, Overlay::ring), aim = picture(offscreen, shot, Overlay::aim);
    int left = 0, right = 0;
    for (int i = 0; i < 320 * 140; ++i)
        (i % 320 < 160 ? left : right) += glm::length(ring.colour(i) - aim.colour(i)) > 0.02;
    EXPECT_EQ(left, 0);
    EXPECT_GT(right, 100);
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

/// A sky with so few and so faint stars that none is seen, and a square that hides a part of it.
GpuWorld constellations_world()
{
    Doc doc;
    quad(doc, {2, 1, -8}, {3, 0, 0}, {0, 3, 0}, unlit(doc, {0.2, 0.2, 0.2}));
    const auto folder = testing::source_dir() / "scenes/stars";
    return open_world("constellations", doc,
        {{"stars",
            {{"catalogue", absolute(folder / "stars.txt").string()}, {"brightness_arcmin2", 1e-6},
                {"ahead_deg", {84, -5}}}}});
}

// By all lines tried one by one, in the world's directions that the picture itself writes.
TEST(Overlay, ConstellationsAreLinesFromStarToStarBehindEverything)
{
    const GpuWorld world = constellations_world();
    const glm::dmat3 turn = world_from_equatorial({84, -5});
    std::vector<std::pair<dvec3, dvec3>> lines;
    for (const Constellation& one : world.sky_names.constellations)
        for (const auto& line : one.lines)
            for (std::size_t i = 0; i + 1 < line.size(); ++i)
                lines.emplace_back(turn * line[i], turn * line[i + 1]);
    const auto from_lines = [&](const dvec3& n, double& from_end) {
        double least = 9;
        for (const auto& [a, b] : lines) {
            const dvec3 axis = glm::normalize(glm::cross(a, b));
            if (glm::dot(glm::cross(axis, a), n) < 0 || glm::dot(glm::cross(b, axis), n) < 0)
                continue;
            const double off = std::asin(std::abs(glm::dot(axis, n)));
            if (off < least)
                least = off, from_end = std::min(between(n, a), between(n, b));
        }
        return least;
    };
    for (const Layout& layout : {window({400, 300}), dome({400, 400})})
        for (const double u : {0.0, 1.5}) {
            OffscreenRenderer offscreen = renderer(world, layout);
            const Shot shot = shot_at({0, 0, 0}, {0, 0, -u});
            const Numbers numbers(offscreen, shot);
            const std::vector<std::uint8_t> bare = offscreen.picture(shot)[0];
            offscreen.frame().measure(Measuring{.over = {.figures = true}});
            const std::vector<std::uint8_t> with = offscreen.picture(shot)[0];
            int on = 0, drawn_on = 0, drawn = 0, drawn_off = 0, hidden = 0;
            for (int i = 0; i < numbers.count(); ++i) {
                const int x = i % numbers.size.x;
                if (!numbers.shown(i) || x + 1 == numbers.size.x || !numbers.shown(i + 1))
                    continue;
                const int step = int(with[4 * i + 2]) - int(bare[4 * i + 2]);
                const double footprint = between(numbers.camera(i), numbers.camera(i + 1)) * numbers.D(i);
                double from_end = 0;
                const double off = from_lines(numbers.world(i), from_end) / footprint;
                const auto is_sky = [&](int k) { return !std::isfinite(numbers.depth(k)) || numbers.depth(k) > 1e6; };
                const bool sky = is_sky(i);
                // At the square's edge a pixel's nearest texel may be either's.
                const int row = numbers.size.x, below = std::min(i + row, numbers.count() - 1), above = std::max(i - row, 0);
                const bool within
                    = !sky && !is_sky(std::max(i - 1, 0)) && !is_sky(i + 1) && !is_sky(below) && !is_sky(above);
                drawn += step > 20, drawn_off += step > 20 && off > 2.5;
                hidden += !sky && off < 0.3;
                EXPECT_FALSE(within && step != 0) << "before what hides the sky";
                if (sky && off < 0.3 && from_end > std::max(1.2 * degree, 5 * footprint))
                    ++on, drawn_on += step > 60;
            }
            EXPECT_GT(on, 100);
            EXPECT_GT(drawn_on, 0.97 * on) << u;
            EXPECT_GT(drawn, 300);
            EXPECT_EQ(drawn_off, 0) << u;
            if (u == 0) {
                EXPECT_GT(hidden, 5) << "the square hides some";
            }
            offscreen.frame().measure({});
            EXPECT_EQ(offscreen.picture(shot)[0], bare);
        }
}

} // namespace
} // namespace starbow::gpu_test::overlay_gpu_test
