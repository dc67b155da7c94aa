#pragma once
#include "exposing.h"
#include "flying.h"
#include <filesystem>
#include <string>

namespace starbow {

/// What an exhibit is made of, and how it flies.
struct Exhibit {
    // Each a path, or the name of a shipped one.
    std::string layout = "desk", scene = "avenue";
    std::string shot; ///< where the visit begins, in the scene of its own; empty: at the scene's start
    std::filesystem::path profiles; ///< a folder with profiles of this exhibit's own sticks; empty: none
    std::string tour; ///< that is shown, in a scene of its own; empty: none
    std::string language = "en"; ///< of what visitors read: a path, or the name of a shipped one
    bool tutorial = true; ///< three prompts for the first minute
    std::string quality; ///< a path, or the name of a shipped one; empty: what the device affords
    double frame_budget_ms = 0; ///< of a whole frame: held by moving along the ladder; 0: the quality stays
    std::string ladder = "ladder"; ///< a path, or the name of a shipped one
    Flying flying;
    Exposing exposure;
};

/// Reads and checks an exhibit; what it names is not opened here. Throws InputError with file, line, JSON pointer, value and
/// what would be right.
Exhibit load_exhibit(const std::filesystem::path& file);

} // namespace starbow
