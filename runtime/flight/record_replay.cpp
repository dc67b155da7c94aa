#include "record_replay.h"
#include <algorithm>
#include <cstdio>
#include <thread>

namespace starbow {

bool RecordReplay::play(RecordEntry& entry)
{
    if (!replay_)
        return true;
    const auto recorded = replay_->next();
    played_ = !recorded;
    if (played_)
        return false;
    entry = *recorded;
    entry.controls.save = false; // a replay writes no layout
    const auto length = std::chrono::nanoseconds(entry.dt_ns);
    std::this_thread::sleep_until(due_ += length);
    due_ = std::max(due_, Clock::now() - length); // a late replay does not hurry, because each frame must be seen
    return true;
}

void RecordReplay::keep(const RecordEntry& entry, const Flight& flight)
{
    if (recorder_)
        recorder_->keep(entry, flight);
    if (replay_)
        replay_->compare(flight);
}

bool RecordReplay::end(const Flight& flight)
{
    if (recorder_) {
        recorder_->end(flight);
        const std::string where
            = recorder_->failed() ? "not recorded to the end" : "recorded in " + recorder_->file().string();
        std::printf("%s, flight state %s\n", where.c_str(), shown_digest(digest(flight)).c_str());
    }
    if (!replay_)
        return true;
    if (played_ || replay_->differs())
        std::printf("%s\n", replay_->verdict().c_str());
    else
        std::printf("left before the record's end; the same to the bit at %d checks\n", replay_->checks());
    return !replay_->differs();
}

} // namespace starbow
