#include "flight.h"
#include "boundary.h"
#include "comfort.h"
#include "pace.h"
#include "pilot.h"
#include "solids.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace starbow {
namespace {

constexpr double half_pi = 1.57079632679489662;

/// The visitor's seconds in a time unit on board.
double shown_unit_s(const Flight& flight, double seconds_per_time_unit)
{
    return seconds_per_time_unit / time_rates[flight.time_scale];
}

SpeedLimits limits_of(const Flight& flight, const Flying& rules, double seconds_per_time_unit)
{
    const double unit_s = shown_unit_s(flight, seconds_per_time_unit);
    SpeedLimits limits;
    if (rules.boundary)
        limits.rapidity = rapidity_within(*rules.boundary, flight.ship, rules, unit_s);
    limits.rapidity = std::min(limits.rapidity, rapidity_above(rules.solids, flight.ship, rules, unit_s));
    if (rules.pace)
        limits.gain = paced_gain(*rules.pace, flight.ship, unit_s);
    return limits;
}

/// Leaves no thrust. inhibits: the throttle has no effect before it was at 0.
void drop_thrust(Flight& flight, const Controls& controls, bool inhibits)
{
    flight.throttle_rate = 0;
    flight.thrust = glm::dvec3(0);
    flight.thrust_inhibited = flight.thrust_inhibited || inhibits;
    if (flight.thrust_inhibited && !controls.lever) // the keys' own lever must not keep its old place
        flight.lever = 0;
}

/// Applies presses, which count once however long the step is.
void press(Flight& flight, const Controls& controls, const Flying& rules, double seconds_per_time_unit, const Shot& start)
{
    if (controls[Switch::reset]) {
        const Flight before = flight;
        flight = flight_at(start, rules);
        flight.hud = before.hud, flight.mode = before.mode;
        flight.ticks = before.ticks, flight.left_ns = before.left_ns;
        count_beginning(flight, before);
        return;
    }
    for (const EffectEntry& one : all_effects)
        if (controls[one.pressed])
            flight.effects.on.flip(one.which);
    if (controls[Switch::comparison])
        flight.effects.comparison = after(flight.effects.comparison);
    flight.hud ^= controls[Switch::hud];
    flight.look_rad = controls[Switch::look_ahead] ? glm::dvec2(0) : flight.look_rad + controls.look_rad;
    flight.look_rad.y = std::clamp(flight.look_rad.y, -half_pi, half_pi);
    flight.frozen ^= controls[Switch::freeze];
    if (controls[Switch::slow_motion])
        flight.time_scale = (flight.time_scale + 1) % time_rates.size();
    if (controls[Switch::next_mode])
        flight.mode = FlightMode((int(flight.mode) + 1) % 3);
    if (controls[Switch::stop]) {
        flight.leaps.within += rapidity_of(flight.ship) > 0;
        flight.ship = stopped(flight.ship);
        flight.homing.reset();
    }
    if (controls[Switch::home] && !flight.homing) { // one press is enough: the way goes on
        FeltMotion motion = felt_motion(flight, controls, rules, limits_of(flight, rules, seconds_per_time_unit));
        if (controls[Switch::stop])
            motion.thrust = glm::dvec3(0);
        flight.homing = homing_from(flight.ship, motion, rules);
        flight.frozen = flight.homeward = false;
    }
    if (controls[Switch::stop] || controls[Switch::home])
        flight.coasting = flight.lever_waits = false;
    if (controls[Switch::stop] || controls[Switch::home] || controls[Switch::next_mode])
        drop_thrust(flight, controls, !controls[Switch::next_mode]);
}

/// Keeps a flight's velocity until a hand touches the controls.
void begin_coasting(Flight& flight, const Flying& rules)
{
    flight.lever = std::min(1.0, rapidity_of(flight.ship) / std::acosh(rules.max_gamma));
    flight.coasting = flight.lever_waits = rapidity_of(flight.ship) > 0;
    flight.lever_rest.reset();
}

/// Returns the turn that is felt in the tick, radians.
double fly_tick(
    Flight& flight, const Controls& controls, const Flying& rules, double seconds_per_time_unit, const Shot& start)
{
    flight.exposure_ev = std::clamp(flight.exposure_ev + controls.exposure * exposure_ev_per_s * tick_s, -60.0, 60.0);
    if (flight.frozen) {
        glm::dvec3 all = controls.turn;
        if (rules.comfort.turn_steps_deg > 0)
            all.z = 0; // a head that looks around does not roll
        const glm::dvec3 turn = steer(flight, Steering{.turn = all}, rules);
        flight.look_rad += glm::dvec2(turn.y, turn.x);
        flight.look_rad.y = std::clamp(flight.look_rad.y, -half_pi, half_pi);
        return glm::length(turn);
    }
    ++flight.ticks;
    if (flight.homing) {
        const glm::dquat before = flight.ship.ship_from_cockpit;
        fly_home(flight.ship, *flight.homing, start, rules, seconds_per_time_unit);
        flight.turn_rad_s = flight.turn_lead_rad_s = glm::dvec3(0);
        if (flight.homing->arrived) {
            flight.homing.reset();
            if (rapidity_of(flight.ship) > 0) {
                begin_coasting(flight, rules);
                flight.thrust_inhibited = false;
            }
        }
        const glm::dquat turn = glm::conjugate(before) * flight.ship.ship_from_cockpit;
        return 2 * glm::length(glm::dvec3(turn.x, turn.y, turn.z));
    }
    const SpeedLimits limits = limits_of(flight, rules, seconds_per_time_unit);
    const bool leaving = rules.boundary && leaves(*rules.boundary, flight.ship);
    if (leaving)
        flight.coasting = flight.lever_waits = false;
    if (leaving && flight.mode != FlightMode::guided) { // a turn of the nose would not turn the flight
        flight.homing = homing_from(flight.ship, felt_motion(flight, controls, rules, limits), rules);
        flight.homing->from_boundary = true;
        drop_thrust(flight, controls, true);
        return 0;
    }
    Steering steering = controls;
    flight.homeward = (flight.homeward || leaving) && flight.mode == FlightMode::guided;
    if (flight.homeward) {
        const std::optional<glm::dvec3> turn = turn_towards(start.position, flight.ship, rules);
        flight.homeward = turn.has_value();
        steering.turn = turn.value_or(steering.turn);
    }
    const Push push = pilot(flight, steering, rules, limits);
    if (push.stop)
        flight.ship = stopped(flight.ship);
    const double dtau = tick_s / shown_unit_s(flight, seconds_per_time_unit);
    const glm::dvec3 before = flight.ship.position.total();
    flight.ship = kept_outside(rules.solids, before, fly(flight.ship, push.rapidity / dtau, push.turn, dtau));
    return glm::length(push.turn);
}

void tick(Flight& flight, const Controls& controls, const Flying& rules, double seconds_per_time_unit, const Shot& start)
{
    const double turned_rad = fly_tick(flight, controls, rules, seconds_per_time_unit, start);
    glm::dquat& cockpit = flight.ship.ship_from_cockpit;
    if (rules.comfort.level_horizon)
        cockpit = levelled(cockpit);
    flight.vignette = vignette_after(flight.vignette, turned_rad, rules);
}

} // namespace

