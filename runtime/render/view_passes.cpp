#include "view_passes.h"
#include "config/model/angles.h"
#include "debug.h"
#include "pattern_label.h"
#include "runtime/hud/hud_place.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

bool drawn_on(const ViewState& view, std::size_t output, std::size_t layer, int canvas)
{
    return view.output == output && std::size_t(view.geometry().layer) == layer && view.geometry().canvas == canvas;
}

} // namespace

ViewPasses::ViewPasses(Device& device, Pipelines& pipelines, const FrameState& state, ViewSet& views, const EyeCubes& eyes,
    StarPass& stars, const ViewConstants& constants, const ViewDescriptors& descriptors)
    : device_(device)
    , pipelines_(pipelines)
    , state_(state)
    , views_(views)
    , eyes_(eyes)
    , stars_(stars)
    , constants_(constants)
    , descriptors_(descriptors)
{
}

void ViewPasses::prepare(const Panel* hud)
{
    if (stars_.on())
        prepare_stars();
    const bool pattern = state_.pattern != Pattern::none;
    for (ViewState& view : views_.all) {
        if (!pattern && state_.bloom == 0) // light that glows is drawn everywhere
            find_lit(view);
        if (state_.bloom == 0)
            view.bloom.reset();
        else if (!view.bloom && !pattern)
            view.bloom = std::make_unique<BloomPass>(device_, pipelines_, view.geometry().size);
        if (pattern && !*view.label.view) {
            view.label = make_label(device_, state_.layout, view.geometry(), views_.sent_pixels(view));
            view.shown_part = shown_part(view.compiled);
        }
    }
    for (const std::unique_ptr<Inset>& inset : views_.insets)
        if (!pattern)
            find_lit(inset->view);
    prepare_callouts();
    hud_on_ = hud;
    if (!hud)
        return;
    if (!hud_)
        hud_ = std::make_unique<PanelPass>(device_, pipelines_, views_.all.size());
    hud_->prepare(*hud, views_.hud_place);
    for (std::size_t i = 0; i < views_.all.size(); ++i)
        hud_->prepare_view(i, views_.map_of(views_.all[i]), descriptors_.nearest());
}

vk::DeviceSize ViewPasses::memory() const
{
    vk::DeviceSize bytes = stars_.picture().bytes + (hud_ ? hud_->memory() : 0);
    for (const auto& pass : callout_passes_)
        bytes += pass->panel.memory();
    return bytes;
}

void ViewPasses::prepare_callouts()
{
    while (callout_passes_.size() < callouts_.size())
        callout_passes_.push_back(std::make_unique<CalloutPass>(CalloutPass{{device_, pipelines_, views_.all.size()}, {}}));
    for (std::size_t k = 0; k < callouts_.size(); ++k) {
        const Callout& callout = callouts_[k];
        auto& [panel, boxes] = *callout_passes_[k];
        if (callout.letters)
            panel.prepare(*callout.letters, callout.place);
        else if (callout.small)
            panel.prepare(*callout.small, callout.place);
        else
            panel.prepare(*callout.picture, callout.place);
        boxes.clear();
        for (std::size_t i = 0; i < views_.all.size(); ++i) {
            const ViewState& view = views_.all[i];
            panel.prepare_view(i, views_.map_of(view), descriptors_.nearest());
            const PixelBox box = panel_box(*view.compiled.cones, callout.place.panel_from_cockpit, callout.place.half);
            boxes.push_back(rect_of(view.geometry().corner + box.low, box.high - box.low));
        }
    }
}

void ViewPasses::prepare_stars()
{
    glm::ivec2 size(1);
    for (const OutputState& output : views_.outputs)
        size = glm::max(size, output.size);
    for (const std::unique_ptr<Inset>& inset : views_.insets)
        size = glm::max(size, inset->view.geometry().size);
    stars_.fit({std::uint32_t(size.x), std::uint32_t(size.y)}, state_.range.has_value());
    star_observers_.clear();
    for (const Observer& one : eyes_.observers)
        star_observers_.push_back({one.rest_frames[0].motion_from_frame, one.shot.effects[Effect::false_colours]});
    stars_.prepare(star_observers_);
}

void ViewPasses::draw_warp(vk::CommandBuffer commands, const ViewState& view, vk::Pipeline pipeline,
    const shared::ViewPush& constants, glm::ivec2 corner, glm::ivec2 size) const
{
    const PixelRect whole{corner, corner + size};
    draw_parts(commands, view, pipeline, constants, {0, 0}, {&whole, 1});
}

