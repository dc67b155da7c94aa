// Whether somebody is there: hands and heads are, worn sensors, books on keys and sticks that are left tilted are not.
#include "input/channels.h"
#include "input/presence.h"
#include "tests/support/controls.h"
#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>

namespace presence_test {

using namespace starbow;
using starbow::testing::controls_with;

namespace {

constexpr double dt_s = 1 / 60.0;

/// Frames with a sign of somebody among `seconds` of them.
int signs(Presence& presence, double seconds, const std::function<Controls(double)>& at)
{
    int count = 0;
    for (int frame = 0; frame < seconds / dt_s; ++frame)
        count += presence.take(at(frame * dt_s), dt_s);
    return count;
}
int signs(Presence& presence, double seconds, const Controls& controls)
{
    return signs(presence, seconds, [&](double) { return controls; });
}

Head head_at(glm::dvec3 moved_m, double yaw_rad = 0) { return {moved_m, glm::angleAxis(yaw_rad, glm::dvec3(0, 1, 0))}; }

} // namespace

TEST(PresenceTest, AStickThatIsTakenIsSomebodyAndOneThatIsLeftTiltedIsNobody)
{
    Presence presence;
    EXPECT_EQ(signs(presence, 100, Controls{}), 0);
    const Controls tilted = controls_with(Steering{.turn = {0, 0.6, 0}});
    EXPECT_TRUE(presence.take(tilted, dt_s));
    EXPECT_EQ(signs(presence, 100, tilted), 0);
    // The health of the axis leaves it out after a minute, and takes it back when it moves.
    EXPECT_FALSE(presence.take({}, dt_s));
    EXPECT_TRUE(presence.take(controls_with(Steering{.turn = {0, -0.3, 0}}), dt_s));
}

// A new member does not compile.
static_assert(count_members<Steering>() == 5, "lever, throttle_rate, push, turn, taken");
static_assert(count_members<Looking>() == 3, "look_rad, head, exposure");
static_assert(count_members<AlignmentSteps>() == 2, "choose, turn_by");
static_assert(count_members<Touches>() == 2, "pressed and held: AButtonThatIsDownIsASignWhenItGoesDownAlone");

TEST(PresenceTest, EveryControlAloneIsASign)
{
    const auto is_sign = [](const Controls& controls) {
        Presence presence;
        presence.take(controls_with(Steering{.lever = 0.5}), dt_s);
        Controls with_lever = controls;
        with_lever.lever = controls.lever.value_or(0.5);
        return presence.take(with_lever, dt_s);
    };
    EXPECT_FALSE(is_sign({}));
    for (const SwitchEntry& one : all_switches) {
        Controls controls;
        controls.set(one.which);
        EXPECT_TRUE(is_sign(controls)) << one.name;
    }
    EXPECT_FALSE(is_sign(controls_with(Steering{.taken = true}))) << "the guide takes the stick";
    for (const double by : {-1.0, -0.2, 0.2, 1.0}) {
        EXPECT_TRUE(is_sign(controls_with(Steering{.throttle_rate = by}))) << by;
        EXPECT_TRUE(is_sign(controls_with(Steering{.lever = std::clamp(0.5 + by, 0.0, 1.0)}))) << by;
        EXPECT_TRUE(is_sign(controls_with(Looking{.exposure = by}))) << by;
        for (int axis = 0; axis < 3; ++axis) {
            Controls push, turn;
            push.push[axis] = turn.turn[axis] = by;
            EXPECT_TRUE(is_sign(push)) << by << " along " << axis;
            EXPECT_TRUE(is_sign(turn)) << by << " about " << axis;
            Head moved = head_at({}, 0);
            moved.moved_m[axis] = by / 2;
            EXPECT_TRUE(is_sign(controls_with(Looking{.head = moved}))) << by << " along " << axis;
        }
        EXPECT_TRUE(is_sign(controls_with(Looking{.look_rad = {0.02 * by, 0}}))) << by;
        EXPECT_TRUE(is_sign(controls_with(Looking{.look_rad = {0, 0.02 * by}}))) << by;
        EXPECT_TRUE(is_sign(controls_with(Looking{.head = head_at({}, by)}))) << by;
        EXPECT_TRUE(is_sign(controls_with(AlignmentSteps{.choose = by < 0 ? -1 : 1}))) << by;
        EXPECT_TRUE(is_sign(controls_with(AlignmentSteps{.turn_by = by < 0 ? -10 : 1}))) << by;
    }
    EXPECT_TRUE(is_sign(controls_with(Touches{.pressed = true})));
}

TEST(PresenceTest, AButtonThatIsDownIsASignWhenItGoesDownAlone)
{
    Presence presence;
    presence.take({}, dt_s);
    EXPECT_TRUE(presence.take(controls_with(Touches{.pressed = true, .held = true}), dt_s));
    EXPECT_EQ(signs(presence, 100, controls_with(Touches{.held = true})), 0);
}

TEST(PresenceTest, AThrottleThatStandsSomewhereIsNobody)
{
    Presence presence;
    const auto lever = [](double place) { return controls_with(Steering{.lever = place}); };
    EXPECT_FALSE(presence.take(lever(0.7), dt_s)) << "its first report";
    EXPECT_EQ(signs(presence, 60, [&](double s) { return lever(0.7 + 0.04 * std::sin(40 * s)); }), 0) << "trembling";
    EXPECT_TRUE(presence.take(lever(0.5), dt_s));
    EXPECT_FALSE(presence.take({}, dt_s)) << "unplugged";
    EXPECT_FALSE(presence.take(lever(0.2), dt_s)) << "plugged in again";
    EXPECT_TRUE(presence.take(lever(0), dt_s)) << "pulled back";
}

TEST(PresenceTest, AWornAxisThatWandersIsNobody)
{
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0, 0.015);
    Presence presence;
    EXPECT_EQ(signs(presence, 600,
                  [&](double) {
                      return controls_with(Steering{.turn = {0.02 + noise(random), 0, 0}});
                  }),
        0);
}

TEST(PresenceTest, ABookOnAKeyIsNobodyAfterItsFirstFrame)
{
    Presence presence;
    const Controls held = controls_with(Steering{.throttle_rate = 1, .turn = {1, 0, 0}});
    EXPECT_EQ(signs(presence, 100, held), 1);
}

TEST(PresenceTest, AHeadThatMovesIsSomebodyAndATrackersNoiseIsNobody)
{
    std::mt19937 random(4);
    std::normal_distribution<double> noise_m(0, 0.002), noise_rad(0, 0.004);
    Presence presence;
    const auto still = [&](double) {
        return controls_with(
            Looking{.head = head_at({0.1 + noise_m(random), noise_m(random), noise_m(random)}, noise_rad(random))});
    };
    EXPECT_EQ(signs(presence, 60, still), 0);
    EXPECT_TRUE(presence.take(controls_with(Looking{.head = head_at({0.15, 0, 0})}), dt_s));
    EXPECT_TRUE(presence.take(controls_with(Looking{.head = head_at({0.15, 0, 0}, 0.1)}), dt_s));
    EXPECT_GT(signs(presence, 10,
                  [](double s) {
                      return controls_with(Looking{.head = head_at({0.3 * std::sin(s), 0, 0})});
                  }),
        50);
}

} // namespace presence_test
