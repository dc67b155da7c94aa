// The course of a visit in one word, as the guide reads it: from the attraction to the visitor's flight, in tours and
// without.
#include "config/model/shipped.h"
#include "runtime/visit/doing.h"
#include "runtime/visit/hand_flight.h"
#include "runtime/visit/tour_player.h"
#include "tests/support/controls.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>

namespace doing_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

constexpr std::int64_t frame_ns = 50'000'000;

TourPlayer tour_of(const std::string& steps)
{
    return TourPlayer(load_tour(write_text("doing.json", R"({ "scene": "avenue", "steps": [)" + steps + "] }"), words(),
                          [](const std::string& name) { return source_dir() / "config/shots" / (name + ".json"); }),
        {}, 1);
}

void pass(Attendance& attendance, const VisitSigns& signs, double seconds)
{
    for (int frame = 0; frame < 20 * seconds; ++frame)
        attendance.advance(signs, frame_ns);
}

void pass(TourPlayer& tour, double seconds)
{
    for (int frame = 0; frame < 20 * seconds; ++frame)
        tour.advance({}, frame_ns);
}

} // namespace

TEST(DoingTest, AVisitGoesFromTheAttractionToTheFlightAndBack)
{
    const HandFlight hands(Shot{}, {}, 1);
    TourPlayer tour = tour_of(R"({ "seconds": 100, "cut": "start" })");
    Attendance attendance({.idle_s = 10, .ask_s = 5, .fade_s = 2}, true);
    EXPECT_EQ(doing_of(attendance, tour, false), Doing::attract_tour);
    EXPECT_EQ(doing_of(attendance, hands, true), Doing::attract_record);
    EXPECT_EQ(doing_of(attendance, hands, false), Doing::attract_start);
    pass(attendance, {.somebody = true}, 0.1);
    EXPECT_EQ(doing_of(attendance, tour, false), Doing::enters);
    pass(attendance, {.somebody = true}, 3);
    EXPECT_EQ(doing_of(attendance, hands, false), Doing::flies);
    pass(attendance, {}, 11);
    EXPECT_EQ(doing_of(attendance, hands, false), Doing::asks);
    pass(attendance, {}, 4.5);
    EXPECT_EQ(doing_of(attendance, hands, false), Doing::changes);
    pass(attendance, {}, 3);
    EXPECT_EQ(doing_of(attendance, tour, false), Doing::attract_tour);
}

TEST(DoingTest, ATourRunsAsksAndLetsTheVisitorFly)
{
    Attendance attendance({}, false);
    TourPlayer tour = tour_of(R"({ "seconds": 2, "cut": "start" },
        { "seconds": 2, "question": { "ask": { "en": "?" }, "explanation": { "en": "!" }, "explanation_s": 0.5,
            "measure": { "quantity": "beta" }, "choices": [{ "text": { "en": "a" } }, { "text": { "en": "b" }, "from": 2 }] } },
        { "seconds": 2, "try": {} })");
    EXPECT_EQ(doing_of(attendance, tour, false), Doing::tour);
    pass(tour, 2.5);
    EXPECT_EQ(doing_of(attendance, tour, false), Doing::tour_asks);
    pass(tour, 1.7);
    EXPECT_EQ(doing_of(attendance, tour, false), Doing::tour); // the answer is explained
    pass(tour, 1);
    EXPECT_EQ(doing_of(attendance, tour, false), Doing::tour_flies);
    pass(tour, 3);
    EXPECT_EQ(doing_of(attendance, tour, false), Doing::waits); // it is over
    pass(attendance, {.somebody = true}, 1);
    EXPECT_EQ(doing_of(attendance, tour, false), Doing::flies);
}

} // namespace doing_test
