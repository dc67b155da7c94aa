#include "homing.h"
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

} // namespace

Homing homing_from(const Ship& ship)
{
    Homing homing;
    homing.braking = rapidity_of(ship) / braking_s;
    return homing;
}

void fly_home(Ship& ship, Homing& homing, const Shot& start, double dt_s, double seconds_per_time_unit)
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
        homing.rapidity_per_s = distance > 0 ? 2 * greatest_rapidity(distance, way_s / seconds_per_time_unit) / way_s : 0;
        return;
    }
    const double before = homing.elapsed_s;
    homing.elapsed_s += dt_s;
    const glm::dvec3 all = start.position - homing.from.position.total();
    if (homing.rapidity_per_s > 0) {
        const double sign = before < way_s / 2 - dt_s / 2 ? 1 : -1;
        const glm::dvec3 along
            = cockpit_from_ship * glm::normalize(all); // at rest and on a straight line the axes are the world's
        ship = fly(ship, along * (sign * homing.rapidity_per_s * seconds_per_time_unit), glm::dvec3(0), dtau);
    } else {
        ship = fly(ship, glm::dvec3(0), glm::dvec3(0), dtau);
    }
    const double turned = glm::smoothstep(0.0, 1.0, homing.elapsed_s / way_s);
    ship.ship_from_cockpit = glm::normalize(glm::slerp(homing.from.ship_from_cockpit, start.ship_from_cockpit, turned));
    if (homing.elapsed_s >= way_s - dt_s / 2) {
        ship = stopped(ship);
        ship.position = Sum3(start.position);
        ship.ship_from_cockpit = start.ship_from_cockpit;
        homing.arrived = true;
    }
}

} // namespace starbow
