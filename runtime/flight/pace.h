#pragma once
#include "config/model/flying.h"
#include "ship.h"

namespace starbow {

/// The distance from a place to the nearest thing of a world, scene units, at least Pace::least; Pace::least without a
/// thing.
double nearest(const Pace& pace, const glm::dvec3& place);

/// The greatest gain of speed, rapidity per second of the visitor's, of a ship that reaches the nearest thing at its present
/// speed in t of those seconds: Pace::per_s2 times t. The rapidity w of a ship at the distance d from things then gains by
/// k d / sinh w, and gamma = cosh w by k d in each second: evenly, and the faster, the emptier the space around it. Infinite
/// at rest. seconds_per_time_unit: the visitor's seconds in a time unit (scene unit / c) on board.
double paced_gain(const Pace& pace, const Ship& ship, double seconds_per_time_unit);

/// The pace by which a flight from a start, straight ahead at full throttle, covers the planned distance in the planned time
/// (to 1 %). Where the greatest gamma or the greatest gain of the rules make it longer, it is the fastest.
Pace pace_for(const PlannedFlight& planned, std::vector<AlignedBox> things, const Shot& start, const Flying& rules,
    double seconds_per_time_unit);

} // namespace starbow
