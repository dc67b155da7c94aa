// The visitors' menu: it takes the hands from the ship while it is open, and gives a docent's commands.
#include "runtime/flight/menu.h"
#include "tests/support/controls.h"
#include <gtest/gtest.h>
#include <random>

namespace menu_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

constexpr std::int64_t frame_ns = 16'000'000;

struct Visitor {
    std::vector<MenuPage> pages{
        {.title = "first",
            .items = {{"worlds", std::size_t(1)}, {"switches", std::size_t(2)}, {"close", MenuItem::Close{}}}},
        {.title = "worlds",
            .items = {{"train", Command{.kind = CommandKind::scene, .text = "train"}},
                {"clocks", Command{.kind = CommandKind::scene, .text = "clocks"}}}},
        {.title = "switches",
            .items = {{"doppler", Command{.kind = CommandKind::effect, .effect = Effect::doppler}}},
            .stays = true}};
    MenuState menu;
    Controls left; ///< of the last frame's controls: what reaches the ship

    std::pair<std::size_t, std::size_t> shown() const { return {menu.shown.page, menu.shown.item}; }
    std::optional<Command> does(const Controls& hands)
    {
        std::optional<Command> chosen = holds(hands);
        const Controls after = left;
        holds({}); // the hand lets go
        left = after;
        return chosen;
    }
    std::optional<Command> holds(const Controls& hands)
    {
        Requests requests;
        std::optional<Command> chosen = advance(menu, pages, hands, frame_ns, requests);
        left = requested(hands, requests);
        return chosen;
    }
};

const Controls opens = controls_with(Switches{Switch::menu}), takes = controls_with(Switches{Switch::stop}),
               leads_back = controls_with(Switches{Switch::home}), right = controls_with(Steering{.turn = {0, -1, 0}}),
               left_hand = controls_with(Steering{.turn = {0, 1, 0}});

} // namespace

TEST(MenuTest, AWorldIsChosenByTheStick)
{
    Visitor visitor;
    EXPECT_FALSE(visitor.does(opens));
    EXPECT_TRUE(visitor.menu.open);
    EXPECT_FALSE(visitor.does(takes));
    EXPECT_EQ(visitor.menu.page, 1u);
    EXPECT_FALSE(visitor.does(right));
    const std::optional<Command> chosen = visitor.does(takes);
    ASSERT_TRUE(chosen);
    EXPECT_EQ(chosen->kind, CommandKind::scene);
    EXPECT_EQ(chosen->text, "clocks");
    EXPECT_FALSE(visitor.menu.open);
}

TEST(MenuTest, NothingButTheLeverReachesTheShip)
{
    Visitor visitor;
    visitor.does(opens);
    visitor.does(controls_with(
        Steering{.lever = 0.4, .throttle_rate = 1, .push = {1, 1, 1}, .turn = {1, 1, 1}}, Switches{Switch::undo}));
    EXPECT_EQ(visitor.left.lever, 0.4);
    EXPECT_EQ(visitor.left.turn, glm::dvec3(0));
    EXPECT_EQ(visitor.left.push, glm::dvec3(0));
    EXPECT_EQ(visitor.left.throttle_rate, 0);
    EXPECT_FALSE((visitor.left & switches_of(Presser::pilot)).any());
    Visitor closed;
    closed.does(controls_with(Steering{.turn = {1, 1, 1}}, Switches{Switch::stop}));
    EXPECT_TRUE(closed.left[Switch::stop]) << "a menu that is shut takes nothing";
    EXPECT_EQ(closed.left.turn, glm::dvec3(1));
}

TEST(MenuTest, TheChoiceGoesAroundAndRepeatsWhileTheStickIsHeld)
{
    Visitor visitor;
    visitor.does(opens);
    visitor.does(left_hand);
    EXPECT_EQ(visitor.menu.item, 2u) << "from the first to the last";
    visitor.does(right);
    EXPECT_EQ(visitor.menu.item, 0u);
    int steps = 0;
    std::size_t before = visitor.menu.item;
    for (int i = 0; i < 63; ++i) { // one second: at once, after half of it, and each fifth then
        visitor.holds(right);
        steps += visitor.menu.item != before;
        before = visitor.menu.item;
    }
    EXPECT_EQ(steps, 4);
}

TEST(MenuTest, BackLeadsToTheFirstPageAndOut)
{
    Visitor visitor;
    visitor.does(opens);
    visitor.does(takes);
    visitor.does(leads_back);
    EXPECT_TRUE(visitor.menu.open);
    EXPECT_EQ(visitor.menu.page, 0u);
    visitor.does(leads_back);
    EXPECT_FALSE(visitor.menu.open);
    visitor.does(opens);
    visitor.does(right);
    visitor.does(right);
    visitor.does(takes);
    EXPECT_FALSE(visitor.menu.open) << "the choice to close it";
}

