// What a visitor's controls do to the ship: smooth, bounded, and safe whatever is pressed.
#include "physics/physics.h"
#include "runtime/flight.h"
#include <gtest/gtest.h>
#include <random>

using namespace starbow;

namespace {

Shot start()
{
    Shot shot;
    shot.position = {1, 2, 3};
    return shot;
}

Flight hold(Flight flight, const Controls& controls, double seconds, double dt = 1.0 / 60)
{
    for (double t = 0; t < seconds - 1e-9; t += dt)
        flight = step(flight, controls, dt, 1, start());
    return flight;
}

double rapidity(const Flight& flight) { return std::asinh(glm::length(flight.ship.u.total())); }

} // namespace

TEST(Flight, SpeedsUpInEqualStepsOfRapidity)
{
    Flight flight = hold(flight_at(start()), {.faster = 1}, 3); // past the easing
    double before = rapidity(flight);
    flight = hold(flight, {.faster = 1}, 1);
    double once = rapidity(flight) - before;
    flight = hold(flight, {.faster = 1}, 5);
    EXPECT_NEAR(once, rapidity_per_s, 1e-3); // easing: e^-15 after 3 s
    EXPECT_NEAR(rapidity(flight) - before - once, 5 * rapidity_per_s, 1e-3);
    // Straight ahead, and only there.
    glm::dvec3 u = flight.ship.u.total();
    EXPECT_LT(std::hypot(u.x, u.y), 1e-12 * -u.z);
}

TEST(Flight, FromRestToGammaAMillionAndBack)
{
    Flight flight = hold(flight_at(start()), {.faster = 4}, 12);
    EXPECT_NEAR(physics::gamma_of(flight.ship.u.total()), 1e6, 1);
    flight = hold(flight, {.faster = -4}, 12);
    EXPECT_EQ(glm::length(flight.ship.u.total()), 0); // rest, not nearly rest
    // It slows down smoothly: no step takes off more than the control's own rate.
    flight = hold(flight_at(start()), {.faster = 1}, 4);
    for (int i = 0; i < 300; ++i) {
        Flight next = step(flight, {.faster = -1}, 1.0 / 60, 1, start());
        EXPECT_LE(std::abs(rapidity(flight) - rapidity(next)), rapidity_per_s / 60 + 1e-12);
        flight = next;
    }
}

TEST(Flight, StopIsAtOnceAndStays)
{
    Flight flight = hold(flight_at(start()), {.faster = 1, .turn = {0, 1, 0}}, 2);
    glm::dvec3 place = flight.ship.position.total();
    glm::dquat axes = flight.ship.ship_from_cockpit;
    Flight stopped = step(flight, {.faster = 1, .stop = true}, 0, 1, start());
    EXPECT_EQ(stopped.ship.u.total(), glm::dvec3(0));
    EXPECT_EQ(stopped.ship.position.total(), place);
    EXPECT_EQ(stopped.ship.ship_from_cockpit, axes);
    // The thrust control, still held, waits until it has been let go.
    stopped = hold(stopped, {.faster = 1}, 1);
    EXPECT_EQ(stopped.ship.u.total(), glm::dvec3(0));
    stopped = hold(hold(stopped, {}, 0.1), {.faster = 1}, 1);
    EXPECT_GT(glm::length(stopped.ship.u.total()), 0.1);
}

TEST(Flight, TheThrustIsAlongTheNose)
{
    Flight flight = hold(flight_at(start()), {.turn = {0, 1, 0}}, 2);
    flight = hold(flight, {}, 3); // the turn has died out
    glm::dvec3 nose = flight.ship.ship_from_cockpit * glm::dvec3(0, 0, -1);
    EXPECT_LT(nose.x, -0.5); // yaw to the left
    flight = hold(flight, {.faster = 1}, 2);
    EXPECT_NEAR(glm::dot(glm::normalize(flight.ship.u.total()), nose), 1, 1e-9);
}

TEST(Flight, SwitchesAndReset)
{
    Flight flight = step(flight_at(start()), {.doppler = true}, 0.01, 1, start());
    EXPECT_TRUE(flight.effects.aberration && !flight.effects.doppler && flight.effects.headlight);
    flight = step(flight, {.aberration = true, .doppler = true, .headlight = true, .hud = true}, 0.01, 1, start());
    EXPECT_TRUE(!flight.effects.aberration && flight.effects.doppler && !flight.effects.headlight && !flight.hud);
    flight = hold(flight, {.faster = 1, .turn = {1, 0, 0}, .exposure = 1}, 2);
    EXPECT_NEAR(flight.exposure_ev, 2 * exposure_ev_per_s, 1e-9);
    flight = step(flight, {.reset = true}, 0.01, 1, start());
    EXPECT_EQ(flight.ship.position.total(), start().position);
    EXPECT_EQ(flight.ship.u.total(), glm::dvec3(0));
    EXPECT_TRUE(flight.effects.aberration && flight.effects.headlight);
    EXPECT_FALSE(flight.hud) << "a display switched off stays off";
}

TEST(Flight, LookingAroundTurnsThePictureOnly)
{
    Flight flight = step(flight_at(start()), {.look_rad = {0.5, 0.2}}, 0.01, 1, start());
    EXPECT_EQ(flight.ship.ship_from_cockpit, start().ship_from_cockpit);
    glm::dvec3 seen = shot_of(flight, "").ship_from_cockpit * glm::dvec3(0, 0, -1);
    EXPECT_NEAR(seen.x, -std::sin(0.5) * std::cos(0.2), 1e-12);
    EXPECT_NEAR(seen.y, std::sin(0.2), 1e-12);
    flight = step(flight, {.look_ahead = true}, 0.01, 1, start());
    EXPECT_EQ(flight.look_rad, glm::dvec2(0));
}

TEST(Flight, AHundredThousandRandomStepsStayFinite)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> part(-1, 1);
    Flight flight = flight_at(start());
    Controls controls;
    for (int i = 0; i < 100000; ++i) {
        if (i % 20 == 0)
            controls = {.faster = 4 * part(random),
                .turn = {part(random), part(random), part(random)},
                .look_rad = {part(random), part(random)},
                .exposure = part(random)};
        controls.stop = random() % 997 == 0;
        controls.reset = random() % 4999 == 0;
        flight = step(flight, controls, random() % 10 == 0 ? 0.1 : 0.016, 1, start());
        glm::dvec3 u = flight.ship.u.total(), x = flight.ship.position.total();
        ASSERT_TRUE(std::isfinite(u.x + u.y + u.z + x.x + x.y + x.z + flight.ship.time.total())) << i;
        ASSERT_LE(physics::gamma_of(u), 1.001e6) << i; // a thrust across the flight at the limit still adds a little
        ASSERT_NEAR(glm::length(flight.ship.ship_from_cockpit), 1, 1e-12) << i;
    }
}
