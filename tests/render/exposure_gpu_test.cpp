// Brightness through the whole path: light as numbers and as pictures, its range, its sum over the sky, the meter, and the
// last step to bytes.
#include "config/model/angles.h"
#include "runtime/light/exposure.h"
#include "tests/support/small_world.h"

namespace starbow::gpu_test {
namespace {

Json even_sky(double r, double g, double b)
{
    return {{"sky", {{"zenith", {r, g, b}}, {"horizon", {r, g, b}}, {"nadir", {r, g, b}}}}};
}

/// Nothing but a sky: what there is lies far behind, is small, and shows its back.
GpuWorld sky_alone(const std::string& name, const Json& scene)
{
    Doc doc;
    quad(doc, {0, 0, 900}, {0.01, 0, 0}, {0, 0.01, 0}, unlit(doc, {1, 1, 1}));
    return open_world(name, doc, scene);
}

Shot flown(double gamma, double exposure_ev = 0)
{
    Shot shot = shot_at({0, 0, 0}, u_of_gamma(gamma) * glm::normalize(dvec3(0.3, 0.5, -0.8)), {0, 0, -1});
    shot.effects = {true, false, true};
    shot.exposure_ev = exposure_ev;
    return shot;
}

double luminance(const dvec3& c) { return glm::dot(c, {0.2126, 0.7152, 0.0722}); }

// ---------------------------------------------------------------- the sky's light, summed up

// Over the camera's sky the means of D^2, D^3, D^4 are 1, gamma and gamma^2 (1 + beta^2 / 3). The pixels' light is D^3; its
// quotient and its product with their D make the other two.
TEST(SphereMeans, OfAnEvenSkyThroughTheWholePath)
{
    const GpuWorld world = sky_alone("even", even_sky(1, 1, 1));
    const ivec2 size(768, 384);
    OffscreenRenderer stage = renderer(world, one_view(Equirectangular{}, size));
    for (double gamma : {1.0, 2.0, 4.0, 10.0}) {
        const auto folder = testing::scratch("means");
        render_still(folder, stage, flown(gamma, -5), true); // whatever the picture's exposure
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
                const double share = std::cos(pi * ((y + 0.5) / size.y - 0.5)); // of the sphere
                ASSERT_EQ(red[i], green[i]);
                ASSERT_EQ(red[i], blue[i]);
                all += share, square += share * red[i] / D[i], cube += share * red[i], fourth += share * red[i] * D[i];
            }
        const double beta_square = 1 - 1 / (gamma * gamma);
        std::printf("  gamma %4g: D^2 %.6f D^3 %.5f D^4 %.4f\n", gamma, square / all, cube / all, fourth / all);
        // Half a degree is a tenth of what D changes in, at gamma 10; fp16 holds 1 exactly.
        EXPECT_NEAR(square / all, 1, 0.005);
        EXPECT_NEAR(cube / all, gamma, 0.005 * gamma);
        EXPECT_NEAR(fourth / all, gamma * gamma * (1 + beta_square / 3), 0.005 * fourth / all);
    }
}

// ---------------------------------------------------------------- range

/// The curve of shaders/tone.glsl for greys, and what a byte has of it.
double byte_of_grey(double light)
{
    const double knee = 0.76, above = std::max(light - knee, 0.0);
    return 255 * srgb(std::min(light, knee) + (1 - knee) * above / (above + 1 - knee));
}

/// Pictures and numbers at thirty stops either way. Greys, so that what is right follows from the sky and D alone; beside
/// lamps that shine so much brighter than all else.
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
    OffscreenRenderer stage = renderer(world, one_view(Equirectangular{}, size));
    int dark = 0, between = 0, white = 0;
    for (double gamma : gammas)
        for (bool doppler : {false, true})
            for (double ev : {-30.0, -15.0, 0.0, 15.0, 30.0}) {
                Shot shot = flown(gamma, ev);
                shot.effects.doppler = doppler;
                const Numbers numbers(stage, shot);
                const auto picture = stage.picture(shot).front();
                for (int i = 0; i < numbers.count(); ++i) {
                    const dvec3 light = numbers.light(i);
                    for (int k = 0; k < 3; ++k) {
                        ASSERT_TRUE(std::isfinite(light[k])) << gamma << " pixel " << i;
                        ASSERT_GE(light[k],
                            -0.12
                                * std::max({light.r, light.g, light.b, 1e-37})); // the red end of the spectrum, in Rec. 709
                    }
                    // What is not grey any more, or fills a pixel with more of the sky than fits into a formula, or shines:
                    // 2 % are the better part of two bytes.
                    const double D = numbers.D(i), sky = sky_colour(numbers.world(i), scene["sky"]).r * D * D * D;
                    if ((doppler && gamma > 1) || D > 1.5 || light.g > 1.02 * sky)
                        continue;
                    // The darkest of the sky keeps six bits beside the lamps: 1.5 bytes. Half a step of dither, half of
                    // rounding.
                    const double wanted = byte_of_grey(sky * std::exp2(ev));
                    for (int k = 0; k < 3; ++k)
                        ASSERT_NEAR(picture[4 * i + k], wanted, 2.5) << "gamma " << gamma << " EV " << ev << " pixel " << i;
                    dark += wanted<1, between += wanted> 20 && wanted<235, white += wanted> 254;
                }
            }
    EXPECT_GT(dark, 1000);
    EXPECT_GT(between, 1000);
    EXPECT_GT(white, 1000);
}

