// The worlds' goals can be reached, are not reached at the start, and come one after the other.
#include "config/model/scene_file.h"
#include "runtime/flight/goals.h"
#include "runtime/flight/measuring.h"
#include "tests/support/files.h"
#include <cmath>
#include <gtest/gtest.h>

namespace goals_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

constexpr std::int64_t frame_ns = 20'000'000;

Goal faster_than(double beta)
{
    return {.ask = {.key = "", .texts = {{"en", "ask"}, {"de", "frage"}}},
        .reward = {.key = "", .texts = {{"en", "done"}}},
        .conditions = {{.measure = {.quantity = Measure::Quantity::beta}, .from = beta}}};
}

Ship at_beta(double beta)
{
    Shot shot;
    shot.u = {0, 0, -beta / std::sqrt(1 - beta * beta)};
    return ship_at(shot);
}

/// The state after some seconds with one ship.
GoalState after(GoalState state, const std::vector<Goal>& goals, const Ship& ship, double s)
{
    for (std::int64_t i = 0; i < std::int64_t(1e9 * s) / frame_ns; ++i)
        state = advance(state, goals, ship, at_beta(0), 1, frame_ns);
    return state;
}

} // namespace

TEST(GoalsTest, AGoalIsReachedWhenItHasHeldForAWhile)
{
    const std::vector<Goal> goals{faster_than(0.5), faster_than(0.7)};
    GoalState state = after({}, goals, at_beta(0.6), 0.4);
    EXPECT_FALSE(state.reached);
    state = after(state, goals, at_beta(0.4), 0.1); // the time begins anew
    state = after(state, goals, at_beta(0.6), 0.4);
    EXPECT_FALSE(state.reached);
    state = after(state, goals, at_beta(0.6), 0.2);
    ASSERT_TRUE(state.reached);
    EXPECT_EQ(goal_line(state, goals, words()), "★ done");
    state = after(state, goals, at_beta(0.9), 8);
    EXPECT_EQ(state.current, 0u);
    state = after(state, goals, at_beta(0.9), 2);
    EXPECT_EQ(state.current, 1u);
    state = after(state, goals, at_beta(0.9), 20);
    EXPECT_EQ(state.current, 2u);
    EXPECT_EQ(goal_line(state, goals, words()), "");
    EXPECT_EQ(after(state, goals, at_beta(0.9), 60).current, 2u);
}

TEST(GoalsTest, AGoalIsAskedForInTurnWithTheSentence)
{
    const std::vector<Goal> goals{faster_than(0.5)};
    int asked = 0;
    GoalState state;
    for (int i = 0; i < 240; ++i) {
        state = after(state, goals, at_beta(0), 0.2);
        asked += goal_line(state, goals, words()) == "▸ ask";
    }
    EXPECT_NEAR(asked, 2 * 10 / 0.2, 2); // ten of every 24 seconds
    EXPECT_EQ(said(goals[0].ask, words("de")), "frage");
    EXPECT_EQ(said(goals[0].reward, words("de")), "done");
}

/// A search over straight flights along each axis: a goal that none of them reaches may be out of a visitor's reach.
TEST(GoalsTest, EveryShippedGoalCanBeReachedAndIsNotAtTheStart)
{
    int goals = 0;
    for (const auto& file : shipped("config/scenes")) {
        const SceneFile scene = load_scene_file(file);
        const double unit_s = scene.seconds_per_time_unit();
        EXPECT_FALSE(scene.goals.empty()) << file;
        const Ship start = ship_at(scene.start);
        for (const Goal& goal : scene.goals) {
            SCOPED_TRACE(goal.ask.key);
            ++goals;
            for (const char* language : {"en", "de"})
                for (const LocalisedText* saying : {&goal.ask, &goal.reward})
                    EXPECT_NE(said(*saying, words(language)), saying->key);
            EXPECT_FALSE(holds(goal, start, start, unit_s));
            bool reached = false;
            for (int axis = 0; axis < 6; ++axis)
                for (double rapidity = 0.1; rapidity < 3.2; rapidity += 0.1) {
                    // Out and back at this rapidity for 40 seconds on board each.
                    glm::dvec3 way(0);
                    way[axis % 3] = axis < 3 ? 1 : -1;
                    Ship ship = start;
                    for (int half = 0; half < 2; ++half)
                        for (int i = 0; i < 40; ++i) {
                            ship.u = Sum3((half ? -1.0 : 1.0) * std::sinh(rapidity) * way);
                            ship = fly(ship, {}, {}, 1 / unit_s);
                            reached = reached || holds(goal, ship, start, unit_s);
                        }
                }
            EXPECT_TRUE(reached);
        }
    }
    EXPECT_GE(goals, 10);
}

TEST(GoalsTest, WhoFliesIsYoungerByGammaLessOne)
{
    const double gamma = 2.5, tau = 8;
    Shot shot;
    shot.time = 100;
    const Ship start = ship_at(shot);
    Ship ship = start;
    ship.u = Sum3({std::sqrt(gamma * gamma - 1), 0, 0});
    ship = fly(ship, {}, {}, tau);
    EXPECT_NEAR(measured({.quantity = Measure::Quantity::younger_s}, ship, start, 0.5), 0.5 * (gamma - 1) * tau, 1e-12);
}

TEST(GoalsTest, WrongGoalsAreRefused)
{
    const auto scene = [](const std::string& goals) { return R"({ "gltf": "a.glb", "goals": )" + goals + " }"; };
    const std::string texts = R"("ask": { "en": "a" }, "reward": { "en": "b" })";
    const auto refusal = [&](const std::string& goals) {
        const auto file = write_text("scene.json", scene(goals));
        return complaint([&] { load_scene_file(file); });
    };
    const auto condition
        = [&](const std::string& members) { return "[{ " + texts + ", \"conditions\": [{ " + members + " }] }]"; };
    EXPECT_EQ(
        load_scene_file(write_text("scene.json", scene(condition(R"("measure": { "quantity": "beta" }, "from": 0.5)"))))
            .goals.size(),
        1u);
    EXPECT_NE(refusal(condition(R"("measure": { "quantity": "beta" })")).find("always holds"), std::string::npos);
    EXPECT_NE(refusal(condition(R"("measure": { "quantity": "beta" }, "from": 1, "below": 1)")).find("leaves nothing"),
        std::string::npos);
    EXPECT_NE(refusal(condition(R"("measure": { "quantity": "speed" }, "from": 1)")).find("gamma"), std::string::npos);
    EXPECT_NE(refusal(R"([{ "ask": "tour.x", "reward": "goal.x", "conditions": [] }])").find("goal."), std::string::npos);
    EXPECT_NE(refusal("[{ " + texts + ", \"conditions\": [] }]").find("conditions"), std::string::npos);
}

} // namespace goals_test
