#pragma once
#include "choices.h"
#include "config/model/shot.h"
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace starbow {

/// The course of a visit in one word. The words have a sentence for each, by its name.
enum class Doing {
    attract_tour, ///< nobody is there, and a tour runs
    attract_record, ///< the same, and a recorded flight is shown
    attract_start, ///< the same, and the start of the flight is shown
    changes, ///< on its way to what is shown while nobody is there
    enters, ///< somebody has come: on its way to the visitor's flight
    waits, ///< nobody has touched a control yet
    flies, ///< a visitor does
    asks, ///< whether the visitor is still there
    tour, ///< in its own motion
    tour_asks, ///< a question waits for its answer
    tour_flies, ///< a step of the tour in which the visitor flies
    replays, ///< a record
};
/// In the order of Doing.
inline constexpr std::array doing_names{"attract_tour", "attract_record", "attract_start", "changes", "enters", "waits",
    "flies", "asks", "tour", "tour_asks", "tour_flies", "replays"};

/// The offered speed limits, gamma: half, 0.9, 0.99 and 0.999 of light's speed, and further on. The last is no limit.
inline constexpr std::array offered_limits{1.1547, 2.2942, 7.0888, 22.366, 100.0, 1000.0, 1e6};

/// The state of a running exhibit that commands change and that remotes and the guide's window show.
struct ExhibitState : Choices {
    std::string scene, shot, tour; ///< names of files, without folder and .json; empty: none
    std::string coming; ///< the name of a world that is being read; empty: none
    Doing doing = Doing::waits;
    int step = 0, steps = 0; ///< of the running tour, the first one 1; 0: none runs
    double left_s = 0; ///< of the step
    /// The whole caption of the tour's next step, in each language: its name and the text; empty where there is none.
    std::vector<std::pair<std::string, std::string>> next_caption;
    int item = 0, items = 0; ///< of the programme, begun last, the first one 1; 0: none yet, and no programme
    double item_s = 0; ///< since the item began
    bool calm = false; ///< the exhibit limits flashes
    bool paused = false; ///< the tour, or else the world
    bool fade = false, hold = false;
    Effects effects{};
    bool slow_motion = false;
    double speed = 0; ///< v/c
    double gamma = 1;
    double max_gamma = 1; ///< at full throttle
    double exposure_ev = 0; ///< a docent's change
    std::string caption; ///< a docent's; empty: none
    bool as_saved = false; ///< the picture is by the layout's file, without what a builder has moved since
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
    {CommandKind::filter, &ExhibitState::filter, "filter"}, {CommandKind::sky_names, &ExhibitState::sky_names, "sky-names"},
    {CommandKind::range, &ExhibitState::range, "range"}, {CommandKind::as_saved, &ExhibitState::as_saved, "as-saved"}};

/// Applies a command that switches an effect, or chooses a comparison. Returns false, and changes nothing, for any other.
/// Throws InputError for an unknown comparison.
bool apply(Effects& effects, const Command& command);

/// The state to which a command leads, as far as the command alone says it: switches, choices and numbers, but no world,
/// view or tour. Throws InputError for an unknown name.
ExhibitState after(ExhibitState state, const Command& command);

} // namespace starbow
