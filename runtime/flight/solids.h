#pragma once
#include "config/model/flying.h"
#include "ship.h"
#include <span>

namespace starbow {

/// The middle of a solid ball at a time of the world, scene units.
glm::dvec3 place_of(const Solid& solid, double time);

/// The greatest rapidity at which a ship can come to rest above every solid that its straight way meets, with two fifths of
/// the rules' gain, as rapidity_within. Infinite where its way meets none.
double rapidity_above(std::span<const Solid> solids, const Ship& ship, const Flying& rules, double seconds_per_time_unit);

/// The ship outside of all solids, after a step from a place: one whose straight way led into a solid is on its ground where
/// it met it. It rests there if it fell more than it flew along the ground, and else slides on.
Ship kept_outside(std::span<const Solid> solids, const glm::dvec3& before, Ship ship);

} // namespace starbow
