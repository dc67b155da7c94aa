#pragma once
#include "flight.h"
#include <limits>

namespace starbow {

/// A flight mode's effect on the ship in one tick.
struct Push {
    glm::dvec3 rapidity{0}; ///< gain in the tick, cockpit axes
    glm::dvec3 turn{0}; ///< in the tick, a rotation vector, radians, cockpit axes
    bool stop = false; ///< the ship is at rest at once: the end of slowing down
};

/// The limits of a place in a world, where the throttle sets the speed.
struct SpeedLimits {
    double rapidity = std::numeric_limits<double>::infinity(); ///< the greatest
    double gain = std::numeric_limits<double>::infinity(); ///< of speed: the greatest, rapidity per second
};

/// Advances the flight's smoothed turn by a tick, or its wait for the next step where the rules turn in steps. Returns the
/// turn in the tick: pitch, yaw, roll, radians.
glm::dvec3 steer(Flight& flight, const Steering& controls, const Flying& rules);

/// Advances the flight's smoothed controls (turn_rad_s, step_wait, throttle_rate, thrust, lever) by a tick; it does not move
/// the ship.
Push pilot(Flight& flight, const Steering& controls, const Flying& rules, const SpeedLimits& limits = {});

/// The ship's motion in the next tick under these controls.
FeltMotion felt_motion(Flight flight, const Steering& controls, const Flying& rules, const SpeedLimits& limits = {});

} // namespace starbow
