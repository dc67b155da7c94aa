#pragma once
#include "input/command.h"
#include "input/requests.h"
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace starbow {

/// A choice of a menu: it leads to another page or gives a command, or it closes the menu.
struct MenuItem {
    struct Close { };
    std::string text;
    std::variant<Close, std::size_t, Command> leads{};
};

struct MenuPage {
    std::string title;
    std::vector<MenuItem> items; ///< a page without any closes the menu
    bool stays = false; ///< its commands leave the menu open: they are switches
};

/// The place of a visitor in a menu, whose first page is its beginning.
struct MenuState {
    bool open = false;
    std::size_t page = 0, item = 0;
    bool nudged = false; ///< the stick is still away from its middle
    double nudged_s = 0;
    std::int64_t idle_ns = 0, rested_ns = 0; ///< since the last touch, and since the choice is this one
    /// The choice whose small picture is shown: the last one that has stayed for 0.4 s. So pictures flash at most 2.5 times
    /// in a second, whatever is pressed.
    struct {
        std::size_t page = 0, item = 0;
    } shown{};
};

/// Advances a menu by a frame. While it is open, the stick or the arrows choose, the stop button takes, home and undo lead
/// back, and by the requests none of them reaches the ship, whose lever stays. Returns the chosen command. A menu that
/// nobody touches for twenty seconds closes.
std::optional<Command> advance(
    MenuState& menu, std::span<const MenuPage> pages, const Controls& hands, std::int64_t dt_ns, Requests& requests);

} // namespace starbow
