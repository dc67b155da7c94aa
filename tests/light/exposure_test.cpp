// Metering, adaptation, and the tone curve from light to a screen's range.
#include "config/model/angles.h"
#include "runtime/hud/hud.h"
#include "runtime/light/colour.h"
#include "runtime/light/exposure.h"
#include "shaders/tone.h"
#include "tests/support/files.h"
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace exposure_test {

using namespace starbow;

namespace {

using View = std::vector<LuminanceSample>;

View even(const std::vector<float>& luminances, float each = 0.001f)
{
    View view;
    for (const float l : luminances)
        view.push_back({l, each});
    return view;
}

} // namespace

// ---------------------------------------------------------------- metering

TEST(Metering, AnEvenViewIsBroughtToMidGrey)
{
    // From the least float to nearly the greatest.
    for (double ev = -130; ev <= 120; ev += 12.5)
        EXPECT_NEAR(*metered_ev(even(std::vector<float>(100, float(std::exp2(ev))))), std::log2(0.18) - ev, 1e-6) << ev;
}

TEST(Metering, IsTheLogAverageOfTheBrighterHalfWithoutTheBrightest)
{
    // A thousand luminances, evenly spaced in log2 over ten stops: the mean from 50 % to 98 % is at 74 %.
    std::vector<float> luminances;
    for (int i = 0; i < 1000; ++i)
        luminances.push_back(float(std::exp2(-8 + 10 * (i * 617 % 1000 + 0.5) / 1000)));
    // Bins of a sixteenth of a stop are cut at both ends.
    EXPECT_NEAR(*metered_ev(even(luminances)), std::log2(0.18) - (-8 + 7.4), 0.01);
    // Light above the 98th percentile does not matter.
    std::vector<float> lamps = luminances;
    std::sort(lamps.begin(), lamps.end());
    for (int i = 985; i < 1000; ++i)
        lamps[std::size_t(i)] *= 1e6f;
    EXPECT_NEAR(*metered_ev(even(lamps)), *metered_ev(even(luminances)), 1e-9);
}

TEST(Metering, IsWeightedBySolidAngle)
{
    // The same sky with a part sampled more finely, as at a dome's rim or by a second eye.
    View view = even({0.01f, 0.1f, 0.2f, 0.3f}, 1.0f), finer = view;
    finer[2].solid_angle_sr = 0.25f;
    for (int i = 0; i < 3; ++i)
        finer.push_back(finer[2]);
    EXPECT_NEAR(*metered_ev(view), *metered_ev(finer), 1e-9);
    // The brighter half is a part of 0.2 and nearly all of 0.3.
    EXPECT_NEAR(*metered_ev(view), std::log2(0.18) - (0.25 * std::log2(0.2) + 0.23 * std::log2(0.3)) / 0.48, 1e-6);
}

TEST(Metering, ASmallBrightDiscIsNotBurntOut)
{
    // A tenth of the view is lit, as at great gamma; the rest is 20 stops darker.
    std::vector<float> luminances(900, 1e-6f);
    luminances.resize(1000, 1.0f);
    EXPECT_NEAR(*metered_ev(even(luminances)), 2, 1e-6); // two stops above white
}

// A bright disc on exactly a fiftieth of the view is the bright end; a smaller one may turn white.
TEST(Metering, TheBrightEndBeginsAtAFiftiethOfTheView)
{
    const auto ev_with = [](float dark_sr, float disc_sr) { return *metered_ev(View{{1e-6f, dark_sr}, {1.0f, disc_sr}}); };
    EXPECT_NEAR(ev_with(98, 2), 2, 1e-6); // two stops above white
    EXPECT_NEAR(ev_with(49, 1), 2, 1e-6);
    EXPECT_NEAR(ev_with(97, 3), 2, 1e-6);
    EXPECT_NEAR(ev_with(99, 1), std::log2(0.18 / 1e-6), 1e-6); // the dark is brought to mid-grey
}

// Stars in twilight, with a hundredfold range of brightness, evenly spaced in its logarithm.
TEST(Metering, StarsAreExposedToMidGreyAtMost)
{
    const View twilight = even(std::vector<float>(1000, 0.01f));
    std::vector<float> luminances;
    for (int i = 0; i < 300; ++i)
        luminances.push_back(float(std::pow(10, -1 + 2 * (i + 0.5) / 300)));
    const View stars = even(luminances, 1e-6f);
    const double alone = std::log2(0.18) - std::log2(10) * (-1 + 2 * 0.74); // the brighter half's mean, as above
    EXPECT_NEAR(*metered_ev({}, stars), alone, 0.01);
    // Among 300 stars the sixteen assumed ones count for 5 %.
    EXPECT_NEAR(*metered_ev(twilight, stars), alone + (std::log2(18) - alone) * 16 / 316, 0.01);
    // By day the stars do not count.
    EXPECT_EQ(*metered_ev(even({5, 5, 5, 5}), stars), *metered_ev(even({5, 5, 5, 5})));
    EXPECT_EQ(metered_ev(twilight, even({0, 0, 0})), metered_ev(twilight)); // stars without light do not count
    // A few bright stars come into view.
    View with_bright = stars;
    for (const float bright : {300.0f, 1000.0f, 3000.0f})
        with_bright.push_back({bright, 1e-6f});
    EXPECT_NEAR(*metered_ev(twilight, with_bright), *metered_ev(twilight, stars), 0.1);
    // One bright star changes the exposure of a twilight little.
    EXPECT_NEAR(*metered_ev(twilight, even({30.0f}, 1e-6f)), std::log2(18) - std::log2(30 / 0.01) / 17, 0.01);
}

TEST(Metering, DarknessAndInvalidNumbersGiveNoReading)
{
    const float none = std::numeric_limits<float>::quiet_NaN(), most = std::numeric_limits<float>::infinity();
    EXPECT_FALSE(metered_ev({}));
    EXPECT_FALSE(metered_ev(even(std::vector<float>(100, 0.0f))));
    EXPECT_FALSE(metered_ev(even({none, most, -1.0f, 1e-45f})));
    EXPECT_FALSE(metered_ev(View{{1, 0}, {1, none}, {1, -1}}));
    // These values do not count beside light.
    EXPECT_NEAR(*metered_ev(even({none, most, 0, 0, 0, 0, 0.18f})), 0, 1e-6);
}

// ---------------------------------------------------------------- adaptation

TEST(Adaptation, TakesHalfASecondUpAndThreeDown)
{
    const Exposing rules;
    const double part = 1 - std::exp(-1.0); // the fraction after one time constant
    Exposure exposure{0.0};
    EXPECT_NEAR(*adapted(exposure, -10.0, 0.5, rules, 0).ev, -10 * part, 1e-12); // ten stops brighter: half a second
    EXPECT_NEAR(*adapted(exposure, 10.0, 3, rules, 0).ev, 10 * part, 1e-12); // ten stops darker: three seconds
    EXPECT_EQ(*adapted(exposure, 10.0, 0, rules, 0).ev, 0);
    EXPECT_EQ(*adapted(exposure, 10.0, -1, rules, 0).ev, 0);
}

TEST(Adaptation, IsTheSameAtAnyFrameRate)
{
    const Exposing rules;
    for (const double target : {-12.0, 7.0})
        for (const int rate : {5, 24, 60, 144, 1000}) {
            Exposure exposure{2.0};
            for (int i = 0; i < rate; ++i)
                exposure = adapted(exposure, target, 1.0 / rate, rules, 0);
            const double time_s = target < 2 ? 0.5 : 3;
            // A thousand roundings of numbers up to 12.
            EXPECT_NEAR(*exposure.ev, target + (2 - target) * std::exp(-1 / time_s), 1e-11) << rate;
        }
}

TEST(Adaptation, NeverOvershootsItsTarget)
{
    const Exposing rules;
    Exposure exposure{0.0};
    for (int i = 0; i < 200; ++i) {
        const double before = *exposure.ev;
        exposure = adapted(exposure, -5.0, 0.1 * i, rules, 0);
        EXPECT_LE(*exposure.ev, before);
        EXPECT_GE(*exposure.ev, -5);
    }
    EXPECT_NEAR(*exposure.ev, -5, 1e-12);
}

TEST(Adaptation, TheFirstViewAppliesAtOnceAndDarknessChangesNothing)
{
    const Exposing rules;
    Exposure exposure;
    exposure = adapted(exposure, {}, 0.1, rules, 0);
    EXPECT_FALSE(exposure.ev);
    exposure = adapted(exposure, -4.0, 0.001, rules, 0);
    EXPECT_EQ(exposure.ev, -4.0);
    EXPECT_EQ(adapted(exposure, {}, 100, rules, 0).ev, -4.0);
}

// The greatest exposure, as config/exposing.h derives it, from SI's constants.
TEST(Adaptation, TheGreatestExposureFollowsFromTheEyesThreshold)
{
    const double h = 6.62607015e-34, c = 299792458, k = 1.380649e-23, kelvin = 5772;
    double all = 0, seen = 0;
    for (double nm = 50.5; nm < 1e5; ++nm) {
        const double m = 1e-9 * nm, power = 1 / (std::pow(m, 5) * std::expm1(h * c / (m * k * kelvin)));
        all += power, seen += power * xyz_response(nm).y;
    }
    const double sunlit_cd_m2 = 683 * 1361 * (seen / all) / pi;
    EXPECT_NEAR(sunlit_cd_m2, 39900, 100);
    EXPECT_NEAR(Exposing().max_ev, std::log2(0.18 * sunlit_cd_m2 / 1e-6), 0.5); // rounded to a whole number
}

TEST(Adaptation, KeepsToTheLimitsAndToTheLock)
{
    Exposing rules;
    rules.min_ev = -3, rules.max_ev = 5;
    EXPECT_EQ(adapted({}, -20.0, 1, rules, 0).ev, -3.0);
    EXPECT_EQ(adapted({}, 20.0, 1, rules, 0).ev, 5.0);
    EXPECT_NEAR(*adapted({0.0}, 20.0, 1000, rules, 0).ev, 5, 1e-9);
    EXPECT_EQ(adapted({1.0, 0, true}, 20.0, 1000, rules, 0).ev, 1.0);
}

TEST(Adaptation, TheVisitorsCorrectionIsAdded)
{
    Exposing rules;
    // A start at -3 EV that the visitor has not changed adds nothing.
    EXPECT_EQ(shown_ev({-1.5}, rules, -3, -3), -1.5);
    EXPECT_EQ(shown_ev({-1.5}, rules, -1, -3), 0.5);
    EXPECT_EQ(shown_ev({}, rules, -2, -3), -2) << "before the first metered view";
    EXPECT_EQ(shown_ev({55.0}, rules, 30, 0), 60);
    rules.automatic = false;
    EXPECT_EQ(shown_ev({-1.5}, rules, -2, -3), -2);
}

TEST(Adaptation, AShotHasOneBrightnessLiveAndAsAStill)
{
    const Exposing rules;
    for (double start_ev : {-3.0, 0.0, 2.5})
        for (double metered : {-7.0, 0.0, 1.8, 20.0}) {
            Exposure exposure;
            EXPECT_EQ(shown_ev(exposure, rules, start_ev, start_ev), start_ev);
            for (int frame = 0; frame < 100; ++frame) {
                exposure = adapted(exposure, metered, 0.1, rules, start_ev);
                EXPECT_NEAR(shown_ev(exposure, rules, start_ev, start_ev), start_ev, 1e-12);
            }
            // Light that becomes two stops brighter is shown two stops darker, wherever the start's EV was.
            for (int frame = 0; frame < 100; ++frame)
                exposure = adapted(exposure, metered - 2, 0.1, rules, start_ev);
            EXPECT_NEAR(shown_ev(exposure, rules, start_ev, start_ev), start_ev - 2, 1e-6);
            // A replay knows the adapted EV of each frame alone.
            Exposure again = adapted_to(
                adapted_to(adapted_to({}, {}, rules, start_ev), metered, rules, start_ev), exposure.ev, rules, start_ev);
            EXPECT_NEAR(shown_ev(again, rules, start_ev, start_ev), start_ev - 2, 1e-6);
        }
    // In the dark nothing is anchored: the first light is shown as it is metered.
    Exposure dark = adapted({}, 85.0, 0.1, rules, 0);
    dark = adapted(dark, 20.0, 1000, rules, 0);
    EXPECT_NEAR(shown_ev(dark, rules, 0, 0), 20, 1e-6);
}

TEST(Adaptation, IsDisplayedInEv)
{
    auto exposure_field = [](double ev, bool locked) {
        Readings readings{};
        readings.gamma = readings.doppler_ahead = 1;
        readings.exposure_ev = ev, readings.exposure_locked = locked;
        for (const auto& [label, value] : hud_fields(readings, starbow::testing::words()))
            if (label == "exposure")
                return value;
        return std::string();
    };
    EXPECT_EQ(exposure_field(0.04, false), "0.0 EV");
    EXPECT_EQ(exposure_field(-0.04, false), "0.0 EV");
    EXPECT_EQ(exposure_field(-3.16, false), "−3.2 EV");
    EXPECT_EQ(exposure_field(11.5, true), "+11.5 EV locked");
}

// ---------------------------------------------------------------- the cube map's exposure

// fp16 holds numbers up to 65504. Two stops below that is 16376, which a power of two comes near to within one stop.
TEST(PreExposure, PutsTheBrightestLightTwoStopsBelowTheGreatestHalf)
{
    constexpr double two_stops_below = 16384; // the next power of two, 0.05 % above 65504 / 4
    for (double brightest = 1e-20; brightest < 1e20; brightest *= 3.7) {
        const double factor = pre_exposure(brightest, -90, 1); // so dark an exposure that all light counts
        EXPECT_EQ(std::exp2(std::round(std::log2(factor))), factor) << brightest;
        EXPECT_LE(brightest * factor, two_stops_below) << brightest;
        EXPECT_GT(brightest * factor, two_stops_below / 2) << brightest;
    }
}

// Light that is ten stops over white even where a viewer weakens it most has no part in the scale.
TEST(PreExposure, LeavesOutLightThatIsTenStopsOverWhite)
{
    for (const double ev : {-7.0, 0.0, 5.0})
        for (const double gain : {1.0, 4.0, 4096.0}) {
            const double limit = 1024 / std::exp2(ev) * gain; // shown with `ev` and weakened by `gain`: 1024 times white
            EXPECT_EQ(pre_exposure(1e25, ev, gain), pre_exposure(limit, ev, gain)) << ev << ", " << gain;
            EXPECT_EQ(limit * pre_exposure(1e25, ev, gain), 16384) << ev << ", " << gain;
            EXPECT_EQ(pre_exposure(limit / 2, ev, gain), 2 * pre_exposure(limit, ev, gain)) << ev << ", " << gain;
        }
    EXPECT_GT(pre_exposure(0, 0, 1), 0);
    EXPECT_TRUE(std::isfinite(pre_exposure(0, 0, 1)));
}

// ---------------------------------------------------------------- tone curve

namespace {

/// A colour of full brightness; at saturation 0 it is white.
glm::dvec3 colour_of(double hue_deg, double saturation)
{
    glm::dvec3 colour;
    for (int k = 0; k < 3; ++k) {
        const double away = std::abs(std::remainder(hue_deg - 120 * k, 360.0)) / 60;
        colour[k] = 1 - saturation * std::clamp(away - 1, 0.0, 1.0);
    }
    return colour;
}

/// Lightness and opponent colours by Björn Ottosson, "A perceptual color space for image processing" (2020).
glm::dvec3 oklab(const glm::dvec3& c)
{
    const double l = std::cbrt(0.4122214708 * c.r + 0.5363325363 * c.g + 0.0514459929 * c.b),
                 m = std::cbrt(0.2119034982 * c.r + 0.6806995451 * c.g + 0.1073969566 * c.b),
                 s = std::cbrt(0.0883024619 * c.r + 0.2817188376 * c.g + 0.6299787005 * c.b);
    return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s, 1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
        0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

double luminance(const glm::dvec3& c) { return glm::dot(c, {0.2126, 0.7152, 0.0722}); }

} // namespace

TEST(ToneCurve, IsLinearBelowItsKnee)
{
    for (int hue = 0; hue < 360; hue += 30)
        for (const double saturation : {0.0, 0.5, 1.0})
            for (double ev = -40; ev < std::log2(0.76); ev += 0.25) {
                const glm::dvec3 light = colour_of(hue, saturation) * std::exp2(ev), shown = tone_float::tone_map(light);
                EXPECT_LT(glm::distance(light, shown), 4 * 0x1p-24 * std::exp2(ev)) << hue; // four roundings
            }
    EXPECT_EQ(tone_float::tone_map({0, 0, 0}), glm::vec3(0));
}

// Twelve hues with four saturations over sixteen stops.
TEST(ToneCurve, GoesToWhiteAndKeepsTheHue)
{
    double worst = 0, turned_most = 0;
    for (int hue = 0; hue < 360; hue += 30)
        for (const double saturation : {1.0, 0.9, 0.6, 0.3}) {
            double before = 0, chroma_before = 1e9;
            for (double ev = -6; ev <= 10; ev += 1.0 / 16) {
                const glm::dvec3 light = colour_of(hue, saturation) * std::exp2(ev), shown = tone_float::tone_map(light);
                for (int k = 0; k < 3; ++k)
                    ASSERT_TRUE(shown[k] >= 0 && shown[k] <= 1) << hue << " at " << ev;
                EXPECT_GT(luminance(shown), before) << hue << " at " << ev;
                before = luminance(shown);
                const glm::dvec3 of_light = oklab(light), of_shown = oklab(shown);
                // Chroma relative to lightness must never grow.
                const double chroma = std::hypot(of_shown.y, of_shown.z) / of_shown.x;
                EXPECT_LT(chroma, chroma_before + 1e-5) << hue << " at " << ev;
                chroma_before = chroma;
                // Nearly white: 0.02 is twice the least visible difference from white on a good screen.
                if (std::hypot(of_shown.y, of_shown.z) < 0.02)
                    continue;
                const double angle = std::remainder(
                    std::atan2(of_shown.z, of_shown.y) - std::atan2(of_light.z, of_light.y), 2 * 180 * degree);
                worst = std::max(worst, std::abs(angle) / degree);
                turned_most
                    = std::max(turned_most, chroma < 0.5 * std::hypot(of_light.y, of_light.z) / of_light.x ? 1.0 : 0);
            }
            const glm::dvec3 last = tone_float::tone_map(colour_of(hue, saturation) * 1024.0);
            // The last value misses white by one of a screen's 255 steps; near white a step is 2.27 / 255 of the light.
            for (int k = 0; k < 3; ++k)
                EXPECT_GT(last[k], 1 - 1.5 * 2.27 / 255) << hue;
        }
    EXPECT_EQ(turned_most, 1); // the chroma has fallen by more than half
    std::printf("  the hue turns by %.2f degrees at most\n", worst);
    // Side by side, people distinguish hues from about 2 degrees on; the fit of the roots takes half a degree.
    EXPECT_LT(worst, 1);
}

TEST(ToneCurve, AnyLightStaysInRange)
{
    for (const float light : {1e-38f, 1e-10f, 1e10f, 1e30f}) {
        const glm::vec3 shown = tone_float::tone_map({light, 0.5f * light, 0});
        for (int k = 0; k < 3; ++k)
            EXPECT_TRUE(shown[k] >= 0 && shown[k] <= 1) << light;
    }
    EXPECT_NEAR(glm::length(tone_float::tone_map(glm::vec3(1e30f)) - glm::vec3(1)), 0, 1e-6);
}

} // namespace exposure_test
