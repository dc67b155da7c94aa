// One-button flying: every choice is reachable by one button, also in the menu, and visitors who have no more come home.
#include "config/model/scene_file.h"
#include "config/model/shipped.h"
#include "input/scan.h"
#include "runtime/flight/flight.h"
#include "runtime/flight/menu.h"
#include "tests/support/controls.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>
#include <random>
#include <set>

namespace scan_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

constexpr std::int64_t frame_ns = 16'000'000;
constexpr AnyButton untouched{}, goes_down{true, true}, stays_down{false, true};

/// A scan whose frames are stepped for so long.
struct Scanned {
    OneButton rules{};
    Scan scan{};
    double moved_s = 0; ///< with any rate
    double time_s = 0;

    ScannedHands frame(AnyButton button, std::int64_t dt_ns = frame_ns)
    {
        const ScannedHands hands = advance(scan, rules, button, dt_ns);
        time_s += 1e-9 * double(dt_ns);
        if (hands.throttle_rate != 0 || hands.turn != glm::dvec3(0))
            moved_s += 1e-9 * double(dt_ns);
        return hands;
    }
    void wait_for(ScanChoice choice)
    {
        while (scan.choice != std::size_t(choice) || scan.acts)
            frame(untouched);
    }
};

/// What a choice must do, as a person would say it: faster, turn up, turn left, and the switches.
struct Deed {
    ScanChoice choice;
    double throttle, up, left;
    bool stop, home, menu;
};
constexpr Deed deeds[] = {{ScanChoice::faster, 1, 0, 0, false, false, false},
    {ScanChoice::slower, -1, 0, 0, false, false, false}, {ScanChoice::left, 0, 0, 1, false, false, false},
    {ScanChoice::right, 0, 0, -1, false, false, false}, {ScanChoice::up, 0, 1, 0, false, false, false},
    {ScanChoice::down, 0, -1, 0, false, false, false}, {ScanChoice::stop, 0, 0, 0, true, false, false},
    {ScanChoice::home, 0, 0, 0, false, true, false}, {ScanChoice::menu, 0, 0, 0, false, false, true}};

} // namespace

TEST(ScanTest, EveryChoiceIsReachedByOneButtonAndDoesWhatItSays)
{
    ASSERT_EQ(std::size(deeds), scan_choices);
    for (const Deed& deed : deeds) {
        SCOPED_TRACE(int(deed.choice));
        Scanned one;
        one.wait_for(deed.choice);
        EXPECT_LT(one.time_s, one.rules.scan_s * scan_choices);
        const ScannedHands now = one.frame(goes_down);
        EXPECT_EQ(now.throttle_rate, deed.throttle);
        EXPECT_EQ(now.turn, glm::dvec3(deed.up, deed.left, 0));
        EXPECT_EQ(now[Switch::stop], deed.stop);
        EXPECT_EQ(now[Switch::home], deed.home);
        EXPECT_EQ(now[Switch::menu], deed.menu);
        const ScannedHands later = one.frame(stays_down);
        EXPECT_FALSE(later[Switch::stop] || later[Switch::home] || later[Switch::menu]) << "a switch counts once";
        EXPECT_EQ(later.throttle_rate, deed.throttle);
    }
}

TEST(ScanTest, EachChoiceIsShownForItsTimeInTurn)
{
    for (const double scan_s : {0.5, 1.5, 10.0}) {
        Scanned one{.rules = {.scan_s = scan_s}};
        for (std::size_t i = 0; i < 2 * scan_choices; ++i) {
            const double from = one.time_s;
            const std::size_t shown = one.scan.choice;
            EXPECT_EQ(shown, i % scan_choices);
            while (one.scan.choice == shown)
                EXPECT_EQ(one.frame(untouched).turn, glm::dvec3(0));
            EXPECT_NEAR(one.time_s - from, scan_s, 1e-9 * frame_ns);
        }
    }
}

TEST(ScanTest, AShortPressActsForItsTimeAndALongOneAsLongAsItIsHeld)
{
    Scanned tap;
    tap.frame(goes_down);
    for (int i = 0; i < 200; ++i)
        tap.frame(untouched);
    EXPECT_NEAR(tap.moved_s, tap.rules.act_s, 2e-9 * frame_ns);
    Scanned long_one;
    long_one.frame(goes_down);
    for (int i = 0; i < 300; ++i)
        long_one.frame(stays_down);
    EXPECT_EQ(long_one.scan.choice, 0u) << "nothing else is shown meanwhile";
    for (int i = 0; i < 50; ++i)
        long_one.frame(untouched);
    EXPECT_NEAR(long_one.moved_s, 301 * 0.016, 1e-6);
    EXPECT_EQ(long_one.scan.choice, 0u) << "the same choice again, for its whole time";
}

TEST(ScanTest, ASecondPressEndsWhatTheFirstBegan)
{
    Scanned one;
    one.rules.act_s = 10;
    one.frame(goes_down);
    for (int i = 0; i < 30; ++i)
        one.frame(untouched);
    one.frame(goes_down);
    for (int i = 0; i < 30; ++i)
        EXPECT_EQ(one.frame(untouched).throttle_rate, 0);
    EXPECT_NEAR(one.moved_s, 31 * 0.016, 1e-6);
    EXPECT_NE(one.frame(goes_down).throttle_rate, 0) << "a third one begins again";
}

TEST(ScanTest, AStuckButtonDoesNotFlyForEver)
{
    Scanned one;
    one.frame(goes_down);
    for (int i = 0; i < 60 / 0.016; ++i)
        one.frame(stays_down);
    EXPECT_NEAR(one.moved_s, 20, 0.05);
    one.frame(untouched);
    one.wait_for(ScanChoice::up);
    EXPECT_EQ(one.frame(goes_down).turn.x, 1);
}

