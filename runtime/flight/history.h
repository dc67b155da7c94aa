#pragma once
#include "flight.h"
#include <deque>

namespace starbow {

/// The last ten seconds of a flight, for a visitor who has got lost.
class History {
public:
    /// Keeps the flight; call it after each step.
    void keep(const Flight& flight);

    /// The flight of ten seconds ago, or the oldest kept one. The mode, the switches, slow motion, the exposure and the
    /// clock stay as they are. The states in between are dropped, so that a second call leads further back.
    Flight back(const Flight& now);

    bool empty() const { return kept_.empty(); }

private:
    std::deque<Flight> kept_;
};

/// Applies one frame's controls: first an undo, then the step, which the history keeps. The live flight and every replay
/// use this function.
Flight flown(const Flight& flight, History& history, const Controls& controls, std::int64_t dt_ns, const Flying& rules,
    double seconds_per_time_unit, const Shot& start);

constexpr std::int64_t history_ticks = 10'000, history_every_ticks = 100;

} // namespace starbow
