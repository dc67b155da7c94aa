#pragma once
#include "world.h"

namespace starbow {

/// Gives every primitive worth it coarser levels of detail (indices appended, vertices shared), each about half the
/// triangles of the one before, with its measured error, in shape and in shading: most of a relativistic sky is far away or
/// seen small.
void add_detail_levels(World& world);

} // namespace starbow