TEST(ScanTest, SlowFramesShowTheChoicesAtTheSameTimes)
{
    // Frame times of which the scan's are whole multiples: the same choices at the same times.
    Scanned fast, slow;
    for (int i = 0; i < 3'000; ++i) {
        for (int k = 0; k < 10; ++k)
            fast.frame(untouched, 10'000'000);
        slow.frame(untouched, 100'000'000);
        ASSERT_EQ(fast.scan.choice, slow.scan.choice) << i;
    }
}

TEST(ScanTest, OneButtonReachesEveryItemOfAMenuAndTheWayOut)
{
    const std::vector<MenuPage> pages{
        {.title = "first", .items = {{"worlds", std::size_t(1)}, {"switches", std::size_t(2)}}},
        {.title = "worlds",
            .items = {{"train", Command{.kind = CommandKind::scene, .text = "train"}},
                {"clocks", Command{.kind = CommandKind::scene, .text = "clocks"}},
                {"twins", Command{.kind = CommandKind::scene, .text = "twins"}}}},
        {.title = "switches",
            .items = {{"doppler", Command{.kind = CommandKind::effect, .effect = Effect::doppler}},
                {"one", Command{.kind = CommandKind::one_button}}},
            .stays = true}};
    const OneButton rules;
    std::set<std::string> taken;
    Requests requests;
    // A visitor for each page and item: presses when it is shown.
    for (std::size_t page = 1; page < pages.size(); ++page)
        for (std::size_t item = 0; item < pages[page].items.size(); ++item) {
            Scan scan;
            MenuState menu{.open = true};
            double time_s = 0;
            std::optional<Command> chosen;
            for (; !chosen && menu.open && time_s < 60; time_s += 0.016) {
                const bool here = menu.page == 0 ? menu.item == page - 1 : menu.item == item;
                const AnyButton button = here ? goes_down : untouched;
                Controls controls
                    = controls_of(advance_in_menu(scan, rules, button, menu.page, pages[menu.page].items.size(), frame_ns));
                chosen = advance(menu, pages, controls, frame_ns, requests);
            }
            ASSERT_TRUE(chosen) << page << ' ' << item;
            EXPECT_EQ(*chosen, std::get<Command>(pages[page].items[item].leads));
            taken.insert(text_of(*chosen));
        }
    EXPECT_EQ(taken.size(), 5u);
    // One who presses nothing is led back, and out.
    Scan scan;
    MenuState menu{.open = true, .page = 1};
    double time_s = 0;
    std::set<std::size_t> shown;
    for (; menu.open && time_s < 60; time_s += 0.016) {
        if (menu.page == 1)
            shown.insert(menu.item);
        Controls controls
            = controls_of(advance_in_menu(scan, rules, untouched, menu.page, pages[menu.page].items.size(), frame_ns));
        EXPECT_FALSE(advance(menu, pages, controls, frame_ns, requests));
    }
    EXPECT_EQ(shown.size(), 3u);
    EXPECT_NEAR(time_s, (3 + 2) * rules.scan_s, 0.1);
    EXPECT_EQ(advance(scan, rules, untouched, frame_ns).turn, glm::dvec3(0));
    EXPECT_EQ(scan.choice, 0u) << "after the menu the first choice is shown again";
}

TEST(ScanTest, AHundredVisitorsWithOneButtonFlyOutAndComeHome)
{
    const SceneFile scene = load_scene_file(shipped_file("scenes", "avenue"));
    for (unsigned seed = 0; seed < 100; ++seed) {
        std::mt19937 random(seed);
        const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
        Flying rules{.max_gamma = 100};
        rules.mode = FlightMode(seed % 3);
        rules.boundary = scene.boundary;
        Flight flight = flight_at(scene.start, rules);
        Scanned one{.rules = {.scan_s = uniform(0.5, 3), .act_s = uniform(0.3, 3)}};
        double farthest = 0, reacts_s = uniform(0.1, 0.4), holds_s = 0;
        const auto fly = [&](AnyButton button) {
            Controls controls = controls_of(one.frame(button));
            controls.set(Switch::menu, false);
            flight = step(flight, controls, frame_ns, rules, scene.seconds_per_time_unit(), scene.start);
            farthest = std::max(farthest, glm::distance(flight.ship.position.total(), scene.start.position));
        };
        // Presses when the wanted choice has been shown for as long as the hand takes, and holds a while.
        const auto choose = [&](ScanChoice wanted) {
            for (double seen_s = 0; seen_s < reacts_s; fly(untouched))
                seen_s = one.scan.choice == std::size_t(wanted) && !one.scan.acts ? seen_s + 0.016 : 0;
            fly(goes_down);
            for (double held_s = 0; held_s < holds_s; held_s += 0.016)
                fly(stays_down);
        };
        for (int presses = 0; presses < 5; ++presses) {
            holds_s = uniform(0, 3);
            choose(ScanChoice::faster);
            holds_s = uniform(0, 1);
            choose(ScanChoice(std::uniform_int_distribution<int>(1, 6)(random)));
        }
        const double until_s = one.time_s + 300;
        holds_s = 0.1;
        choose(ScanChoice::home);
        while (flight.homing && one.time_s < until_s)
            fly(untouched);
        EXPECT_GT(farthest, 0.05) << seed;
        EXPECT_FALSE(flight.homing) << seed;
        fly(untouched);
        EXPECT_EQ(flight.ship.position.total(), scene.start.position) << seed;
        EXPECT_EQ(rapidity_of(flight.ship), 0) << seed << ": and it stays there";
    }
}

} // namespace scan_test
