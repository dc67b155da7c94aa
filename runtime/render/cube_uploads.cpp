#include "cube_uploads.h"
#include "command_counts.h"
#include "debug.h"
#include "lamp.h"
#include "runtime/plan/scratch.h"
#include "runtime/world/clock.h"
#include "runtime/world/shadows.h"
#include <algorithm>

namespace starbow {
namespace {

template <class T>
void put(const Device& device, Buffer& buffer, const std::vector<T>& data,
    vk::BufferUsageFlags usage = vk::BufferUsageFlagBits::eStorageBuffer)
{
    grow(device, buffer, data.size() * sizeof(T), usage);
    copy_to(buffer, std::as_bytes(std::span(data)));
}

} // namespace

CubeUploads::CubeUploads(Device& device, const Pipelines& pipelines, const GpuWorld& world)
    : device_(device)
    , pipelines_(pipelines)
    , world_(world)
{
    const vk::DeviceSize step = device.properties.limits.minUniformBufferOffsetAlignment;
    stride_ = (sizeof(shared::CubeConstants) + step - 1) / step * step;
    const std::size_t rest_frames = world.world.frames.size();
    constants_ = make_mapped_buffer(device, rest_frames * stride_, vk::BufferUsageFlagBits::eUniformBuffer);
    name_object(device, constants_, "cube pass: constants");
    tiles_ = make_mapped_buffer(device, sizeof(shared::TileTable), vk::BufferUsageFlagBits::eUniformTexelBuffer);
    name_object(device, tiles_, "cube pass: tiles");
    tiles_view_ = device.device.createBufferView({{}, *tiles_.buffer, exact_format, 0, VK_WHOLE_SIZE});
    name_object(device, tiles_view_, "cube pass: tiles view");
    std::vector<vk::DescriptorPoolSize> sizes
        = {{vk::DescriptorType::eUniformBufferDynamic, 1}, {vk::DescriptorType::eUniformBuffer, 1},
            {vk::DescriptorType::eStorageBuffer, 7}, {vk::DescriptorType::eCombinedImageSampler, 2}};
    pool_ = device.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes});
    name_object(device, pool_, "cube pass: descriptor pool");
    set_ = std::move(device.device.allocateDescriptorSets({*pool_, *pipelines.layouts.eye_set}).front());
    name_object(device, set_, "cube pass: descriptor set");
    const vk::DescriptorImageInfo maps(
        *world.nearest_sampler, *world.shadow_maps.view, vk::ImageLayout::eShaderReadOnlyOptimal),
        cells(*world.sky_sampler, *world.sky_cells.view, vk::ImageLayout::eShaderReadOnlyOptimal);
    const vk::DescriptorBufferInfo deforming(*world.deforming.buffer, 0, VK_WHOLE_SIZE);
    device.device.updateDescriptorSets(
        {vk::WriteDescriptorSet(*set_, 7, 0, vk::DescriptorType::eStorageBuffer, nullptr, deforming),
            vk::WriteDescriptorSet(*set_, 5, 0, vk::DescriptorType::eCombinedImageSampler, maps),
            vk::WriteDescriptorSet(*set_, 6, 0, vk::DescriptorType::eCombinedImageSampler, cells)},
        {});
}

void CubeUploads::write(const DrawList& list, const std::vector<shared::SkyImage>& skies,
    std::span<const EyeEvent> eye_events, StoredLight light, double pre_exposure)
{
    put(device_, instances_, list.instances);
    put(device_, visible_, list.visible);
    put(device_, skies_, skies);
    if (!list.sorted_indices.empty())
        put(device_, sorted_indices_, list.sorted_indices, vk::BufferUsageFlagBits::eIndexBuffer);
    write_draws(list, pre_exposure);
    std::vector<shared::TimeEntry>& times = time_writes_;
    times.clear();
    for (std::size_t rest_frame = 0; rest_frame < eye_events.size(); ++rest_frame) {
        shared::CubeConstants constants = constants_of(eye_events[rest_frame], light, pre_exposure);
        constants.first = glm::vec4(list.first[rest_frame], times.size(), list.first_pose[rest_frame], 0);
        copy_to(constants_, std::as_bytes(std::span(&constants, 1)), rest_frame * stride_);
        const auto own = time_entries(world_.world, eye_events[rest_frame], world_.scene.seconds_per_time_unit());
        times.insert(times.end(), own.begin(), own.end());
    }
    if (!times.empty())
        put(device_, times_, times);

    write_set(light == StoredLight::unshifted ? world_.unshifted_columns : world_.columns);
}

void CubeUploads::write_tile_table(const CubeMapPlan& plan)
{
    count_upload(write_tiles(plan, *static_cast<shared::TileTable*>(tiles_.mapped)));
}

void CubeUploads::bind(vk::CommandBuffer commands, int rest_frame) const
{
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.layouts.surface_layout, 0, *set_,
        std::uint32_t(std::size_t(rest_frame) * stride_));
}

void CubeUploads::write_draws(const DrawList& list, double pre_exposure)
{
    draw_writes_.clear(), command_writes_.clear(), surface_writes_.clear();
    for (const Draw& draw : list.draws) {
        const Primitive& primitive = world_.world.primitives[draw.primitive];
        draw_writes_.push_back({std::uint32_t(primitive.material), world_.shadows ? float(draw.apart) : 0});
        command_writes_.push_back(
            {draw.index_count, draw.count, draw.first_index, std::int32_t(primitive.vertex_offset), draw.first});
    }
    for (std::size_t i = 0; i < world_.world.materials.size(); ++i) {
        const Material& material = world_.world.materials[i];
        const Spectra::Surface& surface = world_.spectra.surfaces[i];
        surface_writes_.push_back({material.base_colour,
            glm::vec4(material.emissive * float(surface.emission * pre_exposure), material.alpha_cutoff), surface.beyond,
            glm::vec4(surface.own * pre_exposure)});
    }
    reserve_headroom(draw_writes_), reserve_headroom(command_writes_);
    put(device_, draws_, draw_writes_);
    put(device_, draw_commands_, command_writes_, vk::BufferUsageFlagBits::eIndirectBuffer);
    put(device_, surfaces_, surface_writes_);
}

