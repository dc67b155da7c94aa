#pragma once

namespace starbow {

/// Prints what the processor asks of the device in one frame: passes, draws, binds and the like, by world, layout and speed.
/// The figures are the same on every machine with one kind of device.
void bench_counts();

} // namespace starbow
