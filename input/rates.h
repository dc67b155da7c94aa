#pragma once
#include "controls.h"

namespace starbow {

/// The rates among the controls. Each hand's run from -1 to 1, but for the keyboard's throttle with Shift; look_rad is the
/// change since the last reading.
struct Rates {
    double throttle_rate = 0, exposure = 0;
    glm::dvec3 push{0}, turn{0};
    glm::dvec2 look_rad{0};
};

/// The speed of looking around at a full stick.
constexpr double look_rad_per_s = 1.5;

/// Returns the rates and leaves none.
Rates take_rates(Controls& controls);

/// Adds others' rates to those of one device. Several hands together are at most as fast as the fastest of them alone may
/// be: the limits of flight count on full rates of 1. dt_s: since the last reading.
void add_rates(Controls& device, const Rates& others, double dt_s);

} // namespace starbow
