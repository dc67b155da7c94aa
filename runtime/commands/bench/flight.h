#pragma once

namespace starbow {

struct FlightTimes {
    double longest_ms = 0, p50_ms = 0, p99_ms = 0;
};

/// Flies the avenue for a minute of its time, ten frames a second: take-off, every switch at gamma 4, gamma 100 and back,
/// overlays, a tour's cuts, a resize, and an edit of the layout. Each frame's time is from its planning to the device's end,
/// with whatever pipelines it needs first. Prints each manoeuvre's longest frame to stdout. Returns the times of all frames.
FlightTimes bench_flight();

} // namespace starbow
