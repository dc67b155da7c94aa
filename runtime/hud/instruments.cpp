#include "instruments.h"
#include "config/model/angles.h"
#include "runtime/world/clock.h"
#include "runtime/world/eye_event.h"
#include "runtime/world/instances.h"
#include "runtime/world/moving.h"
#include "runtime/world/worldline.h"
#include "shaders/physics/physics.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

double exp_rapidity_of(const MeasuringObserver& observer) { return physics::exp_rapidity(glm::length(observer.u)); }

const WorldClock* clock_of(const World& world, std::size_t instance)
{
    const auto& clock = world.materials[std::size_t(world.primitives[world.instances[instance].primitive].material)].clock;
    return clock ? &*clock : nullptr;
}

bool exists(const World& world, const Instance& instance, double time)
{
    if (instance.existence < 0)
        return true;
    const ExistenceInterval& existence = world.existence_intervals[std::size_t(instance.existence)];
    return time >= existence.begin && time < existence.end;
}

/// The clock of a rest frame on whose dial, or beside it by a quarter of its radius, a place lies at a time of the frame.
/// A body has a clock for each part of its worldline, and in one frame several may lie at one place at different times.
std::optional<std::size_t> clock_near(const World& world, int frame, const glm::dvec3& at, double time)
{
    std::optional<std::size_t> found;
    double nearest = 0.25;
    const InstanceRange range = instances_of(world, frame);
    for (std::size_t i = range.first; i < range.last && timed(world, world.instances[i]); ++i) {
        const Instance& instance = world.instances[i];
        if (!clock_of(world, i) || !exists(world, instance, time))
            continue;
        const Primitive& primitive = world.primitives[instance.primitive];
        const glm::dmat4 frame_from_local = instance.motion < 0 ? instance.frame_from_local : pose_at(world, instance, time);
        const glm::dvec3 local(glm::inverse(frame_from_local) * glm::dvec4(at, 1));
        const glm::dvec3 beside = local - glm::clamp(local, primitive.low, primitive.high);
        // Both lengths in the frame, where the dial may be stretched.
        const glm::dmat3 turn(frame_from_local);
        const double radius
            = primitive.radius * std::max({glm::length(turn[0]), glm::length(turn[1]), glm::length(turn[2])});
        if (const double off = glm::length(turn * beside) / radius; off <= nearest)
            found = i, nearest = off;
    }
    return found;
}

bool is_galilean(const MeasuringObserver& observer) { return observer.comparison == Comparison::galilean; }
bool shows_now(const MeasuringObserver& observer) { return observer.comparison == Comparison::no_light_delay; }

/// The observer in a rest frame's coordinates, and the rotation from the axes carried by the world's boost to the axes
/// carried by that frame's boost.
struct ObserverInFrame {
    MeasuringObserver observer;
    glm::dquat turn{1, 0, 0, 0};
};
ObserverInFrame in_frame_of(const MeasuringObserver& observer, const World& world, int frame)
{
    const RestFrame& rest = world.frames[std::size_t(frame)];
    if (rest == RestFrame{})
        return {observer};
    Shot shot;
    shot.time = observer.time, shot.position = observer.place, shot.u = observer.u;
    const Shot there = in_frame(rest, shot); // its cockpit then holds the rotation
    const glm::dquat& turn = there.ship_from_cockpit;
    return {
        {there.position, there.time, there.u, turn * observer.ship_from_cockpit, observer.aberration, observer.comparison},
        turn};
}

/// The observer by whose aberration the picture shows a rest frame. Without aberration moving things are shown as from rest
/// in the world.
ObserverInFrame looking_from(const MeasuringObserver& observer, const World& world, int frame)
{
    if (observer.aberration || frame == 0)
        return in_frame_of(observer, world, frame);
    MeasuringObserver still = observer;
    still.u = glm::dvec3(0);
    ObserverInFrame there = in_frame_of(still, world, frame);
    there.observer.aberration = true;
    return there;
}

/// The factor of the ship's own shift, where looking_from's observer does not have it.
double D_beside(const MeasuringObserver& observer, int frame, const glm::dvec3& ship)
{
    return observer.aberration || frame == 0 ? 1 : ray_from_ship(observer, ship).D;
}

/// An event of a rest frame that the picture shows: its place and time there, and its place from the eye. Of light's way the
/// last is in that frame; without light delay it is in the ship, at the ship's present.
struct ShownEvent {
    glm::dvec3 at{0};
    double eye_time = 0, delay = 0; ///< the event's time is eye_time - delay
    double way = 0; ///< length
};
/// The event that the picture shows at a resting place of a frame.
ShownEvent event_at(const MeasuringObserver& there, const glm::dvec3& at)
{
    const glm::dvec3 to = at - there.place;
    if (!shows_now(there)) {
        const double way = glm::length(to);
        return {at, there.time, way, way};
    }
    // Contracted along the motion, by 1 / gamma; eye_place is the inverse.
    const double gamma = physics::gamma_of(there.u);
    const glm::dvec3 in_ship = to - there.u * (glm::dot(there.u, to) / (gamma * (1 + gamma)));
    return {at, there.time + physics::eye_time(there.u, in_ship), 0, glm::length(in_ship)};
}

