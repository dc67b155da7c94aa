// A tour in a running exhibit: it begins anew for the next visitor, and leaves out the visitor's steps while nobody is
// there.
#include "config/model/shipped.h"
#include "runtime/visit/tour_player.h"
#include "tests/support/controls.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>

namespace tour_player_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

Tour tour_of(const std::string& steps)
{
    return load_tour(write_text("guided.json", R"({ "scene": "avenue", "steps": [)" + steps + "] }"), words(),
        [](const std::string& name) { return source_dir() / "config/shots" / (name + ".json"); });
}

void pass(TourPlayer& guide, double seconds, const Controls& controls = {})
{
    for (int frame = 0; frame < 20 * seconds; ++frame)
        guide.advance(controls, 50'000'000);
}

} // namespace

TEST(TourPlayerTest, TheTourBeginsAnewForTheNextVisitor)
{
    const Tour tour = tour_of(R"({ "seconds": 1, "cut": "start" }, { "seconds": 1, "thrust": { "rapidity_per_s": 0.5 } })");
    TourPlayer guide(tour, {}, 1);
    pass(guide, 3);
    EXPECT_TRUE(guide.over());
    EXPECT_FALSE(guide.prompt(words()).empty());
    pass(guide, 5, controls_with(Steering{.throttle_rate = 1}));
    guide.again();
    EXPECT_FALSE(guide.over());
    EXPECT_EQ(guide.step(), 0u);
    EXPECT_TRUE(guide.prompt(words()).empty());
    EXPECT_EQ(guide.advance({}, 1).ship.u.total(), glm::dvec3(0));
}

// On a dome a step has its other place; it keeps its texts and its time, and the first step's cut counts as well.
TEST(TourPlayerTest, ASurroundingDisplayHasItsOwnPlaces)
{
    const Tour tour = tour_of(R"({ "seconds": 1, "cut": { "position": [0, 0, 5], "look": [0, 0, -1] },
            "around": { "cut": { "position": [0, 0, 2], "look": [0, 0, -1] } } },
        { "seconds": 2, "ship_s_per_s": 0, "glide": { "position": [1, 0, 5] }, "around": { "glide": { "position": [0, 3, 2] } } },
        { "seconds": 1, "ship_s_per_s": 0 })");
    TourPlayer flat(tour, {}, 1), around(tour, {}, 1, {.surrounds = true});
    EXPECT_EQ(flat.flight().ship.position.total(), glm::dvec3(0, 0, 5));
    EXPECT_EQ(around.flight().ship.position.total(), glm::dvec3(0, 0, 2));
    pass(flat, 3.5), pass(around, 3.5);
    EXPECT_EQ(flat.step(), around.step());
    EXPECT_EQ(flat.flight().ship.position.total(), glm::dvec3(1, 0, 5));
    EXPECT_EQ(around.flight().ship.position.total(), glm::dvec3(0, 3, 2));
    around.again();
    EXPECT_EQ(around.flight().ship.position.total(), glm::dvec3(0, 0, 2));
}

TEST(TourPlayerTest, WithoutVisitorsNobodyFlies)
{
    const Tour tour = tour_of(R"({ "seconds": 1, "cut": "start" }, { "seconds": 30, "try": {} }, { "seconds": 1 })");
    TourPlayer attended(tour, {}, 1), alone(tour, {}, 1, {.visitors = false});
    pass(attended, 3), pass(alone, 3);
    EXPECT_TRUE(attended.by_hand());
    EXPECT_TRUE(alone.over());
    EXPECT_FALSE(alone.by_hand());
}

} // namespace tour_player_test
