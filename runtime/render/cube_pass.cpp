#include "cube_pass.h"
#include "runtime/operation/trace.h"
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
    }
    const Trace::Span span(device_.trace, "upload");
    eye_events_.assign(eye_events.begin(), eye_events.end());
    target_.fit(plan.atlas_size, plan.levels);
    uploads_.write(list_, eye_events, light, pre_exposure_);
    uploads_.write_tile_table(plan);
}

void CubePass::prepare_plain(const PlannedImage& image, const EyeEvent& eye_event)
{
    images_ = {image};
    use_ = {false, StoredLight::plain};
    list_ = cull(world_.world, {&eye_event, 1}, images_, quality_, std::move(list_));
    eye_events_ = {eye_event};
    uploads_.write(list_, {&eye_event, 1}, use_.light, pre_exposure_);
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
    target_.begin(commands, use_, area_, std::span(clear).first(kind.colours.size()), 2 + std::uint32_t(images_.size()));
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

void CubePass::draw_images(vk::CommandBuffer commands, const TargetKind& kind)
{
    const World& world = world_.world;
    commands.bindVertexBuffers(0, *world_.vertices.buffer, vk::DeviceSize(0));
    if (*world_.vertex_maps.buffer)
        commands.bindVertexBuffers(1, *world_.vertex_maps.buffer, vk::DeviceSize(0));
    commands.bindIndexBuffer(*world_.indices.buffer, 0, vk::IndexType::eUint32);
    constexpr auto stages = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;
    auto draw = list_.draws.begin();
    vk::Pipeline bound;
    int rest_frame = -1; // whose uploads are bound
    for (std::uint32_t i = 0; i < images_.size(); ++i) {
        const PlannedImage& image = images_[i];
        if (!image.needed)
            continue;
        set_guarded_area(commands, image);
        commands.setLineWidth(line_width(image));
        if (image.rest_frame != std::exchange(rest_frame, image.rest_frame))
            uploads_.bind(commands, image.rest_frame);
        glm::dmat4 clip = clip_from_cube(image, near_distance);
        clip[2] *= eye_events_[std::size_t(image.rest_frame)].contraction;
        clip = glm::scale(glm::dmat4(1), glm::dvec3(1 / guard_of(image), 1 / guard_of(image), 1)) * clip;
        shared::CubePush push{};
        push.clip_x = shared::row(clip, 0), push.clip_y = shared::row(clip, 1), push.clip_w = shared::row(clip, 3);
        push.surface.x = near_distance;
        push.surface.z = float(pixel_rad_ * image.texels_per_unit);
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
        const auto bind = [&](vk::Pipeline pipeline) {
            if (pipeline != bound)
                commands.bindPipeline(vk::PipelineBindPoint::eGraphics, bound = pipeline);
        };
        const auto push_constants
            = [&] { commands.pushConstants<shared::CubePush>(*pipelines_.layouts.surface_layout, stages, 0, push); };
        // The material of a draw's surface, and for shadows its distance from the full surface.
        const auto put_surface = [&](const Draw& one) {
            const int index = world.primitives[one.primitive].material;
            const float apart = world_.shadows ? float(one.apart) : 0;
            if (index == material && apart == push.surface.y)
                return;
            push.surface.y = apart;
            if (index == material)
                return push_constants();
            material = index;
            const Material& m = world.materials[material];
            commands.bindDescriptorSets(
                vk::PipelineBindPoint::eGraphics, *pipelines_.layouts.surface_layout, 1, *world_.materials[material], {});
            commands.setCullMode(m.double_sided ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack);
            push.base_colour = m.base_colour;
            const Spectra::Surface& surface = world_.spectra.surfaces[std::size_t(material)];
            push.emissive = glm::vec4(m.emissive * float(surface.emission * pre_exposure_), m.alpha_cutoff);
            push.beyond = surface.beyond;
            push.own = glm::vec4(surface.own * pre_exposure_);
            push_constants();
        };
        const auto draw_surface = [&](const Draw& one) {
            bind(pipelines_.surface(variant_of(one, use_.light), kind));
            put_surface(one);
            commands.drawIndexed(
                one.index_count, one.count, one.first_index, world.primitives[one.primitive].vertex_offset, one.first);
        };
        for (; draw != list_.draws.end() && draw->image == i && !draw->blended; ++draw)
            draw_surface(*draw);
        const shared::CubePush surfaces_push = push;
        if (sky_ && !use_.several_rest_frames) {
            set_area(commands, image.atlas, image.size);
            bind(pipelines_.sky(world.milky_way >= 0, kind));
            commands.setCullMode(vk::CullModeFlagBits::eNone);
            commands.bindDescriptorSets(
                vk::PipelineBindPoint::eGraphics, *pipelines_.layouts.surface_layout, 1, *world_.materials.back(), {});
            glm::dvec3 origin = face_direction(image.face, image.low);
            push.clip_x = glm::vec4(origin, 0);
            push.clip_y = glm::vec4(a * (image.high.x - image.low.x), 0);
            push.clip_w = glm::vec4(b * (image.high.y - image.low.y), 0);
            push_constants();
            commands.draw(3, 1, 0, 0);
            push = surfaces_push, material = -1;
            set_guarded_area(commands, image);
        }
        // Blended surfaces, from behind.
        const auto first_blended = draw;
        for (; draw != list_.draws.end() && draw->image == i; ++draw) {
            if (draw == first_blended)
                commands.bindIndexBuffer(uploads_.sorted_indices(), 0, vk::IndexType::eUint32);
            draw_surface(*draw);
        }
        if (draw != first_blended)
            commands.bindIndexBuffer(*world_.indices.buffer, 0, vk::IndexType::eUint32);
        if (device_.keeper)
            device_.keeper->hold(commands); // a scene ends whenever its memory is full
    }
}

void CubePass::record_plain(vk::CommandBuffer commands, const Target& target)
{
    target_.begin_plain(commands, target, glm::vec4(world_.scene.sky.horizon * pre_exposure_, 1));
    draw_images(commands, {{target.format}});
    device_.end_rendering(commands);
}

} // namespace starbow
