// The first minute, as visitors live it: prompts come in turn, go once done, and come again for the next visitor.
#include "config/model/shot.h"
#include "runtime/flight/tutorial.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>

using namespace starbow;

namespace {

struct Visitor {
    Flying rules{};
    Shot start{};
    Flight flight = flight_at(start, rules);
    Tutorial tutorial = tutorial_at(flight);
    void hold(Controls controls, double seconds)
    {
        for (int frame = 0; frame < 60 * seconds; ++frame) {
            flight = step(flight, controls, 16'666'667, rules, 1, start);
            tutorial = advance(tutorial, controls, flight, 1 / 60.0);
            controls.stop = controls.home = false; // a press is one frame's
        }
    }
};

} // namespace

TEST(TutorialTest, EachPromptIsGoneOnceDone)
{
    Visitor visitor;
    visitor.hold({}, 20);
    EXPECT_EQ(visitor.tutorial.lesson, 0);
    visitor.hold({.turn = {0, 1, 0}}, 5); // who turns first still has to learn to go
    EXPECT_EQ(visitor.tutorial.lesson, 0);
    visitor.hold({.lever = 0.3}, 3);
    EXPECT_EQ(visitor.tutorial.lesson, 1);
    visitor.hold({.lever = 0.3, .turn = {0, 0, 1}}, 3); // a roll turns no nose
    EXPECT_EQ(visitor.tutorial.lesson, 1);
    visitor.hold({.lever = 0.3, .turn = {0.5, 0, 0}}, 3);
    EXPECT_EQ(visitor.tutorial.lesson, 2);
    visitor.hold({.lever = 0.3, .stop = true}, 1);
    EXPECT_EQ(visitor.tutorial.lesson, lessons);
    EXPECT_EQ(prompt(visitor.tutorial, {}, starbow::testing::words()), "");
}

TEST(TutorialTest, TheNextVisitorBeginsAnew)
{
    Visitor visitor;
    visitor.hold({.lever = 0.4}, 3);
    visitor.hold({.lever = 0.4}, 80); // a lever that stands is no hand
    EXPECT_EQ(visitor.tutorial.lesson, 1);
    visitor.hold({.lever = 0.4}, 15);
    EXPECT_EQ(visitor.tutorial.lesson, 0);
    // In full flight already: another speed is what there is to learn.
    visitor.hold({.lever = 0.4}, 5);
    EXPECT_EQ(visitor.tutorial.lesson, 0);
    visitor.hold({.lever = 0.2}, 3);
    EXPECT_EQ(visitor.tutorial.lesson, 1);
}

TEST(TutorialTest, PromptsNameWhatIsInTheHand)
{
    Tutorial tutorial;
    EXPECT_EQ(prompt(tutorial, {}, starbow::testing::words()), "Hold W: faster");
    EXPECT_EQ(
        prompt(tutorial, {.stick = true, .lever = true}, starbow::testing::words()), "Push the throttle forward: faster");
    EXPECT_EQ(
        prompt(tutorial, {.stick = true, .trigger = true}, starbow::testing::words()), "Squeeze the right trigger: faster");
    tutorial.lesson = 1;
    EXPECT_EQ(prompt(tutorial, {.stick = true}, starbow::testing::words()), "Move the stick: the ship turns");
    tutorial.lesson = 2;
    EXPECT_EQ(prompt(tutorial, {.stick = true, .stop_button = 3}, starbow::testing::words()), "Press button 3: full stop");
    EXPECT_EQ(prompt(tutorial, {}, starbow::testing::words()), "Space: full stop");
}
