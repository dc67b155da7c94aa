// Devices over months of use: worn axes, short taps, and several levers.
#include "config/model/angles.h"
#include "input/health.h"
#include "input/lever.h"
#include "input/mapping.h"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace devices_test {

using namespace starbow;

namespace {

constexpr std::int64_t ms = 1'000'000, s = 1000 * ms;
constexpr double two_pi = 2 * pi;

/// An axis of eight bits, a slider and a button, in one report of three bytes.
const Descriptor stick{.fields = {{.usage = {1, 0x30}, .bits = 8, .logical_max = 255},
                           {.usage = {1, 0x36}, .bit_offset = 8, .bits = 8, .logical_max = 255},
                           {.usage = {9, 1}, .bit_offset = 16, .bits = 1, .logical_max = 1}},
    .report_bits = {{0, 24}}};
const Profile profile{.name = "stick",
    .axes = {{.usage = 0x30, .role = AxisRole::nose_right, .dead_zone = 0.1, .curve = 1},
        {.usage = 0x36, .role = AxisRole::throttle, .dead_zone = 0}},
    .buttons = {{1, Switch::stop}}};

struct Hand {
    Mapping mapping{stick, profile};
    DeviceState state;
    void report(std::uint8_t x, std::uint8_t slider, bool button, std::int64_t now_ns)
    {
        const std::array<std::uint8_t, 3> bytes{x, slider, button};
        EXPECT_TRUE(take_report(stick, bytes, now_ns, state));
    }
    /// The controls of a frame, as Hid reads them.
    Controls controls_at(std::int64_t now_ns)
    {
        Controls controls;
        mapping.add(state, now_ns, 0.016, controls);
        state.presses.assign(state.presses.size(), {});
        return controls;
    }
};

} // namespace

TEST(PressHealth, FourButtonsAtOnceAreFingersAndFiveAreNot)
{
    PressHealth health;
    const std::int64_t s = 1'000'000'000;
    EXPECT_TRUE(health.take(4, s));
    EXPECT_FALSE(health.storms(s));
    EXPECT_FALSE(health.take(5, 2 * s));
    EXPECT_TRUE(health.storms(2 * s));
    EXPECT_TRUE(health.take(1, 3 * s + s / 2)) << "a second later";
}

// A hand shakes a stick at most six or seven times a second; a worn track jumps with every report.
TEST(AxisHealthTest, NoiseIsDistinguishedFromShaking)
{
    const auto noisy = [](double hertz, double size, double report_s) {
        AxisHealth health;
        for (double t = 0; t < 3; t += report_s)
            health.take(0.5 + 0.5 * size * std::sin(two_pi * hertz * t), std::int64_t(t * 1e9) + 1);
        return health.noisy(3 * s);
    };
    EXPECT_FALSE(noisy(7, 1, 0.008)); // the fastest that a hand can move, from end to end
    EXPECT_TRUE(noisy(20, 0.2, 0.004));
    EXPECT_FALSE(noisy(50, 0.02, 0.004)); // the last digits of a good sensor
    std::mt19937 random(3);
    std::uniform_real_distribution<double> anywhere(0, 1);
    AxisHealth worn;
    for (int i = 0; i < 250; ++i)
        worn.take(anywhere(random), 4 * ms * i + 1);
    EXPECT_TRUE(worn.noisy(1 * s));
    // After three quiet seconds the axis counts again.
    for (int i = 250; i < 1000; ++i)
        worn.take(0.5, 4 * ms * i);
    EXPECT_TRUE(worn.noisy(3 * s));
    EXPECT_FALSE(worn.noisy(4 * s));
}

TEST(AxisHealthTest, ANoisyAxisIsReportedAndIgnored)
{
    Hand hand;
    for (int i = 0; i < 500; ++i)
        hand.report(i % 2 ? 255 : 128, i % 2 ? 0 : 255, false, 1 + 4 * ms * i);
    EXPECT_EQ(hand.controls_at(2 * s).turn, glm::dvec3(0));
    EXPECT_TRUE(hand.mapping.levers().empty());
    EXPECT_EQ(hand.mapping.troubles(),
        (std::vector<std::string>{"axis X jitters and is left out", "axis slider jitters and is left out"}));
    hand.report(255, 255, false, 2 * s);
    EXPECT_EQ(hand.controls_at(6 * s).turn, glm::dvec3(0, -1, 0));
    EXPECT_EQ(hand.mapping.levers().size(), 1u);
    EXPECT_TRUE(hand.mapping.troubles().empty());
}

