#include "frame.h"
#include "colour.h"
#include "displays/direction_map.h"
#include "physics/physics.h"
#include <algorithm>
#include <cmath>
#include <cstring>

namespace starbow {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;
using Layout_ = vk::ImageLayout;

constexpr double near_distance = 1e-6; // scene units; reversed z keeps its precision at any ratio
constexpr double degree = 3.14159265358979323846 / 180;

vk::SampleCountFlagBits sample_bits(int samples)
{
    return samples >= 8 ? vk::SampleCountFlagBits::e8
        : samples >= 4  ? vk::SampleCountFlagBits::e4
        : samples >= 2  ? vk::SampleCountFlagBits::e2
                        : vk::SampleCountFlagBits::e1;
}

glm::vec4 row(const glm::dmat3& m, int i, double w = 0) { return glm::vec4(m[0][i], m[1][i], m[2][i], w); }
glm::vec4 row(const glm::dmat4& m, int i) { return glm::vec4(m[0][i], m[1][i], m[2][i], m[3][i]); }

/// Panel axes from the cockpit's: x right and y up on the panel, z = 1 on its plane, the origin at its middle. Flat screens
/// get a panel parallel to them, so that its lines stay level; everywhere else it faces the visitor.
glm::dmat3 panel_from_cockpit(const HudPlacement& hud, bool flat)
{
    double a = hud.azimuth_deg * degree, e = hud.elevation_deg * degree;
    glm::dvec3 middle(std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e));
    if (flat && middle.z < -0.2) {
        glm::dvec2 at = glm::dvec2(middle) / -middle.z;
        return glm::transpose(glm::dmat3(glm::dvec3(1, 0, at.x), glm::dvec3(0, 1, at.y), glm::dvec3(0, 0, -1)));
    }
    glm::dvec3 x(std::cos(a), 0, std::sin(a));
    return glm::transpose(glm::dmat3(x, glm::cross(-middle, x), middle));
}

vk::Rect2D rect_of(glm::ivec2 corner, glm::ivec2 size)
{
    return {{corner.x, corner.y}, {std::uint32_t(size.x), std::uint32_t(size.y)}};
}

void set_area(vk::CommandBuffer commands, glm::ivec2 corner, glm::ivec2 size)
{
    commands.setViewport(0, vk::Viewport(corner.x, corner.y, size.x, size.y, 0, 1));
    commands.setScissor(0, rect_of(corner, size));
}

} // namespace

Frame::Frame(Device& device, Pipelines& pipelines, const GpuWorld& world, const Layout& layout, const Quality& quality,
    bool keeps_depth)
    : quality_(quality)
    , device_(device)
    , pipelines_(pipelines)
    , world_(world)
    , layout_(layout)
    , keeps_depth_(keeps_depth)
{
    const Sky& sky = world.scene.sky;
    sky_ = sky.zenith != sky.horizon || sky.nadir != sky.horizon;
    linear_ = device.device.createSampler({{}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eLinear,
        vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge, 0,
        false, 1, false, {}, 0, VK_LOD_CLAMP_NONE});
    nearest_ = device.device.createSampler({});
    finest_ = device.device.createSampler({{}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eNearest,
        vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge});
    const std::vector<glm::vec4> table = doppler_table();
    colours_ = make_static_buffer(device, std::as_bytes(std::span(table)), vk::BufferUsageFlagBits::eUniformBuffer);
    const float zeros[4] = {};
    nothing_ = make_texture(device, exact_format, {1, 1}, std::as_bytes(std::span(zeros)), false);

    std::uint32_t views = 0;
    for (const Output& output : layout.outputs)
        views += std::uint32_t(output.viewports.size());
    // Every viewport may have an eye of its own.
    std::vector<vk::DescriptorPoolSize> sizes = {{vk::DescriptorType::eUniformBuffer, 3 * views},
        {vk::DescriptorType::eStorageBuffer, 2 * views}, {vk::DescriptorType::eCombinedImageSampler, 5 * views}};
    pool_ = device.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 3 * views, sizes});
    auto make_set = [&](const vk::raii::DescriptorSetLayout& set_layout) {
        return std::move(device.device.allocateDescriptorSets({*pool_, *set_layout}).front());
    };

    for (std::size_t output = 0; output < layout.outputs.size(); ++output) {
        sizes_.push_back({0, 0});
        for (const Viewport& viewport : layout.outputs[output].viewports) {
            auto same = std::find_if(eyes_.begin(), eyes_.end(), [&](const Eye& e) { return e.offset_m == viewport.eye_m; });
            if (same == eyes_.end()) {
                Eye eye;
                eye.offset_m = viewport.eye_m;
                eye.constants
                    = make_mapped_buffer(device, sizeof(shared::CubeConstants), vk::BufferUsageFlagBits::eUniformBuffer);
                eye.slots = make_mapped_buffer(
                    device, SLOT_COUNT * sizeof(shared::SlotEntry), vk::BufferUsageFlagBits::eUniformBuffer);
                eye.set = make_set(pipelines.eye_set);
                eyes_.push_back(std::move(eye));
                same = eyes_.end() - 1;
            }
            ViewState view;
            view.output = output;
            view.eye = std::size_t(same - eyes_.begin());
            view.projection = viewport.projection;
            view.warp_set = make_set(pipelines.warp_set);
            view.hud_set = make_set(pipelines.picture_set);
            views_.push_back(std::move(view));
        }
    }
    plans_.resize(eyes_.size());
    bool flat
        = std::all_of(views_.begin(), views_.end(), [](auto& v) { return std::holds_alternative<Planar>(v.projection); });
    panel_from_cockpit_ = panel_from_cockpit(layout.hud, flat);
    for (std::size_t output = 0; output < layout.outputs.size(); ++output)
        resize(output, layout.outputs[output].size);
}

