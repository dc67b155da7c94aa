#pragma once
#include "config/model/tour_file.h"
#include "ship.h"

namespace starbow {

/// From 0 to 1: the polynomial of seventh order that has no speed, no acceleration and no jerk at either end.
double eased(double x);

/// The ship a part (0 to 1) of a step's time after its start, by the step's motion. seconds_per_time_unit: of the scene.
/// Where the visitor flies it stays.
Ship along(const Step& step, const Ship& start, double part, double seconds_per_time_unit);

} // namespace starbow
