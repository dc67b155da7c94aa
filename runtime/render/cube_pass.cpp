#include "cube_pass.h"
#include "runtime/operation/trace.h"
#include "runtime/plan/scratch.h"
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <utility>

namespace starbow {
namespace {

/// Width of the viewport over the image's. Behind at high speed one triangle may be a thousand million texels wide. Where a
/// device cuts it at the viewport's sides, the rounding of its far corners moves the cut by many texels; the image's edge
/// would stay empty if it were there. Every device takes viewports of 16384 pixels if it takes such images.
double guard_of(const PlannedImage& image)
{
    return std::clamp(std::floor(16384.0 / std::max(image.size.x, image.size.y)), 1.0, 8.0);
}

/// Sets a viewport that much wider than the image around the same middle; only the image is drawn into.
void set_guarded_area(vk::CommandBuffer commands, const PlannedImage& image)
{
    const glm::dvec2 inner(image.size), size = guard_of(image) * inner;
    const glm::dvec2 corner = glm::dvec2(image.atlas) - 0.5 * (size - inner);
    commands.setViewport(0, vk::Viewport(float(corner.x), float(corner.y), float(size.x), float(size.y), 0, 1));
    commands.setScissor(0, rect_of(image.atlas, image.size));
}

/// The directions in which the two coordinates of an image's face grow.
std::pair<glm::dvec3, glm::dvec3> axes_of(const PlannedImage& image)
{
    const glm::dvec3 middle = face_direction(image.face, {0, 0});
    return {face_direction(image.face, {1, 0}) - middle, face_direction(image.face, {0, 1}) - middle};
}

/// A mirrored pair of face axes turns a surface's front round.
bool mirrored(const PlannedImage& image)
{
    const auto [a, b] = axes_of(image);
    return glm::dot(glm::cross(a, b), face_direction(image.face, {0, 0})) < 0;
}

} // namespace

CubePass::CubePass(Device& device, Pipelines& pipelines, const GpuWorld& world, const Quality& quality, bool keeps_depth)
    : device_(device)
    , pipelines_(pipelines)
    , world_(world)
    , quality_(quality)
    , target_(device, pipelines, world, quality, keeps_depth)
    , uploads_(device, pipelines, world)
{
    const Sky& sky = world.scene.sky;
    sky_ = sky.zenith != sky.horizon || sky.nadir != sky.horizon || world.world.milky_way >= 0;
}

void CubePass::prepare(const CubeMapPlan& plan, std::span<const EyeEvent> eye_events, StoredLight light, double pre_exposure)
{
    pre_exposure_ = pre_exposure;
    images_ = plan.images;
    use_ = {!images_.empty() && images_.back().rest_frame > 0, light};
    area_ = plan.atlas_size;
    levels_ = plan.levels;
    {
        const Trace::Span span(device_.trace, "cull");
        list_ = cull(world_.world, eye_events, images_, quality_, std::move(list_));
        group_draws();
    }
    const Trace::Span span(device_.trace, "upload");
    eye_events_.assign(eye_events.begin(), eye_events.end());
    target_.fit(plan.atlas_size, plan.levels);
    find_skies();
    uploads_.write(list_, skies_, eye_events, light, pre_exposure_);
    uploads_.write_tile_table(plan);
}

void CubePass::prepare_plain(const PlannedImage& image, const EyeEvent& eye_event)
{
    images_ = {image};
    area_ = image.size;
    use_ = {false, StoredLight::plain};
    list_ = cull(world_.world, {&eye_event, 1}, images_, quality_, std::move(list_));
    group_draws();
    eye_events_ = {eye_event};
    find_skies();
    uploads_.write(list_, skies_, {&eye_event, 1}, use_.light, pre_exposure_);
    target_.fit_depth(image.size);
}

std::size_t CubePass::triangles() const
{
    std::size_t triangles = 0;
    for (const Draw& draw : list_.draws)
        if (world_.world.primitives[draw.primitive].topology == Topology::triangles)
            triangles += std::size_t(draw.count) * draw.index_count / 3;
    return triangles;
}

void CubePass::record(vk::CommandBuffer commands)
{
    const TargetKind kind = target_.kind(use_);
    std::array<glm::vec4, MAX_GROUPS + 1> clear{};
    for (std::size_t group = 0; group < kind.colours.size() && !use_.several_rest_frames; ++group)
        clear[group] = glm::vec4(world_.spectra_of(use_.light).sky[1][group] * pre_exposure_);
    target_.begin(commands, use_, area_, std::span(clear).first(kind.colours.size()), 3 + 2 * std::uint32_t(images_.size()));
    draw_images(commands, kind);
    target_.end(commands, use_, images_, levels_);
}

SurfaceVariant CubePass::variant_of(const Draw& draw, StoredLight light) const
{
    const Primitive& primitive = world_.world.primitives[draw.primitive];
    SurfaceVariant variant = world_.variant(primitive.material, light);
    variant.topology = primitive.topology;
    const bool plain = light == StoredLight::plain;
    variant.finite_existence = draw.finite_existence && !plain;
    variant.several_rest_frames = use_.several_rest_frames;
    variant.blended = draw.blended;
    // A deforming instance has no transform of its own beside its poses.
    variant.deforms = draw.deforms, variant.moves = draw.moves && (!plain || draw.deforms);
    if (!plain && !variant.unlit && !draw.moves && images_[draw.image].rest_frame == 0)
        variant.shadows = world_.shadows;
    return variant;
}

float CubePass::line_width(const PlannedImage& image) const
{
    const glm::dvec2 middle = 0.5 * (image.low + image.high);
    const EyeEvent& eye_event = eye_events_[std::size_t(image.rest_frame)];
    const double width = pixel_rad_ * image.texels_per_unit * growth_towards(eye_event, face_direction(image.face, middle))
        * std::pow(1 + glm::dot(middle, middle), 0.75);
    return float(std::clamp(width, 1.0, double(device_.widest_line)));
}

CubePass::SurfaceState CubePass::state_of(const Draw& draw) const
{
    const auto material = std::size_t(world_.world.primitives[draw.primitive].material);
    return {variant_of(draw, use_.light), world_.set_of_material[material], world_.world.materials[material].double_sided};
}

void CubePass::group_draws()
{
    runs_.clear();
    std::vector<Draw>& draws = list_.draws;
    for (std::size_t first = 0, last; first < draws.size(); first = last) {
        const auto alike
            = [&](const Draw& draw) { return draw.image == draws[first].image && draw.blended == draws[first].blended; };
        // The runs in the order of their nearest surfaces. Blended surfaces keep their order, from behind.
        const std::size_t first_run = runs_.size();
        run_of_draw_.clear();
        for (last = first; last < draws.size() && alike(draws[last]); ++last) {
            const SurfaceState state = state_of(draws[last]);
            std::size_t run = draws[first].blended ? std::max(runs_.size(), first_run + 1) - 1 : first_run;
            while (run < runs_.size() && runs_[run].state != state)
                ++run;
            if (run == runs_.size())
                runs_.push_back({state, draws[first].image, draws[first].blended, 0, 0});
            ++runs_[run].count;
            run_of_draw_.push_back(run);
        }
        std::size_t next = first;
        for (std::size_t run = first_run; run < runs_.size(); ++run)
            runs_[run].first = std::uint32_t(next), next += runs_[run].count;
        grouped_.assign(draws.begin() + std::ptrdiff_t(first), draws.begin() + std::ptrdiff_t(last));
        for (std::size_t k = 0; k < grouped_.size(); ++k)
            draws[runs_[run_of_draw_[k]].first++] = grouped_[k];
        for (std::size_t run = first_run; run < runs_.size(); ++run)
            runs_[run].first -= runs_[run].count;
    }
    reserve_headroom(runs_), reserve_headroom(run_of_draw_), reserve_headroom(grouped_);
}

void CubePass::draw_images(vk::CommandBuffer commands, const TargetKind& kind)
{
    commands.bindVertexBuffers(0, *world_.vertices.buffer, vk::DeviceSize(0));
    if (*world_.vertex_maps.buffer)
        commands.bindVertexBuffers(1, *world_.vertex_maps.buffer, vk::DeviceSize(0));
    commands.bindIndexBuffer(*world_.indices.buffer, 0, vk::IndexType::eUint32);
    for (const PlannedImage& image : images_)
        if (image.needed && image.clip_hole > 0)
            fill_clip_hole(commands, image);
    BoundState bound;
    const bool blends = std::ranges::any_of(runs_, &Run::blended);
    draw_surfaces(commands, kind, false, bound);
    if (!skies_.empty())
        draw_sky(commands, kind, bound);
    if (!blends)
        return;
    commands.bindIndexBuffer(uploads_.sorted_indices(), 0, vk::IndexType::eUint32);
    draw_surfaces(commands, kind, true, bound);
}

/// Nothing is nearer than the near plane. A fragment in the clip-map hole therefore fails the depth test and is not shaded.
void CubePass::fill_clip_hole(vk::CommandBuffer commands, const PlannedImage& image) const
{
    const glm::dvec2 low = glm::ceil((-glm::dvec2(image.clip_hole) - image.low) * image.texels_per_unit);
    const glm::dvec2 high = glm::floor((glm::dvec2(image.clip_hole) - image.low) * image.texels_per_unit);
    const glm::ivec2 first = glm::clamp(glm::ivec2(low), glm::ivec2(0), image.size),
                     last = glm::clamp(glm::ivec2(high), first, image.size);
    if (last.x > first.x && last.y > first.y)
        commands.clearAttachments(vk::ClearAttachment(vk::ImageAspectFlagBits::eDepth, 0, vk::ClearDepthStencilValue(1, 0)),
            vk::ClearRect(rect_of(image.atlas + first, last - first), 0, 1));
}

void CubePass::bind(
    vk::CommandBuffer commands, vk::Pipeline pipeline, std::size_t material_set, bool double_sided, BoundState& bound) const
{
    if (bound.pipeline != pipeline)
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
    if (bound.material_set != material_set)
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.layouts.surface_layout, 1,
            *world_.material_sets[material_set], {});
    if (bound.double_sided != double_sided)
        commands.setCullMode(double_sided ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack);
    bound.pipeline = pipeline, bound.material_set = material_set, bound.double_sided = double_sided;
}

