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

/// Root of the determinant of a flat view's matrix: its pixels' solid angle is det M / length^3.
double unit_of(const CompiledView& view) { return view.matrix ? std::sqrt(std::abs(glm::determinant(*view.matrix))) : 0; }

} // namespace

/// What an eye's cube map is asked for, and from where.
void Frame::request_views(std::size_t i)
{
    Eye& eye = eyes_[i];
    const std::vector<RestFrameView>& layers = observers_[eye.observer].layers;
    eye.requests.resize(layers.size());
    eye.eye_events.clear();
    eye.nearest.clear();
    for (std::size_t at = 0; at < layers.size(); ++at) {
        const RestFrameView& layer = layers[at];
        const EyeEvent eye_event = eye_event_of(layer, int(at), scene_units(eye.now_m));
        eye.nearest.push_back(reprojects() ? std::max(nearest_box(world_.world, eye_event), 1e-30) : 1);
        RestFrameRequest& ask = eye.requests[at];
        ask.views.clear();
        ask.E = layer.E;
        ask.galilean = shot_.effects.comparison == Comparison::galilean;
        for (const ViewState& view : views_)
            if (view.eye == i)
                ask.views.push_back({view.compiled.cones.get(), layer.motion_from_cockpit,
                    reprojects() ? std::min(MOST_PARALLAX, glm::length(eye_offset(view, layer)) / eye.nearest[at]) : 0});
        if (lab_)
            request_probes(i, layer.motion_from_cockpit, ask.views);
        if (at > 0)
            ask.bounds = bounding_spheres(world_.world, eye_event);
        eye.eye_events.push_back(eye_event);
    }
}

/// Whether what an eye's cube map holds may be shown once more: from where it was drawn, and as fast as may be now, but
/// along the same axes.
bool Frame::can_reuse(std::size_t i) const
{
    const Eye& eye = eyes_[i];
    for (std::size_t at = 0; at < eye.drawn.size(); ++at) {
        const EyeEvent &drawn = eye.drawn[at], &now = eye.eye_events[at];
        const glm::dmat3 turned = drawn.motion_from_frame - now.motion_from_frame;
        double most = 0;
        for (int axis = 0; axis < 3; ++axis)
            most = std::max(most, glm::length(turned[axis]));
        if (most > 1e-9 || drawn.now != now.now || drawn.contraction != now.contraction)
            return false;
    }
    return starbow::can_reuse(plans_[i], eye.wanted);
}

/// pre_exposure: for cube maps that are drawn now.
void Frame::prepare_eyes(double pre_exposure)
{
    bool keep = cubes_drawn_ && cubes_shown_ < quality_.frames_per_cube;
    for (std::size_t i = 0; i < eyes_.size(); ++i) {
        request_views(i);
        eyes_[i].wanted = plan_cube_map(eyes_[i].requests, quality_, plan_scratch_, std::move(eyes_[i].wanted));
        keep = keep && can_reuse(i);
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
            eye.cube.prepare(plans_[i], eye.eye_events, pre_exposure_);
            std::swap(eye.drawn, eye.eye_events);
        }
        if (!stars_.on())
            continue;
        const auto& images = plans_[i].images;
        const auto own = std::find_if(images.begin(), images.end(), [](const PlannedImage& image) { return image.layer > 0; });
        eye.stars = stars_in({images.begin(), own}, world_.star_patches, observers_[eye.observer].layers[0].motion_from_frame,
            std::move(eye.stars));
    }
}

