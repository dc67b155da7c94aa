#pragma once
#include "config/model/angles.h"
#include "config/model/flying.h"
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace starbow {

/// The direction of a level cockpit's nose in the ship frame: heading to the left of -z about y, and pitch up. Radians.
struct Aim {
    double heading = 0, pitch = 0;
};

/// The greatest pitch of a level cockpit, up or down, radians: before the pole, where a heading would lose its meaning.
constexpr double most_pitch_rad = 75 * degree;

/// The direction of a cockpit's nose; straight up or down the heading is that of its right axis.
Aim aim_of(const glm::dquat& ship_from_cockpit);

/// The level cockpit whose nose points there.
glm::dquat level_cockpit(const Aim& aim);

/// The level cockpit with the same nose, but for a pitch beyond the greatest. A cockpit that is level to 1e-12 radians stays
/// as it is, to the bit.
glm::dquat levelled(const glm::dquat& ship_from_cockpit);

/// The turns that lead from one aim to another, the shorter way round: x the pitch, y the heading. Radians.
glm::dvec2 turns_between(const Aim& from, const Aim& to);

/// A turn of the controls (pitch up, yaw left, roll left) about the cockpit's axes. Where the horizon is kept, the yaw is
/// about the ship's y, and there is no roll.
glm::dvec3 about_cockpit(const glm::dvec3& turn, const glm::dquat& ship_from_cockpit, const Comfort& comfort);

/// The part of the vignette that is seen a tick later. turned_rad: the ship's turn in the tick. It grows and fades within a
/// quarter of a second, and is exactly 0 some time after a turn has ended.
double vignette_after(double now, double turned_rad, const Flying& rules);

} // namespace starbow
