// What a frame does for who measures: probes, overlays, the panel of readings.
#include "config/model/angles.h"
#include "frame.h"
#include "runtime/hud/hud_place.h"
#include "shaders/physics/physics.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

} // namespace

void Frame::measure(const std::optional<Measuring>& what)
{
    if (!what) {
        lab_.reset();
        return;
    }
    if (!lab_)
        lab_ = std::make_unique<LabPasses>();
    lab_->what = *what;
    if (!keeps_depth_) {
        keeps_depth_ = true;
        eyes_.clear();
        apply_layout(parts(false));
    }
}

void Frame::forget_lab()
{
    if (lab_)
        lab_->overlay.reset(), lab_->panel.reset(), lab_->probe.reset();
}

/// A view of the visitor's own, not a preview, where there is one.
const Frame::ViewState& Frame::probed_view() const
{
    for (const ViewState& view : views_)
        if (!layout_.outputs[view.output].preview && view.view().observer == ViewportObserver{})
            return view;
    return views_.front();
}

MeasuringObserver Frame::measuring_observer_at(const glm::dvec3& eye_m) const
{
    return measuring_observer_of(shot_, shot_.ship_from_cockpit * scene_units(eye_m));
}

void Frame::request_probes(std::size_t eye, const glm::dmat3& motion_from_cockpit, std::vector<ViewRequest>& requests) const
{
    LabPasses& lab = *lab_;
    const ViewState& view = probed_view();
    if (eye != view.eye)
        return;
    // As finely as the picture there, so that the plan grows no finer for it.
    const double angle = std::max(double(view.compiled.cones->cone(0, {0, 0}).finest), 2e-4);
    if (lab.what.probes.empty())
        lab.probe.reset();
    else if (!lab.probe || !lab.probe->looks(lab.what.probes, angle))
        lab.probe = std::make_unique<Probe>(device_, lab.what.probes, angle);
    for (std::size_t i = 0; lab.probe && i < lab.probe->count(); ++i)
        requests.push_back({&lab.probe->view(i), motion_from_cockpit});
}

PanelPass::Place Frame::lab_place(double aspect) const
{
    std::vector<std::vector<CompiledView>> shown(outputs_.size());
    for (const ViewState& view : views_)
        shown[view.output].push_back(view.compiled);
    return {panel_from_cockpit(instruments_place(layout_.hud, aspect, shown), shown),
        std::tan(0.5 * layout_.hud.width_deg * degree) * glm::dvec2(1, aspect)};
}

int Frame::lab_panel_width(double aspect) const
{
    const PanelPass::Place place = lab_place(aspect);
    double finest = 1;
    for (const ViewState& view : views_)
        finest = std::min(finest, panel_box(*view.compiled.cones, place.panel_from_cockpit, place.half).finest);
    return std::clamp(int(2 * place.half.x / finest), 160, 4096);
}

void Frame::prepare_lab()
{
    LabPasses& lab = *lab_;
    const ViewState& probed = probed_view();
    const glm::dvec3 eye_m = eyes_[probed.eye].now_m;
    lab.observer = measuring_observer_at(eye_m);
    const bool of_one_eye = layout_.stereo.method == StereoMethod::exact;
    lab.head = measuring_observer_at(of_one_eye ? eye_m - (probed.view().picture.eye_m - probed.view().head_m) : eye_m);
    lab.world_from_motion = glm::transpose(observer_of(probed).layers[0].motion_from_frame);
    if (lab.what.over.overlay != Overlay::off) {
        if (!lab.overlay)
            lab.overlay = std::make_unique<OverlayPass>(device_, pipelines_, views_.size());
        for (std::size_t i = 0; i < views_.size(); ++i)
            lab.overlay->prepare(i, lab.what.over, measuring_observer_at(eyes_[views_[i].eye].now_m + views_[i].beside_m), world_);
    }
    const Panel* panel = lab.what.panel;
    if (!panel)
        return;
    if (!lab.panel)
        lab.panel = std::make_unique<PanelPass>(device_, pipelines_, views_.size());
    const PanelPass::Place place = lab_place(double(panel->size.y) / panel->size.x);
    lab.panel->prepare(*panel, place);
    lab.boxes.clear();
    for (std::size_t i = 0; i < views_.size(); ++i) {
        lab.panel->prepare_view(i, map_of(views_[i]), *nearest_);
        const PixelBox box = panel_box(*views_[i].compiled.cones, place.panel_from_cockpit, place.half);
        lab.boxes.push_back(rect_of(views_[i].view().corner + box.low, box.high - box.low));
    }
}

