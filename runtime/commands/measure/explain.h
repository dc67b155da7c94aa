#pragma once
#include "settings.h"

namespace starbow {

/// Prints every part of a frame that the trial's scene, layout and first shot switch on: why, and what a frame costs with it
/// over one without, each pair in turn; and what is off. Throws InputError.
void explain(const Trial& trial, const Device::Options& options);

} // namespace starbow
