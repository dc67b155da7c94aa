#pragma once
#include "view_constants.h"
#include "view_descriptors.h"
#include <functional>

namespace starbow {

/// The three images of measured channels that record_measured fills.
struct MeasureTarget {
    Image light_and_depth, camera, world;
};

/// Records all passes that go view by view: stars, warp, bloom, test patterns, head-up display, and the finish of each
/// output. Each function is one pass with a label for debuggers.
class ViewPasses {
public:
    ViewPasses(Device& device, Pipelines& pipelines, const FrameState& state, ViewSet& views, const EyeCubes& eyes,
        StarPass& stars, const ViewConstants& constants, const ViewDescriptors& descriptors);

    /// Makes room for the next frame: picture of the stars, bloom, labels, panel of the head-up display (null: none).
    void prepare(const Panel* hud);
    /// Sets what is laid over the views beside the display, from the next prepare() on.
    void place(std::span<const Callout> callouts) { callouts_.assign(callouts.begin(), callouts.end()); }

    /// The views of one layer of an output through the cube maps, stars and bloom included, or the test pattern.
    void warp_layer(vk::CommandBuffer commands, std::size_t output, std::size_t layer, const Target& last);
    void draw_vignette(vk::CommandBuffer commands, std::size_t output, std::size_t layer, const Target& last);
    void draw_hud(vk::CommandBuffer commands, std::size_t output, std::size_t layer, const Target& last);
    /// Adds a layer to the output's light where there are several.
    void end_layer(vk::CommandBuffer commands, std::size_t output, std::size_t layer);
    void finish_output(vk::CommandBuffer commands, std::size_t output, const Target& target);
    /// Black over the whole target, by the state's part.
    void fade_output(vk::CommandBuffer commands, const Target& target);
    /// The measured channels of one layer of an output's first canvas.
    void record_measured(vk::CommandBuffer commands, std::size_t output, std::size_t layer, const MeasureTarget& target);
    /// An inset: stars and cube map, without glow.
    void draw_inset(vk::CommandBuffer commands, const Inset& inset);
    /// The stars alone, the first part of warp_layer. exposure: factor of their light.
    void draw_stars(
        vk::CommandBuffer commands, std::size_t output, std::size_t layer, int canvas, std::optional<double> exposure);

    /// The rotations from a measured view's motion axes and its cube map's axes to the world's, with the view's layer,
    /// corner and size.
    struct Axes {
        std::size_t layer;
        glm::ivec2 corner, size;
        glm::dmat3 world_from_motion, world_from_cube;
        glm::dvec3 ahead; ///< the observer's direction of motion, unit; 0 at rest
    };
    std::vector<Axes> measured_axes(std::size_t output) const;

    /// Calls `draw` for each view of a layer on each of an output's canvases, inside a rendering over the picture.
    void lay_over(vk::CommandBuffer commands, std::size_t output, std::size_t layer, const Target& last,
        const std::function<void(std::size_t view, vk::Format target)>& draw) const;
    /// Draws one full-screen triangle over `size` pixels from `corner` on, with the view's descriptor set.
    void draw_warp(vk::CommandBuffer commands, const ViewState& view, vk::Pipeline pipeline,
        const shared::ViewPush& constants, glm::ivec2 corner, glm::ivec2 size) const;

    /// Draws the pixels at which something may show.
    void draw_lit(vk::CommandBuffer commands, const ViewState& view, vk::Format target) const;

    /// An image of the first view, which must be flat, without aberration: the image and its axes, for
    /// CubePass::prepare_plain.
    PlannedImage plain_image(const Shot& shot, glm::dmat3& straight_from_world) const;
    /// Draws the first view through Pipelines::lookup: the bare cost of a cube map's look-up.
    void look_up(vk::CommandBuffer commands, const Target& target, vk::Pipeline pipeline, vk::DescriptorSet set);

    vk::DeviceSize memory() const;

private:
    bool plain_pattern() const;
    void begin_over(vk::CommandBuffer commands, const Target& target) const;
    void prepare_callouts();
    void prepare_stars();
    void find_lit(ViewState& view);
    void draw_stars_of(vk::CommandBuffer commands, const ViewState& view, std::optional<double> exposure);
    /// corner: added to each part's.
    void draw_parts(vk::CommandBuffer commands, const ViewState& view, vk::Pipeline pipeline,
        const shared::ViewPush& constants, glm::ivec2 corner, std::span<const PixelRect> parts) const;
    void bloom_view(vk::CommandBuffer commands, const ViewState& view);
    void pattern_view(vk::CommandBuffer commands, const ViewState& view, vk::Format target);

    Device& device_;
    Pipelines& pipelines_;
    const FrameState& state_;
    ViewSet& views_;
    const EyeCubes& eyes_;
    StarPass& stars_;
    const ViewConstants& constants_;
    const ViewDescriptors& descriptors_;
    std::vector<StarPass::Observer> star_observers_; ///< a member so that its memory is reused
    std::vector<ShipCap> bodies_; ///< the same
    std::unique_ptr<PanelPass> hud_; ///< null before its first use
    std::vector<Callout> callouts_;
    struct CalloutPass {
        PanelPass panel;
        std::vector<vk::Rect2D> boxes; ///< the pixels of each view that it may cover
    };
    std::vector<std::unique_ptr<CalloutPass>> callout_passes_; ///< made at their first use
    bool hud_on_ = false;
};

} // namespace starbow