void Frame::draw_probes(vk::CommandBuffer commands)
{
    if (!lab_ || !lab_->probe)
        return;
    const ViewState& view = probed_view();
    WarpVariant own = variant(view);
    own.map = own.channels = own.reproject = own.turning = own.stars = false; // flat, from where the cube map was drawn
    const vk::Pipeline pipeline = pipelines_.probe(own);
    lab_->probe->record(commands, [&](std::size_t i, const glm::dmat3& cockpit_from_pixel) {
        shared::ViewPush constants = push(view, observer_of(view).layers[0].motion_from_cockpit);
        const glm::dmat3 m = observer_of(view).layers[0].motion_from_cockpit * cockpit_from_pixel;
        constants.row0 = shared::row(m, 0, float(std::sqrt(std::abs(glm::determinant(m)))));
        constants.row1 = shared::row(m, 1, constants.row1.w);
        constants.row2 = shared::row(m, 2, constants.row2.w);
        constants.boost = boost(view, 1);
        constants.origin.x = float(i), constants.origin.y = 0;
        set_warp(commands, view, pipeline, constants, {int(i), 0}, {1, 1});
    });
}

std::vector<Probed> Frame::probed() const
{
    std::vector<Probed> all = lab_ && lab_->probe ? lab_->probe->read() : std::vector<Probed>();
    for (Probed& one : all)
        one.ray = {lab_->world_from_motion * one.ray.ship, lab_->world_from_motion * one.ray.world, one.ray.D};
    return all;
}

void Frame::draw_lab(vk::CommandBuffer commands, std::size_t output, const Target& last)
{
    if (!lab_ || pattern_ != Pattern::none || (!lab_->what.panel && lab_->what.over.overlay == Overlay::off))
        return;
    if (lab_->what.panel)
        lab_->panel->upload(commands);
    lay_over(commands, output, last, [&](std::size_t i, vk::Format target) {
        const ViewState& view = views_[i];
        const glm::ivec2 corner = view.view().corner, size = view.view().size;
        shared::ViewPush constants = push(view, observer_of(view).layers[0].motion_from_cockpit);
        constants.boost = boost(view, 1);
        if (lab_->what.over.overlay != Overlay::off)
            lab_->overlay->draw(
                commands, i, variant(view), lab_->what.over.overlay, *view.warp_set, constants, corner, size, target);
        if (lab_->what.panel)
            lab_->panel->draw(commands, i, view.compiled.map != nullptr, push(view, lab_->panel->place().panel_from_cockpit),
                corner, size, lab_->boxes[i], lab_->what.scale, target);
    });
}

std::optional<glm::dvec3> Frame::direction(std::size_t output, const glm::dvec2& pixel) const
{
    for (const ViewState& view : views_) {
        const glm::dvec2 at = pixel - glm::dvec2(view.view().corner), size(view.view().size);
        if (view.output != output || view.view().layer != 0 || at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y)
            continue;
        if (view.compiled.matrix)
            return glm::normalize(*view.compiled.matrix * glm::dvec3(at, 1));
        const glm::vec4 texel = view.compiled.map->at(int(at.x), int(at.y));
        if (texel.w > 0)
            return glm::normalize(glm::dvec3(texel));
    }
    return {};
}

} // namespace starbow
