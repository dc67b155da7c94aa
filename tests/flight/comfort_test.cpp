// Comfort: whatever the hands do, there is no roll, the horizon stays level, and steps are whole.
#include "config/model/angles.h"
#include "config/model/scene_file.h"
#include "config/model/shipped.h"
#include "runtime/flight/comfort.h"
#include "runtime/flight/flight.h"
#include "runtime/flight/record.h"
#include "tests/support/controls.h"
#include "tests/support/files.h"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace comfort_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

constexpr std::int64_t frame_ns = 16'000'000;
constexpr double pitch_limit_deg = 75;
constexpr FlightMode all_modes[] = {FlightMode::guided, FlightMode::free, FlightMode::newtonian};

/// Hands that change their mind about once a second, and now and then ask for the way home.
struct Hands {
    std::mt19937 random;
    Controls controls{};

    explicit Hands(unsigned seed)
        : random(seed)
    {
    }
    double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random); }
    Controls next()
    {
        if (uniform(0, 1) < 0.016) {
            controls.turn = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
            controls.lever = uniform(0, 1);
            controls.push = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
        }
        controls.set(Switch::home, uniform(0, 1) < 0.001);
        controls.set(Switch::undo, false);
        controls.look_rad = {uniform(-0.05, 0.05), uniform(-0.05, 0.05)};
        controls.set(Switch::look_ahead, uniform(0, 1) < 0.01);
        return controls;
    }
};

struct Flown {
    SceneFile scene = load_scene_file(shipped_file("scenes", "avenue"));
    Flying rules{.max_gamma = 100};
    Shot start = scene.start;
    Flight flight;

    Flown(FlightMode mode, const Comfort& comfort)
    {
        rules.mode = mode, rules.boundary = scene.boundary, rules.comfort = comfort;
        start.ship_from_cockpit = orientation({1, 0.3, -2}, {0.4, 1, 0}); // tilted
        begin();
    }
    void begin() { flight = flight_at(start, rules); }
    void fly(const Controls& controls, std::int64_t dt_ns = frame_ns)
    {
        flight = step(flight, controls, dt_ns, rules, scene.seconds_per_time_unit(), start);
    }
};

/// The angle between the right axis and the horizon, radians.
double tilt(const glm::dquat& cockpit)
{
    const glm::dvec3 right = cockpit * glm::dvec3(1, 0, 0);
    return std::atan2(right.y, std::hypot(right.x, right.z));
}
double pitch_deg(const glm::dquat& cockpit)
{
    const glm::dvec3 nose = cockpit * glm::dvec3(0, 0, -1);
    return std::atan2(nose.y, std::hypot(nose.x, nose.z)) / degree;
}
double angle_deg(const glm::dquat& a, const glm::dquat& b)
{
    const glm::dquat turn = glm::conjugate(a) * b;
    return 2 * std::atan2(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), std::abs(turn.w)) / degree;
}

} // namespace

TEST(ComfortTest, TheHorizonStaysLevelWhateverHandsDo)
{
    int homings = 0, turns = 0;
    double steepest = 0, most_tilt_without = 0;
    for (const FlightMode mode : all_modes)
        for (unsigned seed = 0; seed < 12; ++seed) {
            const double step_deg = seed % 3 == 0 ? 15 : 0;
            Flown level(mode, {.level_horizon = true, .turn_steps_deg = step_deg}), usual(mode, {});
            Hands hands(seed);
            EXPECT_GT(std::abs(tilt(usual.flight.ship.ship_from_cockpit)), 0.1);
            for (int i = 0; i < 60 / 0.016; ++i) {
                const bool homing = level.flight.homing.has_value(), homeward = level.flight.homeward;
                const Controls controls = hands.next();
                level.fly(controls), usual.fly(controls);
                homings += !homing && level.flight.homing, turns += !homeward && level.flight.homeward;
                const glm::dquat& cockpit = level.flight.ship.ship_from_cockpit;
                ASSERT_LT(std::abs(tilt(cockpit)), 1e-9) << seed << ' ' << i;
                ASSERT_GT((cockpit * glm::dvec3(0, 1, 0)).y, 0);
                ASSERT_LT(std::abs(pitch_deg(cockpit)), pitch_limit_deg + 1e-9);
                const glm::dquat seen = shot_of(level.flight, "", level.rules.comfort).ship_from_cockpit;
                ASSERT_LT(std::abs(tilt(seen)), 1e-9) << "looking around";
                steepest = std::max(steepest, std::abs(pitch_deg(cockpit)));
                most_tilt_without = std::max(most_tilt_without, std::abs(tilt(usual.flight.ship.ship_from_cockpit)));
            }
        }
    EXPECT_GT(homings, 20);
    EXPECT_GT(turns, 2) << "at the world's end";
    EXPECT_GT(steepest, pitch_limit_deg - 0.01);
    EXPECT_GT(most_tilt_without, 1);
}

