#include "exhibit_renderer.h"

namespace starbow {

std::unique_ptr<FrameRenderer> exhibit_renderer(RenderContext& context, const Layout& layout, const Quality& quality,
    const std::string& node, std::optional<PreparedLayout> prepared)
{
    // Before a window's own size is known, no output may be beyond the device's limit.
    Layout shown = layout;
    for (Output& output : shown.outputs)
        output.size = glm::min(output.size, int(context.device.properties.limits.maxImageDimension2D));
    return in_room([&] {
        auto made = std::make_unique<FrameRenderer>(
            context.device, context.pipelines, context.world, shown, quality, false, std::move(prepared));
        made->only(node);
        made->repeatable(!node.empty()); // all machines' pictures are alike, whatever each drew before
        return made;
    });
}

void exchange_world(RenderContext& context, GpuWorld world, const std::function<void()>& make_renderer)
{
    std::swap(context.world, world);
    try {
        make_renderer();
    } catch (...) {
        std::swap(context.world, world); // the old renderer draws the old world, in its place
        throw;
    }
}

} // namespace starbow
