#pragma once
#include "gpu_world.h"
#include "pipelines.h"
#include "runtime/hud/instruments.h"
#include "runtime/hud/overlay.h"
#include "shaders/shared_structs.h"

namespace starbow {

/// Draws the constellations' lines, overlays, the crosshair and the marks. Holds the constants of each view.
class OverlayPass {
public:
    /// figures: figure_table(); empty until they are drawn.
    OverlayPass(const Device& device, Pipelines& pipelines, std::size_t views, const std::vector<glm::vec4>& figures);
    bool has_figures() const { return has_figures_; }

    struct Content {
        Overlay overlay = Overlay::off;
        std::array<std::optional<Spot>, 2> marks;
        OverlayScale scale;
        bool figures = false; ///< the constellations' lines, below the overlay
        bool any() const { return overlay != Overlay::off || figures; }
    };
    /// observer: the view's eye. The device must have finished the frame before.
    void prepare(std::size_t view, const Content& content, const MeasuringObserver& observer, const GpuWorld& world);

    /// Draws into the rendering under way. warp_set, constants: the same as for the view's warp.
    void draw(vk::CommandBuffer commands, std::size_t view, const WarpVariant& variant, const Content& content,
        vk::DescriptorSet warp_set, const shared::ViewPush& constants, glm::ivec2 corner, glm::ivec2 size,
        vk::Format target);

private:
    Pipelines& pipelines_;
    Buffer constants_, figures_;
    vk::raii::BufferView figures_view_ = nullptr;
    bool has_figures_;
    vk::raii::DescriptorPool pool_ = nullptr;
    std::vector<vk::raii::DescriptorSet> sets_;
};

} // namespace starbow