// A thing lies on the stick overnight, or its spring has broken.
TEST(AxisHealthTest, AStuckAxisIsReportedAndIgnoredUntilItMoves)
{
    Hand hand;
    hand.report(128, 200, false, 1);
    hand.report(255, 200, false, 1 * s);
    EXPECT_EQ(hand.controls_at(60 * s).turn.y, -1);
    EXPECT_EQ(hand.controls_at(62 * s).turn.y, 0);
    EXPECT_EQ(
        hand.mapping.troubles(), std::vector<std::string>{"axis X is stuck and is left out"}); // a lever may rest anywhere
    EXPECT_EQ(hand.mapping.levers().size(), 1u);
    hand.report(250, 200, false, 63 * s);
    EXPECT_LT(hand.controls_at(63 * s).turn.y, -0.9);
    // A released axis may stay so for ever.
    hand.report(128, 200, false, 64 * s);
    EXPECT_EQ(hand.controls_at(1000 * s).turn.y, 0);
    EXPECT_TRUE(hand.mapping.troubles().empty());
}

TEST(AxisHealthTest, AnAxisOffItsMiddleSincePluggedInIsStuckAfterAMinute)
{
    Hand hand;
    hand.report(0, 0, false, 5 * s);
    EXPECT_EQ(hand.controls_at(6 * s).turn.y, 1);
    EXPECT_EQ(hand.controls_at(66 * s).turn.y, 0);
}

// A visitor goes with the stick tilted, the throttle open and a button down, and the device falls silent.
TEST(DevicesTest, ASilentDeviceCountsForTheNextVisitorOnceItReports)
{
    Hand hand;
    hand.report(0, 200, true, 5 * s);
    const DeviceState before = hand.state;
    const auto read = [&](std::int64_t came_ns) {
        Mapping mapping(stick, profile); // as Hid makes it for other hands
        Controls controls;
        mapping.add(known_since(hand.state, came_ns), 7 * s, 0.016, controls);
        return std::tuple(controls.turn.y, mapping.levers().size(), controls.held, controls.pressed, controls[Switch::stop]);
    };
    EXPECT_EQ(read(-1), std::tuple(1., 1u, true, true, true));
    EXPECT_EQ(read(6 * s), std::tuple(0., 0u, false, false, false)) << "nobody holds it";
    hand.report(0, 200, true, 6 * s + 1);
    EXPECT_EQ(read(6 * s), std::tuple(1., 1u, true, true, true)) << "somebody does";
}

// At ten frames a second a tap may come and go between two frames.
TEST(DevicesTest, NoTapIsTooShort)
{
    Hand hand;
    hand.report(128, 0, false, 1);
    EXPECT_FALSE(hand.controls_at(1)[Switch::stop]);
    hand.report(128, 0, true, 2);
    hand.report(128, 0, false, 3);
    EXPECT_TRUE(hand.controls_at(4)[Switch::stop]);
    EXPECT_FALSE(hand.controls_at(5)[Switch::stop]);
    hand.report(128, 0, true, 6);
    EXPECT_TRUE(hand.controls_at(7)[Switch::stop]);
    hand.report(128, 0, true, 8);
    EXPECT_FALSE(hand.controls_at(9)[Switch::stop]); // held
}

namespace {

/// Two buttons and a hat that rests at 15, in one byte.
const Descriptor grip{.fields
    = {{.usage = {9, 1}, .bits = 1, .logical_max = 1}, {.usage = {9, 2}, .bit_offset = 1, .bits = 1, .logical_max = 1},
        {.usage = {1, 0x39}, .bit_offset = 4, .bits = 4, .logical_max = 7, .null_state = true}},
    .report_bits = {{0, 8}}};
constexpr std::uint8_t let_go = 0xf0, first = 0xf1, second = 0xf2, ahead = 0x00, ahead_right = 0x10, left = 0x60;

/// The controls of the `frames` readings after reports that all come within one frame.
std::vector<Controls> frames_after(
    Mapping& mapping, DeviceState& state, const std::vector<std::uint8_t>& reports, int frames)
{
    for (const std::uint8_t report : reports)
        EXPECT_TRUE(take_report(grip, std::span(&report, 1), 1, state));
    std::vector<Controls> all;
    for (int i = 0; i < frames; ++i) {
        mapping.add(state, 1, 0.1, all.emplace_back());
        state.presses.assign(state.presses.size(), {});
    }
    return all;
}

} // namespace

