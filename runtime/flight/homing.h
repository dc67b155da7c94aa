#pragma once
#include "config/model/flying.h"
#include "ship.h"

namespace starbow {

/// A flight back to a place without the visitor. The ship brakes to rest, then speeds up for half of a straight way and
/// slows down for the other half, while it turns. Then the start's clock counts again. Before a start in flight the world
/// stands still at the start's instant while the velocity grows to the start's.
struct Homing {
    double braking = 0; ///< rapidity per second
    double elapsed_s = -1; ///< since the way began; below 0 while it brakes
    Ship from; ///< the ship at rest, at the way's beginning
    double rapidity_per_s = 0; ///< on the way
    double way_s = 0, launch_s = 0; ///< durations of the way, and of the launch into a start in flight
    bool arrived = false;
};

/// The shortest durations; the limits that spare stomachs make them longer.
constexpr double least_braking_s = 1.5, least_way_s = 4, least_launch_s = 1.5;

Homing homing_from(const Ship& ship, const Shot& start, const Flying& rules);

/// Flies one tick of dt_s seconds. At the end the ship is at `start`'s instant, place, velocity and look to the bit, with
/// its clock and its distance at 0.
void fly_home(Ship& ship, Homing& homing, const Shot& start, const Flying& rules, double dt_s, double seconds_per_time_unit);

} // namespace starbow