/// The reading of the clock at a spot at the event that is shown there. nullopt: no clock is there then, or not yet, or no
/// longer.
std::optional<double> clock_reading(
    const World& world, const Spot& spot, const ShownEvent& event, double seconds_per_time_unit)
{
    const auto instance = clock_near(world, spot.frame, spot.at, event.eye_time - event.delay);
    if (!instance)
        return {};
    const int existence = world.instances[*instance].existence;
    const double zero = existence < 0 ? 0 : world.existence_intervals[std::size_t(existence)].zero;
    return reading_s(*clock_of(world, *instance), event.eye_time - zero, event.delay, seconds_per_time_unit);
}

/// A spot's retarded position in the ship's frame, from the observer. The 4-vector (-r, r n) of the light's way is
/// lengthened as its frequency is: r becomes D r.
glm::dvec3 left_from(const SpotReading& reading) { return *reading.ship_distance_s * reading.ray.ship; }

} // namespace

MeasuringObserver measuring_observer_of(const Shot& shot, const glm::dvec3& offset)
{
    return {shot.position + physics::eye_place(shot.u, offset), shot.time + physics::eye_time(shot.u, offset), shot.u,
        shot.ship_from_cockpit, shot.effects[Effect::aberration] || shot.effects.comparison == Comparison::no_light_delay,
        shot.effects.comparison};
}

Ray ray_from_ship(const MeasuringObserver& observer, const glm::dvec3& ship)
{
    if (shows_now(observer))
        return {ship, glm::normalize(physics::eye_place(observer.u, ship)), 1};
    const glm::dmat3 to_motion = motion_from_world(observer.u, observer.ship_from_cockpit);
    const double E = exp_rapidity_of(observer);
    const physics::AberratedRay sight = is_galilean(observer)
        ? physics::galilean_world_from_camera(to_motion * ship, E, 1 / E)
        : physics::world_from_camera(to_motion * ship, E, 1 / E);
    return {ship, observer.aberration ? glm::transpose(to_motion) * sight.n : ship, sight.D};
}

Ray ray_from_world(const MeasuringObserver& observer, const glm::dvec3& world)
{
    if (shows_now(observer)) {
        const double gamma = physics::gamma_of(observer.u);
        return {glm::normalize(world - observer.u * (glm::dot(observer.u, world) / (gamma * (1 + gamma)))), world, 1};
    }
    if (!observer.aberration) // the picture shows the world's direction, with the shift of the ship's direction
        return ray_from_ship(observer, world);
    const glm::dmat3 to_motion = motion_from_world(observer.u, observer.ship_from_cockpit);
    const double E = exp_rapidity_of(observer);
    const physics::AberratedRay sight = is_galilean(observer)
        ? physics::galilean_camera_from_world(to_motion * world, E, 1 / E)
        : physics::camera_from_world(to_motion * world, E, 1 / E);
    return {glm::transpose(to_motion) * sight.n, world, sight.D};
}

Ray aim_of(const MeasuringObserver& observer)
{
    return ray_from_ship(observer, observer.ship_from_cockpit * glm::dvec3(0, 0, -1));
}

Spot spot_at(const MeasuringObserver& observer, const Probed& probed, const World& world)
{
    if (!std::isfinite(probed.distance)) // the sky is infinitely far: nothing of it is contracted
        return {.at = shows_now(observer) ? probed.ray.ship : probed.ray.world, .sky = true};
    Spot spot{.frame = probed.frame};
    const ObserverInFrame there = looking_from(observer, world, probed.frame);
    const glm::dvec3 ship = there.turn * probed.ray.ship;
    if (shows_now(observer)) {
        spot.at = there.observer.place + physics::eye_place(there.observer.u, probed.distance * ship);
    } else if (probed.frame == 0) {
        spot.at = observer.place + probed.distance * probed.ray.world;
    } else {
        const Ray ray = ray_from_ship(there.observer, ship);
        // The light's travel distance transforms like its frequency: in the ship it is D times that in any other frame.
        const double way = probed.distance * (observer.aberration ? ray_from_ship(observer, probed.ray.ship).D : 1);
        spot.at = there.observer.place + way / ray.D * ray.world;
    }
    const ShownEvent event = event_at(there.observer, spot.at);
    spot.clock = clock_near(world, spot.frame, spot.at, event.eye_time - event.delay);
    return spot;
}

Spot snapped(Spot spot, const World& world)
{
    if (!spot.clock || world.instances[*spot.clock].motion >= 0)
        return spot;
    const Instance& instance = world.instances[*spot.clock];
    const Primitive& primitive = world.primitives[instance.primitive];
    spot.at = glm::dvec3(instance.frame_from_local * glm::dvec4(0.5 * (primitive.low + primitive.high), 1));
    return spot;
}

