#pragma once
#include "config/model/switches.h"
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>

namespace starbow {

/// A tracked head's displacement from the layout's head, in the cockpit's axes: right, up, back.
struct Head {
    glm::dvec3 moved_m{0};
    glm::dquat turned{1, 0, 0, 0};
};

// Rates run from -1 to 1 of the exhibit's limits.

struct ControlTimes {
    std::int64_t time_ns = 0;
    std::int64_t report_ns = 0; ///< arrival of the last report of any device; steady clock
};

struct Steering {
    std::optional<double> lever; ///< the throttle's place, from 0 to 1; without one, keys move it
    double throttle_rate = 0; ///< for visitors without a throttle: above 0 faster, below 0 slower
    glm::dvec3 push{0}; ///< thrusters: right, up, back; newtonian flight
    glm::dvec3 turn{0}; ///< pitch up, yaw left, roll left: right-handed about the cockpit's x, y, z
    bool taken = false; ///< the guide has the stick: the ship comes to coasting; in each frame meanwhile
};

struct Looking {
    glm::dvec2 look_rad{0}; ///< change of the look to the left and up since the last frame
    Head head;
    double exposure = 0; ///< change to brighter or darker
};

/// For builders: the choice of one of the layout's numbers and its change in steps.
struct AlignmentSteps {
    int choose = 0, turn_by = 0;
};

/// For knowing whether somebody is there.
struct Touches {
    bool pressed = false; ///< a key, a button or a mouse button went down, whether it has a role or none
    bool held = false; ///< one of them is down
};

/// The visitor's controls at a time. Each member belongs to one of the parts, so that a reader names only its part.
struct Controls : ControlTimes, Steering, Looking, Switches, AlignmentSteps, Touches { };

} // namespace starbow
