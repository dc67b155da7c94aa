#include "cube_pass.h"
#include "debug.h"
#include "lamp.h"
#include "runtime/operation/trace.h"
#include "runtime/world/clock.h"
#include <algorithm>
#include <cmath>
#include <cstring>

namespace starbow {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

/// The star pass reads the atlases in its vertex shader: where things move, they may cover a star.
constexpr auto readers = Stage::eVertexShader | Stage::eFragmentShader;
constexpr auto depth_tests = Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;

vk::SampleCountFlagBits sample_bits(int samples)
{
    return samples >= 8 ? vk::SampleCountFlagBits::e8
        : samples >= 4  ? vk::SampleCountFlagBits::e4
        : samples >= 2  ? vk::SampleCountFlagBits::e2
                        : vk::SampleCountFlagBits::e1;
}

} // namespace

CubePass::CubePass(Device& device, Pipelines& pipelines, const GpuWorld& world, const Quality& quality, bool keeps_depth)
    : device_(device)
    , pipelines_(pipelines)
    , world_(world)
    , quality_(quality)
    , keeps_depth_(keeps_depth)
{
    const Sky& sky = world.scene.sky;
    sky_ = sky.zenith != sky.horizon || sky.nadir != sky.horizon;
    const vk::DeviceSize step = device.properties.limits.minUniformBufferOffsetAlignment;
    stride_ = (sizeof(shared::CubeConstants) + step - 1) / step * step;
    const std::size_t layers = world.world.frames.size();
    constants_ = make_mapped_buffer(device, layers * stride_, vk::BufferUsageFlagBits::eUniformBuffer);
    name_object(device, constants_, "cube pass: constants");
    tiles_ = make_mapped_buffer(device, sizeof(shared::TileTable), vk::BufferUsageFlagBits::eUniformTexelBuffer);
    name_object(device, tiles_, "cube pass: tiles");
    tiles_view_ = device.device.createBufferView({{}, *tiles_.buffer, exact_format, 0, VK_WHOLE_SIZE});
    name_object(device, tiles_view_, "cube pass: tiles view");
    atlases_.resize(formats(world.layered()).size());
    std::vector<vk::DescriptorPoolSize> sizes = {{vk::DescriptorType::eUniformBufferDynamic, 1},
        {vk::DescriptorType::eUniformBuffer, 1}, {vk::DescriptorType::eStorageBuffer, 3}};
    pool_ = device.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes});
    name_object(device, pool_, "cube pass: descriptor pool");
    set_ = std::move(device.device.allocateDescriptorSets({*pool_, *pipelines.eye_set}).front());
    name_object(device, set_, "cube pass: descriptor set");
}

Formats CubePass::formats(bool layered) const
{
    Formats formats = world_.numbers().formats(quality_.half_floats);
    if (layered)
        formats.push_back(vk::Format::eR32G32Sfloat); // near / distance is small
    return formats;
}

void CubePass::prepare(const CubeMapPlan& plan, std::span<const EyeEvent> layers, double pre_exposure)
{
    pre_exposure_ = pre_exposure;
    images_ = plan.images;
    layered_ = !images_.empty() && images_.back().layer > 0;
    area_ = plan.atlas_size;
    levels_ = plan.levels;
    {
        const Trace::Span span(device_.trace, "cull");
        list_ = cull(world_.world, layers, images_, quality_, std::move(list_));
    }
    const Trace::Span span(device_.trace, "upload");
    contractions_.clear();
    for (const EyeEvent& layer : layers)
        contractions_.push_back(layer.contraction);
    fit(plan.atlas_size, plan.levels);
    upload(layers, false);
    write_tiles(plan, *static_cast<shared::TileTable*>(tiles_.mapped));
}

