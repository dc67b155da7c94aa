#pragma once
#include <string>

namespace starbow {

struct FlashOptions {
    std::string film; ///< a tour's file or name, or a record's file
    std::string layout; ///< "": the desk for a tour, the record's own for a record
    std::string mode = "eye"; ///< of a tour's exposure, by its name
    std::string out; ///< the picture's file; "": NAME-flashes.png in the current folder
};

/// Draws a tour or a record frame by frame, counts the flashes that each eye sees on each output, prints them and draws
/// them over time. Returns the exit status: 1 where there are more than may be.
int check_flashes(const FlashOptions& options);

} // namespace starbow