void Frame::prepare(const Shot& shot, const Panel* hud)
{
    shot_ = shot;
    double most_E = 1;
    for (Observer& one : observers_) {
        one = starbow::observer_of(world_.world, shot, one.observer, std::move(one.layers));
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
        for (const Observer& one : observers_)
            star_turns_.push_back(one.layers[0].motion_from_frame);
        stars_.prepare(star_turns_, shot.effects.false_colours);
    }
    for (ViewState& view : views_)
        if (bloom_ == 0)
            view.bloom.reset();
        else if (!view.bloom && pattern_ == Pattern::none)
            view.bloom = std::make_unique<BloomPass>(device_, pipelines_, view.view().size);
    if (meters_ && !meter_) {
        std::vector<glm::ivec2> sizes;
        for (const ViewState& view : views_)
            sizes.push_back(layout_.outputs[view.output].preview ? glm::ivec2(0) : view.view().size);
        meter_ = std::make_unique<Meter>(device_, sizes, world_.star_count);
    }
    hud_on_ = hud;
    if (hud) {
        if (!hud_)
            hud_ = std::make_unique<PanelPass>(device_, pipelines_, views_.size());
        hud_->prepare(*hud, hud_place_);
        for (std::size_t i = 0; i < views_.size(); ++i)
            hud_->prepare_view(i, map_of(views_[i]), *nearest_);
    }
    if (pattern_ != Pattern::none)
        for (ViewState& view : views_)
            if (!*view.label.view) {
                view.label = make_label(device_, layout_, view.view(), sent_pixels(view));
                view.shown_part = shown_part(view.compiled);
            }
    write_sets();
    if (lab_ && pattern_ == Pattern::none)
        prepare_lab();
}

/// The pixels of the view, and where it is a preview, of the one that it shows small.
glm::ivec2 Frame::sent_pixels(const ViewState& view) const
{
    for (const ViewState& other : views_)
        if (other.output == other.view().output && other.output == view.view().output
            && other.view().viewport == view.view().viewport && other.view().eye == view.view().eye)
            return other.view().size;
    return view.view().size;
}

glm::dvec3 Frame::scene_units(const glm::dvec3& place_m) const
{
    return place_m * (layout_.stereo.hyper_stereo / world_.scene.unit_m);
}

/// Of an eye from its cube map's place, in a layer's motion axes. Where the baseline turns, as far as it ever is.
glm::dvec3 Frame::eye_offset(const ViewState& view, const RestFrameView& layer) const
{
    const glm::dvec3 offset = layer.shot.ship_from_cockpit * scene_units(view.beside_m);
    if (layout_.stereo.turning)
        return glm::dvec3(1, 1, physics::gamma_of(layer.shot.u)) * glm::length(offset);
    glm::dvec3 apart = layer.motion_from_frame * physics::eye_place(layer.shot.u, offset);
    apart.z *= layer.contraction;
    return apart;
}

/// ViewPush's and RestFrameEntry's member.
glm::vec4 Frame::eye_constants(const ViewState& view, const RestFrameView& layer) const
{
    if (!layout_.stereo.turning)
        return glm::vec4(eye_offset(view, layer), 0);
    const double side = view.beside_m.x < 0 ? -1 : 1;
    return glm::vec4(layer.motion_from_cockpit * glm::dvec3(0, 1, 0), side * glm::length(scene_units(view.beside_m)));
}

