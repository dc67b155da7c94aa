// Planets are solid: nobody flies into them, and whoever flies straight at one comes to rest above its ground.
#include "config/model/scene_file.h"
#include "config/model/shipped.h"
#include "config/model/shot.h"
#include "runtime/flight/flight.h"
#include "runtime/flight/solids.h"
#include "runtime/world/ephemeris.h"
#include "runtime/world/stars.h"
#include "runtime/world/surroundings.h"
#include "tests/support/controls.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>
#include <random>

namespace solids_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

SceneFile solar_system() { return load_scene_file(shipped_file("scenes", "solar-system")); }

/// The least height of a flight above any ground, as a part of that solid's radius.
double height(const std::vector<Solid>& solids, const Ship& ship)
{
    double least = 1e300;
    for (const Solid& solid : solids)
        least = std::min(least, glm::distance(place_of(solid, ship.time.total()), ship.position.total()) / solid.radius - 1);
    return least;
}

struct Pilot {
    SceneFile scene = solar_system();
    Flying rules{.max_gamma = 1e4, .solids = solid_globes(scene)};
    Flight flight;
    double lowest = 1e300;

    explicit Pilot(const Shot& start) { flight = flight_at(start, rules); }
    void hold(const Controls& controls, double seconds)
    {
        for (int i = 0; i < seconds / 0.016; ++i) {
            flight = step(flight, controls, 16'000'000, rules, scene.seconds_per_time_unit(), scene.start);
            lowest = std::min(lowest, height(rules.solids, flight.ship));
        }
    }
};

} // namespace

TEST(SolidsTest, GroundsFollowTheGlobesForTwoDays)
{
    const SceneFile scene = solar_system();
    const SolarSystem system = load_solar_system(scene.globes->file);
    const WorldOrigin origin = world_origin(system, *scene.globes);
    const glm::dmat3 turn = world_from_equatorial(scene.stars->ahead_deg);
    const std::vector<Solid> solids = solid_globes(scene);
    ASSERT_EQ(solids.size(), system.globes.size());
    for (double hours = 0; hours <= 48; hours += 1.7) {
        const std::vector<glm::dvec3> places = globe_places_m(system, origin.days + hours / 24);
        for (std::size_t i = 0; i < solids.size(); ++i) {
            const glm::dvec3 true_m = turn * (places[i] - origin.at(hours * 3600));
            const glm::dvec3 found_m = place_of(solids[i], hours * 3600 / scene.seconds_per_time_unit()) * scene.unit_m;
            EXPECT_LT(glm::distance(true_m, found_m), 1000) << system.globes[i].name << " after " << hours << " h";
            EXPECT_GT(solids[i].radius * scene.unit_m, system.globes[i].radius_m);
        }
    }
}

TEST(SolidsTest, WhoFliesAtAPlanetComesToRestAboveIt)
{
    for (const char* name : {"solar-system", "earth", "moon", "jupiter", "saturn", "sun", "earth-10km"})
        for (const FlightMode mode : {FlightMode::guided, FlightMode::free, FlightMode::newtonian}) {
            SCOPED_TRACE(name + std::string(", ") + std::string(name_of(mode)));
            const Shot start
                = std::string(name) == "solar-system" ? solar_system().start : load_shot(shipped_file("shots", name));
            Pilot pilot(start);
            pilot.rules.mode = pilot.flight.mode = mode;
            pilot.hold(controls_with(Steering{.lever = 1.0}), 60);
            EXPECT_GE(pilot.lowest, -1e-9);
            if (std::string(name) == "earth-10km")
                continue; // it looks at the horizon, and flies away
            EXPECT_LT(height(pilot.rules.solids, pilot.flight.ship), 0.01);
            EXPECT_LT(rapidity_of(pilot.flight.ship), 0.1);
        }
}

TEST(SolidsTest, WhoPassesIsNotHeld)
{
    // Half a radius above the Earth's ground, straight past it.
    Shot start;
    start.position = {-0.1, 0.032, 0};
    start.ship_from_cockpit = glm::dquat(std::sqrt(0.5), 0, -std::sqrt(0.5), 0); // nose along +x
    Pilot pilot(start);
    Flight alone = pilot.flight;
    Flying without = pilot.rules;
    without.solids.clear();
    for (int i = 0; i < 300; ++i) {
        pilot.hold(controls_with(Steering{.lever = 0.1}), 0.016);
        alone = step(alone, controls_with(Steering{.lever = 0.1}), 16'000'000, without, 1, start);
    }
    EXPECT_GT(pilot.flight.ship.position.total().x, 0.1);
    EXPECT_EQ(pilot.flight.ship.position.total(), alone.ship.position.total());
}

TEST(SolidsTest, NoRandomFlightGetsIntoAPlanet)
{
    const char* starts[] = {"earth", "moon", "saturn", "sun", "earth-400km"};
    for (int seed = 0; seed < (all_cases() ? 300 : 15); ++seed) {
        std::mt19937 random{unsigned(seed)};
        const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
        Pilot pilot(load_shot(shipped_file("shots", starts[seed % 5])));
        pilot.rules.mode = pilot.flight.mode = FlightMode(seed % 3);
        for (int part = 0; part < 15; ++part) {
            Controls controls = controls_with(Steering{.lever = uniform(0, 1) < 0.3 ? 0 : uniform(0, 0.4)});
            controls.turn = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
            pilot.hold(controls, 2);
        }
        EXPECT_GE(pilot.lowest, -1e-9) << seed;
    }
}

} // namespace solids_test