TEST(Range, FromRestToAMillionAndThirtyStopsEitherWay)
{
    expect_in_range(1, {1, 1.5, 4, 20, 100, 1e4, 1e6});
    expect_in_range(1e6, {1, 4, 20, 1e3, 1e6});
    expect_in_range(1e9, {1, 1.5, 4});
}

// Behind, sunlight is shifted into the infrared: what is left to see is dark by many more stops than D^3 tells, and is shown
// by an exposure at which nothing in the world at rest would be less than white.
TEST(Range, RedShiftedLightAtGreatExposures)
{
    const GpuWorld world = sky_alone("behind", even_sky(0.5, 0.5, 0.5));
    OffscreenRenderer stage = renderer(world, one_view(Planar{20}, {32, 32}));
    for (double gamma : {1.5, 2.0, 4.0}) {
        Shot shot = shot_at({0, 0, 0}, {0, 0, u_of_gamma(gamma)}, {0, 0, -1});
        shot.effects = {true, true, true};
        const Numbers numbers(stage, shot);
        shot.exposure_ev = std::log2(0.5 / numbers.light(16 * 32 + 16).r);
        const auto picture = stage.picture(shot).front();
        std::printf("  gamma %g: EV %.1f\n", gamma, shot.exposure_ev);
        for (int i = 0; i < numbers.count(); ++i) {
            const double red = numbers.light(i).r * std::exp2(shot.exposure_ev); // the brightest
            if (red < 0.76) { // straight: only the brightest channel shows it if the others are negative
                ASSERT_NEAR(picture[4 * i], 255 * srgb(red), 2) << "gamma " << gamma << " pixel " << i;
            }
        }
        Shot metered = shot;
        const double ev = *stage.metered(shot);
        metered.exposure_ev = 0;
        EXPECT_NEAR(*stage.metered(metered), ev, 1e-3); // whatever it is shown at
    }
}

TEST(Range, NumbersDoNotDependOnTheExposure)
{
    OffscreenRenderer stage = renderer(avenue().world, one_view(Fisheye{180, 30}, {64, 64}));
    Shot shot = flown(4, 0);
    const Numbers at_0(stage, shot);
    for (double ev : {-60.0, 60.0}) {
        shot.exposure_ev = ev;
        const Numbers at_ev(stage, shot);
        for (int i = 0; i < at_0.count(); ++i)
            if (at_0.shown(i)) {
                ASSERT_EQ(at_0.light(i), at_ev.light(i));
            }
    }
}

// ---------------------------------------------------------------- the meter

/// A larger atlas, left from another frame, makes other roundings of where texels lie in it.
constexpr double same_ev = 1e-4;

