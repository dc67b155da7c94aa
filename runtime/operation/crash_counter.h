#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

namespace starbow {

/// After so many disorderly ends within this time an exhibit starts with care.
constexpr int most_ends = 5;
constexpr std::int64_t ends_within_s = 600;

/// The disorderly ends of a supervised exhibit, such as crashes and hangs, in the file `ends` of a folder: a line with the
/// Unix time of each lately, and the line "running" during a run. A start that finds this line takes it for one more end.
class CrashCounter {
public:
    /// Reads the file, and writes it with this run. A folder that can't be written counts no ends. now_s: Unix time.
    CrashCounter(const std::filesystem::path& folder, std::int64_t now_s);
    int lately() const { return int(times_.size()); } ///< within ends_within_s before this start
    /// This run ends in order, and so all before it are forgotten.
    void in_order() const;

private:
    std::filesystem::path file_;
    std::vector<std::int64_t> times_;
};

} // namespace starbow