/// Where something moves: the layers of which there is anything to see, and the sky.
void Frame::write_rest_frames(ViewState& view)
{
    if (!*view.layers.buffer)
        view.layers = make_mapped_buffer(device_, sizeof(shared::RestFrameConstants), vk::BufferUsageFlagBits::eUniformBuffer);
    const Eye& eye = eyes_[view.eye];
    const CubeMapPlan& plan = plans_[view.eye];
    const std::vector<RestFrameView>& layers = observer_of(view).layers;
    shared::RestFrameConstants all{};
    std::size_t count = 0;
    for (std::size_t at = 0; at < layers.size(); ++at) {
        const bool seen = std::any_of(
            plan.images.begin(), plan.images.end(), [&](const PlannedImage& image) { return std::size_t(image.layer) == at; });
        if (at > 0 && !seen)
            continue;
        const RestFrameView& layer = layers[at];
        const glm::dmat3 turn = layer.motion_from_cockpit * glm::transpose(layers[0].motion_from_cockpit);
        shared::RestFrameEntry& entry = all.layers[count++];
        entry.row0 = shared::row(turn, 0);
        entry.row1 = shared::row(turn, 1, plan.finest_clip_level[at]);
        entry.row2 = shared::row(turn, 2);
        entry.boost = glm::vec4(layer.E, 1 / layer.E, at * TILE_COUNT, at);
        entry.eye = eye_constants(view, layer);
        entry.nearest.y = float(eye.nearest[at]);
    }
    all.count.x = float(count);
    all.world_up = glm::vec4(layers[0].motion_from_frame * glm::dvec3(0, 1, 0), 0);
    for (std::size_t group = 0; group < MAX_GROUPS; ++group) {
        all.sky_zenith[group] = glm::vec4(world_.spectra.sky[0][group] * pre_exposure_);
        all.sky_horizon[group] = glm::vec4(world_.spectra.sky[1][group] * pre_exposure_);
        all.sky_nadir[group] = glm::vec4(world_.spectra.sky[2][group] * pre_exposure_);
    }
    std::memcpy(view.layers.mapped, &all, sizeof all);
}

