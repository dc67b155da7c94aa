#include "homing.h"
#include "comfort.h"
#include "config/model/angles.h"
#include "flight.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// Whole ticks, at most a month.
std::int64_t ticks_in(double seconds) { return std::int64_t(std::ceil(std::min(2.6e6, seconds) / tick_s - 1e-9)); }

/// The duration of a change of rapidity by a smoothstep. Its gain is greatest in the middle, 3/2 of the mean; that gain
/// changes fastest at the ends, by 6 of the change over the square of the duration.
double change_s(double rapidity, double least_s, const Flying& rules)
{
    return std::max({least_s, 1.5 * rapidity / rules.rapidity_per_s, std::sqrt(6 * rapidity / rules.rapidity_jerk_per_s2)});
}

/// The turn's rates go to 0 by the cubic that has the given value and slope at the beginning, and neither at the end. Its
/// second derivative is greatest at the beginning, (6 rate + 4 gain T) / T^2; the duration T follows from that.
double settling_s(const FeltMotion& motion, const Flying& rules)
{
    const double jerk = degree * rules.turn_jerk_deg_per_s3, rate = glm::length(motion.turn_rad_s),
                 gain = glm::length(motion.turn_gain_rad_s2);
    return std::max(glm::length(motion.thrust) / rules.rapidity_jerk_per_s2,
        (2 * gain + std::sqrt(4 * gain * gain + 6 * jerk * rate)) / jerk);
}

/// The rapidity of the way after t seconds, for a greatest gain of 1. The gain grows for ramp_s, stays, falls for twice
/// ramp_s through 0 in the middle, stays, and vanishes in ramp_s: its change is never faster than gain / ramp_s.
double rapidity_at(double t, double way_s, double ramp_s)
{
    t = std::min(t, way_s - t);
    const double before_middle = way_s / 2 - t;
    if (t < ramp_s)
        return t * t / (2 * ramp_s);
    if (before_middle > ramp_s)
        return t - ramp_s / 2;
    return way_s / 2 - ramp_s - before_middle * before_middle / (2 * ramp_s);
}

struct WayShape {
    double way_s, ramp_s;
};

/// The length of the way for a greatest gain, in seconds of light. The thrust is constant in each of so many equal parts of
/// its first half, as it is in each tick; the second half is as long.
double length_s(const WayShape& shape, double gain, std::int64_t parts)
{
    const double dt = shape.way_s / 2 / double(parts);
    double sum = 0, before = 0;
    for (std::int64_t i = 1; i <= parts; ++i) {
        const double rapidity = gain * rapidity_at(double(i) * dt, shape.way_s, shape.ramp_s),
                     half = 0.5 * (rapidity - before);
        sum += std::sinh(before + half) * (half > 0 ? std::sinh(half) / half : 1);
        before = rapidity;
    }
    return 2 * sum * dt;
}

constexpr std::int64_t coarse_parts = 400;

/// The greatest x below `high` with grows(x) <= value.
template <class Function> double last_below(double high, double value, const Function& grows)
{
    double low = 0;
    while (grows(high) < value)
        high *= 2;
    for (int i = 0; i < 60; ++i) {
        const double x = 0.5 * (low + high);
        (grows(x) < value ? low : high) = x;
    }
    return 0.5 * (low + high);
}

/// The size of the way's turn, radians.
double turned_on_way(const glm::dquat& from, const glm::dquat& to, const Comfort& comfort)
{
    return comfort.level_horizon ? glm::length(turns_between(aim_of(from), aim_of(to)))
                                 : 2 * std::acos(std::min(1.0, std::abs(glm::dot(from, to))));
}

/// The number of the way's steps, where the ship turns in steps.
double steps_on_way(double turned, const Comfort& comfort)
{
    constexpr double rounding = 1e-9;
    return std::ceil(turned / (degree * comfort.turn_steps_deg) - rounding);
}

/// The cockpit after a part of the way. Without steps it follows the polynomial of fifth order.
glm::dquat turned_by(double part, const glm::dquat& from, const glm::dquat& to, const Comfort& comfort)
{
    double x = part * part * part * (10 + part * (6 * part - 15));
    if (comfort.turn_steps_deg > 0) {
        const double steps = steps_on_way(turned_on_way(from, to, comfort), comfort);
        x = steps > 0 ? std::min(1.0, std::floor(part * (steps + 1)) / steps) : 0;
    }
    if (!comfort.level_horizon)
        return glm::normalize(glm::slerp(from, to, x));
    const Aim aim = aim_of(from);
    const glm::dvec2 turns = turns_between(aim, aim_of(to));
    return level_cockpit({aim.heading + x * turns.y, aim.pitch + x * turns.x});
}

