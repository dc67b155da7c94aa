#include "frame_renderer.h"
#include "debug.h"
#include "runtime/operation/trace.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace starbow {

void FrameRenderer::draw(
    vk::CommandBuffer world, vk::CommandBuffer outputs, const Shot& shot, const Panel* hud, std::span<const Target> targets)
{
    // The processor's part.
    update(shot, hud);

    // The device's part.
    const Trace::Span span(device_.trace, "record");
    if (state_.pattern == Pattern::none) {
        draw_cubes(world);
        meter_.record(world);
        measurement_.draw_probes(world);
        for (const std::unique_ptr<Inset>& inset : views_.insets)
            passes_.draw_inset(world, *inset);
    }
    for (std::size_t output = 0; output < targets.size(); ++output) {
        if (!targets[output].view)
            continue; // minimised, or its monitor is away
        for (std::size_t layer = 0; layer < views_.outputs[output].layers(); ++layer) { // one, unless viewports overlap
            passes_.warp_layer(outputs, output, layer, targets[output]); // stars and bloom included
            passes_.draw_vignette(outputs, output, layer, targets[output]);
            measurement_.draw(outputs, output, layer, targets[output]); // the overlay
            passes_.draw_hud(outputs, output, layer, targets[output]);
            passes_.end_layer(outputs, output, layer);
        }
        passes_.finish_output(outputs, output, targets[output]);
        passes_.fade_output(outputs, targets[output]);
    }
}

void FrameRenderer::update(const Shot& shot, const Panel* hud)
{
    state_.shot = shot;
    state_.all_light = counts_all_light_ || measurement_.overlay_on() || state_.range; // an overlay's lines follow surfaces
                                                                                       // in the dark too
    const double most_E = eyes_.observe();
    eyes_.observe_insets(views_.insets);
    if (state_.pattern == Pattern::none)
        eyes_.plan(pre_exposure(most_E), measurement_.probe());
    const Trace::Span span(device_.trace, "upload");
    passes_.prepare(hud);
    meter_.prepare();
    descriptors_.write();
    measurement_.prepare();
}

void FrameRenderer::draw_cubes(vk::CommandBuffer commands)
{
    const Label label(device_, commands, "cube pass");
    eyes_.record(commands);
}

void FrameRenderer::record_measured(
    vk::CommandBuffer commands, std::size_t output, std::size_t layer, const MeasureTarget& target)
{
    draw_cubes(commands);
    passes_.record_measured(commands, output, layer, target);
}

FrameRenderer::FrameRenderer(Device& device, Pipelines& pipelines, const GpuWorld& world, const Layout& layout,
    const Quality& quality, bool keeps_depth, std::optional<PreparedLayout> prepared)
    : device_(device)
    , pipelines_(pipelines)
    , world_(world)
    , state_{.quality = quality, .layout = with_stereo(layout, quality)}
    , seen_stars_(device, world)
    , stars_(device, pipelines, world, seen_stars_, keeps_depth)
    , views_(device, pipelines, state_, world.scene, stars_.on())
    , eyes_(device, pipelines, world, state_, views_, seen_stars_)
    , constants_(world, state_, views_, eyes_)
    , descriptors_(device, world, state_, views_, eyes_, stars_)
    , passes_(device, pipelines, state_, views_, eyes_, stars_, constants_, descriptors_)
    , meter_(device, pipelines, state_, views_, eyes_, stars_, constants_, passes_, std::uint32_t(world.stars.brightest),
          world.globes != nullptr)
    , measurement_(device, pipelines, world, state_, views_, eyes_, constants_, descriptors_, passes_)
{
    state_.keeps_depth = keeps_depth || state_.reprojects() || stars_.on() || world.several_rest_frames();
    if (prepared && prepared->method == state_.layout.stereo.method
        && prepared->matrices == uses_matrices(state_.layout, quality)) {
        for (std::size_t output = 0; output < prepared->sizes.size(); ++output)
            views_.outputs[output].size = prepared->sizes[output];
        apply_layout(std::move(prepared->parts));
    } else {
        apply_layout(views_.parts(true));
    }
}

void FrameRenderer::apply_layout(LayoutParts parts)
{
    views_.apply_layout(std::move(parts));
    eyes_.assign(views_.all);
    meter_.reset();
    measurement_.reset();
}