void ViewPasses::find_lit(ViewState& view)
{
    const Observer& observer = eyes_.observer_of(view);
    eyes_.find_bodies(view, bodies_);
    view.pixels.find(*view.compiled.cones, observer.rest_frames[0].motion_from_cockpit, observer.E,
        eyes_.dark_D(view, state_.pre_exposure), ray_spread(eyes_.rays_of(view)), bodies_);
}

void ViewPasses::draw_parts(vk::CommandBuffer commands, const ViewState& view, vk::Pipeline pipeline,
    const shared::ViewPush& constants, glm::ivec2 corner, std::span<const PixelRect> parts) const
{
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.layouts.warp_layout, 0, *view.warp_set, {});
    commands.pushConstants<shared::ViewPush>(
        *pipelines_.layouts.warp_layout, vk::ShaderStageFlagBits::eFragment, 0, constants);
    for (const PixelRect& part : parts) {
        set_area(commands, corner + part.low, part.high - part.low);
        commands.draw(3, 1, 0, 0);
    }
}

void ViewPasses::draw_lit(vk::CommandBuffer commands, const ViewState& view, vk::Format target) const
{
    WarpVariant variant = constants_.variant_shown(view);
    const LitPixels& pixels = view.pixels;
    variant.range = state_.range.has_value();
    const shared::ViewPush constants = constants_.exposed_push(view, state_.exposure_of(eyes_.observer_of(view).shot));
    const glm::ivec2 corner = view.geometry().corner;
    if (!pixels.with_bodies.empty())
        draw_parts(commands, view, pipelines_.warp(variant, target), constants, corner, pixels.with_bodies);
    if (variant.stars && !pixels.dark.empty())
        draw_parts(commands, view, pipelines_.dark(variant, target), constants, corner, pixels.dark);
    variant.world_alone = variant.several_rest_frames;
    if (!pixels.lit.empty())
        draw_parts(commands, view, pipelines_.warp(variant, target), constants, corner, pixels.lit);
}

void ViewPasses::draw_stars(
    vk::CommandBuffer commands, std::size_t output, std::size_t layer, int canvas, std::optional<double> exposure)
{
    const Label label(device_, commands, "stars");
    const glm::ivec2 size = views_.outputs[output].size;
    stars_.begin(commands, {std::uint32_t(size.x), std::uint32_t(size.y)});
    for (const ViewState& view : views_.all)
        if (drawn_on(view, output, layer, canvas))
            draw_stars_of(commands, view, exposure);
    stars_.end(commands);
}

void ViewPasses::draw_stars_of(vk::CommandBuffer commands, const ViewState& view, std::optional<double> exposure)
{
    const shared::ViewPush constants = constants_.star_push(view, exposure);
    WarpVariant own = constants_.variant_of_stars(view);
    own.range = exposure && state_.range;
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.stars(own, stars_.format()));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.layouts.star_layout, 0, *view.warp_set, {});
    commands.pushConstants<shared::ViewPush>(*pipelines_.layouts.star_layout,
        vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0, constants);
    const int places = view.map && views_.maps[*view.map].closes ? 2 : 1;
    stars_.draw(commands, view.observer, view.geometry().corner, view.geometry().size, places * (own.channels ? 3 : 1),
        eyes_.all[view.eye].stars);
}

void ViewPasses::draw_inset(vk::CommandBuffer commands, const Inset& inset)
{
    const Label label(device_, commands, "inset");
    const ViewState& view = inset.view;
    const Image& picture = inset.picture;
    if (stars_.on()) {
        stars_.begin(commands, picture.extent);
        draw_stars_of(commands, view, state_.exposure_of(eyes_.observer_of(view).shot));
        stars_.end(commands);
    }
    transition(commands, picture, vk::ImageLayout::eUndefined, Stage::eFragmentShader, {},
        vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite);
    const vk::RenderingAttachmentInfo colour(*picture.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore, vk::ClearColorValue(std::array<float, 4>{0, 0, 0, 1}));
    device_.begin_rendering(commands, {{}, {{0, 0}, picture.extent}, 1, 0, colour});
    draw_lit(commands, view, picture.format);
    device_.end_rendering(commands);
    transition(commands, picture, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
        Access::eColorAttachmentWrite, vk::ImageLayout::eShaderReadOnlyOptimal, Stage::eFragmentShader,
        Access::eShaderSampledRead);
}

