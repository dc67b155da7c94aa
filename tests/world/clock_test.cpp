// Clocks without a device: the arithmetic after months, figures, table entries, and the shipped scene.
#include "config/model/scene_file.h"
#include "runtime/world/clock.h"
#include "runtime/world/eye_event.h"
#include "runtime/world/instances.h"
#include "tests/support/dial.h"
#include "tests/support/files.h"
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>
#include <random>
extern "C" {
#include <quadmath.h>
}

namespace clock_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

/// The reading in 33 digits.
__float128 exact_reading(double zero_s, double time, const glm::dvec3& place, double spt)
{
    const __float128 x = place.x, y = place.y, z = place.z;
    return (__float128(time) - sqrtq(x * x + y * y + z * z)) * spt - zero_s;
}

/// Flat objects at places; each names its material by index, and its mesh reaches from -1 to 3.
World world_of(const std::vector<std::pair<int, glm::dvec3>>& things, std::vector<Material> materials)
{
    World world;
    world.materials = std::move(materials);
    for (std::size_t i = 0; i < world.materials.size(); ++i) {
        Primitive primitive{};
        primitive.material = int(i);
        primitive.low = {-1, -1, 0}, primitive.high = {3, 1, 0};
        world.primitives.push_back(primitive);
    }
    for (const auto& [material, place] : things) {
        glm::dmat4 m(1);
        m[3] = glm::dvec4(place, 1);
        world.instances.push_back({m, std::uint32_t(material)});
    }
    sort_instances(world);
    return world;
}

Material clock_of(double zero_s)
{
    Material material;
    material.clock = WorldClock{zero_s};
    return material;
}

} // namespace

TEST(ClockTest, TheLightTravelTimeIsSubtracted)
{
    // A Gamow world: a unit is 2 m, light flies at 5 m/s.
    EXPECT_EQ(reading_s({0}, 100, 10, 0.4), 36);
    EXPECT_EQ(reading_s({1.5}, 100, 10, 0.4), 34.5);
    EXPECT_EQ(reading_s({}, 5, 10, 1), -5);
}

TEST(ClockTest, ReadingsAreExactAfterMonths)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part(-1, 1);
    double worst = 0;
    for (int i = 0; i < 10000; ++i) {
        const double time = 1e7 * (1 + 0.1 * part(random)), zero_s = 1e7 * part(random);
        const glm::dvec3 place = 1e3 * glm::dvec3(part(random), part(random), part(random));
        const double measured = reading_s({zero_s}, time, glm::length(place), 1);
        worst = std::max(worst, std::abs(double(measured - exact_reading(zero_s, time, place, 1))));
    }
    // Two roundings of numbers below 2^24 and one below 2^25: at most 2^-29 each.
    EXPECT_LT(worst, 3 * std::ldexp(1, -29));
    // With a metre for a unit, times are 3e15 and resolve half a metre of light.
    EXPECT_NEAR(reading_s({0}, 1e7 * 299792458, 31, 1.0 / 299792458), 1e7 - 31 / 299792458.0, 4e-9);
}

TEST(ClockTest, FiguresRoundToTenths)
{
    const std::vector<std::pair<double, const char*>> cases = {{0, "0.0"}, {-0.04, "0.0"}, {0.04, "0.0"}, {-5.90909, "-5.9"},
        {2.21961, "2.2"}, {9.96, "10.0"}, {-0.06, "-0.1"}, {1e7 + 0.26, "10000000.3"}, {9999999999.9, "9999999999.9"},
        {-9999999999.9, "-9999999999.9"}, {1e10, "---.-"}, {-1e300, "---.-"}, {NAN, "---.-"}};
    for (const auto& [reading, shown] : cases)
        EXPECT_EQ(figures(reading), shown) << reading;
}