TEST(Meter, TellsTheLightOfAnEvenSky)
{
    for (double ev : {-9.0, 0.0, 6.0}) {
        const dvec3 colour = dvec3(0.2, 0.5, 0.9) * std::exp2(ev);
        const GpuWorld world = sky_alone("metered", even_sky(colour.r, colour.g, colour.b));
        for (const Projection& projection : {Projection(Planar{60}), Projection(Fisheye{180, 30})}) {
            OffscreenRenderer stage = renderer(world, one_view(projection, {320, 200}), false);
            // fp16's eleven bits.
            EXPECT_NEAR(*stage.metered(flown(1)), std::log2(0.18 / luminance(colour)), 1e-3);
            // Whatever it is shown at.
            EXPECT_NEAR(*stage.metered(flown(1, 3)), *stage.metered(flown(1)), same_ev);
        }
    }
}

/// What metered_ev makes of every pixel of the numbers.
double metered_by_numbers(OffscreenRenderer& stage, const Shot& shot, const std::vector<std::size_t>& outputs,
    const std::function<double(std::size_t, dvec2)>& solid_angle)
{
    std::vector<std::pair<double, double>> all; // log2 luminance, solid angle
    double sum = 0;
    for (std::size_t output : outputs) {
        const Numbers numbers(stage, shot, output);
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

// Against every pixel of both outputs, weighted by solid angle: one exposure for all.
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
        // A sample stands for 9 pixels, and a bin is a sixteenth of a stop.
        EXPECT_NEAR(*both.metered(shot), metered_by_numbers(both, shot, {0, 1}, solid_angle), 0.04) << gamma;
    }
    // A preview is not looked at by visitors.
    Layout watched = layout;
    watched.outputs.push_back({});
    watched.outputs[2].name = "preview", watched.outputs[2].preview = true, watched.outputs[2].size = {200, 100};
    // Its plan is another, so where texels are as wide as pixels the sky bends otherwise between them: finer ones.
    Quality fine = test_quality();
    fine.texels_per_pixel = 3, fine.max_texels_per_pixel = 100;
    OffscreenRenderer with_preview(device(), pipelines(), world, watched, fine, false);
    OffscreenRenderer without(device(), pipelines(), world, layout, fine, false);
    EXPECT_NEAR(*with_preview.metered(flown(4)), *without.metered(flown(4)), 2e-3);
    // Each alone wants something else.
    Layout up = layout;
    up.outputs.erase(up.outputs.begin());
    OffscreenRenderer alone = renderer(world, up, false);
    EXPECT_GT(std::abs(*alone.metered(flown(4)) - *both.metered(flown(4))), 0.3);
}

TEST(Meter, OfANightWithoutLightThereIsNothing)
{
    const GpuWorld world = sky_alone("night", even_sky(0, 0, 0));
    OffscreenRenderer stage = renderer(world, one_view(Planar{60}, {64, 64}), false);
    EXPECT_FALSE(stage.metered(flown(4)));
}

// As the exhibit runs it: the meter is drawn beside the picture, read when the device has finished, and is the same again.
TEST(Meter, BesideAFrameItChangesNothingAndIsTheSameEachTime)
{
    Layout layout = load_layout(testing::source_dir() / "config/layouts/stereo.json");
    layout.outputs[0].size = {320, 120};
    OffscreenRenderer stage = renderer(avenue().world, layout, false);
    const Shot shot = flown(2, -1);
    const auto plain = stage.picture(shot);
    EXPECT_FALSE(stage.frame().metered());
    stage.frame().meter(true);
    EXPECT_EQ(stage.picture(shot), plain);
    const auto first = stage.frame().metered();
    ASSERT_TRUE(first);
    stage.picture(flown(4));
    EXPECT_NE(stage.frame().metered(), first);
    stage.picture(shot);
    EXPECT_NEAR(*stage.frame().metered(), *first, same_ev);
    OffscreenRenderer again = renderer(avenue().world, layout, false);
    EXPECT_NEAR(*again.metered(shot), *first, same_ev);
    // Both eyes and a resized output go on.
    stage.frame().resize(0, {200, 100});
    EXPECT_FALSE(stage.frame().metered());
}

