#include "frame.h"
#include "config/model/angles.h"
#include "label.h"
#include "runtime/plan/cull.h"
#include "runtime/world/worldline.h"
#include "shaders/physics/physics.h"
#include <algorithm>
#include <cmath>
#include <cstring>

namespace starbow {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;
using Layout_ = vk::ImageLayout;

/// Root of the determinant of a flat pane's matrix: its pixels' solid angle is det M / length^3.
double unit_of(const CompiledPane& pane) { return pane.matrix ? std::sqrt(std::abs(glm::determinant(*pane.matrix))) : 0; }

} // namespace

/// What an eye's cube map is asked for, and from where.
void Frame::ask(std::size_t i)
{
    Eye& eye = eyes_[i];
    const std::vector<Layer>& layers = watchers_[eye.watcher].layers;
    eye.asked.resize(layers.size());
    eye.vantages.clear();
    eye.nearest.clear();
    for (std::size_t at = 0; at < layers.size(); ++at) {
        const Layer& layer = layers[at];
        const Vantage vantage = vantage_of(layer, int(at), scene_units(eye.now_m));
        eye.nearest.push_back(reprojects() ? std::max(nearest_box(world_.world, vantage), 1e-30) : 1);
        PlanLayer& ask = eye.asked[at];
        ask.views.clear();
        ask.E = layer.E;
        ask.galilean = shot_.effects.comparison == Comparison::galilean;
        for (const PaneState& pane : panes_)
            if (pane.eye == i)
                ask.views.push_back({pane.compiled.blocks.get(), layer.motion_from_cockpit,
                    reprojects() ? std::min(MOST_PARALLAX, glm::length(eye_offset(pane, layer)) / eye.nearest[at]) : 0});
        if (lab_)
            ask_for_probes(i, layer.motion_from_cockpit, ask.views);
        if (at > 0)
            ask.things = balls(world_.world, vantage);
        eye.vantages.push_back(vantage);
    }
}

/// Whether what an eye's cube map holds may be shown once more: from where it was drawn, and as fast as may be now, but
/// along the same axes.
bool Frame::still_serves(std::size_t i) const
{
    const Eye& eye = eyes_[i];
    for (std::size_t at = 0; at < eye.drawn.size(); ++at) {
        const Vantage &drawn = eye.drawn[at], &now = eye.vantages[at];
        const glm::dmat3 turned = drawn.motion_from_frame - now.motion_from_frame;
        double most = 0;
        for (int axis = 0; axis < 3; ++axis)
            most = std::max(most, glm::length(turned[axis]));
        if (most > 1e-9 || drawn.now != now.now || drawn.contraction != now.contraction)
            return false;
    }
    return serves(plans_[i], eye.wanted);
}

/// pre_exposure: for cube maps that are drawn now.
void Frame::prepare_eyes(double pre_exposure)
{
    bool keep = cubes_drawn_ && cubes_shown_ < quality_.frames_per_cube;
    for (std::size_t i = 0; i < eyes_.size(); ++i) {
        ask(i);
        eyes_[i].wanted = make_plan(eyes_[i].asked, quality_, plan_room_, std::move(eyes_[i].wanted));
        keep = keep && still_serves(i);
    }
    cubes_shown_ = keep ? cubes_shown_ + 1 : 1;
    if (!keep) {
        cubes_drawn_ = false;
        pre_exposure_ = pre_exposure;
    }
    for (std::size_t i = 0; i < eyes_.size(); ++i) {
        Eye& eye = eyes_[i];
        if (!keep) {
            std::swap(plans_[i], eye.wanted);
            eye.cube.prepare(plans_[i], eye.vantages, pre_exposure_);
            std::swap(eye.drawn, eye.vantages);
        }
        if (!stars_.on())
            continue;
        const auto& images = plans_[i].images;
        const auto own = std::find_if(images.begin(), images.end(), [](const PlanImage& image) { return image.layer > 0; });
        eye.stars = stars_in({images.begin(), own}, world_.star_patches, watchers_[eye.watcher].layers[0].motion_from_frame,
            std::move(eye.stars));
    }
}

