#pragma once
#include "layout.h"

namespace starbow {

/// The turn that leads from the cockpit's axes to others: the columns are the turned right, up and backwards, unit and at
/// right angles. Straight up or down the roll is taken as yaw's share.
Turn turn_of(const glm::dmat3& axes);

/// The same of a unit quaternion.
Turn turn_of(double x, double y, double z, double w);

} // namespace starbow