Ray ray_to(const MeasuringObserver& observer, const Spot& spot, const World& world)
{
    if (spot.sky && shows_now(observer))
        return {spot.at, spot.at, 1};
    const int frame = spot.sky ? 0 : spot.frame;
    const ObserverInFrame there = looking_from(observer, world, frame);
    const glm::dvec3 to = spot.sky ? spot.at : spot.at - there.observer.place;
    Ray ray = ray_from_world(there.observer, glm::length(to) > 0 ? glm::normalize(to) : glm::dvec3(0, 0, -1));
    if (frame > 0) {
        ray.ship = glm::conjugate(there.turn) * ray.ship;
        ray.world = ray_from_ship(observer, ray.ship).world;
        ray.D *= D_beside(observer, frame, ray.ship);
    }
    return ray;
}

SpotReading read_spot(const MeasuringObserver& observer, const Spot& spot, const World& world, double seconds_per_time_unit)
{
    SpotReading reading{.ray = ray_to(observer, spot, world)};
    reading.seen_nm = example_nm / reading.ray.D;
    if (observer.u != glm::dvec3(0)) {
        reading.from_motion_rad = angle_between(reading.ray.ship, observer.u);
        reading.from_motion_world_rad = angle_between(reading.ray.world, observer.u);
    }
    const ObserverInFrame relative = in_frame_of(observer, world, spot.sky ? 0 : spot.frame);
    reading.relative_u = glm::length(relative.observer.u);
    if (reading.relative_u > 0)
        reading.from_relative_motion_rad = angle_between(relative.turn * reading.ray.ship, relative.observer.u);
    if (spot.sky)
        return reading;
    const MeasuringObserver there = looking_from(observer, world, spot.frame).observer;
    const ShownEvent event = event_at(there, spot.at);
    if (shows_now(observer)) {
        reading.ship_distance_s = reading.distance_s = event.way * seconds_per_time_unit;
        // The ship's present is one plane of events for all frames.
        reading.emitted_s
            = (observer.time + event.way * physics::eye_time(observer.u, reading.ray.ship)) * seconds_per_time_unit;
    } else {
        // Light's way is a null vector. Its length changes from the spot's frame to the world as the frequency would for an
        // observer at rest in the world.
        const MeasuringObserver world_there{.u = -world.frames[std::size_t(spot.frame)].u};
        const glm::dvec3 towards = spot.at - there.place;
        const double in_world = event.way > 0 ? event.way * ray_from_world(world_there, towards / event.way).D : 0;
        reading.distance_s = in_world * seconds_per_time_unit;
        reading.emitted_s = observer.time * seconds_per_time_unit - *reading.distance_s;
        if (!is_galilean(observer))
            reading.ship_distance_s = reading.ray.D * event.way * seconds_per_time_unit;
    }
    if (spot.clock)
        reading.clock_s = clock_reading(world, spot, event, seconds_per_time_unit);
    return reading;
}

PairReading read_pair(const MeasuringObserver& observer, const Spot& first, const Spot& second, const World& world,
    double seconds_per_time_unit)
{
    const SpotReading a = read_spot(observer, first, world, seconds_per_time_unit),
                      b = read_spot(observer, second, world, seconds_per_time_unit);
    PairReading pair{.angle_rad = angle_between(a.ray.ship, b.ray.ship)};
    if (a.ship_distance_s && b.ship_distance_s && observer.aberration)
        pair.apparent_s = glm::distance(left_from(a), left_from(b));
    if (!first.sky && !second.sky && first.frame == second.frame)
        pair.rest_s = glm::distance(first.at, second.at) * seconds_per_time_unit;
    if (pair.rest_s) {
        const glm::dvec3 apart = second.at - first.at, u = in_frame_of(observer, world, first.frame).observer.u;
        pair.relative_u = glm::length(u);
        if (*pair.relative_u > 0 && glm::length(apart) > 0) {
            const double angle = angle_between(apart, u);
            pair.from_motion_at_rest_rad = std::min(angle, glm::pi<double>() - angle);
        }
    }
    if (pair.rest_s && !is_galilean(observer)) {
        // Only the component along the motion is contracted, by 1 / gamma.
        const glm::dvec3 apart = (second.at - first.at) * seconds_per_time_unit,
                         u = in_frame_of(observer, world, first.frame).observer.u;
        const double gamma = physics::gamma_of(u);
        pair.contracted_s = glm::length(apart - u * (glm::dot(u, apart) / (gamma * (1 + gamma))));
    }
    if (a.clock_s && b.clock_s)
        pair.clocks_s = *b.clock_s - *a.clock_s;
    return pair;
}

std::optional<double> unshifted_angle(const MeasuringObserver& observer)
{
    if (observer.u == glm::dvec3(0) || shows_now(observer))
        return {};
    if (is_galilean(observer)) // abeam in the world
        return std::atan2(1.0, glm::length(observer.u) / physics::gamma_of(observer.u));
    return std::acos(physics::unshifted_cosine(exp_rapidity_of(observer)));
}

} // namespace starbow
