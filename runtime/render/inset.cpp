#include "inset.h"
#include "debug.h"

namespace starbow {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

Layout small_layout(int width)
{
    Output output;
    output.name = "inset";
    output.size = {width, int(width * Inset::aspect)};
    output.viewports = {{.projection = Planar{.fov_y_deg = Inset::fov_y_deg}}};
    Layout layout;
    layout.outputs = {output};
    return layout;
}

} // namespace

Inset::Inset(Device& device, Pipelines& pipelines, const GpuWorld& world, const Quality& quality, int width)
    : picture_(make_image(device,
        {vk::Format::eR8G8B8A8Srgb, {std::uint32_t(width), std::uint32_t(int(width * aspect))},
            vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eSampled}))
    , frame_(device, pipelines, world, small_layout(width), quality)
{
    name_object(device, picture_, "inset: picture");
}

void Inset::record(vk::CommandBuffer commands, const Shot& shot)
{
    transition(commands, picture_, vk::ImageLayout::eUndefined, Stage::eFragmentShader, {},
        vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite);
    const Target target{*picture_.image, *picture_.view, picture_.extent, picture_.format};
    frame_.draw(commands, shot, nullptr, {&target, 1});
    transition(commands, picture_, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
        Access::eColorAttachmentWrite, vk::ImageLayout::eShaderReadOnlyOptimal, Stage::eFragmentShader,
        Access::eShaderSampledRead);
}

} // namespace starbow
