#pragma once
#include "body.h"
#include "emission.h"
#include "flying.h"
#include "goal.h"
#include "shot.h"
#include "solar_system.h"
#include <filesystem>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace starbow {

/// A directional light, the same everywhere. `towards`: unit direction from the world to the light.
struct DirectionalLight {
    glm::dvec3 towards;
    glm::dvec3 radiance; ///< Rec. 709 linear; the colour of a white surface that faces it
    std::optional<Emission> spectrum; ///< nullopt: sunlight. Otherwise `radiance` tints it: 1 is the energy of sunlight's 1
};

/// The directions into which a lamp shines. Its light falls from the inner cone to the outer one as glTF says
/// (KHR_lights_punctual): by the square of the cosine's part between both.
struct LightCone {
    glm::dvec3 axis; ///< unit, in the lamp's own frame
    double inner_rad, outer_rad; ///< from the axis: 0 <= inner < outer <= pi / 2
};

/// A point light; a white surface that faces it at `distance` (scene units) gets the colour `radiance`, which falls as
/// 1/r^2.
struct PointLight {
    glm::dvec3 position;
    double distance;
    glm::dvec3 radiance;
    std::optional<Emission> spectrum; ///< as above
    std::string
        body{}; ///< the light moves with this body, around its origin, while the body exists; empty: it rests in the world
    std::optional<LightCone> cone{}; ///< none: it shines to all sides
};

using Light = std::variant<DirectionalLight, PointLight>;

/// The sky behind everything: a colour at the zenith (+y), at the horizon and at the nadir, blended smoothly between. A
/// black body's glow is everywhere the same.
struct Sky {
    glm::dvec3 zenith{0}, horizon{0}, nadir{0}; ///< Rec. 709 linear
    double temperature_K = 0; ///< 0: no glow. 2.725 is the microwave background's
    bool has_colour() const { return zenith + horizon + nadir != glm::dvec3(0); } ///< beside its glow
};

/// The light of the stars that are too many to be told apart: a picture of the whole sky.
struct MilkyWay {
    /// Equirectangular: right ascension (J2000) grows to the right from 0 at the left edge, north is up. Colours are those
    /// of sunlight on a surface.
    std::filesystem::path panorama;
    double peak_arcmin2 = 0; ///< the picture's white: so many stars of magnitude 0 in each square arc minute
};

/// The stars of a catalogue, behind everything.
struct StarSky {
    std::filesystem::path catalogue;
    double brightness_arcmin2
        = 200; ///< a star of magnitude 0 gives as much light as so many square arc minutes of the scene's white
    glm::dvec2 ahead_deg{0}; ///< right ascension and declination (J2000) of straight ahead (-z), with north up
    std::optional<MilkyWay> milky_way{};
    std::optional<glm::dvec2>
        sun_deg{}; ///< right ascension and declination of the Sun, one astronomical unit from the origin
    /// The light of a white surface that faces the Sun at the origin, over the scene's white; nullopt: as much brighter than
    /// the stars as it is.
    std::optional<double> sun_light{};
    /// So many of the brightest are drawn one by one, each at its place in depth. The others are painted onto the Milky
    /// Way's panorama, as they are seen from the Sun.
    std::size_t in_depth = std::numeric_limits<std::size_t>::max();
};

/// A level square of tiles below a world that brings no ground of its own.
struct Ground {
    static constexpr double most = 1e9; ///< of its numbers, scene units

    glm::dvec3 middle{0}; ///< scene units
    double half_width = 100;
    glm::dvec3 colour{0.3}; ///< Rec. 709 linear reflectance; every other tile is a little darker
};

struct SceneFile {
    std::string name;
    std::string file; ///< as messages show it
    std::filesystem::path gltf;
    double unit_m = 299792458; ///< one scene unit in metres
    double light_speed_m_s = 299792458; ///< the real one, or a slow one as in Gamow's tales
    Sky sky;
    std::optional<Ground> ground;
    std::optional<StarSky> stars;
    std::optional<GlobeSky> globes; ///< the Sun, planets and moons; only where nothing else moves
    bool shadows = false; ///< still things hide the light of resting lamps and of the sky from others
    glm::dvec3 ambient{0}; ///< Rec. 709 linear, a white surface's light without any lamp
    std::vector<Light> lights;
    std::vector<Body> bodies;
    std::optional<Boundary> boundary; ///< for exhibits that nobody attends to
    std::vector<Goal> goals; ///< for visitors, one after the other
    std::optional<PlannedFlight> planned; ///< for exhibits with a pace
    Shot start; ///< the visitor's start; its `scene` is this file's name
    std::vector<std::string> notes{}; ///< said once when its world is loaded

    /// The radiance of the Milky Way's white, over the scene's; 0 where there is none.
    double milky_way() const
    {
        return stars && stars->milky_way ? stars->brightness_arcmin2 * stars->milky_way->peak_arcmin2 : 0;
    }
    /// The factor from scene times (unit / c) to seconds.
    double seconds_per_time_unit() const { return unit_m / light_speed_m_s; }
};

/// Reads and checks a scene file, without opening the files that it names. Throws InputError.
SceneFile load_scene_file(const std::filesystem::path& file);

} // namespace starbow
