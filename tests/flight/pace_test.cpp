// The pace of a flight: a held throttle leads through a world in its planned time, whoever holds it.
#include "config/model/angles.h"
#include "config/model/scene_file.h"
#include "config/model/shipped.h"
#include "runtime/flight/flight.h"
#include "runtime/flight/pace.h"
#include "runtime/world/surroundings.h"
#include "tests/support/controls.h"
#include "tests/support/files.h"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace pace_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

constexpr std::int64_t frame_ns = 16'000'000;

struct Paced {
    SceneFile scene;
    Flying rules{.max_gamma = 100};
    Flight flight;
    double time_s = 0;

    explicit Paced(const std::string& name)
        : scene(load_scene_file(shipped_file("scenes", name)))
    {
        rules.boundary = scene.boundary;
        rules.pace = pace_for(*scene.planned, things_at_rest(scene), scene.start, rules, scene.seconds_per_time_unit());
        flight = flight_at(scene.start, rules);
    }
    void frame(const Controls& controls)
    {
        flight = step(flight, controls, frame_ns, rules, scene.seconds_per_time_unit(), scene.start);
        time_s += 1e-9 * frame_ns;
    }
};

Ship ship_with(const glm::dvec3& position, double rapidity)
{
    Shot shot;
    shot.position = position;
    shot.u = {0, 0, -std::sinh(rapidity)};
    return ship_at(shot);
}

} // namespace

TEST(PaceTest, TheNearestThingIsThatOfDensePointsOfAllBoxes)
{
    const Pace pace{.per_s2 = 1, .least = 0.01, .things = {{{-1, -1, -1}, {1, 1, 1}}, {{3, 0, 0}, {5, 2, 1}}}};
    std::mt19937 random{7};
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    for (int i = 0; i < 40; ++i) {
        const glm::dvec3 place(uniform(-6, 8), uniform(-4, 4), uniform(-4, 4));
        double least = 1e300;
        constexpr int steps = 40;
        for (const auto& [low, high] : pace.things)
            for (int x = 0; x <= steps; ++x)
                for (int y = 0; y <= steps; ++y)
                    for (int z = 0; z <= steps; ++z)
                        least = std::min(
                            least, glm::distance(place, low + (high - low) * glm::dvec3(x, y, z) / double(steps)));
        EXPECT_NEAR(nearest(pace, place), std::max(least, pace.least), 0.05);
    }
    EXPECT_EQ(nearest(pace, {0, 0, 0}), pace.least) << "inside";
    EXPECT_EQ(nearest({.least = 3}, {0, 0, 0}), 3) << "an empty world";
}

