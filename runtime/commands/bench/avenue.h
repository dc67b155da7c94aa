#pragma once
#include "runtime/render/render_context.h"
#include <array>
#include <utility>

namespace starbow {

/// The scene that the benches fly in, on the device, with its stars and without.
struct Avenue {
    RenderContext context;
    GpuWorld starless;
    Avenue();
};

/// One plain window of a size in pixels: the layout `desk`.
Layout window_of(glm::ivec2 size);

/// The speeds that the benches compare, by their names in JSON: gamma.
constexpr std::array<std::pair<const char*, double>, 3> bench_speeds = {{{"rest", 1}, {"gamma4", 4}, {"gamma100", 100}}};

/// The avenue from its start: at rest, or from its first columns on at gamma, three stops darker.
Shot along_avenue(const Shot& start, double gamma);

} // namespace starbow
