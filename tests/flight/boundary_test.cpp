// The end of a world: whatever the visitors do, the ship slows down before it, flies home, and is felt no more than the
// rules allow.
#include "config/model/angles.h"
#include "config/model/scene_file.h"
#include "config/model/shipped.h"
#include "runtime/flight/boundary.h"
#include "runtime/flight/flight.h"
#include "tests/support/controls.h"
#include "tests/support/files.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <random>

namespace boundary_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

struct Pilot {
    SceneFile scene;
    Flying rules{.max_gamma = 100};
    Flight flight;
    double farthest = 0; ///< of the boundary's radius
    int homings = 0, arrivals = 0, turns = 0;

    explicit Pilot(const std::string& name, FlightMode mode = FlightMode::guided)
        : scene(load_scene_file(shipped_file("scenes", name)))
    {
        rules.mode = mode;
        rules.boundary = scene.boundary;
        // So large a world that light crosses it in more than 100 seconds on board at that gamma needs a greater one.
        rules.max_gamma = std::max(rules.max_gamma, scene.boundary->radius * scene.seconds_per_time_unit() / 10);
        flight = flight_at(scene.start, rules);
    }
    void frame(const Controls& controls)
    {
        const bool before = flight.homing.has_value(), turned = flight.homeward;
        flight = step(flight, controls, 16'000'000, rules, scene.seconds_per_time_unit(), scene.start);
        homings += !before && flight.homing;
        turns += !turned && flight.homeward;
        if (before && !flight.homing) {
            ++arrivals;
            EXPECT_LT(flight.ship.proper_time.total() * scene.seconds_per_time_unit(), 0.1) << "clocks begin anew";
        }
        farthest = std::max(
            farthest, glm::distance(flight.ship.position.total(), rules.boundary->centre) / rules.boundary->radius);
    }
    void hold(const Controls& controls, double seconds)
    {
        for (int i = 0; i < seconds / 0.016; ++i)
            frame(controls);
    }
};

} // namespace

TEST(BoundaryTest, EveryShippedWorldHasOneAroundItsStart)
{
    for (const std::string& name : shipped_names("scenes")) {
        const SceneFile scene = load_scene_file(shipped_file("scenes", name));
        ASSERT_TRUE(scene.boundary) << name;
        EXPECT_LT(glm::distance(scene.start.position, scene.boundary->centre), 0.7 * scene.boundary->radius) << name;
    }
}

TEST(BoundaryTest, AHeldThrottleLeadsHomeAndNotOutOfTheWorld)
{
    for (const std::string& name : shipped_names("scenes")) {
        SCOPED_TRACE(name);
        Pilot pilot(name, FlightMode::free);
        pilot.hold(controls_with(Steering{.throttle_rate = 1}), 120);
        EXPECT_LT(pilot.farthest, 1);
        EXPECT_GE(pilot.homings, 1);
        EXPECT_GE(pilot.arrivals, 1);
        if (pilot.scene.start.u != glm::dvec3(0))
            continue; // a start in flight goes on from there under the key, and home again
        EXPECT_EQ(pilot.homings, 1);
        EXPECT_EQ(rapidity_of(pilot.flight.ship), 0) << "a key that is still held has no effect";
        pilot.hold({}, 0.1);
        pilot.hold(controls_with(Steering{.throttle_rate = 1}), 4);
        EXPECT_GT(rapidity_of(pilot.flight.ship), 0.5);
    }
}

