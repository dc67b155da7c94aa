// The flight compared with the closed form, with integrated equations of motion, and with Thomas' precession, in 33 digits.
#include "config/model/angles.h"
#include "runtime/flight/ship.h"
#include "tests/support/quad.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>
#include <vector>

namespace ship_test {

namespace {

using glm::dquat;
using glm::dvec3;
using quad::Q;
using quad::V3;
using starbow::fly;
using starbow::pi;
using starbow::Ship;

constexpr double one_g = 9.80665 * 365.25 * 86400 / 299792458; // rapidity per year
constexpr double within = 1e-9; // required accuracy of position and time

Ship flying(const dvec3& u)
{
    Ship ship;
    ship.u = starbow::Sum3(u);
    return ship;
}

dvec3 at_gamma(double gamma, const dvec3& way) { return glm::normalize(way) * std::sqrt((gamma - 1) * (gamma + 1)); }

// In the frame of the start the ship leaves from rest: x = (cosh - 1)/a, t = sinh/a along the thrust. A boost transforms
// that to the world.
struct End {
    V3 x, u;
    Q t;
};
End closed_form(const dvec3& u, const dvec3& acceleration, Q tau)
{
    const Q a = quad::length(quad::of(acceleration));
    const V3 way = quad::unit(quad::of(acceleration));
    const Q half = sinhq(a * tau / 2);
    const quad::V4 event = quad::boosted(quad::of(u), {sinhq(a * tau) / a, way * (2 * half * half / a)});
    const quad::V4 velocity = quad::boosted(quad::of(u), {coshq(a * tau), way * sinhq(a * tau)});
    return {event.x, velocity.x, event.t};
}

struct Error {
    double x, t, u;
};
Error against(const End& expected, const Ship& ship)
{
    return {double(quad::length(quad::of(ship.position.total()) - expected.x) / quad::length(expected.x)),
        double(fabsq(ship.time.total() / expected.t - 1)),
        double(quad::length(quad::of(ship.u.total()) - expected.u) / quad::length(expected.u))};
}

Ship flown(Ship ship, const dvec3& acceleration, double tau, long steps)
{
    for (long i = 0; i < steps; ++i)
        ship = fly(ship, acceleration, dvec3(0), tau / double(steps));
    return ship;
}

// ---------------------------------------------------------------- sums

TEST(Sum, KeepsSmallTermsThatRoundingWouldLose)
{
    starbow::Sum sum;
    sum.add(1);
    for (int i = 0; i < 1000000; ++i)
        sum.add(1e-17);
    EXPECT_DOUBLE_EQ(sum.total(), 1 + 1e-11);
    starbow::Sum swap; // the large number comes last: Kahan's sum loses the small ones, Neumaier's keeps them
    for (double x : {1.0, 1e100, 1.0, -1e100})
        swap.add(x);
    EXPECT_EQ(swap.total(), 2);
}

// ---------------------------------------------------------------- constant thrust

// Ten years on board, shown in one or ten minutes, at every frame rate.
TEST(Fly, TenYearsAgreeWithTheClosedFormAtAnyFrameRate)
{
    const dvec3 oblique = glm::normalize(dvec3(1, -2, 2.5));
    const struct {
        const char* name;
        dvec3 u, acceleration;
    } flights[] = {{"1 g", dvec3(0), one_g * oblique}, {"1 g along an axis", dvec3(0), dvec3(0, 0, -one_g)},
        {"2 g, to gamma 5e8", dvec3(0), 2 * one_g * oblique}, {"0.001 g", dvec3(0), 1e-3 * one_g * oblique},
        {"1e-9 g", dvec3(0), 1e-9 * one_g * oblique}, {"1 g across 0.9 c", at_gamma(2.3, {2, 1, 0}), one_g * oblique},
        {"0.3 g against gamma 3", at_gamma(3, {-1, 2, -2.4}), .3 * one_g * oblique},
        {"1e-9 g across gamma 1e4", at_gamma(1e4, {3, 1, 1}), 1e-9 * one_g * oblique}};
    Error worst{0, 0, 0};
    for (const auto& flight : flights) {
        const double tau = 10;
        const End expected = closed_form(flight.u, flight.acceleration, tau);
        Error of_flight{0, 0, 0};
        for (int rate : {10, 24, 60, 144, 240, 1000})
            for (int seconds : {60, 600}) {
                const Error e = against(expected, flown(flying(flight.u), flight.acceleration, tau, long(rate) * seconds));
                of_flight = {std::max(of_flight.x, e.x), std::max(of_flight.t, e.t), std::max(of_flight.u, e.u)};
                EXPECT_LE(e.x, within) << flight.name << ' ' << rate << " Hz, " << seconds << " s";
                EXPECT_LE(e.t, within) << flight.name << ' ' << rate << " Hz, " << seconds << " s";
                EXPECT_LE(e.u, within) << flight.name << ' ' << rate << " Hz, " << seconds << " s";
            }
        std::printf("  %-26s position %.1e  time %.1e  u %.1e\n", flight.name, of_flight.x, of_flight.t, of_flight.u);
        worst = {std::max(worst.x, of_flight.x), std::max(worst.t, of_flight.t), std::max(worst.u, of_flight.u)};
    }
    // The required accuracy allows for a slow drift; with compensated sums only rounding remains.
    EXPECT_LE(std::max({worst.x, worst.t, worst.u}), 1e-12);
}

// 1e8 steps: ten years at about 100 frames a second for twelve days. It runs only with STARBOW_LONG=1.
TEST(Fly, TenYearsInAHundredMillionStepsOnRequest)
{
    const char* requested = std::getenv("STARBOW_LONG");
    if (!requested || std::strcmp(requested, "1") != 0)
        GTEST_SKIP() << "STARBOW_LONG=1 runs it";
    const dvec3 acceleration = one_g * glm::normalize(dvec3(1, -2, 2.5));
    const Ship ship = flown(Ship(), acceleration, 10, 100000000);
    const Error e = against(closed_form(dvec3(0), acceleration, 10), ship);
    std::printf("  1e8 steps: position %.2e  time %.2e  u %.2e  proper time %.2e\n", e.x, e.t, e.u,
        ship.proper_time.total() / 10 - 1);
    EXPECT_LE(e.x, within);
    EXPECT_LE(e.t, within);
}

// The flight and its orientation do not depend on the steps: one, equal ones, or very unequal ones.
TEST(Fly, AnyStepsGiveTheSameFlight)
{
    const dvec3 acceleration(.7, -.4, .2);
    Ship start = flying({3, -1, 2});
    start.ship_from_cockpit = glm::normalize(dquat(.5, .1, -.7, .3));
    const double tau = 4;
    const Ship once = fly(start, acceleration, dvec3(0), tau);
    const Ship many = flown(start, acceleration, tau, 3000);
    Ship uneven = start;
    for (double part = tau, left = tau; left > 0; left -= part) {
        part = left < 1e-9 ? left : .3 * left;
        uneven = fly(uneven, acceleration, dvec3(0), part);
    }
    for (const Ship& ship : {many, uneven}) {
        // At worst 3000 roundings of the size of gamma: 3e-13.
        EXPECT_LE(glm::length(ship.position.total() - once.position.total()), 3e-13 * glm::length(once.position.total()));
        EXPECT_LE(std::abs(ship.time.total() - once.time.total()), 3e-13 * once.time.total());
        EXPECT_LE(glm::length(ship.u.total() - once.u.total()), 3e-13 * glm::length(once.u.total()));
        EXPECT_LE(1 - std::abs(glm::dot(ship.ship_from_cockpit, once.ship_from_cockpit)), 1e-15);
        EXPECT_NEAR(ship.proper_time.total(), tau, 1e-15);
    }
}

TEST(Fly, CoastingIsUniform)
{
    Ship ship = flying({3, 0, 4});
    ship.ship_from_cockpit = glm::normalize(dquat(.5, .1, -.7, .3));
    const dquat before = ship.ship_from_cockpit;
    ship = flown(ship, dvec3(0), 2, 1000000);
    EXPECT_EQ(ship.u.total(), dvec3(3, 0, 4));
    EXPECT_NEAR(ship.position.total().x, 6, 1e-14);
    EXPECT_NEAR(ship.position.total().z, 8, 1e-14);
    EXPECT_NEAR(ship.time.total(), 2 * std::sqrt(26.0), 1e-14);
    EXPECT_NEAR(ship.distance.total(), 10, 1e-14);
    EXPECT_LE(glm::length(glm::dvec3(ship.ship_from_cockpit.x - before.x, ship.ship_from_cockpit.y - before.y,
                  ship.ship_from_cockpit.z - before.z)),
        1e-15);
}

TEST(Fly, AStepOfNoTimeChangesNothing)
{
    Ship ship = flying({3, 0, 4});
    ship = fly(ship, {1, 2, 3}, dvec3(0), 0);
    EXPECT_EQ(ship.u.total(), dvec3(3, 0, 4));
    EXPECT_EQ(ship.position.total(), dvec3(0));
    EXPECT_EQ(ship.time.total(), 0);
    EXPECT_EQ(ship.ship_from_cockpit, dquat(1, 0, 0, 0));
    ship = fly(ship, dvec3(5e-324, 0, 0), dvec3(0, 5e-324, 0), 1e-300); // numbers too small to square
    EXPECT_TRUE(std::isfinite(ship.u.total().x) && std::isfinite(ship.ship_from_cockpit.w));
}

TEST(Fly, ThrustFollowsTheCockpit)
{
    Ship ship;
    ship.ship_from_cockpit
        = glm::angleAxis(glm::half_pi<double>(), dvec3(0, 1, 0)); // the cockpit's -z points along the world's -x
    ship = fly(ship, {0, 0, -1}, dvec3(0), 1);
    EXPECT_NEAR(ship.u.total().x, -std::sinh(1.0), 1e-15);
    EXPECT_NEAR(ship.u.total().y, 0, 1e-15);
    EXPECT_NEAR(ship.u.total().z, 0, 1e-15);
    EXPECT_NEAR(ship.distance.total(), std::cosh(1.0) - 1, 1e-15);
}

TEST(Fly, TurnsAreAboutTheCockpitsAxes)
{
    Ship ship;
    ship = fly(ship, dvec3(0), {0, glm::half_pi<double>(), 0}, 1); // to the left
    ship = fly(ship, dvec3(0), {glm::half_pi<double>(), 0, 0}, 1); // nose up, about the rotated axis
    const dvec3 nose = ship.ship_from_cockpit * dvec3(0, 0, -1), left = ship.ship_from_cockpit * dvec3(-1, 0, 0);
    EXPECT_NEAR(glm::length(nose - dvec3(0, 1, 0)), 0, 1e-15);
    EXPECT_NEAR(glm::length(left - dvec3(0, 0, 1)), 0, 1e-15);
    EXPECT_EQ(ship.u.total(), dvec3(0));
}

TEST(Stopped, RestsAtTheSameEvent)
{
    Ship ship = flying({3, 0, 4});
    ship = fly(ship, {1, 2, 3}, {.1, .2, .3}, .5);
    const Ship rest = starbow::stopped(ship);
    EXPECT_EQ(rest.u.total(), dvec3(0));
    EXPECT_EQ(rest.position.total(), ship.position.total());
    EXPECT_EQ(rest.time.total(), ship.time.total());
    EXPECT_EQ(rest.proper_time.total(), ship.proper_time.total());
    EXPECT_EQ(rest.distance.total(), ship.distance.total());
    EXPECT_EQ(rest.ship_from_cockpit, ship.ship_from_cockpit);
    const Ship later = fly(rest, dvec3(0), dvec3(0), 2); // no remainder of the compensated sums moves it
    EXPECT_EQ(later.position.total(), ship.position.total());
}

// ---------------------------------------------------------------- speeding up and slowing down

// From rest to gamma 1e6 and back in equal steps of rapidity, in every attitude. An angle at the top becomes gamma times
// that angle at the end, in u and in the cockpit's axes.
TEST(Fly, UpToGammaAMillionAndBackSmoothly)
{
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    const double top = std::acosh(1e6);
    for (int steps : {100, 600, 2000, 100000}) { // 600: ten seconds at 60 Hz
        const double step = top / steps;
        double residual = 0, turned = 0, roughest = 0;
        for (int attitude = 0; attitude < (steps > 10000 ? 4 : 40); ++attitude) {
            Ship ship;
            ship.ship_from_cockpit = glm::normalize(dquat(normal(random), normal(random), normal(random), normal(random)));
            const dquat before = ship.ship_from_cockpit;
            const dvec3 way
                = attitude % 2 ? dvec3(0, 0, -1) : glm::normalize(dvec3(normal(random), normal(random), normal(random)));
            double rapidity = 0, highest = 0;
            for (int i = 0; i < 2 * steps; ++i) {
                const double sign = i < steps ? 1 : -1;
                ship = fly(ship, way * sign, dvec3(0), step);
                const dvec3 u = ship.u.total();
                const double now = std::asinh(glm::length(u));
                roughest = std::max(roughest, std::abs(now - rapidity - sign * step));
                rapidity = now;
                highest = std::max(highest, std::sqrt(1 + glm::dot(u, u)));
            }
            EXPECT_NEAR(highest / 1e6, 1, 1e-12);
            EXPECT_NEAR(ship.distance.total() / (2 * (1e6 - 1)), 1, 1e-12); // rapidity 1 for each unit of proper time
            const dquat left = ship.ship_from_cockpit * glm::conjugate(before);
            turned = std::max(turned, 2 * std::sqrt(left.x * left.x + left.y * left.y + left.z * left.z));
            residual = std::max(residual, glm::length(ship.u.total()));
        }
        std::printf("  to gamma 1e6 in %6d steps and back: residual u %.1e, orientation %.1e rad, roughest step %.1e\n",
            steps, residual, turned, roughest);
        EXPECT_LT(residual, 1e-9);
        EXPECT_LE(roughest, 1e-9); // every frame changes the rapidity equally, without a jump
        // u and the thrust are rounded, so that they differ in direction by some 2^-53. A frame then turns by a step times
        // that, instead of not at all. At the top gamma magnifies it, and the last e-fold has 1/step frames that add up at
        // random: one standard deviation is gamma 2^-53 sqrt(step). The worst of 40 attitudes is within four. Steps below
        // 0.01 no longer change the last bit.
        EXPECT_LE(turned, step > .01 ? 4 * 1e6 * 0x1p-53 * std::sqrt(step) : 1e-12);
    }
}

// 50 flights to gamma 1e4 and back, with 2000 boosts each.
TEST(Fly, FiftyFlightsLeaveAlmostNoVelocity)
{
    for (const dvec3& way : {dvec3(0, 0, -1), glm::normalize(dvec3(1, -2, 2.5))}) {
        Ship ship;
        const double step = std::acosh(1e4) / 1000;
        for (int flight = 0; flight < 50; ++flight)
            for (int i = 0; i < 2000; ++i)
                ship = fly(ship, i < 1000 ? way : -way, dvec3(0), step);
        const double residual = glm::length(ship.u.total());
        std::printf("  50 flights: residual u %.1e, orientation %.1e\n", residual, 1 - ship.ship_from_cockpit.w);
        // Across the motion each boost rounds by gamma times 1e-16. Some 150 boosts near the top of each flight add up at
        // random: 1e-12 sqrt(150 * 50) 0.01 of step = 1e-12.
        EXPECT_LE(residual, 4e-12);
    }
}

// ---------------------------------------------------------------- flights that turn

// The traveller's equations with Thomas' precession (Jackson, Classical Electrodynamics, 11.8), integrated in 33 digits: u'
// = a e + (the rate of gamma along u). Each axis of the cockpit turns, relative to the world's axes carried by the boost, by
// gamma^2/(gamma + 1) a x v for each unit of world time, plus the visitor's turn.
struct State {
    V3 x, u, e[3]; // place, proper velocity, cockpit axes in the ship
    Q t;
};
State rate(const State& s, const dvec3& acceleration, const dvec3& turn)
{
    const Q gamma = quad::gamma(s.u);
    const V3 v = s.u * (1 / gamma);
    const V3 proper_acceleration = s.e[0] * acceleration.x + s.e[1] * acceleration.y + s.e[2] * acceleration.z;
    // Acceleration in the world: the proper one divided by gamma^2 across the motion and by gamma^3 along it.
    const Q speed = quad::length(v);
    const V3 way = speed > 0 ? v * (1 / speed) : V3{0, 0, 0};
    const V3 along = way * quad::dot(way, proper_acceleration), across = proper_acceleration - along;
    const V3 a = across * (1 / (gamma * gamma)) + along * (1 / (gamma * gamma * gamma));
    const V3 thomas = quad::cross(a, v) * (gamma * gamma / (gamma + 1) * gamma); // per proper time
    const V3 visitor_turn = s.e[0] * turn.x + s.e[1] * turn.y + s.e[2] * turn.z;
    State r;
    r.x = s.u;
    r.t = gamma;
    // d(gamma v)/dtau = gamma (gamma a + gamma^3 (v.a) v)
    r.u = a * (gamma * gamma) + v * (gamma * gamma * gamma * gamma * quad::dot(v, a));
    for (int i = 0; i < 3; ++i)
        r.e[i] = quad::cross(thomas + visitor_turn, s.e[i]);
    return r;
}
State moved(const State& s, const State& r, Q h)
{
    State m{s.x + r.x * h, s.u + r.u * h, {}, s.t + r.t * h};
    for (int i = 0; i < 3; ++i)
        m.e[i] = s.e[i] + r.e[i] * h;
    return m;
}
State integrated(State s, const dvec3& acceleration, const dvec3& turn, Q tau, int steps)
{
    const Q h = tau / steps;
    for (int i = 0; i < steps; ++i) {
        const State k1 = rate(s, acceleration, turn), k2 = rate(moved(s, k1, h / 2), acceleration, turn),
                    k3 = rate(moved(s, k2, h / 2), acceleration, turn), k4 = rate(moved(s, k3, h), acceleration, turn);
        s = moved(moved(moved(moved(s, k1, h / 6), k2, h / 3), k3, h / 3), k4, h / 6);
    }
    return s;
}
State state_of(const Ship& ship)
{
    const auto axis = [&](const dvec3& e) { return quad::of(ship.ship_from_cockpit * e); };
    return {quad::of(ship.position.total()), quad::of(ship.u.total()), {axis({1, 0, 0}), axis({0, 1, 0}), axis({0, 0, 1})},
        ship.time.total()};
}
// The largest relative difference of position, u and time, or of the axes in radians.
double difference(const State& a, const State& b)
{
    Q worst = quad::length(a.x - b.x) / quad::length(a.x);
    worst = fmaxq(worst, quad::length(a.u - b.u) / quad::length(a.u));
    worst = fmaxq(worst, fabsq(a.t / b.t - 1));
    for (int i = 0; i < 3; ++i)
        worst = fmaxq(worst, quad::length(a.e[i] - b.e[i]));
    return double(worst);
}

// Constant thrust across a fast flight rotates the cockpit relative to the carried axes, though nobody turns it.
TEST(Fly, TheCockpitTurnsByThomasPrecession)
{
    for (const dvec3& u : {dvec3(.1, 0, 0), dvec3(2, -1, 3), dvec3(30, 0, -20)}) {
        Ship start = flying(u);
        start.ship_from_cockpit = glm::normalize(dquat(.5, .1, -.7, .3));
        const dvec3 acceleration(.7, -.4, 1.2);
        const double tau = 1.5;
        // Runge-Kutta of order 4 with 1000 steps of 2.2e-3: (2.2e-3)^4 / 120 * 2.2 = 4e-13, times powers of the rates below
        // 3.
        const State expected = integrated(state_of(start), acceleration, dvec3(0), tau, 1000);
        EXPECT_LE(difference(expected, state_of(fly(start, acceleration, dvec3(0), tau))), 1e-11);
        EXPECT_LE(difference(expected, state_of(flown(start, acceleration, tau, 600))), 1e-11);
    }
}

// With thrust and turn together, the error falls with the square of the step.
TEST(Fly, TurningFlightConvergesAsTheSquareOfTheStep)
{
    Ship start = flying({2, -1, 3});
    start.ship_from_cockpit = glm::normalize(dquat(.5, .1, -.7, .3));
    const dvec3 acceleration(.7, -.4, 1.2), turn(.3, 1.1, -.6);
    const double tau = 1.5;
    const State expected = integrated(state_of(start), acceleration, turn, tau, 1000);
    double error[3];
    for (int i = 0; i < 3; ++i) {
        const int steps = 60 << i;
        Ship ship = start;
        for (int k = 0; k < steps; ++k)
            ship = fly(ship, acceleration, turn * (tau / steps), tau / steps);
        error[i] = difference(expected, state_of(ship));
    }
    std::printf("  turning at 1.3 rad under thrust 1.4: error %.1e, %.1e, %.1e in 60, 120, 240 steps\n", error[0], error[1],
        error[2]);
    // A step's error is its length times the rates of thrust and turn, cubed, over 24. With the rates 1.4 and 1.3, 60 steps
    // give 1.5 (1.5 / 60)^2 2.7^3 / 24.
    EXPECT_LE(error[0], 1.5 * std::pow(1.5 / 60, 2) * std::pow(2.7, 3) / 24);
    EXPECT_NEAR(error[0] / error[1], 4, .1);
    EXPECT_NEAR(error[1] / error[2], 4, .1);
}

// A circular flight: the thrust a = gamma^2 v^2 / R points to the cockpit's left. To keep it there the cockpit turns by
// gamma^2 v/R per proper time relative to gyroscopes. After one orbit ship, velocity and cockpit are back, because the
// gyroscopes have turned by 360 (gamma - 1) degrees against the orbit.
TEST(Fly, CircularOrbitCloses)
{
    const double R = 2;
    for (double gamma : {1.02, 1.25, 2.0, 4.0}) {
        const double u = std::sqrt((gamma - 1) * (gamma + 1)), tau = 2 * pi * R / u;
        double away[2], off[2], facing[2];
        for (int fine = 0; fine < 2; ++fine) {
            const int steps = 4000 << fine;
            Ship ship = flying({0, 0, -u}); // the nose points ahead, left is -x; the orbit turns left about +y
            for (int i = 0; i < steps; ++i)
                ship = fly(ship, {-u * u / R, 0, 0}, {0, gamma * u / R * tau / steps, 0}, tau / steps);
            away[fine] = glm::length(ship.position.total()) / R;
            off[fine] = glm::length(ship.u.total() - dvec3(0, 0, -u)) / u;
            facing[fine] = 2 * std::hypot(ship.ship_from_cockpit.x, ship.ship_from_cockpit.y, ship.ship_from_cockpit.z);
            const double cut = std::pow(2 * pi * gamma / steps, 2) * 2 * pi * gamma;
            EXPECT_NEAR(ship.time.total() / (gamma * tau), 1, cut);
            EXPECT_NEAR(ship.distance.total() / (2 * pi * R), 1, cut);
        }
        std::printf(
            "  orbit at gamma %.2f: off by %.1e R, %.1e u, %.1e rad in 8000 steps\n", gamma, away[1], off[1], facing[1]);
        // The error of 8000 steps: (2 pi gamma / 8000)^2 of the turn, times the 2 pi gamma of the orbit.
        const double cut = std::pow(2 * pi * gamma, 3) / 8000 / 8000;
        EXPECT_LE(std::max({away[1], off[1], facing[1]}), cut);
        EXPECT_LE(away[1], .3 * away[0] + 1e-12);
    }
}

// The same orbit without the visitor's turn: small boosts aimed from outside. The remaining turn of the cockpit's axes is
// Thomas' precession.
TEST(Fly, AnOrbitOfBoostsTurnsByThomasPrecession)
{
    for (double gamma : {1.02, 1.25, 2.0}) {
        double turn_deg[2];
        for (int fine = 0; fine < 2; ++fine) {
            const double u = std::sqrt((gamma - 1) * (gamma + 1));
            const int steps = 10000 << fine;
            const auto on_orbit = [&](int i) {
                const double a = 2 * pi * i / steps;
                return dvec3(u * std::cos(a), u * std::sin(a), 0);
            };
            Ship ship = flying(on_orbit(0));
            double turned = 0;
            dvec3 mark = ship.ship_from_cockpit * dvec3(1, 0, 0);
            for (int i = 0; i < steps; ++i) {
                const V3 next = quad::of(on_orbit(i + 1));
                const V3 w = quad::boosted(quad::of(ship.u.total()) * -1, {quad::gamma(next), next}).x;
                const dvec3 boost(double(w.x), double(w.y), double(w.z));
                const double rapidity = std::asinh(glm::length(boost));
                ship = fly(ship, glm::conjugate(ship.ship_from_cockpit) * glm::normalize(boost), dvec3(0), rapidity);
                const dvec3 now = ship.ship_from_cockpit * dvec3(1, 0, 0);
                turned += std::asin(glm::cross(mark, now).z);
                mark = now;
            }
            turn_deg[fine] = turned * 180 / pi;
        }
        // A polygon of n velocities differs from the circle by 1/n^2, here 2e-5 degrees; Richardson's extrapolation leaves
        // 1/n^4.
        EXPECT_NEAR(turn_deg[1] + (turn_deg[1] - turn_deg[0]) / 3, -360 * (gamma - 1), 1e-8) << gamma;
    }
}

TEST(Fly, TheQuaternionStaysNormalized)
{
    Ship ship;
    double worst = 0;
    for (int i = 0; i < 200000; ++i) {
        const double s = std::sin(i * 1e-3);
        ship = fly(ship, {s, -.3 * s, std::cos(i * 1e-3)}, {.01 * s, .02, -.015}, .01);
        worst = std::max(worst, std::abs(glm::length(ship.ship_from_cockpit) - 1));
    }
    EXPECT_LE(worst, 7e-16); // it is normalized when its square is 1e-15 off, up to a rounding
}

} // namespace

} // namespace ship_test
