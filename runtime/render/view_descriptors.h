#pragma once
#include "eye_cubes.h"
#include "star_pass.h"

namespace starbow {

/// Keeps the descriptor sets of all views up to date: a set is written when something in it changes.
class ViewDescriptors {
public:
    ViewDescriptors(Device& device, const GpuWorld& world, const FrameState& state, ViewSet& views, const EyeCubes& eyes,
        const StarPass& stars);

    /// Writes the sets that changed: after the plans, before any command is recorded. The device must have finished the
    /// frame before.
    void write();

    vk::Sampler nearest() const { return *nearest_; } ///< for direction maps

private:
    void write(ViewState& view);
    /// Writes the constants of the rest frames in view, and of the sky.
    void write_rest_frames(ViewState& view);
    void write_globes(ViewState& view);
    void write_range(); ///< the curve that shows everything at once
    void collect_label_set(const ViewState& view);
    void collect_warp_set(const ViewState& view);
    void image(
        const vk::raii::DescriptorSet& set, std::uint32_t binding, const Image& image, const vk::raii::Sampler& sampler);
    void buffer(const vk::raii::DescriptorSet& set, std::uint32_t binding, const Buffer& buffer);

    Device& device_;
    const GpuWorld& world_;
    const FrameState& state_;
    ViewSet& views_;
    const EyeCubes& eyes_;
    const StarPass& stars_;
    vk::raii::Sampler linear_ = nullptr, nearest_ = nullptr, finest_ = nullptr; ///< finest_ reads level 0 alone
    Buffer range_; ///< RangeConstants
    Image nothing_, no_maps_; ///< for views without an image, or without an array of them
    Buffer no_globes_;
    // The content of one view's sets, collected anew for each view and frame.
    std::array<vk::DescriptorImageInfo, 21> image_infos_;
    std::array<vk::DescriptorBufferInfo, 4> buffer_infos_;
    std::array<vk::BufferView, 2> texel_views_;
    std::size_t images_used_ = 0, buffers_used_ = 0;
    std::vector<vk::WriteDescriptorSet> writes_;
    std::vector<std::uint64_t> serials_;
};

} // namespace starbow
