#include "view_measurement.h"
#include "debug.h"
#include "runtime/hud/hud_place.h"
#include "runtime/world/sky_names.h"
#include "runtime/world/stars.h"
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

/// A view's own observer, whose velocity may differ from the ship's, with an eye at a place of the cockpit.
MeasuringObserver ViewMeasurement::measuring_observer_at(const ViewState& view, const glm::dvec3& eye_m) const
{
    const Shot& shot = eyes_.observer_of(view).shot;
    return measuring_observer_of(shot, shot.ship_from_cockpit * views_.scene_units(eye_m));
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
    const bool of_one_eye = state_.layout.stereo.method == StereoMethod::exact;
    observers_.clear();
    for (std::size_t i = 0; i < std::max<std::size_t>(what_.probes.size(), 1); ++i) {
        const ViewState& probed = views_.probed_view(what_.probes.empty() ? std::nullopt : what_.probes[i].view);
        const glm::dvec3 eye_m = eyes_.all[probed.eye].now_m, head_m = probed.geometry().head_m;
        const RestFrameView& rest_frame = eyes_.observer_of(probed).rest_frames[0];
        observers_.push_back({measuring_observer_at(probed, eye_m),
            measuring_observer_at(probed, of_one_eye ? eye_m - (probed.geometry().picture.eye_m - head_m) : eye_m),
            glm::transpose(rest_frame.motion_from_frame), glm::transpose(rest_frame.cube_from_frame)});
    }
    if (what_.over.any())
        prepare_overlay();
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

void ViewMeasurement::prepare_overlay()
{
    const bool figures_on = what_.over.figures && !world_.sky_names.constellations.empty();
    if (!overlay_ || (figures_on && !overlay_->has_figures()))
        overlay_ = std::make_unique<OverlayPass>(
            device_, pipelines_, views_.all.size(), figures_on ? figures() : std::vector<glm::vec4>());
    for (std::size_t i = 0; i < views_.all.size(); ++i)
        overlay_->prepare(i, what_.over,
            measuring_observer_at(views_.all[i], eyes_.all[views_.all[i].eye].now_m + views_.all[i].beside_m), world_);
}

/// The table of the constellations' lines, which takes a few hundredths of a second once.
const std::vector<glm::vec4>& ViewMeasurement::figures()
{
    if (!figures_)
        figures_ = figure_table(world_.sky_names, world_from_equatorial(world_.scene.stars->ahead_deg));
    return *figures_;
}

void ViewMeasurement::draw_probes(vk::CommandBuffer commands)
{
    if (!probe_)
        return;
    const Label label(device_, commands, "probes");
    probe_->record(commands, [&](std::size_t i, const glm::dmat3& cockpit_from_pixel) {
        const ViewState& view = views_.probed_view(probe_->ray(i).view);
        WarpVariant own = constants_.variant(view);
        own.map = own.channels = own.reproject = own.turning = own.stars
            = false; // a probe is a flat view from the cube map's own place
        shared::ViewPush constants = constants_.push(view, eyes_.observer_of(view).rest_frames[0].motion_from_cockpit);
        const glm::dmat3 m = eyes_.observer_of(view).rest_frames[0].motion_from_cockpit * cockpit_from_pixel;
        constants.row0 = shared::row(m, 0, float(std::sqrt(std::abs(glm::determinant(m)))));
        constants.row1 = shared::row(m, 1, constants.row1.w);
        constants.row2 = shared::row(m, 2, constants.row2.w);
        constants.boost = constants_.exposed_push(view, 1).boost;
        constants.origin.x = float(i), constants.origin.y = 0;
        passes_.draw_warp(commands, view, pipelines_.probe(own), constants, {int(i), 0}, {1, 1});
    });
}

std::vector<Probed> ViewMeasurement::probed() const
{
    std::vector<Probed> all = probe_ ? probe_->read() : std::vector<Probed>();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const ProbeObserver& from = observers_[i];
        all[i].ray = {from.world_from_motion * all[i].ray.ship, from.world_from_cube * all[i].ray.world, all[i].ray.D};
    }
    return all;
}

void ViewMeasurement::draw(vk::CommandBuffer commands, std::size_t output, std::size_t layer, const Target& last)
{
    if (!on_ || state_.pattern != Pattern::none || (!what_.panel && !what_.over.any()))
        return;
    const Label label(device_, commands, "overlay");
    if (what_.panel)
        panel_->upload(commands);
    passes_.lay_over(commands, output, layer, last, [&](std::size_t i, vk::Format target) {
        const ViewState& view = views_.all[i];
        const glm::ivec2 corner = view.geometry().corner, size = view.geometry().size;
        shared::ViewPush constants = constants_.exposed_push(view, 1);
        if (what_.over.any()) {
            WarpVariant own = constants_.variant(view);
            own.glows = false; // lines and scales have no light of the world
            overlay_->draw(commands, i, own, what_.over, *view.warp_set, constants, corner, size, target);
        }
        if (what_.panel)
            panel_->draw(commands, i, view.compiled.map != nullptr,
                constants_.push(view, panel_->place().panel_from_cockpit), corner, size, boxes_[i], what_.scale, target);
    });
}

void ViewMeasurement::reset() { overlay_.reset(), panel_.reset(), probe_.reset(); }

} // namespace starbow