void ViewPasses::bloom_view(vk::CommandBuffer commands, const ViewState& view)
{
    const Label label(device_, commands, "bloom");
    const Target light = view.bloom->light();
    view.bloom->begin(commands);
    vk::RenderingAttachmentInfo colour(light.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eStore);
    device_.begin_rendering(commands, {{}, {{0, 0}, light.extent}, 1, 0, colour});
    shared::ViewPush constants = constants_.exposed_push(view, state_.exposure_of(state_.shot));
    constants.origin.x = constants.origin.y = 0;
    WarpVariant linear = constants_.variant_shown(view);
    linear.linear = true;
    linear.range = state_.range.has_value();
    draw_warp(commands, view, pipelines_.warp(linear, light.format), constants, {0, 0}, view.geometry().size);
    device_.end_rendering(commands);
    view.bloom->spread(commands, state_.bloom_above);
}

void ViewPasses::pattern_view(vk::CommandBuffer commands, const ViewState& view, vk::Format format)
{
    const View& own = view.geometry();
    const shared::ViewPush look = constants_.push(view, glm::dmat3(1));
    shared::PatternPush constants{};
    constants.row0 = look.row0, constants.row1 = look.row1, constants.row2 = look.row2;
    constants.origin = glm::vec4(own.corner, own.size);
    constants.tint = glm::vec4(state_.pattern == Pattern::names ? eye_tint(own.eye) : output_tint(own.output), 0);
    // A table of a colour curve is most likely near a gamma of 2.2. A preview's target is sRGB, whatever it shows.
    const Colour& colour = state_.layout.outputs[view.output].colour;
    const double gamma = colour.lut.empty() ? colour.gamma : 2.2;
    constants.label = glm::vec4(view.label.extent.width, view.label.extent.height, view.shown_part, gamma);
    set_area(commands, own.corner, own.size);
    commands.bindPipeline(
        vk::PipelineBindPoint::eGraphics, pipelines_.pattern(view.compiled.map != nullptr, int(state_.pattern), format));
    commands.bindDescriptorSets(
        vk::PipelineBindPoint::eGraphics, *pipelines_.layouts.picture_layout, 0, *view.label_set, {});
    commands.pushConstants<shared::PatternPush>(
        *pipelines_.layouts.picture_layout, vk::ShaderStageFlagBits::eFragment, 0, constants);
    commands.draw(3, 1, 0, 0);
}

void ViewPasses::warp_layer(vk::CommandBuffer commands, std::size_t output, std::size_t layer, const Target& last)
{
    const Label label(device_, commands, "warp");
    if (views_.outputs[output].finish)
        views_.outputs[output].finish->begin(commands);
    for (int canvas = 0; canvas < canvas_count(state_.layout.outputs[output].packing); ++canvas) {
        if (stars_.on() && state_.pattern == Pattern::none)
            draw_stars(commands, output, layer, canvas, state_.exposure_of(state_.shot));
        const Target target = views_.canvas_target(output, canvas, last);
        const bool glows = state_.bloom > 0 && state_.pattern == Pattern::none;
        for (const ViewState& view : views_.all)
            if (glows && drawn_on(view, output, layer, canvas))
                bloom_view(commands, view);
        vk::RenderingAttachmentInfo colour(target.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
            vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
            vk::ClearColorValue(std::array<float, 4>{0, 0, 0, 1}));
        device_.begin_rendering(commands, {{}, {{0, 0}, target.extent}, 1, 0, colour});
        for (ViewState& view : views_.all) {
            if (!drawn_on(view, output, layer, canvas))
                continue;
            if (state_.pattern != Pattern::none)
                pattern_view(commands, view, target.format);
            else if (glows)
                view.bloom->show(commands, view.geometry().corner, state_.bloom, state_.bloom_above,
                    state_.range.has_value(), target.format);
            else
                draw_lit(commands, view, target.format);
        }
        device_.end_rendering(commands);
    }
}

/// Begins a rendering over the target's present picture.
void ViewPasses::begin_over(vk::CommandBuffer commands, const Target& target) const
{
    vk::ImageMemoryBarrier2 after_picture(Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite,
        Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite | Access::eColorAttachmentRead,
        vk::ImageLayout::eColorAttachmentOptimal, vk::ImageLayout::eColorAttachmentOptimal, VK_QUEUE_FAMILY_IGNORED,
        VK_QUEUE_FAMILY_IGNORED, target.image, {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
    commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, after_picture));
    vk::RenderingAttachmentInfo colour(target.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eLoad, vk::AttachmentStoreOp::eStore);
    device_.begin_rendering(commands, {{}, {{0, 0}, target.extent}, 1, 0, colour});
}

