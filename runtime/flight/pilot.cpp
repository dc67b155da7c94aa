#include "pilot.h"
#include "comfort.h"
#include "config/model/angles.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

const glm::dvec3 nose(0, 0, -1); ///< cockpit axes

/// The part of the remaining difference that a smoothed value covers in one tick.
double share(double seconds) { return seconds > 0 ? -std::expm1(-tick_s / seconds) : 1; }

/// A thrust that covers a share of the remaining difference in each tick changes fastest at the start, by the difference
/// over the time constant. The largest difference is from end to end.
double gain_share(const Flying& rules) { return share(2 * rules.rapidity_per_s / rules.rapidity_jerk_per_s2); }

/// The time constant T of each stage of a smoothed turn.
double smoothing_s(double greatest, double jerk) { return std::sqrt(2 * greatest / jerk); }

/// A turn is smoothed in two such stages, each of time T, so that its acceleration has no steps. After a step of the
/// stick by w the rate is w (1 - (1 + t/T) exp(-t/T)), whose second derivative is greatest at the start, w / T^2.
void turn(double& rate, double& lead, double wanted, double greatest, double jerk)
{
    const double part = share(smoothing_s(greatest, jerk));
    lead += part * (wanted - lead);
    rate += part * (lead - rate);
}

/// The pitch's wanted rate, within what leads no further than the greatest pitch of a level cockpit. Once the stick is let
/// go, the two stages turn the ship by T (rate + lead) more, and a stick that is held moves that end by its own rate.
double pitch_within(const Flight& flight, double wanted, double greatest, double jerk)
{
    const double part = share(smoothing_s(greatest, jerk)), remaining_s = tick_s * (1 - part) / part,
                 end
        = aim_of(flight.ship.ship_from_cockpit).pitch + remaining_s * (flight.turn_rad_s.x + flight.turn_lead_rad_s.x);
    return std::clamp(
        wanted, std::min(0.0, (-most_pitch_rad - end) / tick_s), std::max(0.0, (most_pitch_rad - end) / tick_s));
}

/// The turn in the tick where the ship turns in steps: pitch, yaw, roll, radians. The way round at a world's end takes a
/// part of a step at its end; a stick takes whole ones.
glm::dvec3 step_by(Flight& flight, const glm::dvec3& turn, const Flying& rules)
{
    flight.step_wait = std::max<std::int64_t>(0, flight.step_wait - 1);
    constexpr double far = 0.5;
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(turn[i]) > std::abs(turn[axis]))
            axis = i;
    if (flight.step_wait > 0 || std::abs(turn[axis]) <= (flight.homeward ? 0 : far))
        return glm::dvec3(0);
    glm::dvec3 step(0);
    step[axis] = rules.comfort.turn_steps_deg * degree
        * (flight.homeward ? std::clamp(turn[axis], -1.0, 1.0) : std::copysign(1.0, turn[axis]));
    constexpr double rounding_rad = 1e-9;
    if (axis == 0 && rules.comfort.level_horizon && !flight.frozen
        && std::abs(aim_of(flight.ship.ship_from_cockpit).pitch + step.x) > most_pitch_rad + rounding_rad)
        return glm::dvec3(0);
    flight.step_wait = std::int64_t(turn_step_every_s / tick_s);
    return step;
}

/// The velocity's direction in the cockpit at the middle of the tick, where its thrust acts; at rest the nose's. turn: in
/// the tick, about the cockpit's axes.
glm::dvec3 heading(const Flight& flight, const glm::dvec3& turn)
{
    const glm::dvec3 u = flight.ship.u.total(), half = 0.5 * turn;
    const double length = glm::length(u), angle = glm::length(half);
    if (!(length > 0))
        return nose;
    const glm::dvec3 way = glm::inverse(flight.ship.ship_from_cockpit) * (u / length);
    return glm::normalize(angle > 0 ? glm::angleAxis(-angle, half / angle) * way : way);
}

