#pragma once
#include "layout.h"

namespace starbow {

/// The turn from a picture's own axes (-z its middle, +x right, +y up) to the cockpit's.
glm::dmat3 cockpit_from_picture(const Turn& turn);

/// The direction of a dome's zenith: the cockpit's up, leant forward by the tilt.
glm::dvec3 dome_zenith(double tilt_deg);

/// The angles of the turn from the cockpit's axes to others: the columns are the turned right, up and backwards, unit and
/// at right angles. Straight up or down, the roll counts as yaw.
Turn turn_of(const glm::dmat3& axes);

/// The same for a unit quaternion.
Turn turn_of(double x, double y, double z, double w);

} // namespace starbow
