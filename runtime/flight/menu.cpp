#include "menu.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace starbow {
namespace {

constexpr std::int64_t closes_after_ns = 20'000'000'000;
constexpr std::int64_t picture_after_ns = 400'000'000;
constexpr double first_repeat_s = 0.5, repeat_s = 0.2;

/// The step of the choice that a hand asks for now: to the right or down is on.
int nudge(MenuState& menu, const Steering& hands, double dt_s)
{
    constexpr double far = 0.5;
    const double aside = std::abs(hands.turn.y) > std::abs(hands.turn.x) ? -hands.turn.y : -hands.turn.x;
    const int by = aside > far ? 1 : aside < -far ? -1 : 0;
    if (by == 0) {
        menu.nudged = false;
        return 0;
    }
    if (!std::exchange(menu.nudged, true)) {
        menu.nudged_s = -first_repeat_s;
        return by;
    }
    menu.nudged_s += dt_s;
    if (menu.nudged_s < 0)
        return 0;
    menu.nudged_s -= repeat_s;
    return by;
}

/// Leads one page back, and from the first one out of the menu.
void back(MenuState& menu)
{
    if (menu.page == 0)
        menu = {};
    else
        menu = {.open = true, .nudged = menu.nudged};
}

std::optional<Command> choose(MenuState& menu, const MenuPage& page)
{
    const auto& leads = page.items[menu.item].leads;
    if (const auto* other = std::get_if<std::size_t>(&leads)) {
        menu.page = *other, menu.item = 0, menu.rested_ns = 0;
        return {};
    }
    if (!page.stays || std::holds_alternative<MenuItem::Close>(leads))
        menu = {};
    const auto* command = std::get_if<Command>(&leads);
    return command ? std::optional(*command) : std::nullopt;
}

} // namespace

std::optional<Command> advance(
    MenuState& menu, std::span<const MenuPage> pages, const Controls& hands, std::int64_t dt_ns, Requests& requests)
{
    Switches pressed = hands & switches_of(Presser::pilot);
    if (!menu.open) {
        menu.open = pressed[Switch::menu];
        if (!menu.open)
            return {};
        pressed.set(Switch::menu, false);
    }
    requests.hands_in_menu = true;
    const int by = nudge(menu, hands, 1e-9 * double(dt_ns));
    constexpr Switches used{Switch::stop, Switch::home, Switch::undo, Switch::menu};
    const bool touched = by != 0 || (pressed & used).any() || hands.pressed;
    menu.idle_ns = touched ? 0 : menu.idle_ns + dt_ns;
    menu.rested_ns = by != 0 ? 0 : menu.rested_ns + dt_ns;
    if (menu.rested_ns >= picture_after_ns)
        menu.shown = {menu.page, menu.item};
    const MenuPage& page = pages[menu.page];
    if (page.items.empty()) { // its last choice has gone meanwhile
        menu = {};
        return {};
    }
    const auto count = int(page.items.size());
    menu.item = std::size_t((std::min(int(menu.item), count - 1) + by + count) % count);
    if (pressed[Switch::menu] || menu.idle_ns > closes_after_ns)
        menu = {};
    else if (pressed[Switch::home] || pressed[Switch::undo])
        back(menu);
    else if (pressed[Switch::stop])
        return choose(menu, page);
    return {};
}

} // namespace starbow