void Frame::write_sets()
{
    // Each write points at its part of these, which must not move.
    auto& buffers = buffer_infos_;
    auto& images = image_infos_;
    auto& texels = texel_views_;
    auto& writes = writes_;
    buffers.clear(), images.clear(), texels.clear(), writes.clear();
    buffers.reserve(6 * views_.size());
    images.reserve(11 * views_.size());
    texels.reserve(2 * views_.size());
    auto buffer = [&](const vk::raii::DescriptorSet& set, std::uint32_t binding, vk::DescriptorType type, const Buffer& b) {
        buffers.push_back({*b.buffer, 0, VK_WHOLE_SIZE});
        writes.push_back({*set, binding, 0, 1, type, nullptr, &buffers.back()});
    };
    auto image
        = [&](const vk::raii::DescriptorSet& set, std::uint32_t binding, const Image& i, const vk::raii::Sampler& sampler) {
              images.push_back({*sampler, *i.view, vk::ImageLayout::eShaderReadOnlyOptimal});
              writes.push_back({*set, binding, 0, 1, vk::DescriptorType::eCombinedImageSampler, &images.back()});
          };
    for (ViewState& view : views_) {
        const Image& map = map_of(view);
        image(view.label_set, 0, map, nearest_);
        image(view.label_set, 1, *view.label.view ? view.label : nothing_, linear_);
        if (pattern_ != Pattern::none)
            continue;
        const Eye& eye = eyes_[view.eye];
        image(view.warp_set, 0, map, nearest_);
        constexpr std::uint32_t atlas_bindings[MAX_GROUPS] = {1, 7, 8, 9};
        const std::vector<Image>& atlases = eye.cube.atlases();
        for (std::size_t group = 0; group < MAX_GROUPS; ++group)
            image(view.warp_set, atlas_bindings[group], atlases[std::min(group, std::size_t(world_.spectra.groups) - 1)],
                plans_[view.eye].levels > 1 ? linear_ : finest_);
        const ResponseBuffers& response = this->response();
        for (auto [binding, texel_view] : {std::pair(2u, eye.cube.tiles()), std::pair(3u, *response.texels)}) {
            texels.push_back(texel_view);
            writes.push_back(
                {*view.warp_set, binding, 0, 1, vk::DescriptorType::eUniformTexelBuffer, nullptr, nullptr, &texels.back()});
        }
        buffer(view.warp_set, 10, vk::DescriptorType::eUniformBuffer, response.own_rows);
        const bool layered = eye.cube.layered();
        if (layered)
            write_rest_frames(view);
        image(view.warp_set, 11, layered ? atlases.back() : nothing_, plans_[view.eye].levels > 1 ? linear_ : finest_);
        buffer(view.warp_set, 12, vk::DescriptorType::eUniformBuffer, layered ? view.layers : no_rest_frames_);
        image(view.warp_set, 4, keeps_depth_ ? eye.cube.depth() : nothing_, nearest_);
        image(view.warp_set, 5, stars_.on() ? stars_.picture() : nothing_, nearest_);
        image(view.warp_set, 6, view.map && stars_.on() ? maps_[*view.map].inverse : no_map_, nearest_);
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
WarpVariant Frame::variant_shown(const ViewState& view) const
{
    WarpVariant all = variant(view);
    all.rays = quality_.pixel_rays;
    return all;
}

/// The image ahead, if the plan has no other: at rest it often shows all. Null otherwise.
const PlannedImage* Frame::single_image(const ViewState& view) const
{
    const std::vector<PlannedImage>& images = plans_[view.eye].images;
    const bool beside = reprojects() && view.beside_m != glm::dvec3(0);
    return images.size() == 1 && images[0].layer == 0 && images[0].tile == TILE_FRONT && !beside ? &images[0] : nullptr;
}

WarpVariant Frame::variant(const ViewState& view) const
{
    const bool moves = observer_of(view).E != 1 || eyes_[view.eye].cube.layered(); // otherwise there is nothing to shift
    const bool beside = reprojects() && view.beside_m != glm::dvec3(0);
    const Effects& on = shot_.effects;
    WarpVariant variant{view.compiled.map != nullptr, on.aberration && moves, on.doppler && moves, on.headlight && moves,
        plans_[view.eye].levels > 1, view.compiled.channels() == 3, beside, beside && layout_.stereo.turning, stars_.on()};
    variant.numbers = world_.numbers();
    variant.layered = eyes_[view.eye].cube.layered();
    variant.single = single_image(view);
    variant.cut = plans_[view.eye].cut;
    variant.galilean = on.comparison == Comparison::galilean;
    variant.by_table = variant.doppler || on.false_colours || variant.numbers != CoefficientCounts{}; // else as at rest, which is told
    return variant;
}

shared::ViewPush Frame::push(const ViewState& view, const glm::dmat3& axes_from_cockpit) const
{
    const glm::dmat3 m = axes_from_cockpit * view.compiled.matrix.value_or(glm::dmat3(1));
    const vk::Extent2D atlas = eyes_[view.eye].cube.atlases()[0].extent;
    shared::ViewPush push{};
    push.row0 = shared::row(m, 0, unit_of(view.compiled));
    push.row1 = shared::row(m, 1, pattern_ == Pattern::none ? plans_[view.eye].finest_clip_level[0] : 0);
    push.row2 = shared::row(m, 2, response().first_log2_D);
    push.origin = glm::vec4(view.view().corner, 1.0 / atlas.width, 1.0 / atlas.height);
    push.corner = glm::vec4(view.view().corner, 0, response().per_octave);
    if (pattern_ == Pattern::none) {
        const PlannedImage* single = single_image(view);
        push.eye = single ? tile_entry(*single).texel_from_face : eye_constants(view, observer_of(view).layers[0]);
        push.zenith.y = float(eyes_[view.eye].nearest[0]);
    }
    push.zenith.x = float(std::sin(layout_.stereo.full_from_zenith_deg * degree));
    push.zenith.z = float(view.view().size.x), push.zenith.w = float(view.view().size.y);
    return push;
}

/// What comes before light is shown: ViewPush's member.
glm::vec4 Frame::boost(const ViewState& view, double exposure) const
{
    // Not infinite, so that darkness times it stays dark.
    const double E = observer_of(view).E;
    return glm::vec4(E, 1 / E, std::min(exposure / pre_exposure_, 1e37), near_distance);
}

/// ViewPush of the stars' pass.
shared::ViewPush Frame::star_push(const ViewState& view) const
{
    const Observer& own = observer_of(view);
    shared::ViewPush constants = push(view, own.layers[0].motion_from_cockpit);
    constants.boost = glm::vec4(own.E, 1 / own.E, pre_exposure_, near_distance);
    const glm::dmat3 back = glm::inverse(own.layers[0].motion_from_cockpit * view.compiled.matrix.value_or(glm::dmat3(1)));
    constants.row0 = shared::row(back, 0, constants.row0.w);
    constants.row1 = shared::row(back, 1, constants.row1.w);
    constants.row2 = shared::row(back, 2);
    return constants;
}

void Frame::draw_stars(vk::CommandBuffer commands, std::size_t output, int layer)
{
    const glm::ivec2 size = outputs_[output].size;
    stars_.begin(commands, {std::uint32_t(size.x), std::uint32_t(size.y)});
    for (const ViewState& view : views_) {
        if (view.output != output || view.view().layer != layer)
            continue;
        const shared::ViewPush constants = star_push(view);
        WarpVariant own = variant(view);
        own.mips = false;
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.stars(own, stars_.format()));
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.star_layout, 0, *view.warp_set, {});
        commands.pushConstants<shared::ViewPush>(
            *pipelines_.star_layout, vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0, constants);
        const int places = view.map && maps_[*view.map].closes ? 2 : 1;
        stars_.draw(commands, eyes_[view.eye].observer, view.view().corner, view.view().size, places * (own.channels ? 3 : 1),
            eyes_[view.eye].stars);
    }
    stars_.end(commands);
}