void CubePass::prepare_plain(const PlannedImage& image, const EyeEvent& eye_event)
{
    images_ = {image};
    layered_ = false;
    list_ = cull(world_.world, {&eye_event, 1}, images_, quality_, std::move(list_));
    contractions_ = {1};
    upload({&eye_event, 1}, true);
    if (int(depth_.extent.width) < image.size.x || int(depth_.extent.height) < image.size.y) {
        depth_ = make_image(device_,
            {depth_format, {std::uint32_t(image.size.x), std::uint32_t(image.size.y)},
                vk::ImageUsageFlagBits::eDepthStencilAttachment});
        name_object(device_, depth_, "cube pass: depth");
    }
}

void CubePass::fit(glm::ivec2 size, int levels)
{
    const Image& first = atlases_[0];
    // A plan is empty where no view shows anything; the texture exists all the same.
    const auto grown = [&](int needed, std::uint32_t had) {
        const std::uint32_t whole = (std::uint32_t(std::max(needed, 1)) + 255) / 256 * 256;
        return repeatable_ ? whole : std::max(whole, had);
    };
    const vk::Extent2D extent(grown(size.x, first.extent.width), grown(size.y, first.extent.height));
    if (*first.view && first.extent == extent && int(first.levels) >= levels)
        return;
    auto most = std::max(std::uint32_t(levels), first.levels);
    using Usage = vk::ImageUsageFlagBits;
    for (Image& atlas : atlases_)
        atlas = {};
    depth_ = {}, atlas_samples_.clear(), depth_samples_ = {};
    auto copied = most > 1 ? Usage::eTransferSrc | Usage::eTransferDst : vk::ImageUsageFlags();
    Formats formats = this->formats(world_.layered());
    for (std::size_t i = 0; i < atlases_.size(); ++i) {
        atlases_[i] = make_image(device_, {formats[i], extent, Usage::eColorAttachment | Usage::eSampled | copied, most});
        name_object(device_, atlases_[i], "cube pass: atlas");
    }
    depth_ = make_image(device_, {depth_format, extent, Usage::eDepthStencilAttachment | Usage::eSampled});
    name_object(device_, depth_, "cube pass: depth");
    if (quality_.cube_samples > 1) {
        vk::SampleCountFlagBits samples = sample_bits(quality_.cube_samples);
        for (vk::Format format : formats)
            name_object(device_,
                atlas_samples_.emplace_back(make_image(device_, {format, extent, Usage::eColorAttachment, 1, 1, samples})),
                "cube pass: atlas samples");
        depth_samples_ = make_image(device_, {depth_format, extent, Usage::eDepthStencilAttachment, 1, 1, samples});
        name_object(device_, depth_samples_, "cube pass: depth samples");
    }
}

void CubePass::upload(std::span<const EyeEvent> layers, bool plain)
{
    triangles_ = 0;
    for (const Draw& draw : list_.draws)
        triangles_ += std::size_t(draw.count) * draw.index_count / 3;
    auto put = [&](Buffer& buffer, const auto& data) {
        grow(device_, buffer, data.size() * sizeof(data[0]), vk::BufferUsageFlagBits::eStorageBuffer);
        if (!data.empty())
            std::memcpy(buffer.mapped, data.data(), data.size() * sizeof(data[0]));
    };
    put(instances_, list_.instances);
    put(visible_, list_.visible);
    std::vector<shared::TimeEntry>& times = time_writes_;
    times.clear();
    for (std::size_t layer = 0; layer < layers.size(); ++layer) {
        shared::CubeConstants constants = constants_of(layers[layer], plain);
        constants.first = glm::vec4(list_.first[layer], times.size(), list_.first_pose[layer], 0);
        std::memcpy(static_cast<std::byte*>(constants_.mapped) + layer * stride_, &constants, sizeof constants);
        const auto own = time_entries(world_.world, layers[layer], world_.scene.seconds_per_time_unit());
        times.insert(times.end(), own.begin(), own.end());
    }
    if (!times.empty())
        put(times_, times);

    write_set();
}

