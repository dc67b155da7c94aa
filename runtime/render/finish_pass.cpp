#include "finish_pass.h"
#include "debug.h"
#include "displays/finish/anaglyph.h"
#include <glm/gtc/packing.hpp>

namespace starbow {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

int combine_of(Packing packing)
{
    switch (packing) {
    case Packing::rows:
        return 1;
    case Packing::columns:
        return 2;
    case Packing::checkerboard:
        return 3;
    case Packing::anaglyph_red_cyan:
    case Packing::anaglyph_dubois:
    case Packing::anaglyph_amber_blue:
        return 4;
    default:
        return 0;
    }
}

Image shade_texture(Device& device, glm::ivec2 size, const std::vector<glm::vec3>& values)
{
    std::vector<glm::u16vec4> halves;
    halves.reserve(values.size());
    for (const glm::vec3& v : values)
        halves.push_back(glm::packHalf(glm::vec4(v, 1)));
    return make_texture(device, vk::Format::eR16G16B16A16Sfloat, size, std::as_bytes(std::span(halves)), false);
}

} // namespace

bool needs_finish(const Output& output, const Shade& shade)
{
    const Colour& colour = output.colour;
    return canvas_count(output.packing) > 1 || colour.matrix != glm::dmat3(1) || colour.gamma != 0 || !colour.lut.empty()
        || !shade.empty() || !shade.shares.empty();
}

FinishPass::FinishPass(Device& device, Pipelines& pipelines, const Output& output, const Shade& shade, double headroom)
    : device_(device)
    , pipelines_(pipelines)
{
    const vk::Extent2D extent(std::uint32_t(output.size.x), std::uint32_t(output.size.y));
    using Usage = vk::ImageUsageFlagBits;
    for (int i = 0; i < starbow::canvas_count(output.packing); ++i)
        for (std::vector<Image>* images : {&canvases_, &sums_})
            if (images == &canvases_ || !shade.shares.empty())
                images->push_back(make_image(device, {light_format, extent, Usage::eColorAttachment | Usage::eSampled}));

    const Colour& colour = output.colour;
    variant_.combine = combine_of(output.packing);
    variant_.screened = !shade.empty() || headroom != 1;
    variant_.curve = !colour.lut.empty() ? 2 : colour.gamma != 0 ? 1 : 0;
    glm::dmat3 left = colour.matrix, right(0);
    if (variant_.combine == 4) {
        const Anaglyph mixed = *anaglyph(output.packing);
        left = colour.matrix * mixed.left;
        right = colour.matrix * mixed.right;
    }
    push_.left0 = shared::row(left, 0), push_.left1 = shared::row(left, 1), push_.left2 = shared::row(left, 2);
    push_.right0 = shared::row(right, 0), push_.right1 = shared::row(right, 1), push_.right2 = shared::row(right, 2);
    const double curve = variant_.curve == 2 ? double(colour.lut.size() - 1) : variant_.curve == 1 ? 1 / colour.gamma : 0;
    push_.curve = glm::vec4(curve, headroom, 0, 0);

    const std::vector<glm::vec3> one(1, glm::vec3(1)), none(1, glm::vec3(0));
    weight_ = shade.weight.empty() ? shade_texture(device, {1, 1}, one) : shade_texture(device, shade.size, shade.weight);
    black_ = shade.black.empty() ? shade_texture(device, {1, 1}, none) : shade_texture(device, shade.size, shade.black);
    std::vector<glm::vec4> entries;
    for (const glm::dvec3& entry : colour.lut)
        entries.emplace_back(entry, 1);
    if (entries.empty())
        entries.resize(2);
    table_ = make_texture(device, exact_format, {int(entries.size()), 1}, std::as_bytes(std::span(entries)), false);
    name_object(device, table_, "finish pass: table");

    sampler_ = device.device.createSampler({});
    name_object(device, sampler_, "finish pass: sampler");
    const auto layer_sets = std::uint32_t(shade.shares.size());
    vk::DescriptorPoolSize size(vk::DescriptorType::eCombinedImageSampler, 5 + 2 * layer_sets);
    pool_ = device.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1 + layer_sets, size});
    name_object(device, pool_, "finish pass: descriptor pool");
    set_ = std::move(device.device.allocateDescriptorSets({*pool_, *pipelines.layouts.finish_set}).front());
    name_object(device, set_, "finish pass: descriptor set");
    std::vector<vk::DescriptorImageInfo> images;
    std::vector<Image>& pictures = sums_.empty() ? canvases_ : sums_;
    for (const Image* image : {&pictures.front(), &pictures.back(), &weight_, &black_, &table_})
        images.push_back({*sampler_, *image->view, vk::ImageLayout::eShaderReadOnlyOptimal});
    std::vector<vk::WriteDescriptorSet> writes;
    for (std::uint32_t i = 0; i < images.size(); ++i)
        writes.push_back({*set_, i, 0, 1, vk::DescriptorType::eCombinedImageSampler, &images[i]});
    device.device.updateDescriptorSets(writes, {});
    make_layers(shade);
}

