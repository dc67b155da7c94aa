// The way of a visitor's hands from the devices to the flight: its writers, each alone, and their order.
#include "input/hands.h"
#include "tests/support/controls.h"
#include <functional>
#include <gtest/gtest.h>
#include <utility>

namespace hands_test {

using namespace starbow;
using starbow::testing::controls_with;

namespace {

constexpr std::int64_t frame_ns = 20'000'000;
using Order = std::array<Hands::Writer, 5>;

/// The controls of a frame after all writers in an order.
Controls written(Hands& hands, const Order& order, HandsFrame frame)
{
    frame.dt_ns = frame_ns;
    Controls controls;
    for (const Hands::Writer& writer : order)
        (hands.*writer.write)(controls, frame);
    return controls;
}

HandsFrame pressing(Switches switches, Touches touches = {}) { return {.devices = controls_with(switches, touches)}; }

/// A builder's key does nothing where it is locked.
bool a_locked_key_is_nothing(const Order& order)
{
    Hands hands({.locks = true});
    return !written(hands, order, pressing({Switch::pattern}))[Switch::pattern];
}

/// With one button every key is that button, locked ones too: the first choice is to go faster.
bool a_locked_key_is_the_button(const Order& order)
{
    Hands hands({.locks = true});
    HandsFrame frame = pressing({Switch::pattern}, {.pressed = true, .held = true});
    frame.one_button = OneButtonPlace{};
    return written(hands, order, frame).throttle_rate > 0;
}

/// A press while a docent holds the exhibit is forgotten, and does not come when the hold is over.
bool a_held_press_is_forgotten(const Order& order)
{
    Hands hands({.calm = true});
    bool came = false;
    for (int frame = 0; frame < 200; ++frame) {
        const bool held = frame < 2;
        HandsFrame now = held ? pressing({Switch::doppler}) : HandsFrame{};
        now.held = held;
        came |= written(hands, order, now)[Switch::doppler];
    }
    return !came;
}

/// A request acts at once, whatever was pressed just before.
bool a_request_acts_at_once(const Order& order)
{
    Hands hands({.calm = true});
    written(hands, order, pressing({Switch::doppler}));
    HandsFrame frame;
    frame.requests.set(Switch::stop);
    return written(hands, order, frame)[Switch::stop];
}

} // namespace

// Two neighbours that change places break the one thing for which they stand in this order.
TEST(Hands, TheWritersHaveAnOrder)
{
    const std::array<bool (*)(const Order&), 4> of_neighbours{
        a_locked_key_is_nothing, a_locked_key_is_the_button, a_held_press_is_forgotten, a_request_acts_at_once};
    for (std::size_t i = 0; i + 1 < Hands::writers.size(); ++i) {
        EXPECT_TRUE(of_neighbours[i](Hands::writers)) << Hands::writers[i].name;
        Order swapped = Hands::writers;
        std::swap(swapped[i], swapped[i + 1]);
        EXPECT_FALSE(of_neighbours[i](swapped)) << swapped[i].name << " before " << swapped[i + 1].name;
    }
}

TEST(Hands, ABuildersKeysComeBackForTenMinutes)
{
    Hands hands({.locks = true});
    const auto acts = [&](Switch key) {
        HandsFrame frame = pressing({key});
        frame.dt_ns = 1'000'000'000;
        return hands.advance(frame)[key];
    };
    EXPECT_FALSE(acts(Switch::quit));
    hands.unlock();
    int seconds = 0;
    while (acts(Switch::quit) && seconds < 10'000)
        ++seconds;
    EXPECT_EQ(seconds, 599) << "the first frame has taken a second";
    hands.unlock();
    EXPECT_TRUE(acts(Switch::log)) << "a student's";
    Hands open({});
    EXPECT_TRUE(open.advance(pressing({Switch::quit}))[Switch::quit]) << "where somebody attends to the visitors";
}

TEST(Hands, ADocentTakesTheStickAndLeavesTheReadersTheirKeys)
{
    Hands hands({});
    HandsFrame frame{.devices = controls_with(Steering{.lever = 0.4, .throttle_rate = 1, .turn = {1, 0, 0}},
                         Switches{Switch::doppler, Switch::stop, Switch::hud, Switch::quit})};
    frame.held = true;
    Controls controls = hands.advance(frame);
    EXPECT_TRUE(controls.taken);
    EXPECT_EQ(controls.lever, 0.4);
    EXPECT_EQ(controls.throttle_rate, 0);
    EXPECT_EQ(controls.turn, glm::dvec3(0));
    EXPECT_EQ(static_cast<const Switches&>(controls), (Switches{Switch::hud, Switch::quit}));
    frame.held = false, frame.in_hand = false;
    controls = hands.advance(frame);
    EXPECT_FALSE(controls.taken) << "nobody is there";
    EXPECT_EQ(static_cast<const Switches&>(controls), (Switches{Switch::hud, Switch::quit}));
}

TEST(Hands, OneButtonLeadsATourOn)
{
    Hands hands({});
    HandsFrame frame = pressing({}, {.pressed = true, .held = true});
    frame.dt_ns = frame_ns;
    frame.one_button = OneButtonPlace{.kind = OneButtonPlace::Kind::tour};
    EXPECT_TRUE(hands.advance(frame)[Switch::home]);
    EXPECT_TRUE(hands.somebody());
    frame.devices = {};
    EXPECT_FALSE(hands.advance(frame)[Switch::home]);
    EXPECT_FALSE(hands.somebody());
}

TEST(Hands, ALaboratoryHasNoSlowMotion)
{
    Hands laboratory({.laboratory = true}), other({});
    EXPECT_FALSE(laboratory.advance(pressing({Switch::slow_motion}))[Switch::slow_motion]);
    EXPECT_TRUE(other.advance(pressing({Switch::slow_motion}))[Switch::slow_motion]);
}

// The last demand on a switch holds, and a menu keeps the pilot's hands from the ship but not from other switches.
TEST(Requests, TheLastOneHolds)
{
    Requests requests;
    const Controls pressed = controls_with(Switches{Switch::home, Switch::hud}, Steering{.lever = 0.3, .turn = {0, 1, 0}});
    requests.set(Switch::home, false);
    EXPECT_FALSE(requested(pressed, requests)[Switch::home]);
    Requests later;
    later.set(Switch::home), later.set(Switch::stop);
    requests.add(later);
    EXPECT_TRUE(requested(pressed, requests)[Switch::home]);
    EXPECT_TRUE(requested(pressed, requests)[Switch::stop]);
    later.set(Switch::stop, false);
    requests.add(later);
    EXPECT_FALSE(requested(pressed, requests)[Switch::stop]);
    Requests menu;
    menu.hands_in_menu = true;
    const Controls left = requested(pressed, menu);
    EXPECT_EQ(left.turn, glm::dvec3(0));
    EXPECT_EQ(left.lever, 0.3);
    EXPECT_EQ(static_cast<const Switches&>(left), Switches{Switch::hud});
}

} // namespace hands_test
