#pragma once
#include "config/model/log_kinds.h"
#include "record.h"
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace starbow {

/// Waits until `over` holds, at most so long, as std::condition_variable::wait_for does. A test brings a clock of its own.
using TimedWait = std::function<void(std::condition_variable& changed, std::unique_lock<std::mutex>& lock,
    std::chrono::nanoseconds longest, const std::function<bool()>& over)>;
void wait_in_real_time(std::condition_variable& changed, std::unique_lock<std::mutex>& lock, std::chrono::nanoseconds longest,
    const std::function<bool()>& over);

/// Writes a record on a thread of its own, so that no frame waits for a disk. Entries reach the disk within a second. On
/// a full or missing disk the record ends with a message, and the flight goes on.
class Recorder {
public:
    /// file: a new one; or a folder, where the file is named by date and time. log: is called with a line for the log, from
    /// any thread. wait: of the writing thread. Throws InputError where the file can't be made, or exists already.
    Recorder(const std::filesystem::path& file, const RecordHeader& header, LogTo log, TimedWait wait = wait_in_real_time);
    ~Recorder(); ///< waits until everything is on the disk
    Recorder(const Recorder&) = delete;

    /// Keeps a frame, and a check of its result when one is due.
    void keep(const RecordEntry& entry, const Flight& flight);
    /// Writes the last line of a flight that ended properly.
    void end(const Flight& flight);

    bool failed() const; ///< true after a reported failure; nothing more is kept
    const std::filesystem::path& file() const { return file_; }

private:
    void add(const std::string& text);
    void write() noexcept;
    void write_out(const std::string& text);

    std::filesystem::path file_;
    LogTo log_;
    TimedWait wait_;
    int stream_ = -1;
    bool ordinary_ = false; ///< the file is on a disk, not a pipe
    std::int64_t checked_ticks_ = 0;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::string waiting_; ///< text not written yet
    bool ended_ = false, failed_ = false;
    std::thread writer_;
};

/// A record ends by itself when its disk has less than this free: other programs need the disk too.
constexpr std::uintmax_t least_free_bytes = std::uintmax_t(256) << 20;

} // namespace starbow
