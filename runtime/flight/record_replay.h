#pragma once
#include "recorder.h"
#include "replay.h"
#include <chrono>
#include <functional>
#include <memory>
#include <thread>

namespace starbow {

/// The clock by which a replay's frames are due. A test turns one of its own.
struct ReplayTime {
    using Clock = std::chrono::steady_clock;
    std::function<Clock::time_point()> now = Clock::now;
    std::function<void(Clock::time_point)> sleep_until = [](Clock::time_point due) { std::this_thread::sleep_until(due); };
};

/// The exhibit's record of its flight, or the replay that takes the place of the visitor's controls, or neither.
class RecordReplay {
public:
    using Clock = ReplayTime::Clock;
    RecordReplay(std::unique_ptr<Recorder> recorder, std::unique_ptr<Replay> replay, ReplayTime time = {})
        : recorder_(std::move(recorder))
        , replay_(std::move(replay))
        , time_(std::move(time))
    {
    }

    bool replays() const { return replay_ != nullptr; }

    /// In a replay, waits until the next recorded frame is due and replaces `entry` by it; recorded stalls are skipped.
    /// Returns false after the last.
    bool play(RecordEntry& entry);
    /// Records the frame, or compares its result with the record.
    void keep(const RecordEntry& entry, const Flight& flight);
    /// A record begins.
    void record(std::unique_ptr<Recorder> recorder) { recorder_ = std::move(recorder); }
    /// Ends the record or the replay of a flight that ended properly. say: receives lines for people. Returns false if a
    /// replay differed in any bit.
    bool end(const Flight& flight, const std::function<void(std::string)>& say);
    /// Closes the record's file; its last entries are written.
    void close() { recorder_.reset(); }

private:
    std::unique_ptr<Recorder> recorder_;
    std::unique_ptr<Replay> replay_;
    ReplayTime time_;
    bool played_ = false; ///< the replay has reached its end
    Clock::time_point due_{}; ///< due time of the last frame
};

} // namespace starbow