void Frame::prepare(const Shot& shot, const Panel* hud)
{
    shot_ = shot;
    double most_E = 1;
    for (Watcher& one : watchers_) {
        one = watcher(world_.world, shot, one.observer, std::move(one.layers));
        most_E = std::max(most_E, one.most_E());
    }
    const bool gains = shot.effects.headlight || shot.effects.doppler;
    // Red-shifted, sunlight also leaves the visible: by Wien's law its part at 360 nm falls as exp(-6.92 (1/D - 1)).
    const double leaves = shot.effects.doppler ? std::exp(6.92 * (most_E - 1)) : 1;
    double light = pre_exposure(world_.brightest, shot.exposure_ev, (gains ? most_E * most_E * most_E : 1) * leaves);
    // A glow's number may stand for light of any strength: only that it fits counts.
    if (world_.spectra.most > 0)
        light = std::min(light, pre_exposure(world_.spectra.most, -1000, 1));
    if (pattern_ == Pattern::none)
        prepare_eyes(light);
    if (stars_.on()) {
        glm::ivec2 size(1);
        for (const OutputState& output : outputs_)
            size = glm::max(size, output.size);
        stars_.fit({std::uint32_t(size.x), std::uint32_t(size.y)});
        star_turns_.clear();
        for (const Watcher& one : watchers_)
            star_turns_.push_back(one.layers[0].motion_from_frame);
        stars_.prepare(star_turns_, shot.effects.false_colours);
    }
    for (PaneState& pane : panes_)
        if (bloom_ == 0)
            pane.bloom.reset();
        else if (!pane.bloom && pattern_ == Pattern::none)
            pane.bloom = std::make_unique<BloomPass>(device_, pipelines_, pane.pane().size);
    if (meters_ && !meter_) {
        std::vector<glm::ivec2> sizes;
        for (const PaneState& pane : panes_)
            sizes.push_back(layout_.outputs[pane.output].preview ? glm::ivec2(0) : pane.pane().size);
        meter_ = std::make_unique<Meter>(device_, sizes, world_.star_count);
    }
    hud_on_ = hud;
    if (hud) {
        if (!hud_)
            hud_ = std::make_unique<PanelPass>(device_, pipelines_, panes_.size());
        hud_->prepare(*hud, hud_place_);
        for (std::size_t i = 0; i < panes_.size(); ++i)
            hud_->prepare_pane(i, map_of(panes_[i]), *nearest_);
    }
    if (pattern_ != Pattern::none)
        for (PaneState& pane : panes_)
            if (!*pane.label.view) {
                pane.label = make_label(device_, layout_, pane.pane(), sent_pixels(pane));
                pane.shown_part = shown_part(pane.compiled);
            }
    write_sets();
    if (lab_ && pattern_ == Pattern::none)
        prepare_lab();
}

/// The pixels of the pane, and where it is a preview, of the one that it shows small.
glm::ivec2 Frame::sent_pixels(const PaneState& pane) const
{
    for (const PaneState& other : panes_)
        if (other.output == other.pane().output && other.output == pane.pane().output
            && other.pane().viewport == pane.pane().viewport && other.pane().eye == pane.pane().eye)
            return other.pane().size;
    return pane.pane().size;
}

glm::dvec3 Frame::scene_units(const glm::dvec3& place_m) const
{
    return place_m * (layout_.stereo.hyper_stereo / world_.scene.unit_m);
}

/// Of an eye from its cube map's place, in a layer's motion axes. Where the baseline turns, as far as it ever is.
glm::dvec3 Frame::eye_offset(const PaneState& pane, const Layer& layer) const
{
    const glm::dvec3 offset = layer.shot.ship_from_cockpit * scene_units(pane.beside_m);
    if (layout_.stereo.turning)
        return glm::dvec3(1, 1, physics::gamma_of(layer.shot.u)) * glm::length(offset);
    glm::dvec3 apart = layer.motion_from_frame * physics::eye_place(layer.shot.u, offset);
    apart.z *= layer.contraction;
    return apart;
}

