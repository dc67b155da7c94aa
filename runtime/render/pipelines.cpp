#include "pipelines.h"
#include "debug.h"
#include "runtime/world/world.h"
#include "shaders/shared_structs.h"
#include "spirv/bloom_frag.h"
#include "spirv/bloomed_frag.h"
#include "spirv/compress_frag.h"
#include "spirv/cube_frag.h"
#include "spirv/cube_mapped_frag.h"
#include "spirv/cube_mapped_vert.h"
#include "spirv/cube_vert.h"
#include "spirv/fade_frag.h"
#include "spirv/finish_frag.h"
#include "spirv/hud_frag.h"
#include "spirv/layer_frag.h"
#include "spirv/lookup_frag.h"
#include "spirv/measure_frag.h"
#include "spirv/measure_globes_frag.h"
#include "spirv/measure_one_frame_frag.h"
#include "spirv/measure_own_eye_frag.h"
#include "spirv/meter_frag.h"
#include "spirv/meter_globes_frag.h"
#include "spirv/meter_one_frame_frag.h"
#include "spirv/meter_own_eye_frag.h"
#include "spirv/mip_frag.h"
#include "spirv/overlay_frag.h"
#include "spirv/overlay_globes_frag.h"
#include "spirv/overlay_one_frame_frag.h"
#include "spirv/overlay_own_eye_frag.h"
#include "spirv/pattern_frag.h"
#include "spirv/probe_frag.h"
#include "spirv/probe_globes_frag.h"
#include "spirv/probe_one_frame_frag.h"
#include "spirv/probe_own_eye_frag.h"
#include "spirv/scaled_frag.h"
#include "spirv/screen_vert.h"
#include "spirv/sky_frag.h"
#include "spirv/sky_vert.h"
#include "spirv/star_flat_vert.h"
#include "spirv/star_frag.h"
#include "spirv/star_globes_vert.h"
#include "spirv/star_meter_frag.h"
#include "spirv/star_one_frame_vert.h"
#include "spirv/star_own_eye_vert.h"
#include "spirv/star_vert.h"
#include "spirv/vignette_frag.h"
#include "spirv/warp_dark_frag.h"
#include "spirv/warp_frag.h"
#include "spirv/warp_globes_frag.h"
#include "spirv/warp_one_frame_frag.h"
#include "spirv/warp_own_eye_frag.h"
#include "spirv/warp_rays_frag.h"
#include "spirv/warp_rays_globes_frag.h"
#include "spirv/warp_rays_one_frame_frag.h"
#include "spirv/warp_rays_own_eye_frag.h"
#include <algorithm>
#include <cstddef>

namespace starbow {

using Spirv = std::span<const std::uint32_t>;

namespace {

#define STARBOW_VALUE(id, type, NAME, member, usual) {Constant::member, v.member},

SpecializationConstants with(SpecializationConstants all, const CoefficientCounts& v)
{
    for (const auto& [constant, value] :
        std::initializer_list<SpecializationConstants::Value>{COEFFICIENT_CONSTANTS(STARBOW_VALUE)})
        all.add(constant, value);
    return all;
}
SpecializationConstants constants(const SurfaceVariant& v)
{
    return with({SURFACE_CONSTANTS(STARBOW_VALUE)}, v.coefficients).add(Constant::topology, int(v.topology));
}
SpecializationConstants constants(const WarpVariant& v) { return with({VIEW_CONSTANTS(STARBOW_VALUE)}, v.coefficients); }
SpecializationConstants constants(const FinishVariant& v)
{
    return {DITHER_CONSTANTS(STARBOW_VALUE) FINISH_CONSTANTS(STARBOW_VALUE)};
}

#undef STARBOW_VALUE

/// A shader that reads the cube map, in its builds (received_light.glsl).
struct Builds {
    Spirv whole, own_eye, one_rest_frame, globes;