/// Applies the state's layout. If the device has no room for it, some views have lost their objects: `undo` restores the
/// state, and all views are made again as they were. Where not even that succeeds, the device must be opened anew.
template <class Undo> void FrameRenderer::apply_layout_or(bool rejects_empty, const Undo& undo)
{
    std::optional<LayoutParts> parts;
    try {
        parts = in_room([&] { return views_.parts(rejects_empty); });
    } catch (...) {
        undo();
        throw;
    }
    try {
        in_room([&] { apply_layout(std::move(*parts)); });
    } catch (...) {
        undo();
        try {
            in_room([&] { apply_layout(views_.parts(false)); });
        } catch (const InputError& error) {
            throw vk::OutOfDeviceMemoryError(error.what());
        }
        throw;
    }
}

/// The factor that keeps every radiance of this instant in the range of the stored coefficients.
double FrameRenderer::pre_exposure(double most_E) const
{
    double least = pre_exposure(state_.shot, most_E, eyes_.light_of(views_.probed_view().eye));
    for (const std::unique_ptr<Inset>& inset : views_.insets) {
        const ViewState& view = inset->view;
        const Observer& observer = eyes_.observer_of(view);
        least = std::min(least, pre_exposure(observer.shot, observer.most_E(), eyes_.light_of(view.eye)));
    }
    return least;
}

/// The same for the observers of one shot. light: that their cube map stores.
double FrameRenderer::pre_exposure(const Shot& shot, double most_E, StoredLight light) const
{
    const Effects& effects = shot.effects;
    const bool gains = effects[Effect::headlight] || effects[Effect::doppler];
    // Red-shifted sunlight also leaves the visible range: by Wien's law its share at 360 nm falls as exp(-6.92 (1/D -
    // 1)).
    const double leaves = effects[Effect::doppler] ? std::exp(6.92 * (most_E - 1)) : 1;
    const bool unshifted = light == StoredLight::unshifted;
    const double brightest
        = unshifted ? std::max(world_.brightest * world_.unshifted->gain, world_.unshifted->most) : world_.brightest;
    const double factor = starbow::pre_exposure(
        brightest, state_.range ? -60 : shot.exposure_ev, (gains ? most_E * most_E * most_E : 1) * leaves);
    // A glow's coefficient may represent light of any strength, so it is limited by its size alone.
    const bool by_size = !unshifted && world_.spectra.most > 0;
    return by_size ? std::min(factor, starbow::pre_exposure(world_.spectra.most, -1000, 1)) : factor;
}

void FrameRenderer::resize(std::size_t output, glm::ivec2 size)
{
    if (views_.outputs[output].size == size)
        return;
    const glm::ivec2 before = std::exchange(views_.outputs[output].size, size);
    // A visitor may drag a window so small that a viewport shows nothing.
    apply_layout_or(false, [&] { views_.outputs[output].size = before; });
}

void FrameRenderer::adopt(const Layout& layout)
{
    views_.store.keep(false);
    Layout before = std::exchange(state_.layout, with_stereo(layout, state_.quality));
    const auto undo = [&] {
        state_.layout = std::move(before);
        views_.store.keep(true);
    };
    apply_layout_or(true, undo);
    views_.store.keep(true);
}

void FrameRenderer::adopt(const Quality& quality)
{
    const Quality before = std::exchange(state_.quality, quality);
    eyes_.adopt(quality);
    if (quality.cube_samples == before.cube_samples && quality.half_floats == before.half_floats)
        return;
    eyes_.clear();
    const auto undo = [&] {
        state_.quality = before;
        eyes_.clear();
    };
    apply_layout_or(false, undo);
}

void FrameRenderer::move_head(const Head& head)
{
    views_.move_head(head);
    eyes_.move();
}

void FrameRenderer::show_inset(const Shot& shot, int width, double fov_deg, std::size_t which)
{
    std::vector<std::unique_ptr<Inset>>& all = views_.insets;
    if (which < all.size() && (int(all[which]->picture.extent.width) != width || all[which]->fov_deg != fov_deg))
        drop_insets(which);
    if (which == all.size())
        all.push_back(in_room([&] { return std::make_unique<Inset>(device_, pipelines_, width, fov_deg); }));
    all[which]->shot = shot;
}

void FrameRenderer::drop_insets(std::size_t from)
{
    if (from < views_.insets.size())
        views_.insets.resize(from);
    if (from == 0)
        eyes_.forget_insets();
}

void FrameRenderer::repeatable(bool on)
{
    state_.repeatable = on;
    eyes_.repeatable(on);
}

void FrameRenderer::measure(const std::optional<Measuring>& what)
{
    measurement_.set(what);
    if (!what || state_.keeps_depth)
        return;
    state_.keeps_depth = true;
    eyes_.clear();
    apply_layout(views_.parts(false));
}

vk::DeviceSize FrameRenderer::memory() const
{
    return views_.memory() + eyes_.memory() + passes_.memory() + meter_.memory() + measurement_.memory();
}

} // namespace starbow
