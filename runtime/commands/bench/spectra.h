#pragma once
#include "config/model/layout.h"
#include "runtime/render/render_context.h"

namespace starbow {

/// Times the cube and the warp pass of the avenue at every spectral level, and prints each level's errors beside its cost.
/// Prints to stdout. Returns [level][cube, warp] over the coarsest's.
std::array<std::array<double, 2>, 3> bench_spectra(RenderContext& context, const Layout& layout, int rounds);

} // namespace starbow
