#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>

namespace starbow {

/// How a tracked head has moved from where the layout has it, in the cockpit's axes: right, up, back.
struct Head {
    glm::dvec3 moved_m{0};
    glm::dquat turned{1, 0, 0, 0};
};

/// What the visitor wants, at a time. Rates run from -1 to 1 of what the exhibit allows; switches are true in the one frame
/// in which they are pressed.
struct Controls {
    std::int64_t time_ns = 0;
    std::int64_t told_ns = 0; ///< when the last report of any device arrived; the steady clock's
    std::optional<double> lever; ///< where the throttle stands, from 0 to 1; without one keys move it
    double throttle_rate = 0; ///< of who has no throttle: above 0 more, below 0 less
    glm::dvec3 push{0}; ///< thrusters: right, up, back; newtonian flight
    glm::dvec3 turn{0}; ///< pitch up, yaw left, roll left: right-handed about the cockpit's x, y, z
    glm::dvec2 look_rad{0}; ///< how much further to look to the left and up, since the last frame
    Head head;
    double exposure = 0; ///< brighter or darker
    bool look_ahead = false, stop = false;
    bool home = false; ///< fly back to the start
    bool undo = false; ///< ten seconds back
    bool reset = false; ///< to the start at once
    bool next_mode = false;
    bool aberration = false, doppler = false, headlight = false; ///< effects to switch over
    bool false_colours = false; ///< the infrared and the ultraviolet, for who guides
    bool comparison = false; ///< the next view to compare with, and back to what is seen
    bool lock_exposure = false; ///< hold the automatic exposure, or let it go
    // For who measures: the next overlay; the thing at the crosshair; a line of the log; the next page that tells why.
    bool overlay = false, mark = false, log = false, why = false;
    bool hud = false, full_screen = false, quit = false;
    // For who builds the exhibit: the next test pattern; which of the layout's numbers to turn, by how many steps; keep
    // them.
    bool pattern = false, save = false;
    int choose = 0, turn_by = 0;
};

} // namespace starbow