/// The unit direction across `way` towards `to`. Where `to` is straight behind, every direction is equally good, and it
/// is up.
glm::dvec3 across(const glm::dvec3& way, const glm::dvec3& to)
{
    glm::dvec3 side = to - way * glm::dot(to, way);
    if (!(glm::length(side) > 1e-9)) {
        const glm::dvec3 up(0, 1, 0), right(1, 0, 0);
        side = std::abs(way.y) < 0.9 ? up - way * way.y : right - way * way.x;
    }
    return glm::normalize(side);
}

/// Guided and free: the ship approaches the rapidity `target`.
Push towards(double target, Flight& flight, const glm::dvec3& turn, const Flying& rules, const SpeedLimits& limits)
{
    const double speed = rapidity_of(flight.ship);
    // A greatest rapidity that falls must be followed more closely than a hand.
    constexpr double closely_s = 0.25;
    const double gain_to_target = std::min((target - speed) / settle_s, (limits.rapidity - speed) / closely_s),
                 wanted = std::clamp(gain_to_target, -rules.rapidity_per_s, std::min(rules.rapidity_per_s, limits.gain));
    flight.throttle_rate += gain_share(rules) * (wanted - flight.throttle_rate);
    const double gain = flight.throttle_rate * tick_s;
    Push push{.turn = turn};
    if (std::min(target, limits.rapidity) == 0
        && speed + gain < 2e-3) { // slower than anyone can see; the approach would never end
        flight.throttle_rate = 0;
        push.stop = speed > 0;
        return push;
    }
    const glm::dvec3 way = heading(flight, turn);
    push.rapidity = std::max(gain, -speed) * way;
    if (flight.mode == FlightMode::guided) {
        // A thrust across the flight turns the things ahead, as seen from the ship, by v/c. It also adds a speed of
        // second order, cosh w' = cosh(thrust) cosh w, which is subtracted again.
        const double angle = std::atan2(glm::length(glm::cross(way, nose)), glm::dot(way, nose));
        const double turned = share(follow_s) * angle;
        push.rapidity += (across(way, nose) * turned - way * (0.5 * turned * turned)) * std::tanh(speed);
    }
    return push;
}

/// The throttle's place sets the speed.
Push by_lever(Flight& flight, const glm::dvec3& turn, const Flying& rules, const SpeedLimits& limits)
{
    return towards(flight.thrust_inhibited ? 0 : flight.lever * std::acosh(rules.max_gamma), flight, turn, rules, limits);
}

/// The keys' lever after a tick. It is no further ahead of the speed than the pilot's delay needs, so that the ship gains
/// hardly any speed after the key is let go.
double moved_lever(const Flight& flight, double rate, const Flying& rules, const SpeedLimits& limits)
{
    const double most = (rapidity_of(flight.ship) + settle_s * limits.gain) / std::acosh(rules.max_gamma);
    const double moved = std::min(flight.lever + rate * lever_per_s * tick_s, std::max(flight.lever, most));
    return std::clamp(moved, 0.0, 1.0);
}

/// Newtonian: the throttle sets the thrust.
Push by_thrust(Flight& flight, const glm::dvec3& turn, const Steering& controls, const Flying& rules)
{
    const double engine = controls.lever ? *controls.lever * rules.rapidity_per_s : 0;
    glm::dvec3 wanted = (nose * controls.throttle_rate + controls.push) * key_rapidity_per_s + nose * engine;
    wanted *= std::min(1.0, rules.rapidity_per_s / std::max(glm::length(wanted), 1e-30)); // a limit that spares stomachs
    if (flight.thrust_inhibited)
        wanted = glm::dvec3(0);
    flight.thrust += gain_share(rules) * (wanted - flight.thrust);
    if (wanted == glm::dvec3(0) && glm::length(flight.thrust) < 1e-4)
        flight.thrust = glm::dvec3(0);
    Push push{flight.thrust * tick_s, turn};
    // At the limit the speed does not grow; the velocity still turns, and the gain of speed from turning is subtracted.
    const glm::dvec3 way = heading(flight, turn);
    const double room = std::acosh(rules.max_gamma) - rapidity_of(flight.ship);
    push.rapidity -= way * std::max(0.0, glm::dot(push.rapidity, way) - room);
    return push;
}