void Frame::resize(std::size_t output, glm::ivec2 size)
{
    if (sizes_[output] == size)
        return;
    sizes_[output] = size;
    const Viewport* viewport = layout_.outputs[output].viewports.data();
    for (ViewState& view : views_)
        if (view.output == output) {
            glm::ivec4 rect = pixel_rect(*viewport++, size);
            view.corner = {rect.x, rect.y};
            place_view(view, glm::max(glm::ivec2(rect.z, rect.w), 1));
        }
}

void Frame::place_view(ViewState& view, glm::ivec2 size)
{
    view.size = size;
    if (auto planar = planar_matrix(view.projection, size)) {
        view.cockpit_from_pixel = *planar;
    } else {
        DirectionMap map = compile(view.projection, size);
        view.map = make_texture(device_, exact_format, size, std::as_bytes(std::span(map.texels)), false);
    }
    // The panel's rim, projected, bounds it: its inside is nowhere outside its rim in any continuous view.
    glm::dmat3 cockpit_from_panel = glm::inverse(panel_from_cockpit_);
    panel_half_ = std::tan(0.5 * layout_.hud.width_deg * degree) * glm::dvec2(1, panel_aspect);
    glm::dvec2 low(1e9), high(-1e9);
    for (int i = 0; i <= 16; ++i)
        for (glm::dvec2 at : {glm::dvec2(i / 8.0 - 1, -1), glm::dvec2(i / 8.0 - 1, 1), glm::dvec2(-1, i / 8.0 - 1),
                 glm::dvec2(1, i / 8.0 - 1), glm::dvec2(0)})
            if (auto p = pixel(view.projection, size, glm::normalize(cockpit_from_panel * glm::dvec3(at * panel_half_, 1))))
                low = glm::min(low, *p), high = glm::max(high, *p);
    glm::ivec2 first = glm::clamp(glm::ivec2(glm::clamp(low, -1e6, 1e6)) - 4, glm::ivec2(0), size);
    glm::ivec2 last = glm::clamp(glm::ivec2(glm::clamp(high, -1e6, 1e6)) + 4, first, size);
    view.hud_box = rect_of(view.corner + first, last - first);
}

int Frame::hud_width() const
{
    double finest = 1;
    for (const ViewState& view : views_) {
        glm::dvec3 middle = glm::inverse(panel_from_cockpit_) * glm::dvec3(0, 0, 1);
        if (auto p = pixel(view.projection, view.size, glm::normalize(middle)))
            finest = std::min(finest, pixel_angle(view.projection, view.size, *p));
    }
    return std::clamp(int(2 * panel_half_.x / finest), 160, 4096);
}

void Frame::fit_buffer(Buffer& buffer, vk::DeviceSize size, vk::BufferUsageFlags usage)
{
    if (buffer.size < size || !*buffer.buffer)
        buffer = make_mapped_buffer(device_, size + size / 2, usage);
}

