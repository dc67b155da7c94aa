#pragma once
#include "cube_pass.h"

namespace starbow {

/// The glow of a viewport: its exposed light in linear fp16, and smaller and smaller copies of it, mixed so that every
/// octave of distance gets the same part, as in an eye (Vos 1984: about 1 / angle^2). It works on the output's pixels, on a
/// dome or a bent wall too, and ends at the viewport's edges: no eye's light gets into the other's picture.
class BloomPass {
public:
    BloomPass(Device& device, Pipelines& pipelines, glm::ivec2 size);

    glm::ivec2 size() const { return size_; }
    /// Where the light is to be drawn; in eColorAttachmentOptimal after begin().
    Target light() const;
    void begin(vk::CommandBuffer commands) const;
    /// Spreads it: outside of any rendering.
    void spread(vk::CommandBuffer commands) const;
    /// Draws it with `part` of its light spread, inside the rendering of a target, at a corner of it.
    void show(vk::CommandBuffer commands, glm::ivec2 corner, double part, vk::Format target) const;

    vk::DeviceSize memory() const;

private:
    void step(vk::CommandBuffer commands, std::size_t from, std::size_t to, double part) const;

    Pipelines& pipelines_;
    glm::ivec2 size_;
    std::vector<Image> pictures_; ///< the light, and each half as large as the one before
    vk::raii::Sampler sampler_ = nullptr;
    vk::raii::DescriptorPool pool_ = nullptr;
    std::vector<vk::raii::DescriptorSet> sets_; ///< each picture, and the one after it
};

} // namespace starbow
