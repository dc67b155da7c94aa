#pragma once
#include "cube_pass.h"

namespace starbow {

/// The glow of one viewport. Holds its exposed light in linear fp16 and a chain of copies, each half as large. The copies
/// are mixed so that every octave of distance gets the same share, as in an eye (Vos 1984: about 1 / angle^2). The glow
/// spreads over the output's pixels, on a dome or a curved wall too. It ends at the viewport's edges: no eye's light
/// reaches the other eye's picture.
class BloomPass {
public:
    BloomPass(Device& device, Pipelines& pipelines, glm::ivec2 size);

    glm::ivec2 size() const { return size_; }
    /// The target that the viewport's light is drawn into; in eColorAttachmentOptimal after begin().
    Target light() const;
    void begin(vk::CommandBuffer commands) const;
    /// Spreads the light that is brighter than a level over the copies. Call it outside any rendering.
    void spread(vk::CommandBuffer commands, double above) const;
    /// Draws the light, with `part` of what is brighter than that level spread, inside the rendering of a target, with its
    /// top left pixel at `corner`. range: the light went through the curve that shows everything at once.
    void show(vk::CommandBuffer commands, glm::ivec2 corner, double part, double above, bool range, vk::Format target) const;

    vk::DeviceSize memory() const;

private:
    void step(vk::CommandBuffer commands, std::size_t from, std::size_t to, double part, double above) const;

    Device& device_;
    Pipelines& pipelines_;
    glm::ivec2 size_;
    std::vector<Image> pictures_; ///< the light, and each half as large as the one before
    vk::raii::Sampler sampler_ = nullptr;
    vk::raii::DescriptorPool pool_ = nullptr;
    std::vector<vk::raii::DescriptorSet> sets_; ///< each picture with the next smaller one
};

} // namespace starbow