void Frame::fit(Eye& eye, glm::ivec2 size, int levels)
{
    bool enough = *eye.atlas.view && int(eye.atlas.extent.width) >= size.x && int(eye.atlas.extent.height) >= size.y
        && int(eye.atlas.levels) >= levels;
    if (enough)
        return;
    auto grown = [](int needed, std::uint32_t had) { return std::max((std::uint32_t(needed) + 255) / 256 * 256, had); };
    vk::Extent2D extent(grown(size.x, eye.atlas.extent.width), grown(size.y, eye.atlas.extent.height));
    auto most = std::max(std::uint32_t(levels), eye.atlas.levels);
    using Usage = vk::ImageUsageFlagBits;
    eye.atlas = {}, eye.depth = {}, eye.atlas_samples = {}, eye.depth_samples = {};
    auto copied = most > 1 ? Usage::eTransferSrc | Usage::eTransferDst : vk::ImageUsageFlags();
    eye.atlas = make_image(device_, {light_format, extent, Usage::eColorAttachment | Usage::eSampled | copied, most});
    eye.depth = make_image(device_, {depth_format, extent, Usage::eDepthStencilAttachment | Usage::eSampled});
    if (quality_.samples > 1) {
        vk::SampleCountFlagBits samples = sample_bits(quality_.samples);
        eye.atlas_samples = make_image(device_, {light_format, extent, Usage::eColorAttachment, 1, 1, samples});
        eye.depth_samples = make_image(device_, {depth_format, extent, Usage::eDepthStencilAttachment, 1, 1, samples});
    }
}

void Frame::prepare(const Shot& shot, const Panel* hud)
{
    shot_ = shot;
    E_ = physics::exp_rapidity(glm::length(shot.u));
    glm::dmat3 to_motion = motion_from_world(shot.u, shot.ship_from_cockpit);
    glm::dmat3 motion_from_cockpit = to_motion * glm::dmat3(glm::mat3_cast(shot.ship_from_cockpit));
    triangles_ = 0;
    for (std::size_t i = 0; i < eyes_.size(); ++i) {
        std::vector<View> asked;
        for (ViewState& view : views_)
            if (view.eye == i) {
                view.motion_from_cockpit = motion_from_cockpit;
                asked.push_back({view.projection, view.size, motion_from_cockpit});
            }
        plans_[i] = make_plan(asked, shot.effects.aberration ? E_ : 1, quality_);

        glm::dvec3 offset = shot.ship_from_cockpit * eyes_[i].offset_m * (layout_.hyper_stereo / world_.scene.unit_m);
        glm::dvec3 place = shot.position + physics::eye_place(shot.u, offset);
        eyes_[i].list = cull(world_.world, place, to_motion, plans_[i].images);
        fit(eyes_[i], plans_[i].atlas_size, plans_[i].levels);
        upload_eye(eyes_[i], to_motion, place);
        glm::ivec2 size(eyes_[i].atlas.extent.width, eyes_[i].atlas.extent.height);
        auto table = slot_table(plans_[i], size);
        std::memcpy(eyes_[i].slots.mapped, table.data(), table.size() * sizeof(table[0]));
    }
    if (hud && (panel_.extent.width != std::uint32_t(hud->size.x) || panel_.extent.height != std::uint32_t(hud->size.y))) {
        panel_ = make_image(device_,
            {vk::Format::eR8G8Unorm, {std::uint32_t(hud->size.x), std::uint32_t(hud->size.y)},
                vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst});
        fit_buffer(panel_pixels_, hud->texels.size(), vk::BufferUsageFlagBits::eTransferSrc);
    }
    hud_on_ = hud;
    if ((panel_new_ = hud))
        std::memcpy(panel_pixels_.mapped, hud->texels.data(), hud->texels.size());
    write_sets();
}

void Frame::upload_eye(Eye& eye, const glm::dmat3& to_motion, const glm::dvec3& place)
{
    for (const Draw& draw : eye.list.draws)
        triangles_ += std::size_t(draw.count) * draw.index_count / 3;
    auto put = [&](Buffer& buffer, const auto& data) {
        fit_buffer(buffer, data.size() * sizeof(data[0]), vk::BufferUsageFlagBits::eStorageBuffer);
        if (!data.empty())
            std::memcpy(buffer.mapped, data.data(), data.size() * sizeof(data[0]));
    };
    put(eye.instances, eye.list.instances);
    put(eye.visible, eye.list.visible);

    const SceneFile& scene = world_.scene;
    double scale = world_.pre_exposure;
    shared::CubeConstants constants{};
    constants.ambient = glm::vec4(scene.ambient * scale, scale);
    constants.sky_zenith = glm::vec4(scene.sky.zenith * scale, 0);
    constants.sky_horizon = glm::vec4(scene.sky.horizon * scale, 0);
    constants.sky_nadir = glm::vec4(scene.sky.nadir * scale, 0);
    constants.world_up = glm::vec4(to_motion * glm::dvec3(0, 1, 0), 0);
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        shared::LightEntry& entry = constants.lights[i];
        if (auto* light = std::get_if<DirectionalLight>(&scene.lights[i]))
            entry = {glm::vec4(to_motion * light->towards, 0), glm::vec4(light->radiance * scale, 0)};
        else if (auto* point = std::get_if<PointLight>(&scene.lights[i]))
            entry = {glm::vec4(to_motion * (point->position - place), 1),
                glm::vec4(point->radiance * scale, point->distance * point->distance)};
    }
    std::memcpy(eye.constants.mapped, &constants, sizeof constants);
}