Flight flight_at(const Shot& start, const Flying& rules)
{
    Flight flight;
    flight.ship = ship_at(start);
    if (rules.comfort.level_horizon)
        flight.ship.ship_from_cockpit = levelled(flight.ship.ship_from_cockpit);
    flight.mode = rules.mode;
    begin_coasting(flight, rules);
    flight.effects = start.effects;
    flight.exposure_ev = start.exposure_ev;
    return flight;
}

Flight step(Flight flight, const Controls& given, std::int64_t dt_ns, const Flying& rules, double seconds_per_time_unit,
    const Shot& given_start)
{
    const Comfort& comfort = rules.comfort;
    Controls controls = given;
    if (comfort.no_roll || comfort.level_horizon)
        controls.turn.z = 0;
    Shot start = given_start;
    if (comfort.level_horizon) // the way home leads to a level cockpit, too
        start.ship_from_cockpit = levelled(start.ship_from_cockpit);
    press(flight, controls, rules, seconds_per_time_unit, start);
    for (flight.left_ns += dt_ns; flight.left_ns >= tick_ns; flight.left_ns -= tick_ns)
        tick(flight, controls, rules, seconds_per_time_unit, start);
    return flight;
}

Shot shot_of(const Flight& flight, const std::string& scene, const Comfort& comfort)
{
    Shot shot = shot_of(flight.ship);
    shot.scene = scene;
    shot.effects = flight.effects;
    shot.exposure_ev = flight.exposure_ev;
    const glm::dquat& cockpit = flight.ship.ship_from_cockpit;
    if (comfort.level_horizon) {
        const Aim aim = aim_of(cockpit);
        shot.ship_from_cockpit
            = level_cockpit({aim.heading + flight.look_rad.x, std::clamp(aim.pitch + flight.look_rad.y, -half_pi, half_pi)});
    } else {
        shot.ship_from_cockpit = cockpit * glm::angleAxis(flight.look_rad.x, glm::dvec3(0, 1, 0))
            * glm::angleAxis(flight.look_rad.y, glm::dvec3(1, 0, 0));
    }
    return shot;
}

} // namespace starbow
