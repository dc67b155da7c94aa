#pragma once
#include "enum_set.h"
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace starbow {

/// A switch of a visitor, a guide or a builder: true in the one frame in which it is pressed. In the order of records.
enum class Switch : std::uint8_t {
    look_ahead,
    stop,
    home, ///< fly back to the start
    undo, ///< ten seconds back
    reset, ///< to the start at once
    next_mode,
    freeze, ///< the world stands still to look around in, or goes on
    menu, ///< opens the visitors' menu, or closes it
    slow_motion, ///< the next slower rate of time, and from the slowest back to the usual one
    aberration,
    doppler,
    headlight,
    false_colours,
    comparison, ///< the next comparison, and back to the seen picture
    lock_exposure, ///< locks or unlocks the automatic exposure
    range, ///< shows everything at once by a curve, or with one exposure again
    filter, ///< a dark filter before the eyes, or none again
    overlay, ///< the next instrument
    mark, ///< at the crosshair
    log, ///< a line of the log
    why, ///< the next page of explanation
    plot, ///< the next plot
    hud,
    information, ///< the next display of information
    inset, ///< the next inset view
    sky_names, ///< names of stars, constellations and planets
    full_screen,
    quit,
    pattern, ///< the next test pattern
    save, ///< the layout
    count
};
using Switches = EnumSet<Switch>;

/// The change of the picture by a press. A calm exhibit holds back every press that changes it at once (input/calm.h). No
/// value is 0, so that no row can leave it out.
enum class Leap : std::uint8_t {
    none = 1, ///< nothing at once, or some words: letters alone are too small an area to flash
    press, ///< it changes at once; a second press adds nothing while the first one waits
    toggle, ///< it changes at once; a second press undoes the first
};

/// The person who presses it. No value is 0, so that no row can leave it out.
enum class Presser : std::uint8_t {
    pilot = 1, ///< a visitor who flies: neither while a menu is open nor while a docent holds the exhibit
    visitor, ///< not while a docent holds the exhibit
    reader, ///< of the display: also while a docent holds the exhibit
    student, ///< in a laboratory, as it writes a file; locked where an exhibit attends to its visitors
    builder, ///< locked there, too
};

/// Keys by GLFW's numbers; letters, digits and space have those of their characters.
namespace keys {
constexpr int none = 0, space = 32, escape = 256, enter = 257, tab = 258, backspace = 259, right = 262, left = 263,
              down = 264, up = 265, page_up = 266, page_down = 267, f1 = 290, f2 = 291, f5 = 294, f11 = 300,
              keypad_enter = 335;
}
/// A gamepad's buttons by GLFW's numbers.
enum class PadButton : std::int8_t {
    none = -1,
    a,
    b,
    x,
    y,
    left_bumper,
    right_bumper,
    back,
    start,
    guide,
    left_stick,
    right_stick
};

/// The properties of a switch.
struct SwitchEntry {
    Switch which;
    std::string_view name; ///< in records; a button's role has - for _
    Leap leap;
    Presser by;
    std::string_view help; ///< after the key's name; empty: no key
    std::array<int, 2> keys{}; ///< keys::none: fewer
    PadButton pad = PadButton::none;
};

/// Every switch once. Keyboard, pads, profiles, records, presence, calm hands and the soak loop over them.
inline constexpr std::array all_switches{
    SwitchEntry{
        Switch::look_ahead, "look_ahead", Leap::press, Presser::visitor, "look ahead again", {'C'}, PadButton::left_bumper},
    SwitchEntry{Switch::stop, "stop", Leap::press, Presser::pilot, "stop at once, relative to the world", {keys::space},
        PadButton::a},
    SwitchEntry{Switch::home, "home", Leap::press, Presser::pilot, "fly back to the start", {'R'}, PadButton::b},
    SwitchEntry{
        Switch::undo, "undo", Leap::press, Presser::pilot, "ten seconds back", {keys::backspace}, PadButton::left_stick},
    SwitchEntry{Switch::reset, "reset", Leap::press, Presser::pilot, ""},
    SwitchEntry{Switch::next_mode, "next_mode", Leap::press, Presser::pilot,
        "the next mode of flight: guided, free, newtonian", {'M'}},
    SwitchEntry{Switch::freeze, "freeze", Leap::toggle, Presser::pilot, // its words are too large an area
        "freeze the world, to look around in it; again: go on", {'P'}},
    SwitchEntry{Switch::menu, "menu", Leap::toggle, Presser::pilot, "the visitors' menu", {keys::tab, keys::enter}},
    SwitchEntry{Switch::slow_motion, "slow_motion", Leap::press, Presser::pilot, // its words are too large an area
        "slow motion: a quarter, a sixteenth, the usual rate of time", {'T'}},
    SwitchEntry{
        Switch::aberration, "aberration", Leap::toggle, Presser::visitor, "aberration on and off", {'1'}, PadButton::x},
    SwitchEntry{
        Switch::doppler, "doppler", Leap::toggle, Presser::visitor, "Doppler effect on and off", {'2'}, PadButton::y},
    SwitchEntry{Switch::headlight, "headlight", Leap::toggle, Presser::visitor, "headlight effect on and off", {'3'},
        PadButton::right_bumper},
    SwitchEntry{Switch::false_colours, "false_colours", Leap::toggle, Presser::visitor,
        "for guides: infrared and ultraviolet in false colours, on and off", {'4'}},
    SwitchEntry{Switch::comparison, "comparison", Leap::press, Presser::visitor,
        "to compare: velocities that simply add, no light delay, and back to the seen picture", {'5'}},
    SwitchEntry{Switch::lock_exposure, "lock_exposure", Leap::none,
        Presser::visitor, // a released exposure is as slow as ever
        "lock the automatic exposure, or release it", {'L'}},
    SwitchEntry{Switch::range, "range", Leap::toggle, Presser::visitor,
        "everything visible at once, with brightness compressed, on and off", {'V'}},
    SwitchEntry{Switch::filter, "filter", Leap::toggle, Presser::visitor,
        "a dark filter: the brightest thing in view, such as the Sun, shows its surface, on and off", {'F'}},
    SwitchEntry{Switch::overlay, "overlay", Leap::press, Presser::visitor,
        "instruments: crosshair, grid, ring of D = 1, distance, time of emission, protractor, spectrum, photometer, off",
        {'O'}, PadButton::start},
    SwitchEntry{Switch::mark, "mark", Leap::press, Presser::visitor, // shows the crosshair and its panel, as `log` does
        "mark the thing at the crosshair (the first, the second)", {'X'}, PadButton::right_stick},
    SwitchEntry{Switch::log, "log", Leap::press, Presser::student, "write a line of the log", {'K'}},
    SwitchEntry{Switch::why, "why", Leap::press, Presser::visitor, "why? the next page, with the formula and its numbers",
        {keys::f1}},
    SwitchEntry{Switch::plot, "plot", Leap::press, Presser::visitor,
        "plots of the log against theory: D, length, clock, off", {'G'}},
    SwitchEntry{Switch::hud, "hud", Leap::toggle, Presser::reader, "head-up display on and off", {'H'}, PadButton::back},
    SwitchEntry{Switch::information, "information", Leap::press, Presser::reader,
        "the next head-up display: for visitors, guides, the laboratory", {'I'}},
    SwitchEntry{Switch::inset, "beside", Leap::press, Presser::reader,
        "beside the picture: the same instant at rest, or with one effect alone, or none", {'N'}},
    SwitchEntry{Switch::sky_names, "sky_names", Leap::toggle, Presser::reader,
        "the sky's names: constellations, stars and planets, on and off", {'B'}},
    SwitchEntry{Switch::full_screen, "full_screen", Leap::toggle, Presser::builder, "full screen", {keys::f11}},
    SwitchEntry{Switch::quit, "quit", Leap::none, Presser::builder, "leave", {keys::escape}},
    SwitchEntry{
        Switch::pattern, "pattern", Leap::press, Presser::builder, "for builders: the next test pattern", {keys::f2}},
    SwitchEntry{Switch::save, "save", Leap::none, Presser::builder, "for builders: save the changes in the layout's file",
        {keys::f5}},
};
static_assert(has_each_in_order(all_switches, &SwitchEntry::which, Switch::count), "a new switch belongs in the list above");
static_assert(std::ranges::all_of(all_switches,
                  [](const SwitchEntry& one) {
                      return one.leap != Leap{} && one.by != Presser{} && one.help.empty() == (one.keys[0] == keys::none);
                  }),
    "a switch says its leap and who presses it, and one with a key has help");

constexpr const SwitchEntry& entry_of(Switch which) { return all_switches[std::size_t(which)]; }
/// The switches of which something is true.
template <class Test> constexpr Switches switches_where(Test test)
{
    Switches those;
    for (const SwitchEntry& one : all_switches)
        those.set(one.which, test(one));
    return those;
}
constexpr Switches switches_of(Presser by)
{
    return switches_where([by](const SwitchEntry& one) { return one.by == by; });
}
/// Those that a button of a device may have for its role.
inline constexpr Switches button_switches
    = switches_where([](const SwitchEntry& one) { return one.keys[0] != keys::none && one.by != Presser::builder; });

/// A name with - for _, as roles and commands have it.
std::string dashed(std::string_view name);

} // namespace starbow
