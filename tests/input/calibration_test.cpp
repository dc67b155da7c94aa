// The evaluation of a calibration's samples, and the profile made from them. The axes of these tests are artificial.
#include "input/calibration.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace calibration_test {

using namespace starbow;
using namespace starbow::testing;
using Rest = AxisMeasure::Rest;

namespace {

Field axis(std::uint16_t page, std::uint16_t usage, std::int64_t low, std::int64_t high)
{
    return {.usage = {page, usage}, .bits = 16, .logical_min = low, .logical_max = high};
}

/// A stick's X, Y, twist and slider, each of 0 to 1000, then a trigger (accelerator) of 0 to 255.
Descriptor stick()
{
    Descriptor descriptor;
    descriptor.applications = {{1, 4}};
    descriptor.fields = {axis(1, 0x30, 0, 1000), axis(1, 0x31, 0, 1000), axis(1, 0x35, 0, 1000), axis(1, 0x36, 0, 1000),
        axis(2, 0xc4, 0, 255)};
    return descriptor;
}

DeviceState state_of(const std::vector<std::int64_t>& raw)
{
    DeviceState state;
    state.raw.assign(raw.begin(), raw.end());
    return state;
}

/// The samples of one axis.
SeenAxis seen(std::vector<std::int64_t> before, std::vector<std::int64_t> moved, std::vector<std::int64_t> after = {})
{
    std::vector<SeenAxis> axes{{.field = 0, .usage = 0x30}};
    for (const auto raw : before)
        take_rest(state_of({raw}), 0, axes);
    for (const auto raw : moved)
        take_ends(state_of({raw}), axes);
    for (const auto raw : after)
        take_rest(state_of({raw}), 1, axes);
    return axes[0];
}

/// The stick after every axis was moved to its ends: X is noisy, Y moved from end to end, and the slider stays elsewhere.
std::vector<SeenAxis> moved_stick(const Descriptor& descriptor)
{
    std::vector<SeenAxis> axes = axes_of(descriptor);
    for (const std::int64_t x : {490, 510, 500, 495, 505})
        take_rest(state_of({x, 500, 520, 1000, 0}), 0, axes);
    take_ends(state_of({20, 40, 0, 0, 0}), axes);
    take_ends(state_of({980, 900, 1000, 1000, 255}), axes);
    take_rest(state_of({500, 500, 520, 200, 0}), 1, axes);
    return axes;
}

const AxisUse& with(const Profile& profile, AxisRole role)
{
    for (const AxisUse& use : profile.axes)
        if (use.role == role)
            return use;
    throw std::runtime_error("no such role");
}

const Field thousand = axis(1, 0x30, 0, 1000);

} // namespace

TEST(CalibrationTest, AxesHaveTheNamesOfProfiles)
{
    Descriptor descriptor = stick();
    descriptor.fields.push_back(axis(1, 0x36, 0, 1000)); // a second slider
    descriptor.fields.push_back(
        {.usage = {1, 0x32}, .bits = 1, .logical_max = 1}); // a field of one bit is a button, whatever its usage
    descriptor.fields.push_back({.usage = {9, 1}, .bits = 1, .logical_max = 1});
    descriptor.fields.push_back({.usage = {1, 0x39}, .bits = 4, .logical_max = 7}); // the hat
    const auto axes = axes_of(descriptor);
    ASSERT_EQ(axes.size(), 6u);
    EXPECT_EQ(axes[5].usage, 0x36);
    EXPECT_EQ(axes[5].nth, 1);
    EXPECT_EQ(describe(axes[5]), "slider 2");
    EXPECT_EQ(axis_of({.usage = 0x36, .nth = 1}, axes), 5u);
    EXPECT_FALSE(axis_of({.usage = 0x32}, axes));
}

TEST(CalibrationTest, TheMiddleIsWhereItRestsAndTheNoiseTheFurthestFromThere)
{
    const AxisMeasure is = measured(seen({440, 450, 452, 450, 449}, {50, 960}, {455, 455}), thousand);
    EXPECT_TRUE(is.moved);
    EXPECT_EQ(is.low, 50);
    EXPECT_EQ(is.high, 960);
    EXPECT_EQ(is.rests, Rest::middle);
    EXPECT_EQ(is.middle, 450);
    EXPECT_EQ(is.noise, 10);
    // It comes back from the other side 30 short, which is part of the middle's play.
    EXPECT_GE(measured(seen({450, 450, 450}, {50, 960}, {480}), thousand).noise, 30);
    EXPECT_TRUE(kept_still({440, 450, 452}, thousand));
    EXPECT_FALSE(kept_still({440, 600}, thousand));
    EXPECT_TRUE(kept_still({}, thousand));
    EXPECT_TRUE(kept_still({1, 2}, axis(1, 0x30, 1, 3))); // a pad's cross: one step is noise
}

