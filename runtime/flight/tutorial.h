#pragma once
#include "config/model/words.h"
#include "flight.h"
#include "input/capabilities.h"
#include <string>

namespace starbow {

/// A visitor's first minute: go, turn, stop. Each prompt disappears when its task is done.
struct Tutorial {
    int lesson = 0; ///< index of the lesson; beyond the last there is no prompt
    double begun_at = 0; ///< rapidity when the lesson began
    double turned_rad = 0; ///< angle that the nose has turned since the lesson began
};

constexpr int lessons = 3;
constexpr double lesson_rapidity = 0.3, lesson_turn_rad = 0.35;

Tutorial tutorial_at(const Flight& flight);

/// The tutorial after a step of the flight, with that step's controls.
Tutorial advance(Tutorial tutorial, const Controls& controls, const Flight& flight, double dt_s);

/// The present prompt, in words for the controls at hand, or "".
std::string prompt(const Tutorial& tutorial, const InputCapabilities& capabilities, const Words& words);

} // namespace starbow
