// The tutorial for visitors: prompts come in order, go once their control is used, and come again for the next visitor.
#include "config/model/shot.h"
#include "runtime/flight/tutorial.h"
#include "tests/support/controls.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>

namespace tutorial_test {

using namespace starbow;
using starbow::testing::controls_with;

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
            controls.set(Switch::stop, false), controls.set(Switch::home, false); // a press lasts one frame
        }
    }
};

} // namespace

TEST(TutorialTest, EachPromptGoesOnceItsControlIsUsed)
{
    Visitor visitor;
    visitor.hold({}, 20);
    EXPECT_EQ(visitor.tutorial.lesson, 0);
    visitor.hold(controls_with(Steering{.turn = {0, 1, 0}}), 5); // a visitor who turns first still has to learn to fly
    EXPECT_EQ(visitor.tutorial.lesson, 0);
    visitor.hold(controls_with(Steering{.lever = 0.3}), 3);
    EXPECT_EQ(visitor.tutorial.lesson, 1);
    visitor.hold(controls_with(Steering{.lever = 0.3, .turn = {0, 0, 1}}), 3); // a roll does not turn the nose
    EXPECT_EQ(visitor.tutorial.lesson, 1);
    visitor.hold(controls_with(Steering{.lever = 0.3, .turn = {0.5, 0, 0}}), 3);
    EXPECT_EQ(visitor.tutorial.lesson, 2);
    visitor.hold(controls_with(Steering{.lever = 0.3}, Switches{Switch::stop}), 1);
    EXPECT_EQ(visitor.tutorial.lesson, lessons);
    EXPECT_EQ(prompt(visitor.tutorial, {}, starbow::testing::words()), "");
}

TEST(TutorialTest, InFullFlightTheVisitorHasToLearnToChangeTheSpeed)
{
    Visitor visitor;
    visitor.hold(controls_with(Steering{.lever = 0.4}), 20);
    EXPECT_EQ(visitor.tutorial.lesson, 1);
    visitor.tutorial = tutorial_at(visitor.flight); // the next visitor
    visitor.hold(controls_with(Steering{.lever = 0.4}), 5);
    EXPECT_EQ(visitor.tutorial.lesson, 0);
    visitor.hold(controls_with(Steering{.lever = 0.2}), 3);
    EXPECT_EQ(visitor.tutorial.lesson, 1);
}

TEST(TutorialTest, PromptsNameTheDevicesControls)
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

} // namespace tutorial_test
