#include "panel_pass.h"
#include "debug.h"
#include <utility>

namespace starbow {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

} // namespace

PanelPass::PanelPass(Device& device, Pipelines& pipelines, std::size_t views)
    : device_(device)
    , pipelines_(pipelines)
{
    linear_ = device.device.createSampler({{}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eNearest,
        vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge});
    name_object(device, linear_, "panel pass: linear");
    const std::uint32_t count = std::uint32_t(views);
    const vk::DescriptorPoolSize size(vk::DescriptorType::eCombinedImageSampler, 2 * count);
    pool_ = device.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, count, size});
    name_object(device, pool_, "panel pass: descriptor pool");
    for (std::size_t i = 0; i < views; ++i)
        name_object(device,
            sets_.emplace_back(
                std::move(device.device.allocateDescriptorSets({*pool_, *pipelines.layouts.picture_set}).front())),
            "panel pass: descriptor set");
}

void PanelPass::hold(vk::Format format, glm::ivec2 size, std::span<const std::uint8_t> texels, const Place& place)
{
    place_ = place, light_ = nullptr;
    const vk::Extent2D extent(std::uint32_t(size.x), std::uint32_t(size.y));
    if (!*picture_.view || picture_.extent != extent || picture_.format != format) {
        picture_
            = make_image(device_, {format, extent, vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst});
        name_object(device_, picture_, "panel pass: picture");
    }
    grow(device_, texels_, texels.size(), vk::BufferUsageFlagBits::eTransferSrc);
    copy_to(texels_, std::as_bytes(texels));
    new_ = true;
}

void PanelPass::prepare(const Panel& panel, const Place& place)
{
    hold(vk::Format::eR8G8Unorm, panel.size, panel.texels, place);
}

void PanelPass::prepare(const SmallPicture& picture, const Place& place)
{
    std::vector<std::uint8_t> rgba(picture.rgb.size() / 3 * 4, 255);
    for (std::size_t i = 0; i < picture.rgb.size(); ++i)
        rgba[i / 3 * 4 + i % 3] = picture.rgb[i];
    hold(vk::Format::eR8G8B8A8Srgb, picture.size, rgba, place);
}

void PanelPass::prepare(const Image& picture, const Place& place)
{
    place_ = place, light_ = &picture;
    new_ = false;
}

void PanelPass::prepare_view(std::size_t view, const Image& map, vk::Sampler nearest)
{
    const vk::DescriptorImageInfo images[] = {{nearest, *map.view, vk::ImageLayout::eShaderReadOnlyOptimal},
        {*linear_, *shown().view, vk::ImageLayout::eShaderReadOnlyOptimal}};
    device_.device.updateDescriptorSets(
        {vk::WriteDescriptorSet(*sets_[view], 0, 0, vk::DescriptorType::eCombinedImageSampler, images[0]),
            vk::WriteDescriptorSet(*sets_[view], 1, 0, vk::DescriptorType::eCombinedImageSampler, images[1])},
        {});
}

void PanelPass::upload(vk::CommandBuffer commands)
{
    if (!std::exchange(new_, false))
        return;
    transition(commands, picture_, vk::ImageLayout::eUndefined, Stage::eFragmentShader, {},
        vk::ImageLayout::eTransferDstOptimal, Stage::eTransfer, Access::eTransferWrite);
    commands.copyBufferToImage(*texels_.buffer, *picture_.image, vk::ImageLayout::eTransferDstOptimal,
        vk::BufferImageCopy(
            0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {}, {picture_.extent.width, picture_.extent.height, 1}));
    transition(commands, picture_, vk::ImageLayout::eTransferDstOptimal, Stage::eTransfer, Access::eTransferWrite,
        vk::ImageLayout::eShaderReadOnlyOptimal, Stage::eFragmentShader, Access::eShaderSampledRead);
}

void PanelPass::draw(vk::CommandBuffer commands, std::size_t view, bool map, shared::ViewPush constants, glm::ivec2 corner,
    glm::ivec2 size, const vk::Rect2D& box, const glm::vec4& scale, vk::Format target)
{
    if (box.extent.width == 0 || box.extent.height == 0)
        return;
    constants.boost = glm::vec4(place_.half, 0, 0);
    constants.eye = scale;
    set_area(commands, corner, size);
    commands.setScissor(0, box);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics,
        pipelines_.hud(map, target, scale.z > scale.x, shown().format != vk::Format::eR8G8Unorm));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.layouts.picture_layout, 0, *sets_[view], {});
    commands.pushConstants<shared::ViewPush>(
        *pipelines_.layouts.picture_layout, vk::ShaderStageFlagBits::eFragment, 0, constants);
    commands.draw(3, 1, 0, 0);
}

} // namespace starbow