void ViewPasses::lay_over(vk::CommandBuffer commands, std::size_t output, std::size_t layer, const Target& last,
    const std::function<void(std::size_t view, vk::Format target)>& draw) const
{
    for (int canvas = 0; canvas < canvas_count(state_.layout.outputs[output].packing); ++canvas) {
        const Target target = views_.canvas_target(output, canvas, last);
        begin_over(commands, target);
        for (std::size_t i = 0; i < views_.all.size(); ++i)
            if (drawn_on(views_.all[i], output, layer, canvas))
                draw(i, target.format);
        device_.end_rendering(commands);
    }
}

void ViewPasses::draw_vignette(vk::CommandBuffer commands, std::size_t output, std::size_t layer, const Target& last)
{
    if (state_.vignette_part <= 0 || state_.pattern != Pattern::none)
        return;
    const Label label(device_, commands, "vignette");
    const Vignette& vignette = state_.vignette;
    // Axes of its own: z along the middle of the clear part, x to the right.
    const double up = degree * vignette.elevation_deg;
    const glm::dvec3 right(1, 0, 0), along(0, std::sin(up), -std::cos(up));
    const glm::dmat3 own_from_cockpit = glm::transpose(glm::dmat3(right, glm::cross(along, right), along));
    const glm::vec4 edge(degree * vignette.clear_deg, degree * (vignette.clear_deg + vignette.soft_deg),
        vignette.darkness * state_.vignette_part, 0);
    lay_over(commands, output, layer, last, [&](std::size_t i, vk::Format target) {
        const ViewState& view = views_.all[i];
        shared::ViewPush constants = constants_.push(view, own_from_cockpit);
        constants.boost = edge;
        draw_warp(commands, view, pipelines_.vignette(view.compiled.map != nullptr, target), constants,
            view.geometry().corner, view.geometry().size);
    });
}

void ViewPasses::draw_hud(vk::CommandBuffer commands, std::size_t output, std::size_t layer, const Target& last)
{
    if (!hud_on_ && callouts_.empty())
        return;
    const Label label(device_, commands, "HUD");
    if (hud_on_)
        hud_->upload(commands);
    for (std::size_t k = 0; k < callouts_.size(); ++k)
        callout_passes_[k]->panel.upload(commands);
    lay_over(commands, output, layer, last, [&](std::size_t i, vk::Format target) {
        const ViewState& view = views_.all[i];
        const auto draw = [&](PanelPass& panel, const PanelPass::Place& place, const vk::Rect2D& box) {
            panel.draw(commands, i, view.compiled.map != nullptr, constants_.push(view, place.panel_from_cockpit),
                view.geometry().corner, view.geometry().size, box, {}, target);
        };
        if (hud_on_)
            draw(*hud_, views_.hud_place, view.hud_box);
        for (std::size_t k = 0; k < callouts_.size(); ++k)
            draw(callout_passes_[k]->panel, callouts_[k].place, callout_passes_[k]->boxes[i]);
    });
}

/// A projector is aligned by its bare picture; the overlap of pictures is judged with blend ramps and masks.
bool ViewPasses::plain_pattern() const
{
    return state_.pattern == Pattern::grid || state_.pattern == Pattern::names || state_.pattern == Pattern::wedges;
}

void ViewPasses::end_layer(vk::CommandBuffer commands, std::size_t output, std::size_t layer)
{
    if (views_.outputs[output].layers() == 1)
        return;
    const Label label(device_, commands, "layer");
    views_.outputs[output].finish->end(commands, layer, plain_pattern());
}

void ViewPasses::finish_output(vk::CommandBuffer commands, std::size_t output, const Target& target)
{
    if (!views_.outputs[output].finish)
        return;
    const Label label(device_, commands, "finish");
    views_.outputs[output].finish->record(commands, target, plain_pattern());
}

void ViewPasses::fade_output(vk::CommandBuffer commands, const Target& target)
{
    if (state_.fade <= 0)
        return;
    const Label label(device_, commands, "fade");
    begin_over(commands, target);
    set_area(commands, {0, 0}, {int(target.extent.width), int(target.extent.height)});
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.fade(target.format));
    commands.pushConstants<float>(
        *pipelines_.layouts.picture_layout, vk::ShaderStageFlagBits::eFragment, 0, float(state_.fade));
    commands.draw(3, 1, 0, 0);
    device_.end_rendering(commands);
}

