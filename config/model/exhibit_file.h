#pragma once
#include "exposing.h"
#include "flying.h"
#include "information.h"
#include "one_button.h"
#include "presenting.h"
#include "remote_file.h"
#include "visiting.h"
#include <filesystem>
#include <optional>
#include <string>

namespace starbow {

/// The machines that show one exhibit together.
struct Machines {
    std::string master; ///< the node that has the visitors' devices, the remote and the tours
    std::string interface; ///< a network interface's name, or a network of which each machine has an address
    int domain = 0; ///< from 0 to 200
    std::string exhibit; ///< the identity by which its machines know each other; empty: it follows from the layout
};

/// The worlds and tours that visitors can choose: names of shipped ones; none: all.
struct Menu {
    std::vector<std::string> scenes, tours;
};

/// The parts of an exhibit, and its rules of flight.
struct Exhibit {
    // Paths, or names of shipped files.
    std::string layout = "desk", scene = "avenue";
    std::string shot; ///< the start of the visit, in its own scene; empty: the scene's start
    std::filesystem::path profiles; ///< a folder with profiles of this exhibit's own sticks; empty: none
    std::string tour; ///< the shown tour, in its own scene; empty: none
    std::string programme; ///< of a guide's show: a path, or the name of a shipped one; empty: none
    std::string language = "en"; ///< of the visitors' texts: a path, or the name of a shipped one
    Menu menu;
    Information information = Information::laboratory; ///< the first display of information
    bool speech = false; ///< captions, descriptions and goals are read aloud
    bool tutorial = true; ///< three prompts for the first minute
    std::string quality; ///< a path, or the name of a shipped one; empty: the device's default
    double frame_budget_ms = 0; ///< time of a whole frame, held by the ladder; 0: the quality stays
    std::string ladder = "ladder"; ///< a path, or the name of a shipped one
    std::filesystem::path textfile; ///< receives the counts for node_exporter; empty: none
    Flying flying;
    std::optional<OneButton> one_button{}; ///< the visitors fly with one button; none: where they choose so in the menu
    bool left_handed = false; ///< the controls are a left-handed visitor's, from the start of each visit
    Exposing exposure;
    RemoteSettings remote;
    std::optional<Presenting> presenter; ///< the guide's window; none: there is none
    std::optional<Machines> machines; ///< none: one machine shows it
    std::optional<Visiting> visiting; ///< the exhibit attends to its visitors itself; none: somebody else does
};

/// Reads and checks an exhibit, without opening the files that it names. Throws InputError with file, line, JSON pointer,
/// value and what would be right.
Exhibit load_exhibit(const std::filesystem::path& file);

} // namespace starbow