void CubePass::bind_uploads(vk::CommandBuffer commands, int rest_frame, BoundState& bound) const
{
    if (std::exchange(bound.rest_frame, rest_frame) != rest_frame)
        uploads_.bind(commands, rest_frame);
}

void CubePass::push(vk::CommandBuffer commands, const shared::CubePush& push) const
{
    commands.pushConstants<shared::CubePush>(*pipelines_.layouts.surface_layout, vk::ShaderStageFlagBits::eVertex, 0, push);
}

void CubePass::draw_surfaces(vk::CommandBuffer commands, const TargetKind& kind, bool blended, BoundState& bound)
{
    constexpr std::uint32_t stride = sizeof(vk::DrawIndexedIndirectCommand);
    shared::CubePush constants{};
    std::optional<std::uint32_t> at; // image
    for (const Run& run : runs_) {
        if (run.blended != blended)
            continue;
        if (at != run.image) {
            if (at && device_.keeper)
                device_.keeper->hold(commands); // a scene ends whenever its memory is full
            at = run.image;
            const PlannedImage& image = images_[run.image];
            set_guarded_area(commands, image);
            commands.setLineWidth(line_width(image));
            commands.setFrontFace(mirrored(image) ? vk::FrontFace::eClockwise : vk::FrontFace::eCounterClockwise);
            bind_uploads(commands, image.rest_frame, bound);
            constants = constants_of(image);
        }
        bind(commands, pipelines_.surface(run.state.variant, kind), run.state.material_set, run.state.double_sided, bound);
        constants.surface.y = float(run.first);
        push(commands, constants);
        commands.drawIndexedIndirect(uploads_.draw_commands(), run.first * stride, run.count, stride);
    }
    if (at && device_.keeper)
        device_.keeper->hold(commands);
}

