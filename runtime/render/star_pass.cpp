#include "star_pass.h"
#include "debug.h"
#include "shaders/shared_structs.h"
#include <algorithm>

namespace starbow {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

/// A sum in 16 bits stops growing at 2,000 times a star's light, as where a million stars crowd into a few pixels, but it is
/// drawn and read in three quarters of the time. A device that can't blend 32 bits uses 16 all the same.
vk::Format summing_format(const Device& device, std::size_t stars, bool exact)
{
    constexpr std::uint32_t crowd = 100'000;
    if (!exact && stars < crowd)
        return light_format;
    const auto can = device.physical.getFormatProperties(exact_format).optimalTilingFeatures;
    return can & vk::FormatFeatureFlagBits::eColorAttachmentBlend ? exact_format : light_format;
}

} // namespace

StarPass::StarPass(Device& device, const Pipelines& pipelines, const GpuWorld& world, const SeenStars& seen, bool exact)
    : device_(device)
    , pipelines_(pipelines)
    , world_(world)
    , seen_(seen)
    , exact_(exact)
    , format_(summing_format(device, world.stars.stars.size(), exact))
{
    if (!on())
        return;
    const vk::DeviceSize step = device.properties.limits.minUniformBufferOffsetAlignment;
    stride_ = (sizeof(shared::StarConstants) + step - 1) / step * step;
    std::vector<vk::DescriptorPoolSize> sizes = {{vk::DescriptorType::eUniformBufferDynamic, 2},
        {vk::DescriptorType::eUniformBuffer, 2}, {vk::DescriptorType::eStorageBuffer, 2}};
    pool_ = device.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 2, sizes});
    name_object(device, pool_, "star pass: descriptor pool");
    for (vk::raii::DescriptorSet& set : sets_) {
        set = std::move(device.device.allocateDescriptorSets({*pool_, *pipelines.layouts.star_set}).front());
        name_object(device, set, "star pass: descriptor set");
    }
}

void StarPass::write_sets()
{
    for (std::size_t i = 0; i < sets_.size(); ++i) {
        const Buffer& black_bodies = (i == 0 ? world_.eye : world_.false_colours).black_bodies;
        const vk::DescriptorBufferInfo buffers[] = {{*constants_.buffer, 0, sizeof(shared::StarConstants)},
            {*seen_.entries().buffer, 0, VK_WHOLE_SIZE}, {*black_bodies.buffer, 0, VK_WHOLE_SIZE}};
        device_.device.updateDescriptorSets(
            {vk::WriteDescriptorSet(*sets_[i], 0, 0, vk::DescriptorType::eUniformBufferDynamic, {}, buffers[0]),
                vk::WriteDescriptorSet(*sets_[i], 1, 0, vk::DescriptorType::eStorageBuffer, {}, buffers[1]),
                vk::WriteDescriptorSet(*sets_[i], 2, 0, vk::DescriptorType::eUniformBuffer, {}, buffers[2])},
            {});
    }
}

void StarPass::bind(vk::CommandBuffer commands, std::size_t observer) const
{
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.layouts.star_layout, 1,
        *sets_[false_colours_[observer]], std::uint32_t(observer * stride_));
}

void StarPass::fit(vk::Extent2D extent, bool exact)
{
    format_ = summing_format(device_, world_.stars.stars.size(), exact_ || exact);
    if (*picture_.view && picture_.format == format_ && picture_.extent.width >= extent.width
        && picture_.extent.height >= extent.height)
        return;
    extent.width = std::max(extent.width, picture_.extent.width);
    extent.height = std::max(extent.height, picture_.extent.height);
    picture_ = {};
    picture_ = make_image(
        device_, {format_, extent, vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eSampled});
    name_object(device_, picture_, "star pass: picture");
}

void StarPass::prepare(std::span<const Observer> observers)
{
    const std::uint64_t before = constants_.serial;
    grow(device_, constants_, observers.size() * stride_, vk::BufferUsageFlagBits::eUniformBuffer);
    if (constants_.serial != before)
        write_sets();
    false_colours_.clear();
    for (std::size_t at = 0; at < observers.size(); ++at) {
        const glm::dmat3& turn = observers[at].motion_from_world;
        false_colours_.push_back(observers[at].false_colours);
        shared::StarConstants constants{};
        glm::vec4* rows[] = {&constants.row0, &constants.row1, &constants.row2};
        for (int i = 0; i < 3; ++i)
            *rows[i] = glm::vec4(turn[0][i], turn[1][i], turn[2][i], 0);
        copy_to(constants_, std::as_bytes(std::span(&constants, 1)), at * stride_);
    }
}

void StarPass::begin(vk::CommandBuffer commands, vk::Extent2D extent)
{
    transition(commands, picture_, vk::ImageLayout::eUndefined, Stage::eFragmentShader, {},
        vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
        Access::eColorAttachmentWrite | Access::eColorAttachmentRead);
    const vk::RenderingAttachmentInfo colour(*picture_.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore, vk::ClearColorValue(std::array<float, 4>{}));
    device_.begin_rendering(commands, {{}, {{0, 0}, extent}, 1, 0, colour});
}

void StarPass::draw(vk::CommandBuffer commands, std::size_t observer, glm::ivec2 corner, glm::ivec2 size, int instances,
    std::span<const StarRun> stars)
{
    bind(commands, observer);
    // The viewport is wider by the glare's radius: a point whose middle lies outside would not be drawn at all.
    const glm::ivec2 radius(STAR_REACH);
    const glm::vec2 low = corner - radius, wide = size + 2 * radius;
    commands.setViewport(0, vk::Viewport(low.x, low.y, wide.x, wide.y, 0, 1));
    commands.setScissor(0, rect_of(corner, size));
    for (const StarRun& run : stars)
        commands.draw(run.count, std::uint32_t(instances), run.first, 0);
}

void StarPass::sample(
    vk::CommandBuffer commands, std::size_t observer, glm::ivec2 corner, glm::ivec2 size, int every, bool channels) const
{
    bind(commands, observer);
    set_area(commands, corner, size);
    commands.draw(
        (std::uint32_t(world_.stars.brightest) + std::uint32_t(every) - 1) / std::uint32_t(every), 1, 0, channels ? 1 : 0);
}

void StarPass::end(vk::CommandBuffer commands)
{
    device_.end_rendering(commands);
    transition(commands, picture_, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
        Access::eColorAttachmentWrite, vk::ImageLayout::eShaderReadOnlyOptimal, Stage::eFragmentShader,
        Access::eShaderSampledRead);
}

} // namespace starbow
