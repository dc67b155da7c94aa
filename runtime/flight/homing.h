#pragma once
#include "config/model/flying.h"
#include "ship.h"
#include <cstdint>

namespace starbow {

/// The legs of a flight back to the start, in their order. settling: the visitor's thrust and turn fade. braking: the ship
/// slows down to rest. way: it speeds up for half of a straight way and slows down for the other half, while it turns; then
/// the start's clock counts again. launch, before a start in flight: the world stands still at the start's instant while
/// the velocity grows to the start's.
enum class HomingLeg { settling, braking, way, launch };

/// The thrust and the turn of the ship, cockpit axes.
struct FeltMotion {
    glm::dvec3 thrust{0}; ///< rapidity per second
    glm::dvec3 turn_rad_s{0}, turn_gain_rad_s2{0};
};

/// A flight back to a place without the visitor. No leg gains or loses speed faster, turns faster, or changes either of
/// them faster, than the rules allow; and each leg begins and ends without thrust, but for the settling's beginning.
struct Homing {
    HomingLeg leg = HomingLeg::settling;
    std::int64_t ticks = 0, elapsed = 0; ///< of this leg, whole and so far
    FeltMotion settling; ///< at the beginning
    Ship from; ///< the ship at this leg's beginning
    double gain = 0, ramp_s = 0; ///< on the way: the greatest, rapidity per second; and the time in which it is reached
    bool arrived = false;
    bool from_boundary = false; ///< the world's end began it, and no visitor
};

/// The shortest durations; the limits that spare stomachs make them longer.
constexpr double least_braking_s = 1.5, least_way_s = 4, least_launch_s = 1.5;

/// motion: at this moment, so that it goes on from there.
Homing homing_from(const Ship& ship, const FeltMotion& motion, const Flying& rules);

/// Flies one tick. At the end the ship is at `start`'s instant, place, velocity and look to the bit, with its clock and its
/// distance at 0.
void fly_home(Ship& ship, Homing& homing, const Shot& start, const Flying& rules, double seconds_per_time_unit);

} // namespace starbow