TEST(CalibrationTest, AxesThatDidNotMoveAreLeftAsTheyWere)
{
    EXPECT_FALSE(measured(seen({500}, {500}), thousand).moved); // never moved, or stuck
    EXPECT_FALSE(measured(seen({500}, {450, 560}), thousand).moved); // shaken by a movement of another axis
    EXPECT_FALSE(measured(seen({}, {}), thousand).moved); // it never had a value
    EXPECT_FALSE(measured(seen({5}, {5}), axis(1, 0x30, 5, 5)).moved); // its range is empty
    EXPECT_TRUE(measured(seen({500}, {400, 600}), thousand).moved);
    // In the profile such an axis keeps its old range and dead zone.
    const Descriptor descriptor = stick();
    auto axes = axes_of(descriptor);
    Profile present;
    present.axes = {{.usage = 0x30, .role = AxisRole::nose_right, .dead_zone = 0.11, .range = std::array{1.0, 2.0, 3.0}},
        {.usage = 0x99, .role = AxisRole::look_up}};
    for (int i = 0; i < 3; ++i)
        take_rest(state_of({500, 500, 500, 500, 0}), 0, axes);
    take_ends(state_of({510, 500, 500, 500, 0}), axes);
    EXPECT_EQ(calibrated(present, descriptor, axes, {}).axes, present.axes);
}

TEST(CalibrationTest, AnAxisWithoutASpringHasItsMiddleBetweenItsEnds)
{
    const AxisMeasure is = measured(seen({990, 991, 990}, {10, 1000}, {200, 200}), thousand);
    EXPECT_EQ(is.rests, Rest::anywhere);
    EXPECT_EQ(is.middle, 505);
    EXPECT_EQ(is.noise, 1);
    // The usages of a slider, a dial and a throttle say so, even if it was put back to its first place; those of a stick's
    // axis and of a pedal do not.
    const auto rests = [](std::uint16_t page, std::uint16_t usage) {
        SeenAxis axis = seen({100}, {0, 1000}, {100});
        axis.page = page, axis.usage = usage;
        return measured(axis, thousand);
    };
    for (const auto& [page, usage] : {std::pair(1, 0x36), {1, 0x37}, {2, 0xbb}}) {
        EXPECT_EQ(rests(std::uint16_t(page), std::uint16_t(usage)).rests, Rest::anywhere) << usage;
        EXPECT_EQ(rests(std::uint16_t(page), std::uint16_t(usage)).middle, 500) << usage;
    }
    for (const auto& [page, usage] : {std::pair(1, 0x35), {1, 0x38}, {2, 0x36}, {2, 0xc4}})
        EXPECT_NE(rests(std::uint16_t(page), std::uint16_t(usage)).rests, Rest::anywhere) << usage;
}

TEST(CalibrationTest, AnAxisThatRestsAtAnEndIsAPedal)
{
    EXPECT_EQ(measured(seen({3, 5}, {0, 1000}, {4}), thousand).rests, Rest::low_end);
    EXPECT_EQ(measured(seen({1000}, {0, 1000}, {990}), thousand).rests, Rest::high_end);

    const Descriptor descriptor = stick();
    const auto axes = moved_stick(descriptor);
    const Field& pedal = descriptor.fields[4];
    // A trigger gives 0 when released, in whichever direction it was pulled or described.
    for (const bool to_high : {true, false}) {
        const Profile profile = calibrated({}, descriptor, axes, {{{AxisRole::faster, Push{4, to_high, 1}}}, {}});
        EXPECT_EQ(shaped(with(profile, AxisRole::faster), pedal, 0), 0);
        EXPECT_EQ(shaped(with(profile, AxisRole::faster), pedal, 255), 1);
    }
    // On a control with two sides it moves one side.
    for (const bool to_high : {true, false}) {
        const Profile profile = calibrated({}, descriptor, axes, {{{AxisRole::roll_right, Push{4, to_high, 1}}}, {}});
        EXPECT_EQ(shaped(with(profile, AxisRole::roll_right), pedal, 0), 0);
        EXPECT_EQ(shaped(with(profile, AxisRole::roll_right), pedal, 255), to_high ? 1 : -1);
        EXPECT_NEAR(std::abs(shaped(with(profile, AxisRole::roll_right), pedal, 128)), 0.32,
            0.01); // (0.502 - 0.03) / 0.97, to the 1.6th
    }
}