void Frame::write_sets()
{
    std::vector<vk::DescriptorBufferInfo> buffers;
    std::vector<vk::DescriptorImageInfo> images;
    buffers.reserve(5 * (eyes_.size() + views_.size()));
    images.reserve(5 * views_.size());
    std::vector<vk::WriteDescriptorSet> writes;
    auto buffer = [&](const vk::raii::DescriptorSet& set, std::uint32_t binding, vk::DescriptorType type, const Buffer& b) {
        buffers.push_back({*b.buffer, 0, VK_WHOLE_SIZE});
        writes.push_back({*set, binding, 0, 1, type, nullptr, &buffers.back()});
    };
    auto image
        = [&](const vk::raii::DescriptorSet& set, std::uint32_t binding, const Image& i, const vk::raii::Sampler& sampler) {
              images.push_back({*sampler, *i.view, vk::ImageLayout::eShaderReadOnlyOptimal});
              writes.push_back({*set, binding, 0, 1, vk::DescriptorType::eCombinedImageSampler, &images.back()});
          };
    for (const Eye& eye : eyes_) {
        buffer(eye.set, 0, vk::DescriptorType::eUniformBuffer, eye.constants);
        buffer(eye.set, 1, vk::DescriptorType::eStorageBuffer, eye.instances);
        buffer(eye.set, 2, vk::DescriptorType::eStorageBuffer, eye.visible);
    }
    for (const ViewState& view : views_) {
        const Eye& eye = eyes_[view.eye];
        const Image& map = view.planar() ? nothing_ : view.map;
        image(view.warp_set, 0, map, nearest_);
        image(view.warp_set, 1, eye.atlas, plans_[view.eye].levels > 1 ? linear_ : finest_);
        buffer(view.warp_set, 2, vk::DescriptorType::eUniformBuffer, eye.slots);
        buffer(view.warp_set, 3, vk::DescriptorType::eUniformBuffer, colours_);
        image(view.warp_set, 4, keeps_depth_ ? eye.depth : nothing_, nearest_);
        image(view.hud_set, 0, map, nearest_);
        image(view.hud_set, 1, hud_on_ ? panel_ : nothing_, linear_);
    }
    device_.device.updateDescriptorSets(writes, {});
}

void Frame::record(vk::CommandBuffer commands, std::span<const Target> targets)
{
    draw_cubes(commands);
    for (std::size_t output = 0; output < targets.size(); ++output) {
        if (!targets[output].view)
            continue; // minimised
        warp_output(commands, output, targets[output]);
        draw_hud(commands, output, targets[output]);
    }
}

void Frame::draw_cubes(vk::CommandBuffer commands)
{
    for (std::size_t i = 0; i < eyes_.size(); ++i)
        draw_eye(commands, eyes_[i], plans_[i]);
}

