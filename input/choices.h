#pragma once
#include "command.h"
#include "config/model/information.h"
#include "config/model/inset_view.h"
#include "config/model/switches.h"
#include <string>

namespace starbow {

/// Everything that a visitor chooses beside the flight's own switches. The next visitor has the exhibit's own again: a reset
/// assigns it whole.
struct Choices {
    std::string language; ///< name of a file, without folder and .json
    Information information = Information::laboratory; ///< the shown display
    InsetView inset = InsetView::none;
    bool sky_names = false; ///< of constellations, stars and planets
    bool range = false; ///< everything is visible at once
    bool filter = false; ///< a dark filter, through which the brightest thing in view is seen well
    bool one_button = false; ///< the visitor flies with one
    bool left_handed = false; ///< keyboard and sticks for a left-handed visitor
    bool operator==(const Choices&) const = default;
};

/// True for a command that switches one of a visitor's choices on and off.
bool switches_choice(CommandKind kind);
/// Applies a command that chooses. Returns false, and changes nothing, for any other. Throws InputError for an unknown name.
bool apply(Choices& choices, const Command& command);
/// Applies the switches of a frame that choose.
void apply(Choices& choices, Switches pressed);

} // namespace starbow