TEST(CalibrationTest, TheMovedAxisIsFoundWithItsDirection)
{
    const Descriptor descriptor = stick();
    const auto axes = moved_stick(descriptor);
    const DeviceState rest = state_of({500, 500, 520, 200, 0});
    const auto found = [&](const std::vector<std::int64_t>& raw) { return pushed(descriptor, axes, rest, state_of(raw)); };
    EXPECT_TRUE(found({505, 495, 520, 200, 0}).empty());
    EXPECT_TRUE(found({600, 500, 520, 200, 0}).empty()); // less than half of the way
    auto one = found({30, 560, 520, 200, 0});
    ASSERT_EQ(one.size(), 1u);
    EXPECT_EQ(one[0].axis, 0u);
    EXPECT_FALSE(one[0].to_high);
    one = found({500, 880, 700, 200, 0});
    ASSERT_EQ(one.size(), 1u);
    EXPECT_EQ(one[0].axis, 1u);
    EXPECT_TRUE(one[0].to_high);
    EXPECT_EQ(found({960, 880, 520, 200, 0}).size(), 2u); // pulled aslant
    // A slider near its end that trembles is no push, however short the rest of its way is.
    EXPECT_TRUE(pushed(descriptor, axes, state_of({500, 500, 520, 5, 0}), state_of({500, 500, 520, 0, 0})).empty());
    // An axis without a value has not moved.
    EXPECT_TRUE(pushed(descriptor, axes, {}, state_of({0, 0, 0, 0, 0})).empty());
}

TEST(CalibrationTest, TheProfileHasTheChosenRolesAndMeasuredRanges)
{
    const Descriptor descriptor = stick();
    const auto axes = moved_stick(descriptor);
    Profile present = usual_profile(descriptor);
    present.axes[0].curve = 2;
    const Chosen chosen{{{AxisRole::nose_up, Push{1, false, 1}}, {AxisRole::nose_right, Push{0, true, 1}},
                            {AxisRole::roll_right, {}}, {AxisRole::throttle, Push{3, false, 1}}},
        {{Switch::stop, 4}, {Switch::undo, {}}}};
    const Profile profile = calibrated(present, descriptor, axes, chosen);
    const AxisUse &up = with(profile, AxisRole::nose_up), &right = with(profile, AxisRole::nose_right),
                  &lever = with(profile, AxisRole::throttle);
    // The control is now full where the hand was during the step.
    EXPECT_EQ(shaped(up, descriptor.fields[1], 40), 1);
    EXPECT_EQ(shaped(up, descriptor.fields[1], 900), -1);
    EXPECT_EQ(shaped(right, descriptor.fields[0], 980), 1);
    EXPECT_EQ(shaped(right, descriptor.fields[0], 20), -1);
    EXPECT_EQ(shaped(lever, descriptor.fields[3], 0), 1);
    EXPECT_EQ(shaped(lever, descriptor.fields[3], 1000), 0);
    EXPECT_NEAR(shaped(lever, descriptor.fields[3], 500), 0.5, 1e-12);
    // Released it gives 0, with all its noise. Y's upper side is the shorter one.
    for (int x = 490; x <= 510; ++x)
        EXPECT_EQ(shaped(right, descriptor.fields[0], x), 0) << x;
    EXPECT_EQ(right.dead_zone, 0.032); // 10 of 480, one and a half times: 0.03125, rounded up
    EXPECT_EQ(right.curve, 2);
    EXPECT_EQ(up.dead_zone, 0.03); // the least dead zone without noise
    EXPECT_EQ(up.range, (std::array{40.0, 500.0, 900.0}));
    // The twist was moved but has no role; it keeps its range for a later role. So does the pedal, whose throttle role went
    // to the slider.
    EXPECT_THROW(with(profile, AxisRole::roll_right), std::runtime_error);
    const auto twist
        = std::find_if(profile.axes.begin(), profile.axes.end(), [](const AxisUse& u) { return u.usage == 0x35; });
    ASSERT_NE(twist, profile.axes.end());
    EXPECT_EQ(twist->role, AxisRole::none);
    EXPECT_EQ(twist->range, (std::array{0.0, 520.0, 1000.0}));
    EXPECT_EQ(std::count_if(
                  profile.axes.begin(), profile.axes.end(), [](const AxisUse& u) { return u.role == AxisRole::throttle; }),
        1);
    // In the usual profile button 1 stopped, 3 went ten seconds back and 4 was the Doppler effect; 9 is still the menu.
    EXPECT_EQ(profile.buttons,
        (std::vector<ButtonUse>{{2, Switch::home}, {4, Switch::stop}, {5, Switch::headlight}, {6, Switch::aberration},
            {7, Switch::hud}, {8, Switch::next_mode}, {9, Switch::menu}}));
    EXPECT_EQ(profile.hat.x, AxisRole::look_right);
    // Another calibration that keeps the roles gives the same.
    EXPECT_EQ(calibrated(profile, descriptor, axes, {}).axes, profile.axes);
}

