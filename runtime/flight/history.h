#pragma once
#include "flight.h"
#include <deque>

namespace starbow {

/// The last ten seconds of a flight, for who has got lost.
class History {
public:
    /// After each step.
    void keep(const Flight& flight);

    /// The flight as it was ten seconds ago, or as long ago as is known; switches, throttle and clock stay as they are. What
    /// lies between is forgotten: called again it leads further back.
    Flight back(const Flight& now);

private:
    std::deque<Flight> kept_;
};

/// What one frame's controls lead to: what is undone first, then the step, which the history keeps. The live flight and
/// every replay go through this.
Flight flown(const Flight& flight, History& history, const Controls& controls, std::int64_t dt_ns, const Flying& rules,
    double seconds_per_time_unit, const Shot& start);

constexpr std::int64_t history_ticks = 10'000, history_every_ticks = 100;

} // namespace starbow
