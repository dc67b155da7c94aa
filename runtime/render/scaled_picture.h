#pragma once
#include "pipelines.h"

namespace starbow {

/// A picture of another size than its window's, which is scaled into the window's own. It is drawn instead of blitted, for
/// MipChain's reason.
class ScaledPicture {
public:
    /// Throws InputError where the device has no room for it.
    ScaledPicture(Device& device, Pipelines& pipelines, glm::ivec2 size, vk::Format format);

    /// The picture that is drawn instead of the window's.
    Target target() const { return {*image_.image, *image_.view, image_.extent, image_.format}; }
    /// Scales it. Both pictures are in eColorAttachmentOptimal, before and afterwards.
    void draw(vk::CommandBuffer commands, const Target& window) const;

private:
    Device& device_;
    Pipelines& pipelines_;
    Image image_;
    vk::raii::Sampler sampler_ = nullptr;
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::raii::DescriptorSet set_ = nullptr;
};

} // namespace starbow
