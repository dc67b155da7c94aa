// An exhibit that attends to its visitors: who is counted, and how a visitor comes home.
#include "runtime/visit/attendance.h"
#include "runtime/visit/hand_flight.h"
#include "tests/support/controls.h"
#include <gtest/gtest.h>

namespace attendance_test {

using namespace starbow;
using starbow::testing::controls_with;

namespace {

constexpr std::int64_t frame_ns = 50'000'000;
constexpr double frame_s = 0.05;

Attendance attended()
{
    Attendance attendance({.fade_s = 1}, true);
    for (int i = 0; i < 100; ++i)
        attendance.advance({.somebody = true}, frame_ns);
    return attendance;
}

} // namespace

TEST(AttendanceTest, KnowsAVisitorFromTheFirstTouchOn)
{
    Attendance attends({.fade_s = 0}, true), counts({.fade_s = 0}, false);
    EXPECT_FALSE(attends.in_hand());
    EXPECT_TRUE(counts.in_hand()) << "somebody else lets the visitors in";
    EXPECT_FALSE(counts.knows_visitor());
    bool begins = false;
    for (int i = 0; i < 10; ++i) {
        begins |= attends.advance({.somebody = true}, frame_ns).begins;
        counts.advance({.somebody = true}, frame_ns);
    }
    EXPECT_TRUE(begins);
    EXPECT_TRUE(attends.in_hand() && attends.knows_visitor() && counts.knows_visitor());
    EXPECT_NEAR(counts.take_visited_s(), 10 * frame_s, 1e-9);
    EXPECT_EQ(counts.take_visited_s(), 0);
}

// A short way home is flown; from far away the picture goes black, the flight begins again, and the picture comes back.
TEST(AttendanceTest, ALongWayHomeLeadsThroughBlack)
{
    HandFlight near({}, {}, 1), far({}, {}, 1);
    for (int i = 0; i < 400; ++i)
        far.advance(controls_with(Steering{.lever = 0.9}), frame_ns);
    const Controls home = controls_with(Switches{Switch::home});

    Attendance attendance = attended();
    EXPECT_FALSE(attendance.lead_home(near, home, true, frame_s).withheld[Switch::home]);
    EXPECT_EQ(attendance.fade(), 0);

    Requests requests = attendance.lead_home(far, home, true, frame_s);
    EXPECT_TRUE(requests.withheld[Switch::home]);
    int frames = 0;
    double before = 0;
    while (!requests.made[Switch::reset] && frames < 1000) {
        EXPECT_GE(attendance.fade(), before);
        before = attendance.fade();
        requests = attendance.lead_home(far, {}, true, frame_s);
        ++frames;
    }
    EXPECT_EQ(attendance.fade(), 1) << "the leap is not seen";
    EXPECT_NEAR(frames * frame_s, 0.5, 2 * frame_s) << "half of the fade";
    // An open throttle waits, as at the start of a visit.
    EXPECT_TRUE(attendance.lead_home(near, controls_with(Steering{.lever = 0.8}), true, frame_s).made[Switch::stop]);
    for (int i = 0; i < 20; ++i)
        requests = attendance.lead_home(near, {}, true, frame_s);
    EXPECT_EQ(attendance.fade(), 0);
    EXPECT_FALSE(requests.made.any());
}

TEST(AttendanceTest, AnOpenThrottleWaitsAtAStartAtRestAlone)
{
    for (const bool rests : {false, true})
        for (const double lever : {0., 0.01, 0.5}) {
            Requests requests;
            Attendance::wait_for_throttle(controls_with(Steering{.lever = lever}), rests, requests);
            EXPECT_EQ(requests.made[Switch::stop], rests && lever == 0.5) << rests << ' ' << lever;
        }
}

// The visit's end ends the way home, too.
TEST(AttendanceTest, TheNextVisitorIsNotLedHome)
{
    HandFlight far({}, {}, 1);
    for (int i = 0; i < 400; ++i)
        far.advance(controls_with(Steering{.lever = 0.9}), frame_ns);
    Attendance attendance({.idle_s = 1, .ask_s = 0, .fade_s = 1}, true);
    for (int i = 0; i < 100; ++i)
        attendance.advance({.somebody = true}, frame_ns);
    attendance.lead_home(far, controls_with(Switches{Switch::home}), true, frame_s);
    bool ends = false;
    for (int i = 0; i < 200 && !ends; ++i)
        ends = attendance.advance({}, frame_ns).ends;
    ASSERT_TRUE(ends);
    for (int i = 0; i < 100; ++i)
        EXPECT_FALSE(attendance.lead_home(far, {}, true, frame_s).made[Switch::reset]);
}

} // namespace attendance_test
