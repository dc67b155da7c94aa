#include "scaled_picture.h"
#include "debug.h"

namespace starbow {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

} // namespace

ScaledPicture::ScaledPicture(Device& device, Pipelines& pipelines, glm::ivec2 size, vk::Format format)
    : device_(device)
    , pipelines_(pipelines)
    , image_(make_image(device,
          {.format = format,
              .extent = {std::uint32_t(size.x), std::uint32_t(size.y)},
              .usage = vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eSampled}))
{
    name_object(device, image_, "scaled picture");
    sampler_ = device.device.createSampler({{}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eNearest,
        vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge});
    name_object(device, sampler_, "scaled picture: sampler");
    const vk::DescriptorPoolSize sizes(vk::DescriptorType::eCombinedImageSampler, 2);
    pool_ = device.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes});
    name_object(device, pool_, "scaled picture: descriptor pool");
    set_ = std::move(device.device.allocateDescriptorSets({*pool_, *pipelines.layouts.picture_set}).front());
    name_object(device, set_, "scaled picture: descriptor set");
    const vk::DescriptorImageInfo picture(*sampler_, *image_.view, vk::ImageLayout::eShaderReadOnlyOptimal);
    const vk::DescriptorImageInfo pictures[] = {picture, picture}; // the shader reads the first
    device.device.updateDescriptorSets(
        vk::WriteDescriptorSet(*set_, 0, 0, vk::DescriptorType::eCombinedImageSampler, pictures), {});
}

void ScaledPicture::draw(vk::CommandBuffer commands, const Target& window) const
{
    transition(commands, image_, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
        Access::eColorAttachmentWrite, vk::ImageLayout::eShaderReadOnlyOptimal, Stage::eFragmentShader,
        Access::eShaderSampledRead);
    const vk::RenderingAttachmentInfo colour(window.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eStore);
    device_.begin_rendering(commands, {{}, {{0, 0}, window.extent}, 1, 0, colour});
    set_area(commands, {0, 0}, {window.extent.width, window.extent.height});
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.scaled(window.format));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.layouts.picture_layout, 0, *set_, {});
    shared::ViewPush constants{};
    constants.zenith = glm::vec4(0, 0, window.extent.width, window.extent.height);
    commands.pushConstants<shared::ViewPush>(
        *pipelines_.layouts.picture_layout, vk::ShaderStageFlagBits::eFragment, 0, constants);
    commands.draw(3, 1, 0, 0);
    device_.end_rendering(commands);
    transition(commands, image_, vk::ImageLayout::eShaderReadOnlyOptimal, Stage::eFragmentShader, {},
        vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite);
}

} // namespace starbow