void CubePass::write_set()
{
    const Buffer& times = *times_.buffer ? times_ : instances_; // without finite existences the shader reads no times
    const Buffer* held[] = {&constants_, &instances_, &visible_, &world_.columns, &times};
    std::array<std::uint64_t, 5> serials;
    std::array<vk::DescriptorBufferInfo, 5> infos;
    std::array<vk::WriteDescriptorSet, 5> writes;
    constexpr vk::DescriptorType types[] = {vk::DescriptorType::eUniformBufferDynamic, vk::DescriptorType::eStorageBuffer,
        vk::DescriptorType::eStorageBuffer, vk::DescriptorType::eUniformBuffer, vk::DescriptorType::eStorageBuffer};
    for (std::uint32_t i = 0; i < 5; ++i) {
        serials[i] = held[i]->serial;
        infos[i] = vk::DescriptorBufferInfo(*held[i]->buffer, 0, i == 0 ? sizeof(shared::CubeConstants) : VK_WHOLE_SIZE);
        writes[i] = vk::WriteDescriptorSet(*set_, i, 0, 1, types[i], nullptr, &infos[i]);
    }
    if (serials == written_)
        return;
    device_.device.updateDescriptorSets(writes, {});
    written_ = serials;
}

shared::CubeConstants CubePass::constants_of(const EyeEvent& eye_event, bool plain) const
{
    const SceneFile& scene = world_.scene;
    const double scale = pre_exposure_;
    shared::CubeConstants constants{};
    constants.ambient = glm::vec4(scene.ambient * scale, scale);
    const auto& numbers = world_.spectra.sky;
    for (std::size_t group = 0; group < std::size_t(world_.spectra.groups); ++group) {
        constants.sky_zenith[group] = glm::vec4(numbers[0][group] * scale);
        constants.sky_horizon[group] = glm::vec4(numbers[1][group] * scale);
        constants.sky_nadir[group] = glm::vec4(numbers[2][group] * scale);
    }
    if (plain) {
        constants.sky_zenith[0] = glm::vec4(scene.sky.zenith * scale, 0);
        constants.sky_horizon[0] = glm::vec4(scene.sky.horizon * scale, 0);
        constants.sky_nadir[0] = glm::vec4(scene.sky.nadir * scale, 0);
    }
    constants.world_up = glm::vec4(eye_event.motion_from_frame * glm::dvec3(0, 1, 0), 0);
    constants.now = glm::vec4(0, 0, eye_event.beta, eye_event.now);
    for (std::size_t i = 0; i < world_.world.lamps.size(); ++i)
        constants.lights[i] = light_entry(world_, world_.world.lamps[i], eye_event, scale);
    return constants;
}

