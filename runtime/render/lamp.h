#pragma once
#include "gpu_world.h"
#include "runtime/world/eye_event.h"

namespace starbow {

/// A lamp as what stands still in the eye event's frame is lit by it, around the eye: where it is at the eye's time, how it
/// moves, and which spectra its light may have there. scale: of radiances.
shared::LightEntry light_entry(const GpuWorld& world, const Lamp& lamp, const EyeEvent& eye_event, double scale);

} // namespace starbow
