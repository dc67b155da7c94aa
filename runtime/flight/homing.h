#pragma once
#include "ship.h"

namespace starbow {

/// A flight back to a place without the visitor. The ship brakes to rest, then speeds up for half of a straight way and
/// slows down for the other half, while it turns.
struct Homing {
    double braking = 0; ///< rapidity per second
    double elapsed_s = -1; ///< since the way began; below 0 while it brakes
    Ship from; ///< the ship at rest, at the way's beginning
    double rapidity_per_s = 0; ///< on the way
    bool arrived = false;
};

constexpr double braking_s = 1.5, way_s = 4;

Homing homing_from(const Ship& ship);

/// Flies one tick of dt_s seconds. At the end the ship is at rest at `start`'s place with `start`'s look, to the bit.
void fly_home(Ship& ship, Homing& homing, const Shot& start, double dt_s, double seconds_per_time_unit);

} // namespace starbow
