// Brightness through the whole path: light as numbers and as pictures, its range, its mean over the sky, the meter, and the
// final conversion to bytes.
#include "config/model/angles.h"
#include "runtime/light/exposure.h"
#include "tests/support/effects.h"
#include "tests/support/small_world.h"

namespace starbow::gpu_test::exposure_gpu_test {
namespace {

Json even_sky(double r, double g, double b)
{
    return {{"sky", {{"zenith", {r, g, b}}, {"horizon", {r, g, b}}, {"nadir", {r, g, b}}}}};
}

/// A world whose pictures show only its sky: its one object is far behind, small, and turned away.
GpuWorld sky_alone(const std::string& name, const Json& scene)
{
    Doc doc;
    quad(doc, {0, 0, 900}, {0.01, 0, 0}, {0, 0.01, 0}, unlit(doc, {1, 1, 1}));
    return open_world(name, doc, scene);
}

Shot flown(double gamma, double exposure_ev = 0)
{
    Shot shot = shot_at({0, 0, 0}, u_of_gamma(gamma) * glm::normalize(dvec3(0.3, 0.5, -0.8)), {0, 0, -1});
    shot.effects = testing::effects_of(true, false, true);
    shot.exposure_ev = exposure_ev;
    return shot;
}

double luminance(const dvec3& c) { return glm::dot(c, {0.2126, 0.7152, 0.0722}); }

// ---------------------------------------------------------------- light close to a lamp

/// A white wall at z = -4, and a lamp of orange light before it, at rest. lamp_z: its place.
GpuWorld wall_and_lamp(double lamp_z, double strength)
{
    Doc doc;
    doc.json["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}}}};
    quad(doc, {0, 0, -4}, {3, 0, 0}, {0, 3, 0}, 0);
    const Json lamp = {{"type", "point"}, {"position", {0, 0, lamp_z}}, {"distance", 1},
        {"radiance", {strength, 0.5 * strength, 0.1 * strength}}};
    return open_world("lamp", doc, {{"lights", {lamp}}});
}

// Up to a thousand times white the numbers are the light of the inverse square.
TEST(BrightLight, OfALampCloseToAWallIsWhole)
{
    const GpuWorld world = wall_and_lamp(-3.7, 60);
    OffscreenRenderer live = renderer(world, one_view(Planar{.fov_y_deg = 50}, {240, 180}), true);
    for (const double ev : {0.0, -6.0}) {
        Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
        shot.exposure_ev = ev;
        const Numbers numbers(live, shot);
        double most = 0;
        for (int i = 0; i < numbers.count(); ++i) {
            const dvec3 place = numbers.world(i) * numbers.depth(i), to = dvec3(0, 0, -3.7) - place;
            const double square = glm::dot(to, to), right = 60 / square * to.z / std::sqrt(square);
            if (right < 0.5)
                continue;
            EXPECT_NEAR(numbers.light(i).r / right, 1, 0.01) << place.x << ' ' << place.y;
            EXPECT_NEAR(numbers.light(i).g / right, 0.5, 0.005) << place.x << ' ' << place.y;
            EXPECT_NEAR(numbers.light(i).b / right, 0.1, 0.001) << place.x << ' ' << place.y;
            most = std::max(most, right);
        }
        EXPECT_GT(most, 600);
    }
}

// Light above the greatest number that a cube map stores is scaled down in all channels alike.
TEST(BrightLight, KeepsItsColourHoweverBrightItIs)
{
    const GpuWorld world = wall_and_lamp(-3.99999, 1000);
    OffscreenRenderer live = renderer(world, one_view(Planar{.fov_y_deg = 2}, {64, 64}), true);
    Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
    shot.exposure_ev = -8;
    const Numbers numbers(live, shot);
    double most = 0;
    for (int i = 0; i < numbers.count(); ++i) {
        const dvec3 light = numbers.light(i);
        most = std::max(most, light.r);
        if (light.r > 1) {
            EXPECT_NEAR(light.g / light.r, 0.5, 0.005) << i;
            EXPECT_NEAR(light.b / light.r, 0.1, 0.001) << i;
        }
    }
    EXPECT_GT(most, 1000);
}

// ---------------------------------------------------------------- means of the sky's light

// Over the camera's whole sky the means of D^2, D^3 and D^4 are 1, gamma and gamma^2 (1 + beta^2 / 3). The pixels hold D^3;
// dividing and multiplying by their D gives the other two.
TEST(SphereMeans, DopplerPowersOfAnEvenSkyHaveTheirMeans)
{
    const GpuWorld world = sky_alone("even", even_sky(1, 1, 1));
    const ivec2 size = starbow::testing::all_cases() ? ivec2(768, 384) : ivec2(384, 192);
    OffscreenRenderer offscreen = renderer(world, one_view(Equirectangular{}, size));
    for (double gamma : {1.0, 2.0, 4.0, 10.0}) {
        const auto folder = testing::scratch("means");
        render_still(folder, offscreen, flown(gamma, -5), true); // the picture's exposure must not matter
        const auto [read_size, channels] = read_exr(folder / "view.exr");
        ASSERT_EQ(read_size, size);
        auto channel = [&](const std::string& name) {
            for (const auto& [own, values] : channels)
                if (own == name)
                    return values;
            throw std::runtime_error("no channel " + name);
        };
        const auto red = channel("R"), green = channel("G"), blue = channel("B"), D = channel("doppler");
        double all = 0, square = 0, cube = 0, fourth = 0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const std::size_t i = std::size_t(y) * size.x + x;
                const double share = std::cos(pi * ((y + 0.5) / size.y - 0.5)); // of the sphere's area
                ASSERT_EQ(red[i], green[i]);
                ASSERT_EQ(red[i], blue[i]);
                all += share, square += share * red[i] / D[i], cube += share * red[i], fourth += share * red[i] * D[i];
            }
        const double beta_square = 1 - 1 / (gamma * gamma);
        std::printf("  gamma %4g: D^2 %.6f D^3 %.5f D^4 %.4f\n", gamma, square / all, cube / all, fourth / all);
        // At gamma 10, half a degree is a tenth of the angle over which D changes. fp16 holds 1 exactly.
        EXPECT_NEAR(square / all, 1, 0.005);
        EXPECT_NEAR(cube / all, gamma, 0.005 * gamma);
        EXPECT_NEAR(fourth / all, gamma * gamma * (1 + beta_square / 3), 0.005 * fourth / all);
    }
}

// ---------------------------------------------------------------- range

/// The tone curve of shaders/tone.glsl for greys, then sRGB: a byte's expected value, 0 to 255.
double byte_of_grey(double light)
{
    const double knee = 0.76, above = std::max(light - knee, 0.0);
    return 255 * srgb(std::min(light, knee) + (1 - knee) * above / (above + 1 - knee));
}

/// Checks pictures and numbers from -30 to +30 EV, beside lamps `lamps` times as bright as the rest. The sky is grey, so
/// that the expected values follow from the sky and D alone.
void expect_in_range(double lamps, const std::vector<double>& gammas)
{
    Json scene = even_sky(0.4, 0.4, 0.4);
    scene["sky"]["zenith"] = {3e-4, 3e-4, 3e-4};
    Doc doc;
    const int lamp = doc.put("materials",
        {{"emissiveFactor", {1, 1, 1}},
            {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", lamps}}}}}});
    doc.json["extensionsUsed"].push_back("KHR_materials_emissive_strength");
    for (double side : {-1.0, 1.0})
        quad(doc, {0, -1, 2 * side}, {-0.2 * side, 0, 0}, {0, 0.2, 0}, lamp);
    const GpuWorld world = open_world("range", doc, scene);
    const ivec2 size(96, 48);
    OffscreenRenderer offscreen = renderer(world, one_view(Equirectangular{}, size));
    int dark = 0, between = 0, white = 0;
    for (double gamma : gammas)
        for (bool doppler : {false, true})
            for (double ev : {-30.0, -15.0, 0.0, 15.0, 30.0}) {
                Shot shot = flown(gamma, ev);
                shot.effects.on.set(Effect::doppler, doppler);
                const Numbers numbers(offscreen, shot);
                const auto picture = offscreen.picture(shot).front();
                for (int i = 0; i < numbers.count(); ++i) {
                    const dvec3 light = numbers.light(i);
                    for (int k = 0; k < 3; ++k) {
                        ASSERT_TRUE(std::isfinite(light[k])) << gamma << " pixel " << i;
                        ASSERT_GE(light[k],
                            -0.12
                                * std::max({light.r, light.g, light.b,
                                    1e-37})); // the spectrum's red end has negative parts in Rec. 709
                    }
                    // Skips pixels that are no longer grey, that are lamps, or in which the sky varies too much for a
                    // formula. The limit of 2 % is most of two bytes.
                    const double D = numbers.D(i), sky = sky_colour(numbers.world(i), scene["sky"]).r * D * D * D;
                    if ((doppler && gamma > 1) || D > 1.5 || light.g > 1.02 * sky)
                        continue;
                    // InsetView the lamps the sky's darkest part keeps six bits: 1.5 bytes. Dither adds half a step,
                    // rounding another half.
                    const double expected = byte_of_grey(sky * std::exp2(ev));
                    for (int k = 0; k < 3; ++k)
                        ASSERT_NEAR(picture[4 * i + k], expected, 2.5)
                            << "gamma " << gamma << " EV " << ev << " pixel " << i;
                    dark += expected<1, between += expected> 20 && expected<235, white += expected> 254;
                }
            }
    EXPECT_GT(dark, 1000);
    EXPECT_GT(between, 1000);
    EXPECT_GT(white, 1000);
}

TEST(Range, PicturesHoldUpToGammaAMillionAndThirtyStops)
{
    if (!starbow::testing::all_cases()) {
        expect_in_range(1, {1, 4, 100, 1e6});
        expect_in_range(1e6, {4, 1e6});
        expect_in_range(1e9, {1.5});
        return;
    }
    expect_in_range(1, {1, 1.5, 4, 20, 100, 1e4, 1e6});
    expect_in_range(1e6, {1, 4, 20, 1e3, 1e6});
    expect_in_range(1e9, {1, 1.5, 4});
}

// Behind the ship, sunlight is shifted into the infrared. Its visible part is many stops darker than D^3, and needs an
// exposure that shows everything at rest as white.
TEST(Range, RedShiftedLightIsRightAtGreatExposures)
{
    const GpuWorld world = sky_alone("behind", even_sky(0.5, 0.5, 0.5));
    OffscreenRenderer offscreen = renderer(world, one_view(Planar{20}, {32, 32}));
    for (double gamma : {1.5, 2.0, 4.0}) {
        Shot shot = shot_at({0, 0, 0}, {0, 0, u_of_gamma(gamma)}, {0, 0, -1});
        shot.effects = {};
        const Numbers numbers(offscreen, shot);
        shot.exposure_ev = std::log2(0.5 / numbers.light(16 * 32 + 16).r);
        const auto picture = offscreen.picture(shot).front();
        std::printf("  gamma %g: EV %.1f\n", gamma, shot.exposure_ev);
        for (int i = 0; i < numbers.count(); ++i) {
            const double red = numbers.light(i).r * std::exp2(shot.exposure_ev); // the brightest channel
            if (red < 0.76) { // Below the tone curve's knee. Only the brightest channel is checked, because the others may
                              // be negative.
                ASSERT_NEAR(picture[4 * i], 255 * srgb(red), 2) << "gamma " << gamma << " pixel " << i;
            }
        }
        Shot metered = shot;
        const double ev = *offscreen.metered(shot);
        metered.exposure_ev = 0;
        EXPECT_NEAR(*offscreen.metered(metered), ev, 1e-3); // the shot's own exposure does not matter
    }
}

TEST(Range, NumbersDoNotDependOnTheExposure)
{
    OffscreenRenderer offscreen = renderer(avenue().world, one_view(Fisheye{180, 30}, {64, 64}));
    Shot shot = flown(4, 0);
    const Numbers at_0(offscreen, shot);
    for (double ev : {-60.0, 60.0}) {
        shot.exposure_ev = ev;
        const Numbers at_ev(offscreen, shot);
        for (int i = 0; i < at_0.count(); ++i)
            if (at_0.shown(i)) {
                ASSERT_EQ(at_0.light(i), at_ev.light(i));
            }
    }
}

// ---------------------------------------------------------------- the meter

/// An atlas that an earlier frame enlarged shifts the texels, and so their rounding.
constexpr double same_ev = 1e-4;

TEST(Meter, MeasuresTheLuminanceOfAnEvenSky)
{
    for (double ev : {-9.0, 0.0, 6.0}) {
        const dvec3 colour = dvec3(0.2, 0.5, 0.9) * std::exp2(ev);
        const GpuWorld world = sky_alone("metered", even_sky(colour.r, colour.g, colour.b));
        for (const Projection& projection : {Projection(Planar{60}), Projection(Fisheye{180, 30})}) {
            OffscreenRenderer offscreen = renderer(world, one_view(projection, {320, 200}), false);
            // The tolerance is fp16's eleven bits.
            EXPECT_NEAR(*offscreen.metered(flown(1)), std::log2(0.18 / luminance(colour)), 1e-3);
            // The shot's own exposure does not matter.
            EXPECT_NEAR(*offscreen.metered(flown(1, 3)), *offscreen.metered(flown(1)), same_ev);
        }
    }
}

/// Computes metered_ev from every pixel of the numbers.
double metered_by_numbers(OffscreenRenderer& offscreen, const Shot& shot, const std::vector<std::size_t>& outputs,
    const std::function<double(std::size_t, dvec2)>& solid_angle)
{
    std::vector<std::pair<double, double>> all; // log2 luminance, solid angle
    double sum = 0;
    for (std::size_t output : outputs) {
        const Numbers numbers(offscreen, shot, output);
        for (int i = 0; i < numbers.count(); ++i)
            if (numbers.shown(i)) {
                all.emplace_back(std::log2(luminance(numbers.light(i))), solid_angle(output, numbers.centre(i)));
                sum += all.back().second;
            }
    }
    std::sort(all.begin(), all.end());
    double below = 0, weight = 0, mean = 0, bright = 0;
    for (const auto& [log, share] : all) {
        if (below > 0.5 * sum && below < 0.98 * sum)
            weight += share, mean += share * log, bright = log;
        below += share;
    }
    return std::min(std::log2(0.18) - mean / weight, 2 - bright);
}

// The meter must equal the sum over every pixel of both outputs, weighted by solid angle: all outputs have one exposure.
TEST(Meter, WeighsTheWholeViewOfAllOutputsBySolidAngle)
{
    const GpuWorld world = sky_alone("weighed", {{"sky", smooth_sky}});
    Layout layout = one_view(Equirectangular{}, {240, 120});
    layout.outputs.push_back(one_view(Planar{100, {}, {0, 60, 0}}, {160, 160}).outputs[0]);
    layout.outputs[1].name = "up";
    const double unit = std::tan(glm::radians(50.0)) / 80;
    auto solid_angle = [&](std::size_t output, dvec2 at) {
        if (output == 0)
            return std::cos(pi * (at.y / 120 - 0.5)) * pi / 120 * 2 * pi / 240;
        const dvec2 p = (at - 80.0) * unit;
        return unit * unit / std::pow(1 + glm::dot(p, p), 1.5);
    };
    OffscreenRenderer both = renderer(world, layout);
    for (double gamma : {1.0, 1.5, 4.0}) {
        const Shot shot = flown(gamma);
        // The tolerance: a sample stands for 9 pixels, and a bin is a sixteenth of a stop.
        EXPECT_NEAR(*both.metered(shot), metered_by_numbers(both, shot, {0, 1}, solid_angle), 0.04) << gamma;
    }
    // A preview is not shown to visitors, so the meter leaves it out.
    Layout watched = layout;
    watched.outputs.push_back({});
    watched.outputs[2].name = "preview", watched.outputs[2].preview = true, watched.outputs[2].size = {200, 100};
    // A preview changes the plan, and with it the sky between wide texels. Finer texels keep that small.
    Quality fine = test_quality();
    fine.texels_per_pixel = 3, fine.max_texels_per_pixel = 100;
    OffscreenRenderer with_preview(device(), pipelines(), world, watched, fine, false);
    OffscreenRenderer without(device(), pipelines(), world, layout, fine, false);
    EXPECT_NEAR(*with_preview.metered(flown(4)), *without.metered(flown(4)), 2e-3);
    // One output alone has another exposure.
    Layout up = layout;
    up.outputs.erase(up.outputs.begin());
    OffscreenRenderer alone = renderer(world, up, false);
    EXPECT_GT(std::abs(*alone.metered(flown(4)) - *both.metered(flown(4))), 0.3);
}

TEST(Meter, HasNoReadingWithoutLight)
{
    const GpuWorld world = sky_alone("night", even_sky(0, 0, 0));
    OffscreenRenderer offscreen = renderer(world, one_view(Planar{60}, {64, 64}), false);
    EXPECT_FALSE(offscreen.metered(flown(4)));
}

// In an exhibit the meter is drawn with each frame and read once the device has finished.
TEST(Meter, ChangesNoPictureAndRepeatsItsReading)
{
    Layout layout = load_layout(testing::source_dir() / "config/layouts/stereo.json");
    layout.outputs[0].size = {320, 120};
    OffscreenRenderer offscreen = renderer(avenue().world, layout, false);
    const Shot shot = flown(2, -1);
    const auto plain = offscreen.picture(shot);
    EXPECT_FALSE(offscreen.frame().metered());
    offscreen.frame().meter(true);
    EXPECT_EQ(offscreen.picture(shot), plain);
    const auto first = offscreen.frame().metered();
    ASSERT_TRUE(first);
    offscreen.picture(flown(4));
    EXPECT_NE(offscreen.frame().metered(), first);
    offscreen.picture(shot);
    EXPECT_NEAR(*offscreen.frame().metered(), *first, same_ev);
    OffscreenRenderer again = renderer(avenue().world, layout, false);
    EXPECT_NEAR(*again.metered(shot), *first, same_ev);
    // A resized output with both eyes has no reading until it is drawn.
    offscreen.frame().resize(0, {200, 100});
    EXPECT_FALSE(offscreen.frame().metered());
}

// ---------------------------------------------------------------- one exposure

TEST(OneExposure, EqualLightGivesEqualBytesInEveryOutputAndEye)
{
    const GpuWorld world = sky_alone("one", {{"sky", smooth_sky}});
    Layout layout = one_view(Equirectangular{}, {240, 120});
    layout.outputs.push_back(one_view(Planar{60, {}, {70, 30, 0}}, {200, 160}).outputs[0]);
    layout.outputs[1].packing = Packing::side_by_side;
    layout.outputs[1].name = "pair";
    OffscreenRenderer offscreen = renderer(world, layout);
    Shot shot = flown(1.2);
    shot.exposure_ev = *offscreen.metered(shot);
    const auto pictures = offscreen.picture(shot);
    for (std::size_t output : {0u, 1u}) {
        const Numbers numbers(offscreen, shot, output);
        int compared = 0;
        for (int i = 0; i < numbers.count(); ++i)
            for (int k = 0; k < 3; ++k) {
                const dvec3 light = numbers.light(i) * std::exp2(shot.exposure_ev);
                if (std::max({light.r, light.g, light.b}) > 0.75)
                    continue;
                // Half a step of dither, half of rounding, and half for the device's own sRGB table.
                ASSERT_NEAR(pictures[output][4 * i + k], 255 * srgb(light[k]), 1.5) << output << " " << i;
                ++compared;
            }
        EXPECT_GT(compared, 10000);
    }
}

// ---------------------------------------------------------------- dither

/// Over a slow ramp, the means of 16 x 16 bytes must follow the expected values, 0 to 255, within a tenth of a step. Their
/// common error is the device's sRGB curve. A GPU's own curve may be a tenth of a step off beside the rounding (Direct3D's
/// rules, which GPUs are built by, allow 0.6 of a step in all), here in one sense and there in the other.
void expect_no_bands(Layout layout, const GpuWorld& world, const Shot& shot, const std::function<double(double)>& expected)
{
    Layout plain = layout; // the light without conversions
    plain.outputs[0].colour = {};
    OffscreenRenderer offscreen = renderer(world, layout, false), measured = renderer(world, plain);
    const auto bytes = offscreen.picture(shot).front();
    const Numbers numbers(measured, shot);
    const ivec2 size = numbers.size;
    std::vector<double> off;
    double least = 255, most = 0, mean = 0;
    int mixed = 0;
    for (int y = 0; y + 16 <= size.y; y += 16)
        for (int x = 0; x + 16 <= size.x; x += 16)
            for (int k = 0; k < 3; ++k) {
                double sum = 0, right = 0;
                bool mixes = false;
                for (int j = 0; j < 256; ++j) {
                    const int i = (y + j / 16) * size.x + x + j % 16;
                    sum += bytes[4 * i + k] / 256.0;
                    right += expected(numbers.light(i)[k] * std::exp2(shot.exposure_ev)) / 256;
                    mixes |= bytes[4 * i + k] != bytes[4 * (y * size.x + x) + k];
                }
                off.push_back(sum - right);
                mean += sum - right;
                least = std::min(least, right), most = std::max(most, right);
                mixed += mixes;
            }
    mean /= double(off.size());
    double worst = 0;
    for (double o : off)
        worst = std::max(worst, std::abs(o - mean));
    std::printf("  from %6.2f to %6.2f: off by %5.2f, local means by %.3f at most\n", least, most, mean, worst);
    EXPECT_LT(worst, device().on_processor() ? 0.1 : 0.3);
    EXPECT_LT(std::abs(mean), 0.3);
    EXPECT_GT(most - least, 1);
    EXPECT_LT(most - least, 20); // slow: a band is several blocks wide
    EXPECT_GT(mixed, int(off.size()) / 2);
}

TEST(Dither, ASlowRampHasNoBandsInAnyCurve)
{
    struct Ramp {
        double from, to, exposure_ev;
    };
    // The sky fades from horizon to zenith in dark, middle and bright levels.
    for (const Ramp& ramp : {Ramp{0, 1, -10}, Ramp{0.2, 0.22, 0}, Ramp{0.68, 0.74, 0}}) {
        Json scene = even_sky(ramp.from, ramp.from, ramp.from);
        scene["sky"]["zenith"] = scene["sky"]["nadir"] = {ramp.to, ramp.to, ramp.to};
        const GpuWorld world = sky_alone("ramp", scene);
        Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
        shot.exposure_ev = ramp.exposure_ev;
        Layout layout = one_view(Equirectangular{}, {512, 256});
        expect_no_bands(layout, world, shot, [](double light) { return 255 * srgb(light); });
        layout.outputs[0].colour.gamma = 1.8;
        if (ramp.exposure_ev == 0) // otherwise a gamma's infinite slope at black makes the ramp steep
            expect_no_bands(layout, world, shot, [](double light) { return 255 * std::pow(light, 1 / 1.8); });
        layout.outputs[0].colour = {};
        layout.outputs[0].colour.lut = {{0, 0, 0}, {0.4, 0.4, 0.4}, {1, 1, 1}};
        if (ramp.exposure_ev == 0)
            expect_no_bands(layout, world, shot,
                [](double light) { return 255 * (light < 0.5 ? 0.8 * light : 0.4 + 1.2 * (light - 0.5)); });
        // The finish pass writes sRGB here.
        layout.outputs[0].colour.lut.clear();
        layout.outputs[0].colour.matrix = dmat3(0.5);
        expect_no_bands(layout, world, shot, [](double light) { return 255 * srgb(0.5 * light); });
    }
}

TEST(Dither, BlackStaysBlack)
{
    const GpuWorld world = sky_alone("black", even_sky(0, 0, 0));
    for (bool finished : {false, true}) {
        Layout layout = one_view(Planar{60}, {128, 128});
        if (finished)
            layout.outputs[0].colour.gamma = 2.2;
        OffscreenRenderer offscreen = renderer(world, layout, false);
        const auto bytes = offscreen.picture(flown(1)).front();
        for (std::size_t i = 0; i < bytes.size(); ++i)
            ASSERT_EQ(bytes[i], i % 4 == 3 ? 255 : 0);
    }
}

// ---------------------------------------------------------------- bloom

/// A lamp of light 0.7 in front of a black sky.
GpuWorld lamp_in_the_dark()
{
    Doc doc;
    quad(doc, {0, 0, -10}, {1, 0, 0}, {0, 1, 0}, unlit(doc, {0.7, 0.7, 0.7}));
    return open_world("lamp", doc, even_sky(0, 0, 0));
}

TEST(Bloom, MovesLightAndMakesNone)
{
    const GpuWorld world = lamp_in_the_dark();
    for (ivec2 size : {ivec2(256, 256), ivec2(301, 203)}) {
        Layout layout = one_view(Planar{60}, size);
        layout.outputs[0].colour.gamma = 1; // bytes are proportional to light, and dithered: their sum is the light's sum
        OffscreenRenderer offscreen = renderer(world, layout, false);
        auto bytes = [&](double part) {
            offscreen.frame().bloom(part, 0);
            return offscreen.picture(shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1})).front();
        };
        auto sum = [&](const std::vector<std::uint8_t>& picture) {
            double all = 0;
            for (std::size_t i = 0; i < picture.size(); i += 4)
                all += picture[i];
            return all;
        };
        const auto sharp = bytes(0);
        const vk::DeviceSize memory = offscreen.frame().memory();
        const auto glowing = bytes(0.4);
        EXPECT_GT(offscreen.frame().memory(), memory);
        // The tolerance: edges return the light that would leave, odd sizes are halved with a spare texel, and the lamp is
        // only 44 or 35 pixels wide.
        EXPECT_NEAR(sum(glowing) / sum(sharp), 1, 0.03) << size.x;
        const std::size_t middle = 4 * (std::size_t(size.y / 2) * size.x + size.x / 2), corner = 4 * (size.x + 1);
        EXPECT_NEAR(sharp[middle], 0.7 * 255, 2);
        EXPECT_LT(glowing[middle], sharp[middle] - 20);
        EXPECT_EQ(sharp[corner], 0);
        // The glow falls with the distance, and is the same on every side.
        for (int away : {30, 50, 70, 90}) {
            auto ring = [&](int r) {
                double least = 255, most = 0;
                for (ivec2 to : {ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1)}) {
                    double mean = 0; // over 9 x 9 pixels
                    for (int k = 0; k < 81; ++k) {
                        const ivec2 p = size / 2 + to * r + ivec2(k % 9 - 4, k / 9 - 4);
                        mean += glowing[4 * (std::size_t(p.y) * size.x + p.x)] / 81.0;
                    }
                    least = std::min(least, mean), most = std::max(most, mean);
                }
                return dvec2(least, most);
            };
            const dvec2 here = ring(away);
            EXPECT_GT(here.x, 0.1) << away;
            EXPECT_LT(here.y - here.x, 0.25 * here.y + 0.5) << away;
            if (away < 90) {
                EXPECT_GT(here.x, ring(away + 20).y) << away;
            }
        }
        EXPECT_EQ(bytes(0), sharp);
        EXPECT_EQ(offscreen.frame().memory(), memory);
    }
}

TEST(Bloom, LeavesAnEvenViewAsItIs)
{
    const GpuWorld world = sky_alone("even", even_sky(0.3, 0.1, 0.5));
    for (const Projection& projection : {Projection(Planar{60}), Projection(Fisheye{180, 90})}) {
        OffscreenRenderer offscreen = renderer(world, one_view(projection, {128, 128}), false);
        const auto sharp = offscreen.picture(flown(1)).front();
        offscreen.frame().bloom(0.4, 0);
        const auto glowing = offscreen.picture(flown(1)).front();
        for (int i = 0; i < 128 * 128; ++i)
            for (int k = 0; k < 3; ++k) {
                const double at = glm::length(dvec2(i % 128, i / 128) - 63.5);
                const int sharply = sharp[4 * i + k], shown = glowing[4 * i + k];
                if (std::holds_alternative<Planar>(projection)) {
                    ASSERT_NEAR(shown, sharply, 1) << i; // fp16's rounding
                } else {
                    // Outside a dome's circle the picture stays black, even beside a glow.
                    ASSERT_LE(shown, at > 64.5 ? 0 : sharply + 1) << i;
                }
            }
    }
}

// A screen shows light up to its white by itself, so only what is brighter glows: as much as that part alone would.
TEST(Bloom, OnlyWhatIsBrighterThanTheScreenGlows)
{
    const GpuWorld world = lamp_in_the_dark(); // of light 0.7
    OffscreenRenderer offscreen = renderer(world, one_view(Planar{60}, {256, 256}), false);
    const auto bytes = [&](double ev, double part, double above) {
        offscreen.frame().bloom(part, above);
        Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
        shot.exposure_ev = ev;
        return offscreen.picture(shot).front();
    };
    const auto plain = bytes(0, 0, 1), dim = bytes(0, 0.5, 1);
    for (std::size_t i = 0; i < plain.size(); ++i)
        ASSERT_NEAR(dim[i], plain[i], 1) << i / 4; // fp16's rounding
    // A lamp of light 11.2 has 10.2 above white; alone these are log2(10.2 / 0.7) EV.
    const auto shown = bytes(4, 0.1, 1), alone = bytes(std::log2(10.2 / 0.7), 0.1, 0), sharp = bytes(4, 0, 1);
    int around = 0, off = 0;
    for (std::size_t i = 0; i < shown.size(); i += 4)
        if (sharp[i] == 0) {
            // At the lamp's soft edge, the part above white is not that part of the light.
            ASSERT_NEAR(shown[i], alone[i], 6) << i / 4;
            off += std::abs(shown[i] - alone[i]) > 2;
            around += shown[i] > 20;
        } else if (sharp[i] > 240) { // inside the lamp
            ASSERT_NEAR(shown[i], sharp[i], 6) << i / 4;
        }
    EXPECT_GT(around, 2000);
    EXPECT_LT(off, around / 10);
}

TEST(Bloom, EndsAtTheViewportsEdge)
{
    const GpuWorld world = lamp_in_the_dark();
    Layout layout = one_view(Planar{60}, {256, 128});
    layout.outputs[0].viewports = {{.rect = {0, 0, 0.5, 1}, .projection = Planar{10}},
        {.rect = {0.5, 0, 0.5, 1}, .projection = Planar{60, {}, {90, 0, 0}}}};
    OffscreenRenderer offscreen = renderer(world, layout, false);
    offscreen.frame().bloom(1, 0);
    const auto bytes = offscreen.picture(shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1})).front();
    for (int i = 0; i < 256 * 128; ++i)
        for (int k = 0; k < 3; ++k) {
            if (i % 256 < 128)
                ASSERT_GT(bytes[4 * i + k], 200) << i; // the lamp fills this viewport
            else
                ASSERT_EQ(bytes[4 * i + k], 0) << i;
        }
}

} // namespace
} // namespace starbow::gpu_test::exposure_gpu_test
