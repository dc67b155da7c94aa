#pragma once
#include "flight.h"

namespace starbow {

/// What a mode of flight makes of the controls in one tick.
struct Push {
    glm::dvec3 rapidity{0}; ///< gained in the tick, cockpit axes
    bool stop = false; ///< at rest at once: the last bit of slowing down
};

/// The flight's smoothed controls (turn_rad_s, faster, thrust, lever) move on by a tick; the ship does not yet.
Push pilot(Flight& flight, const Controls& controls, const Flying& rules);

} // namespace starbow
