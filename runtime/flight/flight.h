#pragma once
#include "config/model/flying.h"
#include "homing.h"
#include "input/controls.h"
#include "ship.h"
#include <array>
#include <cstdint>
#include <optional>

namespace starbow {

/// How often the picture has left its way. Whoever follows the picture compares the counts of two frames.
struct Leaps {
    std::uint32_t begun
        = 0; ///< to a state with an exposure of its own: a start, a tour's cut, the end of a tour's own motion
    std::uint32_t within = 0; ///< within a flight: ten seconds back, a stop at once
    bool operator==(const Leaps&) const = default;
};

/// The state of a visit: everything that a visitor changes.
struct Flight {
    Ship ship;
    FlightMode mode = FlightMode::guided;
    double lever = 0; ///< the throttle's place, from 0 to 1
    bool coasting = false; ///< after a start in flight: straight on at its velocity, until a hand touches the controls
    bool lever_waits = false; ///< after a start in flight: the throttle has no effect until it is moved
    std::optional<double> lever_rest; ///< its place meanwhile, once a throttle has reported
    bool frozen = false; ///< the world stands still, and the stick turns the head
    std::size_t time_scale = 0; ///< slow motion: index into time_rates
    bool thrust_inhibited = false; ///< after a stop the engine gives no thrust until the throttle has been at 0
    double throttle_rate = 0; ///< rapidity per second now, along the way; guided and free
    glm::dvec3 thrust{0}; ///< rapidity per second, cockpit axes; newtonian
    glm::dvec3 turn_rad_s{0}, turn_lead_rad_s{0}; ///< the turn now, and the smoothed turn it approaches
    std::int64_t step_wait = 0; ///< ticks before the stick turns the ship by a step again, where it turns in steps
    double vignette = 0; ///< the part of the rules' vignette that is seen now, 0 to 1
    std::optional<Homing> homing; ///< the flight back to the start, while it lasts
    bool homeward = false; ///< at the world's end the nose turns to the start; the stick does not turn it meanwhile
    glm::dvec2 look_rad{0}; ///< the head's turn to the left and up from the nose
    Effects effects;
    double exposure_ev = 0;
    bool hud = true;
    std::int64_t ticks = 0; ///< flown since the visit began; none while frozen
    std::int64_t left_ns = 0; ///< the visitor's time not flown yet, less than a tick
    Leaps leaps; ///< it never counts backwards
};

/// The length of a step of every flight, so that a slow and a fast computer fly the same.
constexpr std::int64_t tick_ns = 1'000'000;
constexpr double tick_s = 1e-3;

/// Time constants, seconds: of the velocity's turn to the nose, and of the speed's approach to the throttle's.
constexpr double follow_s = 0.5, settle_s = 0.8;
/// The throttle's change per second while a key moves it.
constexpr double lever_per_s = 0.1;
/// The thrust of a pressed key.
constexpr double key_rapidity_per_s = 0.5;
/// Seconds from one step of a turn to the next, where the ship turns in steps.
constexpr double turn_step_every_s = 0.4;
/// A throttle that has moved by so much has been touched: less may be its sensor's noise.
constexpr double lever_touched = 0.02;
constexpr double exposure_ev_per_s = 2;

/// Slow motion: time on board that passes in one of the visitor's seconds, s. Controls act as fast as ever.
inline constexpr std::array time_rates{1.0, 0.25, 0.0625};

/// A start in flight goes on at its velocity until a hand touches the controls.
Flight flight_at(const Shot& start, const Flying& rules = {});

/// The leap from `before` to the beginning of `flight`, which has replaced it.
inline void count_beginning(Flight& flight, const Flight& before)
{
    flight.leaps = before.leaps;
    ++flight.leaps.begun;
}

/// The flight dt_ns nanoseconds later under the visitor's controls. seconds_per_time_unit: of the scene. The result depends
/// only on the controls and on the whole ticks that have passed. So any division of the same time into steps gives the same
/// flight to the bit.
Flight step(Flight flight, const Controls& controls, std::int64_t dt_ns, const Flying& rules, double seconds_per_time_unit,
    const Shot& start);

/// The arguments of the picture: the flight's instant as a shot, with the head turned. Where the rules keep the horizon, the
/// head does so too.
Shot shot_of(const Flight& flight, const std::string& scene, const Comfort& comfort = {});

} // namespace starbow