void CubePass::record(vk::CommandBuffer commands)
{
    bool sampled = quality_.cube_samples > 1;
    const std::span used(atlases_.data(), formats(layered_).size());
    const Image& depth = sampled ? depth_samples_ : depth_;
    for (const Image& atlas : used)
        transition(commands, atlas, vk::ImageLayout::eUndefined, readers, {}, vk::ImageLayout::eColorAttachmentOptimal,
            Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite | Access::eColorAttachmentRead);
    constexpr auto depth_access = Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite;
    transition(commands, depth_, vk::ImageLayout::eUndefined,
        depth_tests | Stage::eVertexShader | Stage::eFragmentShader | Stage::eColorAttachmentOutput, depth_access,
        vk::ImageLayout::eDepthAttachmentOptimal, depth_tests | Stage::eColorAttachmentOutput,
        depth_access | Access::eColorAttachmentWrite);
    if (sampled) {
        for (const Image& colour : std::span(atlas_samples_.data(), used.size()))
            transition(commands, colour, vk::ImageLayout::eUndefined, Stage::eColorAttachmentOutput,
                Access::eColorAttachmentWrite, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
                Access::eColorAttachmentWrite | Access::eColorAttachmentRead);
        transition(commands, depth, vk::ImageLayout::eUndefined, depth_tests, depth_access,
            vk::ImageLayout::eDepthAttachmentOptimal, depth_tests, depth_access);
    }
    std::array<vk::RenderingAttachmentInfo, MAX_GROUPS + 1> colours;
    for (std::size_t group = 0; group < used.size(); ++group) {
        const glm::vec4 sky(layered_ ? glm::dvec4(0) : world_.spectra.sky[1][group] * pre_exposure_);
        const vk::ClearColorValue clear(std::array<float, 4>{sky.x, sky.y, sky.z, sky.w});
        vk::RenderingAttachmentInfo& colour = colours[group];
        colour = {*(sampled ? atlas_samples_ : atlases_)[group].view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
            vk::AttachmentLoadOp::eClear, sampled ? vk::AttachmentStoreOp::eDontCare : vk::AttachmentStoreOp::eStore, clear};
        if (sampled) {
            colour.resolveMode = vk::ResolveModeFlagBits::eAverage;
            colour.resolveImageView = *atlases_[group].view;
            colour.resolveImageLayout = vk::ImageLayout::eColorAttachmentOptimal;
        }
    }
    vk::RenderingAttachmentInfo depth_info(*depth.view, vk::ImageLayout::eDepthAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eClear,
        keeps_depth_ && !sampled ? vk::AttachmentStoreOp::eStore : vk::AttachmentStoreOp::eDontCare,
        vk::ClearDepthStencilValue(0, 0));
    if (sampled && keeps_depth_) {
        depth_info.resolveMode = vk::ResolveModeFlagBits::eSampleZero;
        depth_info.resolveImageView = *depth_.view;
        depth_info.resolveImageLayout = vk::ImageLayout::eDepthAttachmentOptimal;
    }
    commands.beginRendering({{}, rect_of({0, 0}, area_), 1, 0, std::uint32_t(used.size()), colours.data(), &depth_info});
    draw_images(commands, {formats(layered_), sample_bits(quality_.cube_samples)}, false);
    commands.endRendering();
    for (const Image& atlas : used)
        if (levels_ > 1)
            make_mips(commands, atlas);
        else
            transition(commands, atlas, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
                Access::eColorAttachmentWrite, vk::ImageLayout::eShaderReadOnlyOptimal, readers, Access::eShaderSampledRead);
    if (keeps_depth_)
        transition(commands, depth_, vk::ImageLayout::eDepthAttachmentOptimal, depth_tests | Stage::eColorAttachmentOutput,
            depth_access | Access::eColorAttachmentWrite, vk::ImageLayout::eShaderReadOnlyOptimal,
            Stage::eVertexShader | Stage::eFragmentShader, Access::eShaderSampledRead);
}

