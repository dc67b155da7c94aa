#pragma once
#include "choices.h"
#include "config/model/shot.h"
#include <string>

namespace starbow {

/// The state of a running exhibit that commands change and that remotes and the guide's window show.
struct ExhibitState : Choices {
    std::string scene, shot, tour; ///< names of files, without folder and .json; empty: none
    bool paused = false; ///< the tour, or else the world
    bool fade = false, hold = false;
    Effects effects{};
    bool slow_motion = false;
    double speed = 0; ///< v/c
    double gamma = 1;
    double max_gamma = 1; ///< at full throttle
    double exposure_ev = 0; ///< a docent's change
    std::string caption; ///< a docent's; empty: none
};

/// The commands that switch something on and off, but for effects: the member, and its name in the remote's state.
struct SwitchedState {
    CommandKind kind;
    bool ExhibitState::*member;
    const char* name;
};
inline constexpr SwitchedState switched_states[]{{CommandKind::fade, &ExhibitState::fade, "fade"},
    {CommandKind::hold, &ExhibitState::hold, "hold"}, {CommandKind::pause, &ExhibitState::paused, "paused"},
    {CommandKind::slow_motion, &ExhibitState::slow_motion, "slow-motion"},
    {CommandKind::one_button, &ExhibitState::one_button, "one-button"},
    {CommandKind::left_handed, &ExhibitState::left_handed, "left-handed"},
    {CommandKind::range, &ExhibitState::range, "range"}};

/// Applies a command that switches an effect, or chooses a comparison. Returns false, and changes nothing, for any other.
/// Throws InputError for an unknown comparison.
bool apply(Effects& effects, const Command& command);

/// The state to which a command leads, as far as the command alone says it: switches, choices and numbers, but no world,
/// view or tour. Throws InputError for an unknown name.
ExhibitState after(ExhibitState state, const Command& command);

} // namespace starbow
