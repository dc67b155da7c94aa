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

constexpr double degree = 3.14159265358979323846 / 180;

glm::vec4 row(const glm::dmat3& m, int i, double w = 0) { return glm::vec4(m[0][i], m[1][i], m[2][i], w); }

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
    std::vector<vk::DescriptorPoolSize> sizes
        = {{vk::DescriptorType::eUniformBuffer, 2 * views}, {vk::DescriptorType::eCombinedImageSampler, 5 * views}};
    pool_ = device.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 2 * views, sizes});
    auto make_set = [&](const vk::raii::DescriptorSetLayout& set_layout) {
        return std::move(device.device.allocateDescriptorSets({*pool_, *set_layout}).front());
    };

    for (std::size_t output = 0; output < layout.outputs.size(); ++output) {
        sizes_.push_back({0, 0});
        for (const Viewport& viewport : layout.outputs[output].viewports) {
            auto same = std::find_if(eyes_.begin(), eyes_.end(), [&](const Eye& e) { return e.offset_m == viewport.eye_m; });
            if (same == eyes_.end()) {
                eyes_.push_back({viewport.eye_m, CubePass(device, pipelines, world, quality.samples, keeps_depth)});
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

void Frame::prepare(const Shot& shot, const Panel* hud)
{
    shot_ = shot;
    E_ = physics::exp_rapidity(glm::length(shot.u));
    glm::dmat3 to_motion = motion_from_world(shot.u, shot.ship_from_cockpit);
    glm::dmat3 motion_from_cockpit = to_motion * glm::dmat3(glm::mat3_cast(shot.ship_from_cockpit));
    for (std::size_t i = 0; i < eyes_.size(); ++i) {
        std::vector<View> asked;
        for (ViewState& view : views_)
            if (view.eye == i) {
                view.motion_from_cockpit = motion_from_cockpit;
                asked.push_back({view.projection, view.size, motion_from_cockpit});
            }
        plans_[i] = make_plan(asked, shot.effects.aberration ? E_ : 1, quality_);

        glm::dvec3 offset = shot.ship_from_cockpit * eyes_[i].offset_m * (layout_.stereo.hyper_stereo / world_.scene.unit_m);
        glm::dvec3 place = shot.position + physics::eye_place(shot.u, offset);
        eyes_[i].cube.prepare(plans_[i], place, to_motion);
    }
    if (hud && (panel_.extent.width != std::uint32_t(hud->size.x) || panel_.extent.height != std::uint32_t(hud->size.y))) {
        panel_ = make_image(device_,
            {vk::Format::eR8G8Unorm, {std::uint32_t(hud->size.x), std::uint32_t(hud->size.y)},
                vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst});
        grow(device_, panel_pixels_, hud->texels.size(), vk::BufferUsageFlagBits::eTransferSrc);
    }
    hud_on_ = hud;
    if ((panel_new_ = hud))
        std::memcpy(panel_pixels_.mapped, hud->texels.data(), hud->texels.size());
    write_sets();
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
    for (const ViewState& view : views_) {
        const Eye& eye = eyes_[view.eye];
        const Image& map = view.planar() ? nothing_ : view.map;
        image(view.warp_set, 0, map, nearest_);
        image(view.warp_set, 1, eye.cube.atlas(), plans_[view.eye].levels > 1 ? linear_ : finest_);
        buffer(view.warp_set, 2, vk::DescriptorType::eUniformBuffer, eye.cube.slots());
        buffer(view.warp_set, 3, vk::DescriptorType::eUniformBuffer, colours_);
        image(view.warp_set, 4, keeps_depth_ ? eye.cube.depth() : nothing_, nearest_);
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
    for (Eye& eye : eyes_)
        eye.cube.record(commands);
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
    push.origin
        = glm::vec4(view.corner, eyes_[view.eye].cube.atlas().extent.width, eyes_[view.eye].cube.atlas().extent.height);
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

PlanImage Frame::plain_image(const Shot& shot, glm::dmat3& straight_from_world) const
{
    const ViewState& view = views_.front();
    straight_from_world = motion_from_world({0, 0, 0}, shot.ship_from_cockpit);
    glm::dmat3 m = straight_from_world * glm::dmat3(glm::mat3_cast(shot.ship_from_cockpit)) * view.cockpit_from_pixel;
    glm::dvec3 low = m * glm::dvec3(0, 0, 1), high = m * glm::dvec3(view.size, 1);
    // The view's x may run against the face's a: the picture is then mirrored, at the same cost.
    glm::dvec2 one = glm::dvec2(low) / low.z, other = glm::dvec2(high) / high.z;
    PlanImage image{SLOT_FRONT, 0, glm::min(one, other), glm::max(one, other), view.size, {0, 0}, 0, 1};
    image.texels_per_unit = image.size.y / (image.high.y - image.low.y);
    return image;
}

std::size_t Frame::triangles() const
{
    std::size_t sum = 0;
    for (const Eye& eye : eyes_)
        sum += eye.cube.triangles();
    return sum;
}

vk::DeviceSize Frame::memory() const
{
    vk::DeviceSize bytes = panel_.bytes;
    for (const Eye& eye : eyes_)
        bytes += eye.cube.memory();
    for (const ViewState& view : views_)
        bytes += view.map.bytes;
    return bytes;
}

} // namespace starbow