TEST(ComfortTest, TheWayHomeEndsAtTheLevelStartToTheBit)
{
    for (const FlightMode mode : all_modes)
        for (const double step_deg : {0.0, 15.0}) {
            Flown level(mode, {.level_horizon = true, .turn_steps_deg = step_deg});
            Hands hands(3);
            for (int i = 0; i < 10 / 0.016; ++i) {
                Controls controls = hands.next();
                controls.set(Switch::home, false), controls.set(Switch::look_ahead, false);
                level.fly(controls);
            }
            level.fly(controls_with(Switches{Switch::home}));
            for (int i = 0; i < 60 / 0.016 && level.flight.homing; ++i)
                level.fly({});
            ASSERT_FALSE(level.flight.homing);
            const glm::dquat reached = level.flight.ship.ship_from_cockpit;
            level.begin();
            EXPECT_EQ(reached, level.flight.ship.ship_from_cockpit);
            EXPECT_NEAR(angle_between(reached * glm::dvec3(0, 0, -1), level.start.ship_from_cockpit * glm::dvec3(0, 0, -1)),
                0, 1e-12)
                << "with the start's own nose";
        }
}

TEST(ComfortTest, ACockpitKeepsItsHeadingAtThePole)
{
    for (double heading = -3; heading <= 3; heading += 0.25)
        for (const double pitch : {-pi / 2, -pi / 2 + 1e-8, -1.0, 0.3, pi / 2 - 1e-8, pi / 2}) {
            const Aim aim = aim_of(level_cockpit({heading, pitch}));
            // 1e-8 radians before the pole the nose leaves 8 digits of the heading, and the right axis has all.
            EXPECT_NEAR(std::remainder(aim.heading - heading, 2 * pi), 0, 1e-7) << heading << ' ' << pitch;
            EXPECT_NEAR(aim.pitch, pitch, 2e-8) << heading << ' ' << pitch;
        }
}

TEST(ComfortTest, APitchEndsSoftlyBeforeThePole)
{
    // The limits of the shipped headset: its stick stops the turn long after it is let go.
    Flown level(FlightMode::guided, {.level_horizon = true});
    level.rules.turn_deg_per_s = 12, level.rules.turn_jerk_deg_per_s3 = 60;
    level.start.ship_from_cockpit = orientation({0, 0, -1}, {0, 1, 0});
    level.begin();
    std::vector<double> pitches;
    for (int i = 0; i < 20'000; ++i) {
        level.fly(controls_with(Steering{.turn = {1, 0, 0}}), tick_ns);
        pitches.push_back(pitch_deg(level.flight.ship.ship_from_cockpit));
    }
    EXPECT_NEAR(pitches.back(), pitch_limit_deg, 1e-6);
    double most_rate = 0, most_jerk = 0;
    for (std::size_t i = 50; i < pitches.size(); i += 1) {
        most_rate = std::max(most_rate, std::abs(pitches[i] - pitches[i - 1]) / tick_s);
        if (i >= 150) { // third differences over 50 ticks, above the rounding
            constexpr double dt = 50 * tick_s;
            most_jerk = std::max(most_jerk,
                std::abs(pitches[i] - 3 * pitches[i - 50] + 3 * pitches[i - 100] - pitches[i - 150]) / (dt * dt * dt));
        }
    }
    EXPECT_LE(most_rate, 12 + 1e-6);
    EXPECT_GT(most_rate, 11.5);
    EXPECT_LE(most_jerk, 1.01 * 60);
}