TEST(MenuTest, SwitchesStayOpen)
{
    Visitor visitor;
    visitor.does(opens);
    visitor.does(right);
    visitor.does(takes);
    EXPECT_EQ(visitor.does(takes)->effect, Effect::doppler);
    EXPECT_TRUE(visitor.menu.open);
    EXPECT_EQ(visitor.does(takes)->effect, Effect::doppler);
    visitor.does(opens);
    EXPECT_FALSE(visitor.menu.open) << "the menu's own key shuts it";
}

TEST(MenuTest, AMenuThatNobodyTouchesCloses)
{
    Visitor visitor;
    visitor.does(opens);
    for (int i = 0; i < 19 * 1000 / 16; ++i) {
        visitor.holds(controls_with(Steering{.lever = 0.7}));
    }
    EXPECT_TRUE(visitor.menu.open);
    for (int i = 0; i < 2 * 1000 / 16; ++i) {
        visitor.holds({});
    }
    EXPECT_FALSE(visitor.menu.open);
}

TEST(MenuTest, APageWithoutChoicesClosesTheMenu)
{
    Visitor visitor;
    visitor.pages[1].items.clear();
    visitor.does(opens);
    visitor.does(takes);
    EXPECT_FALSE(visitor.menu.open);
    visitor.holds(left_hand);
    EXPECT_EQ(visitor.left.turn.y, 1) << "the hands reach the ship again";
}

TEST(MenuTest, RandomHandsNeverLeaveTheMenusPages)
{
    std::mt19937 random{3};
    Visitor visitor;
    const MenuItem world = visitor.pages[1].items[0];
    int chosen = 0;
    for (int i = 0; i < 200'000; ++i) {
        const auto once_in = [&](unsigned frames) { return random() % frames == 0; };
        const double turn = double(random() % 3) - 1;
        Controls hands = controls_with(Steering{.turn = {0, turn, 0}});
        for (const auto& [which, frames] :
            {std::pair(Switch::stop, 10u), {Switch::home, 100u}, {Switch::undo, 100u}, {Switch::menu, 20u}})
            hands.set(which, once_in(frames));
        if (i % 5000 == 0)
            visitor.pages[1].items.resize(random() % 3, world); // a world goes, or comes
        chosen += visitor.holds(hands).has_value();
        ASSERT_LT(visitor.menu.page, visitor.pages.size());
    }
    EXPECT_GT(chosen, 1000);
}

/// A choice's small picture is shown once the choice has stayed, and leads nobody to a picture of another one for long.
TEST(MenuTest, AChoicesSmallPictureComesOnceItStays)
{
    using Choice = std::pair<std::size_t, std::size_t>;
    Visitor visitor;
    visitor.does(opens), visitor.does(takes); // the worlds
    EXPECT_EQ(visitor.shown(), Choice(0, 0));
    for (int i = 0; i < 30; ++i)
        visitor.holds({});
    EXPECT_EQ(visitor.shown(), Choice(1, 0));
    visitor.does(right);
    EXPECT_EQ(visitor.shown(), Choice(1, 0)) << "until the next one stays";
    for (int i = 0; i < 30; ++i)
        visitor.holds({});
    EXPECT_EQ(visitor.shown(), Choice(1, 1));
    visitor.does(leads_back);
    EXPECT_EQ(visitor.shown(), Choice(0, 0));
}

/// docs/safety.md: three flashes in a second at most, each of two opposing changes.
TEST(MenuTest, NoHandsMakeSmallPicturesFlash)
{
    std::mt19937_64 random(5);
    const std::vector<Controls> pressed{opens, takes, leads_back, {}}, held{right, left_hand, {}, {}};
    Visitor visitor;
    std::vector<std::int64_t> changes;
    auto before = visitor.shown();
    std::size_t hand = 0;
    for (std::int64_t now = 0; now < 4'000'000'000'000; now += frame_ns) {
        const bool presses = random() % 20 == 0;
        if (random() % 40 == 0)
            hand = random() % held.size();
        visitor.holds(presses ? pressed[random() % pressed.size()] : held[hand]);
        if (visitor.shown() != before)
            changes.push_back(now), before = visitor.shown();
    }
    ASSERT_GT(changes.size(), 1000u);
    for (std::size_t i = 6; i < changes.size(); ++i)
        EXPECT_GT(changes[i] - changes[i - 6], 1'000'000'000) << "six changes are three flashes";
}

} // namespace menu_test