void Frame::warp_view(vk::CommandBuffer commands, const ViewState& view, vk::Pipeline pipeline, double exposure)
{
    shared::ViewPush constants = push(view, observer_of(view).layers[0].motion_from_cockpit);
    constants.boost = boost(view, exposure);
    set_warp(commands, view, pipeline, constants, view.view().corner, view.view().size);
}

void Frame::set_warp(vk::CommandBuffer commands, const ViewState& view, vk::Pipeline pipeline,
    const shared::ViewPush& constants, glm::ivec2 corner, glm::ivec2 size)
{
    set_area(commands, corner, size);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.warp_layout, 0, *view.warp_set, {});
    commands.pushConstants<shared::ViewPush>(*pipelines_.warp_layout, vk::ShaderStageFlagBits::eFragment, 0, constants);
    commands.draw(3, 1, 0, 0);
}

/// The light of a view that glows, spread.
void Frame::bloom_view(vk::CommandBuffer commands, const ViewState& view)
{
    const Target light = view.bloom->light();
    view.bloom->begin(commands);
    vk::RenderingAttachmentInfo colour(light.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eStore);
    commands.beginRendering({{}, {{0, 0}, light.extent}, 1, 0, colour});
    shared::ViewPush constants = push(view, observer_of(view).layers[0].motion_from_cockpit);
    constants.boost = boost(view, std::exp2(shot_.exposure_ev));
    constants.origin.x = constants.origin.y = 0;
    WarpVariant linear = variant_shown(view);
    linear.linear = true;
    set_warp(commands, view, pipelines_.warp(linear, light.format), constants, {0, 0}, view.view().size);
    commands.endRendering();
    view.bloom->spread(commands);
}

void Frame::draw_meter(vk::CommandBuffer commands)
{
    if (!meters_)
        return;
    const vk::RenderingAttachmentInfo picture = meter_->begin(commands);
    commands.beginRendering({{}, {{0, 0}, meter_->extent()}, 1, 0, picture});
    for (std::size_t i = 0; i < views_.size(); ++i) {
        const ViewState& view = views_[i];
        if (layout_.outputs[view.output].preview)
            continue;
        const Meter::Cell& cell = meter_->cell(i);
        shared::ViewPush constants = push(view, observer_of(view).layers[0].motion_from_cockpit);
        constants.boost = boost(view, 1);
        constants.origin.x = float(cell.corner.x), constants.origin.y = float(cell.corner.y);
        const glm::dvec2 step = glm::dvec2(view.view().size) / glm::dvec2(cell.size);
        constants.zenith.z = float(step.x), constants.zenith.w = float(step.y);
        set_warp(commands, view, pipelines_.meter(variant(view)), constants, cell.corner, cell.size);
        if (stars_.on())
            meter_stars(commands, view, meter_->star_cell(i));
    }
    commands.endRendering();
    meter_->end(commands);
}