// ---------------------------------------------------------------- one exposure

TEST(OneExposure, TheSameLightIsTheSameByteInEveryOutputAndEye)
{
    const GpuWorld world = sky_alone("one", {{"sky", smooth_sky}});
    Layout layout = one_view(Equirectangular{}, {240, 120});
    layout.outputs.push_back(one_view(Planar{60, {}, {70, 30, 0}}, {200, 160}).outputs[0]);
    layout.outputs[1].packing = Packing::side_by_side;
    layout.outputs[1].name = "pair";
    OffscreenRenderer stage = renderer(world, layout);
    Shot shot = flown(1.2);
    shot.exposure_ev = *stage.metered(shot);
    const auto pictures = stage.picture(shot);
    for (std::size_t output : {0u, 1u}) {
        const Numbers numbers(stage, shot, output);
        int straight = 0;
        for (int i = 0; i < numbers.count(); ++i)
            for (int k = 0; k < 3; ++k) {
                const dvec3 light = numbers.light(i) * std::exp2(shot.exposure_ev);
                if (std::max({light.r, light.g, light.b}) > 0.75)
                    continue;
                // Half a step of dither, half of rounding, and half for the device's own sRGB table.
                ASSERT_NEAR(pictures[output][4 * i + k], 255 * srgb(light[k]), 1.5) << output << " " << i;
                ++straight;
            }
        EXPECT_GT(straight, 10000);
    }
}

// ---------------------------------------------------------------- dither

/// A slow ramp: the means of 16 x 16 bytes follow what is wanted within a tenth of a step. wanted: 0 to 255, of a light.
/// What all of them are off by together is the device's own sRGB curve: smooth, and Vulkan allows it 0.6 of a step.
void expect_no_bands(Layout layout, const GpuWorld& world, const Shot& shot, const std::function<double(double)>& wanted)
{
    Layout plain = layout; // the light alone
    plain.outputs[0].colour = {};
    OffscreenRenderer stage = renderer(world, layout, false), measured = renderer(world, plain);
    const auto bytes = stage.picture(shot).front();
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
                    right += wanted(numbers.light(i)[k] * std::exp2(shot.exposure_ev)) / 256;
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
    EXPECT_LT(worst, 0.1);
    EXPECT_LT(std::abs(mean), 0.3);
    EXPECT_GT(most - least, 1);
    EXPECT_LT(most - least, 20); // slow: bands of some blocks each
    EXPECT_GT(mixed, int(off.size()) / 2);
}

