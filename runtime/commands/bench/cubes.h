#pragma once

namespace starbow {

/// Times what a planned cube map saves and costs: a dome beside a plain picture, and the plan's images beside the six full
/// faces that would show as much. Prints to stdout.
void bench_cubes(int rounds);

} // namespace starbow
