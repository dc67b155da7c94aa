#pragma once
#include "config/model/scene_file.h"
#include "runtime/light/spectrum.h"
#include "shaders/shared_structs.h"
#include <vector>

namespace starbow {

struct Star {
    glm::dvec3 direction; ///< unit, from the observer; equatorial, J2000: x towards the equinox, z towards the north pole
    double magnitude; ///< visual
    double temperature_K;
};

/// Reads a catalogue; scenes/stars/README.md describes its columns. Throws InputError with the line, the problem, and
/// what would be right.
std::vector<Star> load_stars(const std::filesystem::path& file);

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

/// The stars as the device reads them, in a scene's world.
std::vector<shared::StarEntry> star_entries(const std::vector<Star>& stars, const StarSky& sky);

} // namespace starbow
