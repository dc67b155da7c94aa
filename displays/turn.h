#pragma once
#include "config/layout.h"

namespace starbow {

/// From a picture's own axes (-z its middle, +x right, +y up) to the cockpit's.
glm::dmat3 cockpit_from_picture(const Turn& turn);

/// Where the zenith of a dome points: the cockpit's up, leant forward by the tilt.
glm::dvec3 dome_zenith(double tilt_deg);

} // namespace starbow
