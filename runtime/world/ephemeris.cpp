#include "ephemeris.h"
#include "config/json/reader.h"
#include "config/model/angles.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace starbow {
namespace {

constexpr double ecliptic_deg = 23.43928; ///< obliquity at J2000, as Standish has it
constexpr double days_per_century = 36525;

glm::dvec3 equatorial_from_ecliptic(const glm::dvec3& p)
{
    const double s = std::sin(ecliptic_deg * degree), c = std::cos(ecliptic_deg * degree);
    return {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
}

double dynamical_centuries(double days) { return (days + ahead_of_utc_s / 86400) / days_per_century; }

/// Metres from the Sun.
glm::dvec3 place_on(const OrbitElements& orbit, double centuries)
{
    const auto at = [&](const OrbitElements::Element& e) { return e.at_j2000 + e.per_century * centuries; };
    const double e = at(orbit.eccentricity), perihelion = at(orbit.perihelion_deg), node = at(orbit.node_deg) * degree;
    const double mean = std::remainder(at(orbit.mean_longitude_deg) - perihelion, 360) * degree;
    double E = mean + e * std::sin(mean); // Kepler's equation by Newton's method; the planets' e is at most 0.21
    for (int i = 0; i < 8; ++i)
        E -= (E - e * std::sin(E) - mean) / (1 - e * std::cos(E));
    const double x = at(orbit.semi_major_au) * (std::cos(E) - e),
                 y = at(orbit.semi_major_au) * std::sqrt(1 - e * e) * std::sin(E);
    const double w = perihelion * degree - node, inclination = at(orbit.inclination_deg) * degree;
    const double along = x * std::cos(w) - y * std::sin(w), across = x * std::sin(w) + y * std::cos(w);
    return equatorial_from_ecliptic({along * std::cos(node) - across * std::cos(inclination) * std::sin(node),
               along * std::sin(node) + across * std::cos(inclination) * std::cos(node), across * std::sin(inclination)})
        * astronomical_unit_m;
}

/// Turns of the axes around z and x.
glm::dmat3 around_z(double a)
{
    return glm::transpose(glm::dmat3(std::cos(a), std::sin(a), 0, -std::sin(a), std::cos(a), 0, 0, 0, 1));
}
glm::dmat3 around_x(double a)
{
    return glm::transpose(glm::dmat3(1, 0, 0, 0, std::cos(a), std::sin(a), 0, -std::sin(a), std::cos(a)));
}

/// The ecliptic axes of J2000 from those of a date: Lieske and others 1977, as in Meeus, formulas 21.6 and 21.7.
glm::dmat3 j2000_from_date(double T)
{
    const double second = degree / 3600;
    const double eta = ((47.0029 - (0.03302 - 0.00006 * T) * T) * T) * second,
                 p = ((5029.0966 + (1.11113 - 0.000006 * T) * T) * T) * second;
    const double Pi = (174.876384 - (0.24161358 - 0.000009831 * T) * T) * degree;
    return glm::transpose(around_z(-(Pi + p)) * around_x(eta) * around_z(Pi));
}

/// The Moon's place from the Earth's middle, metres.
glm::dvec3 moon_place(const SolarSystem& system, double T)
{
    const double longitude
        = 218.3164477 + 481267.88123421 * T - 0.0015786 * T * T,
        D = 297.8501921 + 445267.1114034 * T - 0.0018819 * T * T, M = 357.5291092 + 35999.0502909 * T - 0.0001536 * T * T,
        m = 134.9633964 + 477198.8675055 * T + 0.0087414 * T * T, F = 93.2720950 + 483202.0175233 * T - 0.0036539 * T * T;
    const double flatter = 1 - 0.002516 * T - 0.0000074 * T * T; // of the Earth's orbit, in terms of the Sun's anomaly
    double l = longitude, b = 0, r = 385000.56;
    const auto sum = [&](const std::vector<LunarTerm>& terms, bool cosine, double& to) {
        for (const LunarTerm& term : terms) {
            const double angle
                = (term.multiples.x * D + term.multiples.y * M + term.multiples.z * m + term.multiples.w * F) * degree;
            to += term.amplitude * (cosine ? std::cos(angle) : std::sin(angle))
                * std::pow(flatter, std::abs(term.multiples.y));
        }
    };
    sum(system.moon_longitude, false, l), sum(system.moon_latitude, false, b), sum(system.moon_distance, true, r);
    // By Venus, Jupiter and the Earth's flattening (Meeus, chapter 47).
    const auto wave = [](double deg) { return 1e-6 * std::sin(deg * degree); };
    const double venus = 119.75 + 131.849 * T, jupiter = 53.09 + 479264.290 * T, third = 313.45 + 481266.484 * T;
    l += 3958 * wave(venus) + 1962 * wave(longitude - F) + 318 * wave(jupiter);
    b += -2235 * wave(longitude) + 382 * wave(third) + 175 * wave(venus - F) + 175 * wave(venus + F)
        + 127 * wave(longitude - m) - 115 * wave(longitude + m);
    l *= degree, b *= degree;
    return equatorial_from_ecliptic(
        j2000_from_date(T) * glm::dvec3(std::cos(b) * std::cos(l), std::cos(b) * std::sin(l), std::sin(b)) * (r * 1000));
}

/// A term of the Earth's longitude: amplitude * cos(phase + rate * t) * t^power, 1e-8 radians, t in thousands of years of
/// dynamical time since J2000.
struct LongitudeTerm {
    int power;
    double amplitude, phase, rate;
};
/// The Earth's heliocentric longitude, mean equinox of date: Bretagnon and Francou, Astronomy and Astrophysics 202 (1988),
/// 309 (VSOP87D), the terms above 0.2 seconds of arc. With them the Sun stands within 2 seconds from 1900 to 2050.
constexpr LongitudeTerm earth_longitude[] = {{0, 175347046, 0, 0}, {0, 3341656, 4.6692568, 6283.07585},
    {0, 34894, 4.6261, 12566.1517}, {0, 3497, 2.7441, 5753.3849}, {0, 3418, 2.8289, 3.5231}, {0, 3136, 3.6277, 77713.7715},
    {0, 2676, 4.4181, 7860.4194}, {0, 2343, 6.1352, 3930.2097}, {0, 1324, 0.7425, 11506.7698}, {0, 1273, 2.0371, 529.691},
    {0, 1199, 1.1096, 1577.3435}, {0, 990, 5.233, 5884.927}, {0, 902, 2.045, 26.298}, {0, 857, 3.508, 398.149},
    {0, 780, 1.179, 5223.694}, {0, 753, 2.533, 5507.553}, {0, 505, 4.583, 18849.228}, {0, 492, 4.205, 775.523},
    {0, 357, 2.92, 0.067}, {0, 317, 5.849, 11790.629}, {0, 284, 1.899, 796.298}, {0, 271, 0.315, 10977.079},
    {0, 243, 0.345, 5486.778}, {0, 206, 4.806, 2544.314}, {0, 205, 1.869, 5573.143}, {0, 202, 2.458, 6069.777},
    {0, 156, 0.833, 213.299}, {0, 132, 3.411, 2942.463}, {0, 126, 1.083, 20.775}, {0, 115, 0.645, 0.98},
    {0, 103, 0.636, 4694.003}, {1, 628331966747, 0, 0}, {1, 206059, 2.678235, 6283.07585}, {1, 4303, 2.6351, 12566.1517},
    {1, 425, 1.59, 3.523}, {1, 119, 5.796, 26.298}, {1, 109, 2.966, 1577.344}, {1, 93, 2.59, 18849.23},
    {1, 72, 1.14, 529.69}, {1, 68, 1.87, 398.15}, {2, 52919, 0, 0}, {2, 8720, 1.0721, 6283.0758}};

/// The direction from the Sun to the Earth, J2000. The Earth's latitude, at most 1.2 seconds of arc, is left out.
glm::dvec3 way_to_earth(double centuries)
{
    const double t = centuries / 10;
    double sum = 0;
    for (const LongitudeTerm& term : earth_longitude)
        sum += term.amplitude * std::cos(term.phase + term.rate * t) * std::pow(t, term.power);
    const double l = sum * 1e-8;
    return equatorial_from_ecliptic(j2000_from_date(centuries) * glm::dvec3(std::cos(l), std::sin(l), 0));
}

constexpr double moons_part = 1 / 82.3005691; ///< of the mass of the Earth and the Moon (DE440)

double value_of(const SolarSystem& system, const OrbitElements::Correction& correction, double centuries)
{
    const double T = std::clamp(centuries, -1.05, 0.55); // the fit's
    double sum = 0, power = 1;
    for (const double coefficient : correction.polynomial)
        sum += coefficient * power, power *= T;
    const double jupiter = system.jupiter_deg.at_j2000 + system.jupiter_deg.per_century * centuries,
                 saturn = system.saturn_deg.at_j2000 + system.saturn_deg.per_century * centuries;
    for (const auto& term : correction.terms) {
        const double angle = (term.multiples.x * jupiter + term.multiples.y * saturn) * degree;
        sum += term.sine * std::sin(angle) + term.cosine * std::cos(angle);
    }
    return sum;
}

glm::dvec3 corrected(const SolarSystem& system, const OrbitElements& orbit, const glm::dvec3& place, double centuries)
{
    const glm::dvec3 pole = equatorial_from_ecliptic({0, 0, 1});
    const double turn = value_of(system, orbit.longitude_deg, centuries) * degree;
    const glm::dvec3 turned = place * std::cos(turn) + glm::cross(pole, place) * std::sin(turn)
        + pole * (glm::dot(pole, place) * (1 - std::cos(turn)));
    return turned * (1 + value_of(system, orbit.distance_part, centuries));
}

glm::dvec3 place_of(const SolarSystem& system, const Globe& globe, double days)
{
    const double centuries = dynamical_centuries(days);
    const auto earth
        = std::find_if(system.globes.begin(), system.globes.end(), [](const Globe& g) { return g.name == "Earth"; });
    if (globe.moon || globe.name == "Earth") {
        // The orbit is that of the Earth's and the Moon's middle.
        const glm::dvec3 moon = moon_place(system, centuries);
        const double distance = glm::length(place_on(earth->orbit.value(), centuries) - moons_part * moon);
        return way_to_earth(centuries) * distance + (globe.moon ? moon : glm::dvec3(0));
    }
    if (!globe.orbit)
        return glm::dvec3(0);
    glm::dvec3 place = place_on(*globe.orbit, centuries);
    if (!globe.orbit->longitude_deg.polynomial.empty())
        place = corrected(system, *globe.orbit, place, centuries);
    return place;
}

} // namespace

std::vector<glm::dvec3> globe_places_m(const SolarSystem& system, double days)
{
    std::vector<glm::dvec3> places;
    for (const Globe& globe : system.globes)
        places.push_back(place_of(system, globe, days));
    return places;
}

glm::dmat3 globe_turn(const Globe& globe, double days)
{
    const double centuries = dynamical_centuries(days);
    const double dynamical_days = centuries * days_per_century;
    glm::dvec2 pole = globe.rotation.pole_deg + globe.rotation.pole_deg_per_century * centuries;
    double W = std::remainder(globe.rotation.meridian_deg
            + globe.rotation.meridian_deg_per_day * (globe.rotation.universal_time ? days : dynamical_days),
        360);
    for (const Rotation::Libration& libration : globe.rotation.librations) {
        const double angle = std::remainder(libration.angle_deg + libration.deg_per_day * dynamical_days, 360) * degree;
        pole += glm::dvec2(libration.ascension * std::sin(angle), libration.declination * std::cos(angle));
        W += libration.meridian * std::sin(angle);
    }
    pole *= degree, W *= degree;
    const glm::dvec3 z(std::cos(pole.y) * std::cos(pole.x), std::cos(pole.y) * std::sin(pole.x), std::sin(pole.y));
    const glm::dvec3 node(-std::sin(pole.x), std::cos(pole.x), 0); // of its equator on the equator of J2000
    const glm::dvec3 x = node * std::cos(W) + glm::cross(z, node) * std::sin(W);
    return glm::transpose(glm::dmat3(x, glm::cross(z, x), z));
}

WorldOrigin world_origin(const SolarSystem& system, const GlobeSky& sky)
{
    std::vector<std::string_view> names;
    for (const Globe& globe : system.globes)
        names.push_back(globe.name);
    const Globe& globe = system.globes[index_named(sky.origin, names, "globe")];
    const double half_s = 60;
    const glm::dvec3 change
        = place_of(system, globe, sky.days + half_s / 86400) - place_of(system, globe, sky.days - half_s / 86400);
    return {sky.days, place_of(system, globe, sky.days), change / (2 * half_s)};
}

std::vector<SeenGlobe> globes_seen(const SolarSystem& system, const WorldOrigin& origin, const EyeAmongGlobes& eye)
{
    std::vector<SeenGlobe> all;
    for (std::size_t i = 0; i < system.globes.size(); ++i) {
        const Globe& globe = system.globes[i];
        double time = eye.time;
        glm::dvec3 from_sun_m, from_eye;
        // The retarded time, a fixed point: a planet moves by at most 2e-4 of light's way.
        for (int round = 0; round < 6; ++round) {
            const double seconds = time * eye.seconds;
            from_sun_m = place_of(system, globe, origin.days + seconds / 86400);
            from_eye = eye.world_from_equatorial * ((from_sun_m - origin.at(seconds)) / eye.unit_m) - eye.place;
            const double next = eye.time + (eye.now ? glm::dot(eye.way, from_eye) : -glm::length(from_eye));
            if (next == time)
                break;
            time = next;
        }
        SeenGlobe seen{i, from_eye, glm::length(from_eye)};
        if (seen.distance * eye.unit_m <= globe.radius_m * (1 - globe.flattening))
            continue;
        seen.own_from_world
            = globe_turn(globe, origin.days + time * eye.seconds / 86400) * glm::transpose(eye.world_from_equatorial);
        seen.to_sun = glm::dvec3(0);
        if (const double far_m = glm::length(from_sun_m); far_m > 0) {
            // Sunlight left so long before, and the world has moved since.
            const double light_s = far_m * eye.seconds / eye.unit_m;
            seen.to_sun = eye.world_from_equatorial * glm::normalize(origin.velocity_m_s * light_s - from_sun_m);
            seen.sun_distance_au = far_m / astronomical_unit_m;
            seen.phase_deg = std::acos(std::clamp(glm::dot(seen.to_sun, -from_eye / seen.distance), -1.0, 1.0)) / degree;
        }
        all.push_back(seen);
    }
    std::sort(all.begin(), all.end(), [](const SeenGlobe& a, const SeenGlobe& b) { return a.distance > b.distance; });
    return all;
}

double farthest_eye(const SolarSystem& system, std::span<const SeenGlobe> seen, double unit_m)
{
    constexpr double most_parallax = 0.00873; // half a degree
    double nearest = std::numeric_limits<double>::max();
    for (const SeenGlobe& one : seen)
        nearest = std::min(nearest, one.distance - system.globes[one.globe].radius_m / unit_m);
    return most_parallax * std::max(nearest, 0.0);
}

} // namespace starbow
