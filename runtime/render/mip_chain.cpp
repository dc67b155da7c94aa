#include "mip_chain.h"
#include "debug.h"

namespace starbow {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

MipChain::MipChain(Device& device, Pipelines& pipelines, const Image& image)
    : device_(device)
    , pipelines_(pipelines)
    , image_(image)
{
    sampler_ = device.device.createSampler({{}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eNearest,
        vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge});
    name_object(device, sampler_, "mip chain: sampler");
    for (std::uint32_t level = 0; level < image.levels; ++level) {
        views_.push_back(device.device.createImageView({{}, *image.image, vk::ImageViewType::e2D, image.format, {},
            {vk::ImageAspectFlagBits::eColor, level, 1, 0, 1}}));
        name_object(device, views_.back(), "mip chain: level");
    }
    if (image.levels < 2)
        return;
    const std::uint32_t count = image.levels - 1;
    const vk::DescriptorPoolSize sizes(vk::DescriptorType::eCombinedImageSampler, 2 * count);
    pool_ = device.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, count, sizes});
    name_object(device, pool_, "mip chain: descriptor pool");
    const std::vector<vk::DescriptorSetLayout> layouts(count, *pipelines.layouts.picture_set);
    sets_ = device.device.allocateDescriptorSets({*pool_, layouts});
    for (std::uint32_t level = 0; level < count; ++level) {
        name_object(device, sets_[level], "mip chain: descriptor set");
        const vk::DescriptorImageInfo finer(*sampler_, *views_[level], vk::ImageLayout::eShaderReadOnlyOptimal);
        const vk::DescriptorImageInfo images[] = {finer, finer}; // the shader reads the first
        device.device.updateDescriptorSets(
            vk::WriteDescriptorSet(*sets_[level], 0, 0, vk::DescriptorType::eCombinedImageSampler, images), {});
    }
}

void MipChain::barrier(vk::CommandBuffer commands, vk::ImageLayout from, vk::ImageLayout to) const
{
    const bool drawn = from == vk::ImageLayout::eColorAttachmentOptimal;
    constexpr auto readers = Stage::eVertexShader | Stage::eFragmentShader;
    const vk::ImageMemoryBarrier2 barrier(drawn ? Stage::eColorAttachmentOutput : readers | Stage::eColorAttachmentOutput,
        drawn ? Access::eColorAttachmentWrite : Access::eNone, drawn ? readers : Stage::eColorAttachmentOutput,
        drawn ? Access::eShaderSampledRead : Access::eColorAttachmentWrite, from, to, VK_QUEUE_FAMILY_IGNORED,
        VK_QUEUE_FAMILY_IGNORED, *image_.image, {vk::ImageAspectFlagBits::eColor, level_, 1, 0, 1});
    commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
}

void MipChain::begin(vk::CommandBuffer commands, std::uint32_t level) const
{
    level_ = level;
    barrier(commands, vk::ImageLayout::eUndefined, vk::ImageLayout::eColorAttachmentOptimal);
    const vk::RenderingAttachmentInfo colour(*views_[level], vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eStore);
    const vk::Extent2D extent(std::max(image_.extent.width >> level, 1u), std::max(image_.extent.height >> level, 1u));
    device_.begin_rendering(commands, {{}, {{0, 0}, extent}, 1, 0, colour});
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.mip(image_.format));
    commands.bindDescriptorSets(
        vk::PipelineBindPoint::eGraphics, *pipelines_.layouts.picture_layout, 0, *sets_[level - 1], {});
}

void MipChain::halve(vk::CommandBuffer commands, glm::ivec2 corner, glm::ivec2 size) const
{
    set_area(commands, corner, size);
    commands.draw(3, 1, 0, 0);
}

void MipChain::end(vk::CommandBuffer commands) const
{
    device_.end_rendering(commands);
    barrier(commands, vk::ImageLayout::eColorAttachmentOptimal, vk::ImageLayout::eShaderReadOnlyOptimal);
}

void MipChain::draw_all(vk::CommandBuffer commands) const
{
    for (std::uint32_t level = 1; level < image_.levels; ++level) {
        begin(commands, level);
        halve(commands, {0, 0},
            {std::max(int(image_.extent.width >> level), 1), std::max(int(image_.extent.height >> level), 1)});
        end(commands);
    }
}

} // namespace starbow
