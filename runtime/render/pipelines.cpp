#include "pipelines.h"
#include "debug.h"
#include "runtime/world/world.h"
#include "shaders/shared_structs.h"
#include "spirv/bloom_frag.h"
#include "spirv/bloomed_frag.h"
#include "spirv/cube_frag.h"
#include "spirv/cube_vert.h"
#include "spirv/finish_frag.h"
#include "spirv/hud_frag.h"
#include "spirv/lookup_frag.h"
#include "spirv/measure_frag.h"
#include "spirv/meter_frag.h"
#include "spirv/overlay_frag.h"
#include "spirv/pattern_frag.h"
#include "spirv/probe_frag.h"
#include "spirv/screen_vert.h"
#include "spirv/sky_frag.h"
#include "spirv/sky_vert.h"
#include "spirv/star_frag.h"
#include "spirv/star_meter_frag.h"
#include "spirv/star_vert.h"
#include "spirv/warp_frag.h"
#include <cstddef>

namespace starbow {
namespace {

using Spirv = std::span<const std::uint32_t>;

struct Pass {
    const char* name; ///< for debuggers
    Spirv vertex, fragment;
    vk::PipelineLayout layout;
    std::vector<vk::Format> targets;
    std::vector<std::uint32_t> constants; ///< constant_id is the index, in both stages
    bool depth = false, vertices = false, blend = false;
    bool points = false, added = false;
    vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
};

vk::raii::Pipeline make_pipeline(const Device& device, const Pass& pass)
{
    auto module = [&](Spirv words) { return device.device.createShaderModule({{}, words.size_bytes(), words.data()}); };
    vk::raii::ShaderModule vertex = module(pass.vertex), fragment = module(pass.fragment);
    std::vector<vk::SpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < pass.constants.size(); ++i)
        entries.push_back({i, i * 4, 4});
    vk::SpecializationInfo constants(
        std::uint32_t(entries.size()), entries.data(), pass.constants.size() * 4, pass.constants.data());
    vk::PipelineShaderStageCreateInfo stages[] = {{{}, vk::ShaderStageFlagBits::eVertex, *vertex, "main", &constants},
        {{}, vk::ShaderStageFlagBits::eFragment, *fragment, "main", &constants}};

    vk::VertexInputBindingDescription binding(0, sizeof(Vertex));
    vk::VertexInputAttributeDescription attributes[] = {{0, 0, vk::Format::eR32G32B32Sfloat, offsetof(Vertex, position)},
        {1, 0, vk::Format::eR32G32B32Sfloat, offsetof(Vertex, normal)},
        {2, 0, vk::Format::eR32G32Sfloat, offsetof(Vertex, uv)},
        {3, 0, vk::Format::eR8G8B8A8Unorm, offsetof(Vertex, colour)}};
    vk::PipelineVertexInputStateCreateInfo vertices;
    if (pass.vertices)
        vertices = vk::PipelineVertexInputStateCreateInfo({}, binding, attributes);

