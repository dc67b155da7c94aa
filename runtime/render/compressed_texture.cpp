#include "compressed_texture.h"
#include "debug.h"

namespace starbow {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

namespace {

/// Blocks of one level, and the level's own view.
struct Level {
    vk::Extent2D texels, blocks;
    vk::raii::ImageView view = nullptr;
    vk::raii::DescriptorSet set = nullptr;
};

vk::Extent2D blocks_of(vk::Extent2D texels) { return {(texels.width + 3) / 4, (texels.height + 3) / 4}; }

std::vector<Level> levels_of(
    Device& device, Pipelines& pipelines, const Image& picture, vk::Sampler sampler, vk::DescriptorPool pool)
{
    std::vector<Level> levels(picture.levels);
    const vk::DescriptorSetLayout layout = *pipelines.layouts.picture_set;
    for (std::uint32_t i = 0; i < picture.levels; ++i) {
        Level& level = levels[i];
        level.texels = vk::Extent2D(std::max(picture.extent.width >> i, 1u), std::max(picture.extent.height >> i, 1u));
        level.blocks = blocks_of(level.texels);
        level.view = device.device.createImageView(
            {{}, *picture.image, vk::ImageViewType::e2D, picture.format, {}, {vk::ImageAspectFlagBits::eColor, i, 1, 0, 1}});
        name_object(device, level.view, "compressed texture: level");
        level.set = std::move(device.device.allocateDescriptorSets({pool, layout}).front());
        name_object(device, level.set, "compressed texture: descriptor set");
        const vk::DescriptorImageInfo image(sampler, *level.view, vk::ImageLayout::eShaderReadOnlyOptimal);
        const vk::DescriptorImageInfo images[] = {image, image}; // the shader reads the first
        device.device.updateDescriptorSets(
            vk::WriteDescriptorSet(*level.set, 0, 0, vk::DescriptorType::eCombinedImageSampler, images), {});
    }
    return levels;
}

/// Copies before this have done the first access before those after it do the second.
void wait_for(vk::CommandBuffer commands, vk::AccessFlags2 first, vk::AccessFlags2 second)
{
    const vk::MemoryBarrier2 barrier(Stage::eTransfer, first, Stage::eTransfer, second);
    commands.pipelineBarrier2(vk::DependencyInfo({}, barrier));
}

} // namespace

Image compressed(Device& device, Pipelines& pipelines, const Image& picture, MemoryArena& arena)
{
    const bool colours = picture.format == vk::Format::eR8G8B8A8Srgb;
    Image made = make_image(device,
        {.format = colours ? compressed_colours : compressed_numbers,
            .extent = picture.extent,
            .usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst,
            .levels = picture.levels,
            .arena = &arena});
    const Image blocks = make_image(device,
        {.format = words_format,
            .extent = blocks_of(picture.extent),
            .usage = vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc});
    name_object(device, blocks, "compressed texture: blocks");
    // A copy between the images themselves would do, but for the edges of levels that no whole block fits.
    const Buffer between = make_read_buffer(device, vk::DeviceSize(16) * blocks.extent.width * blocks.extent.height,
        vk::BufferUsageFlagBits::eTransferSrc | vk::BufferUsageFlagBits::eTransferDst);
    name_object(device, between, "compressed texture: blocks between images");
    const vk::raii::Sampler sampler = device.device.createSampler({});
    name_object(device, sampler, "compressed texture: sampler");
    const vk::DescriptorPoolSize sizes(vk::DescriptorType::eCombinedImageSampler, 2 * picture.levels);
    const vk::raii::DescriptorPool pool
        = device.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, picture.levels, sizes});
    name_object(device, pool, "compressed texture: descriptor pool");
    const std::vector<Level> levels = levels_of(device, pipelines, picture, *sampler, *pool);
    const vk::Pipeline pipeline = pipelines.compress(colours);
    device.now([&](vk::CommandBuffer commands) {
        transition(commands, made, vk::ImageLayout::eUndefined, Stage::eNone, {}, vk::ImageLayout::eTransferDstOptimal,
            Stage::eTransfer, Access::eTransferWrite);
        for (std::uint32_t i = 0; i < levels.size(); ++i) {
            const Level& level = levels[i];
            transition(commands, blocks, vk::ImageLayout::eUndefined, Stage::eTransfer, {},
                vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite);
            const vk::RenderingAttachmentInfo target(*blocks.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
                vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eStore);
            device.begin_rendering(commands, {{}, {{0, 0}, level.blocks}, 1, 0, target});
            commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
            commands.bindDescriptorSets(
                vk::PipelineBindPoint::eGraphics, *pipelines.layouts.picture_layout, 0, *level.set, {});
            set_area(commands, {0, 0}, {int(level.blocks.width), int(level.blocks.height)});
            commands.draw(3, 1, 0, 0);
            device.end_rendering(commands);
            transition(commands, blocks, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
                Access::eColorAttachmentWrite, vk::ImageLayout::eTransferSrcOptimal, Stage::eTransfer,
                Access::eTransferRead);
            commands.copyImageToBuffer(*blocks.image, vk::ImageLayout::eTransferSrcOptimal, *between.buffer,
                vk::BufferImageCopy(
                    0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {}, {level.blocks.width, level.blocks.height, 1}));
            wait_for(commands, Access::eTransferWrite, Access::eTransferRead);
            commands.copyBufferToImage(*between.buffer, *made.image, vk::ImageLayout::eTransferDstOptimal,
                vk::BufferImageCopy(
                    0, 0, 0, {vk::ImageAspectFlagBits::eColor, i, 0, 1}, {}, {level.texels.width, level.texels.height, 1}));
            wait_for(commands, Access::eTransferRead, Access::eTransferWrite);
        }
        transition(commands, made, vk::ImageLayout::eTransferDstOptimal, Stage::eTransfer, Access::eTransferWrite,
            vk::ImageLayout::eShaderReadOnlyOptimal, Stage::eFragmentShader, Access::eShaderSampledRead);
    });
    return made;
}

} // namespace starbow