TEST(Dither, ASlowRampHasNoBandsInAnyCurve)
{
    struct Ramp {
        double from, to, exposure_ev;
    };
    // The sky fades from horizon to zenith: dark, middle and bright.
    for (const Ramp& ramp : {Ramp{0, 1, -10}, Ramp{0.2, 0.22, 0}, Ramp{0.68, 0.74, 0}}) {
        Json scene = even_sky(ramp.from, ramp.from, ramp.from);
        scene["sky"]["zenith"] = scene["sky"]["nadir"] = {ramp.to, ramp.to, ramp.to};
        const GpuWorld world = sky_alone("ramp", scene);
        Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
        shot.exposure_ev = ramp.exposure_ev;
        Layout layout = one_view(Equirectangular{}, {512, 256});
        expect_no_bands(layout, world, shot, [](double light) { return 255 * srgb(light); });
        layout.outputs[0].colour.gamma = 1.8;
        if (ramp.exposure_ev == 0) // else a gamma's infinite slope at black makes it steep
            expect_no_bands(layout, world, shot, [](double light) { return 255 * std::pow(light, 1 / 1.8); });
        layout.outputs[0].colour = {};
        layout.outputs[0].colour.lut = {{0, 0, 0}, {0.4, 0.4, 0.4}, {1, 1, 1}};
        if (ramp.exposure_ev == 0)
            expect_no_bands(layout, world, shot,
                [](double light) { return 255 * (light < 0.5 ? 0.8 * light : 0.4 + 1.2 * (light - 0.5)); });
        // sRGB by way of the finish pass.
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
        OffscreenRenderer stage = renderer(world, layout, false);
        const auto bytes = stage.picture(flown(1)).front();
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
        layout.outputs[0].colour.gamma = 1; // bytes that are proportional to light, and dithered: their sum is the light's
        OffscreenRenderer stage = renderer(world, layout, false);
        auto bytes = [&](double part) {
            stage.frame().bloom(part);
            return stage.picture(shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1})).front();
        };
        auto sum = [&](const std::vector<std::uint8_t>& picture) {
            double all = 0;
            for (std::size_t i = 0; i < picture.size(); i += 4)
                all += picture[i];
            return all;
        };
        const auto sharp = bytes(0);
        const vk::DeviceSize memory = stage.frame().memory();
        const auto glowing = bytes(0.4);
        EXPECT_GT(stage.frame().memory(), memory);
        // Edges give back what would leave; odd sizes are halved with a texel to spare; a lamp's side is 44 or 35 pixels.
        EXPECT_NEAR(sum(glowing) / sum(sharp), 1, 0.03) << size.x;
        const std::size_t middle = 4 * (std::size_t(size.y / 2) * size.x + size.x / 2), corner = 4 * (size.x + 1);
        EXPECT_NEAR(sharp[middle], 0.7 * 255, 2);
        EXPECT_LT(glowing[middle], sharp[middle] - 20);
        EXPECT_EQ(sharp[corner], 0);
        // Nearer is brighter, on every side alike.
        for (int away : {30, 50, 70, 90}) {
            auto ring = [&](int r) {
                double least = 255, most = 0;
                for (ivec2 to : {ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1)}) {
                    double mean = 0; // of 9 x 9
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
        EXPECT_EQ(stage.frame().memory(), memory);
    }
}

TEST(Bloom, LeavesAnEvenViewAsItIs)
{
    const GpuWorld world = sky_alone("even", even_sky(0.3, 0.1, 0.5));
    for (const Projection& projection : {Projection(Planar{60}), Projection(Fisheye{180, 90})}) {
        OffscreenRenderer stage = renderer(world, one_view(projection, {128, 128}), false);
        const auto sharp = stage.picture(flown(1)).front();
        stage.frame().bloom(0.4);
        const auto glowing = stage.picture(flown(1)).front();
        for (int i = 0; i < 128 * 128; ++i)
            for (int k = 0; k < 3; ++k) {
                const double at = glm::length(dvec2(i % 128, i / 128) - 63.5);
                const int sharply = sharp[4 * i + k], shown = glowing[4 * i + k];
                if (std::holds_alternative<Planar>(projection)) {
                    ASSERT_NEAR(shown, sharply, 1) << i; // fp16
                } else {
                    // Outside a dome's circle nothing is shown, whatever glows beside it.
                    ASSERT_LE(shown, at > 64.5 ? 0 : sharply + 1) << i;
                }
            }
    }
}

TEST(Bloom, EndsAtTheViewportsEdge)
{
    const GpuWorld world = lamp_in_the_dark();
    Layout layout = one_view(Planar{60}, {256, 128});
    layout.outputs[0].viewports = {{.rect = {0, 0, 0.5, 1}, .projection = Planar{10}},
        {.rect = {0.5, 0, 0.5, 1}, .projection = Planar{60, {}, {90, 0, 0}}}};
    OffscreenRenderer stage = renderer(world, layout, false);
    stage.frame().bloom(1);
    const auto bytes = stage.picture(shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1})).front();
    for (int i = 0; i < 256 * 128; ++i)
        for (int k = 0; k < 3; ++k) {
            if (i % 256 < 128)
                ASSERT_GT(bytes[4 * i + k], 200) << i; // the lamp fills it
            else
                ASSERT_EQ(bytes[4 * i + k], 0) << i;
        }
}

} // namespace
} // namespace starbow::gpu_test
