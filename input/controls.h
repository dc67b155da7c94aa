#pragma once
#include "command.h"
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

// Rates run from -1 to 1 of the exhibit's limits. Switches are true in the one frame in which they are pressed.

struct ControlTimes {
    std::int64_t time_ns = 0;
    std::int64_t report_ns = 0; ///< arrival of the last report of any device; steady clock
};

struct Steering {
    std::optional<double> lever; ///< the throttle's place, from 0 to 1; without one, keys move it
    double throttle_rate = 0; ///< for visitors without a throttle: above 0 faster, below 0 slower
    glm::dvec3 push{0}; ///< thrusters: right, up, back; newtonian flight
    glm::dvec3 turn{0}; ///< pitch up, yaw left, roll left: right-handed about the cockpit's x, y, z
    bool stop = false;
    bool home = false; ///< fly back to the start
    bool undo = false; ///< ten seconds back
    bool reset = false; ///< to the start at once
    bool next_mode = false;
    bool freeze = false; ///< the world stands still to look around in, or goes on
    bool menu = false; ///< opens the visitors' menu, or closes it
    bool taken = false; ///< the guide has the stick: the ship comes to coasting; in each frame meanwhile
    bool slow_motion = false; ///< the next slower rate of time, and from the slowest back to the usual one
};

struct Looking {
    glm::dvec2 look_rad{0}; ///< change of the look to the left and up since the last frame
    bool look_ahead = false;
    Head head;
    double exposure = 0; ///< change to brighter or darker
    bool lock_exposure = false; ///< locks or unlocks the automatic exposure
    bool range = false; ///< shows everything at once by a curve, or with one exposure again
};

struct EffectSwitches {
    bool aberration = false, doppler = false, headlight = false;
    bool false_colours = false; ///< the infrared and the ultraviolet, for guides
    bool comparison = false; ///< the next comparison, and back to the seen picture
};

/// For measuring: the next overlay; a mark at the crosshair; a line of the log; the next page of explanation; the next plot.
struct LabSwitches {
    bool overlay = false, mark = false, log = false, why = false, plot = false;
};

struct WindowSwitches {
    bool hud = false, full_screen = false, quit = false;
    bool information = false; ///< the next display of information
    bool beside = false; ///< the next small picture beside the large one
};

/// For builders: the next test pattern; saving; the choice of one of the layout's numbers and its change in steps.
struct AlignmentKeys {
    bool pattern = false, save = false;
    int choose = 0, turn_by = 0;
};

/// For knowing whether somebody is there.
struct Touches {
    bool pressed = false; ///< a key, a button or a mouse button went down, whether it has a role or none
    bool held = false; ///< one of them is down
};

/// From a remote; applied before the frame's other controls.
struct RemoteCommands {
    std::vector<Command> commands;
};

/// The visitor's controls at a time. Each member belongs to one of the parts, so that a reader names only its part.
struct Controls : ControlTimes,
                  Steering,
                  Looking,
                  EffectSwitches,
                  LabSwitches,
                  WindowSwitches,
                  AlignmentKeys,
                  Touches,
                  RemoteCommands { };

} // namespace starbow