/// ViewPush's and LayerEntry's member.
glm::vec4 Frame::eye_told(const PaneState& pane, const Layer& layer) const
{
    if (!layout_.stereo.turning)
        return glm::vec4(eye_offset(pane, layer), 0);
    const double side = pane.beside_m.x < 0 ? -1 : 1;
    return glm::vec4(layer.motion_from_cockpit * glm::dvec3(0, 1, 0), side * glm::length(scene_units(pane.beside_m)));
}

/// Where something moves: the layers of which there is anything to see, and the sky.
void Frame::put_layers(PaneState& pane)
{
    if (!*pane.layers.buffer)
        pane.layers = make_mapped_buffer(device_, sizeof(shared::LayerConstants), vk::BufferUsageFlagBits::eUniformBuffer);
    const Eye& eye = eyes_[pane.eye];
    const Plan& plan = plans_[pane.eye];
    const std::vector<Layer>& layers = watcher_of(pane).layers;
    shared::LayerConstants all{};
    std::size_t count = 0;
    for (std::size_t at = 0; at < layers.size(); ++at) {
        const bool seen = std::any_of(
            plan.images.begin(), plan.images.end(), [&](const PlanImage& image) { return std::size_t(image.layer) == at; });
        if (at > 0 && !seen)
            continue;
        const Layer& layer = layers[at];
        const glm::dmat3 turn = layer.motion_from_cockpit * glm::transpose(layers[0].motion_from_cockpit);
        shared::LayerEntry& entry = all.layers[count++];
        entry.row0 = shared::row(turn, 0);
        entry.row1 = shared::row(turn, 1, plan.rear_last[at]);
        entry.row2 = shared::row(turn, 2);
        entry.boost = glm::vec4(layer.E, 1 / layer.E, at * SLOT_COUNT, at);
        entry.eye = eye_told(pane, layer);
        entry.nearest.y = float(eye.nearest[at]);
    }
    all.count.x = float(count);
    all.world_up = glm::vec4(layers[0].motion_from_frame * glm::dvec3(0, 1, 0), 0);
    for (std::size_t group = 0; group < MAX_GROUPS; ++group) {
        all.sky_zenith[group] = glm::vec4(world_.spectra.sky[0][group] * pre_exposure_);
        all.sky_horizon[group] = glm::vec4(world_.spectra.sky[1][group] * pre_exposure_);
        all.sky_nadir[group] = glm::vec4(world_.spectra.sky[2][group] * pre_exposure_);
    }
    std::memcpy(pane.layers.mapped, &all, sizeof all);
}

void Frame::write_sets()
{
    // Each write points at its part of these, which must not move.
    auto& buffers = told_buffers_;
    auto& images = told_images_;
    auto& texels = told_texels_;
    auto& writes = writes_;
    buffers.clear(), images.clear(), texels.clear(), writes.clear();
    buffers.reserve(6 * panes_.size());
    images.reserve(11 * panes_.size());
    texels.reserve(2 * panes_.size());
    auto buffer = [&](const vk::raii::DescriptorSet& set, std::uint32_t binding, vk::DescriptorType type, const Buffer& b) {
        buffers.push_back({*b.buffer, 0, VK_WHOLE_SIZE});
        writes.push_back({*set, binding, 0, 1, type, nullptr, &buffers.back()});
    };
    auto image
        = [&](const vk::raii::DescriptorSet& set, std::uint32_t binding, const Image& i, const vk::raii::Sampler& sampler) {
              images.push_back({*sampler, *i.view, vk::ImageLayout::eShaderReadOnlyOptimal});
              writes.push_back({*set, binding, 0, 1, vk::DescriptorType::eCombinedImageSampler, &images.back()});
          };
    for (PaneState& pane : panes_) {
        const Image& map = map_of(pane);
        image(pane.label_set, 0, map, nearest_);
        image(pane.label_set, 1, *pane.label.view ? pane.label : nothing_, linear_);
        if (pattern_ != Pattern::none)
            continue;
        const Eye& eye = eyes_[pane.eye];
        image(pane.warp_set, 0, map, nearest_);
        constexpr std::uint32_t atlas_bindings[MAX_GROUPS] = {1, 7, 8, 9};
        const std::vector<Image>& atlases = eye.cube.atlases();
        for (std::size_t group = 0; group < MAX_GROUPS; ++group)
            image(pane.warp_set, atlas_bindings[group], atlases[std::min(group, std::size_t(world_.spectra.groups) - 1)],
                plans_[pane.eye].levels > 1 ? linear_ : finest_);
        const ResponseBuffers& response = this->response();
        for (auto [binding, view] : {std::pair(2u, eye.cube.slots()), std::pair(3u, *response.texels)}) {
            texels.push_back(view);
            writes.push_back(
                {*pane.warp_set, binding, 0, 1, vk::DescriptorType::eUniformTexelBuffer, nullptr, nullptr, &texels.back()});
        }
        buffer(pane.warp_set, 10, vk::DescriptorType::eUniformBuffer, response.own_rows);
        const bool layered = eye.cube.layered();
        if (layered)
            put_layers(pane);
        image(pane.warp_set, 11, layered ? atlases.back() : nothing_, plans_[pane.eye].levels > 1 ? linear_ : finest_);
        buffer(pane.warp_set, 12, vk::DescriptorType::eUniformBuffer, layered ? pane.layers : no_layers_);
        image(pane.warp_set, 4, keeps_depth_ ? eye.cube.depth() : nothing_, nearest_);
        image(pane.warp_set, 5, stars_.on() ? stars_.picture() : nothing_, nearest_);
        image(pane.warp_set, 6, pane.map && stars_.on() ? maps_[*pane.map].inverse : no_map_, nearest_);
    }
    device_.device.updateDescriptorSets(writes, {});
}