TEST(ClockTest, EntriesAreRelativeToTheEyeAndComeFirst)
{
    const World world = world_of({{0, {0, 0, 0}}, {2, {4, 0, -10}}, {1, {0, 5, -10}}, {0, {1, 1, 1}}, {1, {-4, 0, 2}}},
        {{}, clock_of(0), clock_of(7)});
    const glm::dvec3 eye(1, 0, 3);
    const double time = 1e7 + 0.625, spt = 2;
    const glm::dmat3 turn = glm::mat3_cast(glm::normalize(glm::dquat(0.3, -0.5, 0.2, 0.9)));
    const auto entries = time_entries(world, {0, eye, time, turn}, spt);
    ASSERT_EQ(entries.size(), 3u);
    // The middle of each mesh is at 1, 0, 0.
    const std::vector<std::pair<double, glm::dvec3>> expected = {{0, {1, 5, -10}}, {0, {-3, 0, 2}}, {7, {5, 0, -10}}};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& [zero_s, middle] = expected[i];
        EXPECT_LT(glm::length(glm::dvec3(entries[i].middle) - turn * (middle - eye)), 1e-5);
        EXPECT_NEAR(entries[i].middle.w, glm::length(middle - eye), 1e-5);
        const __float128 reading = exact_reading(zero_s, time, middle - eye, spt);
        for (auto [measured, turn_s] :
            {std::pair(entries[i].turns.x, 60), {entries[i].turns.y, 10}, {entries[i].turns.z, 3600}})
            // A double's rounding at 2e7 s, then a float's over one turn.
            EXPECT_NEAR(measured * turn_s, double(fmodq(reading, turn_s)), 1e-8 + 6e-8 * turn_s);
        EXPECT_EQ(entries[i].turns.w, 2);
        EXPECT_NEAR(std::stod(dial_text(entries[i])), double(reading), 0.05 + 1e-8);
    }
}

TEST(ClockTest, HandsGoBackwardsBeforeZero)
{
    const World world = world_of({{0, {-1, 0, -31}}}, {clock_of(0)});
    const auto entries = time_entries(world, {0, {0, 0, 0}, 31 - 5.9}, 1);
    ASSERT_EQ(entries.size(), 1u);
    EXPECT_NEAR(entries[0].turns.x, 1 - 5.9 / 60, 1e-7);
    EXPECT_NEAR(entries[0].turns.y, 1 - 5.9 / 10, 1e-7);
    EXPECT_NEAR(entries[0].turns.z, 1 - 5.9 / 3600, 1e-7);
    EXPECT_EQ(dial_text(entries[0]), "-5.9");
}

TEST(ClockTest, AWorldWithoutClocksHasNoEntries)
{
    EXPECT_TRUE(time_entries(world_of({{0, {0, 0, 0}}}, {{}}), {}, 1).empty());
}

TEST(ClockTest, TheShippedSceneIsThePapersRow)
{
    expect_made_by_its_program("clocks", 200'000);
    World world = load_world(source_dir() / "scenes/clocks/clocks.glb");
    EXPECT_EQ(world.notes, std::vector<std::string>{});
    sort_instances(world);
    const SceneFile scene = load_scene_file(source_dir() / "config/scenes/clocks.json");
    EXPECT_EQ(scene.seconds_per_time_unit(), 1);
    const auto entries = time_entries(world, {0, {0, 0, 31}, 31}, 1);
    ASSERT_EQ(entries.size(), 5u);
    for (int i = 0; i < 5; ++i)
        EXPECT_LT(glm::length(glm::dvec3(entries[std::size_t(i)].middle) - glm::dvec3(5 * i - 10, 0, -31)), 1e-5);
    // The passing and the stopped shot are at one event.
    const Shot passing = load_shot(source_dir() / "config/shots/clocks-passing.json"),
               stopped = load_shot(source_dir() / "config/shots/clocks-stopped.json");
    EXPECT_EQ(passing.position, stopped.position);
    EXPECT_EQ(passing.time, stopped.time);
    EXPECT_EQ(stopped.u, glm::dvec3(0));
    EXPECT_NEAR(glm::length(passing.u), 1 / std::sqrt(3), 1e-15);
}

} // namespace clock_test