void CubePass::draw_images(vk::CommandBuffer commands, const TargetKind& kind, bool plain)
{
    const World& world = world_.world;
    commands.bindVertexBuffers(0, *world_.vertices.buffer, vk::DeviceSize(0));
    commands.bindIndexBuffer(*world_.indices.buffer, 0, vk::IndexType::eUint32);
    constexpr auto stages = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;
    auto draw = list_.draws.begin();
    vk::Pipeline bound;
    for (std::uint32_t i = 0; i < images_.size(); ++i) {
        const PlannedImage& image = images_[i];
        set_area(commands, image.atlas, image.size);
        if (i == 0 || image.layer != images_[i - 1].layer)
            commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.surface_layout, 0, *set_,
                std::uint32_t(std::size_t(image.layer) * stride_));
        glm::dmat4 clip = clip_from_motion(image, near_distance);
        clip[2] *= contractions_[std::size_t(image.layer)];
        shared::CubePush push{
            shared::row(clip, 0), shared::row(clip, 1), shared::row(clip, 2), shared::row(clip, 3), {}, {}, {}, {}};
        // A mirrored pair of face axes turns a surface's front round.
        glm::dvec3 a = face_direction(image.face, {1, 0}) - face_direction(image.face, {0, 0});
        glm::dvec3 b = face_direction(image.face, {0, 1}) - face_direction(image.face, {0, 0});
        bool mirrored = glm::dot(glm::cross(a, b), face_direction(image.face, {0, 0})) < 0;
        commands.setFrontFace(mirrored ? vk::FrontFace::eClockwise : vk::FrontFace::eCounterClockwise);
        if (image.clip_hole > 0) {
            // Nothing is nearer than the near plane. A fragment in the clip-map hole therefore fails the depth test and
            // is not shaded.
            glm::dvec2 low = glm::ceil((-glm::dvec2(image.clip_hole) - image.low) * image.texels_per_unit);
            glm::dvec2 high = glm::floor((glm::dvec2(image.clip_hole) - image.low) * image.texels_per_unit);
            glm::ivec2 first = glm::clamp(glm::ivec2(low), glm::ivec2(0), image.size),
                       last = glm::clamp(glm::ivec2(high), first, image.size);
            if (last.x > first.x && last.y > first.y)
                commands.clearAttachments(
                    vk::ClearAttachment(vk::ImageAspectFlagBits::eDepth, 0, vk::ClearDepthStencilValue(1, 0)),
                    vk::ClearRect(rect_of(image.atlas + first, last - first), 0, 1));
        }
        int material = -1;
        for (; draw != list_.draws.end() && draw->image == i; ++draw) {
            const Primitive& primitive = world.primitives[draw->primitive];
            SurfaceVariant variant = world_.variant(primitive.material, plain);
            variant.finite_existence = draw->finite_existence && !plain;
            variant.layered = layered_;
            variant.moves = draw->moves && !plain;
            if (vk::Pipeline pipeline = pipelines_.surface(variant, kind); pipeline != bound)
                commands.bindPipeline(vk::PipelineBindPoint::eGraphics, bound = pipeline);
            if (primitive.material != material) {
                material = primitive.material;
                const Material& m = world.materials[material];
                commands.bindDescriptorSets(
                    vk::PipelineBindPoint::eGraphics, *pipelines_.surface_layout, 1, *world_.materials[material], {});
                commands.setCullMode(m.double_sided ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack);
                push.base_colour = m.base_colour;
                const Spectra::Surface& surface = world_.spectra.surfaces[std::size_t(material)];
                push.emissive = glm::vec4(m.emissive * float(surface.emission * pre_exposure_), m.alpha_cutoff);
                push.beyond = surface.beyond;
                push.own = glm::vec4(surface.own * pre_exposure_);
                commands.pushConstants<shared::CubePush>(*pipelines_.surface_layout, stages, 0, push);
            }
            commands.drawIndexed(draw->index_count, draw->count, draw->first_index, primitive.vertex_offset, draw->first);
        }
        if (sky_ && !layered_) {
            commands.bindPipeline(vk::PipelineBindPoint::eGraphics, bound = pipelines_.sky(kind));
            glm::dvec3 origin = face_direction(image.face, image.low);
            push.clip_row0 = glm::vec4(origin, 0);
            push.clip_row1 = glm::vec4(a * (image.high.x - image.low.x), 0);
            push.clip_row2 = glm::vec4(b * (image.high.y - image.low.y), 0);
            commands.pushConstants<shared::CubePush>(*pipelines_.surface_layout, stages, 0, push);
            commands.draw(3, 1, 0, 0);
        }
    }
}

