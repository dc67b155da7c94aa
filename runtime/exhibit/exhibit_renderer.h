#pragma once
#include "runtime/render/frame_renderer.h"
#include "runtime/render/render_context.h"
#include <functional>

namespace starbow {

/// The renderer of a machine's outputs. node: this machine among several; empty: it shows all. prepared: as
/// FrameRenderer's. Throws InputError where a layout is wrong, or there is no memory for it.
std::unique_ptr<FrameRenderer> exhibit_renderer(RenderContext& context, const Layout& layout, const Quality& quality,
    const std::string& node, std::optional<PreparedLayout> prepared = {});

/// Puts another world in the old one's place and makes its renderer. Where that throws, the old world stays.
void exchange_world(RenderContext& context, GpuWorld world, const std::function<void()>& make_renderer);

} // namespace starbow