/// Ends the flight's coasting when a hand touches the controls, and leaves out a throttle that no hand has moved.
void watch_hands(Flight& flight, Steering& controls)
{
    if (flight.lever_waits && controls.lever) {
        if (!flight.lever_rest)
            flight.lever_rest = controls.lever;
        flight.lever_waits = std::abs(*controls.lever - *flight.lever_rest) <= lever_touched;
        if (flight.lever_waits)
            controls.lever.reset();
    }
    const glm::dvec3 none(0);
    if (controls.lever || controls.throttle_rate != 0 || controls.push != none || controls.turn != none)
        flight.coasting = false;
}

/// The guide has the stick: the thrust fades as after a hand that lets go, and the ship keeps its speed. Afterwards the
/// throttle has no effect until it is moved.
Push let_coast(Flight& flight, const glm::dvec3& turn, const Flying& rules, const SpeedLimits& limits)
{
    flight.lever_waits = true;
    flight.lever_rest.reset();
    if (flight.coasting)
        return {.turn = turn};
    if (flight.mode == FlightMode::newtonian)
        return by_thrust(flight, turn, {}, rules);
    const double speed = rapidity_of(flight.ship);
    flight.lever = std::min(1.0, speed / std::acosh(rules.max_gamma));
    return towards(speed, flight, turn, rules, limits);
}

} // namespace

glm::dvec3 steer(Flight& flight, const Steering& controls, const Flying& rules)
{
    if (rules.comfort.turn_steps_deg > 0)
        return step_by(flight, controls.turn, rules);
    const glm::dvec3 rates = degree * glm::dvec3(rules.turn_deg_per_s, rules.turn_deg_per_s, rules.roll_deg_per_s);
    const double jerk = degree * rules.turn_jerk_deg_per_s3;
    for (int i = 0; i < 3; ++i) {
        double wanted = std::clamp(controls.turn[i], -1.0, 1.0) * rates[i];
        if (i == 0 && rules.comfort.level_horizon && !flight.frozen)
            wanted = pitch_within(flight, wanted, rates[i], jerk);
        turn(flight.turn_rad_s[i], flight.turn_lead_rad_s[i], wanted, rates[i], jerk);
    }
    return tick_s * flight.turn_rad_s;
}

Push pilot(Flight& flight, const Steering& input, const Flying& rules, const SpeedLimits& limits)
{
    Steering controls = input;
    if (!input.taken)
        watch_hands(flight, controls);
    const glm::dvec3 turn = about_cockpit(steer(flight, controls, rules), flight.ship.ship_from_cockpit, rules.comfort);
    if (input.taken)
        return let_coast(flight, turn, rules, limits);
    if (flight.coasting)
        return {.turn = turn};
    // Visitors with thrusters alone, as on a space mouse, set the speed too.
    if (flight.mode != FlightMode::newtonian)
        controls.throttle_rate -= input.push.z;
    if (controls.lever)
        flight.lever = std::clamp(*controls.lever, 0.0, 1.0);
    else if (flight.mode != FlightMode::newtonian)
        flight.lever = moved_lever(flight, controls.throttle_rate, rules, limits);
    const bool let_go = flight.mode == FlightMode::newtonian
        ? controls.throttle_rate == 0 && controls.push == glm::dvec3(0) && controls.lever.value_or(0) < 0.02
        : (controls.lever ? flight.lever < 0.02 : controls.throttle_rate <= 0);
    flight.thrust_inhibited = flight.thrust_inhibited && !let_go;
    if (flight.thrust_inhibited && !controls.lever)
        flight.lever = 0;
    return flight.mode == FlightMode::newtonian ? by_thrust(flight, turn, controls, rules)
                                                : by_lever(flight, turn, rules, limits);
}

FeltMotion felt_motion(Flight flight, const Steering& controls, const Flying& rules, const SpeedLimits& limits)
{
    const glm::dvec3 turn = flight.turn_rad_s;
    const Push push = pilot(flight, controls, rules, limits);
    return {push.rapidity / tick_s, turn, (flight.turn_rad_s - turn) / tick_s};
}

} // namespace starbow
