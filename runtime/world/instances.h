#pragma once
#include "world.h"
#include <utility>

namespace starbow {

/// A rest frame's instances, from first to before last, in sort_instances' order.
struct InstanceRange {
    std::size_t first, last;
};
InstanceRange instances_of(const World& world, int frame);

/// True if an instance's picture depends on its own time: clocks, blinking lamps, animated nodes and finite existence.
/// These instances are the first of their rest frame.
bool timed(const World& world, const Instance& instance);

/// True if an instance's existence interval is finite.
bool finite_existence(const World& world, const Instance& instance);

/// The part of sort_instances' key by which a primitive's instances need separate draws: finite existence, animation.
std::pair<bool, bool> kind_of(const World& world, const Instance& instance);

/// Sorts a world's instances by their rest frames. In each frame the timed ones come first; then they are sorted by their
/// materials and their primitives.
void sort_instances(World& world);

} // namespace starbow