void Frame::draw_eye(vk::CommandBuffer commands, Eye& eye, const Plan& plan)
{
    bool sampled = quality_.samples > 1;
    const Image& colour = sampled ? eye.atlas_samples : eye.atlas;
    const Image& depth = sampled ? eye.depth_samples : eye.depth;
    transition(commands, eye.atlas, Layout_::eUndefined, Stage::eFragmentShader, {}, Layout_::eColorAttachmentOptimal,
        Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite | Access::eColorAttachmentRead);
    constexpr auto tests = Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;
    constexpr auto depth_access = Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite;
    transition(commands, eye.depth, Layout_::eUndefined, tests | Stage::eFragmentShader | Stage::eColorAttachmentOutput,
        depth_access, Layout_::eDepthAttachmentOptimal, tests | Stage::eColorAttachmentOutput,
        depth_access | Access::eColorAttachmentWrite);
    if (sampled) {
        transition(commands, colour, Layout_::eUndefined, Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite,
            Layout_::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
            Access::eColorAttachmentWrite | Access::eColorAttachmentRead);
        transition(commands, depth, Layout_::eUndefined, tests, depth_access, Layout_::eDepthAttachmentOptimal, tests,
            depth_access);
    }
    glm::dvec3 sky = world_.scene.sky.horizon * world_.pre_exposure;
    vk::ClearColorValue clear(std::array<float, 4>{float(sky.r), float(sky.g), float(sky.b), 1});
    vk::RenderingAttachmentInfo colour_info(*colour.view, Layout_::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eClear, sampled ? vk::AttachmentStoreOp::eDontCare : vk::AttachmentStoreOp::eStore, clear);
    vk::RenderingAttachmentInfo depth_info(*depth.view, Layout_::eDepthAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eClear,
        keeps_depth_ && !sampled ? vk::AttachmentStoreOp::eStore : vk::AttachmentStoreOp::eDontCare,
        vk::ClearDepthStencilValue(0, 0));
    if (sampled) {
        colour_info.resolveMode = vk::ResolveModeFlagBits::eAverage;
        colour_info.resolveImageView = *eye.atlas.view;
        colour_info.resolveImageLayout = Layout_::eColorAttachmentOptimal;
        if (keeps_depth_) {
            depth_info.resolveMode = vk::ResolveModeFlagBits::eSampleZero;
            depth_info.resolveImageView = *eye.depth.view;
            depth_info.resolveImageLayout = Layout_::eDepthAttachmentOptimal;
        }
    }
    commands.beginRendering({{}, rect_of({0, 0}, plan.atlas_size), 1, 0, colour_info, &depth_info});
    draw_images(commands, eye, plan.images, {light_format, sample_bits(quality_.samples)});
    commands.endRendering();
    if (plan.levels > 1)
        make_mips(commands, eye, plan);
    else
        transition(commands, eye.atlas, Layout_::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
            Access::eColorAttachmentWrite, Layout_::eShaderReadOnlyOptimal, Stage::eFragmentShader,
            Access::eShaderSampledRead);
    if (keeps_depth_)
        transition(commands, eye.depth, Layout_::eDepthAttachmentOptimal, tests | Stage::eColorAttachmentOutput,
            depth_access | Access::eColorAttachmentWrite, Layout_::eShaderReadOnlyOptimal, Stage::eFragmentShader,
            Access::eShaderSampledRead);
}

