#pragma once
#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace starbow {

struct Document;

/// Mean elements of an orbit around the Sun, and their changes in a Julian century: astronomical units and degrees, the mean
/// ecliptic and equinox of J2000 (E. M. Standish, "Keplerian elements for approximate positions of the major planets").
struct OrbitElements {
    struct Element {
        double at_j2000, per_century;
    };
    Element semi_major_au, eccentricity, inclination_deg, mean_longitude_deg, perihelion_deg, node_deg;

    /// The pull of Jupiter and Saturn on each other: a polynomial in Julian centuries, held beyond the centuries of its fit,
    /// and periodic terms of the angle a L5 + b L6 of both mean longitudes.
    struct Correction {
        struct Term {
            glm::ivec2 multiples;
            double sine, cosine;
        };
        std::vector<double> polynomial;
        std::vector<Term> terms;
    };
    Correction longitude_deg, distance_part; ///< added around the ecliptic's pole; times 1 + it. Empty: none
};

/// A periodic term of the Moon's motion: the multiples of its four arguments, and its amplitude.
struct LunarTerm {
    glm::ivec4 multiples; ///< of the elongation, the Sun's and the Moon's anomaly, and the argument of latitude
    double amplitude; ///< of a sine in longitude or latitude, degrees; of a cosine in the distance, km
};

/// The rotation of a globe: its north pole and prime meridian (IAU working group on cartographic coordinates).
struct Rotation {
    glm::dvec2 pole_deg{0, 90}, pole_deg_per_century{0}; ///< right ascension and declination, J2000
    double meridian_deg = 0, meridian_deg_per_day = 0;
    /// A libration: sines in the pole's right ascension and in the meridian, and a cosine in its declination, degrees.
    struct Libration {
        double angle_deg, deg_per_day, ascension, declination, meridian;
    };
    std::vector<Libration> librations;
    bool universal_time = false; ///< days of UTC; otherwise of terrestrial time
};

enum class Scattering { cloudy, dusty, sun };

/// A ring of thin matter around a globe's equator. profile: at evenly spaced radii its optical depth along its normal, and
/// twice the reflectivity of a thick layer of its particles, lit and seen from its normal.
struct PlanetRing {
    double inner_m, outer_m;
    std::vector<glm::dvec2> profile;
    std::string kind;
};

/// A layer above a globe's air that shines by itself: airglow, or a part of an aurora's height. zenith: radiance as seen
/// from right below, over a sunlit white surface's; of an aurora, of a full arc. light: a name in SolarSystem::lights.
struct Glow {
    double from_m, to_m, zenith;
    std::string light;
    bool aurora;
};

constexpr std::size_t most_glows = 8;

/// The Earth's geomagnetic pole in the north, latitude and longitude (International Geomagnetic Reference Field, 2020), and
/// the angle from there, towards midnight, of the middle of an aurora's oval (docs/physics/solar-system.md).
constexpr glm::dvec2 geomagnetic_pole_deg{80.65, -72.68};
constexpr double oval_from_pole_deg = 4;

/// A globe's air: the height over which its density falls to 1/e. Only one globe has air, and the maps for it.
struct Air {
    double scale_height_m;
    std::filesystem::path clouds, water, lamps; ///< grey maps; lamps: the root of their radiance
    double brightest_lamps; ///< radiance of that map's white, over a sunlit white surface's
    std::string lamp; ///< the lamps' light: a name in SolarSystem::lights; empty: they are dark
    std::vector<Glow> glows; ///< at most most_glows; layers of aurora are the last, each on the one before
};

/// The Sun, a planet or a moon.
struct Globe {
    std::string name;
    double radius_m = 0, flattening = 0; ///< equatorial; (equatorial - polar) / equatorial
    std::optional<OrbitElements> orbit; ///< around the Sun; of the Earth it is that of the Earth and the Moon together
    bool moon = false; ///< the Earth's
    Rotation rotation;
    Scattering scattering = Scattering::cloudy;
    double dimming_per_deg = 0,
           dimming_per_deg4 = 0; ///< of a dusty one, in magnitudes by its phase angle's first and fourth power
    std::filesystem::path map; ///< parts of the first three kinds, over `map_scale`; empty: the fourth alone
    double map_scale = 1;
    std::array<std::string, 4> kinds; ///< names in SolarSystem::kinds; empty: none
    std::optional<Air> air;
    std::optional<PlanetRing> ring;
};

/// A measured reflectance, or a lamp's relative radiance per wavelength, at wavelengths in nm.
struct NamedTable {
    std::string name;
    std::vector<std::pair<double, double>> points;
};

/// A polynomial in the cosine of the angle from the Sun's normal: its brightness over that at the middle of the disc.
struct LimbDarkening {
    double nm;
    std::array<double, 6> powers;
};

/// The Sun and all that goes around it, as plain data.
struct SolarSystem {
    std::vector<Globe> globes; ///< at most MAX_GLOBES; the Sun is one
    std::vector<NamedTable> kinds, lights;
    std::vector<LimbDarkening> limb; ///< rising wavelengths
    OrbitElements::Element jupiter_deg{}, saturn_deg{}; ///< mean longitudes
    std::vector<LunarTerm> moon_longitude, moon_latitude, moon_distance;
};

/// Reads and checks a file of globes; scenes/solar-system/README.md describes it. Throws InputError.
SolarSystem load_solar_system(const std::filesystem::path& file);

/// A scene's globes: their file, and the date at the scene's time 0.
struct GlobeSky {
    std::filesystem::path file;
    double days = 0; ///< since 2000 January 1, 12 h UTC
    std::string origin; ///< name of the globe at the world's origin, at which it rests at the scene's time 0
};

} // namespace starbow