    /// The smallest that serves the variant.
    Spirv of(const WarpVariant& v) const
    {
        return v.globes > 0 ? globes : v.reproject ? whole : v.several_rest_frames ? own_eye : one_rest_frame;
    }
};
constexpr Builds measure_builds{measure_frag, measure_own_eye_frag, measure_one_frame_frag, measure_globes_frag},
    meter_builds{meter_frag, meter_own_eye_frag, meter_one_frame_frag, meter_globes_frag},
    overlay_builds{overlay_frag, overlay_own_eye_frag, overlay_one_frame_frag, overlay_globes_frag},
    probe_builds{probe_frag, probe_own_eye_frag, probe_one_frame_frag, probe_globes_frag},
    star_builds{star_vert, star_own_eye_vert, star_one_frame_vert, star_globes_vert},
    warp_builds{warp_frag, warp_own_eye_frag, warp_one_frame_frag, warp_globes_frag},
    warp_rays_builds{warp_rays_frag, warp_rays_own_eye_frag, warp_rays_one_frame_frag, warp_rays_globes_frag};

Spirv stars_shader(const WarpVariant& v)
{
    return v.map || v.reproject || v.several_rest_frames || v.globes > 0 ? star_builds.of(v) : Spirv(star_flat_vert);
}

} // namespace

std::string describe(const PipelinePass& pass)
{
#define STARBOW_NAME(id, type, NAME, member, usual) {Constant::member, #member},
    static const std::map<Constant, const char*> names{COEFFICIENT_CONSTANTS(STARBOW_NAME) SURFACE_CONSTANTS(STARBOW_NAME)
            VIEW_CONSTANTS_ALONE(STARBOW_NAME) PASS_CONSTANTS(STARBOW_NAME)};
#undef STARBOW_NAME
    std::string text;
    for (std::size_t i = 0; i < pass.constants.count; ++i)
        if (const auto& [constant, value] = pass.constants.list[i]; value != 0)
            text += names.at(constant) + (value == 1 ? "" : "=" + std::to_string(value)) + ", ";
    text += "to";
    for (const vk::Format format : pass.target.colours)
        text += " " + vk::to_string(format);
    return pass.target.samples == vk::SampleCountFlagBits::e1 ? text : text + " x " + vk::to_string(pass.target.samples);
}

Pipelines::Pipelines(Device& device)
    : layouts(device)
    , device_(device)
{
}

vk::Pipeline Pipelines::find_or_make(const PipelinePass& pass)
{
    const Key key(pass.name, pass.constants, pass.target);
    auto at = made_.find(key);
    if (at == made_.end()) {
        at = made_.emplace(key, Made{pass, make(pass), turn_}).first;
        ++count_;
    }
    at->second.used = turn_;
    return *at->second.pipeline;
}

void Pipelines::release_old(std::size_t most)
{
    while (made_.size() > most) {
        const auto oldest = std::min_element(
            made_.begin(), made_.end(), [](const auto& a, const auto& b) { return a.second.used < b.second.used; });
        if (oldest->second.used == turn_)
            break;
        made_.erase(oldest);
    }
    ++turn_;
}

std::vector<std::pair<PipelinePass, vk::Pipeline>> Pipelines::made() const
{
    std::vector<std::pair<PipelinePass, vk::Pipeline>> all;
    for (const auto& [key, made] : made_)
        all.emplace_back(made.pass, *made.pipeline);
    return all;
}

vk::raii::Pipeline Pipelines::make(const PipelinePass& pass) const
{
    auto module = [&](Spirv words) { return device_.device.createShaderModule({{}, words.size_bytes(), words.data()}); };
    vk::raii::ShaderModule vertex = module(pass.vertex), fragment = module(pass.fragment);
    std::vector<vk::SpecializationMapEntry> entries;
    constexpr std::size_t size = sizeof(SpecializationConstants::Value);
    for (std::size_t i = 0; i < pass.constants.count; ++i)
        entries.push_back({std::uint32_t(pass.constants.list[i].constant),
            std::uint32_t(i * size + offsetof(SpecializationConstants::Value, value)), 4});
    vk::SpecializationInfo constants(
        std::uint32_t(entries.size()), entries.data(), pass.constants.count * size, pass.constants.list.data());
    vk::PipelineShaderStageCreateInfo stages[] = {{{}, vk::ShaderStageFlagBits::eVertex, *vertex, "main", &constants},
        {{}, vk::ShaderStageFlagBits::eFragment, *fragment, "main", &constants}};

    vk::VertexInputBindingDescription bindings[] = {{0, sizeof(Vertex)}, {1, sizeof(VertexMaps)}};
    vk::VertexInputAttributeDescription attributes[] = {{0, 0, vk::Format::eR32G32B32Sfloat, offsetof(Vertex, position)},
        {1, 0, vk::Format::eR32G32B32Sfloat, offsetof(Vertex, normal)},
        {2, 0, vk::Format::eR32G32Sfloat, offsetof(Vertex, uv)},
        {3, 0, vk::Format::eR8G8B8A8Unorm, offsetof(Vertex, colour)},
        {4, 1, vk::Format::eR32G32B32A32Sfloat, offsetof(VertexMaps, tangent)},
        {5, 1, vk::Format::eR32G32B32A32Sfloat, offsetof(VertexMaps, uvs)}};
    vk::PipelineVertexInputStateCreateInfo vertices;
    if (pass.vertices)
        vertices = vk::PipelineVertexInputStateCreateInfo({}, pass.maps ? 2 : 1, bindings, pass.maps ? 6 : 4, attributes);

    vk::PipelineInputAssemblyStateCreateInfo assembly({},
        pass.topology == Topology::points      ? vk::PrimitiveTopology::ePointList
            : pass.topology == Topology::lines ? vk::PrimitiveTopology::eLineList
                                               : vk::PrimitiveTopology::eTriangleList);
    vk::PipelineViewportStateCreateInfo viewport({}, 1, nullptr, 1, nullptr);
    vk::PipelineRasterizationStateCreateInfo raster;
    raster.lineWidth = 1;
    vk::PipelineMultisampleStateCreateInfo samples({}, pass.target.samples);
    vk::PipelineDepthStencilStateCreateInfo depth;
    depth.depthTestEnable = pass.depth;
    depth.depthWriteEnable = pass.depth && pass.vertices && pass.blending == Blending::none;
    depth.depthCompareOp = vk::CompareOp::eGreaterOrEqual;
    vk::PipelineColorBlendAttachmentState blend;
    blend.colorWriteMask = vk::FlagTraits<vk::ColorComponentFlagBits>::allFlags;
    using Factor = vk::BlendFactor;
    blend.blendEnable = pass.blending != Blending::none;
    blend.srcColorBlendFactor = blend.srcAlphaBlendFactor = Factor::eOne;
    blend.dstColorBlendFactor = blend.dstAlphaBlendFactor
        = pass.blending == Blending::add ? Factor::eOne : Factor::eOneMinusSrcAlpha;
    std::vector<vk::PipelineColorBlendAttachmentState> blends(pass.target.colours.size(), blend);
    vk::PipelineColorBlendStateCreateInfo blending({}, false, {}, blends);
    std::vector<vk::DynamicState> dynamic = {vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    if (pass.depth) // surfaces, and the sky between them
        dynamic.insert(
            dynamic.end(), {vk::DynamicState::eCullMode, vk::DynamicState::eFrontFace, vk::DynamicState::eLineWidth});
    vk::PipelineDynamicStateCreateInfo dynamics({}, dynamic);
    const std::vector<vk::Format> formats(pass.target.colours.begin(), pass.target.colours.end());
    vk::PipelineRenderingCreateInfo rendering(
        0, formats, pass.depth ? depth_format : vk::Format::eUndefined, vk::Format::eUndefined);
    vk::GraphicsPipelineCreateInfo info({}, stages, &vertices, &assembly, nullptr, &viewport, &raster, &samples, &depth,
        &blending, &dynamics, *(layouts.*pass.layout));
    info.pNext = &rendering;
    if (device_.statistics)
        info.flags = vk::PipelineCreateFlagBits::eCaptureStatisticsKHR
            | vk::PipelineCreateFlagBits::eCaptureInternalRepresentationsKHR;
    vk::raii::Pipeline pipeline = device_.device.createGraphicsPipeline(device_.cache, info);
    name_object(device_, vertex, pass.name);
    name_object(device_, fragment, pass.name);
    name_object(device_, pipeline, pass.name);
    return pipeline;
}

vk::Pipeline Pipelines::surface(const SurfaceVariant& v, const TargetKind& target)
{
    return find_or_make({.name = v.mapped ? "mapped surface pipeline" : "surface pipeline",
        .vertex = v.mapped ? Spirv(cube_mapped_vert) : Spirv(cube_vert),
        .fragment = v.mapped ? Spirv(cube_mapped_frag) : Spirv(cube_frag),
        .layout = &PipelineLayouts::surface_layout,
        .target = target,
        .constants = constants(v).add(Constant::cube_samples, int(target.samples)),
        .depth = true,
        .vertices = true,
        .maps = v.mapped,
        .topology = v.topology,
        .blending = v.blended ? Blending::over : Blending::none});
}

vk::Pipeline Pipelines::sky(bool milky_way, const TargetKind& target)
{
    return find_or_make({.name = "sky pipeline",
        .vertex = sky_vert,
        .fragment = sky_frag,
        .layout = &PipelineLayouts::surface_layout,
        .target = target,
        .constants = {{Constant::groups, int(target.colours.size())}, {Constant::milky_way, milky_way}},
        .depth = true});
}

vk::Pipeline Pipelines::warp(const WarpVariant& v, vk::Format target)
{
    return find_or_make({.name = "warp pipeline",
        .vertex = screen_vert,
        .fragment = (v.rays == 1 && !v.channels ? warp_builds : warp_rays_builds).of(v),
        .layout = &PipelineLayouts::warp_layout,
        .target = {{target}},
        .constants = constants(v).add(Constant::dithered, target != light_format)});
}

vk::Pipeline Pipelines::dark(const WarpVariant& v, vk::Format target)
{
    WarpVariant own{};
    own.map = v.map, own.stars = true, own.range = v.range;
    return find_or_make({.name = "dark pipeline",
        .vertex = screen_vert,
        .fragment = warp_dark_frag,
        .layout = &PipelineLayouts::warp_layout,
        .target = {{target}},
        .constants = constants(own).add(Constant::dithered, target != light_format)});
}

vk::Pipeline Pipelines::stars(const WarpVariant& v, vk::Format target)
{
    return find_or_make({.name = "stars pipeline",
        .vertex = stars_shader(v),
        .fragment = star_frag,
        .layout = &PipelineLayouts::star_layout,
        .target = {{target}},
        .constants = constants(v).add(Constant::halves, target == light_format),
        .topology = Topology::points,
        .blending = Blending::add});
}

vk::Pipeline Pipelines::measure(const WarpVariant& v)
{
    return find_or_make({.name = "measure pipeline",
        .vertex = screen_vert,
        .fragment = measure_builds.of(v),
        .layout = &PipelineLayouts::warp_layout,
        .target = {{exact_format, exact_format, exact_format}},
        .constants = constants(v)});
}

vk::Pipeline Pipelines::probe(const WarpVariant& v)
{
    return find_or_make({.name = "probe pipeline",
        .vertex = screen_vert,
        .fragment = probe_builds.of(v),
        .layout = &PipelineLayouts::warp_layout,
        .target = {{exact_format, exact_format, exact_format}},
        .constants = constants(v)});
}

vk::Pipeline Pipelines::overlay(const WarpVariant& v, int overlay, vk::Format target)
{
    return find_or_make({.name = "overlay pipeline",
        .vertex = screen_vert,
        .fragment = overlay_builds.of(v),
        .layout = &PipelineLayouts::overlay_layout,
        .target = {{target}},
        .constants = constants(v).add(Constant::overlay, overlay),
        .blending = Blending::over});
}

vk::Pipeline Pipelines::mip(vk::Format target)
{
    return find_or_make({.name = "mip pipeline",
        .vertex = screen_vert,
        .fragment = mip_frag,
        .layout = &PipelineLayouts::picture_layout,
        .target = {{target}}});
}

vk::Pipeline Pipelines::compress(bool colours)
{
    return find_or_make({.name = "compress pipeline",
        .vertex = screen_vert,
        .fragment = compress_frag,
        .layout = &PipelineLayouts::picture_layout,
        .target = {{words_format}},
        .constants = {{Constant::colours, colours}}});
}

vk::Pipeline Pipelines::meter(const WarpVariant& v)
{
    return find_or_make({.name = "meter pipeline",
        .vertex = screen_vert,
        .fragment = meter_builds.of(v),
        .layout = &PipelineLayouts::warp_layout,
        .target = {{meter_format}},
        .constants = constants(v)});
}

vk::Pipeline Pipelines::star_meter(const WarpVariant& v)
{
    return find_or_make({.name = "star meter pipeline",
        .vertex = stars_shader(v),
        .fragment = star_meter_frag,
        .layout = &PipelineLayouts::star_layout,
        .target = {{meter_format}},
        .constants = constants(v).add(Constant::metering_samples, true), // the meter reads one ray for each sample
        .topology = Topology::points});
}

vk::Pipeline Pipelines::bloom(bool up, bool first)
{
    return find_or_make({.name = "bloom pipeline",
        .vertex = screen_vert,
        .fragment = bloom_frag,
        .layout = &PipelineLayouts::picture_layout,
        .target = {{light_format}},
        .constants = {{Constant::up, up}, {Constant::first, first}},
        .blending = up ? Blending::over : Blending::none});
}

vk::Pipeline Pipelines::bloomed(bool range, vk::Format target)
{
    return find_or_make({.name = "bloomed pipeline",
        .vertex = screen_vert,
        .fragment = bloomed_frag,
        .layout = &PipelineLayouts::picture_layout,
        .target = {{target}},
        .constants = {{Constant::dithered, target != light_format}, {Constant::range, range}}});
}

vk::Pipeline Pipelines::hud(bool map, vk::Format target, bool scale, bool light)
{
    return find_or_make({.name = "hud pipeline",
        .vertex = screen_vert,
        .fragment = hud_frag,
        .layout = &PipelineLayouts::picture_layout,
        .target = {{target}},
        .constants = {{Constant::map, map}, {Constant::scale, scale}, {Constant::light, light}},
        .blending = Blending::over});
}

vk::Pipeline Pipelines::lookup(vk::Format target)
{
    return find_or_make({.name = "lookup pipeline",
        .vertex = screen_vert,
        .fragment = lookup_frag,
        .layout = &PipelineLayouts::picture_layout,
        .target = {{target}},
        .constants = {{Constant::map, false}}});
}

vk::Pipeline Pipelines::scaled(vk::Format target)
{
    return find_or_make({.name = "scaled pipeline",
        .vertex = screen_vert,
        .fragment = scaled_frag,
        .layout = &PipelineLayouts::picture_layout,
        .target = {{target}}});
}

vk::Pipeline Pipelines::layer(bool plain)
{
    return find_or_make({.name = "layer pipeline",
        .vertex = screen_vert,
        .fragment = layer_frag,
        .layout = &PipelineLayouts::picture_layout,
        .target = {{light_format}},
        .constants = {{Constant::plain, plain}},
        .blending = Blending::add});
}

vk::Pipeline Pipelines::finish(const FinishVariant& v, vk::Format target)
{
    return find_or_make({.name = "finish pipeline",
        .vertex = screen_vert,
        .fragment = finish_frag,
        .layout = &PipelineLayouts::finish_layout,
        .target = {{target}},
        .constants = constants(v)});
}

vk::Pipeline Pipelines::fade(vk::Format target)
{
    return find_or_make({.name = "fade pipeline",
        .vertex = screen_vert,
        .fragment = fade_frag,
        .layout = &PipelineLayouts::picture_layout,
        .target = {{target}},
        .blending = Blending::over});
}

vk::Pipeline Pipelines::vignette(bool map, vk::Format target)
{
    return find_or_make({.name = "vignette pipeline",
        .vertex = screen_vert,
        .fragment = vignette_frag,
        .layout = &PipelineLayouts::warp_layout,
        .target = {{target}},
        .constants = {{Constant::map, map}},
        .blending = Blending::over});
}

vk::Pipeline Pipelines::pattern(bool map, int pattern, vk::Format target)
{
    return find_or_make({.name = "pattern pipeline",
        .vertex = screen_vert,
        .fragment = pattern_frag,
        .layout = &PipelineLayouts::picture_layout,
        .target = {{target}},
        .constants = {{Constant::map, map}, {Constant::pattern, pattern}}});
}

} // namespace starbow
