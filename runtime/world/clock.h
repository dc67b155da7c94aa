#pragma once
#include "eye_event.h"
#include "shaders/shared_structs.h"
#include <string>

namespace starbow {

/// A clock's reading as it is seen, seconds: its value at the retarded time. time: the eye's, less the time at which the
/// clock's own time is 0. distance: from the eye to the clock at the eye's event. Both are in the clock's rest frame and in
/// scene units. So a moving eye sees the same at an event as a resting one. Accurate to the rounding of `time`: 2e-9 s after
/// four months of seconds.
double reading_s(const WorldClock& clock, double time, double distance, double seconds_per_time_unit);

/// The figures that show a reading: "-5.9", to the nearest tenth; dashes from 1e10 s on.
std::string figures(double reading_s);

/// The times of the timed() instances before an eye event: the rest frame's first instances, in sort_instances' order.
/// Each one's middle is that of its bounding box.
std::vector<shared::TimeEntry> time_entries(const World& world, const EyeEvent& eye_event, double seconds_per_time_unit);

} // namespace starbow
