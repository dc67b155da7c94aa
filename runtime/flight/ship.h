#pragma once
#include "config/model/shot.h"
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace starbow {

/// A sum that compensates its rounding (Neumaier), so that a month of frames adds up like one long step. It holds only
/// without -ffast-math.
struct Sum {
    double value = 0, carry = 0;
    void add(double x);
    double total() const { return value + carry; }
};
struct Sum3 {
    Sum x, y, z;
    Sum3() = default;
    explicit Sum3(const glm::dvec3& v) { x.value = v.x, y.value = v.y, z.value = v.z; }
    void add(const glm::dvec3& v);
    glm::dvec3 total() const { return {x.total(), y.total(), z.total()}; }
};

/// The traveller's state. Scene units, c = 1; times in unit / c.
struct Ship {
    Sum3 position; ///< world frame
    Sum time; ///< world time
    Sum3 u; ///< proper velocity, gamma beta, world frame
    glm::dquat ship_from_cockpit{1, 0, 0, 0}; ///< cockpit axes in the ship frame: the world's axes carried by the pure boost
    Sum proper_time; ///< on board, since the start
    Sum distance; ///< flown in the world, since the start
};

/// A ship at a shot's instant, its clocks and its distance at zero.
Ship ship_at(const Shot& shot);

/// The ship's instant as a shot; the picture is a function of it.
Shot shot_of(const Ship& ship);

/// The rapidity of the ship's velocity in the world.
double rapidity_of(const Ship& ship);

/// One step of proper time dtau (>= 0) under a proper acceleration that is constant in the cockpit: cockpit axes, rapidity
/// per unit of proper time. Meanwhile the cockpit turns by `turn`: a rotation vector, radians, cockpit axes. The boost
/// carries the cockpit along (Thomas-Wigner).
///
/// Without a turn the step is the closed form of hyperbolic motion, and thrust segments of one constant acceleration join
/// exactly. Any division into steps gives the same u, position, time and orientation, to rounding. A turn alone is exact as
/// well. Both together are half the turn, the thrust segment, half the turn; this differs from the smooth flight by the
/// order of dtau^2. `distance` adds the straight way of each step. It is exact on a straight flight that does not reverse
/// within a step. On a curved one it is short by the order of dtau^2.
///
/// u keeps 15 digits at any gamma; u, position and time hold to 1e-12 of the closed form up to gamma 1e9. A flight from rest
/// to gamma and back along one line returns u and the axes to 1e-16 gamma at worst. From gamma 1e6 it returns them to 1e-12
/// if a step's rapidity is below 0.01. A sideways error at the top, such as the rounding of a turn, comes back times gamma.
Ship fly(Ship ship, const glm::dvec3& acceleration, const glm::dvec3& turn, double dtau);

/// Returns the ship at rest in the world at the same event; the cockpit's axes in the ship frame stay.
Ship stopped(Ship ship);

} // namespace starbow
