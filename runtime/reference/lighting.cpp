#include "lighting.h"
#include "clock_face.h"
#include "config/json/hash.h"
#include "gloss.h"
#include "runtime/shadow/still_things.h"
#include "runtime/world/clock.h"
#include "runtime/world/moving.h"
#include "runtime/world/shadows.h"
#include "runtime/world/shape.h"
#include "runtime/world/worldline.h"
#include "shaders/physics/physics.h"
#include <cmath>

namespace starbow {
namespace {

const ExistenceInterval always{-for_ever, for_ever};

/// The retarded time of the middle of an instance's box.
double middle_sent(const World& world, const Instance& instance, const EyeEvent& eye_event)
{
    if (instance.motion >= 0)
        return seen_pose(world, instance, eye_event).sent;
    const Primitive& primitive = world.primitives[instance.primitive];
    const glm::dvec4 middle(0.5 * (primitive.low + primitive.high), 1);
    return retarded_time(
        eye_event, eye_event.cube_from_frame * (glm::dvec3(instance.frame_from_local * middle) - eye_event.place));
}

SurfaceAxes axes_at(const World& world, const SightHit& met)
{
    const Instance& instance = world.instances[met.instance];
    SurfaceAxes axes;
    if (instance.deformation >= 0) {
        Shape shape(world, instance, met.sent);
        for (int k = 0; k < 3; ++k) {
            const PlacedVertex vertex = shape.vertex(met.corners[k]);
            axes.normal += met.weights[k] * vertex.normal, axes.tangent += met.weights[k] * vertex.tangent;
            axes.sense = vertex.mirrored ? -1 : 1;
        }
    } else {
        const glm::dmat3 m(instance.motion >= 0 ? pose_at(world, instance, met.sent) : instance.frame_from_local);
        for (int k = 0; k < 3; ++k) {
            axes.normal += met.weights[k] * glm::dvec3(world.vertices[met.corners[k]].normal);
            if (!world.vertex_maps.empty())
                axes.tangent += met.weights[k] * glm::dvec3(world.vertex_maps[met.corners[k]].tangent);
        }
        axes.normal = glm::transpose(glm::inverse(m)) * axes.normal, axes.tangent = m * axes.tangent;
        axes.sense = glm::determinant(m) < 0 ? -1 : 1;
    }
    axes.normal = glm::normalize(axes.normal);
    return axes;
}

} // namespace

glm::dvec3 sky_gradient(const Sky& sky, double height)
{
    const double h = std::min(std::abs(height), 1.0), part = h * h * (3 - 2 * h);
    return glm::mix(sky.horizon, height > 0 ? sky.zenith : sky.nadir, part);
}

Lighting::Lighting(const World& world, const SceneFile& scene, const Pictures& pictures, Colours& colours,
    const EyeEvent& eye_event, const Occluders* occluders)
    : world_(world)
    , scene_(scene)
    , pictures_(pictures)
    , colours_(colours)
    , eye_event_(eye_event)
    , occluders_(eye_event.frame == 0 ? occluders : nullptr)
    , shadowed_(occluders_ ? lights_with_shadows(boxes_of(world), scene) : std::vector<bool>{})
{
    for (const Lamp& lamp : world.lamps) {
        const Light& light = scene.lights[lamp.light];
        Source source{&light, {}, {}, true, 0};
        std::visit([&](const auto& l) { source.radiance = l.radiance, source.kind.light = l.spectrum; }, light);
        if (lamp.frame != eye_event.frame) {
            if (const auto* far = std::get_if<DirectionalLight>(&light))
                aberrated(world.frames[std::size_t(eye_event.frame)].u, far->towards, source.kind.D);
            else
                source.same_D = false;
        }
        if (source.same_D)
            source.ready = colours.kind(source.kind);
        sources_.push_back(source);
    }
}

Lighting::LightSample Lighting::shine(std::size_t index, const glm::dvec3& place, double time) const
{
    const Lamp& lamp = world_.lamps[index];
    const RestFrame &here = world_.frames[std::size_t(eye_event_.frame)], &there = world_.frames[std::size_t(lamp.frame)];
    const bool moves = lamp.frame != eye_event_.frame;
    LightSample shine;
    if (const auto* far = std::get_if<DirectionalLight>(sources_[index].light)) {
        shine.towards = moves ? aberrated(here.u, far->towards, shine.D) : far->towards;
        shine.strength = shine.D; // a point's flux per frequency
        return shine;
    }
    const PointLight& point = std::get<PointLight>(*sources_[index].light);
    glm::dvec3 way = lamp.position - place;
    double own = time - glm::length(way); // the lamp's time when the light left
    double distance = glm::length(way); // in its own frame
    glm::dvec3 sent = -way, axis = point.cone ? point.cone->axis : glm::dvec3(0); // the light's way there
    if (moves) {
        // The event of its own time 0, and its motion, as the surface's frame has them.
        const Event zero_in_world{there.origin.time + physics::world_time(there.u, 0, lamp.position),
            there.origin.position + physics::world_place(there.u, 0, lamp.position)};
        const Event zero = in_frame(here, zero_in_world);
        const glm::dvec3 u = physics::relative(here.u, there.u).u;
        const double gamma = physics::gamma_of(u), speed = glm::length(u);
        const glm::dvec3 now = zero.position + u / gamma * (time - zero.time) - place;
        const physics::RetardedPosition seen = physics::retarded_position(now, u / speed, speed, gamma);
        shine.D = seen.D;
        way = seen.place;
        own = (time - zero.time) / gamma + seen.tau;
        distance = seen.delay / seen.D; // the light's way goes as its frequency does not
        sent = physics::world_place(-u, seen.delay, -way);
        axis = quaternion(physics::relative(here.u, there.u).turn) * axis;
    }
    const ExistenceInterval& existence
        = lamp.existence < 0 ? always : world_.existence_intervals[std::size_t(lamp.existence)];
    if (own < existence.begin || own > existence.end || distance == 0)
        return shine;
    shine.towards = way / glm::length(way);
    shine.strength = shine.D * (point.distance / distance) * (point.distance / distance);
    if (point.cone) {
        const double cosine = glm::dot(glm::normalize(sent), axis), outer = std::cos(point.cone->outer_rad);
        const double part = std::clamp((cosine - outer) / std::max(std::cos(point.cone->inner_rad) - outer, 1e-3), 0.0, 1.0);
        shine.strength *= part * part;
    }
    return shine;
}

glm::dvec3 Lighting::facet(const SightHit& met, const glm::dmat4& frame_from_local) const
{
    glm::dvec3 at[3];
    for (int k = 0; k < 3; ++k)
        at[k] = glm::dvec3(frame_from_local * glm::dvec4(glm::dvec3(world_.vertices[met.corners[k]].position), 1));
    const glm::dvec3 across = glm::cross(at[1] - at[0], at[2] - at[0]);
    return glm::normalize(glm::dot(across, met.way) > 0 ? -across : across);
}

double Lighting::ambient_part(const glm::dvec3& place, const glm::dvec3& facet, const glm::dvec3& normal) const
{
    constexpr int rays = 64;
    const LineAxes axes(normal);
    // Each place has its own turn of the same rays, so that a pixel's mean is that of all its places' rays.
    Hash hash;
    hash.add(&place, sizeof place);
    const double first = double(hash.value >> 11) * 0x1p-53 * 6.283185307179586;
    const glm::dvec3 from = place + 2e-6 * occluders_->extent() * facet;
    int open = 0;
    for (int i = 0; i < rays; ++i) {
        const double square = (i + 0.5) / rays, turn = first + 2.399963229728653 * i; // the golden angle
        const glm::dvec3 way
            = std::sqrt(square) * (std::cos(turn) * axes.x + std::sin(turn) * axes.y) + std::sqrt(1 - square) * normal;
        open += glm::dot(way, facet) > 0 && !occluders_->hidden(from, way, INFINITY);
    }
    return hidden_sky_part + (1 - hidden_sky_part) * open / rays;
}

bool Lighting::hidden(std::size_t index, const glm::dvec3& place, const glm::dvec3& facet, const glm::dvec3& towards) const
{
    const Lamp& lamp = world_.lamps[index];
    if (!occluders_ || lamp.frame != 0 || !shadowed_[lamp.light])
        return false;
    const double above = 2e-6 * occluders_->extent();
    double far = INFINITY;
    if (std::holds_alternative<PointLight>(scene_.lights[lamp.light]))
        far = std::max(glm::distance(lamp.position, place) - 2 * above, 0.0);
    return occluders_->hidden(place + above * facet, towards, far);
}

glm::dvec3 Lighting::around(const glm::dvec3& way) const
{
    return scene_.sky.has_colour() && eye_event_.frame == 0 ? sky_gradient(scene_.sky, way.y) : scene_.ambient;
}

glm::dvec3 Lighting::seen(const SightHit& met, double D) const
{
    const Instance& instance = world_.instances[met.instance];
    const int index = world_.primitives[instance.primitive].material;
    const Material& material = world_.materials[std::size_t(index)];
    const glm::dvec4 coloured = base_of(world_, pictures_, met);
    glm::dvec3 base(coloured);
    glm::dvec3 emitted(material.emissive);
    if (material.emissive_texture >= 0)
        emitted *= glm::dvec3(pictures_.at(material.emissive_texture, uv_of(world_, met)));
    const double own_s = (met.sent - zero_of(world_, instance)) * world_.seconds_per_time_unit;
    if (material.clock) {
        const glm::dvec2 uv = uv_of(world_, met);
        const double middle_s
            = (middle_sent(world_, instance, eye_event_) - zero_of(world_, instance)) * world_.seconds_per_time_unit;
        const double ink
            = mark({2 * uv.x - 1, 1 - 2 * uv.y}, own_s - material.clock->zero_s, figures(middle_s - material.clock->zero_s));
        base *= 1 - ink;
        emitted *= ink;
    }
    if (material.blink) {
        const double periods = (own_s - material.blink->zero_s) / material.blink->period_s;
        if (periods - std::floor(periods) >= material.blink->on)
            emitted = glm::dvec3(0);
    }
    const glm::dvec3 sent = colours_.sent(index, emitted, D);
    if (material.unlit)
        return sent + colours_.lit(index, Colours::sunlight, base, glm::dvec3(1), D);

    const SurfaceAxes axes = axes_at(world_, met);
    glm::dvec3 normal = axes.normal * (met.front ? 1.0 : -1.0);
    const glm::dvec3 place = eye_event_.place + met.place;
    const bool shaded = occluders_ && instance.motion < 0;
    const glm::dvec3 side = shaded ? facet(met, instance.frame_from_local) : normal;
    const double daylight = shaded ? ambient_part(place, side, normal) : 1;
    std::optional<GlossyHit> gloss;
    glm::dvec3 all = sent;
    if (material.gloss) {
        gloss.emplace(world_, pictures_, met, axes, normal);
        normal = gloss->normal();
        const GlossyHit::Colours light
            = gloss->of_surroundings(scene_.ambient, [&](const glm::dvec3& way) { return around(way); });
        all += colours_.lit(index, Colours::sunlight, base, daylight * light.by_base, D)
            + colours_.lit(-1, Colours::sunlight, glm::dvec3(1), daylight * light.white, D);
    } else
        all += colours_.lit(index, Colours::sunlight, base, daylight * scene_.ambient, D);
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        const LightSample light = shine(i, place, met.sent);
        const double facing = glm::dot(normal, light.towards);
        if (light.strength == 0 || !(facing > 0) || (shaded && hidden(i, place, side, light.towards)))
            continue;
        const GlossyHit::Parts parts = gloss ? gloss->of_lamp(light.towards) : GlossyHit::Parts{facing, 0};
        const Source& source = sources_[i];
        const auto lit = [&](int material, const glm::dvec3& colour, double part) {
            const glm::dvec3 falling = source.radiance * (light.strength * part);
            return source.same_D ? colours_.lit(material, source.ready, colour, falling, D)
                                 : colours_.lit(material, Colours::Kind{source.kind.light, light.D}, colour, falling, D);
        };
        all += lit(index, base, parts.by_base);
        if (parts.white > 0)
            all += lit(-1, glm::dvec3(1), parts.white);
    }
    return all;
}

} // namespace starbow
