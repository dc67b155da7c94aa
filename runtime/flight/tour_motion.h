#pragma once
#include "config/model/tour_file.h"
#include "ship.h"

namespace starbow {

/// The easing from 0 to 1: the polynomial of seventh order with no speed, acceleration or jerk at either end.
double eased(double x);

/// The ship at a part (0 to 1) of a step's time, by the step's motion. seconds_per_time_unit: of the scene. In a step
/// that the visitor flies, it stays at the start.
Ship along(const Step& step, const Ship& start, double part, double seconds_per_time_unit);

} // namespace starbow
