#include "instruments.h"
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

/// The observer in a rest frame's coordinates, and the rotation from the axes carried by the world's boost to the axes
/// carried by that frame's boost.
struct There {
    MeasuringObserver observer;
    glm::dquat turn{1, 0, 0, 0};
};
There in_frame_of(const MeasuringObserver& observer, const World& world, int frame)
{
    const RestFrame& rest = world.frames[std::size_t(frame)];
    if (rest == RestFrame{})
        return {observer};
    Shot shot;
    shot.time = observer.time, shot.position = observer.place, shot.u = observer.u;
    const Shot there = in_frame(rest, shot); // its cockpit then holds the rotation
    const glm::dquat& turn = there.ship_from_cockpit;
    return {{there.position, there.time, there.u, turn * observer.ship_from_cockpit, observer.aberration}, turn};
}

/// The seen reading of the clock at a spot: of the one that is there when its light leaves. time: the eye's, in the spot's
/// rest frame; distance: from there to the spot. nullopt: no clock is there then, or not yet, or no longer.
std::optional<double> clock_reading(
    const World& world, const Spot& spot, double time, double distance, double seconds_per_time_unit)
{
    const auto instance = clock_near(world, spot.frame, spot.at, time - distance);
    if (!instance)
        return {};
    const int existence = world.instances[*instance].existence;
    const double zero = existence < 0 ? 0 : world.existence_intervals[std::size_t(existence)].zero;
    return reading_s(*clock_of(world, *instance), time - zero, distance, seconds_per_time_unit);
}

/// A spot's retarded position in the ship's frame, from the observer. The 4-vector (-r, r n) of the light's way is
/// lengthened as its frequency is: r becomes D r.
glm::dvec3 left_from(const SpotReading& reading) { return *reading.ship_distance_s * reading.ray.ship; }

} // namespace

MeasuringObserver measuring_observer_of(const Shot& shot, const glm::dvec3& offset)
{
    return {shot.position + physics::eye_place(shot.u, offset), shot.time + physics::eye_time(shot.u, offset), shot.u,
        shot.ship_from_cockpit, shot.effects.aberration};
}

Ray ray_from_ship(const MeasuringObserver& observer, const glm::dvec3& ship)
{
    const glm::dmat3 to_motion = motion_from_world(observer.u, observer.ship_from_cockpit);
    const double E = exp_rapidity_of(observer);
    const physics::AberratedRay sight = physics::world_from_camera(to_motion * ship, E, 1 / E);
    return {ship, observer.aberration ? glm::transpose(to_motion) * sight.n : ship, sight.D};
}

Ray ray_from_world(const MeasuringObserver& observer, const glm::dvec3& world)
{
    if (!observer.aberration) // the picture shows the world's direction, with the shift of the ship's direction
        return ray_from_ship(observer, world);
    const glm::dmat3 to_motion = motion_from_world(observer.u, observer.ship_from_cockpit);
    const double E = exp_rapidity_of(observer);
    const physics::AberratedRay sight = physics::camera_from_world(to_motion * world, E, 1 / E);
    return {glm::transpose(to_motion) * sight.n, world, sight.D};
}

Ray aim_of(const MeasuringObserver& observer)
{
    return ray_from_ship(observer, observer.ship_from_cockpit * glm::dvec3(0, 0, -1));
}

Spot spot_at(const MeasuringObserver& observer, const Probed& probed, const World& world)
{
    if (!std::isfinite(probed.distance))
        return {.at = probed.ray.world, .sky = true};
    Spot spot{.at = observer.place + probed.distance * probed.ray.world, .frame = probed.frame};
    double left = observer.time - probed.distance;
    if (probed.frame > 0) {
        const There there = in_frame_of(observer, world, probed.frame);
        const Ray ray = ray_from_ship(there.observer, there.turn * probed.ray.ship);
        // The light's travel distance transforms like its frequency: in the ship it is D times that in any other frame.
        const double way = probed.distance * ray_from_ship(observer, probed.ray.ship).D;
        spot.at = there.observer.place + way / ray.D * ray.world;
        left = there.observer.time - way / ray.D;
    }
    spot.clock = clock_near(world, spot.frame, spot.at, left);
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
    const There there = in_frame_of(observer, world, spot.sky ? 0 : spot.frame);
    const glm::dvec3 to = spot.sky ? spot.at : spot.at - there.observer.place;
    Ray ray = ray_from_world(there.observer, glm::length(to) > 0 ? glm::normalize(to) : glm::dvec3(0, 0, -1));
    if (spot.frame > 0) {
        ray.ship = glm::conjugate(there.turn) * ray.ship;
        ray.world = ray_from_ship(observer, ray.ship).world;
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
    if (spot.sky)
        return reading;
    const MeasuringObserver there = in_frame_of(observer, world, spot.frame).observer;
    const double there_distance = glm::distance(spot.at, there.place);
    reading.ship_distance_s = reading.ray.D * there_distance * seconds_per_time_unit;
    const double world_D = spot.frame > 0 ? ray_from_ship(observer, reading.ray.ship).D : reading.ray.D;
    reading.distance_s = *reading.ship_distance_s / world_D;
    reading.emitted_s = observer.time * seconds_per_time_unit - *reading.distance_s;
    if (spot.clock)
        reading.clock_s = clock_reading(world, spot, there.time, there_distance, seconds_per_time_unit);
    return reading;
}

PairReading read_pair(const MeasuringObserver& observer, const Spot& first, const Spot& second, const World& world,
    double seconds_per_time_unit)
{
    const SpotReading a = read_spot(observer, first, world, seconds_per_time_unit),
                      b = read_spot(observer, second, world, seconds_per_time_unit);
    PairReading pair{.angle_rad = angle_between(a.ray.ship, b.ray.ship)};
    if (!first.sky && !second.sky && observer.aberration)
        pair.apparent_s = glm::distance(left_from(a), left_from(b));
    if (!first.sky && !second.sky && first.frame == second.frame) {
        pair.rest_s = glm::distance(first.at, second.at) * seconds_per_time_unit;
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
    if (observer.u == glm::dvec3(0))
        return {};
    return std::acos(physics::unshifted_cosine(exp_rapidity_of(observer)));
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

} // namespace starbow