TEST(BoundaryTest, AGuidedShipTurnsRoundAndFliesOn)
{
    for (const std::string& name : shipped_names("scenes")) {
        SCOPED_TRACE(name);
        Pilot pilot(name);
        const Flying& rules = pilot.rules;
        double closest = 1e300, most_turn = 0, most_gain = 0, before = rapidity_of(pilot.flight.ship);
        for (int i = 0; i < 200 / 0.016; ++i) {
            pilot.frame(controls_with(Steering{.lever = 1.0}));
            if (pilot.turns > 0)
                closest = std::min(closest, glm::distance(pilot.flight.ship.position.total(), pilot.scene.start.position));
            most_turn = std::max(most_turn, glm::length(pilot.flight.turn_rad_s) / degree);
            const double now = rapidity_of(pilot.flight.ship);
            most_gain = std::max(most_gain, std::abs(now - before) / 0.016);
            before = now;
        }
        EXPECT_LT(pilot.farthest, 1);
        EXPECT_GE(pilot.turns, 2) << "from one end of the world to the other";
        EXPECT_EQ(pilot.homings, 0);
        EXPECT_LT(closest, 0.1 * rules.boundary->radius) << "the way leads past the start";
        EXPECT_LT(most_turn, 1.01 * std::hypot(rules.turn_deg_per_s, rules.turn_deg_per_s));
        EXPECT_LE(most_gain, 1.01 * rules.rapidity_per_s);
    }
}

TEST(BoundaryTest, ATurnRoundEndsWithTheNoseToTheStart)
{
    Pilot pilot("avenue");
    while (pilot.turns == 0)
        pilot.frame(controls_with(Steering{.lever = 1.0}, Looking{}));
    while (pilot.flight.homeward)
        pilot.frame(controls_with(Steering{.lever = 1.0, .turn = {1, -1, 0}})); // the stick has no effect meanwhile
    const glm::dvec3 nose = pilot.flight.ship.ship_from_cockpit * glm::dvec3(0, 0, -1);
    const glm::dvec3 way = pilot.scene.start.position - pilot.flight.ship.position.total();
    EXPECT_LT(angle_between(nose, way) / degree, 5);
    const double before = glm::length(way);
    pilot.hold(controls_with(Steering{.lever = 1.0}), 2);
    EXPECT_LT(glm::distance(pilot.flight.ship.position.total(), pilot.scene.start.position), before);
    pilot.hold(controls_with(Steering{.turn = {0, 1, 0}}), 1);
    EXPECT_GT(pilot.flight.turn_rad_s.y, 0.5) << "the stick turns the nose again";
}

TEST(BoundaryTest, NoRandomFlightLeavesTheWorld)
{
    for (const std::string& name : shipped_names("scenes"))
        for (int seed = 0; seed < (all_cases() ? 100 : 6); ++seed) {
            std::mt19937 random{unsigned(seed)};
            const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
            Pilot pilot(name, FlightMode(seed % 3));
            Controls controls;
            for (int part = 0; part < 40; ++part) {
                controls.lever = uniform(0, 1) < 0.2 ? 0 : uniform(0, 1);
                controls.turn = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
                controls.push = {uniform(-1, 1), 0, 0};
                pilot.hold(controls, 3);
            }
            // Newtonian flight has no brakes but the way home.
            EXPECT_LT(pilot.farthest, seed % 3 == int(FlightMode::newtonian) ? 100 : 1.0) << name << ", seed " << seed;
        }
}

TEST(BoundaryTest, TheGreatestRapidityIsThatOfHyperbolicMotion)
{
    // From gamma 2 with 0.4 of 1.5 per second a ship needs (2 - 1) / 0.6 s of light, to the edge at 0.9 of the radius.
    const Flying rules{.rapidity_per_s = 1.5};
    Ship ship = ship_at(Shot{});
    const Boundary boundary{{0, 0, 0}, 1 / 0.6 / 0.9};
    EXPECT_NEAR(rapidity_within(boundary, ship, rules, 1), std::acosh(2.0), 1e-12);
    EXPECT_NEAR(rapidity_within({{0, 0, 0}, 2 / 0.6 / 0.9}, ship, rules, 0.5), std::acosh(2.0), 1e-12)
        << "other units of length";
    Shot beyond;
    beyond.position = {0, 0, 5}; // the nose points to -z
    EXPECT_TRUE(std::isinf(rapidity_within(boundary, ship_at(beyond), rules, 1))) << "on the way back";
    beyond.position = {0, 0, -5};
    EXPECT_EQ(rapidity_within(boundary, ship_at(beyond), rules, 1), 0);
}

} // namespace boundary_test