void Frame::record(vk::CommandBuffer commands, std::span<const Target> targets)
{
    if (pattern_ == Pattern::none) {
        draw_cubes(commands);
        draw_meter(commands);
        draw_probes(commands);
    }
    for (std::size_t output = 0; output < targets.size(); ++output) {
        if (!targets[output].view)
            continue; // minimised, or its monitor is away
        warp_output(commands, output, targets[output]);
        draw_lab(commands, output, targets[output]);
        draw_hud(commands, output, targets[output]);
        finish_output(commands, output, targets[output]);
    }
}

void Frame::draw_cubes(vk::CommandBuffer commands)
{
    if (cubes_drawn_)
        return;
    for (Eye& eye : eyes_)
        eye.cube.record(commands);
    cubes_drawn_ = quality_.frames_per_cube > 1;
}

/// Of the passes that show light, each pixel along all its rays.
WarpVariant Frame::variant_shown(const PaneState& pane) const
{
    WarpVariant all = variant(pane);
    all.rays = quality_.pixel_rays;
    return all;
}

/// The image ahead, if the plan has no other: at rest it often shows all. Null otherwise.
const PlanImage* Frame::single_image(const PaneState& pane) const
{
    const std::vector<PlanImage>& images = plans_[pane.eye].images;
    const bool beside = reprojects() && pane.beside_m != glm::dvec3(0);
    return images.size() == 1 && images[0].layer == 0 && images[0].slot == SLOT_FRONT && !beside ? &images[0] : nullptr;
}

WarpVariant Frame::variant(const PaneState& pane) const
{
    const bool moves = watcher_of(pane).E != 1 || eyes_[pane.eye].cube.layered(); // otherwise there is nothing to shift
    const bool beside = reprojects() && pane.beside_m != glm::dvec3(0);
    const Effects& on = shot_.effects;
    WarpVariant variant{pane.compiled.map != nullptr, on.aberration && moves, on.doppler && moves, on.headlight && moves,
        plans_[pane.eye].levels > 1, pane.compiled.channels() == 3, beside, beside && layout_.stereo.turning, stars_.on()};
    variant.numbers = world_.numbers();
    variant.layered = eyes_[pane.eye].cube.layered();
    variant.single = single_image(pane);
    variant.cut = plans_[pane.eye].cut;
    variant.galilean = on.comparison == Comparison::galilean;
    variant.by_table = variant.doppler || on.false_colours || variant.numbers != Numbers{}; // else as at rest, which is told
    return variant;
}

