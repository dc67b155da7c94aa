// Places and rotations of the globes against another library's (tests/world/ephemeris_witness.json), and what an eye sees of
// them: where they were when their light left, without jumps on any way.
#include "config/model/angles.h"
#include "config/model/scene_file.h"
#include "runtime/world/ephemeris.h"
#include "runtime/world/stars.h"
#include "tests/support/files.h"
#include <map>
#include <nlohmann/json.hpp>

namespace ephemeris_test {

using namespace starbow;
using glm::dmat3;
using glm::dvec2;
using glm::dvec3;

namespace {

constexpr double light_m_s = 299792458;

const SolarSystem& solar_system()
{
    static const SolarSystem system = load_solar_system(starbow::testing::source_dir() / "scenes/solar-system/globes.json");
    return system;
}

std::size_t index_of(const std::string& name)
{
    const std::vector<Globe>& globes = solar_system().globes;
    const auto at = std::find_if(globes.begin(), globes.end(), [&](const Globe& globe) { return globe.name == name; });
    EXPECT_NE(at, globes.end()) << name;
    return std::size_t(at - globes.begin());
}

const nlohmann::json& witness()
{
    static const nlohmann::json dates = nlohmann::json::parse(
        starbow::testing::read_text(starbow::testing::source_dir() / "tests/world/ephemeris_witness.json"))["dates"];
    return dates;
}

dvec3 vector_of(const nlohmann::json& at) { return {at[0], at[1], at[2]}; }

/// The mean obliquity of J2000 by IAU 1976; the witness's ecliptic is that of its own library, within 0.1 seconds of arc.
dvec3 equatorial_of(const dvec3& ecliptic)
{
    const double e = 23.4392911 * degree;
    return {ecliptic.x, ecliptic.y * std::cos(e) - ecliptic.z * std::sin(e),
        ecliptic.y * std::sin(e) + ecliptic.z * std::cos(e)};
}

/// The argument of globe_places_m at which its terrestrial time is the witness's.
double days_of(const nlohmann::json& date) { return double(date["jd_tt"]) - 2451545 - ahead_of_utc_s / 86400; }

/// Latitude and eastward longitude in degrees.
dvec2 place_of(const dvec3& own)
{
    return {std::atan2(own.z, std::hypot(own.x, own.y)) / degree, std::atan2(own.y, own.x) / degree};
}

double turned(double a, double b) { return std::abs(std::remainder(a - b, 360)); }

const std::vector<std::string> planets{"Mercury", "Venus", "Earth", "Mars", "Jupiter", "Saturn", "Uranus", "Neptune"};

GlobeSky sky_of_2026() { return {{}, double(witness()[4]["jd_ut1"]) - 2451545, "Earth"}; }

/// A place among the globes, scene units of a light-second.
EyeAmongGlobes eye_at(const dvec3& place, double time = 0)
{
    return {place, time, world_from_equatorial({0, 0}), light_m_s, 1};
}

} // namespace

TEST(Ephemeris, PlanetsStandWhereAnotherLibraryHasThem)
{
    std::map<std::string, dvec2> worst;
    for (const auto& date : witness()) {
        const std::vector<dvec3> places = globe_places_m(solar_system(), days_of(date));
        const dvec3 earth = places[index_of("Earth")];
        const auto& all = date["heliocentric_ecliptic_au"];
        const dvec3 true_earth = equatorial_of(vector_of(all["Earth"]));
        for (const std::string& name : planets) {
            const dvec3 place = places[index_of(name)], truth = equatorial_of(vector_of(all[name]));
            worst[name].x = std::max(worst[name].x, angle_between(place, truth) / degree);
            if (name != "Earth")
                worst[name].y = std::max(worst[name].y, angle_between(place - earth, truth - true_earth) / degree);
            EXPECT_NEAR(glm::length(place) / (glm::length(truth) * astronomical_unit_m), 1, 2e-3) << name << date["utc"];
        }
    }
    for (const auto& [name, off] : worst) {
        std::printf("%s: %.4f degrees from the Sun, %.4f from the Earth\n", name.c_str(), off.x, off.y);
        EXPECT_LT(off.x, 0.1) << name;
        EXPECT_LT(off.y, 0.1) << name;
    }
}

TEST(Ephemeris, TheMoonStandsWhereAnotherLibraryHasIt)
{
    for (const auto& date : witness()) {
        const std::vector<dvec3> places = globe_places_m(solar_system(), days_of(date));
        const dvec3 moon = places[index_of("Moon")] - places[index_of("Earth")];
        const dvec3 truth = equatorial_of(vector_of(date["moon_geocentric_ecliptic_km"])) * 1000.0;
        const double off = angle_between(moon, truth) / degree;
        std::printf("%s: %.4f degrees, %.1f km\n", std::string(date["utc"]).c_str(), off,
            (glm::length(moon) - glm::length(truth)) / 1000);
        EXPECT_LT(off, 0.02) << date["utc"];
        EXPECT_NEAR(glm::length(moon), glm::length(truth), 50e3) << date["utc"];
    }
}

TEST(Ephemeris, TheEarthTurnsUnderTheSun)
{
    const Globe& earth = solar_system().globes[index_of("Earth")];
    for (const auto& date : witness()) {
        const dvec3 sun = -globe_places_m(solar_system(), days_of(date))[index_of("Earth")];
        const dvec2 place = place_of(globe_turn(earth, double(date["jd_ut1"]) - 2451545) * sun);
        const auto& truth = date["sub_solar_earth"];
        std::printf("%s: latitude %+.4f, longitude %+.4f\n", std::string(date["utc"]).c_str(), place.x - double(truth[0]),
            std::remainder(place.y - double(truth[1]), 360));
        // The witness's Sun is the apparent one, 0.0057 degrees back; nutation adds up to 0.005.
        EXPECT_NEAR(place.x, double(truth[0]), 0.02) << date["utc"];
        EXPECT_LT(turned(place.y, double(truth[1])), 0.02) << date["utc"];
    }
}

TEST(Ephemeris, GlobesTurnTheSameSidesToTheEarth)
{
    std::map<std::string, dvec2> worst;
    for (const auto& date : witness()) {
        const std::vector<dvec3> places = globe_places_m(solar_system(), days_of(date));
        for (std::string name : {"Sun", "Mercury", "Venus", "Mars", "Jupiter", "Saturn", "Uranus", "Neptune", "Moon"}) {
            const std::size_t i = index_of(name);
            const dvec2 place
                = place_of(globe_turn(solar_system().globes[i], days_of(date)) * (places[index_of("Earth")] - places[i]));
            std::string key = name;
            key[0] = char(std::tolower(key[0]));
            const auto& truth = date["sub_earth_" + key];
            const double across = std::cos(place.x * degree); // a degree of longitude is shorter near a pole
            worst[name] = glm::max(
                worst[name], dvec2(std::abs(place.x - double(truth[0])), turned(place.y, double(truth[1])) * across));
        }
    }
    for (const auto& [name, off] : worst) {
        std::printf("%s: latitude %.4f, longitude %.4f\n", name.c_str(), off.x, off.y);
        EXPECT_LT(off.x, 0.1) << name;
        EXPECT_LT(off.y, 0.1) << name;
    }
}

TEST(Ephemeris, AGlobeIsSeenWhereItWasWhenItsLightLeft)
{
    const WorldOrigin origin = world_origin(solar_system(), sky_of_2026());
    double worst_m = 0;
    for (const dvec3& place :
        {dvec3(0, 0, 0.03), dvec3(300, -200, 100), dvec3(-4000, 9000, 16000), dvec3(30000, 20000, 1000)})
        for (const double time : {0.0, 4e5})
            for (const SeenGlobe& seen : globes_seen(solar_system(), origin, eye_at(place, time))) {
                // The instant whose light arrives now, by bisection over a hundred thousand seconds.
                const dmat3 turn = world_from_equatorial({0, 0});
                const auto from_eye = [&](double at) {
                    return turn
                        * ((globe_places_m(solar_system(), origin.days + at / 86400)[seen.globe] - origin.at(at))
                            / light_m_s)
                        - place;
                };
                double early = time - 1e5, late = time;
                for (int i = 0; i < 70; ++i) {
                    const double middle = 0.5 * (early + late);
                    (time - middle > glm::length(from_eye(middle)) ? early : late) = middle;
                }
                worst_m = std::max(worst_m, glm::length(seen.from_eye - from_eye(early)) * light_m_s);
                const Globe& globe = solar_system().globes[seen.globe];
                const dmat3 own = globe_turn(globe, origin.days + early / 86400) * glm::transpose(turn);
                for (int k = 0; k < 3; ++k)
                    EXPECT_LT(glm::length(seen.own_from_world[k] - own[k]), 1e-7) << globe.name;
            }
    // A day is a double of seconds within a microsecond, in which a planet moves by a few centimetres.
    std::printf("worst: %.4f m\n", worst_m);
    EXPECT_LT(worst_m, 1);
}

/// On a logarithmic way from 10 km above the Earth to 10 light-hours and back, no globe jumps or jitters.
TEST(Ephemeris, GlobesMoveWithoutJumpsOnALongWay)
{
    const WorldOrigin origin = world_origin(solar_system(), sky_of_2026());
    constexpr int steps = 2000;
    constexpr double nearest_m = 10e3, farthest_m = 36000 * light_m_s;
    const dvec3 outward = glm::normalize(dvec3(0.3, 0.8, -0.5)), aside = glm::normalize(glm::cross(outward, dvec3(0, 0, 1)));
    /// step: 0 to 2000, there and back.
    const auto place = [&](double step) {
        const double part = 1 - std::abs(step / (steps / 2) - 1);
        const double height = nearest_m * std::pow(farthest_m / nearest_m, part);
        return (outward * (6378136.6 + height) + aside * (0.2 * height)) / light_m_s;
    };
    std::map<std::size_t, SeenGlobe> before;
    double worst_jump = 0, worst_jitter = 0;
    for (int step = 0; step <= steps; ++step) {
        const dvec3 here = place(step);
        const std::vector<SeenGlobe> all = globes_seen(solar_system(), origin, eye_at(here));
        ASSERT_EQ(all.size(), solar_system().globes.size()) << step;
        // Three places a millionth of the distance apart: rounding would show as a bend.
        const double small = 1e-6;
        std::map<std::size_t, std::array<dvec3, 3>> three;
        for (int k = 0; k < 3; ++k) {
            const dvec3 there = here + outward * (small * k * glm::length(here));
            for (const SeenGlobe& seen : globes_seen(solar_system(), origin, eye_at(there)))
                three[seen.globe][std::size_t(k)] = seen.from_eye;
        }
        for (const SeenGlobe& seen : all) {
            const Globe& globe = solar_system().globes[seen.globe];
            const auto& [a, b, c] = three[seen.globe];
            worst_jitter = std::max(worst_jitter, glm::length(a - 2.0 * b + c) * light_m_s / globe.radius_m);
            if (before.contains(seen.globe)) {
                // The place where it is seen changes by its motion during the change of the light's time, at most 70 km/s.
                const SeenGlobe& last = before.at(seen.globe);
                const dvec3 last_place = last.from_eye + place(step - 1);
                const double moved = glm::length(seen.from_eye + here - last_place) * light_m_s;
                const double light_s = std::abs(seen.distance - last.distance);
                worst_jump = std::max(worst_jump, (moved - 80e3 * light_s) / globe.radius_m);
                // The axes turn by the rotation in that time; the fastest takes ten hours.
                const double turn = glm::length(seen.own_from_world[0] - last.own_from_world[0]);
                EXPECT_LT(turn, 2 * pi / (9.5 * 3600) * light_s + 1e-7) << globe.name << step;
            }
            before.insert_or_assign(seen.globe, seen);
        }
    }
    std::printf("jump %.2e, jitter %.2e of a radius\n", worst_jump, worst_jitter);
    EXPECT_LT(worst_jump, 1e-6);
    EXPECT_LT(worst_jitter, 1e-6);
}

} // namespace ephemeris_test
