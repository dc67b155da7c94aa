// The curve that shows everything at once: what it keeps, how it moves, and the tone curve behind it.
#include "runtime/light/range_curve.h"
#include "shaders/tone.h"
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace range_curve_test {

using namespace starbow;

namespace {

using View = std::vector<LuminanceSample>;

/// Clusters of luminances, as a sky, columns and lamps make them.
View some_view(std::mt19937& random)
{
    const auto any = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
    View view;
    for (int cluster = int(any(1, 6)); cluster > 0; --cluster) {
        const double middle = any(-125, 60), wide = any(0.01, 12), weight = std::exp2(any(-14, 0));
        for (int i = int(any(1, 1500)); i > 0; --i)
            view.push_back({float(std::exp2(middle + wide * any(-1, 1))), float(weight * any(0.5, 1))});
    }
    return view;
}

View even(double from, double to, int count = 1000)
{
    View view;
    for (int i = 0; i < count; ++i)
        view.push_back({float(std::exp2(from + (to - from) * (i + 0.5) / count)), 0.001f});
    return view;
}

double srgb_code(double light)
{
    return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

// ---------------------------------------------------------------- the curve of a view

TEST(RangeCurve, RisesEverywhereAndNowhereFasterThanLight)
{
    std::mt19937 random(1);
    for (int trial = 0; trial < 300; ++trial) {
        const View view = some_view(random), stars = trial % 3 == 0 ? some_view(random) : View();
        const RangeCurve curve = *range_curve(view, stars, std::uniform_real_distribution<double>(-60, 60)(random));
        for (std::size_t k = 1; k < curve.shown.size(); ++k) {
            const double slope = curve.shown[k] - curve.shown[k - 1];
            ASSERT_GE(slope, 0.00099) << trial << " knot " << k;
            ASSERT_LE(slope, 1 + 1e-9) << trial << " knot " << k;
        }
    }
}

TEST(RangeCurve, ShowsNearlyTheWholeViewWithinTheRange)
{
    std::mt19937 random(2);
    for (int trial = 0; trial < 300; ++trial) {
        const View view = some_view(random);
        const RangeCurve curve = *range_curve(view, {}, 100);
        double all = 0, dark = 0, over = 0;
        for (const LuminanceSample& sample : view) {
            const double shown = curve.at(std::log2(double(sample.luminance)));
            all += sample.solid_angle_sr;
            dark += shown < range_bottom - 0.3 ? sample.solid_angle_sr : 0; // two stops below the lowest cell
            over += shown > range_top + 0.3 ? sample.solid_angle_sr : 0;
        }
        EXPECT_LT(dark, 0.01 * all) << trial;
        EXPECT_LT(over, 0.01 * all) << trial;
    }
    EXPECT_NEAR(srgb_code(std::exp2(range_bottom)), 13, 0.5); // as range_curve.h says
    EXPECT_NEAR(std::exp2(range_top), 0.76, 1e-4); // the knee
}

TEST(RangeCurve, AViewThatFitsIsShownAsAnEyeSeesIt)
{
    const View view = even(-4, 2);
    const RangeCurve curve = *range_curve(view, {}, -3);
    for (double stops = -4; stops <= 2; stops += 0.25)
        EXPECT_NEAR(curve.at(stops), stops - 3, 0.01) << stops;
    EXPECT_NEAR(curve.stops(), curve.shown_stops(), 0.01);
    // Beyond the range the curve stays at the range's end.
    EXPECT_NEAR(range_curve(view, {}, 9)->at(2), range_top, 0.01);
    EXPECT_NEAR(range_curve(view, {}, -9)->at(2), range_bottom + 5, 0.01);
    EXPECT_NEAR(range_curve(view, {}, -9)->at(-4), range_bottom, 0.05);
}

TEST(RangeCurve, EmptyStopsTakeHardlyAnyRange)
{
    View view = even(-60, -57), lamps = even(2, 5);
    view.insert(view.end(), lamps.begin(), lamps.end());
    const RangeCurve curve = *range_curve(view, {}, 0);
    // 65 stops, of which 6 have light: these six get nearly all.
    EXPECT_GT(curve.at(-57) - curve.at(-60) + curve.at(5) - curve.at(2), 0.55 * (range_top - range_bottom));
    EXPECT_LT(curve.at(1) - curve.at(-56), 0.25 * (range_top - range_bottom));
}

TEST(RangeCurve, ItsScaleEndsWhereNearlyAllLightDoes)
{
    // A ten-thousandth of this view is a stop / 1000 wide: 0.002 of it lie below `low`, 0.001 above `high`.
    const RangeCurve curve = *range_curve(even(-4, 6, 10000), {}, 0);
    EXPECT_NEAR(curve.low, -4 + 0.002 * 10, 0.002);
    EXPECT_NEAR(curve.high, 6 - 0.001 * 10, 0.002);
}

TEST(RangeCurve, ADarkViewHasNone)
{
    EXPECT_FALSE(range_curve({}, {}, 0));
    const View nothing{{0, 1}, {NAN, 1}, {1, 0}, {INFINITY, 1}, {1, NAN}, {-1, 1}};
    EXPECT_FALSE(range_curve(nothing, nothing, 0));
    EXPECT_TRUE(range_goal(nothing, nothing, 0).empty());
    const View star{{1e-6f, 1e-7f}};
    EXPECT_TRUE(range_curve(nothing, star, 0)); // stars alone
}

TEST(RangeCurve, StarsCountBesideAViewThatTheyHardlyFill)
{
    const View dark = even(-20, -16), stars = even(-4, 0, 300);
    View few = stars;
    for (LuminanceSample& star : few)
        star.solid_angle_sr = 1e-7f;
    const RangeCurve with = *range_curve(dark, few, 0), without = *range_curve(dark, {}, 0);
    EXPECT_GT(with.at(0) - with.at(-4), 1.5 * (without.at(0) - without.at(-4)));
    EXPECT_GT(with.high, -3);
}

TEST(RangeCurve, AGoalMakesTheSameCurve)
{
    std::mt19937 random(3);
    for (int trial = 0; trial < 50; ++trial) {
        const View view = some_view(random);
        EXPECT_EQ(curve_of(range_goal(view, {}, 1)), *range_curve(view, {}, 1));
    }
}

// ---------------------------------------------------------------- in time

double fastest(const RangeCurve& a, const RangeCurve& b, double dt_s)
{
    double most = 0;
    for (std::size_t k = 0; k < a.shown.size(); ++k)
        most = std::max(most, std::abs(a.shown[k] - b.shown[k]) / dt_s);
    return most;
}

TEST(RangeFollower, KeepsOrderAndItsSpeedWhateverTheViewDoes)
{
    std::mt19937 random(4);
    RangeFollower now;
    RangeCurve wanted = *range_curve(some_view(random), {}, 0);
    std::optional<RangeCurve> before;
    std::vector<double> speed_before(RANGE_KNOTS, 0);
    double most_speed = 0, most_change = 0;
    constexpr double dt_s = 1 / 120.;
    for (int frame = 0; frame < 2400; ++frame) {
        if (random() % 8 == 0)
            wanted = *range_curve(some_view(random), {}, 0);
        now = advance(now, wanted, dt_s);
        for (std::size_t k = 1; k < now.shown->shown.size(); ++k) {
            const double slope = now.shown->shown[k] - now.shown->shown[k - 1];
            ASSERT_GT(slope, 0) << frame;
            ASSERT_LE(slope, 1 + 1e-9) << frame;
        }
        if (before) {
            most_speed = std::max(most_speed, fastest(*before, *now.shown, dt_s));
            for (std::size_t k = 0; k < speed_before.size(); ++k) {
                const double speed = (now.shown->shown[k] - before->shown[k]) / dt_s;
                if (frame > 2)
                    most_change = std::max(most_change, std::abs(speed - speed_before[k]) / dt_s);
                speed_before[k] = speed;
            }
        }
        before = now.shown;
    }
    std::printf("  at most %.2f stops/s and %.1f stops/s^2\n", most_speed, most_change);
    EXPECT_LE(most_speed, range_stops_per_s + 1e-9);
    EXPECT_LE(most_change, 4 * range_stops_per_s / range_settle_s * 1.02); // frames are no instants
}

// The worst that a view can do to the curve is to turn it round as often as it can. Changes of a tenth of white, from
// extreme to extreme, the darker below 0.8: at most six of them fit into any second.
TEST(RangeFollower, NoViewMakesItFlash)
{
    constexpr double dt_s = 1 / 240.;
    int worst = 0;
    for (double period_s = 0.1; period_s < 1.2; period_s *= 1.1) {
        RangeFollower now;
        const RangeCurve bright = *range_curve(even(-8, -1), {}, 30), dark = *range_curve(even(-30, 30), {}, -30);
        std::vector<std::vector<double>> changes_s(60);
        std::vector<double> extreme(60, 0), way(60, 0);
        for (int frame = 0; frame < 240 * 8; ++frame) {
            const double t = frame * dt_s;
            now = advance(now, std::fmod(t, period_s) < period_s / 2 ? bright : dark, dt_s);
            for (std::size_t i = 0; i < 60; ++i) {
                const double log = now.shown->at(-30 + double(i)), light = std::min(std::exp2(log), 1.0);
                if (frame == 0)
                    extreme[i] = light;
                const double change = light - extreme[i];
                if (way[i] * change > 0 || way[i] == 0) { // goes on
                    if (std::abs(change) >= 0.1 && std::min(light, extreme[i]) < 0.8)
                        changes_s[i].push_back(t), extreme[i] = light, way[i] = change > 0 ? 1 : -1;
                    continue;
                }
                if (std::abs(change) >= 0.1 && std::min(light, extreme[i]) < 0.8)
                    changes_s[i].push_back(t), way[i] = -way[i], extreme[i] = light;
            }
            for (std::size_t i = 0; i < 60; ++i)
                if (way[i] != 0)
                    extreme[i] = way[i] > 0 ? std::max(extreme[i], std::min(std::exp2(now.shown->at(-30 + double(i))), 1.0))
                                            : std::min(extreme[i], std::min(std::exp2(now.shown->at(-30 + double(i))), 1.0));
        }
        for (const std::vector<double>& times : changes_s)
            for (std::size_t a = 0; a < times.size(); ++a) {
                std::size_t b = a;
                while (b < times.size() && times[b] < times[a] + 1)
                    ++b;
                worst = std::max(worst, int(b - a));
            }
    }
    std::printf("  at most %d changes in a second\n", worst);
    EXPECT_LT(worst, 7);
}

TEST(RangeFollower, ArrivesAndStays)
{
    const RangeCurve from = *range_curve(even(-4, 2), {}, 0), to = *range_curve(even(-40, 9), {}, 0);
    RangeFollower now = advance({}, from, 0.1);
    EXPECT_EQ(*now.shown, from); // the first is taken at once
    double before = fastest(*now.shown, to, 1);
    for (int frame = 0; frame < 60 * 8; ++frame) {
        now = advance(now, to, 1 / 60.);
        const double off = fastest(*now.shown, to, 1);
        EXPECT_LE(off, before + 1e-12);
        before = off;
    }
    EXPECT_LT(before, 1e-3);
    EXPECT_EQ(advance(now, to, 0), now);
}

TEST(RangeMode, FollowsGoalsAndStaysWhileLocked)
{
    RangeMode mode;
    EXPECT_TRUE(wants_goal(mode, 0.01));
    const std::vector<double> first = range_goal(even(-4, 2), {}, 0), second = range_goal(even(-40, 9), {}, 0);
    mode = advance(mode, first, 0.01, true); // the first curve is taken under a lock, too
    EXPECT_EQ(*mode.follower.shown, curve_of(first));
    EXPECT_FALSE(wants_goal(mode, 0.1));
    EXPECT_TRUE(wants_goal(mode, range_goal_every_s));
    mode = advance(mode, second, 0.1, true);
    EXPECT_EQ(*mode.follower.shown, curve_of(first));
    mode = advance(mode, {}, 0.1, false);
    EXPECT_NE(*mode.follower.shown, curve_of(first));
    mode.follows_at_once = true; // another world
    EXPECT_TRUE(wants_goal(mode, 0));
    mode = advance(mode, second, 0.1, false);
    EXPECT_EQ(*mode.follower.shown, curve_of(second));
}

// ---------------------------------------------------------------- the tone curve behind it

double luminance(const glm::dvec3& light) { return glm::dot(light, {0.2126, 0.7152, 0.0722}); }

/// Oklab's a and b (Ottosson 2020).
glm::dvec2 oklab_ab(const glm::dvec3& c)
{
    const double l = std::cbrt(0.4122214708 * c.r + 0.5363325363 * c.g + 0.0514459929 * c.b),
                 m = std::cbrt(0.2119034982 * c.r + 0.6806995451 * c.g + 0.1073969566 * c.b),
                 s = std::cbrt(0.0883024619 * c.r + 0.2817188376 * c.g + 0.6299787005 * c.b);
    return {1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s, 0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

TEST(ToneMapInOrder, ShownLuminanceFollowsFromLuminanceAlone)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(0, 1);
    double most_off = 0, most_turn_deg = 0;
    for (int trial = 0; trial < 100000; ++trial) {
        glm::dvec3 light(any(random), any(random), any(random));
        light[random() % 3] *= std::pow(any(random), 6); // many are saturated
        const double wanted = std::exp2(-10 + 16 * any(random));
        light *= wanted / luminance(light);
        const glm::dvec3 shown = tone_double::tone_map_in_order(light), grey = tone_double::tone_map(glm::dvec3(wanted));
        ASSERT_GE(std::min({shown.r, shown.g, shown.b}), 0);
        ASSERT_LE(std::max({shown.r, shown.g, shown.b}), 1 + 1e-9);
        most_off = std::max(most_off, std::abs(luminance(shown) - grey.r));
        if (std::max({light.r, light.g, light.b}) < 0.76) {
            ASSERT_NEAR(glm::length(shown - light), 0, 1e-12);
        }
        const glm::dvec2 before = oklab_ab(light / std::cbrt(wanted)), after = oklab_ab(shown);
        if (glm::length(after) > 0.04) // nearly grey colours have no hue
            most_turn_deg = std::max(most_turn_deg,
                std::abs(std::remainder(std::atan2(before.y, before.x) - std::atan2(after.y, after.x), 2 * 3.14159265358979))
                    * 57.2957795);
    }
    std::printf("  luminance off by at most %.1e; hue turned by at most %.1f degrees\n", most_off, most_turn_deg);
    EXPECT_LT(most_off, 1e-9); // a grey's brightest channel is its luminance
    EXPECT_LT(most_turn_deg, 12);
}

} // namespace
} // namespace range_curve_test
