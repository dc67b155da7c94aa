#pragma once

namespace starbow {

/// The kinds of control in the visitor's hands, for prompts.
struct InputCapabilities {
    bool stick = false; ///< a stick's, a pad's or a space mouse's axis turns the nose
    bool lever = false;
    bool trigger = false; ///< an axis increases the speed
    int stop_button = 0, home_button = 0, undo_button = 0; ///< their numbers on the device; 0: none
    bool left_handed = false;
};

} // namespace starbow