void CubeUploads::write_set(const Buffer& columns)
{
    const Buffer& times = *times_.buffer ? times_ : instances_; // without finite existences the shader reads no times
    struct Held {
        std::uint32_t binding;
        vk::DescriptorType type;
        const Buffer* buffer;
    };
    constexpr auto storage = vk::DescriptorType::eStorageBuffer;
    const std::array<Held, 8> held = {{{0, vk::DescriptorType::eUniformBufferDynamic, &constants_},
        {1, storage, &instances_}, {2, storage, &visible_}, {3, vk::DescriptorType::eUniformBuffer, &columns},
        {4, storage, &times}, {8, storage, &draws_}, {9, storage, &surfaces_}, {10, storage, &skies_}}};
    std::array<std::uint64_t, held.size()> serials;
    std::array<vk::DescriptorBufferInfo, held.size()> infos;
    std::array<vk::WriteDescriptorSet, held.size()> writes;
    for (std::size_t i = 0; i < held.size(); ++i) {
        const auto& [binding, type, buffer] = held[i];
        serials[i] = buffer->serial;
        infos[i]
            = vk::DescriptorBufferInfo(*buffer->buffer, 0, binding == 0 ? sizeof(shared::CubeConstants) : VK_WHOLE_SIZE);
        writes[i] = vk::WriteDescriptorSet(*set_, binding, 0, 1, type, nullptr, &infos[i]);
    }
    if (serials == written_)
        return;
    device_.device.updateDescriptorSets(writes, {});
    written_ = serials;
}

shared::CubeConstants CubeUploads::constants_of(const EyeEvent& eye_event, StoredLight light, double pre_exposure) const
{
    const SceneFile& scene = world_.scene;
    const double scale = pre_exposure;
    shared::CubeConstants constants{};
    constants.ambient = glm::vec4(scene.ambient * scale, scale);
    constants.sky = sky_constants(world_, light, eye_event.cube_from_frame, scale);
    const std::array<glm::dvec3, 3> around = surroundings_of(scene, eye_event.frame);
    for (std::size_t i = 0; i < around.size(); ++i)
        constants.around[i] = glm::vec4(around[i] * scale, 0);
    if (world_.world.shadows && eye_event.frame == 0)
        write_shadows(constants, eye_event);
    constants.now[0] = glm::vec4(0, 0, eye_event.beta, eye_event.now);
    const double ahead = growth_towards(eye_event, eye_event.ahead);
    const double back = growth_towards(eye_event, -eye_event.ahead);
    constants.growth[0] = glm::vec4(0.5 * (ahead - back) * eye_event.ahead, 0.5 * (ahead + back));
    for (std::size_t i = 0; i < world_.world.lamps.size(); ++i)
        constants.lights[i] = light_entry(world_, world_.world.lamps[i], eye_event, scale);
    return constants;
}

void CubeUploads::write_shadows(shared::CubeConstants& constants, const EyeEvent& eye_event) const
{
    const Shadows& shadows = *world_.world.shadows;
    // The row that takes a place from the eye, in the cube map's axes, to `scale` times its place along an axis of the
    // frame from `zero`.
    const auto row = [&](const glm::dvec3& axis, double zero, double scale) {
        return glm::vec4(scale * (eye_event.cube_from_frame * axis), scale * (glm::dot(axis, eye_event.place) - zero));
    };
    for (int k = 0; k < 3; ++k) {
        glm::dvec3 axis(0);
        axis[k] = 1;
        constants.sky_cells[k] = row(axis, shadows.low[k], 1 / shadows.cell);
    }
    for (std::size_t i = 0; i < world_.world.lamps.size(); ++i)
        for (const ShadowMap& map : shadows.maps) {
            if (map.light != world_.world.lamps[i].light)
                continue;
            shared::ShadowEntry& entry = constants.shadows[i];
            const double per_unit = 1 / (map.nearest - map.nothing), step = 1.0 / 65535;
            entry.map = glm::vec4(map.layer, 1.0 / shadows.size, 0, 2 * step);
            if (map.point) {
                glm::vec4* rows[] = {&entry.u, &entry.v, &entry.depth};
                for (int k = 0; k < 3; ++k) {
                    glm::dvec3 axis(0);
                    axis[k] = 1;
                    *rows[k] = row(axis, map.place[k], 1);
                }
                entry.coarse = glm::vec4(-per_unit, -map.nothing * per_unit, 0, 0);
                continue;
            }
            entry.u = row(map.axes[0], map.low[0].x, 1 / map.texel[0].x);
            entry.v = row(map.axes[1], map.low[0].y, 1 / map.texel[0].y);
            entry.depth = row(map.axes[2], map.nothing, per_unit);
            const glm::dvec2 scale = map.texel[0] / map.texel[1], offset = (map.low[0] - map.low[1]) / map.texel[1];
            entry.coarse = glm::vec4(scale, offset);
            // The slope of a surface that the light meets at 1.15 degrees.
            entry.map.z = float(50 * std::max(map.texel[0].x, map.texel[0].y) * per_unit);
        }
}

} // namespace starbow
