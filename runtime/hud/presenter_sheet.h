#pragma once
#include "config/model/words.h"
#include "input/exhibit_state.h"
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace starbow {

/// A step of the shown tour, for the guide's cue sheet.
struct Cue {
    std::string text; ///< what the visitors read in it
    double seconds = 0;
};

/// An item of the programme.
struct ProgrammeCue {
    std::string title, notes;
    double minutes = 0; ///< planned
};

/// The running exhibit as its guide's window shows it.
struct PresenterState : ExhibitState {
    std::vector<Cue> cues; ///< of the tour; empty: none is shown, or it is over
    std::vector<ProgrammeCue> programme; ///< empty: there is none
    bool own_effects = true; ///< the flight's effects can be switched; a tour shows its own
    std::string said; ///< about the last command; empty: none came
    bool refused = false; ///< it was refused
    /// The choices of each list: a name as in a command, and one for people.
    std::vector<std::pair<std::string, std::string>> scenes, tours, shots, languages;
};

enum class PresenterList { worlds, tours, views, limits, languages };

/// The guide's place in the window: the open list, its page, and the caption that is being typed.
struct PresenterHands {
    PresenterList list = PresenterList::worlds;
    std::size_t page = 0; ///< of the list
    std::optional<std::string> typed{}; ///< a caption that is being typed; none: keys are commands
};

struct OpenList {
    PresenterList list;
};
struct MoreChoices { };
struct TypeCaption { };
using PresenterDeed = std::variant<Command, OpenList, MoreChoices, TypeCaption>;

/// A key of the window, which is a button for the mouse, too.
struct PresenterKey {
    int key = 0;
    int also = 0; ///< a second key for the same, as a presentation's clicker sends it; 0: none
    std::string name; ///< printed on the key
    std::string label;
    std::string state; ///< of what it changes; empty: none
    bool on = false; ///< what it switches is on, or what it chooses is shown
    bool usable = true; ///< false: the exhibit would refuse it now
    PresenterDeed deed;
};

/// Everything that the guide's window says.
struct PresenterSheet {
    std::vector<std::pair<std::string, std::string>> facts; ///< label and value
    std::string cue_title; ///< the tour, its step and the seconds left; or that there is none
    std::vector<Cue> cues;
    std::size_t step = 0;
    std::string item_title; ///< of the programme's present item, with its time; empty: there is no programme
    std::string item_notes, item_then; ///< the guide's notes, and the next item
    std::string list_title;
    std::vector<PresenterKey> choices; ///< the shown page of the open list, at digits, and its key for more
    std::vector<PresenterKey> keys;
    std::string said;
    bool refused = false;
    std::optional<std::string> typed;
    std::string typed_help;
};

/// Choices on one page of a list.
constexpr std::size_t most_choices = 10;

/// thumbnail_of() what a key shows; empty: it shows nothing.
std::string thumbnail_of(const PresenterKey& key);

PresenterSheet sheet_of(const PresenterState& state, const PresenterHands& hands, const Words& words);

/// A key of the sheet, or one that types; nothing happens at any other. Returns the command that it gives.
std::optional<Command> press(const PresenterSheet& sheet, PresenterHands& hands, int key);
/// A character that is typed into a caption.
void type(PresenterHands& hands, char32_t character);

} // namespace starbow
