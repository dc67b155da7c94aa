// The axes of cube maps: the cockpit's in slow flight, the motion's in fast flight, and no flicker between the two.
#include "runtime/world/observer.h"
#include "tests/support/shots.h"
#include "tests/support/speeds.h"
#include <gtest/gtest.h>
#include <random>

namespace observer_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

double largest(const glm::dmat3& m)
{
    double most = 0;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            most = std::max(most, std::abs(m[i][k]));
    return most;
}

Shot moving(double beta, const glm::dvec3& heading, const glm::dvec3& look = {0.3, 0.1, -1})
{
    return shot_at({}, heading * u_of_beta(beta), look);
}

} // namespace

TEST(CubeAxes, StayWithTheCockpitInSlowFlight)
{
    const World world;
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    const glm::dmat3 at_rest = observer_of(world, moving(0, {0, 0, 1}), {}).rest_frames[0].cube_from_frame;
    for (double beta : {1e-100, 1e-9, 1e-6, 0.1, 0.43})
        for (int i = 0; i < 20; ++i) { // 4e-15: some roundings of doubles
            const glm::dvec3 heading = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
            const Observer observer = observer_of(world, moving(beta, heading), {});
            const RestFrameView& own = observer.rest_frames[0];
            EXPECT_EQ(own.cube_from_frame, at_rest) << beta;
            EXPECT_LT(largest(own.cube_from_motion * own.motion_from_frame - own.cube_from_frame), 4e-15) << beta;
            EXPECT_LT(glm::length(own.motion_from_frame * heading - glm::dvec3(0, 0, 1)), 4e-15) << beta;
        }
}

TEST(CubeAxes, AreTheMotionsInFastFlight)
{
    // Behind a fast ship, where tiles are nested around z, and where a float direction needs z along the motion.
    const World world;
    for (double gamma : {1.2, 4.0, 1e6}) {
        const glm::dvec3 heading = glm::normalize(glm::dvec3(1, 0.2, 0.3));
        const RestFrameView own = observer_of(world, shot_at({}, heading * u_of_gamma(gamma)), {}).rest_frames[0];
        EXPECT_TRUE(own.aligned());
        EXPECT_LT(glm::length(own.cube_from_frame * heading - glm::dvec3(0, 0, 1)), 4e-15) << gamma;
    }
    // Directions are not aberrated: a heading does not show at any speed.
    Shot unaberrated = shot_at({}, {0, u_of_gamma(100), 0});
    unaberrated.effects.on.set(Effect::aberration, false);
    EXPECT_EQ(observer_of(world, unaberrated, {}).rest_frames[0].cube_from_frame,
        observer_of(world, shot_at({}, {}), {}).rest_frames[0].cube_from_frame);
}

TEST(CubeAxes, ChangeOnceWhenTheSpeedWaversAroundTheLimit)
{
    const World world;
    const glm::dvec3 heading = glm::normalize(glm::dvec3(1, 0.2, 0.3));
    Observer observer;
    int changes = 0;
    bool aligned = false;
    const auto fly = [&](double beta) {
        observer = observer_of(world, moving(beta, heading), {}, std::move(observer.rest_frames));
        changes += observer.rest_frames[0].aligned() != aligned;
        aligned = observer.rest_frames[0].aligned();
    };
    const auto waver = [&](double about) {
        for (int i = 0; i < 100; ++i)
            fly(about + 0.02 * std::sin(i));
    };
    for (double beta = 0.01; beta < 0.99; beta += 0.001) {
        fly(beta);
        if (int(beta * 1000) % 50 == 0)
            waver(beta);
    }
    EXPECT_EQ(changes, 1) << "faster and faster";
    EXPECT_TRUE(aligned);
    for (double beta = 0.99; beta > 0.04; beta -= 0.001) {
        fly(beta);
        if (int(beta * 1000) % 50 == 0)
            waver(beta);
    }
    EXPECT_EQ(changes, 2) << "and slower";
    EXPECT_FALSE(aligned);
}

} // namespace observer_test
