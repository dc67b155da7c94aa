#pragma once
#include "settings.h"

namespace starbow {

/// Prints how much the live picture shimmers in slow motions: the part of its change from frame to frame that the picture
/// by rays does not share. The place and the look are those of the trial's first shot. Writes shimmer.md into the trial's
/// folder unless that is empty. Returns the exit status: 1 where a shipped setting shimmers more than its bound, which is
/// known for the shot starbow on the desk. Throws InputError.
int measure_shimmer(const Trial& trial, const std::vector<Setting>& settings, const Device::Options& options);

} // namespace starbow