void CubePass::make_mips(vk::CommandBuffer commands, const Image& atlas)
{
    auto level_barrier = [&](std::uint32_t first, std::uint32_t count, vk::ImageLayout from,
                             vk::PipelineStageFlags2 from_stage, vk::AccessFlags2 from_access, vk::ImageLayout to,
                             vk::PipelineStageFlags2 to_stage, vk::AccessFlags2 to_access) {
        vk::ImageMemoryBarrier2 barrier(from_stage, from_access, to_stage, to_access, from, to, VK_QUEUE_FAMILY_IGNORED,
            VK_QUEUE_FAMILY_IGNORED, *atlas.image, {vk::ImageAspectFlagBits::eColor, first, count, 0, 1});
        commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
    };
    // One level more than the plan needs. At its coarsest level an image is sampled together with the next level at
    // weight 0, and 0 times unwritten memory may be NaN.
    std::uint32_t levels = std::min(std::uint32_t(levels_) + 1, atlas.levels);
    level_barrier(0, 1, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
        Access::eColorAttachmentWrite, vk::ImageLayout::eTransferSrcOptimal, Stage::eTransfer, Access::eTransferRead);
    level_barrier(1, atlas.levels - 1, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput, {},
        vk::ImageLayout::eTransferDstOptimal, Stage::eTransfer, Access::eTransferWrite);
    for (std::uint32_t level = 1; level < levels; ++level) {
        blits_.clear();
        for (const PlannedImage& image : images_)
            if (image.levels >= int(level)) {
                auto box = [&](std::uint32_t l) {
                    glm::ivec2 low = image.atlas >> glm::ivec2(l), high = (image.atlas + image.size) >> glm::ivec2(l);
                    return std::array<vk::Offset3D, 2>{vk::Offset3D(low.x, low.y, 0), vk::Offset3D(high.x, high.y, 1)};
                };
                blits_.push_back({{vk::ImageAspectFlagBits::eColor, level - 1, 0, 1}, box(level - 1),
                    {vk::ImageAspectFlagBits::eColor, level, 0, 1}, box(level)});
            }
        commands.blitImage(*atlas.image, vk::ImageLayout::eTransferSrcOptimal, *atlas.image,
            vk::ImageLayout::eTransferDstOptimal, blits_, vk::Filter::eLinear);
        level_barrier(level, 1, vk::ImageLayout::eTransferDstOptimal, Stage::eTransfer, Access::eTransferWrite,
            vk::ImageLayout::eTransferSrcOptimal, Stage::eTransfer, Access::eTransferRead);
    }
    level_barrier(0, levels, vk::ImageLayout::eTransferSrcOptimal, Stage::eTransfer, {},
        vk::ImageLayout::eShaderReadOnlyOptimal, readers, Access::eShaderSampledRead);
    if (atlas.levels > levels)
        level_barrier(levels, atlas.levels - levels, vk::ImageLayout::eTransferDstOptimal, Stage::eTransfer, {},
            vk::ImageLayout::eShaderReadOnlyOptimal, readers, Access::eShaderSampledRead);
}

void CubePass::record_plain(vk::CommandBuffer commands, const Target& target)
{
    transition(commands, depth_, vk::ImageLayout::eUndefined, depth_tests, Access::eDepthStencilAttachmentWrite,
        vk::ImageLayout::eDepthAttachmentOptimal, depth_tests,
        Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite);
    glm::dvec3 sky = world_.scene.sky.horizon * pre_exposure_;
    vk::RenderingAttachmentInfo colour(target.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
        vk::ClearColorValue(std::array<float, 4>{float(sky.r), float(sky.g), float(sky.b), 1}));
    vk::RenderingAttachmentInfo depth(*depth_.view, vk::ImageLayout::eDepthAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eDontCare, vk::ClearDepthStencilValue(0, 0));
    commands.beginRendering({{}, {{0, 0}, target.extent}, 1, 0, colour, &depth});
    draw_images(commands, {{target.format}}, true);
    commands.endRendering();
}

vk::DeviceSize CubePass::memory() const
{
    vk::DeviceSize bytes = depth_.bytes + depth_samples_.bytes;
    for (const auto* images : {&atlases_, &atlas_samples_})
        for (const Image& image : *images)
            bytes += image.bytes;
    return bytes;
}

} // namespace starbow