    vk::PipelineInputAssemblyStateCreateInfo assembly(
        {}, pass.points ? vk::PrimitiveTopology::ePointList : vk::PrimitiveTopology::eTriangleList);
    vk::PipelineViewportStateCreateInfo viewport({}, 1, nullptr, 1, nullptr);
    vk::PipelineRasterizationStateCreateInfo raster;
    raster.lineWidth = 1;
    vk::PipelineMultisampleStateCreateInfo samples({}, pass.samples);
    vk::PipelineDepthStencilStateCreateInfo depth;
    depth.depthTestEnable = pass.depth;
    depth.depthWriteEnable = pass.depth && pass.vertices;
    depth.depthCompareOp = vk::CompareOp::eGreaterOrEqual;
    vk::PipelineColorBlendAttachmentState blend;
    blend.colorWriteMask = vk::FlagTraits<vk::ColorComponentFlagBits>::allFlags;
    if (pass.blend || pass.added) {
        blend.blendEnable = true;
        blend.srcColorBlendFactor = blend.srcAlphaBlendFactor = vk::BlendFactor::eOne;
        blend.dstColorBlendFactor = blend.dstAlphaBlendFactor
            = pass.added ? vk::BlendFactor::eOne : vk::BlendFactor::eOneMinusSrcAlpha;
    }
    std::vector<vk::PipelineColorBlendAttachmentState> blends(pass.targets.size(), blend);
    vk::PipelineColorBlendStateCreateInfo blending({}, false, {}, blends);
    std::vector<vk::DynamicState> dynamic = {vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    if (pass.vertices)
        dynamic.insert(dynamic.end(), {vk::DynamicState::eCullMode, vk::DynamicState::eFrontFace});
    vk::PipelineDynamicStateCreateInfo dynamics({}, dynamic);
    vk::PipelineRenderingCreateInfo rendering(
        0, pass.targets, pass.depth ? depth_format : vk::Format::eUndefined, vk::Format::eUndefined);
    vk::GraphicsPipelineCreateInfo info(
        {}, stages, &vertices, &assembly, nullptr, &viewport, &raster, &samples, &depth, &blending, &dynamics, pass.layout);
    info.pNext = &rendering;
    vk::raii::Pipeline pipeline = device.device.createGraphicsPipeline(device.cache, info);
    name_object(device, vertex, pass.name);
    name_object(device, fragment, pass.name);
    name_object(device, pipeline, pass.name);
    return pipeline;
}

vk::raii::DescriptorSetLayout make_set_layout(
    const Device& device, vk::ShaderStageFlags stages, std::initializer_list<vk::DescriptorType> types)
{
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (vk::DescriptorType type : types)
        bindings.push_back({std::uint32_t(bindings.size()), type, 1, stages});
    return device.device.createDescriptorSetLayout({{}, bindings});
}

vk::raii::PipelineLayout make_layout(const Device& device, std::initializer_list<vk::DescriptorSetLayout> sets,
    vk::ShaderStageFlags stages, std::uint32_t push_bytes)
{
    vk::PushConstantRange push(stages, 0, push_bytes);
    return device.device.createPipelineLayout({{}, sets, push});
}

std::vector<std::uint32_t> constants(const WarpVariant& v)
{
    constexpr std::uint32_t of_the_pass = 0; // constant_id 10 has a meaning of its own in each pass
    return {v.map, v.aberration, v.doppler, v.headlight, v.mips, v.channels, v.reproject, v.turning, v.stars, v.linear,
        of_the_pass, std::uint32_t(v.numbers.reflected), std::uint32_t(v.numbers.own), v.by_table, v.layered, v.galilean,
        v.single, std::uint32_t(v.rays), v.cut};
}

/// The pipeline of a key; a new one comes from `make`.
template <class Key, class Make>
vk::Pipeline find_or_make(std::map<Key, vk::raii::Pipeline>& made, const Key& key, Make&& make)
{
    auto at = made.find(key);
    if (at == made.end())
        at = made.emplace(key, make()).first;
    return *at->second;
}

} // namespace

Pipelines::Pipelines(Device& device)
    : device_(device)
{
    using Type = vk::DescriptorType;
    constexpr auto fragment = vk::ShaderStageFlagBits::eFragment;
    constexpr auto both = fragment | vk::ShaderStageFlagBits::eVertex;
    constexpr Type picture = Type::eCombinedImageSampler;
    constexpr Type constants = Type::eUniformBuffer;
    eye_set = make_set_layout(device, both,
        {Type::eUniformBufferDynamic, Type::eStorageBuffer, Type::eStorageBuffer, constants, Type::eStorageBuffer});
    material_set = make_set_layout(device, fragment, {picture, picture});
    warp_set = make_set_layout(device, both,
        {picture, picture, Type::eUniformTexelBuffer, Type::eUniformTexelBuffer, picture, picture, picture, picture, picture,
            picture, constants, picture, constants});
    star_set = make_set_layout(
        device, vk::ShaderStageFlagBits::eVertex, {Type::eUniformBufferDynamic, Type::eStorageBuffer, constants});
    picture_set = make_set_layout(device, fragment, {picture, picture});
    overlay_set = make_set_layout(device, fragment, {constants});
    finish_set = make_set_layout(device, fragment, {picture, picture, picture, picture, picture});
    surface_layout = make_layout(device, {*eye_set, *material_set}, both, sizeof(shared::CubePush));
    warp_layout = make_layout(device, {*warp_set}, fragment, sizeof(shared::ViewPush));
    star_layout = make_layout(device, {*warp_set, *star_set}, both, sizeof(shared::ViewPush));
    overlay_layout = make_layout(device, {*warp_set, *overlay_set}, fragment, sizeof(shared::ViewPush));
    picture_layout = make_layout(device, {*picture_set}, fragment, sizeof(shared::ViewPush));
    finish_layout = make_layout(device, {*finish_set}, fragment, sizeof(shared::FinishPush));
    name_object(device, eye_set, "eye descriptor set layout");
    name_object(device, material_set, "material descriptor set layout");
    name_object(device, warp_set, "warp descriptor set layout");
    name_object(device, star_set, "star descriptor set layout");
    name_object(device, picture_set, "picture descriptor set layout");
    name_object(device, overlay_set, "overlay descriptor set layout");
    name_object(device, finish_set, "finish descriptor set layout");
    name_object(device, surface_layout, "surface pipeline layout");
    name_object(device, warp_layout, "warp pipeline layout");
    name_object(device, star_layout, "star pipeline layout");
    name_object(device, overlay_layout, "overlay pipeline layout");
    name_object(device, picture_layout, "picture pipeline layout");
    name_object(device, finish_layout, "finish pipeline layout");
}

std::size_t Pipelines::count() const
{
    return surfaces_.size() + skies_.size() + warps_.size() + stars_.size() + measures_.size() + probes_.size()
        + meters_.size() + star_meters_.size() + overlays_.size() + huds_.size() + blooms_.size() + lookups_.size()
        + bloomed_.size() + finishes_.size() + patterns_.size();
}

vk::Pipeline Pipelines::surface(const SurfaceVariant& v, const TargetKind& target)
{
    return find_or_make(surfaces_, std::pair(v, target), [&] {
        return make_pipeline(device_,
            {.name = "surface pipeline",
                .vertex = cube_vert,
                .fragment = cube_frag,
                .layout = *surface_layout,
                .targets = {target.colours.begin(), target.colours.end()},
                .constants = {v.base_texture, v.emissive_texture, v.masked, v.unlit, std::uint32_t(v.lights),
                    std::uint32_t(v.numbers.reflected), std::uint32_t(v.numbers.own), std::uint32_t(v.kinds), v.matrices,
                    v.clock, v.finite_existence, v.layered, v.lamps_move, v.blink, v.moves},
                .depth = true,
                .vertices = true,
                .samples = target.samples});
    });
}

vk::Pipeline Pipelines::sky(const TargetKind& target)
{
    return find_or_make(skies_, target, [&] {
        return make_pipeline(device_,
            {.name = "sky pipeline",
                .vertex = sky_vert,
                .fragment = sky_frag,
                .layout = *surface_layout,
                .targets = {target.colours.begin(), target.colours.end()},
                .constants = {std::uint32_t(target.colours.size())},
                .depth = true,
                .samples = target.samples});
    });
}

vk::Pipeline Pipelines::warp(const WarpVariant& v, vk::Format target)
{
    return find_or_make(warps_, std::pair(v, target), [&] {
        std::vector<std::uint32_t> all = constants(v);
        all[10] = target != light_format; // 8 bits need dither
        return make_pipeline(device_,
            {.name = "warp pipeline",
                .vertex = screen_vert,
                .fragment = warp_frag,
                .layout = *warp_layout,
                .targets = {target},
                .constants = all});
    });
}

vk::Pipeline Pipelines::stars(const WarpVariant& v, vk::Format target)
{
    return find_or_make(stars_, std::pair(v, target), [&] {
        return make_pipeline(device_,
            {.name = "stars pipeline",
                .vertex = star_vert,
                .fragment = star_frag,
                .layout = *star_layout,
                .targets = {target},
                .constants = constants(v),
                .points = true,
                .added = true});
    });
}

vk::Pipeline Pipelines::measure(const WarpVariant& v)
{
    return find_or_make(measures_, v, [&] {
        return make_pipeline(device_,
            {.name = "measure pipeline",
                .vertex = screen_vert,
                .fragment = measure_frag,
                .layout = *warp_layout,
                .targets = {exact_format, exact_format, exact_format},
                .constants = constants(v)});
    });
}

vk::Pipeline Pipelines::probe(const WarpVariant& v)
{
    return find_or_make(probes_, v, [&] {
        return make_pipeline(device_,
            {.name = "probe pipeline",
                .vertex = screen_vert,
                .fragment = probe_frag,
                .layout = *warp_layout,
                .targets = {exact_format, exact_format, exact_format},
                .constants = constants(v)});
    });
}

vk::Pipeline Pipelines::overlay(const WarpVariant& v, int overlay, vk::Format target)
{
    return find_or_make(overlays_, std::tuple(v, overlay, target), [&] {
        std::vector<std::uint32_t> all = constants(v);
        all[10] = std::uint32_t(overlay);
        return make_pipeline(device_,
            {.name = "overlay pipeline",
                .vertex = screen_vert,
                .fragment = overlay_frag,
                .layout = *overlay_layout,
                .targets = {target},
                .constants = all,
                .blend = true});
    });
}

vk::Pipeline Pipelines::meter(const WarpVariant& v)
{
    return find_or_make(meters_, v, [&] {
        return make_pipeline(device_,
            {.name = "meter pipeline",
                .vertex = screen_vert,
                .fragment = meter_frag,
                .layout = *warp_layout,
                .targets = {meter_format},
                .constants = constants(v)});
    });
}

vk::Pipeline Pipelines::star_meter(const WarpVariant& v)
{
    return find_or_make(star_meters_, v, [&] {
        std::vector<std::uint32_t> all = constants(v);
        all[10] = true; // the meter reads one ray for each sample
        return make_pipeline(device_,
            {.name = "star meter pipeline",
                .vertex = star_vert,
                .fragment = star_meter_frag,
                .layout = *star_layout,
                .targets = {meter_format},
                .constants = all,
                .points = true});
    });
}

vk::Pipeline Pipelines::bloom(bool up)
{
    return find_or_make(blooms_, up, [&] {
        return make_pipeline(device_,
            {.name = "bloom pipeline",
                .vertex = screen_vert,
                .fragment = bloom_frag,
                .layout = *picture_layout,
                .targets = {light_format},
                .constants = {up},
                .blend = up});
    });
}

vk::Pipeline Pipelines::bloomed(vk::Format target)
{
    return find_or_make(bloomed_, target, [&] {
        return make_pipeline(device_,
            {.name = "bloomed pipeline",
                .vertex = screen_vert,
                .fragment = bloomed_frag,
                .layout = *picture_layout,
                .targets = {target},
                .constants = {target != light_format}});
    });
}

vk::Pipeline Pipelines::hud(bool map, vk::Format target, bool scale)
{
    return find_or_make(huds_, std::tuple(map, target, scale), [&] {
        return make_pipeline(device_,
            {.name = "hud pipeline",
                .vertex = screen_vert,
                .fragment = hud_frag,
                .layout = *picture_layout,
                .targets = {target},
                .constants = {map, scale},
                .blend = true});
    });
}

vk::Pipeline Pipelines::lookup(vk::Format target)
{
    return find_or_make(lookups_, target, [&] {
        return make_pipeline(device_,
            {.name = "lookup pipeline",
                .vertex = screen_vert,
                .fragment = lookup_frag,
                .layout = *picture_layout,
                .targets = {target},
                .constants = {false}});
    });
}

vk::Pipeline Pipelines::finish(const FinishVariant& v, vk::Format target)
{
    return find_or_make(finishes_, std::pair(v, target), [&] {
        return make_pipeline(device_,
            {.name = "finish pipeline",
                .vertex = screen_vert,
                .fragment = finish_frag,
                .layout = *finish_layout,
                .targets = {target},
                .constants = {std::uint32_t(v.combine), v.masked, std::uint32_t(v.curve), v.dithered}});
    });
}

vk::Pipeline Pipelines::pattern(bool map, int pattern, vk::Format target)
{
    return find_or_make(patterns_, std::tuple(map, pattern, target), [&] {
        return make_pipeline(device_,
            {.name = "pattern pipeline",
                .vertex = screen_vert,
                .fragment = pattern_frag,
                .layout = *picture_layout,
                .targets = {target},
                .constants = {map, std::uint32_t(pattern)}});
    });
}

} // namespace starbow