shared::ViewPush Frame::push(const PaneState& pane, const glm::dmat3& axes_from_cockpit) const
{
    const glm::dmat3 m = axes_from_cockpit * pane.compiled.matrix.value_or(glm::dmat3(1));
    const vk::Extent2D atlas = eyes_[pane.eye].cube.atlases()[0].extent;
    shared::ViewPush push{};
    push.row0 = shared::row(m, 0, unit_of(pane.compiled));
    push.row1 = shared::row(m, 1, pattern_ == Pattern::none ? plans_[pane.eye].rear_last[0] : 0);
    push.row2 = shared::row(m, 2, response().first_log2_D);
    push.origin = glm::vec4(pane.pane().corner, 1.0 / atlas.width, 1.0 / atlas.height);
    push.pane = glm::vec4(pane.pane().corner, 0, response().per_octave);
    if (pattern_ == Pattern::none) {
        const PlanImage* single = single_image(pane);
        push.eye = single ? slot_entry(*single).texel_from_face : eye_told(pane, watcher_of(pane).layers[0]);
        push.zenith.y = float(eyes_[pane.eye].nearest[0]);
    }
    push.zenith.x = float(std::sin(layout_.stereo.full_from_zenith_deg * degree));
    push.zenith.z = float(pane.pane().size.x), push.zenith.w = float(pane.pane().size.y);
    return push;
}

/// What comes before light is shown: ViewPush's member.
glm::vec4 Frame::boost(const PaneState& pane, double exposure) const
{
    // Not infinite, so that darkness times it stays dark.
    const double E = watcher_of(pane).E;
    return glm::vec4(E, 1 / E, std::min(exposure / pre_exposure_, 1e37), near_distance);
}

/// ViewPush of the stars' pass.
shared::ViewPush Frame::star_push(const PaneState& pane) const
{
    const Watcher& own = watcher_of(pane);
    shared::ViewPush constants = push(pane, own.layers[0].motion_from_cockpit);
    constants.boost = glm::vec4(own.E, 1 / own.E, pre_exposure_, near_distance);
    const glm::dmat3 back = glm::inverse(own.layers[0].motion_from_cockpit * pane.compiled.matrix.value_or(glm::dmat3(1)));
    constants.row0 = shared::row(back, 0, constants.row0.w);
    constants.row1 = shared::row(back, 1, constants.row1.w);
    constants.row2 = shared::row(back, 2);
    return constants;
}

void Frame::draw_stars(vk::CommandBuffer commands, std::size_t output, int layer)
{
    const glm::ivec2 size = outputs_[output].size;
    stars_.begin(commands, {std::uint32_t(size.x), std::uint32_t(size.y)});
    for (const PaneState& pane : panes_) {
        if (pane.output != output || pane.pane().layer != layer)
            continue;
        const shared::ViewPush constants = star_push(pane);
        WarpVariant own = variant(pane);
        own.mips = false;
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.stars(own, stars_.format()));
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.star_layout, 0, *pane.warp_set, {});
        commands.pushConstants<shared::ViewPush>(
            *pipelines_.star_layout, vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0, constants);
        const int places = pane.map && maps_[*pane.map].closes ? 2 : 1;
        stars_.draw(commands, eyes_[pane.eye].watcher, pane.pane().corner, pane.pane().size, places * (own.channels ? 3 : 1),
            eyes_[pane.eye].stars);
    }
    stars_.end(commands);
}

void Frame::warp_pane(vk::CommandBuffer commands, const PaneState& pane, vk::Pipeline pipeline, double exposure)
{
    shared::ViewPush constants = push(pane, watcher_of(pane).layers[0].motion_from_cockpit);
    constants.boost = boost(pane, exposure);
    set_warp(commands, pane, pipeline, constants, pane.pane().corner, pane.pane().size);
}

void Frame::set_warp(vk::CommandBuffer commands, const PaneState& pane, vk::Pipeline pipeline,
    const shared::ViewPush& constants, glm::ivec2 corner, glm::ivec2 size)
{
    set_area(commands, corner, size);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.warp_layout, 0, *pane.warp_set, {});
    commands.pushConstants<shared::ViewPush>(*pipelines_.warp_layout, vk::ShaderStageFlagBits::eFragment, 0, constants);
    commands.draw(3, 1, 0, 0);
}

