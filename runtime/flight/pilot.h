#pragma once
#include "flight.h"

namespace starbow {

/// A flight mode's effect on the ship in one tick.
struct Push {
    glm::dvec3 rapidity{0}; ///< gain in the tick, cockpit axes
    bool stop = false; ///< the ship is at rest at once: the end of slowing down
};

/// Advances the flight's smoothed turn by a tick.
void steer(Flight& flight, const Steering& controls, const Flying& rules);

/// Advances the flight's smoothed controls (turn_rad_s, throttle_rate, thrust, lever) by a tick; it does not move the
/// ship. most_rapidity: where the throttle sets the speed, it sets no greater one.
Push pilot(Flight& flight, const Steering& controls, const Flying& rules, double most_rapidity);

/// The ship's motion in the next tick under these controls.
FeltMotion felt_motion(Flight flight, const Steering& controls, const Flying& rules, double most_rapidity);

} // namespace starbow
