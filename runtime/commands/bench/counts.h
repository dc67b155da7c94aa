#pragma once

namespace starbow {

/// Prints the counts of one frame's calls of Vulkan: passes, draws, binds and the like, by world, layout and speed.
/// The figures are the same on every machine with one kind of device.
void bench_counts();

} // namespace starbow
