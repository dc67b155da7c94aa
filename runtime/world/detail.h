#pragma once
#include "world.h"
#include <functional>

namespace starbow {

/// Adds coarser levels of detail to every large enough primitive: indices are appended, vertices shared. Each level has
/// about half the triangles of the one before, with its measured errors in shape and in shading. They pay because most of
/// a relativistic sky is far away or seen small. Very large surfaces are divided into pieces instead, fine and
/// coarse ones. All large ones are divided into clusters. progress: is called with the
/// part of the work that is done, 0 to 1; large worlds take minutes.
void add_detail_levels(World& world, const std::function<void(double)>& progress = {});

} // namespace starbow
