#pragma once
#include "config/model/words.h"
#include "lab_table.h"
#include <optional>
#include <span>

namespace starbow {

/// What a log says about a challenge.
struct Finding {
    enum class Right { about, at_most };
    bool solved = false;
    long line = 0; ///< of the file: the nearest to the answer
    double found = 0, right = 0, tolerance = 0; ///< in the challenge's unit; tolerance: for about
    Right kind = Right::about;
};

/// An open question of the laboratory. Each of its texts is the key of words.
struct Challenge {
    const char* name; ///< as the command line takes it
    const char* start; ///< options of starbow run that lead to a good place
    Key title, ask, tools, check;
    std::array<Key, 3> hints; ///< in steps, each says more
    Key unit; ///< with {number}; none for a pure number
    int decimals; ///< of the shown figures
    /// The line of a log that comes nearest to the answer; nullopt where no line says anything about it.
    std::optional<Finding> (*look)(const std::vector<LabLine>& lines);
};

std::span<const Challenge> challenges();

/// What the log says, in a sentence: "done in line 12: 0.0987; 0.100 ± 0.010 is right". What is right is said of a solved
/// challenge alone.
std::string said_of(const Challenge& challenge, const std::optional<Finding>& finding, const Words& words);

/// Where flights begin among the lines: at the first one, and wherever the clock of ship or world goes back.
std::vector<std::size_t> flights_begin(const std::vector<LabLine>& lines);

} // namespace starbow
