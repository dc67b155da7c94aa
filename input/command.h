#pragma once
#include "config/model/effects.h"
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace starbow {

/// The people at a remote: each role may do all that the ones before it may.
enum class Role : std::uint8_t { look, docent, engineer };

enum class CommandKind : std::uint8_t {
    fade, ///< on: to black; off: back to the picture
    stop,
    reset, ///< to the start at once, with the exhibit's own rules, language and effects
    tour,
    next, ///< the tour's next step
    back, ///< the tour's step before
    pause, ///< on: the tour, or else the world, stands still
    scene,
    shot,
    speed_limit, ///< number: greatest gamma
    exposure, ///< number: EV, added to whatever is shown
    range, ///< on: everything visible at once; off: one exposure
    sky_names, ///< on: the names of constellations, stars and planets
    filter, ///< on: a dark filter, through which the brightest thing in view is seen well
    slow_motion, ///< on: the time on board at a quarter
    one_button, ///< on: the visitor flies with one button
    left_handed, ///< on: keyboard and sticks for a left-handed visitor
    comparison, ///< text: one of comparison_names
    inset, ///< text: one of inset_view_names
    information, ///< text: a name of `informations`
    language,
    caption, ///< text on the head-up display; empty: none
    hold, ///< on: the visitors' devices do nothing
    pointer, ///< place: azimuth and elevation, degrees in the cockpit; the guide's pointer goes there
    touch, ///< place in the live picture, parts of its width and height; the pointer goes to what is seen there
    item, ///< number: of the show's programme, the first one 1; it is shown
    layout,
    pattern,
    quality,
    unlock, ///< a builder's keys, for ten minutes
    grip, ///< text: the name of a grip of the layout, which `move` moves from now on
    move, ///< place: steps to the right and down
    move_back, ///< takes the last move back
    as_saved, ///< on: the picture by the layout's file, to compare with
    keep, ///< writes the layout's moved numbers into its file
    restart, ///< ends the exhibit, so that the service manager starts it anew
    effect, ///< on: it is shown; one command for each effect, with its name
};

/// The value that a command has, or none; a place is two numbers.
enum class CommandValue : std::uint8_t { none, on, number, name, text, place };

/// The numbers that a command may have.
struct CommandRange {
    double least, most;
    bool above = false; ///< the least one itself is none of them
};

/// A command's name on the wire, on the command line and in records, the least role that may give it, and its value.
struct CommandRule {
    CommandKind kind;
    std::string_view name;
    Role role;
    CommandValue value;
    CommandRange range{0, 0}; ///< of a number, and of a place's first one
    Effect effect{}; ///< of the kind `effect`
    CommandRange second{0, 0}; ///< of a place's second number
};

/// All commands: one of each kind in the order of CommandKind, and as the last ones one for each effect.
std::span<const CommandRule> command_rules();

/// A command to the running exhibit, from a remote, OSC, `starbow tell`, the visitors' menu or the guide's window.
struct Command {
    CommandKind kind{};
    bool on = false;
    double number = 0;
    std::string text{}; ///< a name, or a caption
    Effect effect{}; ///< of the kind `effect`
    double second = 0; ///< of a place; its first number is `number`

    bool operator==(const Command&) const = default;
};

const CommandRule& rule_of(const Command& command);

/// True for a command of a builder who aligns the picture.
inline bool aligns(CommandKind kind) { return kind >= CommandKind::grip && kind <= CommandKind::keep; }

/// Greatest change of the exposure by a command, EV: a thousand times the light, or a thousandth.
constexpr double most_exposure_ev = 10;

/// Longest text of a command in bytes: a caption of some lines.
constexpr std::size_t most_command_text = 400;

/// v/c at a gamma. A speed limit is a gamma, and people read it as a part of light's speed.
double speed_of(double gamma);

/// Reads a command from its words, as on a command line: {"scene", "avenue"}, {"doppler", "off"}, {"stop"}, {"pointer",
/// "30", "20"}. A speed limit may be a part of light's speed, 0.97c. Throws
/// InputError with the right form. It does not look whether a named file exists.
Command command_of(std::span<const std::string> words);
/// The words of which command_of makes the same command.
std::vector<std::string> words_of(const Command& command);
/// The words as one line, for logs.
std::string text_of(const Command& command);

} // namespace starbow
