#include "live_copy.h"
#include <utility>

namespace starbow {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

bool is_blue_first(vk::Format format) { return format == vk::Format::eB8G8R8A8Srgb || format == vk::Format::eB8G8R8A8Unorm; }

} // namespace

bool is_live_format(vk::Format format)
{
    return is_blue_first(format) || format == vk::Format::eR8G8B8A8Srgb || format == vk::Format::eR8G8B8A8Unorm;
}

void LiveCopy::record(vk::CommandBuffer commands, const Target& target)
{
    extent_ = target.extent;
    blue_first_ = is_blue_first(target.format);
    step_ = (std::max(extent_.width, extent_.height) + most_px - 1) / most_px;
    const std::uint32_t rows = std::max(1u, extent_.height / step_);
    const vk::DeviceSize row_bytes = vk::DeviceSize(4) * extent_.width;
    if (rows_.size < rows * row_bytes)
        rows_ = make_read_buffer(device_, rows * row_bytes, vk::BufferUsageFlagBits::eTransferDst);
    std::vector<vk::BufferImageCopy> regions;
    for (std::uint32_t row = 0; row < rows; ++row)
        regions.push_back({row * row_bytes, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
            {0, std::int32_t(row * step_ + step_ / 2), 0}, {extent_.width, 1, 1}});
    constexpr auto drawn = vk::ImageLayout::eColorAttachmentOptimal, copied = vk::ImageLayout::eTransferSrcOptimal;
    vk::ImageMemoryBarrier2 barrier(Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite, Stage::eTransfer,
        Access::eTransferRead, drawn, copied, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, target.image,
        {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
    commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
    commands.copyImageToBuffer(target.image, vk::ImageLayout::eTransferSrcOptimal, *rows_.buffer, regions);
    std::swap(barrier.oldLayout, barrier.newLayout);
    barrier.srcStageMask = Stage::eTransfer, barrier.srcAccessMask = {};
    barrier.dstStageMask = Stage::eColorAttachmentOutput, barrier.dstAccessMask = Access::eColorAttachmentWrite;
    vk::MemoryBarrier2 to_host(Stage::eTransfer, Access::eTransferWrite, Stage::eHost, Access::eHostRead);
    commands.pipelineBarrier2(vk::DependencyInfo({}, to_host, {}, barrier));
}

glm::ivec2 LiveCopy::take(std::vector<std::uint8_t>& rgb)
{
    const std::uint32_t step = std::exchange(step_, 0);
    if (step == 0)
        return {0, 0};
    const glm::ivec2 size(std::max(1u, extent_.width / step), std::max(1u, extent_.height / step));
    rgb.resize(3 * std::size_t(size.x) * std::size_t(size.y));
    const auto* from = static_cast<const std::uint8_t*>(rows_.mapped);
    std::uint8_t* to = rgb.data();
    for (int row = 0; row < size.y; ++row)
        for (int column = 0; column < size.x; ++column) {
            const std::uint8_t* pixel
                = from + 4 * (std::size_t(row) * extent_.width + std::size_t(column) * step + step / 2);
            *to++ = pixel[blue_first_ ? 2 : 0];
            *to++ = pixel[1];
            *to++ = pixel[blue_first_ ? 0 : 2];
        }
    return size;
}

} // namespace starbow
