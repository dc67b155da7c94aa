#include "instruments.h"
#include "clock.h"
#include "physics/physics.h"
#include "plan.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

double exp_rapidity_of(const Vantage& vantage) { return physics::exp_rapidity(glm::length(vantage.u)); }

glm::dvec3 middle_of(const World& world, std::size_t instance)
{
    const Instance& one = world.instances[instance];
    const Primitive& primitive = world.primitives[one.primitive];
    return glm::dvec3(one.world_from_local * glm::dvec4(0.5 * (primitive.low + primitive.high), 1));
}

const WorldClock* clock_of(const World& world, std::size_t instance)
{
    const auto& clock = world.materials[std::size_t(world.primitives[world.instances[instance].primitive].material)].clock;
    return clock ? &*clock : nullptr;
}

/// In the ship's frame, from the vantage: where a spot was when the light left it that is seen now. The 4-vector (-r, r n)
/// of the light's way is lengthened as its frequency is: r becomes D r.
glm::dvec3 left_from(const SpotReading& reading) { return *reading.ship_distance_s * reading.ray.ship; }

} // namespace

Vantage vantage_of(const Shot& shot, const glm::dvec3& offset)
{
    return {shot.position + physics::eye_place(shot.u, offset), shot.time + physics::eye_time(shot.u, offset), shot.u,
        shot.ship_from_cockpit, shot.effects.aberration};
}

Ray ray_from_ship(const Vantage& vantage, const glm::dvec3& ship)
{
    const glm::dmat3 to_motion = motion_from_world(vantage.u, vantage.ship_from_cockpit);
    const double E = exp_rapidity_of(vantage);
    const physics::Sight sight = physics::world_from_camera(to_motion * ship, E, 1 / E);
    return {ship, vantage.aberration ? glm::transpose(to_motion) * sight.n : ship, sight.D};
}

Ray ray_from_world(const Vantage& vantage, const glm::dvec3& world)
{
    if (!vantage.aberration) // the picture keeps the direction and shifts the light as the ship's direction has it
        return ray_from_ship(vantage, world);
    const glm::dmat3 to_motion = motion_from_world(vantage.u, vantage.ship_from_cockpit);
    const double E = exp_rapidity_of(vantage);
    const physics::Sight sight = physics::camera_from_world(to_motion * world, E, 1 / E);
    return {glm::transpose(to_motion) * sight.n, world, sight.D};
}

Ray aim_of(const Vantage& vantage) { return ray_from_ship(vantage, vantage.ship_from_cockpit * glm::dvec3(0, 0, -1)); }

Spot spot_at(const Vantage& vantage, const Ray& ray, double distance, const World& world)
{
    if (!std::isfinite(distance))
        return {.at = ray.world, .sky = true};
    const glm::dvec3 at = vantage.place + distance * ray.world;
    for (std::size_t i = 0; i < world.instances.size() && clock_of(world, i); ++i) {
        const glm::dmat3 turn(world.instances[i].world_from_local);
        const double radius = world.primitives[world.instances[i].primitive].radius
            * std::max({glm::length(turn[0]), glm::length(turn[1]), glm::length(turn[2])});
        if (glm::distance(at, middle_of(world, i)) <= radius)
            return {.at = at, .clock = i};
    }
    return {.at = at};
}

Spot snapped(Spot spot, const World& world)
{
    if (spot.clock)
        spot.at = middle_of(world, *spot.clock);
    return spot;
}

Ray ray_to(const Vantage& vantage, const Spot& spot)
{
    const glm::dvec3 to = spot.sky ? spot.at : spot.at - vantage.place;
    return ray_from_world(vantage, glm::length(to) > 0 ? glm::normalize(to) : glm::dvec3(0, 0, -1));
}

SpotReading read_spot(const Vantage& vantage, const Spot& spot, const World& world, double seconds_per_time_unit)
{
    SpotReading reading{.ray = ray_to(vantage, spot)};
    reading.seen_nm = example_nm / reading.ray.D;
    if (vantage.u != glm::dvec3(0)) {
        reading.from_motion_rad = angle_between(reading.ray.ship, vantage.u);
        reading.from_motion_world_rad = angle_between(reading.ray.world, vantage.u);
    }
    if (spot.sky)
        return reading;
    const double distance = glm::distance(spot.at, vantage.place);
    reading.distance_s = distance * seconds_per_time_unit;
    reading.emitted_s = (vantage.time - distance) * seconds_per_time_unit;
    reading.ship_distance_s = reading.ray.D * *reading.distance_s;
    if (spot.clock)
        reading.clock_s = reading_s(*clock_of(world, *spot.clock), vantage.time, distance, seconds_per_time_unit);
    return reading;
}

PairReading read_pair(
    const Vantage& vantage, const Spot& first, const Spot& second, const World& world, double seconds_per_time_unit)
{
    const SpotReading a = read_spot(vantage, first, world, seconds_per_time_unit),
                      b = read_spot(vantage, second, world, seconds_per_time_unit);
    PairReading pair{.angle_rad = angle_between(a.ray.ship, b.ray.ship)};
    if (!first.sky && !second.sky) {
        pair.rest_s = glm::distance(first.at, second.at) * seconds_per_time_unit;
        // Only what lies along the motion is contracted, by 1 / gamma.
        const glm::dvec3 apart = (second.at - first.at) * seconds_per_time_unit, &u = vantage.u;
        const double gamma = physics::gamma_of(u);
        pair.contracted_s = glm::length(apart - u * (glm::dot(u, apart) / (gamma * (1 + gamma))));
        if (vantage.aberration)
            pair.apparent_s = glm::distance(left_from(a), left_from(b));
    }
    if (a.clock_s && b.clock_s)
        pair.clocks_s = *b.clock_s - *a.clock_s;
    return pair;
}

std::optional<double> unshifted_angle(const Vantage& vantage)
{
    if (vantage.u == glm::dvec3(0))
        return {};
    return std::acos(physics::unshifted_cosine(exp_rapidity_of(vantage)));
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

} // namespace starbow