void Frame::draw_images(
    vk::CommandBuffer commands, const Eye& eye, std::span<const PlanImage> images, const TargetKind& kind)
{
    const World& world = world_.world;
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.surface_layout, 0, *eye.set, {});
    commands.bindVertexBuffers(0, *world_.vertices.buffer, vk::DeviceSize(0));
    commands.bindIndexBuffer(*world_.indices.buffer, 0, vk::IndexType::eUint32);
    constexpr auto stages = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;
    auto draw = eye.list.draws.begin();
    vk::Pipeline bound;
    for (std::uint32_t i = 0; i < images.size(); ++i) {
        const PlanImage& image = images[i];
        set_area(commands, image.atlas, image.size);
        glm::dmat4 clip = clip_from_motion(image, near_distance);
        shared::CubePush push{row(clip, 0), row(clip, 1), row(clip, 2), row(clip, 3), {}, {}};
        // Seen through a mirrored pair of face axes a surface's front turns the other way.
        glm::dvec3 a = face_direction(image.face, {1, 0}) - face_direction(image.face, {0, 0});
        glm::dvec3 b = face_direction(image.face, {0, 1}) - face_direction(image.face, {0, 0});
        bool mirrored = glm::dot(glm::cross(a, b), face_direction(image.face, {0, 0})) < 0;
        commands.setFrontFace(mirrored ? vk::FrontFace::eClockwise : vk::FrontFace::eCounterClockwise);
        if (image.hole > 0) {
            // Nothing is nearer than the near plane: what falls into the hole fails the depth test before it is shaded.
            glm::dvec2 low = glm::ceil((-glm::dvec2(image.hole) - image.low) * image.texels_per_unit);
            glm::dvec2 high = glm::floor((glm::dvec2(image.hole) - image.low) * image.texels_per_unit);
            glm::ivec2 first = glm::clamp(glm::ivec2(low), glm::ivec2(0), image.size),
                       last = glm::clamp(glm::ivec2(high), first, image.size);
            if (last.x > first.x && last.y > first.y)
                commands.clearAttachments(
                    vk::ClearAttachment(vk::ImageAspectFlagBits::eDepth, 0, vk::ClearDepthStencilValue(1, 0)),
                    vk::ClearRect(rect_of(image.atlas + first, last - first), 0, 1));
        }
        int material = -1;
        for (; draw != eye.list.draws.end() && draw->image == i; ++draw) {
            const Primitive& primitive = world.primitives[draw->primitive];
            if (primitive.material != material) {
                material = primitive.material;
                const Material& m = world.materials[material];
                if (vk::Pipeline pipeline = pipelines_.surface(world_.variant(material), kind); pipeline != bound)
                    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, bound = pipeline);
                commands.bindDescriptorSets(
                    vk::PipelineBindPoint::eGraphics, *pipelines_.surface_layout, 1, *world_.materials[material], {});
                commands.setCullMode(m.double_sided ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack);
                push.base_colour = m.base_colour;
                push.emissive = glm::vec4(m.emissive * float(world_.pre_exposure), m.alpha_cutoff);
                commands.pushConstants<shared::CubePush>(*pipelines_.surface_layout, stages, 0, push);
            }
            commands.drawIndexed(draw->index_count, draw->count, draw->first_index, primitive.vertex_offset, draw->first);
        }
        if (sky_) {
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

void Frame::make_mips(vk::CommandBuffer commands, Eye& eye, const Plan& plan)
{
    auto level_barrier = [&](std::uint32_t first, std::uint32_t count, Layout_ from, Stage from_stage,
                             vk::AccessFlags2 from_access, Layout_ to, Stage to_stage, vk::AccessFlags2 to_access) {
        vk::ImageMemoryBarrier2 barrier(from_stage, from_access, to_stage, to_access, from, to, VK_QUEUE_FAMILY_IGNORED,
            VK_QUEUE_FAMILY_IGNORED, *eye.atlas.image, {vk::ImageAspectFlagBits::eColor, first, count, 0, 1});
        commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
    };
    // One level more than is asked for: at its coarsest level an image is sampled together with the next, at weight nought,
    // and nought times what was never written may be NaN.
    std::uint32_t levels = std::min(std::uint32_t(plan.levels) + 1, eye.atlas.levels);
    level_barrier(0, 1, Layout_::eColorAttachmentOptimal, Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite,
        Layout_::eTransferSrcOptimal, Stage::eTransfer, Access::eTransferRead);
    level_barrier(1, eye.atlas.levels - 1, Layout_::eColorAttachmentOptimal, Stage::eColorAttachmentOutput, {},
        Layout_::eTransferDstOptimal, Stage::eTransfer, Access::eTransferWrite);
    for (std::uint32_t level = 1; level < levels; ++level) {
        std::vector<vk::ImageBlit> blits;
        for (const PlanImage& image : plan.images)
            if (image.levels >= int(level)) {
                auto box = [&](std::uint32_t l) {
                    glm::ivec2 low = image.atlas >> glm::ivec2(l), high = (image.atlas + image.size) >> glm::ivec2(l);
                    return std::array<vk::Offset3D, 2>{vk::Offset3D(low.x, low.y, 0), vk::Offset3D(high.x, high.y, 1)};
                };
                blits.push_back({{vk::ImageAspectFlagBits::eColor, level - 1, 0, 1}, box(level - 1),
                    {vk::ImageAspectFlagBits::eColor, level, 0, 1}, box(level)});
            }
        commands.blitImage(*eye.atlas.image, Layout_::eTransferSrcOptimal, *eye.atlas.image, Layout_::eTransferDstOptimal,
            blits, vk::Filter::eLinear);
        level_barrier(level, 1, Layout_::eTransferDstOptimal, Stage::eTransfer, Access::eTransferWrite,
            Layout_::eTransferSrcOptimal, Stage::eTransfer, Access::eTransferRead);
    }
    level_barrier(0, levels, Layout_::eTransferSrcOptimal, Stage::eTransfer, {}, Layout_::eShaderReadOnlyOptimal,
        Stage::eFragmentShader, Access::eShaderSampledRead);
    if (eye.atlas.levels > levels)
        level_barrier(levels, eye.atlas.levels - levels, Layout_::eTransferDstOptimal, Stage::eTransfer, {},
            Layout_::eShaderReadOnlyOptimal, Stage::eFragmentShader, Access::eShaderSampledRead);
}

WarpVariant Frame::variant(const ViewState& view) const
{
    bool moves = E_ != 1; // at rest there is nothing to shift
    const Effects& on = shot_.effects;
    return {!view.planar(), on.aberration && moves, on.doppler && moves, on.headlight && moves, plans_[view.eye].levels > 1};
}

shared::ViewPush Frame::push(const ViewState& view, const glm::dmat3& axes_from_cockpit) const
{
    glm::dmat3 m = axes_from_cockpit * view.cockpit_from_pixel;
    // Planar: one pixel's step on the plane at distance 1, the root of its area.
    double unit = view.planar() ? std::sqrt(glm::length(glm::cross(m[0], m[1]))) : 0;
    shared::ViewPush push{};
    push.row0 = row(m, 0, unit);
    push.row1 = row(m, 1, plans_[view.eye].rear_last);
    push.row2 = row(m, 2);
    push.origin = glm::vec4(view.corner, eyes_[view.eye].atlas.extent.width, eyes_[view.eye].atlas.extent.height);
    return push;
}

void Frame::warp_view(vk::CommandBuffer commands, const ViewState& view, vk::Pipeline pipeline, double exposure)
{
    shared::ViewPush constants = push(view, view.motion_from_cockpit);
    constants.boost = glm::vec4(E_, 1 / E_, exposure / world_.pre_exposure, near_distance);
    set_area(commands, view.corner, view.size);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.warp_layout, 0, *view.warp_set, {});
    commands.pushConstants<shared::ViewPush>(*pipelines_.warp_layout, vk::ShaderStageFlagBits::eFragment, 0, constants);
    commands.draw(3, 1, 0, 0);
}

