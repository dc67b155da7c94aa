#pragma once
#include "shared.h"
#include "world.h"
#include <string>

namespace starbow {

/// What is seen on a clock that rests in the world, seconds: what it showed when the light left. time: the eye's, distance:
/// from the eye to the clock at the eye's event, both in the world's frame and in scene units, so that a moving eye sees the
/// same there and then as a resting one. Good to the rounding of `time`: 2e-9 s after four months of seconds.
double reading_s(const WorldClock& clock, double time, double distance, double seconds_per_time_unit);

/// The figures that show a reading: "-5.9", to the nearest tenth. Dashes from 1e10 s on.
std::string figures(double reading_s);

/// The clocks of a world in front of one eye, which is at `eye` at the world's `time`: its first instances, in
/// sort_instances' order. The middle is that of the bounding box.
std::vector<shared::ClockEntry> clock_entries(const World& world, const glm::dvec3& eye, const glm::dmat3& motion_from_world,
    double time, double seconds_per_time_unit);

} // namespace starbow