/// The light of a pane that glows, spread.
void Frame::bloom_pane(vk::CommandBuffer commands, const PaneState& pane)
{
    const Target light = pane.bloom->light();
    pane.bloom->begin(commands);
    vk::RenderingAttachmentInfo colour(light.view, Layout_::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eStore);
    commands.beginRendering({{}, {{0, 0}, light.extent}, 1, 0, colour});
    shared::ViewPush constants = push(pane, watcher_of(pane).layers[0].motion_from_cockpit);
    constants.boost = boost(pane, std::exp2(shot_.exposure_ev));
    constants.origin.x = constants.origin.y = 0;
    WarpVariant linear = variant_shown(pane);
    linear.linear = true;
    set_warp(commands, pane, pipelines_.warp(linear, light.format), constants, {0, 0}, pane.pane().size);
    commands.endRendering();
    pane.bloom->spread(commands);
}

void Frame::draw_meter(vk::CommandBuffer commands)
{
    if (!meters_)
        return;
    const vk::RenderingAttachmentInfo picture = meter_->begin(commands);
    commands.beginRendering({{}, {{0, 0}, meter_->extent()}, 1, 0, picture});
    for (std::size_t i = 0; i < panes_.size(); ++i) {
        const PaneState& pane = panes_[i];
        if (layout_.outputs[pane.output].preview)
            continue;
        const Meter::Cell& cell = meter_->cell(i);
        shared::ViewPush constants = push(pane, watcher_of(pane).layers[0].motion_from_cockpit);
        constants.boost = boost(pane, 1);
        constants.origin.x = float(cell.corner.x), constants.origin.y = float(cell.corner.y);
        const glm::dvec2 step = glm::dvec2(pane.pane().size) / glm::dvec2(cell.size);
        constants.zenith.z = float(step.x), constants.zenith.w = float(step.y);
        set_warp(commands, pane, pipelines_.meter(variant(pane)), constants, cell.corner, cell.size);
        if (stars_.on())
            glance_at_stars(commands, pane, meter_->star_cell(i));
    }
    commands.endRendering();
    meter_->end(commands);
}

void Frame::glance_at_stars(vk::CommandBuffer commands, const PaneState& pane, const Meter::Cell& cell)
{
    shared::ViewPush constants = star_push(pane);
    constants.boost.z = 1;
    constants.pane = glm::vec4(cell.size, meter_->every(), 0);
    WarpVariant own = variant(pane);
    own.mips = false;
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.star_meter(own));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.star_layout, 0, *pane.warp_set, {});
    commands.pushConstants<shared::ViewPush>(
        *pipelines_.star_layout, vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0, constants);
    stars_.glance(commands, eyes_[pane.eye].watcher, cell.corner, cell.size, meter_->every(), own.channels);
}

std::optional<double> Frame::metered() const
{
    return meters_ && meter_ ? metered_ev(meter_->view(), meter_->stars()) : std::nullopt;
}

void Frame::pattern_pane(vk::CommandBuffer commands, const PaneState& pane, vk::Format format)
{
    const Pane& own = pane.pane();
    const shared::ViewPush look = push(pane, glm::dmat3(1));
    shared::PatternPush constants{};
    constants.row0 = look.row0, constants.row1 = look.row1, constants.row2 = look.row2;
    constants.origin = glm::vec4(own.corner, own.size);
    constants.tint = glm::vec4(pattern_ == Pattern::names ? eye_tint(own.eye) : output_tint(own.output), 0);
    // A table most likely is near a gamma of 2.2. A preview's target is sRGB whatever it shows.
    const Colour& colour = layout_.outputs[pane.output].colour;
    const double gamma = colour.lut.empty() ? colour.gamma : 2.2;
    constants.label = glm::vec4(pane.label.extent.width, pane.label.extent.height, pane.shown_part, gamma);
    set_area(commands, own.corner, own.size);
    commands.bindPipeline(
        vk::PipelineBindPoint::eGraphics, pipelines_.pattern(pane.compiled.map != nullptr, int(pattern_), format));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.picture_layout, 0, *pane.label_set, {});
    commands.pushConstants<shared::PatternPush>(
        *pipelines_.picture_layout, vk::ShaderStageFlagBits::eFragment, 0, constants);
    commands.draw(3, 1, 0, 0);
}