void Frame::warp_output(vk::CommandBuffer commands, std::size_t output, const Target& target)
{
    vk::RenderingAttachmentInfo colour(target.view, Layout_::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore, vk::ClearColorValue(std::array<float, 4>{0, 0, 0, 1}));
    commands.beginRendering({{}, {{0, 0}, target.extent}, 1, 0, colour});
    for (const ViewState& view : views_)
        if (view.output == output)
            warp_view(commands, view, pipelines_.warp(variant(view), target.format), std::exp2(shot_.exposure_ev));
    commands.endRendering();
}

void Frame::record_measured(vk::CommandBuffer commands, std::size_t output, const MeasureTarget& target)
{
    draw_cubes(commands);
    float nothing = std::nanf("");
    std::vector<vk::RenderingAttachmentInfo> colours;
    for (const Image* image : {&target.light_and_depth, &target.camera, &target.world}) {
        transition(commands, *image, Layout_::eUndefined, Stage::eNone, {}, Layout_::eColorAttachmentOptimal,
            Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite);
        colours.push_back({*image->view, Layout_::eColorAttachmentOptimal, {}, {}, {}, vk::AttachmentLoadOp::eClear,
            vk::AttachmentStoreOp::eStore, vk::ClearColorValue(std::array<float, 4>{nothing, nothing, nothing, nothing})});
    }
    commands.beginRendering({{}, {{0, 0}, target.camera.extent}, 1, 0, colours});
    for (const ViewState& view : views_)
        if (view.output == output)
            warp_view(commands, view, pipelines_.measure(variant(view)), 1);
    commands.endRendering();
    for (const Image* image : {&target.light_and_depth, &target.camera, &target.world})
        transition(commands, *image, Layout_::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
            Access::eColorAttachmentWrite, Layout_::eTransferSrcOptimal, Stage::eTransfer, Access::eTransferRead);
}

void Frame::draw_hud(vk::CommandBuffer commands, std::size_t output, const Target& target)
{
    if (!hud_on_)
        return;
    if (panel_new_) {
        transition(commands, panel_, Layout_::eUndefined, Stage::eFragmentShader, {}, Layout_::eTransferDstOptimal,
            Stage::eTransfer, Access::eTransferWrite);
        commands.copyBufferToImage(*panel_pixels_.buffer, *panel_.image, Layout_::eTransferDstOptimal,
            vk::BufferImageCopy(
                0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {}, {panel_.extent.width, panel_.extent.height, 1}));
        transition(commands, panel_, Layout_::eTransferDstOptimal, Stage::eTransfer, Access::eTransferWrite,
            Layout_::eShaderReadOnlyOptimal, Stage::eFragmentShader, Access::eShaderSampledRead);
        panel_new_ = false;
    }
    vk::ImageMemoryBarrier2 after_warp(Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite,
        Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite | Access::eColorAttachmentRead,
        Layout_::eColorAttachmentOptimal, Layout_::eColorAttachmentOptimal, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED,
        target.image, {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
    commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, after_warp));
    vk::RenderingAttachmentInfo colour(target.view, Layout_::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eLoad, vk::AttachmentStoreOp::eStore);
    commands.beginRendering({{}, {{0, 0}, target.extent}, 1, 0, colour});
    for (const ViewState& view : views_) {
        if (view.output != output || view.hud_box.extent.width == 0 || view.hud_box.extent.height == 0)
            continue;
        shared::ViewPush constants = push(view, panel_from_cockpit_);
        constants.boost = glm::vec4(panel_half_, 0, 0);
        set_area(commands, view.corner, view.size);
        commands.setScissor(0, view.hud_box);
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.hud(!view.planar(), target.format));
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.picture_layout, 0, *view.hud_set, {});
        commands.pushConstants<shared::ViewPush>(
            *pipelines_.picture_layout, vk::ShaderStageFlagBits::eFragment, 0, constants);
        commands.draw(3, 1, 0, 0);
    }
    commands.endRendering();
}

