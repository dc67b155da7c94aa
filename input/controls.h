#pragma once
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

/// The visitor's controls at a time. Rates run from -1 to 1 of the exhibit's limits; switches are true in the one frame in
/// which they are pressed.
struct Controls {
    std::int64_t time_ns = 0;
    std::int64_t report_ns = 0; ///< arrival of the last report of any device; steady clock
    std::optional<double> lever; ///< the throttle's place, from 0 to 1; without one, keys move it
    double throttle_rate = 0; ///< for visitors without a throttle: above 0 faster, below 0 slower
    glm::dvec3 push{0}; ///< thrusters: right, up, back; newtonian flight
    glm::dvec3 turn{0}; ///< pitch up, yaw left, roll left: right-handed about the cockpit's x, y, z
    glm::dvec2 look_rad{0}; ///< change of the look to the left and up since the last frame
    Head head;
    double exposure = 0; ///< change to brighter or darker
    bool look_ahead = false, stop = false;
    bool home = false; ///< fly back to the start
    bool undo = false; ///< ten seconds back
    bool reset = false; ///< to the start at once
    bool next_mode = false;
    bool aberration = false, doppler = false, headlight = false; ///< effects to switch
    bool false_colours = false; ///< the infrared and the ultraviolet, for guides
    bool comparison = false; ///< the next comparison, and back to the seen picture
    bool lock_exposure = false; ///< locks or unlocks the automatic exposure
    // For measuring: the next overlay; a mark at the crosshair; a line of the log; the next page of explanation.
    bool overlay = false, mark = false, log = false, why = false;
    bool hud = false, full_screen = false, quit = false;
    // For builders: the next test pattern; the choice of one of the layout's numbers and its change in steps; saving.
    bool pattern = false, save = false;
    int choose = 0, turn_by = 0;
};

} // namespace starbow
