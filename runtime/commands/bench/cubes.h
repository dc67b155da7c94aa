#pragma once
#include "runtime/render/render_context.h"

namespace starbow {

/// Times what a planned cube map saves and costs: a dome beside a plain picture, and the plan's images beside the six full
/// faces that would show as much. Prints to stdout.
void bench_cubes(RenderContext& context, const GpuWorld& starless, int rounds);

} // namespace starbow
