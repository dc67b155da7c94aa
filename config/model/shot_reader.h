#pragma once
#include "config/json/reader.h"
#include "shot.h"

namespace starbow {

/// A limit large enough for any world, small enough that squares and sums stay far from overflow.
constexpr double farthest = 1e15;

/// A direction as a unit vector, from three numbers of any length above 0.
glm::dvec3 unit_direction(const Place& place);

/// gamma beta from a direction and exactly one of "gamma", "beta" and "rapidity".
glm::dvec3 read_velocity(const Place& place);

/// Reads the members that a shot's file and a scene's start share. `with_scene`: also the member "scene", which is then
/// required.
Shot read_shot(const Place& place, bool with_scene);

/// The rotation of an object's members "look" and "up"; without them, straight ahead along -z.
glm::dquat read_orientation(const Place& place);

} // namespace starbow
