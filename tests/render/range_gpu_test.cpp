// Everything visible at once: the pictures follow from the numbers by the reported curve, in all outputs and both eyes. The
// curve and the tone curve are written here once more.
#include "config/model/angles.h"
#include "config/model/shipped.h"
#include "runtime/light/range_curve.h"
#include "tests/support/small_world.h"

namespace starbow::gpu_test::range_gpu_test {
namespace {

using Picture = std::vector<std::uint8_t>;

double luminance(const dvec3& c) { return glm::dot(c, {0.2126, 0.7152, 0.0722}); }

Shot flown(const Shot& start, double gamma)
{
    Shot shot = start;
    shot.u = shot.ship_from_cockpit * dvec3(0, 0, -u_of_gamma(gamma));
    return shot;
}

Layout shipped_layout(const std::string& name, int longest)
{
    Layout layout = load_layout(shipped_file("layouts", name));
    int most = 0;
    for (const Output& output : layout.outputs)
        most = std::max({most, output.size.x, output.size.y});
    for (Output& output : layout.outputs)
        output.size = glm::max(output.size * longest / most / 4 * 4, 16);
    return layout;
}

/// A picture by the curve of this shot.
std::vector<Picture> ranged(OffscreenRenderer& offscreen, Shot shot, RangeCurve* used = nullptr)
{
    const std::optional<RangeCurve> curve = offscreen.ranged(shot);
    EXPECT_TRUE(curve);
    if (used)
        *used = *curve;
    offscreen.frame().range(curve);
    shot.exposure_ev = 0;
    std::vector<Picture> pictures = offscreen.picture(shot);
    offscreen.frame().range({});
    return pictures;
}

/// The shown luminance, 0 to 1: by the knots, and above tone.glsl's knee by its shoulder for greys.
double shown_luminance(const RangeCurve& curve, double scene)
{
    const double at = std::log2(scene) - RANGE_FIRST;
    const std::size_t k = std::size_t(at);
    const double y = std::exp2(curve.shown[k] + (at - double(k)) * (curve.shown[k + 1] - curve.shown[k]));
    const double above = std::max(y - 0.76, 0.0);
    return std::min(y, 0.76) + 0.24 * above / (above + 0.24);
}

struct Agreement {
    int pixels = 0, off = 0; ///< off: by more than 2 of 255 in a channel
};

/// Compares a picture with what its numbers say. Only pixels without blending count: neighbours whose light is nearly the
/// same, as numbers have one ray, and pixels below the shoulder.
Agreement compared(const Numbers& numbers, const Picture& picture, const RangeCurve& curve)
{
    Agreement result;
    const int wide = numbers.size.x;
    for (int i = 0; i < numbers.count(); ++i) {
        const int x = i % wide, y = i / wide;
        if (x == 0 || y == 0 || x == wide - 1 || y == numbers.size.y - 1 || !numbers.shown(i))
            continue;
        const dvec3 light = glm::max(numbers.light(i), dvec3(0));
        const double own = luminance(light);
        bool even = own > 1e-36;
        for (const int j : {i - 1, i + 1, i - wide, i + wide})
            even = even && numbers.shown(j) && std::abs(luminance(glm::max(numbers.light(j), dvec3(0))) / own - 1) < 0.15;
        if (!even)
            continue;
        const dvec3 shown = light * (shown_luminance(curve, own) / own);
        if (std::max({shown.r, shown.g, shown.b}) > 0.75)
            continue;
        ++result.pixels;
        bool off = false;
        for (int k = 0; k < 3; ++k)
            off = off || std::abs(picture[std::size_t(4 * i + k)] - 255 * srgb(shown[k])) > 2.5; // dither's half step
        result.off += off;
    }
    return result;
}

class RangeOn : public ::testing::TestWithParam<const char*> { };

// One curve for the whole rig: the picture of each output and each eye follows from it. The avenue's stars have spots that
// numbers and pictures show differently.
TEST_P(RangeOn, EveryPictureFollowsFromItsNumbersByOneCurve)
{
    const WithoutStars without;
    const Layout layout = shipped_layout(GetParam(), 320);
    OffscreenRenderer offscreen = renderer(avenue().world, layout);
    for (double gamma : {1.0, 2.0, 10.0}) {
        const Shot shot = flown(avenue().world.scene.start, gamma);
        RangeCurve curve;
        const std::vector<Picture> pictures = ranged(offscreen, shot, &curve);
        for (std::size_t output = 0; output < layout.outputs.size(); ++output) {
            const Output& of = layout.outputs[output];
            if (of.preview || (of.packing != Packing::mono && of.packing != Packing::side_by_side) || !of.colour.lut.empty())
                continue;
            const Agreement found = compared(Numbers(offscreen, shot, output), pictures[output], curve);
            std::printf("  gamma %g, %s: %d pixels, %d off\n", gamma, of.name.c_str(), found.pixels, found.off);
            EXPECT_LE(found.off, found.pixels / 100) << of.name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Layouts, RangeOn, ::testing::Values("desk", "wall3", "stereo", "cave5", "mirror"));

std::string dome_scene(const std::string& name)
{
    return name == "voyage" ? (testing::source_dir() / "scenes/voyage/voyage.json").string()
                            : shipped_file("scenes", name).string();
}

/// The part of the lit solid angle of a fisheye picture that shows: 5 of 255 or more in a channel, three steps above what
/// dither makes of black, and what a dark-adapted eye sees beside a projector's black.
double seen_part(const Numbers& numbers, const Picture& picture)
{
    double lit = 0, seen = 0;
    for (int i = 0; i < numbers.count(); ++i) {
        if (!numbers.shown(i) || !(luminance(numbers.light(i)) > 0))
            continue;
        // A fisheye's pixels shrink outwards by sin(a) / a.
        const double a = between(numbers.camera(i), numbers.camera(numbers.count() / 2 + numbers.size.x / 2));
        const double solid = a > 0 ? std::sin(a) / a : 1;
        lit += solid;
        const std::uint8_t* p = &picture[std::size_t(4 * i)];
        seen += std::max({p[0], p[1], p[2]}) >= 5 ? solid : 0;
    }
    return seen / lit;
}

class DomeIn : public ::testing::TestWithParam<const char*> { };

// The promise: on a dome at gamma 4 to 100 at least 80 % of what has any light shows. With one exposure, metered as an
// eye's, it is less than a third.
TEST_P(DomeIn, FourFifthsOfWhatHasLightShows)
{
    const SceneFile scene = load_scene_file(dome_scene(GetParam()));
    const GpuWorld world = upload(device(), pipelines(), load_world(scene), scene, {});
    OffscreenRenderer offscreen = renderer(world, one_view(Fisheye{180, 30}, {256, 256}));
    for (double gamma : {4.0, 10.0, 30.0, 100.0}) {
        Shot shot = flown(scene.start, gamma);
        shot.effects = {};
        shot.exposure_ev = *offscreen.metered(shot);
        const Numbers numbers(offscreen, shot);
        const double eye = seen_part(numbers, offscreen.picture(shot).front());
        RangeCurve curve;
        const double range = seen_part(numbers, ranged(offscreen, shot, &curve).front());
        std::printf("  %s, gamma %g: %.1f %% with an eye's exposure, %.1f %% by the curve, %.0f stops in %.1f\n", GetParam(),
            gamma, 100 * eye, 100 * range, curve.stops(), curve.shown_stops());
        EXPECT_GE(range, 0.8) << gamma;
        EXPECT_LT(eye, 0.5) << gamma;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, DomeIn, ::testing::Values("avenue", "voyage"));

// Brighter stays brighter, for any two pixels: the shown luminances, sorted by the scene's, never fall by more than dither's
// and rounding's steps. The stars' spots are apart: a pixel of one has less than the curve gives its light.
TEST(RangePicture, KeepsTheOrderOfAllPixels)
{
    const WithoutStars without;
    OffscreenRenderer offscreen = renderer(avenue().world, one_view(Fisheye{180, 30}, {256, 256}));
    for (double gamma : {1.2, 4.0, 100.0}) {
        const Shot shot = flown(avenue().world.scene.start, gamma);
        const Numbers numbers(offscreen, shot);
        const Picture picture = ranged(offscreen, shot).front();
        std::vector<std::pair<double, double>> pixels; // luminance, shown in bytes of a grey
        for (int i = 0; i < numbers.count(); ++i) {
            const double own = numbers.shown(i) ? luminance(glm::max(numbers.light(i), dvec3(0))) : 0;
            if (own < 1e-36)
                continue;
            dvec3 shown;
            for (int k = 0; k < 3; ++k) {
                const double byte = picture[std::size_t(4 * i + k)] / 255.0;
                shown[k] = byte <= 0.04045 ? byte / 12.92 : std::pow((byte + 0.055) / 1.055, 2.4);
            }
            pixels.emplace_back(std::log2(own), 255 * srgb(luminance(shown)));
        }
        std::sort(pixels.begin(), pixels.end());
        double most = 0;
        long wrong = 0, all = 0;
        for (const auto& [log, shown] : pixels) {
            wrong += shown < most - 4, ++all; // steps of 1 or more in saturated colours' channels; two pixels' worth
            most = std::max(most, std::min(shown, most + 1)); // one bad pixel alone must not count for all
        }
        std::printf("  gamma %g: %ld of %ld pixels are darker than a pixel of less light\n", gamma, wrong, all);
        EXPECT_LE(wrong, all / 200) << gamma; // where numbers and picture have other edges
    }
}

// The curve is for the shown picture alone.
TEST(RangePicture, NumbersStayTheScenesLight)
{
    OffscreenRenderer offscreen = renderer(avenue().world, one_view(Fisheye{180, 30}, {96, 96}));
    const Shot shot = flown(avenue().world.scene.start, 4);
    const Numbers before(offscreen, shot);
    const Picture as_eye = offscreen.picture(shot).front();
    offscreen.frame().range(offscreen.ranged(shot));
    const Numbers by_curve(offscreen, shot);
    const std::optional<double> ev = offscreen.metered(shot);
    offscreen.frame().range({});
    EXPECT_EQ(ev, offscreen.metered(shot));
    for (int i = 0; i < before.count(); ++i)
        if (before.shown(i)) {
            ASSERT_EQ(before.light(i), by_curve.light(i)) << i;
            ASSERT_EQ(before.depth(i), by_curve.depth(i)) << i;
        }
    EXPECT_EQ(offscreen.picture(shot).front(), as_eye); // and back
}

// The visitor's change moves the shown light, and nothing else.
TEST(RangePicture, AChangeOfTheExposureMovesTheWholeCurve)
{
    const WithoutStars without;
    OffscreenRenderer offscreen = renderer(avenue().world, one_view(Fisheye{180, 30}, {256, 256}));
    Shot shot = flown(avenue().world.scene.start, 2);
    const Numbers numbers(offscreen, shot);
    RangeCurve curve = *offscreen.ranged(shot);
    offscreen.frame().range(curve);
    shot.exposure_ev = -1.5;
    const Picture darker = offscreen.picture(shot).front();
    for (double& shown : curve.shown)
        shown -= 1.5;
    const Agreement found = compared(numbers, darker, curve);
    EXPECT_GT(found.pixels, 5000);
    EXPECT_LE(found.off, found.pixels / 100);
}

// Glow spreads the shown light: a share of nearly nothing changes nearly nothing, and any share keeps numbers.
TEST(RangePicture, GlowSpreadsTheShownLight)
{
    OffscreenRenderer offscreen = renderer(avenue().world, one_view(Planar{60}, {160, 120}));
    const Shot shot = flown(avenue().world.scene.start, 4);
    const auto mean = [](const Picture& picture) {
        double sum = 0;
        for (std::size_t i = 0; i < picture.size(); ++i)
            sum += i % 4 < 3 ? picture[i] : 0;
        return sum / (0.75 * double(picture.size()));
    };
    const Picture without = ranged(offscreen, shot).front();
    offscreen.frame().bloom(1e-4, 0);
    const Picture least = ranged(offscreen, shot).front();
    offscreen.frame().bloom(0.3, 0);
    const Picture strong = ranged(offscreen, shot).front();
    int off = 0;
    for (std::size_t i = 0; i < without.size(); ++i)
        off += std::abs(without[i] - least[i]) > 2;
    EXPECT_LE(off, int(without.size() / 200));
    EXPECT_NEAR(mean(strong), mean(without), 0.25 * mean(without));
    EXPECT_NE(strong, without);
}

// A star goes through the curve as a whole, so that its spot is as narrow as with an exposure, and stays in order with
// others. A crowd of stars is no brighter than the curve shows their light.
TEST(RangePicture, StarsKeepTheirSpotsAndCrowdsTheirOrder)
{
    OffscreenRenderer offscreen = renderer(avenue().world, one_view(Planar{60}, {640, 480}));
    for (double gamma : {1.0, 4.0, 100.0}) {
        const Shot shot = flown(avenue().world.scene.start, gamma);
        const Numbers numbers(offscreen, shot);
        RangeCurve curve;
        const Picture picture = ranged(offscreen, shot, &curve).front();
        int spots = 0, wide = 0;
        long over = 0;
        const int across = numbers.size.x;
        const auto shown = [&](int i) {
            dvec3 light;
            for (int k = 0; k < 3; ++k) {
                const double byte = picture[std::size_t(4 * i + k)] / 255.0;
                light[k] = byte <= 0.04045 ? byte / 12.92 : std::pow((byte + 0.055) / 1.055, 2.4);
            }
            return luminance(light);
        };
        for (int i = 0; i < numbers.count(); ++i) {
            const int x = i % across, y = i / across;
            const double own = luminance(glm::max(numbers.light(i), dvec3(0)));
            if (own > 1e-36)
                over += shown(i) > 1.15 * shown_luminance(curve, own) + 0.004;
            if (x < 4 || y < 4 || x >= across - 4 || y >= numbers.size.y - 4)
                continue;
            // A bright spot alone: the greatest of its surroundings, eight stops above what lies three pixels off.
            const double around = std::max({luminance(numbers.light(i - 3)), luminance(numbers.light(i + 3)),
                luminance(numbers.light(i - 3 * across)), luminance(numbers.light(i + 3 * across))});
            bool top = own > 32 * around && around > 0;
            for (const int j :
                {i - 1, i + 1, i - across, i + across, i - across - 1, i - across + 1, i + across - 1, i + across + 1})
                top = top && luminance(numbers.light(j)) < own;
            if (!top || shown(i) < 0.03)
                continue;
            ++spots;
            const double sides = (shown(i - 2) + shown(i + 2) + shown(i - 2 * across) + shown(i + 2 * across)) / 4;
            wide += sides > 0.4 * shown(i);
        }
        std::printf("  gamma %g: %d spots, %d of them wide; %ld pixels above the curve\n", gamma, spots, wide, over);
        if (gamma < 100) { // there, what stands out is no star
            EXPECT_LE(wide, spots / 5);
        }
        EXPECT_LE(over, numbers.count() / 200);
        if (gamma == 1) {
            EXPECT_GT(spots, 20);
        }
    }
}

// In steady flight the curve does not pump: what changes is what passes by.
TEST(RangePicture, AFlightOfConstantVelocityIsSteady)
{
    OffscreenRenderer offscreen = renderer(avenue().world, one_view(Fisheye{180, 30}, {96, 96}), false);
    constexpr int per_s = 10;
    FrameRenderer& frame = offscreen.frame();
    for (double gamma : starbow::testing::all_cases() ? std::vector{1.1547, 4.0} : std::vector{1.1547}) {
        Shot shot = flown(avenue().world.scene.start, gamma);
        shot.exposure_ev = 0;
        const double beta = std::sqrt(1 - 1 / (gamma * gamma));
        RangeMode mode;
        mode.wanted = offscreen.ranged(shot);
        frame.meter(true);
        std::vector<double> means;
        std::optional<RangeCurve> second_ago;
        double most_stops = 0;
        for (int i = 0; i < 10 * per_s; ++i) { // ten seconds
            std::vector<double> goal;
            if (i > 0 && wants_goal(mode, 1.0 / per_s))
                goal = range_goal(frame.surface_samples(), frame.star_samples(), 0);
            mode = advance(std::move(mode), goal, 1.0 / per_s, false);
            frame.range(mode.follower.shown);
            const Picture picture = offscreen.picture(shot).front();
            double sum = 0;
            for (std::size_t k = 0; k < picture.size(); ++k)
                sum += k % 4 < 3 ? picture[k] : 0;
            means.push_back(sum / (0.75 * double(picture.size())));
            shot.position.z -= beta / per_s; // a scene unit of light in a second
            shot.time += 1.0 / per_s;
            if (i % per_s == 0) {
                const RangeCurve& now = *mode.follower.shown;
                for (double at = now.low; second_ago && at < now.high; at += 0.5)
                    most_stops = std::max(most_stops, std::abs(now.at(at) - second_ago->at(at)));
                second_ago = now;
            }
        }
        double most = 0;
        for (std::size_t i = per_s; i < means.size(); ++i)
            most = std::max(most, std::abs(means[i] / means[i - per_s] - 1));
        std::printf(
            "  gamma %g: within a second the mean of the bytes changes by at most %.1f %%, the curve by %.2f stops\n", gamma,
            100 * most, most_stops);
        EXPECT_LT(most, 0.1);
        EXPECT_LT(most_stops, 0.4);
    }
    frame.range({});
    frame.meter(false);
}

} // namespace
} // namespace starbow::gpu_test::range_gpu_test