// Reports come 100 times a second and more, and a frame may take 300 ms. Each press is that of a frame of its own.
TEST(DevicesTest, EveryPressInOneFrameCountsOnce)
{
    Mapping mapping(grip, {.name = "", .buttons = {{1, Switch::doppler}, {2, Switch::overlay}}});
    DeviceState state;
    const auto pressed = [&](const std::vector<std::uint8_t>& reports) {
        std::pair<int, int> count;
        for (const Controls& controls : frames_after(mapping, state, reports, 8))
            count.first += controls[Switch::doppler], count.second += controls[Switch::overlay];
        return count;
    };
    EXPECT_EQ(pressed({let_go}), std::pair(0, 0));
    EXPECT_EQ(pressed({first, let_go, first, let_go}), std::pair(2, 0));
    EXPECT_EQ(pressed({second, let_go, second, let_go, second, let_go, second, let_go, second, let_go}), std::pair(0, 5));
    EXPECT_EQ(pressed({first, first, let_go, first}), std::pair(2, 0)); // the last one is held
    EXPECT_EQ(pressed({first}), std::pair(0, 0));
    EXPECT_EQ(pressed({let_go, first}), std::pair(1, 0)); // let go and pressed again between two readings
    EXPECT_EQ(pressed({let_go}), std::pair(0, 0));
}

// A frame has one switch for both: the second press waits for the next frame.
TEST(DevicesTest, TwoButtonsOfOneRoleInOneFrameAreTwoPresses)
{
    Mapping mapping(grip, {.name = "", .buttons = {{1, Switch::hud}, {2, Switch::hud}}});
    DeviceState state;
    const auto frames = frames_after(mapping, state, {let_go, first | second, let_go}, 3);
    EXPECT_TRUE(frames[0][Switch::hud] && frames[1][Switch::hud]);
    EXPECT_FALSE(frames[2][Switch::hud]);
}

// A loose plug or a broken chip presses everything many times a second; fingers do not.
TEST(DevicesTest, ABurstThatNoHandsMakeIsLeftOut)
{
    const std::vector<std::string> said{"presses come in a burst that no hands make and are left out"};
    const auto presses = [](const Controls& controls) {
        return controls[Switch::home] + controls[Switch::doppler] + controls[Switch::overlay];
    };
    /// Eight buttons in a byte.
    Descriptor box{.report_bits = {{0, 8}}};
    Profile profile{.name = "", .buttons = {{1, Switch::home}, {2, Switch::doppler}, {3, Switch::overlay}}};
    for (int i = 0; i < 8; ++i)
        box.fields.push_back({.usage = {9, std::uint16_t(i + 1)}, .bit_offset = i, .bits = 1, .logical_max = 1});
    struct Player {
        const Descriptor& box;
        Mapping mapping;
        DeviceState state{};
        void report(int buttons, std::int64_t now_ns)
        {
            const std::uint8_t byte = std::uint8_t(buttons);
            EXPECT_TRUE(take_report(box, std::span(&byte, 1), now_ns, state));
        }
        Controls read(std::int64_t now_ns)
        {
            Controls controls;
            mapping.add(state, now_ns, 0.016, controls);
            state.presses.assign(state.presses.size(), {});
            return controls;
        }
    };

    // All buttons at once: no finger, so nothing at all; a second later hands count again.
    Player all{box, {box, profile}};
    all.report(0, 1 * s);
    all.report(0xff, 1 * s + 8 * ms);
    EXPECT_EQ(presses(all.read(1 * s + 16 * ms)), 0);
    EXPECT_EQ(all.mapping.troubles(), said);
    all.report(0, 1 * s + 20 * ms);
    all.report(1, 2 * s + 10 * ms);
    EXPECT_TRUE(all.read(2 * s + 16 * ms)[Switch::home]);
    EXPECT_TRUE(all.mapping.troubles().empty());

    // One button at 500 Hz, and random bits at 125 Hz, read 60 times a second, for ten seconds.
    std::mt19937 random(7);
    for (const int period_ms : {2, 8}) {
        Player one{box, {box, profile}};
        int counted = 0;
        std::int64_t now = 1 * s, frame = now;
        for (one.report(0, now); now < 11 * s; now += period_ms * ms / 2) {
            one.report(period_ms == 2 ? int(now / ms % 2) : int(random() & 0xff), now);
            for (; frame < now; frame += 16 * ms)
                counted += presses(one.read(now));
        }
        EXPECT_LE(counted, 16) << period_ms;
        EXPECT_EQ(one.mapping.troubles(), said) << period_ms;
    }

    // Two fingers as fast as they can, and three buttons pressed together, are hands.
    Player hands{box, {box, profile}};
    int counted = 0;
    hands.report(0, 1);
    for (int i = 0; i < 1000; ++i) { // a press each 36 ms
        hands.report(i % 4 == 0 ? 1 : i % 4 == 2 ? 2 : 0, 1 * s + i * 18 * ms);
        counted += presses(hands.read(1 * s + i * 18 * ms));
    }
    EXPECT_EQ(counted, 500);
    hands.report(0, 30 * s);
    hands.report(7, 30 * s + 8 * ms);
    EXPECT_EQ(presses(hands.read(30 * s + 16 * ms)), 3);
}

