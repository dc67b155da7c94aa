#pragma once
#include "shaders/shared_structs.h"
#include "eye_event.h"
#include <string>

namespace starbow {

/// What is seen on a clock, seconds: what it showed when the light left. time: the eye's, less that at which the clock's own
/// time is 0; distance: from the eye to the clock at the eye's event; both in the frame in which the clock rests and in
/// scene units, so that a moving eye sees the same there and then as a resting one. Good to the rounding of `time`: 2e-9 s
/// after four months of seconds.
double reading_s(const WorldClock& clock, double time, double distance, double seconds_per_time_unit);

/// The figures that show a reading: "-5.9", to the nearest tenth. Dashes from 1e10 s on.
std::string figures(double reading_s);

/// The times of what is timed() in front of an eye: the frame's first instances, in sort_instances' order. The middle is
/// that of the bounding box.
std::vector<shared::TimeEntry> time_entries(const World& world, const EyeEvent& eye_event, double seconds_per_time_unit);

} // namespace starbow
