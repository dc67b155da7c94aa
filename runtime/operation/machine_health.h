#pragma once
#include <string>
#include <vector>

namespace starbow {

/// One of the machines that show an exhibit, as the master sees it.
struct MachineHealth {
    std::string name;
    bool in_step = false;
    double frame_ms = 0; ///< that its last frame took
    bool differs = false; ///< it has another file than the master
};

/// How many of them are in step.
std::size_t in_step(const std::vector<MachineHealth>& machines);

/// Their states in one line: "left 6.9 ms, middle 7.1 ms, right away".
std::string line_of(const std::vector<MachineHealth>& machines);

} // namespace starbow
