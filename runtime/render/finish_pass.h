#pragma once
#include "cube_pass.h"
#include "displays/finish/shade.h"

namespace starbow {

/// Whether an output's light needs more than the sRGB curve that its target applies by itself.
bool needs_finish(const Output& output, const Shade& shade);

/// From an output's pictures in linear light to what its screen or projector wants. Holds these pictures.
class FinishPass {
public:
    /// headroom: of all outputs together, see shade.h.
    FinishPass(Device& device, Pipelines& pipelines, const Output& output, const Shade& shade, double headroom);

    /// The pictures to draw into: one, or the left and the right eye's.
    std::size_t layers() const { return pictures_.size(); }
    Target picture(std::size_t layer) const;

    /// Before and after the pictures are drawn.
    void begin(vk::CommandBuffer commands);
    /// plain: without masks, blend and dither, for a pattern that is aligned by its lines.
    void record(vk::CommandBuffer commands, const Target& target, bool plain);

    vk::DeviceSize memory() const;

private:
    Device& device_;
    Pipelines& pipelines_;
    FinishVariant variant_;
    shared::FinishPush push_{};
    std::vector<Image> pictures_;
    Image weight_, black_, table_;
    vk::raii::Sampler sampler_ = nullptr;
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::raii::DescriptorSet set_ = nullptr;
};

} // namespace starbow
