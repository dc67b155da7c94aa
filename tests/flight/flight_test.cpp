// The visitor's controls move the ship smoothly, within bounds and safely, and equally at any frame rate.
#include "config/model/scene_file.h"
#include "config/model/shipped.h"
#include "runtime/flight/flight.h"
#include "runtime/flight/history.h"
#include "shaders/physics/physics.h"
#include "tests/support/controls.h"
#include <gtest/gtest.h>
#include <random>

namespace flight_test {

using namespace starbow;
using glm::dvec3;
using starbow::testing::controls_with;

namespace {

constexpr std::int64_t ms = 1'000'000;

Shot start()
{
    Shot shot;
    shot.position = {1, 2, 3};
    shot.ship_from_cockpit = orientation({1, 0, -1}, {0, 1, 0});
    return shot;
}

Flying with(FlightMode mode, double max_gamma = 100)
{
    Flying rules;
    rules.mode = mode, rules.max_gamma = max_gamma;
    return rules;
}

Flight hold(Flight flight, const Controls& controls, double seconds, const Flying& rules, std::int64_t dt = 16 * ms)
{
    for (std::int64_t left = std::llround(seconds * 1e9); left > 0; left -= dt)
        flight = step(flight, controls, std::min(dt, left), rules, 1, start());
    return flight;
}

double rapidity(const Flight& flight) { return std::asinh(glm::length(flight.ship.u.total())); }
dvec3 nose_of(const Flight& flight) { return flight.ship.ship_from_cockpit * dvec3(0, 0, -1); }

/// The angle between the ship's motion and its nose, in the ship's axes.
double drift(const Flight& flight)
{
    const dvec3 way = glm::normalize(flight.ship.u.total()), nose = nose_of(flight);
    return std::atan2(glm::length(glm::cross(way, nose)), glm::dot(way, nose));
}

Controls some_controls(std::mt19937& random)
{
    std::uniform_real_distribution<double> part(-1, 1);
    Controls controls;
    controls.throttle_rate = 4 * part(random);
    controls.push = {part(random), part(random), part(random)};
    controls.turn = {part(random), part(random), part(random)};
    controls.look_rad = {part(random), part(random)};
    controls.exposure = part(random);
    if (random() % 2)
        controls.lever = 0.5 + 0.5 * part(random);
    return controls;
}

} // namespace

class Modes : public ::testing::TestWithParam<FlightMode> { };
INSTANTIATE_TEST_SUITE_P(Flight, Modes, ::testing::Values(FlightMode::guided, FlightMode::free, FlightMode::newtonian));

// For a minute the hand moves ten times a second, at 10, 60 and 1000 frames a second.
TEST_P(Modes, FlyTheSameAtAnyFrameRate)
{
    const Flying rules = with(GetParam());
    const auto flown = [&](std::int64_t dt) {
        std::mt19937 random(7);
        Flight flight = flight_at(start(), rules);
        for (int tenth = 0; tenth < 600; ++tenth) {
            Controls controls = some_controls(random);
            controls.set(Switch::home, tenth == 300);
            controls.set(Switch::stop, tenth == 400);
            if (tenth == 401) // after a stop the thrust is inhibited until the lever is at 0
                controls = controls_with(Steering{.lever = 0.0});
            for (std::int64_t left = 100 * ms; left > 0; left -= dt) {
                flight = step(flight, controls, std::min(dt, left), rules, 1, start());
                controls.look_rad = {0, 0}, controls.set(Switch::home, false),
                controls.set(Switch::stop, false); // these controls count once
            }
        }
        return flight;
    };
    const Flight slow = flown(100 * ms);
    for (std::int64_t dt : {1 * ms, 16'666'667l, 333'333l}) {
        const Flight fast = flown(dt);
        EXPECT_EQ(slow.ticks, 60'000);
        EXPECT_EQ(slow.ship.u.total(), fast.ship.u.total()) << dt;
        EXPECT_EQ(slow.ship.position.total(), fast.ship.position.total());
        EXPECT_EQ(slow.ship.ship_from_cockpit, fast.ship.ship_from_cockpit);
        EXPECT_EQ(slow.ship.time.total(), fast.ship.time.total());
        EXPECT_EQ(slow.turn_rad_s, fast.turn_rad_s);
        EXPECT_EQ(slow.look_rad, fast.look_rad);
        EXPECT_EQ(slow.exposure_ev, fast.exposure_ev);
    }
    EXPECT_GT(glm::length(slow.ship.u.total()), 0.01); // the ship has moved
}

// The lever's place is the speed, evenly in rapidity. The ship reaches it without overshoot, from below and from above.
TEST(Flight, TheLeversPlaceSetsTheSpeed)
{
    for (FlightMode mode : {FlightMode::guided, FlightMode::free}) {
        const Flying rules = with(mode);
        const double most = std::acosh(100.0);
        for (double lever : {0.05, 0.25, 0.5, 1.0}) {
            Flight flight = flight_at(start(), rules);
            double before = 0;
            for (int i = 0; i < 1500; ++i) {
                flight = step(flight, controls_with(Steering{.lever = lever}), 10 * ms, rules, 1, start());
                EXPECT_GE(rapidity(flight), before - 1e-9); // never slower
                EXPECT_LE(rapidity(flight) - before, rules.rapidity_per_s * 0.01 + 1e-9);
                before = rapidity(flight);
            }
            EXPECT_NEAR(before, lever * most, 1e-5); // settle_s: e^-18 remains after the rest of 15 s
            flight = hold(flight, controls_with(Steering{.lever = 0.5 * lever}), 15, rules);
            EXPECT_NEAR(rapidity(flight), 0.5 * lever * most, 1e-5);
            flight = hold(flight, controls_with(Steering{.lever = 0.0}), 15, rules);
            EXPECT_EQ(flight.ship.u.total(), dvec3(0)); // exactly rest
        }
        // The ship moves straight ahead.
        const Flight flight = hold(flight_at(start(), rules), controls_with(Steering{.lever = 1.0}), 10, rules);
        EXPECT_LT(drift(flight), 1e-9);
    }
}

TEST(Flight, KeysMoveTheThrottle)
{
    const Flying rules = with(FlightMode::guided);
    Flight flight = hold(flight_at(start(), rules), controls_with(Steering{.throttle_rate = 1}), 2, rules);
    EXPECT_NEAR(flight.lever, 2 * lever_per_s, 1e-9);
    flight = hold(flight, {}, 10, rules);
    EXPECT_NEAR(rapidity(flight), 2 * lever_per_s * std::acosh(100.0), 1e-5);
    flight = hold(flight, controls_with(Steering{.throttle_rate = -4}), 3, rules);
    EXPECT_EQ(flight.lever, 0);
    EXPECT_EQ(hold(flight, {}, 10, rules).ship.u.total(), dvec3(0));
}

// At any speed the velocity follows the nose, as seen in the ship, and the speed stays as the throttle sets it.
TEST(Flight, GuidedVelocityFollowsTheNose)
{
    for (double gamma : {1.0005, 1.2, 4.0, 100.0, 1e6}) {
        SCOPED_TRACE(gamma);
        const Flying rules = with(FlightMode::guided, gamma);
        Flight flight = hold(flight_at(start(), rules), controls_with(Steering{.lever = 1.0}), 20, rules);
        const dvec3 before = glm::normalize(flight.ship.u.total());
        flight = hold(flight, controls_with(Steering{.lever = 1.0, .turn = {0.3, 1, 0}}), 2, rules);
        EXPECT_GT(drift(flight), 0.1); // still turning
        flight = hold(flight, controls_with(Steering{.lever = 1.0}), 6, rules);
        EXPECT_LT(drift(flight), 1e-4); // e^-12 of a radian, plus the rest of the turn
        EXPECT_NEAR(rapidity(flight), std::acosh(gamma), 1e-4);
        // In the world a fast ship turns less, because aberration contracts directions ahead.
        const double turned = std::acos(std::min(1.0, glm::dot(before, glm::normalize(flight.ship.u.total()))));
        EXPECT_GT(turned, 0.3 / gamma);
        EXPECT_LT(turned, 3 / gamma + 1e-6);
    }
    // This holds for a nose that is turned right round, too.
    const Flying rules = with(FlightMode::guided);
    Flight flight = hold(flight_at(start(), rules), controls_with(Steering{.lever = 0.3}), 10, rules);
    flight.ship.ship_from_cockpit *= glm::angleAxis(M_PI, dvec3(0, 1, 0));
    EXPECT_LT(drift(hold(flight, controls_with(Steering{.lever = 0.3}), 10, rules)), 1e-4);
}

TEST(Flight, InFreeModeTheNoseTurnsWithoutTheVelocity)
{
    const Flying rules = with(FlightMode::free);
    Flight flight = hold(flight_at(start(), rules), controls_with(Steering{.lever = 0.4}), 10, rules);
    const dvec3 way = glm::normalize(flight.ship.u.total());
    flight = hold(flight, controls_with(Steering{.lever = 0.4, .turn = {0, 1, 0}}), 3, rules);
    flight = hold(flight, controls_with(Steering{.lever = 0.8}), 8, rules);
    EXPECT_LT(glm::distance(glm::normalize(flight.ship.u.total()), way), 1e-9);
    EXPECT_GT(drift(flight), 1);
    EXPECT_NEAR(rapidity(flight), 0.8 * std::acosh(100.0), 1e-4);
}

// Constant thrust is hyperbolic motion (Misner, Thorne and Wheeler 1973, 6.2). Without thrust the speed stays.
TEST(Flight, NewtonianThrustIsProperAcceleration)
{
    Flying rules = with(FlightMode::newtonian, 1e6);
    rules.rapidity_jerk_per_s2 = 1e12; // full thrust at once, as in the closed form
    Flight flight = hold(flight_at(start(), rules), controls_with(Steering{.lever = 1.0}), 4, rules);
    const double a = rules.rapidity_per_s, tau = 4;
    EXPECT_NEAR(rapidity(flight), a * tau, 1e-11);
    EXPECT_NEAR(flight.ship.time.total(), std::sinh(a * tau) / a, 1e-9 * std::sinh(a * tau));
    EXPECT_NEAR(glm::distance(flight.ship.position.total(), start().position), (std::cosh(a * tau) - 1) / a,
        1e-9 * std::cosh(a * tau));
    const double kept = rapidity(flight);
    flight = hold(flight, controls_with(Steering{.lever = 0.0, .turn = {1, 1, 1}}), 5, rules);
    EXPECT_NEAR(rapidity(flight), kept, 1e-12);
    // Thrusters to the side act along the cockpit's axes.
    flight = hold(flight_at(start(), rules), controls_with(Steering{.push = {1, 0, 0}}), 1, rules);
    EXPECT_NEAR(glm::dot(glm::normalize(flight.ship.u.total()), start().ship_from_cockpit * dvec3(1, 0, 0)), 1, 1e-12);
    // A closed square of small boosts rotates the cockpit by its area: Thomas-Wigner, w^2 to first order.
    flight = flight_at(start(), rules);
    const double w = key_rapidity_per_s * 0.2;
    for (const dvec3& push : {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(-1, 0, 0), dvec3(0, -1, 0)})
        flight = hold(flight, controls_with(Steering{.push = push}), 0.2, rules);
    const double turned
        = 2 * std::acos(std::min(1.0, std::abs(glm::dot(flight.ship.ship_from_cockpit, start().ship_from_cockpit))));
    EXPECT_NEAR(turned, w * w, 0.02 * w * w);
}

TEST_P(Modes, StopIsImmediateAndLasts)
{
    const Flying rules = with(GetParam());
    Flight flight = hold(flight_at(start(), rules), controls_with(Steering{.lever = 0.7, .turn = {0, 1, 0}}), 4, rules);
    ASSERT_GT(rapidity(flight), 1);
    const dvec3 place = flight.ship.position.total();
    const glm::dquat axes = flight.ship.ship_from_cockpit;
    Flight stopped = step(flight, controls_with(Steering{.lever = 0.7}, Switches{Switch::stop}), 0, rules, 1, start());
    EXPECT_EQ(stopped.ship.u.total(), dvec3(0));
    EXPECT_EQ(stopped.ship.position.total(), place);
    EXPECT_EQ(stopped.ship.ship_from_cockpit, axes);
    // The thrust is inhibited until the throttle has been at 0.
    stopped = hold(stopped, controls_with(Steering{.lever = 0.7}), 2, rules);
    EXPECT_EQ(stopped.ship.u.total(), dvec3(0));
    stopped = hold(
        hold(stopped, controls_with(Steering{.lever = 0.0}), 0.1, rules), controls_with(Steering{.lever = 0.7}), 2, rules);
    EXPECT_GT(rapidity(stopped), 0.5);
    // The same holds for a key.
    flight = hold(flight_at(start(), rules), controls_with(Steering{.throttle_rate = 4}), 3, rules);
    stopped = hold(step(flight, controls_with(Steering{.throttle_rate = 4}, Switches{Switch::stop}), 0, rules, 1, start()),
        controls_with(Steering{.throttle_rate = 4}), 1, rules);
    EXPECT_EQ(stopped.ship.u.total(), dvec3(0));
    EXPECT_GT(rapidity(hold(hold(stopped, {}, 0.1, rules), controls_with(Steering{.throttle_rate = 4}), 2, rules)), 0.1);
    // A key that was released before the stop, or before homing, must not speed the ship up again.
    flight = hold(hold(flight_at(start(), rules), controls_with(Steering{.throttle_rate = 4}), 3, rules), {}, 0.2, rules);
    stopped = hold(step(flight, controls_with(Switches{Switch::stop}), 0, rules, 1, start()), {}, 2, rules);
    EXPECT_EQ(stopped.ship.u.total(), dvec3(0));
    flight = hold(step(flight, controls_with(Switches{Switch::home}), 0, rules, 1, start()), {}, 60, rules);
    EXPECT_FALSE(flight.homing);
    EXPECT_EQ(flight.ship.u.total(), dvec3(0));
}

// The visitor lets go of everything: the turn ends, and the ship flies straight on.
TEST_P(Modes, LettingGoIsSafe)
{
    const Flying rules = with(GetParam());
    Flight flight = hold(flight_at(start(), rules), controls_with(Steering{.lever = 0.5, .turn = {1, -1, 1}}), 5, rules);
    Controls none;
    none.lever = GetParam() == FlightMode::newtonian ? 0.0 : 0.5;
    flight = hold(flight, none, 12, rules);
    const dvec3 u = flight.ship.u.total();
    const glm::dquat axes = flight.ship.ship_from_cockpit;
    flight = hold(flight, none, 20, rules);
    EXPECT_LT(glm::length(flight.turn_rad_s), 1e-9);
    EXPECT_LT(glm::distance(flight.ship.u.total(), u), 1e-4 * glm::length(u));
    EXPECT_NEAR(std::abs(glm::dot(axes, flight.ship.ship_from_cockpit)), 1, 1e-8);
}

TEST_P(Modes, HomingFliesBackToTheStart)
{
    const Flying rules = with(GetParam());
    for (double seconds : {0.0, 0.5, 20.0}) {
        SCOPED_TRACE(seconds);
        Flight flight = hold(
            flight_at(start(), rules), controls_with(Steering{.lever = 0.6, .turn = {0.2, 0.5, -0.1}}), seconds, rules);
        flight = step(flight, controls_with(Steering{.lever = 0.6}, Switches{Switch::home}), 0, rules, 1, start());
        for (int i = 0; i < 20'000 && flight.homing; ++i) {
            const Ship before = flight.ship;
            flight = step(flight, controls_with(Steering{.lever = 0.6}), ms, rules, 1, start());
            // The ship must not jump: it moves at most as far as its greater speed allows, plus the correction at the end.
            const double most = std::max(glm::length(before.u.total()), glm::length(flight.ship.u.total()));
            ASSERT_LE(glm::distance(before.position.total(), flight.ship.position.total()),
                1.01 * most * 0.001 + 1e-6 + 1e-9 * glm::length(before.position.total()))
                << i;
        }
        EXPECT_FALSE(flight.homing);
        EXPECT_EQ(flight.ship.position.total(), start().position);
        EXPECT_EQ(flight.ship.u.total(), dvec3(0));
        EXPECT_EQ(flight.ship.ship_from_cockpit, start().ship_from_cockpit);
        // It stays there, though the throttle is not at 0.
        flight = hold(flight, controls_with(Steering{.lever = 0.6}), 3, rules);
        EXPECT_EQ(flight.ship.u.total(), dvec3(0));
    }
}

TEST(Flight, UndoGoesBackTenSecondsEachTime)
{
    const Flying rules = with(FlightMode::guided);
    Flight flight = flight_at(start(), rules);
    History history;
    std::vector<Flight> all;
    for (int i = 0; i < 600; ++i) { // a minute
        all.push_back(flight);
        flight = step(flight, controls_with(Steering{.lever = 0.3, .turn = {0, 0.2, 0}}), 100 * ms, rules, 1, start());
        history.keep(flight);
    }
    flight = history.back(flight);
    EXPECT_EQ(flight.ship.position.total(), all[500].ship.position.total());
    EXPECT_EQ(flight.ship.u.total(), all[500].ship.u.total());
    EXPECT_EQ(flight.ticks, 60'000);
    flight = history.back(flight);
    EXPECT_EQ(flight.ship.position.total(), all[400].ship.position.total());
    // Undo ends at the oldest state, and does nothing without a history.
    flight = history.back(history.back(flight));
    EXPECT_TRUE(std::isfinite(flight.ship.position.total().x));
    EXPECT_EQ(History().back(flight).ship.position.total(), flight.ship.position.total());
}

TEST(Flight, UndoLeavesTheSwitchesAndTheClock)
{
    const Flying rules = with(FlightMode::guided);
    History history;
    Flight flight = flight_at(start(), rules);
    for (int i = 0; i < 120; ++i)
        flight = flown(flight, history, controls_with(Steering{.lever = 0.3}), 100 * ms, rules, 1, start());
    flight.mode = FlightMode::free, flight.frozen = true, flight.time_scale = 2;
    flight.effects.on.set(Effect::doppler, !flight.effects[Effect::doppler]);
    flight.exposure_ev = -3, flight.hud = !flight.hud, flight.vignette = 0.5, flight.left_ns = 7;
    const Flight back = history.back(flight);
    EXPECT_LT(back.ship.distance.total(), 0.5 * flight.ship.distance.total());
    EXPECT_EQ(back.mode, flight.mode);
    EXPECT_EQ(back.frozen, flight.frozen);
    EXPECT_EQ(back.time_scale, flight.time_scale);
    EXPECT_EQ(back.effects[Effect::doppler], flight.effects[Effect::doppler]);
    EXPECT_EQ(back.exposure_ev, flight.exposure_ev);
    EXPECT_EQ(back.hud, flight.hud);
    EXPECT_EQ(back.vignette, flight.vignette);
    EXPECT_EQ(back.ticks, flight.ticks);
    EXPECT_EQ(back.left_ns, flight.left_ns);
}

namespace {

/// A start past things at half the speed of light, looking across the motion.
Shot start_in_flight()
{
    Shot shot = start();
    shot.time = 35.8;
    shot.u = {1 / std::sqrt(3.0), 0, 0}; // beta 1/2
    shot.ship_from_cockpit = orientation({0, 0, -1}, {0, 1, 0});
    return shot;
}

Flight hold_from(const Shot& from, Flight flight, const Controls& controls, double seconds, const Flying& rules)
{
    for (std::int64_t left = std::llround(seconds * 1e9); left > 0; left -= 16 * ms)
        flight = step(flight, controls, std::min<std::int64_t>(16 * ms, left), rules, 1, from);
    return flight;
}

} // namespace

// Every shipped shot in flight goes on as it says: u is the same to the bit, and the place is that of straight flight. A
// throttle that lies anywhere and a look around change nothing.
TEST(Flight, AStartInFlightGoesOnUntilAHandTouchesTheControls)
{
    int moving = 0;
    for (const auto& entry : std::filesystem::directory_iterator(home() / "config/shots")) {
        const Shot shot = load_shot(entry.path());
        if (shot.u == dvec3(0))
            continue;
        ++moving;
        SCOPED_TRACE(entry.path().filename());
        const double seconds_per_time_unit = load_scene_file(shipped_file("scenes", shot.scene)).seconds_per_time_unit();
        for (const FlightMode mode : {FlightMode::guided, FlightMode::free, FlightMode::newtonian})
            for (const std::optional<double> lever : {std::optional<double>(), std::optional(0.0), std::optional(0.4)}) {
                const Flying rules = with(mode, 1e6);
                Flight flight = flight_at(shot, rules);
                for (int i = 0; i < 300; ++i)
                    flight = step(flight, controls_with(Steering{.lever = lever}, Looking{.look_rad = {0.01, 0}}), 10 * ms,
                        rules, seconds_per_time_unit, shot);
                EXPECT_EQ(flight.ship.u.total(), shot.u);
                const double tau = 3 / seconds_per_time_unit, gamma = std::sqrt(1 + glm::dot(shot.u, shot.u));
                EXPECT_NEAR(flight.ship.time.total(), shot.time + gamma * tau, 1e-9 * gamma * tau); // rounding of 3000 sums
                EXPECT_LT(glm::distance(flight.ship.position.total(), shot.position + shot.u * tau), 1e-9 * gamma * tau);
                EXPECT_EQ(flight.ship.ship_from_cockpit, shot.ship_from_cockpit);
            }
    }
    EXPECT_GE(moving, 10);
}

TEST(Flight, AHandOnTheControlsTakesTheFlightOver)
{
    const Flying rules = with(FlightMode::guided);
    const Shot shot = start_in_flight();
    const double speed = std::atanh(0.5);
    const Controls none;
    // The stick: the velocity follows the nose, and the speed stays, wherever the throttle lies.
    for (const std::optional<double> lever : {std::optional<double>(), std::optional(0.0), std::optional(0.9)}) {
        Flight flight = hold_from(shot, flight_at(shot, rules), controls_with(Steering{.lever = lever}), 2, rules);
        EXPECT_NEAR(drift(flight), M_PI / 2, 1e-12);
        flight = hold_from(shot, flight, controls_with(Steering{.lever = lever, .turn = {0, 0.1, 0}}), 0.1, rules);
        flight = hold_from(shot, flight, controls_with(Steering{.lever = lever}), 8, rules);
        EXPECT_LT(drift(flight), 1e-4);
        EXPECT_NEAR(rapidity(flight), speed, 1e-4);
        // The throttle, once it is moved: its place sets the speed.
        flight = hold_from(shot, flight, controls_with(Steering{.lever = 0.28}), 0.1, rules);
        flight = hold_from(shot, flight, controls_with(Steering{.lever = 0.25}), 20, rules);
        EXPECT_NEAR(rapidity(flight), 0.25 * std::acosh(100.0), 1e-4);
    }
    // A throttle's noise is no hand.
    Flight flight = flight_at(shot, rules);
    for (int i = 0; i < 200; ++i)
        flight = step(flight, controls_with(Steering{.lever = 0.3 + (i % 2) * 0.015}), 10 * ms, rules, 1, shot);
    EXPECT_EQ(flight.ship.u.total(), shot.u);
    // A key.
    flight = hold_from(shot, flight_at(shot, rules), controls_with(Steering{.throttle_rate = 4}), 2, rules);
    EXPECT_GT(rapidity(flight), speed + 1);
    // After a stop the throttle waits for its zero as it always does.
    flight = step(flight_at(shot, rules), controls_with(Steering{.lever = 0.5}, Switches{Switch::stop}), 0, rules, 1, shot);
    flight = hold_from(shot, flight, controls_with(Steering{.lever = 0.6}), 2, rules);
    EXPECT_EQ(flight.ship.u.total(), dvec3(0));
}

// Frozen, no number of the ship changes, whatever the hand does; the stick turns the head as fast as it would turn the ship.
// Afterwards the flight goes on as if nothing had been.
TEST(Flight, AFrozenWorldStandsStillAndCanBeLookedAt)
{
    for (const FlightMode mode : {FlightMode::guided, FlightMode::free, FlightMode::newtonian}) {
        const Flying rules = with(mode);
        const Shot shot = start_in_flight();
        History history;
        Flight flight = hold_from(shot, flight_at(shot, rules), {}, 1, rules);
        history.keep(flight);
        const Flight before = flight;
        flight = step(flight, controls_with(Switches{Switch::freeze}), 16 * ms, rules, 1, shot);
        flight = hold_from(shot, flight,
            controls_with(Steering{.lever = 0.8, .throttle_rate = 1, .push = {1, 1, 1}, .turn = {0, 1, 0}}), 2, rules);
        EXPECT_EQ(shot_of(flight.ship).position, shot_of(before.ship).position);
        EXPECT_EQ(flight.ship.u.total(), shot.u);
        EXPECT_EQ(flight.ship.time.total(), before.ship.time.total());
        EXPECT_EQ(flight.ship.proper_time.total(), before.ship.proper_time.total());
        EXPECT_EQ(flight.ship.ship_from_cockpit, shot.ship_from_cockpit);
        EXPECT_NEAR(flight.look_rad.x, 2 * 40 * M_PI / 180, 0.15); // 40 degrees a second, less the smooth beginning
        EXPECT_EQ(flight.look_rad.y, 0);
        EXPECT_EQ(flight.ticks, before.ticks);
        flight = hold_from(shot, flight, {}, 2, rules); // the head comes to rest
        flight = step(flight, controls_with(Switches{Switch::freeze, Switch::look_ahead}), 0, rules, 1, shot);
        flight = hold_from(shot, flight, {}, 1, rules);
        const Flight straight = hold_from(shot, before, {}, 1, rules);
        EXPECT_EQ(flight.ship.position.total(), straight.ship.position.total());
        EXPECT_EQ(flight.ship.time.total(), straight.ship.time.total());
        EXPECT_EQ(flight.ship.u.total(), straight.ship.u.total());
        // The way home, a stop and an undo work in a frozen world, too.
        const Flight frozen = step(straight, controls_with(Switches{Switch::freeze}), 0, rules, 1, shot);
        EXPECT_EQ(step(frozen, controls_with(Switches{Switch::stop}), 0, rules, 1, shot).ship.u.total(), dvec3(0));
        EXPECT_FALSE(step(frozen, controls_with(Switches{Switch::home}), 0, rules, 1, shot).frozen);
        EXPECT_EQ(history.back(frozen).ship.time.total(), before.ship.time.total());
    }
}

// Back at the start the visit begins anew: the world's clock, the clock on board, the distance and the shot's own flight.
TEST(Flight, HomeIsTheStartsInstant)
{
    for (const Shot& shot : {start(), start_in_flight()}) {
        const Flying rules = with(FlightMode::guided);
        Flight flight = hold_from(
            shot, flight_at(shot, rules), controls_with(Steering{.throttle_rate = 1, .turn = {0.2, 0.5, -0.1}}), 5, rules);
        flight = step(flight, controls_with(Switches{Switch::home}), 0, rules, 1, shot);
        double fastest = 0;
        for (Flight before = flight; flight.homing; before = flight) {
            flight = step(flight, {}, ms, rules, 1, shot);
            // The world stands still while the ship gains its speed.
            if (before.ship.time.total() == shot.time && flight.ship.time.total() == shot.time)
                fastest = std::max(fastest, std::abs(rapidity(flight) - rapidity(before)));
        }
        EXPECT_EQ(shot_of(flight.ship).time, shot.time);
        EXPECT_EQ(shot_of(flight.ship).position, shot.position);
        EXPECT_EQ(flight.ship.u.total(), shot.u);
        EXPECT_EQ(flight.ship.ship_from_cockpit, shot.ship_from_cockpit);
        EXPECT_EQ(flight.ship.proper_time.total(), 0);
        EXPECT_EQ(flight.ship.distance.total(), 0);
        EXPECT_LE(fastest, 1.5 * std::atanh(0.5) / 1500 + 1e-6); // smoothstep is steepest in its middle: 3/2
        flight = hold_from(shot, flight, {}, 2, rules);
        EXPECT_EQ(flight.ship.u.total(), shot.u);
        EXPECT_NEAR(flight.ship.proper_time.total(), 2, 1e-9);
    }
}

// The limits that spare stomachs hold for every combination of keys, thrusters and throttle.
TEST(Flight, NewtonianThrustKeepsTheLimitOfComfort)
{
    for (const double limit : {0.6, 1.5}) {
        Flying rules = with(FlightMode::newtonian);
        rules.rapidity_per_s = limit;
        for (const Steering& hand : {Steering{.throttle_rate = 4}, Steering{.lever = 1, .throttle_rate = 4},
                 Steering{.lever = 1, .throttle_rate = 1, .push = {1, 1, -1}}, Steering{.push = {-1, 1, 1}}}) {
            Flight flight = flight_at(start(), rules);
            double most = 0;
            for (int i = 0; i < 2000; ++i) {
                const dvec3 before = flight.ship.u.total();
                flight = step(flight, controls_with(hand), ms, rules, 1, start());
                // The rapidity between the two velocities, from the invariant product of the four-velocities.
                const dvec3 u = flight.ship.u.total();
                const double g = std::sqrt(1 + glm::dot(u, u)), g0 = std::sqrt(1 + glm::dot(before, before));
                const double square = glm::dot(u - before, u - before) - (g - g0) * (g - g0);
                most = std::max(most, std::sqrt(std::max(0.0, square)) / 1e-3); // 2 sinh(w/2) = w to 1e-7
            }
            EXPECT_LE(most, limit * 1.001);
            EXPECT_GT(most, 0.5 * limit);
        }
    }
}

// The way home, too: a headset's limits hold from gamma 1000, far away and turned round.
TEST(Flight, TheWayHomeKeepsTheLimitsOfComfort)
{
    Flying rules = with(FlightMode::guided, 1000);
    rules.rapidity_per_s = 0.6, rules.turn_deg_per_s = 12;
    const Shot shot = start_in_flight();
    Flight flight = hold_from(shot, flight_at(shot, rules), controls_with(Steering{.throttle_rate = 4}), 15, rules);
    flight = hold_from(shot, flight, controls_with(Steering{.turn = {0, 1, 0}}), 10, rules);
    ASSERT_GT(rapidity(flight), 5);
    flight = hold_from(shot, flight, {}, 1, rules);
    flight = step(flight, controls_with(Switches{Switch::home}), 0, rules, 1, shot);
    double most = 0, most_turn = 0;
    for (int i = 0; i < 200'000 && flight.homing; ++i) {
        const Ship before = flight.ship;
        flight = step(flight, {}, ms, rules, 1, shot);
        const dvec3 u = flight.ship.u.total(), u0 = before.u.total(), apart = u - u0;
        const double g = std::sqrt(1 + glm::dot(u, u)), g0 = std::sqrt(1 + glm::dot(u0, u0)),
                     gain = glm::dot(u + u0, apart) / (g + g0), square = glm::dot(apart, apart) - gain * gain;
        most = std::max(most, 1000 * std::sqrt(std::max(0.0, square)));
        const double same = std::abs(glm::dot(before.ship_from_cockpit, flight.ship.ship_from_cockpit));
        most_turn = std::max(most_turn, 1000 * 2 * std::acos(std::min(1.0, same)) * 180 / M_PI);
    }
    EXPECT_FALSE(flight.homing);
    EXPECT_EQ(flight.ship.u.total(), shot.u);
    // 2 % for the digits that are left of a difference of squares at gamma 1000, and of the cosine of a thousandth of a
    // degree.
    EXPECT_LE(most, 0.6 * 1.02);
    EXPECT_LE(most_turn, 12 * 1.02);
}

namespace {

/// A vector's place after a boost with proper velocity u; its time is 0 before, and is returned in `time`.
dvec3 boosted(const dvec3& u, const dvec3& x, double& time)
{
    const double gamma = std::sqrt(1 + glm::dot(u, u)), before = time;
    time = gamma * before + glm::dot(u, x);
    return x + u * (before + glm::dot(u, x) / (gamma + 1));
}

/// The thrust and the turn of one tick as an instrument on board feels them, in the cockpit's axes: rapidity and radians per
/// second. The thrust is the velocity that the second instant has in the rest frame of the first. A boost across the motion
/// turns the axes that are carried along, which nobody feels.
struct Felt {
    dvec3 thrust, turn;
};
Felt felt(const Ship& before, const Ship& after)
{
    const dvec3 u0 = before.u.total(), u = after.u.total();
    const double g0 = std::sqrt(1 + glm::dot(u0, u0)), g = std::sqrt(1 + glm::dot(u, u));
    const dvec3 relative = u + u0 * (glm::dot(u0, u) / (g0 + 1) - g);
    const glm::dquat& q = before.ship_from_cockpit;
    glm::dmat3 carried;
    for (int i = 0; i < 3; ++i) {
        dvec3 axis(0);
        axis[i] = 1;
        double time = 0;
        axis = boosted(relative, q * axis, time);
        axis = boosted(u0, axis, time);
        carried[i] = boosted(-u, axis, time);
    }
    const glm::dmat3 turned = glm::transpose(carried) * glm::mat3_cast(after.ship_from_cockpit);
    return {glm::inverse(q) * relative * 1e3,
        500.0 * dvec3(turned[1][2] - turned[2][1], turned[2][0] - turned[0][2], turned[0][1] - turned[1][0])};
}

} // namespace

// The greatest jerks of the whole way home, from its first tick to those after arrival.
TEST(Flight, TheWayHomeKeepsTheLimitsOfJerk)
{
    for (const auto& [mode, shot, seconds, jerk] :
        {std::tuple(FlightMode::guided, start(), 3.0, 2.0), {FlightMode::guided, start_in_flight(), 15.0, 2.0},
            {FlightMode::newtonian, start(), 8.0, 2.0}, {FlightMode::newtonian, start_in_flight(), 0.1, 0.5}}) {
        SCOPED_TRACE(std::to_string(int(mode)) + " " + std::to_string(seconds));
        Flying rules = with(mode, 20);
        rules.rapidity_per_s = 0.8, rules.rapidity_jerk_per_s2 = jerk; // as a dome's
        rules.turn_deg_per_s = 15, rules.roll_deg_per_s = 10, rules.turn_jerk_deg_per_s3 = 100;
        const Controls hand = controls_with(Steering{.lever = 0.9, .turn = {0.3, 1, 0.2}});
        Flight flight = hold_from(shot, flight_at(shot, rules), controls_with(Steering{.lever = 0.0}), 0.1, rules);
        flight = hold_from(shot, flight, hand, seconds, rules);
        const Flight by_hand = step(flight, hand, ms, rules, 1, shot);
        std::vector<Felt> ticks{felt(flight.ship, by_hand.ship)};
        const Felt goes_on = felt(by_hand.ship, step(by_hand, hand, ms, rules, 1, shot).ship);
        Controls home = hand;
        home.set(Switch::home);
        flight = step(by_hand, home, 0, rules, 1, shot);
        while (ticks.size() < 100'000 && flight.homing) {
            const Ship was = flight.ship;
            flight = step(flight, {}, ms, rules, 1, shot);
            ticks.push_back(felt(was, flight.ship));
        }
        ASSERT_FALSE(flight.homing);
        EXPECT_EQ(flight.ship.position.total(), shot.position);
        EXPECT_EQ(flight.ship.u.total(), shot.u);
        ticks.insert(ticks.end(), 2, Felt{dvec3(0), dvec3(0)});
        // It takes over where the hand let go. A guided ship's thrust across its motion has no limit of its own.
        EXPECT_LT(glm::distance(ticks[1].thrust, goes_on.thrust), 1e-3 * jerk * 1.01);
        double thrust = 0, turn = 0, most_thrust = 0, most_turn = 0;
        for (std::size_t i = 1; i < ticks.size(); ++i) {
            most_thrust = std::max(most_thrust, glm::length(ticks[i].thrust));
            most_turn = std::max(most_turn, glm::length(ticks[i].turn));
            if (i > 1) {
                thrust = std::max(thrust, 1e3 * glm::distance(ticks[i].thrust, ticks[i - 1].thrust));
                turn = std::max(turn, 1e6 * glm::length(ticks[i].turn - 2.0 * ticks[i - 1].turn + ticks[i - 2].turn));
            }
        }
        // 1 % for a tick's length against the exact curves.
        EXPECT_LE(thrust, jerk * 1.01);
        EXPECT_LE(turn, 100 * M_PI / 180 * 1.01);
        // The limits are used.
        EXPECT_GT(most_thrust, 0.25);
        EXPECT_GT(thrust, 0.5 * jerk);
        EXPECT_GT(turn, 0.5);
        EXPECT_GT(most_turn, seconds > 1 ? 0.05 : 0);
    }
}

TEST(Flight, SwitchesToggleAndResetRestores)
{
    const Flying rules = with(FlightMode::guided);
    Flight flight = step(flight_at(start(), rules), controls_with(Switches{Switch::doppler}), 10 * ms, rules, 1, start());
    EXPECT_TRUE(flight.effects[Effect::aberration] && !flight.effects[Effect::doppler] && flight.effects[Effect::headlight]);
    flight = step(flight,
        controls_with(Switches{Switch::aberration, Switch::doppler, Switch::headlight, Switch::false_colours, Switch::hud}),
        10 * ms, rules, 1, start());
    EXPECT_TRUE(!flight.effects[Effect::aberration] && flight.effects[Effect::doppler] && !flight.effects[Effect::headlight]
        && flight.effects[Effect::false_colours] && !flight.hud);
    flight = hold(flight, controls_with(Steering{.lever = 1.0, .turn = {1, 0, 0}}, Looking{.exposure = 1}), 2, rules);
    EXPECT_NEAR(flight.exposure_ev, 2 * exposure_ev_per_s, 1e-9);
    flight = step(flight, controls_with(Switches{Switch::next_mode}), 0, rules, 1, start());
    EXPECT_EQ(flight.mode, FlightMode::free);
    flight = step(flight, controls_with(Switches{Switch::reset}), 10 * ms, rules, 1, start());
    EXPECT_EQ(flight.ship.position.total(), start().position);
    EXPECT_EQ(flight.ship.u.total(), dvec3(0));
    EXPECT_TRUE(flight.effects[Effect::aberration] && flight.effects[Effect::headlight]);
    EXPECT_FALSE(flight.hud) << "a display that was switched off stays off";
}

TEST(Flight, LookingAroundTurnsOnlyThePicture)
{
    const Flying rules;
    Shot level;
    Flight flight = step(flight_at(level), controls_with(Looking{.look_rad = {0.5, 0.2}}), 10 * ms, rules, 1, level);
    EXPECT_EQ(flight.ship.ship_from_cockpit, level.ship_from_cockpit);
    dvec3 seen = shot_of(flight, "").ship_from_cockpit * dvec3(0, 0, -1);
    EXPECT_NEAR(seen.x, -std::sin(0.5) * std::cos(0.2), 1e-12);
    EXPECT_NEAR(seen.y, std::sin(0.2), 1e-12);
    flight = step(flight, controls_with(Switches{Switch::look_ahead}), 10 * ms, rules, 1, level);
    EXPECT_EQ(flight.look_rad, glm::dvec2(0));
}

namespace {

void expect_finite_and_bounded(const Flight& flight, double most_gamma, const std::string& when)
{
    const dvec3 u = flight.ship.u.total(), x = flight.ship.position.total(), t = flight.turn_rad_s;
    ASSERT_TRUE(std::isfinite(u.x + u.y + u.z + x.x + x.y + x.z + t.x + t.y + t.z + flight.ship.time.total()
        + flight.ship.proper_time.total() + flight.lever + flight.throttle_rate + flight.exposure_ev))
        << when;
    ASSERT_LE(physics::gamma_of(u), 1.001 * most_gamma) << when; // a thrust across the motion at the limit adds a little
    ASSERT_NEAR(glm::length(flight.ship.ship_from_cockpit), 1, 1e-12) << when;
}

} // namespace

TEST(Flight, AHundredThousandRandomStepsStayFiniteAndBounded)
{
    for (double greatest : {3.0, 1e6}) {
        const Flying rules = with(FlightMode::guided, greatest);
        std::mt19937 random(1);
        Flight flight = flight_at(start(), rules);
        History history;
        Controls controls;
        for (int i = 0; i < 50000; ++i) {
            if (i % 20 == 0)
                controls = some_controls(random);
            controls.set(Switch::stop, random() % 997 == 0);
            controls.set(Switch::reset, random() % 4999 == 0);
            controls.set(Switch::home, random() % 1511 == 0);
            controls.set(Switch::next_mode, random() % 499 == 0);
            controls.set(Switch::aberration, random() % 7 == 0), controls.set(Switch::doppler, random() % 7 == 0),
                controls.set(Switch::headlight, random() % 7 == 0);
            if (random() % 601 == 0)
                flight = history.back(flight);
            flight = step(flight, controls, random() % 10 == 0 ? 100 * ms : 16 * ms, rules, 1, start());
            history.keep(flight);
            // Homing may be faster than a visitor may fly.
            expect_finite_and_bounded(flight, flight.homing ? 1e300 : greatest, std::to_string(i));
            if (HasFatalFailure())
                return;
        }
    }
}

// Ten minutes at the limit, spinning, then a turn right round at a gamma of a million.
TEST(Flight, LongFlightsAtTheLimitStayFinite)
{
    for (FlightMode mode : {FlightMode::guided, FlightMode::free, FlightMode::newtonian}) {
        const Flying rules = with(mode, 1e6);
        Flight flight = hold(
            flight_at(start(), rules), controls_with(Steering{.lever = 1.0, .turn = {0.1, 0.1, 1}}), 600, rules, 100 * ms);
        expect_finite_and_bounded(flight, 1e6, "after ten minutes");
        EXPECT_NEAR(physics::gamma_of(flight.ship.u.total()), 1e6, 2e3);
        flight.ship.ship_from_cockpit *= glm::angleAxis(M_PI, dvec3(0, 1, 0));
        flight = hold(flight, controls_with(Steering{.lever = 1.0}), 40, rules, 100 * ms);
        expect_finite_and_bounded(flight, 1e6, "turned round");
        if (mode == FlightMode::guided) {
            EXPECT_LT(drift(flight), 1e-3);
        }
    }
}

} // namespace flight_test
