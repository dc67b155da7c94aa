// Whether somebody is there: hands and heads are, worn sensors, books on keys and sticks that are left tilted are not.
#include "input/presence.h"
#include "tests/support/controls.h"
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

TEST(PresenceTest, EveryControlAloneIsASign)
{
    std::vector<Controls> all{controls_with(Steering{.throttle_rate = 1}), controls_with(Steering{.throttle_rate = -0.2}),
        controls_with(Steering{.push = {0, 0, 0.4}}), controls_with(Steering{.stop = true}),
        controls_with(Steering{.home = true}), controls_with(Steering{.undo = true}),
        controls_with(Steering{.next_mode = true}), controls_with(Steering{.freeze = true}),
        controls_with(Steering{.menu = true}), controls_with(Steering{.slow_motion = true}),
        controls_with(WindowSwitches{.information = true}), controls_with(Looking{.look_rad = {0.02, 0}}),
        controls_with(Looking{.look_ahead = true}), controls_with(Looking{.exposure = -1}),
        controls_with(Looking{.lock_exposure = true}), controls_with(Looking{.range = true}),
        controls_with(EffectSwitches{.aberration = true}), controls_with(EffectSwitches{.doppler = true}),
        controls_with(EffectSwitches{.headlight = true}), controls_with(EffectSwitches{.false_colours = true}),
        controls_with(EffectSwitches{.comparison = true}), controls_with(LabSwitches{.overlay = true}),
        controls_with(LabSwitches{.mark = true}), controls_with(LabSwitches{.log = true}),
        controls_with(LabSwitches{.why = true}), controls_with(LabSwitches{.plot = true}),
        controls_with(WindowSwitches{.hud = true}), controls_with(WindowSwitches{.full_screen = true}),
        controls_with(AlignmentKeys{.pattern = true}), controls_with(AlignmentKeys{.choose = -1}),
        controls_with(AlignmentKeys{.turn_by = 10}), controls_with(Touches{.pressed = true})};
    for (int axis = 0; axis < 3; ++axis)
        all.emplace_back().turn[axis] = 0.5;
    for (std::size_t i = 0; i < all.size(); ++i) {
        Presence presence;
        presence.take({}, dt_s);
        EXPECT_TRUE(presence.take(all[i], dt_s)) << i;
    }
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