void Frame::prepare_plain(const Shot& shot)
{
    const ViewState& view = views_.front();
    glm::dmat3 straight = motion_from_world({0, 0, 0}, shot.ship_from_cockpit);
    glm::dmat3 m = straight * glm::dmat3(glm::mat3_cast(shot.ship_from_cockpit)) * view.cockpit_from_pixel;
    glm::dvec3 low = m * glm::dvec3(0, 0, 1), high = m * glm::dvec3(view.size, 1);
    // The view's x may run against the face's a: the picture is then mirrored, at the same cost.
    glm::dvec2 one = glm::dvec2(low) / low.z, other = glm::dvec2(high) / high.z;
    PlanImage image{SLOT_FRONT, 0, glm::min(one, other), glm::max(one, other), view.size, {0, 0}, 0, 1};
    image.texels_per_unit = image.size.y / (image.high.y - image.low.y);
    plain_ = image;
    eyes_[0].list = cull(world_.world, shot.position, straight, {*plain_});
    upload_eye(eyes_[0], straight, shot.position);
    fit(eyes_[0], view.size, 1);
    if (!*plain_depth_.view)
        plain_depth_ = make_image(device_,
            {depth_format, {std::uint32_t(view.size.x), std::uint32_t(view.size.y)},
                vk::ImageUsageFlagBits::eDepthStencilAttachment});
    write_sets();
}

void Frame::draw_plain(vk::CommandBuffer commands, const Target& target)
{
    constexpr auto tests = Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;
    transition(commands, plain_depth_, Layout_::eUndefined, tests, Access::eDepthStencilAttachmentWrite,
        Layout_::eDepthAttachmentOptimal, tests, Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite);
    glm::dvec3 sky = world_.scene.sky.horizon * world_.pre_exposure;
    vk::RenderingAttachmentInfo colour(target.view, Layout_::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
        vk::ClearColorValue(std::array<float, 4>{float(sky.r), float(sky.g), float(sky.b), 1}));
    vk::RenderingAttachmentInfo depth(*plain_depth_.view, Layout_::eDepthAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eDontCare, vk::ClearDepthStencilValue(0, 0));
    commands.beginRendering({{}, {{0, 0}, target.extent}, 1, 0, colour, &depth});
    draw_images(commands, eyes_[0], std::span(&*plain_, 1), {target.format});
    commands.endRendering();
}

void Frame::look_up(vk::CommandBuffer commands, const Target& target, vk::Pipeline pipeline, vk::DescriptorSet set)
{
    const ViewState& view = views_.front();
    shared::ViewPush constants = push(view, view.motion_from_cockpit);
    vk::RenderingAttachmentInfo colour(target.view, Layout_::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore);
    commands.beginRendering({{}, {{0, 0}, target.extent}, 1, 0, colour});
    set_area(commands, view.corner, view.size);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.picture_layout, 0, set, {});
    commands.pushConstants<shared::ViewPush>(*pipelines_.picture_layout, vk::ShaderStageFlagBits::eFragment, 0, constants);
    commands.draw(3, 1, 0, 0);
    commands.endRendering();
}

vk::DeviceSize Frame::memory() const
{
    vk::DeviceSize bytes = panel_.bytes;
    for (const Eye& eye : eyes_)
        bytes += eye.atlas.bytes + eye.depth.bytes + eye.atlas_samples.bytes + eye.depth_samples.bytes;
    for (const ViewState& view : views_)
        bytes += view.map.bytes;
    return bytes;
}

} // namespace starbow