/// Plans the way from rest. A turn takes the thrust along in the cockpit, which changes it too: the turn and the thrust
/// share the limit of its change.
void plan_way(Homing& homing, const Shot& start, const Flying& rules, double seconds_per_time_unit)
{
    const double distance_s = seconds_per_time_unit * glm::distance(start.position, homing.from.position.total()),
                 most = rules.rapidity_per_s, jerk = rules.rapidity_jerk_per_s2,
                 turn_rad_s = std::min(degree * std::max(rules.turn_deg_per_s, 1.0), 0.5 * jerk / most),
                 ramp_s = most / (jerk - most * turn_rad_s);
    const auto shape = [&](double way_s) { return WayShape{way_s, std::min(ramp_s, way_s / 4)}; };
    const double fastest_s = last_below(least_way_s, distance_s, [&](double way_s) {
        const WayShape one = shape(way_s);
        return length_s(one, most * one.ramp_s / ramp_s, coarse_parts);
    });
    // The polynomial of fifth order without speed and acceleration at its ends: 15/8 of the mean rate in the middle, and a
    // jerk of 60 at the ends.
    const double turned = turned_on_way(homing.from.ship_from_cockpit, start.ship_from_cockpit, rules.comfort);
    const double turn_s = rules.comfort.turn_steps_deg > 0
        ? turn_step_every_s * (steps_on_way(turned, rules.comfort) + 1)
        : std::max(1.875 * turned / turn_rad_s, std::cbrt(60 * turned / (degree * rules.turn_jerk_deg_per_s3)));
    // The number of ticks is even: the ship gains speed in half of them, loses it in the others, and arrives at rest.
    const std::int64_t half = ticks_in(std::max({least_way_s, fastest_s, turn_s}) / 2);
    homing.ticks = 2 * half;
    const WayShape way = shape(double(homing.ticks) * tick_s);
    homing.ramp_s = way.ramp_s;
    // In ticks the same gain flies a slightly different length than in coarse parts. Three times the error is enough.
    for (double wanted = distance_s, i = 0; i < 3 && distance_s > 0; ++i) {
        homing.gain = last_below(most, wanted, [&](double gain) { return length_s(way, gain, coarse_parts); });
        wanted *= distance_s / length_s(way, homing.gain, half);
    }
}

void begin(Homing& homing, HomingLeg leg, const Ship& ship, std::int64_t ticks)
{
    homing.leg = leg, homing.from = ship, homing.elapsed = 0, homing.ticks = ticks;
}

double part_of(const Homing& homing) { return double(homing.elapsed) / double(homing.ticks); }

void settle(Ship& ship, const Homing& homing, const Flying& rules, double dtau)
{
    const double x = part_of(homing), all_s = double(homing.ticks) * tick_s;
    const FeltMotion& at_first = homing.settling;
    const glm::dvec3 turn
        = at_first.turn_rad_s * (1 + x * x * (2 * x - 3)) + at_first.turn_gain_rad_s2 * (all_s * x * (1 - x) * (1 - x));
    const double left = 1 - double(homing.elapsed - 1) / double(homing.ticks); // the first tick has the whole thrust
    ship = fly(ship, at_first.thrust * (left * tick_s / dtau),
        about_cockpit(turn * tick_s, ship.ship_from_cockpit, rules.comfort), dtau);
}

void brake(Ship& ship, const Homing& homing, double dtau)
{
    const double wanted = rapidity_of(homing.from) * glm::smoothstep(0.0, 1.0, 1 - part_of(homing)),
                 loss = rapidity_of(ship) - wanted;
    const glm::dvec3 way = glm::inverse(ship.ship_from_cockpit) * glm::normalize(ship.u.total());
    ship = fly(ship, -way * (loss / dtau), glm::dvec3(0), dtau);
}

void fly_way(Ship& ship, const Homing& homing, const Shot& start, const Flying& rules, double dtau)
{
    const double way_s = double(homing.ticks) * tick_s, x = part_of(homing),
                 gained = homing.gain
        * (rapidity_at(double(homing.elapsed) * tick_s, way_s, homing.ramp_s)
            - rapidity_at(double(homing.elapsed - 1) * tick_s, way_s, homing.ramp_s));
    // At rest and on a straight line the axes are the world's.
    const glm::dvec3 all = start.position - homing.from.position.total(),
                     along = homing.gain > 0 ? glm::inverse(ship.ship_from_cockpit) * glm::normalize(all) : glm::dvec3(0);
    ship = fly(ship, along * (gained / dtau), glm::dvec3(0), dtau);
    ship.ship_from_cockpit = turned_by(x, homing.from.ship_from_cockpit, start.ship_from_cockpit, rules.comfort);
}

/// The world stands still while the velocity grows to the start's.
void launch(Ship& ship, Homing& homing, const Shot& start)
{
    const double size = glm::length(start.u);
    ship = ship_at(start);
    homing.arrived = homing.elapsed >= homing.ticks;
    if (!homing.arrived)
        ship.u = Sum3(start.u * (std::sinh(std::asinh(size) * glm::smoothstep(0.0, 1.0, part_of(homing))) / size));
}

} // namespace

Homing homing_from(const Ship& ship, const FeltMotion& motion, const Flying& rules)
{
    Homing homing{.settling = motion};
    begin(homing, HomingLeg::settling, ship, ticks_in(settling_s(motion, rules)));
    return homing;
}

void fly_home(Ship& ship, Homing& homing, const Shot& start, const Flying& rules, double seconds_per_time_unit)
{
    if (homing.leg == HomingLeg::settling && homing.elapsed >= homing.ticks) {
        const double speed = rapidity_of(ship);
        begin(homing, HomingLeg::braking, ship, speed > 0 ? ticks_in(change_s(speed, least_braking_s, rules)) : 0);
    }
    if (homing.leg == HomingLeg::braking && homing.elapsed >= homing.ticks) {
        begin(homing, HomingLeg::way, stopped(ship), 0);
        plan_way(homing, start, rules, seconds_per_time_unit);
        ship = homing.from;
    }
    const double dtau = tick_s / seconds_per_time_unit;
    ++homing.elapsed;
    switch (homing.leg) {
    case HomingLeg::settling:
        settle(ship, homing, rules, dtau);
        return;
    case HomingLeg::braking:
        brake(ship, homing, dtau);
        return;
    case HomingLeg::way:
        fly_way(ship, homing, start, rules, dtau);
        if (homing.elapsed < homing.ticks)
            return;
        ship = stopped(ship_at(start));
        homing.arrived = start.u == glm::dvec3(0);
        begin(homing, HomingLeg::launch, ship, ticks_in(change_s(std::asinh(glm::length(start.u)), least_launch_s, rules)));
        return;
    case HomingLeg::launch:
        launch(ship, homing, start);
        return;
    }
}

} // namespace starbow