Target Frame::picture_of(std::size_t output, int layer, const Target& last) const
{
    const FinishPass* finish = outputs_[output].finish.get();
    return finish ? finish->picture(std::size_t(layer)) : last;
}

void Frame::warp_output(vk::CommandBuffer commands, std::size_t output, const Target& last)
{
    if (outputs_[output].finish)
        outputs_[output].finish->begin(commands);
    for (int layer = 0; layer < layers(layout_.outputs[output].packing); ++layer) {
        if (stars_.on() && pattern_ == Pattern::none)
            draw_stars(commands, output, layer);
        const Target target = picture_of(output, layer, last);
        const bool glows = bloom_ > 0 && pattern_ == Pattern::none;
        for (const PaneState& pane : panes_)
            if (glows && pane.output == output && pane.pane().layer == layer)
                bloom_pane(commands, pane);
        vk::RenderingAttachmentInfo colour(target.view, Layout_::eColorAttachmentOptimal, {}, {}, {},
            vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
            vk::ClearColorValue(std::array<float, 4>{0, 0, 0, 1}));
        commands.beginRendering({{}, {{0, 0}, target.extent}, 1, 0, colour});
        for (const PaneState& pane : panes_) {
            if (pane.output != output || pane.pane().layer != layer)
                continue;
            if (pattern_ != Pattern::none)
                pattern_pane(commands, pane, target.format);
            else if (glows)
                pane.bloom->show(commands, pane.pane().corner, bloom_, target.format);
            else
                warp_pane(commands, pane, pipelines_.warp(variant_shown(pane), target.format), std::exp2(shot_.exposure_ev));
        }
        commands.endRendering();
    }
}

void Frame::finish_output(vk::CommandBuffer commands, std::size_t output, const Target& target)
{
    if (outputs_[output].finish)
        // How a projector is set is judged without what lies on its picture; how pictures meet, with it.
        outputs_[output].finish->record(
            commands, target, pattern_ == Pattern::grid || pattern_ == Pattern::names || pattern_ == Pattern::wedges);
}

void Frame::record_measured(vk::CommandBuffer commands, std::size_t output, const MeasureTarget& target)
{
    draw_cubes(commands);
    if (stars_.on())
        draw_stars(commands, output, 0);
    float nothing = std::nanf("");
    std::vector<vk::RenderingAttachmentInfo> colours;
    for (const Image* image : {&target.light_and_depth, &target.camera, &target.world}) {
        transition(commands, *image, Layout_::eUndefined, Stage::eNone, {}, Layout_::eColorAttachmentOptimal,
            Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite);
        colours.push_back({*image->view, Layout_::eColorAttachmentOptimal, {}, {}, {}, vk::AttachmentLoadOp::eClear,
            vk::AttachmentStoreOp::eStore, vk::ClearColorValue(std::array<float, 4>{nothing, nothing, nothing, nothing})});
    }
    commands.beginRendering({{}, {{0, 0}, target.camera.extent}, 1, 0, colours});
    for (const PaneState& pane : panes_)
        if (pane.output == output && pane.pane().layer == 0)
            warp_pane(commands, pane, pipelines_.measure(variant_shown(pane)), 1);
    commands.endRendering();
    for (const Image* image : {&target.light_and_depth, &target.camera, &target.world})
        transition(commands, *image, Layout_::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
            Access::eColorAttachmentWrite, Layout_::eTransferSrcOptimal, Stage::eTransfer, Access::eTransferRead);
}

std::vector<Frame::Axes> Frame::measured_axes(std::size_t output) const
{
    std::vector<Axes> axes;
    for (const PaneState& pane : panes_)
        if (pane.output == output && pane.pane().layer == 0)
            axes.push_back(
                {pane.pane().corner, pane.pane().size, glm::transpose(watcher_of(pane).layers[0].motion_from_frame)});
    return axes;
}

