#pragma once
#include "cube_pass.h"
#include "displays/finish/shade.h"

namespace starbow {

/// True if an output's light needs more than the sRGB curve that its target applies.
bool needs_finish(const Output& output, const Shade& shade);

/// Turns an output's canvases in linear light into the picture that its screen or projector needs. Holds the canvases.
class FinishPass {
public:
    /// headroom: the one of all outputs together, see shade.h.
    FinishPass(Device& device, Pipelines& pipelines, const Output& output, const Shade& shade, double headroom);

    /// The number of canvases that views are drawn into: 1, or 2 for the left and the right eye.
    std::size_t canvas_count() const { return canvases_.size(); }
    Target canvas(std::size_t i) const;
    /// The number of layers, which are drawn one after the other; more than 1 where viewports overlap.
    std::size_t layers() const { return layers_; }
    /// The view's shares of its output's pixels, or null without overlapping viewports.
    const Image* shares(const View& view) const;

    /// begin: before the canvases are drawn, for each layer; end: afterwards; record: after the last layer.
    void begin(vk::CommandBuffer commands);
    /// plain: without masks, blend ramps and dither, for a pattern whose lines are aligned.
    void end(vk::CommandBuffer commands, std::size_t layer, bool plain);
    void record(vk::CommandBuffer commands, const Target& target, bool plain);

    vk::DeviceSize memory() const;

private:
    void make_layers(const Shade& shade);

    Device& device_;
    Pipelines& pipelines_;
    FinishVariant variant_;
    shared::FinishPush push_{};
    std::vector<Image> canvases_; ///< of the layer that is drawn
    std::vector<Image> sums_; ///< of all layers, for each canvas; empty with one layer
    std::size_t layers_ = 1;
    std::vector<Image> shares_; ///< Shade::shares
    Image weight_, black_, table_;
    vk::raii::Sampler sampler_ = nullptr;
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::raii::DescriptorSet set_ = nullptr;
    std::vector<vk::raii::DescriptorSet> layer_sets_; ///< as shares_, each with its canvas
};

} // namespace starbow
