#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace starbow {

/// Detects that files are written, or replaced by others as editors do.
class FileWatch {
public:
    using Clock = std::chrono::steady_clock;
    explicit FileWatch(std::vector<std::filesystem::path> files);

    /// True once after a change, when the files have stayed the same for a fifth of a second: nobody reads half a file. A
    /// missing file counts as a change after a second, because saving may remove it for a moment. It reads the disk at
    /// most ten times a second, however often it is called.
    bool changed(Clock::time_point now);

    /// True if all files are as they were when changed() last reported, or at the beginning.
    bool same() const { return look() == known_; }

private:
    struct Stamp {
        std::int64_t written_s = 0, written_ns = 0, size = 0;
        std::uint64_t number = 0; ///< inode
        bool operator==(const Stamp&) const = default;
    };
    /// nullopt where a file is missing.
    std::optional<std::vector<Stamp>> look() const;

    std::vector<std::filesystem::path> files_;
    std::optional<std::vector<Stamp>> known_, seen_;
    Clock::time_point looked_, seen_since_;
};

} // namespace starbow