TEST(PaceTest, GammaGrowsEvenlyAtOneDistance)
{
    // dw = k d / sinh w: so gamma = 1 + k d t, and after t it has covered the integral of sqrt(gamma^2 - 1).
    const Pace pace{.per_s2 = 0.2, .least = 0.5};
    Flying rules{.max_gamma = 1e6};
    rules.pace = pace;
    const Shot start;
    Flight flight = flight_at(start, rules);
    const Controls open = controls_with(Steering{.lever = 1.0});
    flight = step(flight, open, 10'000'000'000, rules, 1, start);
    const double at_10 = std::cosh(rapidity_of(flight.ship));
    flight = step(flight, open, 20'000'000'000, rules, 1, start);
    EXPECT_NEAR(std::cosh(rapidity_of(flight.ship)) - at_10, 0.2 * 0.5 * 20, 0.02);
    EXPECT_NEAR(at_10, 1 + 0.2 * 0.5 * 10, 0.1) << "but for the start, which the greatest gain limits";
}

TEST(PaceTest, AGainIsTheMoreTheLongerTheWayToTheNearestThing)
{
    const Pace pace{.per_s2 = 0.3, .least = 0.1, .things = {{{-1, -1, -1}, {1, 1, 1}}}};
    // 4 units away at u = 2: 2 units of time; a unit is 5 s.
    EXPECT_NEAR(paced_gain(pace, ship_with({0, 0, 5}, std::asinh(2)), 5), 0.3 * 2 * 5, 1e-12);
    EXPECT_TRUE(std::isinf(paced_gain(pace, ship_with({0, 0, 5}, 0), 5)));
}

TEST(PaceTest, EveryWorldIsFlownThroughInItsPlannedTime)
{
    for (const std::string& name : shipped_names("scenes")) {
        SCOPED_TRACE(name);
        Paced world(name);
        ASSERT_TRUE(world.scene.planned);
        world.rules.boundary.reset();
        const glm::dvec3 start = world.scene.start.position;
        world.frame(controls_with(Steering{.lever = 0.9})); // a throttle that is not moved leaves a start in flight as it is
        while (
            glm::distance(world.flight.ship.position.total(), start) < world.scene.planned->distance && world.time_s < 100)
            world.frame(controls_with(Steering{.lever = 1.0}));
        // The plan leaves out the pilot's delay, about a second.
        EXPECT_NEAR(world.time_s, world.scene.planned->time_s, 0.1 * world.scene.planned->time_s);
        const double gamma = std::cosh(rapidity_of(world.flight.ship));
        RecordProperty(name, std::to_string(world.time_s) + " s, gamma " + std::to_string(gamma));
    }
}

TEST(PaceTest, FlightsPassTheAvenuesColumnsInTwentyToFortySeconds)
{
    double shortest = 1e300, longest = 0;
    for (int seed = 0; seed < (starbow::testing::all_cases() ? 100 : 25); ++seed) {
        std::mt19937 random{unsigned(seed)};
        const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
        Paced world("avenue");
        Controls controls;
        if (seed % 2 == 0)
            controls.lever = uniform(0.25, 1);
        else
            controls.throttle_rate = 1;
        std::optional<double> passed_s;
        double farthest = 0;
        while (world.time_s < 120) {
            // A hand that is not quite still.
            if (std::fmod(world.time_s, 2) < 1e-9 * frame_ns)
                controls.turn = {uniform(-0.04, 0.04), uniform(-0.04, 0.04), 0};
            world.frame(controls);
            const glm::dvec3 at = world.flight.ship.position.total();
            if (!passed_s && at.z < -41)
                passed_s = world.time_s;
            farthest = std::max(farthest, glm::distance(at, world.rules.boundary->centre) / world.rules.boundary->radius);
        }
        ASSERT_TRUE(passed_s) << seed;
        EXPECT_GE(*passed_s, 20) << seed;
        EXPECT_LE(*passed_s, 40) << seed;
        EXPECT_LT(farthest, 1) << seed;
        shortest = std::min(shortest, *passed_s), longest = std::max(longest, *passed_s);
    }
    std::printf("the columns are passed in %.1f to %.1f s\n", shortest, longest);
}

TEST(PaceTest, AKeyLetGoLeavesTheSpeedAsItIs)
{
    Paced world("avenue");
    while (world.time_s < 10)
        world.frame(controls_with(Steering{.throttle_rate = 1}));
    const double before = rapidity_of(world.flight.ship);
    while (world.time_s < 20)
        world.frame({});
    EXPECT_GT(before, 0.5);
    EXPECT_NEAR(rapidity_of(world.flight.ship), before, 0.1);
}

TEST(PaceTest, APaceHindersNobodyFromSlowingDown)
{
    Paced world("avenue");
    while (world.time_s < 20)
        world.frame(controls_with(Steering{.lever = 1.0}));
    EXPECT_GT(rapidity_of(world.flight.ship), 1);
    while (world.time_s < 24)
        world.frame(controls_with(Steering{.lever = 0.0}));
    EXPECT_LT(rapidity_of(world.flight.ship), 0.05);
}

TEST(SlowMotionTest, OnlyTheTimeOnBoardIsSlower)
{
    const Shot start;
    const Flying rules{.max_gamma = 100};
    const Controls flown = controls_with(Steering{.lever = 0.4, .turn = {0, 0.3, 0}});
    Flight usual = flight_at(start, rules), slow = usual;
    slow = step(slow, controls_with(Switches{Switch::slow_motion}), 0, rules, 1, start);
    EXPECT_EQ(time_rates[slow.time_scale], 0.25);
    usual = step(usual, flown, 3'000'000'000, rules, 1, start);
    slow = step(slow, flown, 3'000'000'000, rules, 1, start);
    EXPECT_NEAR(slow.ship.proper_time.total(), 0.75, 1e-12);
    EXPECT_NEAR(usual.ship.proper_time.total(), 3, 1e-12);
    EXPECT_NEAR(slow.ship.distance.total(), usual.ship.distance.total() / 4, 1e-6);
    EXPECT_LT(angle_between(
                  slow.ship.ship_from_cockpit * glm::dvec3(0, 0, -1), usual.ship.ship_from_cockpit * glm::dvec3(0, 0, -1)),
        1e-6)
        << "the same controls lead to the same velocity and the same look";
    EXPECT_NEAR(rapidity_of(slow.ship), rapidity_of(usual.ship), 1e-6);
    const Controls press = controls_with(Switches{Switch::slow_motion});
    slow = step(slow, press, 0, rules, 1, start);
    EXPECT_EQ(time_rates[slow.time_scale], 0.0625);
    slow = step(slow, press, 0, rules, 1, start);
    EXPECT_EQ(time_rates[slow.time_scale], 1);
}

TEST(SlowMotionTest, TheFlightThroughAWorldLastsItsPlannedTimeAtAGreaterGamma)
{
    double gamma[2], time_s[2];
    for (int slow = 0; slow < 2; ++slow) {
        Paced world("avenue");
        if (slow)
            world.frame(controls_with(Switches{Switch::slow_motion}));
        while (world.flight.ship.position.total().z > -41)
            world.frame(controls_with(Steering{.lever = 1.0}));
        gamma[slow] = std::cosh(rapidity_of(world.flight.ship)), time_s[slow] = world.time_s;
    }
    // But for the beginning: the greatest gain of speed takes some seconds to a greater gamma.
    EXPECT_NEAR(time_s[1], time_s[0], 7);
    EXPECT_GT(gamma[1], 3 * gamma[0]);
}

} // namespace pace_test
