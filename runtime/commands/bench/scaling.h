#pragma once
#include "runtime/render/render_context.h"

namespace starbow {

/// Times how a frame's cost grows with its pixels, with its triangles, and the processor's part of it with the objects.
/// Prints to stdout.
void bench_scaling(int rounds);

} // namespace starbow
