#pragma once
#include <filesystem>
#include <functional>
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

/// Starts a program by start_program and waits for its end.
Ended ran(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

/// Has a program write a file: the whole file or nothing. make: runs the program, which writes to the absolute place that it
/// is given. Throws InputError where the file can't be put in its place.
Ended make_whole(const std::filesystem::path& file, const std::function<Ended(const std::filesystem::path& part)>& make);

/// The reason why a program failed, for a message: its last line, or how it ended.
std::string how(const Ended& ended);

} // namespace starbow
