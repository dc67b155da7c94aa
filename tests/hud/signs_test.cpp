// Signs say what is true, at the place where the thing is seen, and only while it is seen.
#include "config/model/scene_file.h"
#include "runtime/hud/signs.h"
#include "runtime/world/surroundings.h"
#include "runtime/world/world.h"
#include "tests/support/files.h"
#include "tests/support/shots.h"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace signs_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

AlignedBox box_at(const glm::dvec3& middle, double half) { return {middle - half, middle + half}; }

/// Flies along -z at the origin and looks that way, at a speed that gives this Doppler factor ahead.
Shot ahead_at(double E) { return shot_at({0, 0, 0}, {0, 0, -0.5 * (E - 1 / E)}); }

std::optional<Sign> sign(const Shot& shot, const std::vector<AlignedBox>& things, const std::optional<Sign>& before = {})
{
    return sign_for(shot, things, World{}, 1, 0, before);
}

} // namespace

TEST(Signs, AThingBehindIsPointedAtWhereItIsSeen)
{
    // 110 degrees from the motion in the world; tan(seen / 2) = tan(world / 2) / E (Penrose's form of aberration).
    const double world = glm::radians(110.0), E = 10;
    const glm::dvec3 middle = 10.0 * glm::dvec3(std::sin(world), 0, -std::cos(world));
    const auto found = sign(ahead_at(E), {box_at(middle, 1)});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->kind, Sign::Kind::behind);
    const double seen = 2 * std::atan(std::tan(world / 2) / E);
    EXPECT_NEAR(found->towards.x, std::sin(seen), 1e-12);
    EXPECT_NEAR(found->towards.z, -std::cos(seen), 1e-12);
    EXPECT_NEAR(found->light_s, 10, 1e-12);
}

TEST(Signs, NothingIsSaidThatIsNotSo)
{
    const double world = glm::radians(110.0), E = 10;
    const glm::dvec3 way(std::sin(world), 0, -std::cos(world));
    const std::vector<AlignedBox> behind{box_at(10.0 * way, 1)};
    EXPECT_FALSE(sign(ahead_at(1), behind)) << "at rest it is out of sight";
    EXPECT_FALSE(sign(ahead_at(1.3), behind)) << "too slow for it to be seen ahead";
    EXPECT_FALSE(sign(ahead_at(E), {box_at({2, 0, -10}, 1)})) << "it lies ahead";
    EXPECT_FALSE(sign(ahead_at(E), {box_at(1e4 * way, 1)})) << "too small to be told apart";
    Shot shot = ahead_at(E);
    shot.effects.on.set(Effect::aberration, false);
    EXPECT_FALSE(sign(shot, behind));
    shot = ahead_at(E);
    shot.effects.comparison = Comparison::galilean;
    EXPECT_FALSE(sign(shot, behind));
    shot = ahead_at(E);
    shot.ship_from_cockpit = orientation({0, 0, 1}, {0, 1, 0});
    EXPECT_FALSE(sign(shot, behind)) << "the visitor looks back";
}

// cos 92 degrees is -0.035 and cos 94 degrees -0.070, on this and on that side of a twentieth behind abeam.
TEST(Signs, AbeamIsNotBehindAtAnySpeed)
{
    for (const double E : {7.0, 10.0, 30.0})
        for (const double degrees : {92.0, 94.0}) {
            const double world = glm::radians(degrees);
            const glm::dvec3 middle = 10.0 * glm::dvec3(std::sin(world), 0, -std::cos(world));
            EXPECT_EQ(sign(ahead_at(E), {box_at(middle, E / 10)}).has_value(), degrees > 93) << E << ' ' << degrees;
        }
}

TEST(Signs, AThingInTheDarkHasNoSign)
{
    // Seen at 20 degrees: at E = 100 its D is 0.33 where straight ahead it is 100, and 3.6e-8 of the light is left.
    const double E = 100, seen = glm::radians(20.0), world = 2 * std::atan(E * std::tan(seen / 2));
    const std::vector<AlignedBox> things{box_at(10.0 * glm::dvec3(std::sin(world), 0, -std::cos(world)), 0.2)};
    Shot shot = ahead_at(E);
    EXPECT_TRUE(sign(shot, things)) << "shapes alone";
    shot.effects = {};
    EXPECT_FALSE(sign(shot, things));
    const double slower = 8, world_there = 2 * std::atan(slower * std::tan(seen / 2));
    shot = ahead_at(slower);
    shot.effects = {};
    EXPECT_TRUE(sign(shot, {box_at(10.0 * glm::dvec3(std::sin(world_there), 0, -std::cos(world_there)), 0.4)}));
}

