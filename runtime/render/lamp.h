#pragma once
#include "gpu_world.h"
#include "runtime/world/eye_event.h"

namespace starbow {

/// The light of one lamp on surfaces at rest in the eye event's rest frame, relative to the eye: the lamp's place at the
/// eye's time, its motion, and the spectra that its light may have there. scale: factor of radiances.
shared::LightEntry light_entry(const GpuWorld& world, const Lamp& lamp, const EyeEvent& eye_event, double scale);

} // namespace starbow