void FinishPass::make_layers(const Shade& shade)
{
    layers_ = std::size_t(shade.layers);
    for (std::size_t i = 0; i < shade.shares.size(); ++i) {
        std::vector<glm::u16vec4> halves;
        halves.reserve(shade.shares[i].size());
        for (const glm::vec4& share : shade.shares[i])
            halves.push_back(glm::packHalf(share));
        shares_.push_back(make_texture(device_, light_format, shade.size, std::as_bytes(std::span(halves)), false));
        name_object(device_, shares_.back(), "finish pass: shares");
        layer_sets_.push_back(
            std::move(device_.device.allocateDescriptorSets({*pool_, *pipelines_.layouts.picture_set}).front()));
        name_object(device_, layer_sets_.back(), "finish pass: descriptor set");
        const vk::DescriptorImageInfo images[]
            = {{*sampler_, *canvases_[i / layers_].view, vk::ImageLayout::eShaderReadOnlyOptimal},
                {*sampler_, *shares_.back().view, vk::ImageLayout::eShaderReadOnlyOptimal}};
        device_.device.updateDescriptorSets(
            vk::WriteDescriptorSet(*layer_sets_.back(), 0, 0, vk::DescriptorType::eCombinedImageSampler, images), {});
    }
}

const Image* FinishPass::shares(const View& view) const
{
    return shares_.empty() ? nullptr : &shares_[std::size_t(view.canvas) * layers_ + std::size_t(view.layer)];
}

Target FinishPass::canvas(std::size_t i) const
{
    const Image& image = canvases_[i];
    return {*image.image, *image.view, image.extent, image.format};
}

void FinishPass::begin(vk::CommandBuffer commands)
{
    for (const Image& picture : canvases_)
        transition(commands, picture, vk::ImageLayout::eUndefined, Stage::eFragmentShader, {},
            vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
            Access::eColorAttachmentWrite | Access::eColorAttachmentRead);
}

void FinishPass::end(vk::CommandBuffer commands, std::size_t layer, bool plain)
{
    constexpr auto drawn = Access::eColorAttachmentWrite | Access::eColorAttachmentRead;
    for (std::size_t canvas = 0; canvas < sums_.size(); ++canvas) {
        const Image &from = canvases_[canvas], &to = sums_[canvas];
        transition(commands, from, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput, drawn,
            vk::ImageLayout::eShaderReadOnlyOptimal, Stage::eFragmentShader, Access::eShaderSampledRead);
        if (layer == 0)
            transition(commands, to, vk::ImageLayout::eUndefined, Stage::eFragmentShader, {},
                vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput, drawn);
        else
            transition(commands, to, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput, drawn,
                vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput, drawn);
        const vk::RenderingAttachmentInfo colour(*to.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
            layer == 0 ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eLoad, vk::AttachmentStoreOp::eStore,
            vk::ClearColorValue(std::array<float, 4>{0, 0, 0, 1}));
        device_.begin_rendering(commands, {{}, {{0, 0}, to.extent}, 1, 0, colour});
        set_area(commands, {0, 0}, {int(to.extent.width), int(to.extent.height)});
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.layer(plain));
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.layouts.picture_layout, 0,
            *layer_sets_[canvas * layers_ + layer], {});
        commands.draw(3, 1, 0, 0);
        device_.end_rendering(commands);
    }
}

void FinishPass::record(vk::CommandBuffer commands, const Target& target, bool plain)
{
    for (const Image& picture : sums_.empty() ? canvases_ : sums_)
        transition(commands, picture, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
            Access::eColorAttachmentWrite, vk::ImageLayout::eShaderReadOnlyOptimal, Stage::eFragmentShader,
            Access::eShaderSampledRead);
    FinishVariant variant = variant_;
    variant.screened = variant.screened && !plain;
    variant.dithered = !plain; // a pattern's steps are exact
    vk::RenderingAttachmentInfo colour(target.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eStore);
    device_.begin_rendering(commands, {{}, {{0, 0}, target.extent}, 1, 0, colour});
    set_area(commands, {0, 0}, {int(target.extent.width), int(target.extent.height)});
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.finish(variant, target.format));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.layouts.finish_layout, 0, *set_, {});
    commands.pushConstants<shared::FinishPush>(
        *pipelines_.layouts.finish_layout, vk::ShaderStageFlagBits::eFragment, 0, push_);
    commands.draw(3, 1, 0, 0);
    device_.end_rendering(commands);
}

vk::DeviceSize FinishPass::memory() const
{
    vk::DeviceSize bytes = weight_.bytes + black_.bytes + table_.bytes;
    for (const std::vector<Image>* images : {&canvases_, &sums_, &shares_})
        for (const Image& image : *images)
            bytes += image.bytes;
    return bytes;
}

} // namespace starbow
