#pragma once
#include "config/model/scene_file.h"
#include "runtime/light/spectrum.h"
#include "shaders/shared_structs.h"
#include <span>
#include <vector>

namespace starbow {

constexpr double parsec_m = 3.0856775814913673e16; ///< 648000 / pi astronomical units (IAU 2015, resolution B2)
constexpr double unknown_distance_m = 1000 * parsec_m; ///< of a star without a usable parallax

/// A star as it is seen from the Sun.
struct Star {
    glm::dvec3 direction; ///< unit; equatorial, J2000: x towards the equinox, z towards the north pole
    double magnitude; ///< visual
    double temperature_K;
    double distance_m = unknown_distance_m;
    double radius_m = 0; ///< of the Sun alone: beside things it is no point
};

/// Reads a catalogue; scenes/stars/README.md describes its columns. Throws InputError with the line, the problem, and
/// what would be right.
std::vector<Star> load_stars(const std::filesystem::path& file);

/// The catalogue's stars that a scene draws one by one; and the others, which load_world paints onto the Milky Way's
/// panorama. Both throw as load_stars does.
std::vector<Star> stars_in_depth(const StarSky& sky);
std::vector<Star> painted_stars(const StarSky& sky);

/// The unit direction of a right ascension and a declination, equatorial axes.
glm::dvec3 equatorial(double ra_deg, double dec_deg);

/// Effective temperature of a star, K, from its colour index B-V (-0.5 to 6). Ballesteros, "New insights into black
/// bodies", EPL 97, 34008 (2012), equation 14: within a few per cent for ordinary stars.
double temperature_of(double b_v);

/// CIE XYZ of a black body's light over a luminance Y of 1 at 5772 K, the Sun's temperature.
glm::dvec3 black_body_xyz(double temperature_K);

/// The table of star.vert's black_body(): steps even in log2 of the temperature from STAR_COLDEST K upwards. x, y, z: the
/// observer's colour, Rec. 709 linear, over its greatest sensor's value. w: the natural logarithm of that value, where
/// the eye's luminance of 5772 K is 1. Linear interpolation is accurate to 1e-3 at the cold end, where the light rises as
/// the 50th power, and to 2e-4 from 2000 K.
std::vector<glm::vec4> black_body_table(const StandardObserver& observer);

/// The turn from the equatorial axes to the world's: `ahead_deg` (right ascension, declination) stands straight ahead,
/// -z, with north upwards.
glm::dmat3 world_from_equatorial(const glm::dvec2& ahead_deg);

/// A star in a scene's world, at rest there. The Sun stands at the world's origin.
struct PlacedStar {
    glm::dvec3 place; ///< scene units
    double light; ///< illuminance at a distance of one scene unit, in the scene's white times steradians
    double over_luminance; ///< 1 / black_body_xyz(temperature_K).y
    double temperature_K;
    double radius; ///< scene units, or 0
};

/// The stars around a world. At first the brightest as seen from the Sun, by which an eye sets its exposure, then all
/// others; both sorted by patches of the Sun's sky, because a device draws neighbours together, and neighbours are in or
/// out of view together.
struct StarField {
    std::vector<PlacedStar> stars;
    std::size_t brightest = 0; ///< number of stars at first
    double least_distance = 0; ///< scene units: one astronomical unit. Nobody is nearer to a star
};
StarField star_field(const std::vector<Star>& stars, const StarSky& sky, double unit_m);

/// The stars as the device reads them, seen by an eye at rest at a place (scene units) in the world: directions to the
/// accuracy of a float, 0.02 seconds of arc. entries: as many as stars. Returns the distance of the nearest star, scene
/// units.
double stars_from(const StarField& field, const glm::dvec3& eye, std::span<shared::StarEntry> entries);

} // namespace starbow