TEST(ComfortTest, AYawIsAboutTheVerticalAsFastAsTheStickSays)
{
    Flown level(FlightMode::guided, {.level_horizon = true});
    level.start.ship_from_cockpit = orientation({0, std::tan(60 * degree), -1}, {0, 1, 0});
    level.begin();
    for (int i = 0; i < 3'000; ++i)
        level.fly(controls_with(Steering{.turn = {0, 1, 0}}), tick_ns);
    const glm::dquat before = level.flight.ship.ship_from_cockpit;
    for (int i = 0; i < 1'000; ++i)
        level.fly(controls_with(Steering{.turn = {0, 1, 0}}), tick_ns);
    const glm::dquat after = level.flight.ship.ship_from_cockpit;
    const glm::dquat expected = glm::angleAxis(40 * degree, glm::dvec3(0, 1, 0)) * before;
    EXPECT_LT(angle_deg(after, expected), 1e-6);
}

TEST(ComfortTest, WithoutRollTheRollOfAHandDoesNothingToTheBit)
{
    for (const FlightMode mode : all_modes)
        for (unsigned seed = 0; seed < 8; ++seed) {
            const Comfort comfort{.no_roll = true, .turn_steps_deg = seed % 2 == 0 ? 15.0 : 0.0};
            Flown rolled(mode, comfort), still(mode, comfort), usual(mode, {.turn_steps_deg = comfort.turn_steps_deg});
            Hands hands(seed);
            for (int i = 0; i < 30 / 0.016; ++i) {
                Controls controls = hands.next();
                if (i % 500 == 250)
                    controls.set(Switch::freeze);
                rolled.fly(controls), usual.fly(controls);
                controls.turn.z = 0;
                still.fly(controls);
                ASSERT_EQ(digest(rolled.flight), digest(still.flight)) << seed << ' ' << i;
                ASSERT_EQ(rolled.flight.turn_rad_s.z, 0);
            }
            EXPECT_NE(digest(rolled.flight), digest(usual.flight));
        }
    // Nor does it end a start in flight.
    Flown coasts(FlightMode::guided, {.no_roll = true});
    coasts.start.u = {0, 0, -1};
    coasts.begin();
    coasts.fly(controls_with(Steering{.turn = {0, 0, 1}}));
    EXPECT_TRUE(coasts.flight.coasting);
}

TEST(ComfortTest, StepsAreWholeAndTheirNumberIsThatOfTheTimeTheStickIsHeld)
{
    for (const FlightMode mode : all_modes)
        for (int axis = 0; axis < 2; ++axis)
            for (const double way : {-1.0, 1.0}) {
                Flown steps(mode, {.turn_steps_deg = 15});
                const glm::dquat from = steps.flight.ship.ship_from_cockpit;
                Steering held;
                held.turn[axis] = 0.6 * way;
                glm::dvec3 about(0);
                about[axis] = way;
                for (int ms = 0; ms < 2'700; ++ms) {
                    steps.fly(controls_with(held), tick_ns);
                    const int expected = ms / 400 + 1;
                    ASSERT_LT(
                        angle_deg(steps.flight.ship.ship_from_cockpit, from * glm::angleAxis(expected * 15 * degree, about)),
                        1e-10)
                        << ms;
                }
                // Let go, and held less than half: nothing turns, to the bit.
                const glm::dquat rests = steps.flight.ship.ship_from_cockpit;
                held.turn[axis] = 0.45 * way;
                for (int ms = 0; ms < 1'000; ++ms)
                    steps.fly(controls_with(held), tick_ns);
                EXPECT_EQ(steps.flight.ship.ship_from_cockpit, rests);
            }
}

TEST(ComfortTest, InFlightAndOnTheWayHomeNothingTurnsBetweenSteps)
{
    for (const FlightMode mode : all_modes)
        for (unsigned seed = 0; seed < 6; ++seed) {
            Flown steps(mode, {.level_horizon = true, .turn_steps_deg = 15});
            Hands hands(seed);
            int whole = 0;
            std::int64_t since = 1'000;
            for (int i = 0; i < 30 / 0.016; ++i) {
                const Controls controls = hands.next();
                for (int ms = 0; ms < 16; ++ms) {
                    const bool homing = steps.flight.homing.has_value(), homeward = steps.flight.homeward;
                    const glm::dquat before = steps.flight.ship.ship_from_cockpit;
                    Controls now = controls;
                    now.set(Switch::home, controls[Switch::home] && ms == 0);
                    steps.fly(now, tick_ns);
                    const double turned = angle_deg(before, steps.flight.ship.ship_from_cockpit);
                    ++since;
                    // A thrust across the flight carries the axes along by some hundredths of a degree in a tick.
                    if (turned < 0.15)
                        continue;
                    const bool arrives = homing && !steps.flight.homing;
                    ASSERT_LE(turned, 15.15);
                    ASSERT_GE(since, arrives ? 0 : 390) << name_of(mode) << seed;
                    since = 0;
                    if (homing || homeward)
                        continue;
                    ++whole;
                    ASSERT_NEAR(turned, 15, 0.15);
                }
            }
            EXPECT_GT(whole, 5);
        }
}

TEST(ComfortTest, AtTheWorldsEndStepsLeadTheNoseToTheStart)
{
    for (const bool level : {false, true}) {
        Flown steps(FlightMode::guided, {.level_horizon = level, .turn_steps_deg = 15});
        steps.start = steps.scene.start;
        steps.begin();
        while (!steps.flight.homeward)
            steps.fly(controls_with(Steering{.lever = 1.0}));
        double time_s = 0;
        for (; steps.flight.homeward && time_s < 30; time_s += 1e-9 * frame_ns)
            steps.fly(controls_with(Steering{.lever = 1.0, .turn = {1, -1, 0}}));
        EXPECT_LT(time_s, 8) << "twelve steps lead round";
        const glm::dvec3 to = steps.start.position - steps.flight.ship.position.total();
        EXPECT_LT(angle_between(steps.flight.ship.ship_from_cockpit * glm::dvec3(0, 0, -1), to), 6 * degree);
    }
}

TEST(ComfortTest, TheVignetteIsSeenWhileTheShipTurnsAndIsGoneAfterwards)
{
    Flown ship(FlightMode::guided, {.vignette = Vignette()});
    const auto hold = [&](const glm::dvec3& turn, double seconds) {
        for (int i = 0; i < seconds / 0.016; ++i)
            ship.fly(controls_with(Steering{.lever = 0.2, .turn = turn}));
    };
    hold({0, 0, 0}, 2);
    EXPECT_EQ(ship.flight.vignette, 0) << "straight on";
    hold({0, 0.2, 0}, 2);
    // 0.2 of the rate lies at (0.2 - 0.02) / (0.5 - 0.02) between none and all.
    EXPECT_NEAR(ship.flight.vignette, 0.375, 0.01);
    hold({0.6, 0, 0}, 2);
    EXPECT_NEAR(ship.flight.vignette, 1, 0.01);
    hold({0, 0, 0}, 2);
    EXPECT_EQ(ship.flight.vignette, 0);
    hold({0, 0.01, 0}, 2);
    EXPECT_EQ(ship.flight.vignette, 0) << "a turn that nobody sees";
    ship.fly(controls_with(Switches{Switch::freeze}));
    hold({0, 1, 0}, 1);
    EXPECT_GT(ship.flight.vignette, 0.9) << "looking around in a world that stands still turns the picture, too";
    Flown none(FlightMode::guided, {});
    for (int i = 0; i < 100; ++i)
        none.fly(controls_with(Steering{.turn = {0, 1, 0}}));
    EXPECT_EQ(none.flight.vignette, 0);
}

TEST(ComfortTest, WithoutComfortAFlightIsAsItWas)
{
    // Rolls, and the axes of the cockpit alone count.
    Flown usual(FlightMode::guided, {});
    const glm::dquat from = usual.flight.ship.ship_from_cockpit;
    EXPECT_EQ(from, usual.start.ship_from_cockpit);
    for (int i = 0; i < 3'000; ++i)
        usual.fly(controls_with(Steering{.turn = {0, 0, 1}}), tick_ns);
    const glm::dquat turn = glm::conjugate(from) * usual.flight.ship.ship_from_cockpit;
    EXPECT_NEAR(turn.x, 0, 1e-12);
    EXPECT_NEAR(turn.y, 0, 1e-12);
    EXPECT_GT(turn.z, 0.5);
}

} // namespace comfort_test
