#pragma once
#include "config/model/shot.h"
#include "runtime/world/world.h"
#include <optional>

namespace starbow {

/// Who measures: an event and a velocity in the world, scene units; axes as ship_from_cockpit has them.
struct MeasuringObserver {
    glm::dvec3 place{0};
    double time = 0;
    glm::dvec3 u{0}; ///< proper velocity
    glm::dquat ship_from_cockpit{1, 0, 0, 0};
    bool aberration = true; ///< false: the picture has the world's directions, as its effect is switched off
};
/// An eye of a shot, at `offset` from the ship (ship frame, scene units) and simultaneous there.
MeasuringObserver measuring_observer_of(const Shot& shot, const glm::dvec3& offset = glm::dvec3(0));

/// Light on its way in: unit directions towards its source, in the ship's frame and in the world's, and f_seen / f_emitted.
struct Ray {
    glm::dvec3 ship, world;
    double D = 1;
};
Ray ray_from_ship(const MeasuringObserver& observer, const glm::dvec3& ship);
Ray ray_from_world(const MeasuringObserver& observer, const glm::dvec3& world);
/// Straight ahead of the visitor's look: the crosshair.
Ray aim_of(const MeasuringObserver& observer);

/// What a picture shows in one direction, as it has it: to a float's accuracy, the distance to a texel's.
struct Probed {
    Ray ray;
    double distance = 0; ///< of the surface in the world, from the lookout's place, scene units; infinite for the sky
    int frame = 0; ///< of World::frames: where it stands still; the ray's D is of light from there
    double light = 0; ///< luminance as seen, before exposure, without stars; the scene's white is 1
};

/// Something that was aimed at: it is found again from wherever the ship goes.
struct Spot {
    glm::dvec3 at{0}; ///< its place in the frame in which it rests, scene units; of the sky the unit direction in the world
    int frame = 0; ///< of World::frames
    bool sky = false;
    std::optional<std::size_t> clock; ///< it lies on this instance, a clock
};
/// What a probe has seen, and whether that is a clock.
Spot spot_at(const MeasuringObserver& observer, const Probed& probed, const World& world);
/// Of a clock its middle, so that aiming need not be exact.
Spot snapped(Spot spot, const World& world);
/// Light from a spot. Its world direction is the world's, its D that from where the spot rests.
Ray ray_to(const MeasuringObserver& observer, const Spot& spot, const World& world);

/// The light whose shift stands for all, in the middle of what eyes see.
constexpr double example_nm = 550;

/// What the instruments say of one spot. Seconds are the scene's, distances are seconds of light.
struct SpotReading {
    Ray ray;
    std::optional<double> from_motion_rad, from_motion_world_rad; ///< angle from the motion, as seen and in the world; none
                                                                  ///< at rest
    double seen_nm = example_nm; ///< what example_nm is seen as
    std::optional<double> distance_s; ///< in the world, where the light left; none of the sky
    std::optional<double> emitted_s; ///< the world's time then
    std::optional<double>
        ship_distance_s; ///< in the ship's frame: how long the light was under way there, D times the above
    std::optional<double> clock_s; ///< what the clock is seen to show there, on its middle or on another part of its dial
    std::optional<double> light; ///< as Probed's
};
SpotReading read_spot(const MeasuringObserver& observer, const Spot& spot, const World& world, double seconds_per_time_unit);

/// What they say of two spots.
struct PairReading {
    double angle_rad = 0; ///< between them, as seen
    std::optional<double> apparent_s; ///< how long what joins them looks: the distance, in the ship's frame, between the
                                      ///< places where each was when the light left it that is seen now; none of the sky,
                                      ///< and none without aberration
    std::optional<double> rest_s; ///< between them where both rest; none where they move against each other
    std::optional<double> contracted_s; ///< between them in the ship's frame, both at one time there; none there too
    std::optional<double> clocks_s; ///< the second's reading minus the first's
};
PairReading read_pair(
    const MeasuringObserver& observer, const Spot& first, const Spot& second, const World& world, double seconds_per_time_unit);

/// Angle from the motion at which nothing is shifted (D = 1), as seen, radians; none at rest, where nothing is anywhere.
std::optional<double> unshifted_angle(const MeasuringObserver& observer);

/// Angle between directions of any length, sharp for small ones and for opposite ones, radians.
double angle_between(const glm::dvec3& a, const glm::dvec3& b);

} // namespace starbow
