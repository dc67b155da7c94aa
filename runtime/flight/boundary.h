#pragma once
#include "config/model/flying.h"
#include "ship.h"
#include <optional>

namespace starbow {

/// The greatest rapidity at which a ship can come to rest at the boundary's edge, whichever way it turns, as
/// rapidity_to_stop. Infinite beyond the boundary on the way back.
double rapidity_within(const Boundary& boundary, const Ship& ship, const Flying& rules, double seconds_per_time_unit);

/// The greatest rapidity at which a ship can come to rest within a distance (scene units; 0 if it is less), with two fifths
/// of the rules' gain, because its pilot follows with a delay. A ship that slows down from the rapidity w by a per second
/// needs (cosh w - 1) / a seconds of light (hyperbolic motion; Misner, Thorne and Wheeler, 6.2).
double rapidity_to_stop(double room, const Flying& rules, double seconds_per_time_unit);

/// True for a ship that has come close to the boundary, or is beyond it, and flies outward.
bool leaves(const Boundary& boundary, const Ship& ship);

/// The controls' turn that leads the nose to a place, kindly: level at first, for it lies behind. Each is a part of the
/// rules' turn rate, or of their step. None once the nose points there.
std::optional<glm::dvec3> turn_towards(const glm::dvec3& place, const Ship& ship, const Flying& rules);

} // namespace starbow
