#pragma once
#include "config/model/one_button.h"
#include "controls.h"
#include <cstddef>
#include <cstdint>

namespace starbow {

/// The choices of one-button flying, in the order in which they are shown.
enum class ScanChoice : std::uint8_t { faster, slower, left, right, up, down, stop, home, menu };
constexpr std::size_t scan_choices = 9;

/// The one button in a frame: any key, button or mouse button.
struct AnyButton {
    bool pressed = false; ///< went down
    bool held = false; ///< is down
};

/// The place of a visitor who flies with one button.
struct Scan {
    std::size_t choice = 0; ///< the shown one
    std::int64_t shown_ns = 0; ///< since it is shown
    bool acts = false; ///< it was taken, and acts
    std::int64_t acts_ns = 0; ///< since the press
    std::size_t page = 0, passed = 0; ///< in a menu: its page, counted from 1, and the items that went by; 0: in no menu
};

/// The controls of a frame of one-button flying.
struct ScannedHands : Steering, Switches { };

/// A button that is held longer than that, ns, acts no more: it is stuck.
constexpr std::int64_t longest_hold_ns = 20'000'000'000;

/// Advances by a frame. A press takes the shown choice: it acts while the button is held, and after a short press for act_s,
/// or until the next press. Then the same choice is shown for its whole time again. Returns the hands that act on the ship.
ScannedHands advance(Scan& scan, const OneButton& rules, AnyButton button, std::int64_t dt_ns);

/// The same in a menu, which shows its items in turn by the returned steering: a press takes one, and after the last item
/// the menu leads a page back. page: counted from 0. items: of the page.
ScannedHands advance_in_menu(
    Scan& scan, const OneButton& rules, AnyButton button, std::size_t page, std::size_t items, std::int64_t dt_ns);

/// The part of the shown choice's time that has passed, 0 to 1; while it acts, the part of act_s.
double passed_part(const Scan& scan, const OneButton& rules);

} // namespace starbow
