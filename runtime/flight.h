#pragma once
#include "input/controls.h"
#include "ship.h"

namespace starbow {

/// Everything that a visitor changes.
struct Flight {
    Ship ship;
    glm::dvec2 look_rad{0}; ///< of the head, to the left and up from the nose
    double faster = 0; ///< rapidity per second now: follows the control smoothly
    bool held_back = false; ///< after a stop no thrust until the control has been let go: stopped means stopped
    glm::dvec3 turn_rad_s{0};
    Effects effects;
    double exposure_ev = 0;
    bool hud = true;
};

/// How a flight feels. Times are the visitor's seconds, which are the ship's.
constexpr double rapidity_per_s = 0.5;
constexpr double turn_rad_per_s = 0.7;
constexpr double ease_s = 0.2; ///< a control's way to a new value
constexpr double exposure_ev_per_s = 2;
constexpr double greatest_rapidity = 14.508657738524219; ///< gamma 1e6

Flight flight_at(const Shot& start);

/// What the visitor does for dt_s seconds. seconds_per_time_unit: of the scene. Speeding up thrusts along the nose; slowing
/// down thrusts against the motion and ends at rest, never beyond.
Flight step(Flight flight, const Controls& controls, double dt_s, double seconds_per_time_unit, const Shot& start);

/// The picture's arguments: the flight's instant as a shot, the head turned.
Shot shot_of(const Flight& flight, const std::string& scene);

} // namespace starbow
