#pragma once
#include "recorder.h"
#include "replay.h"
#include <chrono>
#include <memory>

namespace starbow {

/// What an exhibit keeps of its flight, or what it flies again instead of the visitor's controls: a record, a replay, or
/// neither.
class RecordReplay {
public:
    using Clock = std::chrono::steady_clock;
    RecordReplay(std::unique_ptr<Recorder> recorder, std::unique_ptr<Replay> replay)
        : recorder_(std::move(recorder))
        , replay_(std::move(replay))
    {
    }

    bool replays() const { return replay_ != nullptr; }

    /// In a replay puts the next recorded frame in this one's place, when its time has come: what a stall had skipped is not
    /// waited for. False after the last.
    bool play(RecordEntry& entry);
    /// Records the frame, or compares where it has led.
    void keep(const RecordEntry& entry, const Flight& flight);
    /// The flight was left properly. For people, on standard output. False where a replay was not the same to the bit.
    bool end(const Flight& flight);

private:
    std::unique_ptr<Recorder> recorder_;
    std::unique_ptr<Replay> replay_;
    bool played_ = false; ///< to the end
    Clock::time_point due_{}; ///< the last frame
};

} // namespace starbow
