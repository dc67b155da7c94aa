#pragma once
#include "config/model/solar_system.h"
#include <span>

namespace starbow {

constexpr double astronomical_unit_m = 149597870700; ///< IAU 2012, resolution B2
/// Terrestrial time before UTC, seconds, since 2017: 32.184 and 37 leap seconds. In a century it changes by a minute or two,
/// in which the Earth turns by half a degree.
constexpr double ahead_of_utc_s = 69.184;

/// Places of the globes from the Sun's middle, metres, equatorial axes of J2000: x towards the equinox, z towards the north
/// pole. days: since 2000 January 1, 12 h UTC. From 1800 to 2050 within 0.1 degrees of the true directions from the Sun
/// (Standish; the Moon: Meeus, "Astronomical algorithms", chapter 47). Elements beyond: index into SolarSystem::globes.
std::vector<glm::dvec3> globe_places_m(const SolarSystem& system, double days);

/// The turn from the equatorial axes to a globe's own: z to its north pole, x to its prime meridian.
glm::dmat3 globe_turn(const Globe& globe, double days);

/// The motion of a world's origin, which is that of one globe at a date: metres from the Sun's middle, equatorial axes. All
/// worlds move evenly.
struct WorldOrigin {
    double days; ///< date
    glm::dvec3 place_m, velocity_m_s;
    glm::dvec3 at(double seconds) const { return place_m + velocity_m_s * seconds; } ///< so long after the date
};
/// Throws InputError where no globe has the name.
WorldOrigin world_origin(const SolarSystem& system, const GlobeSky& sky);

/// A globe as an eye at rest in the world sees it. World axes, scene units.
struct SeenGlobe {
    std::size_t globe; ///< index into SolarSystem::globes
    glm::dvec3 from_eye; ///< its middle's place when its light left
    double distance;
    glm::dmat3 own_from_world; ///< turn to its own axes
    glm::dvec3 to_sun; ///< unit direction from its middle to the Sun's; 0 for the Sun
    double sun_distance_au = 0;
    double phase_deg = 0; ///< the angle between the Sun and the eye there
};

/// The globes around an eye, the farthest first, without those whose inside it is in. eye, time: its event in the world;
/// unit_m: metres of a scene unit; seconds: of a scene's unit of time.
struct EyeAmongGlobes {
    glm::dvec3 place;
    double time;
    glm::dmat3 world_from_equatorial;
    double unit_m, seconds;
    bool now = false; ///< without light delay: everything at the ship's present
    glm::dvec3 way{0}; ///< then: the direction of the ship's motion times its speed over light's
};
std::vector<SeenGlobe> globes_seen(const SolarSystem& system, const WorldOrigin& origin, const EyeAmongGlobes& eye);

/// The greatest distance of an eye from the ship's place, scene units, at which the nearest globe's ground moves by half a
/// degree. An eye's muscles fuse two pictures that are a degree or two apart; a layout's hyper-stereo may part two eyes by a
/// planet's width. seen: from the ship's place.
double farthest_eye(const SolarSystem& system, std::span<const SeenGlobe> seen, double unit_m);

} // namespace starbow