void Frame::lay_over(vk::CommandBuffer commands, std::size_t output, const Target& last,
    const std::function<void(std::size_t pane, vk::Format target)>& draw) const
{
    for (int layer = 0; layer < layers(layout_.outputs[output].packing); ++layer) {
        const Target target = picture_of(output, layer, last);
        vk::ImageMemoryBarrier2 after_warp(Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite,
            Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite | Access::eColorAttachmentRead,
            Layout_::eColorAttachmentOptimal, Layout_::eColorAttachmentOptimal, VK_QUEUE_FAMILY_IGNORED,
            VK_QUEUE_FAMILY_IGNORED, target.image, {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
        commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, after_warp));
        vk::RenderingAttachmentInfo colour(target.view, Layout_::eColorAttachmentOptimal, {}, {}, {},
            vk::AttachmentLoadOp::eLoad, vk::AttachmentStoreOp::eStore);
        commands.beginRendering({{}, {{0, 0}, target.extent}, 1, 0, colour});
        for (std::size_t i = 0; i < panes_.size(); ++i)
            if (panes_[i].output == output && panes_[i].pane().layer == layer)
                draw(i, target.format);
        commands.endRendering();
    }
}

void Frame::draw_hud(vk::CommandBuffer commands, std::size_t output, const Target& last)
{
    if (!hud_on_)
        return;
    hud_->upload(commands);
    lay_over(commands, output, last, [&](std::size_t i, vk::Format target) {
        const PaneState& pane = panes_[i];
        hud_->draw(commands, i, pane.compiled.map != nullptr, push(pane, hud_place_.panel_from_cockpit), pane.pane().corner,
            pane.pane().size, pane.hud_box, {}, target);
    });
}

void Frame::look_up(vk::CommandBuffer commands, const Target& target, vk::Pipeline pipeline, vk::DescriptorSet set)
{
    const PaneState& pane = panes_.front();
    shared::ViewPush constants = push(pane, watcher_of(pane).layers[0].motion_from_cockpit);
    vk::RenderingAttachmentInfo colour(target.view, Layout_::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore);
    commands.beginRendering({{}, {{0, 0}, target.extent}, 1, 0, colour});
    set_area(commands, pane.pane().corner, pane.pane().size);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.picture_layout, 0, set, {});
    commands.pushConstants<shared::ViewPush>(*pipelines_.picture_layout, vk::ShaderStageFlagBits::eFragment, 0, constants);
    commands.draw(3, 1, 0, 0);
    commands.endRendering();
}

PlanImage Frame::plain_image(const Shot& shot, glm::dmat3& straight_from_world) const
{
    const PaneState& pane = panes_.front();
    straight_from_world = motion_from_world({0, 0, 0}, shot.ship_from_cockpit);
    glm::dmat3 m = straight_from_world * glm::dmat3(glm::mat3_cast(shot.ship_from_cockpit)) * pane.compiled.matrix.value();
    glm::dvec3 low = m * glm::dvec3(0, 0, 1), high = m * glm::dvec3(pane.pane().size, 1);
    // The view's x may run against the face's a: the picture is then mirrored, at the same cost.
    glm::dvec2 one = glm::dvec2(low) / low.z, other = glm::dvec2(high) / high.z;
    PlanImage image{SLOT_FRONT, 0, glm::min(one, other), glm::max(one, other), pane.pane().size, {0, 0}, 0, 1};
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
    vk::DeviceSize bytes = stars_.picture().bytes + (hud_ ? hud_->memory() : 0);
    for (const Eye& eye : eyes_)
        bytes += eye.cube.memory();
    for (const Map& map : maps_)
        bytes += map.image.bytes + map.inverse.bytes;
    bytes += meter_ ? meter_->memory() : 0;
    bytes += lab_ && lab_->panel ? lab_->panel->memory() : 0;
    for (const PaneState& pane : panes_)
        bytes += pane.bloom ? pane.bloom->memory() : 0;
    for (const OutputState& output : outputs_)
        bytes += output.finish ? output.finish->memory() : 0;
    return bytes;
}

} // namespace starbow