void Frame::meter_stars(vk::CommandBuffer commands, const ViewState& view, const Meter::Cell& cell)
{
    shared::ViewPush constants = star_push(view);
    constants.boost.z = 1;
    constants.corner = glm::vec4(cell.size, meter_->every(), 0);
    WarpVariant own = variant(view);
    own.mips = false;
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.star_meter(own));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.star_layout, 0, *view.warp_set, {});
    commands.pushConstants<shared::ViewPush>(
        *pipelines_.star_layout, vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0, constants);
    stars_.sample(commands, eyes_[view.eye].observer, cell.corner, cell.size, meter_->every(), own.channels);
}

std::optional<double> Frame::metered() const
{
    return meters_ && meter_ ? metered_ev(meter_->view(), meter_->stars()) : std::nullopt;
}

void Frame::pattern_view(vk::CommandBuffer commands, const ViewState& view, vk::Format format)
{
    const View& own = view.view();
    const shared::ViewPush look = push(view, glm::dmat3(1));
    shared::PatternPush constants{};
    constants.row0 = look.row0, constants.row1 = look.row1, constants.row2 = look.row2;
    constants.origin = glm::vec4(own.corner, own.size);
    constants.tint = glm::vec4(pattern_ == Pattern::names ? eye_tint(own.eye) : output_tint(own.output), 0);
    // A table most likely is near a gamma of 2.2. A preview's target is sRGB whatever it shows.
    const Colour& colour = layout_.outputs[view.output].colour;
    const double gamma = colour.lut.empty() ? colour.gamma : 2.2;
    constants.label = glm::vec4(view.label.extent.width, view.label.extent.height, view.shown_part, gamma);
    set_area(commands, own.corner, own.size);
    commands.bindPipeline(
        vk::PipelineBindPoint::eGraphics, pipelines_.pattern(view.compiled.map != nullptr, int(pattern_), format));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.picture_layout, 0, *view.label_set, {});
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
        for (const ViewState& view : views_)
            if (glows && view.output == output && view.view().layer == layer)
                bloom_view(commands, view);
        vk::RenderingAttachmentInfo colour(target.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
            vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
            vk::ClearColorValue(std::array<float, 4>{0, 0, 0, 1}));
        commands.beginRendering({{}, {{0, 0}, target.extent}, 1, 0, colour});
        for (const ViewState& view : views_) {
            if (view.output != output || view.view().layer != layer)
                continue;
            if (pattern_ != Pattern::none)
                pattern_view(commands, view, target.format);
            else if (glows)
                view.bloom->show(commands, view.view().corner, bloom_, target.format);
            else
                warp_view(commands, view, pipelines_.warp(variant_shown(view), target.format), std::exp2(shot_.exposure_ev));
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
        transition(commands, *image, vk::ImageLayout::eUndefined, Stage::eNone, {}, vk::ImageLayout::eColorAttachmentOptimal,
            Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite);
        colours.push_back({*image->view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {}, vk::AttachmentLoadOp::eClear,
            vk::AttachmentStoreOp::eStore, vk::ClearColorValue(std::array<float, 4>{nothing, nothing, nothing, nothing})});
    }
    commands.beginRendering({{}, {{0, 0}, target.camera.extent}, 1, 0, colours});
    for (const ViewState& view : views_)
        if (view.output == output && view.view().layer == 0)
            warp_view(commands, view, pipelines_.measure(variant_shown(view)), 1);
    commands.endRendering();
    for (const Image* image : {&target.light_and_depth, &target.camera, &target.world})
        transition(commands, *image, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
            Access::eColorAttachmentWrite, vk::ImageLayout::eTransferSrcOptimal, Stage::eTransfer, Access::eTransferRead);
}

