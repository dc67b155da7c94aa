#pragma once
#include <filesystem>
#include <string>

namespace starbow {

/// The number of kept traces. A crash adds one, and the next start removes the oldest.
constexpr int most_crash_traces = 20;

/// From here on a crash (SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, an uncaught exception) leaves a file with its stack in
/// the folder, which is made only then, and the process ends by the signal as without this. The oldest files beyond
/// most_crash_traces are removed at once.
void keep_crash_traces(const std::filesystem::path& folder, const std::string& version);

} // namespace starbow
