#pragma once
#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace starbow {

/// Starts a program from the PATH, without a shell and with nothing to read. folder: where it runs; empty: here. says: a
/// file descriptor for its standard error; -1: none. child: on success its process, which has to be waited for. Returns 0 or
/// the error's number.
int start_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder, int says, pid_t& child);

/// How another program ended.
struct Ended {
    int status; ///< from waitpid; -1: not started
    int error; ///< the reason
    std::string said; ///< the end of its standard error
};

/// Starts a program so and waits for its end.
Ended ran(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

/// The reason why a program failed, for a message: its last line, or how it ended.
std::string how(const Ended& ended);

} // namespace starbow
