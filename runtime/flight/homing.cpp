#include "homing.h"
#include "config/model/angles.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// Greatest rapidity w of a straight way of `distance` in the proper time `tau`, half of it speeding up, half slowing down.
/// From distance = tau (cosh w - 1) / w; the right side grows with w.
double greatest_rapidity(double distance, double tau)
{
    double low = 0, high = 700;
    for (int i = 0; i < 200; ++i) {
        const double w = 0.5 * (low + high);
        // (cosh w - 1) / w without cancellation
        (2 * std::sinh(w / 2) * std::sinh(w / 2) / w * tau < distance ? low : high) = w;
    }
    return 0.5 * (low + high);
}

/// The duration of the way from rest: no faster gain of speed and no faster turn than the rules allow. A smoothstep is
/// steepest in its middle, by 3/2.
double duration_s(const Ship& from, const Shot& start, const Flying& rules, double distance, double seconds_per_time_unit)
{
    const double a = rules.rapidity_per_s,
                 turned = std::min(1.0, std::abs(glm::dot(from.ship_from_cockpit, start.ship_from_cockpit)));
    return std::max({least_way_s, 2 * std::acosh(1 + 0.5 * a * seconds_per_time_unit * distance) / a,
        1.5 * 2 * std::acos(turned) / (degree * std::max(rules.turn_deg_per_s, 1.0))});
}

/// The world stands still while the velocity grows to the start's.
void launch(Ship& ship, Homing& homing, const Shot& start, double dt_s)
{
    const double part = (homing.elapsed_s - homing.way_s) / homing.launch_s, size = glm::length(start.u);
    ship = ship_at(start);
    homing.arrived = part >= 1 - dt_s / 2;
    if (!homing.arrived)
        ship.u = Sum3(start.u * (std::sinh(std::asinh(size) * glm::smoothstep(0.0, 1.0, part)) / size));
}

} // namespace

Homing homing_from(const Ship& ship, const Shot& start, const Flying& rules)
{
    Homing homing;
    homing.braking = std::min(rapidity_of(ship) / least_braking_s, rules.rapidity_per_s);
    homing.launch_s = std::max(least_launch_s, 1.5 * std::asinh(glm::length(start.u)) / rules.rapidity_per_s);
    return homing;
}

void fly_home(Ship& ship, Homing& homing, const Shot& start, const Flying& rules, double dt_s, double seconds_per_time_unit)
{
    const double dtau = dt_s / seconds_per_time_unit;
    const glm::dquat cockpit_from_ship = glm::inverse(ship.ship_from_cockpit);
    if (homing.elapsed_s < 0) {
        const double speed = rapidity_of(ship), loss = homing.braking * dt_s;
        if (speed > loss) {
            const glm::dvec3 way = cockpit_from_ship * glm::normalize(ship.u.total());
            ship = fly(ship, -way * (loss / dtau), glm::dvec3(0), dtau);
            return;
        }
        ship = stopped(ship);
        homing.elapsed_s = 0;
        homing.from = ship;
        const double distance = glm::distance(start.position, ship.position.total());
        // The number of ticks is even: the ship gains speed in half of them, loses it in the others, and arrives at rest.
        homing.way_s
            = 2 * dt_s * std::ceil(duration_s(ship, start, rules, distance, seconds_per_time_unit) / (2 * dt_s) - 1e-9);
        homing.rapidity_per_s
            = distance > 0 ? 2 * greatest_rapidity(distance, homing.way_s / seconds_per_time_unit) / homing.way_s : 0;
        return;
    }
    const double before = homing.elapsed_s;
    homing.elapsed_s += dt_s;
    if (before >= homing.way_s - dt_s / 2) {
        launch(ship, homing, start, dt_s);
        return;
    }
    const glm::dvec3 all = start.position - homing.from.position.total();
    if (homing.rapidity_per_s > 0) {
        const double sign = before < homing.way_s / 2 - dt_s / 2 ? 1 : -1;
        const glm::dvec3 along
            = cockpit_from_ship * glm::normalize(all); // at rest and on a straight line the axes are the world's
        ship = fly(ship, along * (sign * homing.rapidity_per_s * seconds_per_time_unit), glm::dvec3(0), dtau);
    } else {
        ship = fly(ship, glm::dvec3(0), glm::dvec3(0), dtau);
    }
    const double turned = glm::smoothstep(0.0, 1.0, homing.elapsed_s / homing.way_s);
    ship.ship_from_cockpit = glm::normalize(glm::slerp(homing.from.ship_from_cockpit, start.ship_from_cockpit, turned));
    if (homing.elapsed_s >= homing.way_s - dt_s / 2) {
        ship = stopped(ship_at(start));
        homing.arrived = start.u == glm::dvec3(0);
    }
}

} // namespace starbow
