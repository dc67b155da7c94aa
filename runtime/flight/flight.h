#pragma once
#include "config/model/flying.h"
#include "homing.h"
#include "input/controls.h"
#include "ship.h"
#include <cstdint>
#include <optional>

namespace starbow {

/// Everything that a visitor changes.
struct Flight {
    Ship ship;
    FlightMode mode = FlightMode::guided;
    double lever = 0; ///< where the throttle is, from 0 to 1
    bool thrust_inhibited = false; ///< after a stop no thrust until the throttle has been at 0: stopped means stopped
    double throttle_rate = 0; ///< rapidity per second now, along the way; guided and free
    glm::dvec3 thrust{0}; ///< rapidity per second now, cockpit axes; newtonian
    glm::dvec3 turn_rad_s{0}, turn_lead_rad_s{0}; ///< now, and what that is on its way to
    std::optional<Homing> homing; ///< flying back to the start by itself
    glm::dvec2 look_rad{0}; ///< of the head, to the left and up from the nose
    Effects effects;
    double exposure_ev = 0;
    bool hud = true;
    std::int64_t ticks = 0; ///< flown since the visit began
    std::int64_t left_ns = 0; ///< of the visitor's time, less than a tick
};

/// All flights go in steps of this length, so that a slow and a fast computer fly the same.
constexpr std::int64_t tick_ns = 1'000'000;
constexpr double tick_s = 1e-3;

/// Seconds in which the velocity turns most of the way to the nose, and the speed most of the way to the throttle's.
constexpr double follow_s = 0.5, settle_s = 0.8;
/// Of the throttle per second while a key moves it.
constexpr double lever_per_s = 0.1;
/// Of a thrust that a key asks for.
constexpr double key_rapidity_per_s = 0.5;
constexpr double exposure_ev_per_s = 2;

Flight flight_at(const Shot& start, const Flying& rules = {});

/// What the visitor does for dt_ns nanoseconds. seconds_per_time_unit: of the scene. Depends on the controls and on the
/// whole ticks that have passed alone: any cutting of the same time into steps gives the same flight to the bit.
Flight step(Flight flight, const Controls& controls, std::int64_t dt_ns, const Flying& rules, double seconds_per_time_unit,
    const Shot& start);

/// The picture's arguments: the flight's instant as a shot, the head turned.
Shot shot_of(const Flight& flight, const std::string& scene);

} // namespace starbow
