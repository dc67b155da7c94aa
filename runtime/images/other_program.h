#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace starbow {

/// How another program ended.
struct Ended {
    int status; ///< from waitpid; -1: not started
    int error; ///< the reason
    std::string said; ///< the end of its standard error
};

/// Runs a program from the PATH in a folder, without a shell, and waits for its end.
Ended ran(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

/// The reason why a program failed, for a message: its last line, or how it ended.
std::string how(const Ended& ended);

} // namespace starbow
