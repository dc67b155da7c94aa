#pragma once
#include "record.h"
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace starbow {

/// Writes a record on a thread of its own: no frame ever waits for a disk. What was kept is on the disk a second later. A
/// disk that is full, or away, ends the record with a sentence, not the flight.
class Recorder {
public:
    /// file: a new one; or a folder, where a new one is named by date and time. say: is called with a line for the log, from
    /// any thread. Throws InputError where the file can't be made, or is there already.
    Recorder(const std::filesystem::path& file, const RecordHeader& header, std::function<void(const std::string&)> say);
    ~Recorder(); ///< after everything is on the disk
    Recorder(const Recorder&) = delete;

    /// Keeps a frame, and where it led.
    void keep(const RecordEntry& entry, const Flight& flight);
    /// The last line of a flight that was left properly.
    void end(const Flight& flight);

    bool failed() const; ///< said so, and keeps nothing more
    const std::filesystem::path& file() const { return file_; }

private:
    void add(const std::string& text);
    void write();
    void write_out(const std::string& text);

    std::filesystem::path file_;
    std::function<void(const std::string&)> say_;
    int stream_ = -1;
    bool ordinary_ = false; ///< a file on a disk, not a pipe
    std::int64_t checked_ticks_ = 0;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::string waiting_; ///< to be written
    bool ended_ = false, failed_ = false;
    std::thread writer_;
};

/// Less than this free on its disk, and a record ends by itself: others need the disk too.
constexpr std::uintmax_t least_free_bytes = std::uintmax_t(256) << 20;

} // namespace starbow