TEST(DevicesTest, ATapOfARateLastsAFrame)
{
    Mapping mapping(grip,
        {.name = "", .buttons = {{1, HeldRole::brighter}}, .hat = {.x = AxisRole::push_right, .y = AxisRole::push_up}});
    DeviceState state;
    auto frames = frames_after(mapping, state, {let_go, first, let_go, first, let_go}, 3);
    EXPECT_EQ(frames[0].exposure, 1);
    EXPECT_EQ(frames[1].exposure, 1);
    EXPECT_EQ(frames[2].exposure, 0);
    frames = frames_after(mapping, state, {ahead, let_go, left, let_go, ahead, ahead_right, let_go}, 4);
    EXPECT_EQ(frames[0].push, glm::dvec3(0, 1, 0));
    EXPECT_EQ(frames[1].push, glm::dvec3(-1, 0, 0));
    EXPECT_EQ(frames[2].push, glm::dvec3(1, 1, 0));
    EXPECT_EQ(frames[3].push, glm::dvec3(0));
    frames = frames_after(mapping, state, {left}, 2); // held
    EXPECT_EQ(frames[0].push, glm::dvec3(-1, 0, 0));
    EXPECT_EQ(frames[1].push, glm::dvec3(-1, 0, 0));
}

TEST(LeverTest, TheLeverMovedLastCounts)
{
    LeverChoice choice;
    Lever own{"stick", 3, 0.5, 0}, throttle{"throttle", 0, 0.2, 0};
    const auto place = [&](std::int64_t now) {
        const std::array both{own, throttle};
        return choice.place(both, now);
    };
    EXPECT_EQ(place(1), 0.2); // none has moved yet: the slower one
    own.moved_ns = 5, own.place = 0.6;
    EXPECT_EQ(place(6), 0.6);
    throttle.moved_ns = 7, throttle.place = 0.9;
    EXPECT_EQ(place(8), 0.9);
    EXPECT_EQ(place(9), 0.9);
}

TEST(LeverTest, AnUnpluggedLeverIsNotReplacedByOneThatHasNotMoved)
{
    LeverChoice choice;
    const Lever slider{"stick", 3, 1.0, 4};
    Lever throttle{"throttle", 0, 0.3, 6};
    EXPECT_EQ(choice.place(std::array{slider, throttle}, 10), 0.3);
    EXPECT_FALSE(choice.place(std::array{slider}, 20)); // coasts
    EXPECT_FALSE(choice.place(std::array{slider}, 30));
    throttle.moved_ns = 0; // plugged in again, and not moved yet
    EXPECT_EQ(choice.place(std::array{slider, throttle}, 40), 0.3);
    EXPECT_EQ(choice.place(std::array{slider, throttle}, 50), 0.3);
    EXPECT_FALSE(choice.place(std::array{slider}, 60));
    Lever moved = slider;
    moved.moved_ns = 70;
    EXPECT_EQ(choice.place(std::array{moved}, 71), 1.0); // taken in hand
    EXPECT_EQ(choice.place(std::array{moved, throttle}, 72), 1.0);
    EXPECT_FALSE(LeverChoice().place({}, 1));
}

} // namespace devices_test
