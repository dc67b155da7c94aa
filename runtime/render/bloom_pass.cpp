#include "bloom_pass.h"
#include "debug.h"
#include <algorithm>

namespace starbow {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

constexpr auto drawn = Access::eColorAttachmentWrite | Access::eColorAttachmentRead;

void to_read(vk::CommandBuffer commands, const Image& picture)
{
    transition(commands, picture, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput, drawn,
        vk::ImageLayout::eShaderReadOnlyOptimal, Stage::eFragmentShader, Access::eShaderSampledRead);
}

void to_draw(vk::CommandBuffer commands, const Image& picture, bool keeps)
{
    transition(commands, picture, keeps ? vk::ImageLayout::eShaderReadOnlyOptimal : vk::ImageLayout::eUndefined,
        Stage::eFragmentShader, {}, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput, drawn);
}

} // namespace

BloomPass::BloomPass(Device& device, Pipelines& pipelines, glm::ivec2 size)
    : device_(device)
    , pipelines_(pipelines)
    , size_(size)
{
    // Down to four texels across: the widest step reaches over a good part of the viewport.
    for (glm::ivec2 s = size; pictures_.size() < 2 || (std::min(s.x, s.y) >= 4 && pictures_.size() < 12);
         s = glm::max((s + 1) / 2, 1))
        pictures_.push_back(make_image(device,
            {light_format, {std::uint32_t(s.x), std::uint32_t(s.y)},
                vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eSampled}));
    sampler_ = device.device.createSampler({{}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eNearest,
        vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge});
    name_object(device, sampler_, "bloom pass: sampler");
    const auto count = std::uint32_t(pictures_.size());
    vk::DescriptorPoolSize sizes(vk::DescriptorType::eCombinedImageSampler, 2 * count);
    pool_ = device.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, count, sizes});
    name_object(device, pool_, "bloom pass: descriptor pool");
    std::vector<vk::DescriptorSetLayout> layouts(count, *pipelines.layouts.picture_set);
    sets_ = device.device.allocateDescriptorSets({*pool_, layouts});
    for (const vk::raii::DescriptorSet& set : sets_)
        name_object(device, set, "bloom pass: descriptor set");
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
        const vk::DescriptorImageInfo images[] = {{*sampler_, *pictures_[i].view, vk::ImageLayout::eShaderReadOnlyOptimal},
            {*sampler_, *pictures_[std::min(i + 1, pictures_.size() - 1)].view, vk::ImageLayout::eShaderReadOnlyOptimal}};
        device.device.updateDescriptorSets(
            vk::WriteDescriptorSet(*sets_[i], 0, 0, vk::DescriptorType::eCombinedImageSampler, images), {});
    }
}

Target BloomPass::light() const
{
    const Image& image = pictures_.front();
    return {*image.image, *image.view, image.extent, image.format};
}

void BloomPass::begin(vk::CommandBuffer commands) const { to_draw(commands, pictures_.front(), false); }

void BloomPass::spread(vk::CommandBuffer commands, double above) const
{
    to_read(commands, pictures_.front());
    for (std::size_t i = 1; i < pictures_.size(); ++i) {
        to_draw(commands, pictures_[i], false);
        step(commands, i - 1, i, 0, above);
        to_read(commands, pictures_[i]);
    }
    // The sum of n smaller pictures counts n times, the picture itself once: each octave keeps the same share.
    for (std::size_t i = pictures_.size() - 1; i > 1; --i) {
        const double smaller = double(pictures_.size() - i);
        to_draw(commands, pictures_[i - 1], true);
        step(commands, i, i - 1, smaller / (smaller + 1), above);
        to_read(commands, pictures_[i - 1]);
    }
}

void BloomPass::step(vk::CommandBuffer commands, std::size_t from, std::size_t to, double part, double above) const
{
    const vk::Extent2D &source = pictures_[from].extent, &target = pictures_[to].extent;
    const bool up = to < from;
    vk::RenderingAttachmentInfo colour(*pictures_[to].view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
        up ? vk::AttachmentLoadOp::eLoad : vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eStore);
    shared::BloomPush push{};
    push.step = glm::vec4(1.0f / target.width, 1.0f / target.height, 0, 0);
    push.texel = glm::vec4(1.0f / source.width, 1.0f / source.height, 0, 0);
    push.part = glm::vec4(part, above, 0, 0);
    device_.begin_rendering(commands, {{}, {{0, 0}, target}, 1, 0, colour});
    set_area(commands, {0, 0}, {int(target.width), int(target.height)});
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.bloom(up, from == 0));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.layouts.picture_layout, 0, *sets_[from], {});
    commands.pushConstants<shared::BloomPush>(
        *pipelines_.layouts.picture_layout, vk::ShaderStageFlagBits::eFragment, 0, push);
    commands.draw(3, 1, 0, 0);
    device_.end_rendering(commands);
}

void BloomPass::show(
    vk::CommandBuffer commands, glm::ivec2 corner, double part, double above, bool range, vk::Format target) const
{
    shared::BloomPush push{};
    push.step = glm::vec4(1.0f / size_.x, 1.0f / size_.y, 0, 0);
    push.part = glm::vec4(part, above, corner);
    set_area(commands, corner, size_);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.bloomed(range, target));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.layouts.picture_layout, 0, *sets_.front(), {});
    commands.pushConstants<shared::BloomPush>(
        *pipelines_.layouts.picture_layout, vk::ShaderStageFlagBits::eFragment, 0, push);
    commands.draw(3, 1, 0, 0);
}

vk::DeviceSize BloomPass::memory() const
{
    vk::DeviceSize bytes = 0;
    for (const Image& picture : pictures_)
        bytes += picture.bytes;
    return bytes;
}

} // namespace starbow
