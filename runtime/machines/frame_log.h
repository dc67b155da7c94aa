#pragma once
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace starbow {

/// The frames that one machine has shown: a CSV file of a line each, with the time of the machine's steady clock, the
/// frame's number, the digest of its state, and the time that it took to draw. Whole lines survive the end of the program,
/// however it ends.
class FrameLog {
public:
    /// An empty path: nothing is written. Throws InputError where the file can't be made.
    explicit FrameLog(const std::filesystem::path& file);

    bool is_open() const { return file_ != nullptr; }
    /// The frame, which took so long to draw, goes to the screen now.
    void add(std::int64_t frame, std::uint64_t digest, double drawn_ms);

private:
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

} // namespace starbow