void ViewPasses::record_measured(
    vk::CommandBuffer commands, std::size_t output, std::size_t layer, const MeasureTarget& target)
{
    if (stars_.on())
        draw_stars(commands, output, layer, 0, {});
    float nothing = std::nanf("");
    std::vector<vk::RenderingAttachmentInfo> colours;
    for (const Image* image : {&target.light_and_depth, &target.camera, &target.world}) {
        transition(commands, *image, vk::ImageLayout::eUndefined, Stage::eNone, {}, vk::ImageLayout::eColorAttachmentOptimal,
            Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite);
        colours.push_back({*image->view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {}, vk::AttachmentLoadOp::eClear,
            vk::AttachmentStoreOp::eStore, vk::ClearColorValue(std::array<float, 4>{nothing, nothing, nothing, nothing})});
    }
    device_.begin_rendering(commands, {{}, {{0, 0}, target.camera.extent}, 1, 0, colours});
    for (const ViewState& view : views_.all)
        if (drawn_on(view, output, layer, 0)) {
            WarpVariant exact = constants_.variant_shown(view);
            exact.sampled_response = false; // numbers do without the rounding of the device's sampler
            draw_warp(commands, view, pipelines_.measure(exact), constants_.exposed_push(view, 1), view.geometry().corner,
                view.geometry().size);
        }
    device_.end_rendering(commands);
    for (const Image* image : {&target.light_and_depth, &target.camera, &target.world})
        transition(commands, *image, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
            Access::eColorAttachmentWrite, vk::ImageLayout::eTransferSrcOptimal, Stage::eTransfer, Access::eTransferRead);
}

std::vector<ViewPasses::Axes> ViewPasses::measured_axes(std::size_t output) const
{
    std::vector<Axes> axes;
    for (const ViewState& view : views_.all)
        if (view.output == output && view.geometry().canvas == 0) {
            const Observer& observer = eyes_.observer_of(view);
            const RestFrameView& rest_frame = observer.rest_frames[0];
            const double speed = glm::length(observer.shot.u);
            axes.push_back({std::size_t(view.geometry().layer), view.geometry().corner, view.geometry().size,
                glm::transpose(rest_frame.motion_from_frame), glm::transpose(rest_frame.cube_from_frame),
                speed > 0 ? observer.shot.u / speed : glm::dvec3(0)});
        }
    return axes;
}

void ViewPasses::look_up(vk::CommandBuffer commands, const Target& target, vk::Pipeline pipeline, vk::DescriptorSet set)
{
    const ViewState& view = views_.all.front();
    shared::ViewPush constants = constants_.push(view, eyes_.observer_of(view).rest_frames[0].motion_from_cockpit);
    vk::RenderingAttachmentInfo colour(target.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore);
    device_.begin_rendering(commands, {{}, {{0, 0}, target.extent}, 1, 0, colour});
    set_area(commands, view.geometry().corner, view.geometry().size);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.layouts.picture_layout, 0, set, {});
    commands.pushConstants<shared::ViewPush>(
        *pipelines_.layouts.picture_layout, vk::ShaderStageFlagBits::eFragment, 0, constants);
    commands.draw(3, 1, 0, 0);
    device_.end_rendering(commands);
}

PlannedImage ViewPasses::plain_image(const Shot& shot, glm::dmat3& straight_from_world) const
{
    const ViewState& view = views_.all.front();
    straight_from_world = motion_from_world({0, 0, 0}, shot.ship_from_cockpit);
    glm::dmat3 m = straight_from_world * glm::dmat3(glm::mat3_cast(shot.ship_from_cockpit)) * view.compiled.matrix.value();
    glm::dvec3 low = m * glm::dvec3(0, 0, 1), high = m * glm::dvec3(view.geometry().size, 1);
    // The view's x may run against the face's a: the picture is then mirrored, in the same time.
    glm::dvec2 one = glm::dvec2(low) / low.z, other = glm::dvec2(high) / high.z;
    PlannedImage image{TILE_FRONT, 0, glm::min(one, other), glm::max(one, other), view.geometry().size, {0, 0}, 0, 1};
    image.texels_per_unit = image.size.y / (image.high.y - image.low.y);
    return image;
}

} // namespace starbow
