#include "record_replay.h"
#include <algorithm>

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
    entry.controls.set(Switch::save, false); // a replay writes no layout
    std::erase_if(entry.commands, [](const Command& command) { return command.kind == CommandKind::keep; });
    const auto length = std::chrono::nanoseconds(entry.dt_ns);
    time_.sleep_until(due_ += length);
    due_ = std::max(due_, time_.now() - length); // a late replay does not hurry, because each frame must be seen
    return true;
}

void RecordReplay::keep(const RecordEntry& entry, const Flight& flight)
{
    if (recorder_)
        recorder_->keep(entry, flight);
    if (replay_)
        replay_->compare(flight);
}

bool RecordReplay::end(const Flight& flight, const std::function<void(std::string)>& say)
{
    if (recorder_) {
        recorder_->end(flight);
        const std::string where
            = recorder_->failed() ? "not recorded to the end" : "recorded in " + recorder_->file().string();
        say(where + ", flight state " + shown_digest(digest(flight)));
    }
    if (!replay_)
        return true;
    if (played_ || replay_->differs())
        say(replay_->verdict());
    else
        say("left before the record's end; the same to the bit at " + std::to_string(replay_->checks()) + " checks");
    return !replay_->differs();
}

} // namespace starbow
