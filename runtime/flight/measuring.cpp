#include "measuring.h"
#include "shaders/physics/physics.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

struct RetardedPosition {
    double distance; ///< distance in the world
    double angle_rad; ///< from the motion, as seen
    double D;
};

RetardedPosition seen(const Ship& ship, const glm::dvec3& at)
{
    const glm::dvec3 u = ship.u.total(), way = at - ship.position.total();
    const double speed = glm::length(u), distance = glm::length(way), E = physics::exp_rapidity(speed);
    if (!(distance > 0))
        return {0, 0, 1};
    const glm::dvec3 n = way / distance, ahead = speed > 0 ? u / speed : glm::dvec3(0, 0, -1);
    const glm::dvec3 in_motion(glm::length(glm::cross(n, ahead)), 0, glm::dot(n, ahead));
    const physics::AberratedRay sight = physics::camera_from_world(in_motion, E, 1 / E);
    return {distance, std::atan2(sight.n.x, sight.n.z), sight.D};
}

double at_place(
    Measure::Quantity quantity, const glm::dvec3& at, const Ship& ship, const Ship& since, double seconds_per_time_unit)
{
    const RetardedPosition now = seen(ship, at);
    switch (quantity) {
    case Measure::Quantity::distance:
        return now.distance;
    case Measure::Quantity::angle_deg:
        return glm::degrees(now.angle_rad);
    case Measure::Quantity::doppler:
        return now.D;
    case Measure::Quantity::size: { // aberration shrinks small things by 1 / D
        const RetardedPosition then = seen(since, at);
        return then.distance * then.D / (now.distance * now.D);
    }
    case Measure::Quantity::now_s: // Lorentz transformation: at one time of the ship, world time is later by v.dx
        return (ship.time.total() + glm::dot(ship.u.total(), at - ship.position.total()) / physics::gamma_of(ship.u.total()))
            * seconds_per_time_unit;
    default: // the retarded time: the place's distance ago
        return (ship.time.total() - now.distance) * seconds_per_time_unit;
    }
}

double undivided(const Measure& measure, const Ship& ship, const Ship& since, double seconds_per_time_unit)
{
    const double speed = glm::length(ship.u.total()), E = physics::exp_rapidity(speed);
    switch (measure.quantity) {
    case Measure::Quantity::gamma:
        return physics::gamma_of(ship.u.total());
    case Measure::Quantity::beta:
        return speed / physics::gamma_of(ship.u.total());
    case Measure::Quantity::rapidity:
        return std::asinh(speed);
    case Measure::Quantity::ship_s:
        return ship.proper_time.total() * seconds_per_time_unit;
    case Measure::Quantity::world_s:
        return ship.time.total() * seconds_per_time_unit;
    case Measure::Quantity::trip_s:
        return (ship.proper_time.total() - since.proper_time.total()) * seconds_per_time_unit;
    case Measure::Quantity::younger_s:
        return (ship.time.total() - since.time.total() - (ship.proper_time.total() - since.proper_time.total()))
            * seconds_per_time_unit;
    case Measure::Quantity::doppler_ahead:
        return E;
    case Measure::Quantity::own_colour_deg:
        return glm::degrees(std::acos(physics::unshifted_cosine(E)));
    default:
        break;
    }
    const double value = at_place(measure.quantity, measure.at, ship, since, seconds_per_time_unit);
    return measure.relative_to ? value - at_place(measure.quantity, *measure.relative_to, ship, since, seconds_per_time_unit)
                               : value;
}

} // namespace

double measured(const Measure& measure, const Ship& ship, const Ship& since, double seconds_per_time_unit)
{
    return undivided(measure, ship, since, seconds_per_time_unit) / measure.over;
}

} // namespace starbow
