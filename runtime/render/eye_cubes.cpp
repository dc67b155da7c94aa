#include "eye_cubes.h"
#include "config/model/inset_view.h"
#include "runtime/operation/trace.h"
#include "runtime/plan/cull.h"
#include "runtime/plan/scratch.h"
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace starbow {
namespace {

/// Turns an observer's cockpit: by a rotation among its own axes.
void turn_cockpit(Observer& observer, const glm::dquat& by)
{
    observer.shot.ship_from_cockpit = observer.shot.ship_from_cockpit * by;
    for (RestFrameView& view : observer.rest_frames) {
        view.shot.ship_from_cockpit = view.shot.ship_from_cockpit * by;
        view.motion_from_cockpit = view.motion_from_cockpit * glm::mat3_cast(by);
    }
}

} // namespace

EyeCubes::EyeCubes(
    Device& device, Pipelines& pipelines, const GpuWorld& world, FrameState& state, const ViewSet& views, SeenStars& stars)
    : device_(device)
    , pipelines_(pipelines)
    , world_(world)
    , state_(state)
    , views_(views)
    , stars_(stars)
{
}

void EyeCubes::assign(std::vector<ViewState>& views)
{
    forget_insets(); // they come after the eyes of all views
    for (ViewState& view : views) {
        view.eye = eye_for(view);
        view.observer = all[view.eye].observer;
    }
    plans.resize(all.size());
    drawn_ = false;
}

void EyeCubes::clear()
{
    all.clear(), observers.clear();
    inset_observers_ = inset_eyes_ = 0;
}

double EyeCubes::pixel_of(std::size_t eye) const
{
    double finest = 0;
    for (const ViewState& view : views_.all)
        if (view.eye == eye)
            finest = finest_pixel_rad(finest, view.compiled);
    return finest;
}

void EyeCubes::adopt(const Quality& quality)
{
    drawn_ = false;
    for (EyeCube& eye : all)
        eye.cube.adopt(quality);
}

void EyeCubes::release()
{
    drawn_ = false;
    for (EyeCube& eye : all)
        eye.cube.release();
}

void EyeCubes::repeatable(bool on)
{
    for (EyeCube& eye : all)
        eye.cube.repeatable(on);
}

void EyeCubes::move()
{
    for (const ViewState& view : views_.all)
        all[view.eye].now_m = view.cube_m;
}

double EyeCubes::observe()
{
    double most_E = 1;
    for (Observer& one : std::span(observers).first(observers.size() - inset_observers_)) {
        if (state_.repeatable)
            one.rest_frames.clear();
        one = starbow::observer_of(world_.world, state_.shot, one.observer, std::move(one.rest_frames));
        most_E = std::max(most_E, one.most_E());
    }
    return most_E;
}

void EyeCubes::observe_insets(const std::vector<std::unique_ptr<Inset>>& insets)
{
    const std::size_t before = observers.size() - inset_observers_;
    inset_observers_ = insets.size();
    observers.resize(before + insets.size());
    std::size_t own_eyes = 0;
    for (std::size_t i = 0; i < insets.size(); ++i) {
        insets[i]->view.observer = before + i;
        if (shares_first_eye(*insets[i]))
            insets[i]->view.eye = views_.probed_view().eye;
        else
            give_eye(insets[i]->view, own_eyes++);
    }
    keep_inset_eyes(own_eyes);
}

/// Makes an inset's observer. True if the inset is warped from the cube map of the frame's first view.
bool EyeCubes::shares_first_eye(const Inset& inset)
{
    const Observer& first = observers[views_.probed_view().observer];
    Observer& own = observers[inset.view.observer];
    if (looks_closer(inset)) {
        own = first;
        turn_cockpit(own, glm::inverse(state_.shot.ship_from_cockpit) * inset.shot.ship_from_cockpit);
        return true;
    }
    if (state_.repeatable)
        own.rest_frames.clear();
    own = starbow::observer_of(world_.world, inset.shot, {}, std::move(own.rest_frames));
    return shares_cube(own, first);
}

/// Gives an inset's view one of the cube maps of insets. which: from 0.
void EyeCubes::give_eye(ViewState& view, std::size_t which)
{
    const glm::dvec3 place = all[views_.probed_view().eye].now_m;
    if (which == inset_eyes_) {
        all.push_back(
            {place, view.observer, CubePass(device_, pipelines_, world_, state_.quality, state_.keeps_depth), place});
        all.back().cube.repeatable(state_.repeatable);
        plans.emplace_back();
        ++inset_eyes_;
    }
    view.eye = all.size() - inset_eyes_ + which;
    all[view.eye].observer = view.observer;
    all[view.eye].now_m = place;
}

/// True if the inset is a telescope that looks into the first view's own light, only finer, from the same cube map.
bool EyeCubes::looks_closer(const Inset& inset) const { return inset.fov_deg < inset_fov_deg && !state_.reprojects(); }

/// True if another inset is warped from the cube map of the frame's first view: where neither is aberrated. Light
/// that arrives at one event is the same for all observers there, but at another aberration they need other directions
/// finely, so that the common cube map would have the texels of both. At the same aberration it has mips for the small
/// picture alone, or that takes several rays a pixel; on two cores, without a GPU, a frame at gamma 4 took 1.28 and 1.27
/// times as long with these, and 1.19 with a small cube map of its own. Without aberration, several rays a pixel take 1.08,
/// and the cube map 1.14.
bool EyeCubes::shares_cube(const Observer& inset, const Observer& first) const
{
    const RestFrameView &own = inset.rest_frames[0], &other = first.rest_frames[0];
    const StoredLight light = inset_light(inset);
    return !world_.several_rest_frames() && own.E == 1 && other.E == 1 && !own.now && !other.now
        && own.motion_from_frame == other.motion_from_frame // the axes of both cube maps would be the same
        && (light == StoredLight::unshifted || light == world_.stored_light(first.shot.effects));
}

/// The least numbers that are exact for the inset. Where nothing moves, none of its light is shifted.
StoredLight EyeCubes::inset_light(const Observer& inset) const
{
    Effects on = inset.shot.effects;
    if (inset.E == 1 && !world_.several_rest_frames())
        on = on.without(Effect::doppler);
    return world_.stored_light(on);
}

void EyeCubes::keep_inset_eyes(std::size_t count)
{
    for (; inset_eyes_ > count; --inset_eyes_)
        all.pop_back(), plans.pop_back();
}

void EyeCubes::forget_insets()
{
    keep_inset_eyes(0);
    observers.resize(observers.size() - std::exchange(inset_observers_, 0));
}

StoredLight EyeCubes::light_of(std::size_t eye) const
{
    const Observer& observer = observers[all[eye].observer];
    return eye + inset_eyes_ >= all.size() ? inset_light(observer) : world_.stored_light(observer.shot.effects);
}

int EyeCubes::rays_of(const ViewState& view) const
{
    // A pixel of the inset is about four of the others', and they have about a texel each.
    constexpr int shared_rays = 2;
    const bool shared = view.observer != all[view.eye].observer;
    return shared ? std::max(state_.quality.pixel_rays, shared_rays) : state_.quality.pixel_rays;
}

std::size_t EyeCubes::eye_for(const ViewState& state)
{
    const View& view = state.geometry();
    const glm::dvec3 place = state.cube_m;
    const auto whose = std::find_if(
        observers.begin(), observers.end(), [&](const Observer& observer) { return observer.observer == view.observer; });
    const std::size_t own = std::size_t(whose - observers.begin());
    if (whose == observers.end())
        observers.push_back({view.observer});
    auto same
        = std::find_if(all.begin(), all.end(), [&](const EyeCube& e) { return e.place_m == place && e.observer == own; });
    if (same == all.end()) {
        all.push_back({place, own, CubePass(device_, pipelines_, world_, state_.quality, state_.keeps_depth), place});
        same = all.end() - 1;
        same->cube.repeatable(state_.repeatable);
    }
    same->now_m = place;
    return std::size_t(same - all.begin());
}

/// Collects the views that look into an eye's cube map, and the events at which it would be drawn.
void EyeCubes::request_views(std::size_t i, double pre_exposure, const Probe* probe)
{
    EyeCube& eye = all[i];
    const std::vector<RestFrameView>& rest_frames = observers[eye.observer].rest_frames;
    eye.requests.resize(rest_frames.size());
    const bool all_here = draws_all();
    eye.own_requests.resize(all_here ? 0 : rest_frames.size());
    eye.eye_events.clear();
    eye.nearest.clear();
    for (std::size_t at = 0; at < rest_frames.size(); ++at) {
        const RestFrameView& rest_frame = rest_frames[at];
        const EyeEvent eye_event = eye_event_of(rest_frame, int(at), views_.scene_units(eye.now_m));
        eye.nearest.push_back(state_.reprojects() ? std::max(nearest_box(world_.world, eye_event), 1e-30) : 1);
        RestFrameRequest& request = eye.requests[at];
        request.views.clear();
        std::vector<bool> here; // of the views in the request; empty where all are
        request.E = rest_frame.E;
        request.cube_from_motion = rest_frame.cube_from_motion;
        request.galilean = observers[eye.observer].shot.effects.comparison == Comparison::galilean;
        const auto add = [&](const ViewState& view, bool closer) {
            if (view.eye == i)
                request.views.push_back({view.compiled.cones.get(), observer_of(view).rest_frames[at].motion_from_cockpit,
                    state_.reprojects()
                        ? std::min(MOST_PARALLAX, glm::length(views_.eye_offset(view, rest_frame)) / eye.nearest[at])
                        : 0,
                    dark_D(view, pre_exposure), rays_of(view) / state_.quality.pixel_rays,
                    view.observer != eye.observer && !closer});
        };
        for (const ViewState& view : views_.all) {
            add(view, false);
            if (!all_here && view.eye == i)
                here.push_back(state_.is_here(state_.layout.outputs[view.output]));
        }
        // A request within the first view's would change nothing but the rounding of the plan.
        for (const std::unique_ptr<Inset>& inset : views_.insets)
            if (const bool closer = looks_closer(*inset);
                closer || inset_eyes_ > 0 || !ViewSet::shows_all_of(views_.probed_view(), inset->view))
                add(inset->view, closer);
        for (std::size_t ray = 0; probe && ray < probe->count(); ++ray)
            if (views_.probed_view(probe->ray(ray).view).eye == i)
                request.views.push_back({&probe->view(ray), rest_frame.motion_from_cockpit});
        if (at > 0)
            request.bounds = bounding_spheres(world_.world, eye_event);
        if (!all_here) {
            // Views of other machines leave; insets and probes stay, as each machine may show them.
            RestFrameRequest& own = eye.own_requests[at];
            own = request;
            std::size_t number = 0;
            std::erase_if(own.views, [&](const ViewRequest&) { return number < here.size() && !here[number++]; });
        }
        eye.eye_events.push_back(eye_event);
    }
}

bool EyeCubes::draws_all() const
{
    const std::vector<Output>& outputs = state_.layout.outputs;
    const auto shows_all = [&](const Output& output) { return output.preview && state_.is_here(output); };
    return state_.node.empty() || std::ranges::any_of(outputs, shows_all);
}

double EyeCubes::dark_D(const ViewState& view, double pre_exposure) const
{
    const Shot& shot = observer_of(view).shot;
    const Effects& on = shot.effects;
    // A body that stands out against the dark needs its exact edge.
    if (state_.all_light || !on[Effect::aberration] || on.comparison == Comparison::galilean || world_.several_rest_frames()
        || world_.globes) // the Sun's light is in no table of the cube map's
        return 0;
    // A fiftieth of the first of 255 steps, which dither never rounds up: by sRGB's curve, which is linear there, and by
    // any gamma up to 2.3.
    constexpr double least_srgb = 5e-6, least_gamma = 1e-9;
    // The greatest number that a cube map holds.
    constexpr double most_stored = 65504;
    const double exposure = std::exp2(shot.exposure_ev);
    return doppler_cutoff(world_.response(on).greatest, on[Effect::doppler], on[Effect::headlight],
        most_stored * exposure / pre_exposure, views_.finish_of(view) ? least_gamma : least_srgb);
}

/// True if an eye's cube map may be shown once more. It was drawn elsewhere and at another speed, but it must have the same
/// axes.
bool EyeCubes::can_reuse(std::size_t i) const
{
    const EyeCube& eye = all[i];
    if (eye.cube.light() != light_of(i))
        return false;
    for (std::size_t at = 0; at < eye.drawn.size(); ++at) {
        const EyeEvent &drawn = eye.drawn[at], &now = eye.eye_events[at];
        const glm::dmat3 turned = drawn.cube_from_frame - now.cube_from_frame;
        double most = 0;
        for (int axis = 0; axis < 3; ++axis)
            most = std::max(most, glm::length(turned[axis]));
        if (most > 1e-9 || drawn.now != now.now || drawn.contraction != now.contraction)
            return false;
    }
    return starbow::can_reuse(plans[i], eye.wanted);
}

void EyeCubes::bound(EyeCube& eye, const CubeMapPlan& plan) const
{
    eye.caps.assign(eye.requests.size(), {});
    eye.bodies.resize(eye.requests.size());
    if (state_.reprojects())
        return; // an eye beside sees the surfaces elsewhere
    for (std::size_t at = 0; at < eye.requests.size(); ++at)
        if (const RestFrameRequest& request = eye.requests[at]; request.bounds && !request.galilean)
            eye.caps[at] = bounding_cap(*request.bounds);
    for (const PlannedImage& image : plan.images) {
        constexpr double texels = 2;
        double& widest = eye.caps[std::size_t(image.rest_frame)].filter_rad;
        widest = std::max(widest, texels / image.texels_per_unit);
    }
    for (std::size_t at = 1; at < eye.requests.size(); ++at) {
        find_caps(eye.cube.list(), at, eye.bodies[at]);
        for (BoundingCap& cap : eye.bodies[at])
            cap.filter_rad = eye.caps[at].filter_rad;
    }
}

void EyeCubes::find_bodies(const ViewState& view, std::vector<ShipCap>& bodies) const
{
    bodies.clear();
    const EyeCube& eye = all[view.eye];
    if (!eye.cube.several_rest_frames())
        return;
    // An eye beside sees them elsewhere, and circles do not stay circles.
    if (state_.reprojects() || observer_of(view).shot.effects.comparison == Comparison::galilean)
        return bodies.push_back({{0, 0, 1}, -2});
    for (std::size_t at = 1; at < eye.bodies.size(); ++at)
        for (BoundingCap cap : eye.bodies[at]) {
            const RestFrameView& rest_frame = observer_of(view).rest_frames[at];
            cap.axis = glm::transpose(rest_frame.cube_from_motion) * cap.axis;
            const glm::dvec4 there = cap_in_ship(cap, rest_frame.E);
            bodies.push_back({glm::transpose(rest_frame.motion_from_cockpit) * glm::dvec3(there), there.w});
        }
    reserve_headroom(bodies);
}

void EyeCubes::plan(double pre_exposure, const Probe* probe)
{
    stars_.follow(eye_event_of(observers[0].rest_frames[0], 0, glm::dvec3(0)), state_.repeatable);
    bool keep = drawn_ && shown_ < state_.quality.frames_per_cube;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Trace::Span span(device_.trace, "plan");
        request_views(i, pre_exposure, probe);
        all[i].wanted = plan_cube_map(all[i].requests, state_.quality, scratch_, std::move(all[i].wanted));
        if (!all[i].own_requests.empty()) {
            all[i].own = plan_cube_map(all[i].own_requests, state_.quality, scratch_, std::move(all[i].own));
            mark_needed(all[i].wanted, all[i].own);
        }
        keep = keep && can_reuse(i);
    }
    shown_ = keep ? shown_ + 1 : 1;
    if (!keep) {
        drawn_ = false;
        state_.pre_exposure = pre_exposure;
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
        EyeCube& eye = all[i];
        if (!keep) {
            std::swap(plans[i], eye.wanted);
            eye.cube.pixel(pixel_of(i));
            eye.cube.prepare(plans[i], eye.eye_events, light_of(i), state_.pre_exposure);
            std::swap(eye.drawn, eye.eye_events);
            bound(eye, plans[i]);
        }
        if (!stars_.on())
            continue;
        const auto& images = plans[i].images;
        const auto own
            = std::find_if(images.begin(), images.end(), [](const PlannedImage& image) { return image.rest_frame > 0; });
        eye.stars = stars_in({images.begin(), own}, stars_.patches(), observers[eye.observer].rest_frames[0].cube_from_frame,
            std::move(eye.stars));
        if (stars_.globes().count > 0)
            eye.stars.push_back(stars_.globes());
    }
}

void EyeCubes::record(vk::CommandBuffer commands)
{
    if (drawn_)
        return;
    for (EyeCube& eye : all)
        eye.cube.record(commands);
    drawn_ = state_.quality.frames_per_cube > 1;
}

std::size_t EyeCubes::triangles() const
{
    std::size_t sum = 0;
    for (const EyeCube& eye : all)
        sum += eye.cube.triangles();
    return sum;
}

vk::DeviceSize EyeCubes::memory() const
{
    vk::DeviceSize bytes = 0;
    for (const EyeCube& eye : all)
        bytes += eye.cube.memory();
    return bytes;
}

} // namespace starbow
