#pragma once
#include "config/model/measure.h"
#include "ship.h"

namespace starbow {

/// The value of a measure for a ship. since: the ship whose sizes it compares with. seconds_per_time_unit: of the scene.
double measured(const Measure& measure, const Ship& ship, const Ship& since, double seconds_per_time_unit);

} // namespace starbow