std::vector<Frame::Axes> Frame::measured_axes(std::size_t output) const
{
    std::vector<Axes> axes;
    for (const ViewState& view : views_)
        if (view.output == output && view.view().layer == 0)
            axes.push_back(
                {view.view().corner, view.view().size, glm::transpose(observer_of(view).layers[0].motion_from_frame)});
    return axes;
}

void Frame::lay_over(vk::CommandBuffer commands, std::size_t output, const Target& last,
    const std::function<void(std::size_t view, vk::Format target)>& draw) const
{
    for (int layer = 0; layer < layers(layout_.outputs[output].packing); ++layer) {
        const Target target = picture_of(output, layer, last);
        vk::ImageMemoryBarrier2 after_warp(Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite,
            Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite | Access::eColorAttachmentRead,
            vk::ImageLayout::eColorAttachmentOptimal, vk::ImageLayout::eColorAttachmentOptimal, VK_QUEUE_FAMILY_IGNORED,
            VK_QUEUE_FAMILY_IGNORED, target.image, {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
        commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, after_warp));
        vk::RenderingAttachmentInfo colour(target.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
            vk::AttachmentLoadOp::eLoad, vk::AttachmentStoreOp::eStore);
        commands.beginRendering({{}, {{0, 0}, target.extent}, 1, 0, colour});
        for (std::size_t i = 0; i < views_.size(); ++i)
            if (views_[i].output == output && views_[i].view().layer == layer)
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
        const ViewState& view = views_[i];
        hud_->draw(commands, i, view.compiled.map != nullptr, push(view, hud_place_.panel_from_cockpit), view.view().corner,
            view.view().size, view.hud_box, {}, target);
    });
}

void Frame::look_up(vk::CommandBuffer commands, const Target& target, vk::Pipeline pipeline, vk::DescriptorSet set)
{
    const ViewState& view = views_.front();
    shared::ViewPush constants = push(view, observer_of(view).layers[0].motion_from_cockpit);
    vk::RenderingAttachmentInfo colour(target.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore);
    commands.beginRendering({{}, {{0, 0}, target.extent}, 1, 0, colour});
    set_area(commands, view.view().corner, view.view().size);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.picture_layout, 0, set, {});
    commands.pushConstants<shared::ViewPush>(*pipelines_.picture_layout, vk::ShaderStageFlagBits::eFragment, 0, constants);
    commands.draw(3, 1, 0, 0);
    commands.endRendering();
}

PlannedImage Frame::plain_image(const Shot& shot, glm::dmat3& straight_from_world) const
{
    const ViewState& view = views_.front();
    straight_from_world = motion_from_world({0, 0, 0}, shot.ship_from_cockpit);
    glm::dmat3 m = straight_from_world * glm::dmat3(glm::mat3_cast(shot.ship_from_cockpit)) * view.compiled.matrix.value();
    glm::dvec3 low = m * glm::dvec3(0, 0, 1), high = m * glm::dvec3(view.view().size, 1);
    // The view's x may run against the face's a: the picture is then mirrored, at the same cost.
    glm::dvec2 one = glm::dvec2(low) / low.z, other = glm::dvec2(high) / high.z;
    PlannedImage image{TILE_FRONT, 0, glm::min(one, other), glm::max(one, other), view.view().size, {0, 0}, 0, 1};
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
    for (const ViewState& view : views_)
        bytes += view.bloom ? view.bloom->memory() : 0;
    for (const OutputState& output : outputs_)
        bytes += output.finish ? output.finish->memory() : 0;
    return bytes;
}

} // namespace starbow
