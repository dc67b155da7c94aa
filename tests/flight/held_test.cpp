// The guide takes the stick away: the ship comes to coasting as softly as its rules ask for, and nothing leaps afterwards.
#include "runtime/flight/flight.h"
#include "tests/support/controls.h"
#include <cmath>
#include <gtest/gtest.h>

namespace held_test {

using namespace starbow;
using glm::dvec3;
using starbow::testing::controls_with;

namespace {

constexpr std::int64_t ms = 1'000'000;

Flying soft(FlightMode mode)
{
    Flying rules;
    rules.mode = mode, rules.max_gamma = 100;
    rules.turn_deg_per_s = 15, rules.roll_deg_per_s = 10, rules.turn_jerk_deg_per_s3 = 100; // as a dome's
    rules.rapidity_per_s = 0.8, rules.rapidity_jerk_per_s2 = 4;
    return rules;
}

Flight fly(Flight flight, const Controls& controls, int ticks, const Flying& rules)
{
    return step(std::move(flight), controls, ticks * ms, rules, 1, {});
}

double rapidity(const Flight& flight) { return std::asinh(glm::length(flight.ship.u.total())); }

} // namespace

TEST(Held, TheShipComesToCoastingWithinTheLimitsThatAreFelt)
{
    for (const FlightMode mode : {FlightMode::guided, FlightMode::free, FlightMode::newtonian}) {
        const Flying rules = soft(mode);
        const Controls hand = controls_with(Steering{.lever = 0.8, .turn = {0.5, 1, 0.7}}),
                       held = controls_with(Steering{.lever = 0.8, .taken = true});
        Flight flight = fly(flight_at({}, rules), hand, 1500, rules);
        const Flight before = flight;
        ASSERT_GT(glm::length(before.turn_rad_s), 0.1);
        const double began = rapidity(flight);
        double most_gain_step = 0, most_jerk = 0;
        dvec3 turn = flight.turn_rad_s, turn_gain(0);
        for (int i = 0; i < 6000; ++i) {
            const Flight next = fly(flight, held, 1, rules);
            most_gain_step = std::max(most_gain_step,
                std::max(std::abs(next.throttle_rate - flight.throttle_rate), glm::distance(next.thrust, flight.thrust)));
            const dvec3 gain = (next.turn_rad_s - turn) / tick_s;
            if (i > 0)
                for (int axis = 0; axis < 3; ++axis)
                    most_jerk = std::max(most_jerk, std::abs(gain[axis] - turn_gain[axis]) / tick_s);
            turn = next.turn_rad_s, turn_gain = gain, flight = next;
        }
        EXPECT_LE(most_gain_step, 1.01 * tick_s * rules.rapidity_jerk_per_s2) << int(mode);
        EXPECT_GT(most_gain_step, 1e-4) << int(mode); // there was a thrust to take away
        EXPECT_LE(most_jerk, 1.05 * glm::radians(rules.turn_jerk_deg_per_s3)) << int(mode);
        EXPECT_LT(glm::length(flight.turn_rad_s), 1e-4) << int(mode);
        // The rapidity gained while the thrust fades is at most the gain times the fading's time constant, 2 * 0.8 / 4 s.
        EXPECT_NEAR(rapidity(flight), began + 0.16, 0.17) << int(mode);
        const double settled = rapidity(flight);
        EXPECT_NEAR(rapidity(fly(flight, held, 3000, rules)), settled, 1e-3) << int(mode);
        // Without the hold the same hand goes on to gain speed, which shows that the hold is what ends it.
        EXPECT_GT(rapidity(fly(before, hand, 6000, rules)), settled + 1) << int(mode);
    }
}

TEST(Held, AThrottleIsLeftOutAfterwardsUntilItIsMoved)
{
    for (const FlightMode mode : {FlightMode::guided, FlightMode::newtonian}) {
        const Flying rules = soft(mode);
        Flight flight = fly(flight_at({}, rules), controls_with(Steering{.lever = 0.8}), 2000, rules);
        flight = fly(flight, controls_with(Steering{.lever = 0.8, .taken = true}), 4000, rules);
        const double held = rapidity(flight);
        // The visitor has moved it meanwhile: that is no wish either.
        flight = fly(flight, controls_with(Steering{.lever = 0.5}), 3000, rules);
        EXPECT_NEAR(rapidity(flight), held, 5e-3) << int(mode);
        flight = fly(flight, controls_with(Steering{.lever = 0.9}), 3000, rules);
        EXPECT_GT(rapidity(flight), held + 0.5) << int(mode);
    }
}

TEST(Held, KeysGoOnFromTheSpeedThatTheShipHas)
{
    const Flying rules = soft(FlightMode::guided);
    Flight flight = fly(flight_at({}, rules), controls_with(Steering{.throttle_rate = 4}), 2000, rules);
    flight = fly(flight, controls_with(Steering{.taken = true}), 3000, rules);
    const double held = rapidity(flight);
    flight = fly(flight, {}, 3000, rules);
    EXPECT_NEAR(rapidity(flight), held, 1e-3);
}

TEST(Held, AShipAtRestStaysAtRest)
{
    const Flying rules = soft(FlightMode::guided);
    const Flight flight = fly(flight_at({}, rules), controls_with(Steering{.lever = 0.7, .taken = true}), 3000, rules);
    EXPECT_EQ(rapidity(flight), 0);
}

} // namespace held_test
