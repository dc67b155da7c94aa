#pragma once
#include "world.h"

namespace starbow {

/// Divides every surface of many triangles, at every level of detail, into clusters. The order of its triangles changes, so
/// that each cluster's are together.
void add_clusters(World& world);

} // namespace starbow