TEST(CalibrationTest, TwoTriggersOnOneAxisEachHaveAHalf)
{
    const Descriptor descriptor = stick();
    const auto axes = moved_stick(descriptor);
    const Chosen chosen{{{AxisRole::faster, Push{1, false, 1}}, {AxisRole::slower, Push{1, true, 1}}}, {}};
    const Profile profile = calibrated({}, descriptor, axes, chosen);
    const Field& field = descriptor.fields[1];
    for (const auto& [raw, throttle_rate, slower] :
        std::vector<std::array<double, 3>>{{40, 1, 0}, {500, 0, 0}, {900, 0, 1}, {270, 0.5, 0}}) {
        EXPECT_NEAR(shaped(with(profile, AxisRole::faster), field, std::int64_t(raw)), throttle_rate, 1e-12) << raw;
        EXPECT_NEAR(shaped(with(profile, AxisRole::slower), field, std::int64_t(raw)), slower, 1e-12) << raw;
    }
    EXPECT_EQ(calibrated(profile, descriptor, axes, {}).axes, profile.axes);
}

// A profile's range may run from high to low; a new measurement must keep the axis's direction.
TEST(CalibrationTest, ARangeThatRunsDownwardsKeepsItsDirection)
{
    const Descriptor descriptor = stick();
    const auto axes = moved_stick(descriptor);
    for (const bool inverted : {false, true}) {
        Profile present;
        present.axes
            = {{.usage = 0x31, .role = AxisRole::nose_up, .inverted = inverted, .range = std::array{990.0, 500.0, 10.0}}};
        const Profile profile = calibrated(present, descriptor, axes, {});
        for (const std::int64_t raw : {40, 900})
            EXPECT_EQ(shaped(with(profile, AxisRole::nose_up), descriptor.fields[1], raw) > 0,
                shaped(present.axes[0], descriptor.fields[1], raw) > 0);
    }
}

// Any samples make a profile that can be read back.
TEST(CalibrationTest, AnySamplesMakeAProfileThatLoads)
{
    std::mt19937 random(7);
    for (int round = 0; round < 300; ++round) {
        Descriptor descriptor;
        const std::vector<std::pair<std::int64_t, std::int64_t>> kinds{
            {0, 1}, {-1, 1}, {0, 3}, {0, 255}, {-32768, 32767}, {0, 4294967295}, {-2147483648, 2147483647}, {5, 5}, {9, 2}};
        for (int i = 0; i < 70; ++i) {
            const auto& [low, high] = kinds[random() % kinds.size()];
            descriptor.fields.push_back(axis(1, std::uint16_t(0x30 + random() % 8), low, high));
        }
        auto axes = axes_of(descriptor);
        const auto any = [&] {
            DeviceState state;
            for (const Field& field : descriptor.fields) {
                const std::int64_t low = std::min(field.logical_min, field.logical_max),
                                   way = std::abs(field.logical_max - field.logical_min);
                state.raw.push_back(std::vector<std::optional<std::int64_t>>{
                    {}, low, low + way, low + way / 2, low + std::int64_t(random()) % (way + 1)}[random() % 5]);
            }
            return state;
        };
        for (int i = 0; i < 3; ++i) {
            take_rest(any(), 0, axes);
            take_ends(any(), axes);
            take_rest(any(), 1, axes);
        }
        Chosen chosen;
        for (const AxisRole role : {AxisRole::nose_up, AxisRole::faster, AxisRole::slower, AxisRole::throttle})
            for (const Push& push : pushed(descriptor, axes, any(), any()))
                chosen.axes.push_back({role, push});
        Profile profile = calibrated({}, descriptor, axes, chosen);
        profile.name = "any";
        profile.axes.resize(std::min<std::size_t>(profile.axes.size(), 64));
        const auto file = scratch("calibrated.json");
        save_profile(profile, file);
        EXPECT_EQ(load_profile(file).axes, profile.axes);
    }
}

} // namespace calibration_test
