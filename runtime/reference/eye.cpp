#include "eye.h"
#include "config/model/angles.h"
#include "runtime/world/stars.h"
#include <algorithm>
#include <cmath>

namespace starbow {

TracingEye::TracingEye(const World& world, const SceneFile& scene, const Pictures& pictures, Colours& colours,
    const GlobeColours* globes, const Occluders* occluders, const Observer& observer, const glm::dvec3& place, double beside,
    double pixel_rad)
    : world_(world)
    , scene_(scene)
    , pictures_(pictures)
    , colours_(colours)
    , observer_(observer)
    , place_(place)
    , pixel_rad_(pixel_rad)
    , globe_colours_(globes)
{
    if (scene.stars)
        equatorial_from_world_ = glm::transpose(world_from_equatorial(scene.stars->ahead_deg));
    for (std::size_t i = 0; i < observer_.rest_frames.size(); ++i) {
        const RestFrameView& rest_frame = observer_.rest_frames[i];
        const EyeEvent eye_event = eye_event_of(rest_frame, int(i), place);
        // A distance beside the eye in the ship is longer in the frame.
        const double reach = beside * physics::gamma_of(rest_frame.shot.u);
        views_.push_back({&rest_frame, Tracer(world, pictures, eye_event, reach, pixel_rad),
            Lighting(world, scene, pictures, colours, eye_event, occluders)});
    }
    if (globes) {
        const RestFrameView& rest_frame = observer_.rest_frames.front();
        const EyeEvent ship = eye_event_of(rest_frame, 0, glm::dvec3(0));
        const glm::dvec3& u = rest_frame.shot.u;
        const WorldOrigin origin = world_origin(world.globes->system, *scene.globes);
        const EyeAmongGlobes event{ship.place, ship.time,
            world_from_equatorial(scene.stars ? scene.stars->ahead_deg : glm::dvec2(0)), scene.unit_m,
            world.seconds_per_time_unit, rest_frame.now, u / physics::gamma_of(u)};
        const SolarSystem& system = world.globes->system;
        farthest_among_globes_ = farthest_eye(system, globes_seen(system, origin, event), scene.unit_m);
        globes_ = std::make_unique<GlobeSight>(*world.globes, origin, *globes, event);
    }
}

std::size_t TracingEye::triangles() const
{
    std::size_t all = 0;
    for (const EyeInRestFrame& view : views_)
        all += view.tracer.triangles();
    return all;
}

/// The direction in a frame for a direction in the ship, motion axes.
physics::AberratedRay TracingEye::sight(const glm::dvec3& n, double E) const
{
    return observer_.shot.effects.comparison == Comparison::galilean ? physics::galilean_world_from_camera(n, E, 1 / E)
                                                                     : physics::world_from_camera(n, E, 1 / E);
}

TracingEye::Nearest TracingEye::nearest(
    const glm::dvec3& way, const glm::dvec3& beside, const physics::AberratedRay& world, double after) const
{
    // Without aberration, directions are the world's, and moving things are seen as from there; the ship's D comes on top.
    const bool aberration = observer_.shot.effects[Effect::aberration];
    const double D_beside = aberration ? 1 : world.D;
    Nearest found;
    for (const EyeInRestFrame& view : views_) {
        if (view.tracer.triangles() == 0)
            continue;
        const RestFrameView& rest_frame = *view.rest_frame;
        const glm::dvec3 n = glm::normalize(rest_frame.motion_from_cockpit * way);
        physics::AberratedRay own = sight(n, rest_frame.E);
        const bool worlds = view.tracer.eye_event().frame == 0;
        if (worlds)
            own = world;
        glm::dvec3 stretched = own.n;
        stretched.z /= rest_frame.contraction;
        const double stretch = glm::length(stretched);
        const glm::dvec3 apart = rest_frame.shot.ship_from_cockpit * beside;
        SightLine line{glm::dvec3(0), glm::transpose(rest_frame.motion_from_frame) * (stretched / stretch),
            view.tracer.eye_event().time, pixel_rad_ * (worlds && !aberration ? 1 : own.D)};
        if (beside != glm::dvec3(0)) {
            line.from = physics::eye_place(rest_frame.shot.u, apart);
            line.time += physics::eye_time(rest_frame.shot.u, apart);
        }
        const double per_distance = (worlds && !aberration ? 1 : own.D) / stretch;
        const auto met = view.tracer.nearest(line, after / per_distance * (1 + 1e-9));
        if (!met)
            continue;
        const double D = worlds ? world.D : own.D * D_beside;
        const double in_ship = per_distance * met->distance;
        if (in_ship < found.way)
            found = {&view, *met, D, in_ship};
    }
    return found;
}

TracingEye::BlendedPath TracingEye::along(
    const glm::dvec3& way, const glm::dvec3& beside, const physics::AberratedRay& world, bool lights) const
{
    const Effects& effects = observer_.shot.effects;
    BlendedPath out;
    double after = 0;
    while (out.left > 1e-6) {
        const Nearest found = nearest(way, beside, world, after);
        const Instance* instance = found.view ? &world_.instances[found.met.instance] : nullptr;
        if (!instance || !world_.materials[std::size_t(world_.primitives[instance->primitive].material)].blended) {
            out.solid = found;
            return out;
        }
        const double alpha = std::clamp(base_of(world_, pictures_, found.met).a, 0.0, 1.0);
        if (lights && alpha > 0)
            out.light += out.left * alpha * (effects[Effect::headlight] ? found.D * found.D * found.D : 1)
                * found.view->lighting.seen(found.met, effects[Effect::doppler] ? found.D : 1);
        out.left *= 1 - alpha;
        after = found.way;
    }
    return out;
}

/// The colour of the sky at rest, in a unit direction of the world.
glm::dvec3 TracingEye::sky(const glm::dvec3& n) const
{
    glm::dvec3 colour = sky_gradient(scene_.sky, n.y);
    if (world_.milky_way >= 0) {
        const glm::dvec3 there = equatorial_from_world_ * n;
        const double right_ascension = std::atan2(there.y, there.x),
                     declination = std::atan2(there.z, std::hypot(there.x, there.y));
        const glm::dvec2 at(right_ascension / (2 * pi), 0.5 - declination / pi);
        colour += scene_.milky_way() * glm::dvec3(pictures_.at(world_.milky_way, at));
    }
    return colour;
}

/// The direction in the world, motion axes, for one of the cockpit.
physics::AberratedRay TracingEye::world_ray(const glm::dvec3& way) const
{
    const glm::dvec3 n = glm::normalize(observer_.rest_frames.front().motion_from_cockpit * way);
    physics::AberratedRay world = sight(n, observer_.E);
    if (!observer_.shot.effects[Effect::aberration])
        world.n = n;
    return world;
}

glm::dvec3 TracingEye::among_globes_m(const glm::dvec3& beside) const
{
    const RestFrameView& rest_frame = observer_.rest_frames.front();
    glm::dvec3 place = place_ + beside;
    if (const double away = glm::length(place); away > farthest_among_globes_)
        place *= farthest_among_globes_ / away;
    if (place == glm::dvec3(0))
        return place;
    return physics::eye_place(rest_frame.shot.u, rest_frame.shot.ship_from_cockpit * place) * scene_.unit_m;
}

GlobeSight::Ray TracingEye::among_globes(const physics::AberratedRay& world, const glm::dvec3& beside,
    std::span<const double> parts, int only, double pixel_rad, double* stretch) const
{
    const RestFrameView& rest_frame = observer_.rest_frames.front();
    glm::dvec3 stretched = world.n;
    stretched.z /= rest_frame.contraction;
    const double length = glm::length(stretched);
    if (stretch)
        *stretch = length;
    const double there_rad = pixel_rad * (observer_.shot.effects[Effect::aberration] ? world.D : 1);
    return globes_->ray(
        among_globes_m(beside), glm::transpose(rest_frame.motion_from_frame) * (stretched / length), there_rad, parts, only);
}

LookedAt TracingEye::look(
    const glm::dvec3& way, const glm::dvec3& beside, std::span<const double> parts, double pixel_rad) const
{
    const Effects& effects = observer_.shot.effects;
    const RestFrameView& rest_frame = observer_.rest_frames.front();
    const physics::AberratedRay world = world_ray(way);
    LookedAt out;
    out.world = glm::transpose(rest_frame.motion_from_frame) * world.n;
    out.D = world.D;
    out.distance = INFINITY;
    const BlendedPath ray = along(way, beside, world, true);
    const Nearest& found = ray.solid;
    if (found.view) {
        out.D = found.D;
        out.distance = found.way / (effects[Effect::aberration] ? world.D : 1);
    }
    GlobeSight::Ray globes;
    bool before = false; // a globe stands before the nearest triangle
    if (globes_) {
        double stretch = 1;
        globes = among_globes(world, beside, parts, -1, pixel_rad > 0 ? pixel_rad : pixel_rad_, &stretch);
        const double distance = globes.distance_m / scene_.unit_m;
        before = !found.view || distance < found.met.distance;
        if (before && std::isfinite(distance))
            out.D = world.D, out.distance = distance / stretch;
    }
    const double shift = effects[Effect::doppler] ? out.D : 1;
    if (before) {
        out.light = globe_colours_->seen(globes.terms, shift);
        out.sun = globe_colours_->seen(globes.sun, shift);
        if (globes.through > 0)
            out.light += globes.through
                * (found.view ? found.view->lighting.seen(found.met, effects[Effect::doppler] ? found.D : 1)
                              : colours_.sky(sky(out.world), shift));
    } else if (found.view) {
        out.light = found.view->lighting.seen(found.met, shift);
    } else {
        out.light = colours_.sky(sky(out.world), shift);
    }
    if (effects[Effect::headlight]) {
        out.light *= out.D * out.D * out.D;
        out.sun *= out.D * out.D * out.D;
    }
    out.light = ray.light + ray.left * out.light;
    out.sun *= ray.left;
    return out;
}

double TracingEye::part_left(
    const glm::dvec3& way, double distance, const glm::dvec3& beside, std::span<const double> parts) const
{
    const physics::AberratedRay world = world_ray(way);
    const BlendedPath ray = along(way, beside, world, false);
    if (ray.solid.view && ray.solid.met.distance < distance)
        return 0;
    return ray.left * (globes_ ? among_globes(world, beside, parts, -1, INFINITY).through : 1);
}

glm::dvec3 TracingEye::globe_light(std::size_t body, const glm::dvec3& way, const glm::dvec3& beside) const
{
    const Effects& effects = observer_.shot.effects;
    const physics::AberratedRay world = world_ray(way);
    const BlendedPath along_ray = along(way, beside, world, false);
    if (along_ray.solid.view)
        return glm::dvec3(0);
    const GlobeSight::Ray ray = among_globes(world, beside, {}, int(body), INFINITY); // one spot has no detail
    const glm::dvec3 light = along_ray.left * globe_colours_->seen(ray.terms, effects[Effect::doppler] ? world.D : 1);
    return effects[Effect::headlight] ? light * (world.D * world.D * world.D) : light;
}

glm::dvec3 TracingEye::towards(const glm::dvec3& from_eye) const
{
    const RestFrameView& rest_frame = observer_.rest_frames.front();
    glm::dvec3 way = rest_frame.motion_from_frame * from_eye;
    way.z *= rest_frame.contraction;
    return from_world(glm::normalize(glm::transpose(rest_frame.motion_from_frame) * way)).n;
}

physics::AberratedRay TracingEye::from_world(const glm::dvec3& towards) const
{
    const Effects& effects = observer_.shot.effects;
    const RestFrameView& rest_frame = observer_.rest_frames.front();
    const glm::dvec3 n = rest_frame.motion_from_frame * towards;
    const double E = observer_.E;
    physics::AberratedRay seen{n, 1};
    if (!effects[Effect::aberration])
        seen.D = sight(n, E).D;
    else if (effects.comparison == Comparison::galilean)
        seen = physics::galilean_camera_from_world(n, E, 1 / E);
    else
        seen = physics::camera_from_world(n, E, 1 / E);
    seen.n = glm::transpose(rest_frame.motion_from_cockpit) * seen.n;
    return seen;
}

double TracingEye::solid_angle(const physics::AberratedRay& seen) const
{
    const Effects& effects = observer_.shot.effects;
    if (!effects[Effect::aberration])
        return 1;
    if (effects.comparison != Comparison::galilean)
        return 1 / (seen.D * seen.D);
    // The area of a small square of directions in the world, by differences.
    constexpr double step = 1e-5;
    const glm::dvec3 n = observer_.rest_frames.front().motion_from_cockpit * seen.n;
    const glm::dvec3 right = glm::normalize(glm::cross(n, std::abs(n.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const auto change = [&](const glm::dvec3& side) {
        return (sight(glm::normalize(n + step * side), observer_.E).n
                   - sight(glm::normalize(n - step * side), observer_.E).n)
            / (2 * step);
    };
    return 1 / glm::length(glm::cross(change(right), change(glm::cross(n, right))));
}

} // namespace starbow
