#pragma once
#include "config/model/shot.h"
#include "runtime/world/world.h"
#include <optional>

namespace starbow {

/// The measuring observer: an event and a velocity in the world, scene units. ship_from_cockpit turns its axes.
struct MeasuringObserver {
    glm::dvec3 place{0};
    double time = 0;
    glm::dvec3 u{0}; ///< proper velocity
    glm::dquat ship_from_cockpit{1, 0, 0, 0};
    bool aberration = true; ///< false: the effect is off, and the picture has the world's directions; true without light
                            ///< delay
    Comparison comparison = Comparison::none; ///< the law of the picture, by which the instruments read it
};
/// The measuring observer of a shot's eye, at `offset` from the ship (ship frame, scene units) and simultaneous there.
MeasuringObserver measuring_observer_of(const Shot& shot, const glm::dvec3& offset = glm::dvec3(0));

/// An incoming ray of light: unit directions towards its source, in the ship's frame and in the world's, and f_seen /
/// f_emitted, by the picture's law. Without light delay things are shown where they are at the ship's present: `world` then
/// leads to that place, and D is 1.
struct Ray {
    glm::dvec3 ship, world;
    double D = 1;
};
Ray ray_from_ship(const MeasuringObserver& observer, const glm::dvec3& ship);
Ray ray_from_world(const MeasuringObserver& observer, const glm::dvec3& world);
/// The ray at the crosshair: straight ahead of the visitor's look.
Ray aim_of(const MeasuringObserver& observer);

/// The picture's values in one direction, with float accuracy; on planes that holds for the distance too.
struct Probed {
    Ray ray;
    double distance
        = 0; ///< the surface's distance in the world, from the observer's place, scene units; infinite for the sky
    int frame = 0; ///< index into World::frames: its rest frame; the ray's D is of light from there
    double light = 0; ///< luminance as seen, before exposure, without stars; the scene's white is 1
};

/// A marked thing, which can be found again from anywhere on the flight.
struct Spot {
    glm::dvec3 at{0}; ///< its place in its rest frame, scene units; of the sky the unit direction in the world
    int frame = 0; ///< index into World::frames
    bool sky = false;
    std::optional<std::size_t> clock; ///< the instance, if it is a clock
};
/// The spot of a probe's values. A clock is recognised if it exists at the spot's retarded time.
Spot spot_at(const MeasuringObserver& observer, const Probed& probed, const World& world);
/// Moves a spot on a clock to the clock's middle, so that aiming need not be exact; not on an animated clock.
Spot snapped(Spot spot, const World& world);
/// The ray from a spot. Its world direction is the world's; its D is from the spot's rest frame.
Ray ray_to(const MeasuringObserver& observer, const Spot& spot, const World& world);

/// The wavelength whose shift the instruments show, in the middle of the visible.
constexpr double example_nm = 550;

/// The instruments' values of one spot. Seconds are the scene's, distances are seconds of light.
struct SpotReading {
    Ray ray;
    std::optional<double> from_motion_rad, from_motion_world_rad; ///< angle from the motion, as seen and in the world;
                                                                  ///< nullopt at rest
    double relative_u = 0; ///< proper velocity of the ship past the spot: gamma beta in the spot's rest frame
    std::optional<double> from_relative_motion_rad; ///< angle from that motion, as seen; nullopt at rest beside the spot
    double seen_nm = example_nm; ///< the seen wavelength of example_nm
    std::optional<double> distance_s; ///< in the world, to the retarded position; nullopt for the sky. Without light
                                      ///< delay in the ship, to the place at its present
    std::optional<double> emitted_s; ///< the retarded time, in the world; without light delay the world's time there at
                                     ///< the ship's present
    std::optional<double> ship_distance_s; ///< in the ship's frame: the light's travel time there, D times the above;
                                           ///< nullopt where velocities simply add
    std::optional<double> clock_s; ///< the shown reading of the clock that is at the spot at the shown time, at its
                                   ///< middle or at another part of its dial
    std::optional<double> light; ///< as in Probed
};
SpotReading read_spot(const MeasuringObserver& observer, const Spot& spot, const World& world, double seconds_per_time_unit);

/// The instruments' values of two spots.
struct PairReading {
    double angle_rad = 0; ///< between them, as seen
    std::optional<double> apparent_s; ///< apparent length: the distance, in the ship's frame, between the two retarded
                                      ///< positions; nullopt for the sky, without aberration, and where velocities
                                      ///< simply add
    std::optional<double> rest_s; ///< the distance between them where both rest; nullopt where they move against each other
    std::optional<double> contracted_s; ///< the distance in the ship's frame, both at one time there; nullopt as above
    std::optional<double> relative_u; ///< proper velocity of the ship past both, in their rest frame; nullopt as rest_s
    std::optional<double> from_motion_at_rest_rad; ///< angle between that motion and the line through both, where they
                                                   ///< rest, up to a right angle; nullopt at rest beside them too
    std::optional<double> clocks_s; ///< the second's reading minus the first's
};
PairReading read_pair(const MeasuringObserver& observer, const Spot& first, const Spot& second, const World& world,
    double seconds_per_time_unit);

/// The angle from the motion at which nothing is shifted (D = 1), as seen, radians; nullopt at rest and without light delay,
/// where nothing is shifted anywhere.
std::optional<double> unshifted_angle(const MeasuringObserver& observer);

} // namespace starbow
