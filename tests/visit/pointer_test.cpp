// The guide's pointer: it fades and glides at limited rates, whatever the guide's finger does, and goes by itself.
#include "runtime/visit/pointer.h"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace pointer_test {

using namespace starbow;

namespace {

constexpr double frame_s = 1.0 / 60;

double between_deg(const glm::dvec3& a, const glm::dvec3& b)
{
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

void pass(Pointer& pointer, double s)
{
    for (double t = 0; t < s - 1e-9; t += frame_s)
        pointer.advance(frame_s);
}

} // namespace

TEST(Pointer, ItAppearsWhereTheGuidePoints)
{
    Pointer pointer;
    EXPECT_FALSE(pointer.shown());
    pass(pointer, 1);
    EXPECT_FALSE(pointer.shown());
    pointer.touch(90, 0); // to the right
    pass(pointer, 1);
    ASSERT_TRUE(pointer.shown());
    EXPECT_LT(between_deg(pointer.shown()->towards, {1, 0, 0}), 1e-9);
    EXPECT_EQ(pointer.shown()->strength, 1);
    pointer.touch(0, 90); // overhead
    pass(pointer, 2);
    EXPECT_LT(between_deg(pointer.shown()->towards, {0, 1, 0}), 1e-9);
}

TEST(Pointer, ItGoesSomeSecondsAfterTheLastTouch)
{
    Pointer pointer;
    for (int i = 0; i < 20; ++i) { // a finger that rests sends nothing new, one that moves does
        pointer.touch(i, 0);
        pass(pointer, 0.5);
    }
    EXPECT_EQ(pointer.shown()->strength, 1);
    pass(pointer, Pointer::stays_s - 0.6);
    EXPECT_EQ(pointer.shown()->strength, 1);
    pass(pointer, 0.6 + Pointer::fade_s);
    EXPECT_FALSE(pointer.shown());
}

// Two flashes are two pairs of opposite changes; a ring that takes half a second each way makes one a second at most.
TEST(Pointer, NoHandMakesItJumpOrBlink)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> azimuth(-180, 180), elevation(-90, 90), chance(0, 1);
    Pointer pointer;
    std::optional<Pointer::Shown> before;
    double farthest = 0;
    int seen = 0;
    for (int frame = 0; frame < 60000; ++frame) {
        if (chance(random) < (frame % 3000 < 600 ? 0.2 : 0.002))
            pointer.touch(azimuth(random), elevation(random));
        pointer.advance(frame_s);
        const auto now = pointer.shown();
        const double strength = now ? now->strength : 0, strength_before = before ? before->strength : 0;
        EXPECT_LE(std::abs(strength - strength_before), frame_s / Pointer::fade_s + 1e-9);
        if (now && before) {
            farthest = std::max(farthest, between_deg(now->towards, before->towards));
            EXPECT_NEAR(glm::length(now->towards), 1, 1e-12);
            ++seen;
        }
        before = now;
    }
    EXPECT_LE(farthest, Pointer::fastest_deg_per_s * frame_s + 1e-9);
    EXPECT_GT(farthest, 0.9 * Pointer::fastest_deg_per_s * frame_s);
    EXPECT_GT(seen, 10000);
}

TEST(Pointer, ItReachesThePlaceRightBehindItself)
{
    Pointer pointer;
    pointer.touch(0, 0);
    pass(pointer, 1);
    pointer.touch(180, 0);
    pass(pointer, 180 / Pointer::fastest_deg_per_s + 0.1);
    EXPECT_LT(between_deg(pointer.shown()->towards, {0, 0, 1}), 1e-6);
}

} // namespace pointer_test