shared::CubePush CubePass::constants_of(const PlannedImage& image) const
{
    glm::dmat4 clip = clip_from_cube(image, near_distance);
    clip[2] *= eye_events_[std::size_t(image.rest_frame)].contraction;
    clip = glm::scale(glm::dmat4(1), glm::dvec3(1 / guard_of(image), 1 / guard_of(image), 1)) * clip;
    shared::CubePush constants{};
    constants.clip_x = shared::row(clip, 0), constants.clip_y = shared::row(clip, 1),
    constants.clip_w = shared::row(clip, 3);
    constants.surface.x = near_distance;
    constants.surface.z = float(pixel_rad_ * image.texels_per_unit);
    return constants;
}

void CubePass::find_skies()
{
    skies_.clear();
    for (const PlannedImage& image : images_) {
        if (!image.needed || !sky_ || use_.several_rest_frames)
            continue;
        const auto [a, b] = axes_of(image);
        const glm::dvec2 unit = 2.0 / glm::dvec2(area_);
        skies_.push_back({glm::vec4(face_direction(image.face, image.low), 0),
            glm::vec4(a * (image.high.x - image.low.x), 0), glm::vec4(b * (image.high.y - image.low.y), 0),
            glm::vec4(glm::dvec2(image.atlas) * unit - 1.0, glm::dvec2(image.size) * unit)});
    }
}

void CubePass::draw_sky(vk::CommandBuffer commands, const TargetKind& kind, BoundState& bound)
{
    set_area(commands, {0, 0}, area_);
    commands.setLineWidth(1);
    commands.setFrontFace(vk::FrontFace::eCounterClockwise); // any: both sides are drawn
    bind(commands, pipelines_.sky(world_.world.milky_way >= 0, kind), world_.set_of_material.back(), true, bound);
    bind_uploads(commands, 0, bound);
    commands.draw(6, std::uint32_t(skies_.size()), 0, 0);
    if (device_.keeper)
        device_.keeper->hold(commands);
}

void CubePass::record_plain(vk::CommandBuffer commands, const Target& target)
{
    target_.begin_plain(commands, target, glm::vec4(world_.scene.sky.horizon * pre_exposure_, 1));
    draw_images(commands, {{target.format}});
    device_.end_rendering(commands);
}

} // namespace starbow
