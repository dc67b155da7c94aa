#pragma once
// Special relativity with 33 digits, for the tests alone. A boost changes the parts of a 4-vector along and across the
// motion, as in a first textbook. It shares no formula with shaders/physics: no half angles, no 1/(1 + gamma), no E.
#include <array>
#include <glm/glm.hpp>
extern "C" {
#include <quadmath.h>
}

namespace quad {

using Q = __float128;
inline const Q pi = 4 * atanq(1);

struct V3 {
    Q x, y, z;
};
inline V3 of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
inline V3 of(const glm::vec3& v) { return {v.x, v.y, v.z}; }
inline V3 operator+(V3 a, V3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline V3 operator-(V3 a, V3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline V3 operator*(V3 a, Q s) { return {a.x * s, a.y * s, a.z * s}; }
inline Q dot(V3 a, V3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline V3 cross(V3 a, V3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline Q length(V3 a) { return sqrtq(dot(a, a)); }
inline V3 unit(V3 a) { return a * (1 / length(a)); }

/// Angle between two vectors of any length. It is as accurate for small angles as for large ones.
inline double angle(V3 a, V3 b) { return double(atan2q(length(cross(a, b)), dot(a, b))); }

/// An event or a 4-momentum.
struct V4 {
    Q t;
    V3 x;
};
inline Q gamma(V3 u) { return sqrtq(1 + dot(u, u)); }

/// Transforms from the frame that moves with proper velocity u to the world, separately along and across the motion.
inline V4 boosted(V3 u, V4 e)
{
    const Q speed = length(u);
    if (speed == 0)
        return e;
    const V3 way = u * (1 / speed);
    const Q along = dot(way, e.x);
    const V3 across = e.x - way * along;
    return {gamma(u) * e.t + speed * along, across + way * (gamma(u) * along + speed * e.t)};
}

/// A direction to the light's source, and the Doppler factor. Light that comes from n flies along -n.
struct Light {
    V3 n;
    Q D; // f_camera / f_world
};
inline Light world_from_camera(V3 n, V3 u)
{
    const V4 p = boosted(u, {1, unit(n) * -1});
    return {p.x * (-1 / p.t), 1 / p.t};
}
inline Light camera_from_world(V3 n, V3 u)
{
    const V4 p = boosted(u * -1, {1, unit(n) * -1});
    return {p.x * (-1 / p.t), p.t};
}

/// Rotates a vector by a unit quaternion (x, y, z; w), by way of its angle and axis.
inline V3 turned(const glm::dvec4& q, V3 v)
{
    const V3 part{q.x, q.y, q.z};
    const Q sine = length(part);
    if (sine == 0)
        return v;
    const V3 axis = part * (1 / sine);
    const Q a = 2 * atan2q(sine, q.w);
    return v * cosq(a) + cross(axis, v) * sinq(a) + axis * (dot(axis, v) * (1 - cosq(a)));
}

} // namespace quad
