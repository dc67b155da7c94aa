#pragma once

namespace starbow {

/// What the visitor's hands hold, for prompts.
struct InputCapabilities {
    bool stick = false; ///< or a pad's, or a space mouse: something turns the nose
    bool lever = false;
    bool trigger = false; ///< an axis for faster
    int stop_button = 0; ///< its number on the device; 0: none
};

} // namespace starbow
