#pragma once
#include "pipelines.h"

namespace starbow {

/// Draws the coarser levels of an image, each from the next finer one. They are drawn instead of blitted, because the
/// fences of lavapipe's blits can't be held (LavapipeFenceGuard).
class MipChain {
public:
    /// The image can be drawn into and sampled, and outlives this object.
    MipChain(Device& device, Pipelines& pipelines, const Image& image);

    /// Begins a level, from 1 on. The next finer one is in eShaderReadOnlyOptimal; contents of this one are lost.
    void begin(vk::CommandBuffer commands, std::uint32_t level) const;
    /// Draws a part of the level, in its texels.
    void halve(vk::CommandBuffer commands, glm::ivec2 corner, glm::ivec2 size) const;
    /// Ends the level: shaders may read it in eShaderReadOnlyOptimal.
    void end(vk::CommandBuffer commands) const;

    /// Draws all levels whole, from level 0 in eShaderReadOnlyOptimal.
    void draw_all(vk::CommandBuffer commands) const;

private:
    void barrier(vk::CommandBuffer commands, vk::ImageLayout from, vk::ImageLayout to) const;

    Device& device_;
    Pipelines& pipelines_;
    const Image& image_;
    vk::raii::Sampler sampler_ = nullptr;
    vk::raii::DescriptorPool pool_ = nullptr;
    std::vector<vk::raii::ImageView> views_; ///< a level each
    std::vector<vk::raii::DescriptorSet> sets_; ///< read a level each, but the last
    mutable std::uint32_t level_ = 0; ///< the one that is drawn
};

} // namespace starbow
