#pragma once
#include "view_meter.h"

namespace starbow {

/// Makes the next pipeline, or a few small ones, that take-off and the switches will need, and returns true; false where all
/// are there. In software one takes a tenth of a second: nobody sees that while the ship rests.
bool make_pipeline_ahead(Pipelines& pipelines, const GpuWorld& world, const FrameState& state, const ViewSet& views,
    EyeCubes& eyes, const StarPass& stars, const ViewConstants& constants, const ViewMeter& meter);

} // namespace starbow