TEST(Signs, AThingThatAnotherOneHidesHasNoSign)
{
    const double world = glm::radians(110.0), E = 10;
    const glm::dvec3 way(std::sin(world), 0, -std::cos(world));
    // The nearer one is a plate beside the line of sight, then on it. It is too thin to have a sign of its own.
    const auto with_plate = [&](double aside) {
        const glm::dvec3 middle = 5.0 * way + glm::dvec3(0, aside, 0);
        return sign(ahead_at(E), {box_at(10.0 * way, 1), {middle - glm::dvec3(0.02), middle + glm::dvec3(0.02)}});
    };
    EXPECT_TRUE(with_plate(0.5));
    EXPECT_FALSE(with_plate(0));
}

TEST(Signs, ASignStaysAtItsThingWhileItIsTrue)
{
    std::mt19937 random(3);
    std::vector<AlignedBox> things;
    for (int i = 0; i < 60; ++i) {
        std::uniform_real_distribution<double> place(-12, 12);
        things.push_back(box_at({place(random), place(random) / 6, 20 + 2 * place(random)}, 0.4));
    }
    std::optional<Sign> before;
    int changes = 0, shown = 0;
    for (int i = 0; i < 3000; ++i) {
        Shot shot = ahead_at(8 + 2 * std::sin(0.01 * i));
        shot.position.z = -0.01 * i;
        const auto now = sign(shot, things, before);
        changes += now && before && now->thing != before->thing;
        shown += now.has_value();
        before = now;
    }
    EXPECT_GT(shown, 600);
    EXPECT_LT(changes, 30); // without keeping, over 150
}

/// The world's time at which the light left a place at rest that an eye sees now. The eye rests in the ship, `aside` from
/// its middle; the event of the eye in the world is the inverse Lorentz transform of (0, aside).
double left_at(const Shot& shot, const glm::dvec3& place, const glm::dvec3& aside)
{
    const double gamma = std::sqrt(1 + glm::dot(shot.u, shot.u));
    const double time = glm::dot(shot.u, aside);
    const glm::dvec3 eye = shot.position + aside + shot.u * (glm::dot(shot.u, aside) / (1 + gamma));
    return time - glm::distance(eye, place);
}

TEST(Signs, TwoEyesThatSeeTwoTimesAreToldWhy)
{
    const World world = load_world(load_scene_file(source_dir() / "config/scenes/clocks.json").gltf);
    int told = 0, shown = 0;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-12, 12), speed(-2, 2);
    for (int i = 0; i < 4000; ++i) {
        const Shot shot = shot_at({place(random), 0.2 * place(random), 3 + std::abs(place(random))},
            {speed(random), 0.1 * speed(random), speed(random)}, {0.1 * speed(random), 0, -1});
        constexpr double apart = 0.0325;
        const auto found = sign_for(shot, {}, world, 1, apart, {});
        if (!found)
            continue;
        const Instance& clock = world.instances[found->thing];
        const Primitive& dial = world.primitives[clock.primitive];
        const glm::dvec3 middle = clock.frame_from_local * glm::dvec4(0.5 * (dial.low + dial.high), 1);
        const glm::dvec3 aside = shot.ship_from_cockpit * glm::dvec3(apart / 2, 0, 0);
        const double seconds = std::abs(left_at(shot, middle, aside) - left_at(shot, middle, -aside));
        // The two eyes' rays to a thing so far away are parallel to the second order of the distance between the eyes.
        EXPECT_NEAR(found->eyes_apart_s, seconds, 1e-4 * apart + 1e-3 * seconds);
        ++shown, told += lines_of(*found, words()).size() == 3;
        EXPECT_EQ(lines_of(*found, words()).size(), found->eyes_apart_s > 0.01 ? 3u : 2u);
        EXPECT_EQ(lines_of(*sign_for(shot, {}, world, 1, 0, {}), words()).size(), 2u) << "one eye";
    }
    EXPECT_GT(told, 50);
    EXPECT_GT(shown - told, 50);
}

TEST(Signs, TheArrowsTipIsInTheMiddleOfTheLowerEdge)
{
    const Typesetter typesetter;
    for (const char* language : {"en", "de"})
        for (const Sign::Kind kind : {Sign::Kind::behind, Sign::Kind::clock}) {
            const Panel panel
                = draw_sign(typesetter, lines_of({.kind = kind, .light_s = 12, .eyes_apart_s = 0.1}, words(language)), 12);
            const auto plate_at = [&](int x, int y) { return panel.texels[2 * (std::size_t(y) * panel.size.x + x) + 1]; };
            int first = panel.size.x, last = -1;
            for (int x = 0; x < panel.size.x; ++x)
                if (plate_at(x, panel.size.y - 3) > 100)
                    first = std::min(first, x), last = std::max(last, x);
            EXPECT_NEAR(0.5 * (first + last + 1), 0.5 * panel.size.x, 1);
            EXPECT_LE(last - first, 6);
            EXPECT_LT(panel.size.x / 12.0, 30) << "degrees";
            EXPECT_LT(panel.size.y / 12.0, kind == Sign::Kind::clock ? 9 : 7) << "degrees";
        }
}

} // namespace signs_test
