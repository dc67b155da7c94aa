#include "view_measurement.h"
#include "debug.h"
#include "runtime/hud/hud_place.h"
#include <algorithm>
#include <cmath>

namespace starbow {

void ViewMeasurement::set(const std::optional<Measuring>& what)
{
    on_ = what.has_value();
    if (what)
        what_ = *what;
    else
        reset();
}

MeasuringObserver ViewMeasurement::measuring_observer_at(const glm::dvec3& eye_m) const
{
    return measuring_observer_of(state_.shot, state_.shot.ship_from_cockpit * views_.scene_units(eye_m));
}

const Probe* ViewMeasurement::probe()
{
    if (!on_ || what_.probes.empty()) {
        probe_.reset();
        return nullptr;
    }
    // The probes are as fine as the picture there, so the plan's resolution does not grow for them.
    const double angle = std::max(double(views_.probed_view().compiled.cones->cone(0, {0, 0}).finest), 2e-4);
    if (!probe_ || !probe_->looks(what_.probes, angle))
        probe_ = std::make_unique<Probe>(device_, what_.probes, angle);
    return probe_.get();
}

void ViewMeasurement::prepare()
{
    if (!on_ || state_.pattern != Pattern::none)
        return;
    const ViewState& probed = views_.probed_view();
    const glm::dvec3 eye_m = eyes_.all[probed.eye].now_m;
    observer_ = measuring_observer_at(eye_m);
    const bool of_one_eye = state_.layout.stereo.method == StereoMethod::exact;
    head_ = measuring_observer_at(of_one_eye ? eye_m - (probed.geometry().picture.eye_m - probed.geometry().head_m) : eye_m);
    world_from_motion_ = glm::transpose(eyes_.observer_of(probed).rest_frames[0].motion_from_frame);
    if (what_.over.overlay != Overlay::off) {
        if (!overlay_)
            overlay_ = std::make_unique<OverlayPass>(device_, pipelines_, views_.all.size());
        for (std::size_t i = 0; i < views_.all.size(); ++i)
            overlay_->prepare(
                i, what_.over, measuring_observer_at(eyes_.all[views_.all[i].eye].now_m + views_.all[i].beside_m), world_);
    }
    const Panel* panel = what_.panel;
    if (!panel)
        return;
    if (!panel_)
        panel_ = std::make_unique<PanelPass>(device_, pipelines_, views_.all.size());
    const PanelPass::Place place = views_.lab_place(double(panel->size.y) / panel->size.x);
    panel_->prepare(*panel, place);
    boxes_.clear();
    for (std::size_t i = 0; i < views_.all.size(); ++i) {
        panel_->prepare_view(i, views_.map_of(views_.all[i]), descriptors_.nearest());
        const PixelBox box = panel_box(*views_.all[i].compiled.cones, place.panel_from_cockpit, place.half);
        boxes_.push_back(rect_of(views_.all[i].geometry().corner + box.low, box.high - box.low));
    }
}

void ViewMeasurement::draw_probes(vk::CommandBuffer commands)
{
    if (!probe_)
        return;
    const Label label(device_, commands, "probes");
    const ViewState& view = views_.probed_view();
    WarpVariant own = constants_.variant(view);
    own.map = own.channels = own.reproject = own.turning = own.stars
        = false; // a probe is a flat view from the cube map's own place
    const vk::Pipeline pipeline = pipelines_.probe(own);
    probe_->record(commands, [&](std::size_t i, const glm::dmat3& cockpit_from_pixel) {
        shared::ViewPush constants = constants_.push(view, eyes_.observer_of(view).rest_frames[0].motion_from_cockpit);
        const glm::dmat3 m = eyes_.observer_of(view).rest_frames[0].motion_from_cockpit * cockpit_from_pixel;
        constants.row0 = shared::row(m, 0, float(std::sqrt(std::abs(glm::determinant(m)))));
        constants.row1 = shared::row(m, 1, constants.row1.w);
        constants.row2 = shared::row(m, 2, constants.row2.w);
        constants.boost = constants_.exposed_push(view, 1).boost;
        constants.origin.x = float(i), constants.origin.y = 0;
        passes_.draw_warp(commands, view, pipeline, constants, {int(i), 0}, {1, 1});
    });
}

std::vector<Probed> ViewMeasurement::probed() const
{
    std::vector<Probed> all = probe_ ? probe_->read() : std::vector<Probed>();
    for (Probed& one : all)
        one.ray = {world_from_motion_ * one.ray.ship, world_from_motion_ * one.ray.world, one.ray.D};
    return all;
}

void ViewMeasurement::draw(vk::CommandBuffer commands, std::size_t output, const Target& last)
{
    if (!on_ || state_.pattern != Pattern::none || (!what_.panel && what_.over.overlay == Overlay::off))
        return;
    const Label label(device_, commands, "overlay");
    if (what_.panel)
        panel_->upload(commands);
    passes_.lay_over(commands, output, last, [&](std::size_t i, vk::Format target) {
        const ViewState& view = views_.all[i];
        const glm::ivec2 corner = view.geometry().corner, size = view.geometry().size;
        shared::ViewPush constants = constants_.exposed_push(view, 1);
        if (what_.over.overlay != Overlay::off)
            overlay_->draw(
                commands, i, constants_.variant(view), what_.over.overlay, *view.warp_set, constants, corner, size, target);
        if (what_.panel)
            panel_->draw(commands, i, view.compiled.map != nullptr,
                constants_.push(view, panel_->place().panel_from_cockpit), corner, size, boxes_[i], what_.scale, target);
    });
}

void ViewMeasurement::reset() { overlay_.reset(), panel_.reset(), probe_.reset(); }

} // namespace starbow
