#include "overlay_pass.h"
#include "debug.h"
#include "runtime/world/eye_event.h"
#include "shaders/physics/physics.h"
#include <cmath>

namespace starbow {
namespace {

/// Bytes from one view's constants to the next: Vulkan limits the alignment of uniform buffers to 256.
constexpr vk::DeviceSize stride = 256;
static_assert(sizeof(shared::OverlayConstants) <= stride);

} // namespace

OverlayPass::OverlayPass(
    const Device& device, Pipelines& pipelines, std::size_t views, const std::vector<glm::vec4>& figures)
    : pipelines_(pipelines)
    , constants_(make_mapped_buffer(device, views * stride, vk::BufferUsageFlagBits::eUniformBuffer))
    , has_figures_(!figures.empty())
{
    const std::vector<glm::vec4> nothing(1); // its descriptor is there all the same
    const auto table = std::as_bytes(std::span(has_figures_ ? figures : nothing));
    figures_ = make_mapped_buffer(device, table.size(), vk::BufferUsageFlagBits::eUniformTexelBuffer);
    name_object(device, figures_, "overlay pass: figures");
    copy_to(figures_, table);
    figures_view_ = device.device.createBufferView({{}, *figures_.buffer, exact_format, 0, VK_WHOLE_SIZE});
    name_object(device, figures_view_, "overlay pass: figures");
    const std::uint32_t count = std::uint32_t(views);
    const std::array sizes{vk::DescriptorPoolSize(vk::DescriptorType::eUniformBuffer, count),
        vk::DescriptorPoolSize(vk::DescriptorType::eUniformTexelBuffer, count)};
    pool_ = device.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, count, sizes});
    name_object(device, pool_, "overlay pass: descriptor pool");
    for (std::size_t i = 0; i < views; ++i) {
        name_object(device,
            sets_.emplace_back(
                std::move(device.device.allocateDescriptorSets({*pool_, *pipelines.layouts.overlay_set}).front())),
            "overlay pass: descriptor set");
        const vk::DescriptorBufferInfo part(*constants_.buffer, i * stride, sizeof(shared::OverlayConstants));
        device.device.updateDescriptorSets(
            {vk::WriteDescriptorSet(*sets_.back(), 0, 0, vk::DescriptorType::eUniformBuffer, {}, part),
                vk::WriteDescriptorSet(
                    *sets_.back(), 1, 0, vk::DescriptorType::eUniformTexelBuffer, {}, {}, *figures_view_)},
            {});
    }
}

void OverlayPass::prepare(std::size_t view, const Content& content, const MeasuringObserver& observer, const GpuWorld& world)
{
    const glm::dmat3 to_motion = motion_from_world(observer.u, observer.ship_from_cockpit);
    const glm::dmat3 to_world = glm::transpose(to_motion);
    const glm::dmat3 from_cockpit = to_motion * glm::dmat3(glm::mat3_cast(observer.ship_from_cockpit));
    const OverlayScale& scale = content.scale;
    const double seconds_per_time_unit = world.scene.seconds_per_time_unit();
    shared::OverlayConstants c{};
    c.world0 = shared::row(to_world, 0), c.world1 = shared::row(to_world, 1), c.world2 = shared::row(to_world, 2);
    if (const auto angle = unshifted_angle(observer))
        c.ring = glm::vec4(std::cos(*angle), std::sin(*angle), 1, 0);
    const double low = std::log10(scale.nearest_s);
    c.scale = glm::vec4(low, 1 / (std::log10(scale.farthest_s) - low), std::log10(seconds_per_time_unit), 0);
    // Every fifth contour is heavier. Times are therefore counted modulo five steps: single precision is enough however
    // late it is.
    const double now_s = observer.time * seconds_per_time_unit, step = scale.emission_step_s;
    c.steps = glm::vec4(step, std::fmod(now_s, 5 * step), seconds_per_time_unit, 0);
    if (observer.comparison == Comparison::no_light_delay) // at the ship's present the world's time is later ahead
        c.ring.w = 1, c.steps.w = float(glm::length(observer.u));
    c.aim[0] = glm::vec4(-from_cockpit[2], 1);
    c.right = glm::vec4(from_cockpit[0], 0), c.up = glm::vec4(from_cockpit[1], 0);
    for (int i = 0; i < 2; ++i)
        if (const auto& mark = content.marks[std::size_t(i)])
            c.marks[i] = glm::vec4(to_motion * ray_to(observer, *mark, world.world).ship, 1);
    copy_to(constants_, std::as_bytes(std::span(&c, 1)), view * stride);
}

void OverlayPass::draw(vk::CommandBuffer commands, std::size_t view, const WarpVariant& variant, const Content& content,
    vk::DescriptorSet warp_set, const shared::ViewPush& constants, glm::ivec2 corner, glm::ivec2 size, vk::Format target)
{
    constexpr int kinds[] = {OVERLAY_NONE, OVERLAY_NONE, OVERLAY_GRID, OVERLAY_RING, OVERLAY_DISTANCE, OVERLAY_EMISSION,
        OVERLAY_PROTRACTOR, OVERLAY_NONE, OVERLAY_NONE};
    static_assert(std::size(kinds) == overlay_names.size());
    // Everything that finds the surface of a pixel is the warp's. Only the light is left out, so that the switches of the
    // light need no pipelines of their own.
    WarpVariant own = variant;
    own.doppler = own.headlight = own.stars = own.by_table = false;
    own.coefficients = {};
    set_area(commands, corner, size);
    commands.bindDescriptorSets(
        vk::PipelineBindPoint::eGraphics, *pipelines_.layouts.overlay_layout, 0, {warp_set, *sets_[view]}, {});
    commands.pushConstants<shared::ViewPush>(
        *pipelines_.layouts.overlay_layout, vk::ShaderStageFlagBits::eFragment, 0, constants);
    const auto lay = [&](int kind) {
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.overlay(own, kind, target));
        commands.draw(3, 1, 0, 0);
    };
    if (content.figures && has_figures_)
        lay(OVERLAY_FIGURES);
    if (content.overlay != Overlay::off)
        lay(kinds[std::size_t(content.overlay)]);
}

} // namespace starbow
