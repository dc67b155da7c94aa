// The course of a visit: from the attraction to the visitor's flight, to the question, and back. The expected times are
// those of the rules, added by hand.
#include "runtime/visit/visit.h"
#include <gtest/gtest.h>
#include <random>
#include <string>

namespace visit_test {

using namespace starbow;

namespace {

constexpr double frame_s = 0.05;

struct Exhibit {
    Visiting rules{.idle_s = 90, .ask_s = 15, .fade_s = 1};
    Visit visit{};
    VisitEvents events{}; ///< of the last frame
    double passed_s = 0;
    int begun = 0, ended = 0, shown = 0;
    std::vector<double> lengths{};

    void frame(const VisitSigns& signs, double dt_s = frame_s)
    {
        events = {};
        visit = advance(visit, rules, signs, std::llround(1e9 * dt_s), events);
        passed_s += dt_s;
        begun += events.begins, ended += events.ends, shown += events.shows_attraction;
        if (events.ends)
            lengths.push_back(events.length_s);
    }
    void hold(const VisitSigns& signs, double seconds)
    {
        for (int i = 0; i < std::lround(seconds / frame_s); ++i)
            frame(signs);
    }
    /// Until the phase comes; returns the seconds that it took.
    double until(VisitPhase phase, const VisitSigns& signs = {}, double most_s = 1000)
    {
        const double from = passed_s;
        while (visit.phase != phase && passed_s - from < most_s)
            frame(signs);
        return passed_s - from;
    }
};

constexpr VisitSigns nobody{}, touch{.somebody = true};

} // namespace

TEST(VisitTest, ATouchLeadsToTheVisitorsFlightWithinTheFade)
{
    Exhibit exhibit;
    exhibit.hold(nobody, 600);
    EXPECT_EQ(exhibit.visit.phase, VisitPhase::attract);
    EXPECT_FALSE(in_hand(exhibit.visit));
    exhibit.frame(touch);
    EXPECT_NEAR(exhibit.until(VisitPhase::flying), 0.5, 2 * frame_s);
    EXPECT_EQ(exhibit.begun, 1);
    EXPECT_EQ(fade_of(exhibit.visit, exhibit.rules), 1) << "the world changes in the dark";
    exhibit.hold(nobody, 0.5);
    EXPECT_EQ(fade_of(exhibit.visit, exhibit.rules), 0);
    EXPECT_TRUE(in_hand(exhibit.visit));
}

TEST(VisitTest, TheQuestionComesAfterTheIdleTimeAndATouchAnswersItInOneFrame)
{
    Exhibit exhibit;
    exhibit.frame(touch), exhibit.until(VisitPhase::flying);
    EXPECT_NEAR(exhibit.until(VisitPhase::asking), 90, 2 * frame_s);
    EXPECT_NEAR(*seconds_left(exhibit.visit, exhibit.rules), 15, 2 * frame_s);
    exhibit.hold(nobody, 10);
    EXPECT_NEAR(*seconds_left(exhibit.visit, exhibit.rules), 5, 3 * frame_s);
    EXPECT_TRUE(in_hand(exhibit.visit)) << "the touch that answers steers, too";
    exhibit.frame(touch);
    EXPECT_EQ(exhibit.visit.phase, VisitPhase::flying);
    EXPECT_FALSE(seconds_left(exhibit.visit, exhibit.rules));
    EXPECT_NEAR(exhibit.until(VisitPhase::attract), 90 + 15 + 0.5, 5 * frame_s);
    ASSERT_EQ(exhibit.ended, 1);
    EXPECT_NEAR(exhibit.lengths[0], 100, 5 * frame_s) << "from the beginning to the last touch";
    EXPECT_EQ(exhibit.visit.attraction, 0u);
    EXPECT_TRUE(exhibit.events.shows_attraction);
}

TEST(VisitTest, ATouchOnTheWayToBlackKeepsTheVisit)
{
    Exhibit exhibit;
    exhibit.frame(touch), exhibit.until(VisitPhase::leaving);
    exhibit.hold(nobody, 0.25);
    EXPECT_NEAR(fade_of(exhibit.visit, exhibit.rules), 0.5, 0.11);
    exhibit.frame(touch);
    EXPECT_EQ(exhibit.visit.phase, VisitPhase::flying);
    EXPECT_EQ(exhibit.ended, 0);
    exhibit.hold(nobody, 0.5);
    EXPECT_EQ(fade_of(exhibit.visit, exhibit.rules), 0);
}

TEST(VisitTest, WatchingATourIsNoIdleTime)
{
    Exhibit exhibit;
    exhibit.frame(touch), exhibit.until(VisitPhase::flying);
    exhibit.hold({.watches = true}, 400);
    EXPECT_EQ(exhibit.visit.phase, VisitPhase::flying);
    EXPECT_NEAR(exhibit.until(VisitPhase::asking), 90, 2 * frame_s);
}

TEST(VisitTest, AttractionsFollowEachOtherThroughBlack)
{
    Exhibit exhibit;
    for (std::size_t turn = 1; turn <= 3; ++turn) {
        exhibit.hold(nobody, 30);
        exhibit.frame({.attraction_over = true});
        EXPECT_EQ(exhibit.visit.phase, VisitPhase::changing);
        EXPECT_NEAR(exhibit.until(VisitPhase::attract, {.attraction_over = true}), 0.5, 2 * frame_s);
        EXPECT_EQ(exhibit.visit.attraction, turn);
        EXPECT_EQ(exhibit.shown, int(turn));
    }
    // A touch in the dark between two of them counts.
    exhibit.frame({.attraction_over = true});
    exhibit.frame({.somebody = true, .attraction_over = true});
    exhibit.until(VisitPhase::flying, {.attraction_over = true});
    EXPECT_EQ(exhibit.begun, 1);
    EXPECT_EQ(exhibit.shown, 3);
}

TEST(VisitTest, TheLongestVisitEndsWhoeverTouches)
{
    Exhibit exhibit;
    exhibit.rules.longest_s = 120;
    exhibit.frame(touch), exhibit.until(VisitPhase::flying);
    exhibit.hold(touch, 100);
    EXPECT_FALSE(seconds_left(exhibit.visit, exhibit.rules));
    exhibit.hold(touch, 10);
    EXPECT_NEAR(*seconds_left(exhibit.visit, exhibit.rules), 10, 2 * frame_s) << "it is announced";
    EXPECT_NEAR(exhibit.until(VisitPhase::leaving, touch), 10, 2 * frame_s);
    exhibit.until(VisitPhase::attract, touch, 2);
    EXPECT_EQ(exhibit.ended, 1);
    exhibit.frame(touch); // and the next one begins
    exhibit.until(VisitPhase::flying, touch, 2);
    EXPECT_EQ(exhibit.begun, 2);
    EXPECT_LT(exhibit.visit.visit_ns, 1'000'000'000);
}

TEST(VisitTest, WithoutAQuestionAndAFadeAVisitEndsAtOnce)
{
    Exhibit exhibit;
    exhibit.rules = {.idle_s = 20, .ask_s = 0, .fade_s = 0};
    exhibit.visit = begun({});
    exhibit.hold(touch, 3);
    EXPECT_NEAR(exhibit.until(VisitPhase::attract), 20, 4 * frame_s);
    ASSERT_EQ(exhibit.ended, 1);
    EXPECT_NEAR(exhibit.lengths[0], 3, 1e-6);
    EXPECT_EQ(fade_of(exhibit.visit, exhibit.rules), 0);
}

TEST(VisitTest, WhateverTheVisitorsDoEachVisitThatBeginsEndsOnceAndNothingIsLeftOver)
{
    std::mt19937 random(5);
    for (int seed = 0; seed < 200; ++seed) {
        Exhibit exhibit;
        exhibit.rules = {.idle_s = 5.0 + seed % 7,
            .ask_s = double(seed % 4),
            .longest_s = seed % 3 ? 0.0 : 40.0,
            .fade_s = 0.5 * (seed % 3)};
        for (int i = 0; i < 4000; ++i) {
            const VisitSigns signs{random() % (i / 500 % 2 ? 400 : 20) == 0, random() % 50 == 0, random() % 100 == 0};
            exhibit.frame(signs, 0.001 * double(random() % 100));
            const bool inside = in_hand(exhibit.visit) || exhibit.visit.phase == VisitPhase::leaving;
            ASSERT_EQ(exhibit.begun - exhibit.ended, int(inside)) << seed << ", frame " << i;
            ASSERT_GE(fade_of(exhibit.visit, exhibit.rules), 0);
            ASSERT_LE(fade_of(exhibit.visit, exhibit.rules), 1);
            if (exhibit.events.ends) {
                const Visit& fresh = exhibit.visit;
                ASSERT_EQ(fresh.idle_ns + fresh.visit_ns + fresh.touched_ns + std::int64_t(fresh.attraction), 0);
            }
        }
        exhibit.until(VisitPhase::attract);
        EXPECT_EQ(exhibit.begun, exhibit.ended);
    }
}

} // namespace visit_test
