#include "ship.h"

#include "shaders/physics/physics.h"

#include <cmath>

namespace starbow {
namespace {

glm::dquat quaternion_of(const glm::dvec3& rotation_vector_rad)
{
    const double half = 0.5 * glm::length(rotation_vector_rad);
    const glm::dvec3 v = rotation_vector_rad * (half > 0 ? 0.5 * std::sin(half) / half : 0.5);
    return {std::cos(half), v.x, v.y, v.z};
}

// turn * q as q plus a small change, so that q keeps every bit on a straight flight. Accumulated rounding would turn the
// thrust aside, and a flight back to rest from gamma multiplies sideways errors by gamma.
glm::dquat carried(const glm::dvec4& turn, const glm::dquat& q)
{
    const glm::dvec3 v(turn);
    return q + glm::dquat(-glm::dot(v, v) / (1 + turn.w), v.x, v.y, v.z) * q; // turn.w - 1 without cancellation
}

// Normalised only when needed, for the same reason.
glm::dquat nearly_unit(const glm::dquat& q) { return std::abs(glm::dot(q, q) - 1) > 1e-15 ? glm::normalize(q) : q; }

} // namespace

void Sum::add(double x)
{
    const double sum = value + x;
    carry += std::abs(value) >= std::abs(x) ? (value - sum) + x : (x - sum) + value;
    value = sum;
}

void Sum3::add(const glm::dvec3& v)
{
    x.add(v.x);
    y.add(v.y);
    z.add(v.z);
}

Ship ship_at(const Shot& shot)
{
    Ship ship;
    ship.position = Sum3(shot.position);
    ship.time.value = shot.time;
    ship.u = Sum3(shot.u);
    ship.ship_from_cockpit = shot.ship_from_cockpit;
    return ship;
}

Shot shot_of(const Ship& ship)
{
    Shot shot;
    shot.position = ship.position.total();
    shot.time = ship.time.total();
    shot.u = ship.u.total();
    shot.ship_from_cockpit = ship.ship_from_cockpit;
    return shot;
}

double rapidity_of(const Ship& ship) { return std::asinh(glm::length(ship.u.total())); }

Ship fly(Ship ship, const glm::dvec3& acceleration, const glm::dvec3& turn, double dtau)
{
    // The thrust has the step's mean direction: half of the turn before it and half after it leave no first-order error.
    const glm::dquat half_turn = quaternion_of(0.5 * turn);
    const glm::dquat ship_from_thruster = ship.ship_from_cockpit * half_turn;

    // A thrust whose square underflows has no direction and no effect.
    const double length = glm::length(acceleration), strength = length > 1e-100 ? length : 0;
    const glm::dvec3 way = strength > 0 ? glm::normalize(ship_from_thruster * acceleration) : glm::dvec3(0);
    const glm::dvec3 u = ship.u.total();
    const physics::ThrustSegment segment = physics::thrust_segment(u, way, strength, dtau);

    ship.u.add(segment.du);
    ship.position.add(segment.dx);
    ship.time.add(segment.dt);
    ship.proper_time.add(dtau);
    ship.distance.add(glm::length(segment.dx));

    const glm::dvec4 wigner = physics::wigner_turn(u, way * std::sinh(strength * dtau));
    ship.ship_from_cockpit = nearly_unit(carried(wigner, ship_from_thruster) * half_turn);
    return ship;
}

Ship stopped(Ship ship)
{
    ship.u = Sum3();
    return ship;
}

} // namespace starbow
