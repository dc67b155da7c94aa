// The shipped voyage against closed forms: hyperbolic motion at one g, at the end of each leg, to 1e-9.
#include "config/model/angles.h"
#include "config/model/scene_file.h"
#include "config/model/shipped.h"
#include "config/model/tour_file.h"
#include "runtime/flight/measuring.h"
#include "runtime/flight/tour_motion.h"
#include "runtime/world/stars.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>

namespace starbow::voyage_test {
namespace {

using namespace starbow::testing;

constexpr long double year_s = 365.25L * 86400, c = 299792458, g = 9.80665L, a = g * year_s / c; // per year

struct Voyage {
    Tour tour = load_tour(source_dir() / "config/tours/voyage.json", words(),
        [](const std::string& name) { return source_dir() / "config/shots" / (name + ".json"); });
    SceneFile scene = load_scene_file(scene_of(tour));

    /// The ship at the end of each step that has a motion.
    std::vector<Ship> ends() const
    {
        std::vector<Ship> all;
        Ship ship;
        for (const Step& step : tour.steps) {
            if (const Cut* cut = std::get_if<Cut>(&step.motion))
                ship = ship_at(cut->shot);
            ship = along(step, ship, 1, scene.seconds_per_time_unit());
            all.push_back(ship);
        }
        return all;
    }
};

/// A leg's numbers from rest, years and light-years: on board, at home, gamma.
struct Leg {
    long double ship, home, gamma;
};
/// Half of a way d, accelerated all the time: x = (cosh(a tau) - 1) / a, t = sinh(a tau) / a.
Leg half_of(long double d)
{
    const long double gamma = 1 + a * d / 2, ship = std::acosh(gamma) / a;
    return {ship, std::sqrt(gamma * gamma - 1) / a, gamma};
}

double years(const Ship& ship) { return ship.time.total(); }

TEST(Voyage, EveryLegIsTheClosedForm)
{
    const Voyage voyage;
    EXPECT_NEAR(voyage.scene.seconds_per_time_unit(), double(year_s), 1e-3); // a unit is a light-year, and a year
    const std::vector<Ship> ends = voyage.ends();
    const auto check = [&](std::size_t first, std::size_t last, long double d, bool brakes) {
        const Leg half = half_of(d);
        const Ship &middle = ends[first], &end = ends[last];
        EXPECT_NEAR(middle.proper_time.total() / double(half.ship), 1, 1e-9);
        EXPECT_NEAR(years(middle) / double(half.home), 1, 1e-9);
        EXPECT_NEAR(glm::length(middle.position.total()) / double(d / 2), 1, 1e-9);
        EXPECT_NEAR(std::sqrt(1 + glm::dot(middle.u.total(), middle.u.total())) / double(half.gamma), 1, 1e-9);
        if (!brakes)
            return;
        EXPECT_NEAR(end.proper_time.total() / double(2 * half.ship), 1, 1e-9);
        EXPECT_NEAR(years(end) / double(2 * half.home), 1, 1e-9);
        EXPECT_NEAR(glm::length(end.position.total()) / double(d), 1, 1e-9);
        EXPECT_LT(glm::length(end.u.total()), 1e-9 * double(half.gamma));
    };
    std::vector<std::size_t> thrusts;
    for (std::size_t i = 0; i < voyage.tour.steps.size(); ++i)
        if (std::holds_alternative<Thrust>(voyage.tour.steps[i].motion))
            thrusts.push_back(i);
    ASSERT_EQ(thrusts.size(), 5u);
    const long double parsec = 3.0856775814913673e16L / (year_s * c);
    // Parallaxes of the catalogue: 768.50 and 8.09 milliseconds of arc; the middle of the galaxy: 8178 parsecs (GRAVITY
    // 2019).
    check(thrusts[0], thrusts[1], parsec / 0.7685L - 0.01L, true);
    check(thrusts[2], thrusts[3], parsec / 0.00809L - 2, true);
    check(thrusts[4], thrusts[4], 8178 * parsec, false);
}

TEST(Voyage, SunlightRunsAfterAndNeverLaterLight)
{
    const Voyage voyage;
    const std::vector<Ship> ends = voyage.ends();
    for (std::size_t i = 0; i < ends.size(); ++i) {
        if (!std::holds_alternative<Thrust>(voyage.tour.steps[i].motion) || glm::length(ends[i].u.total()) < 1)
            continue;
        const Measure measure{.quantity = Measure::Quantity::reading_s, .at = {0, 0, 0}, .over = double(year_s)};
        const double seen = measured(measure, ends[i], ends[i], voyage.scene.seconds_per_time_unit());
        const long double tau = ends[i].proper_time.total();
        EXPECT_NEAR(seen, double((1 - std::exp(-a * tau)) / a), 1e-9 * years(ends[i])) << "t - x = (1 - e^(-a tau)) / a";
        EXPECT_LT(seen, double(1 / a));
    }
}

TEST(Voyage, TheStarsThatItNamesLieWhereItFlies)
{
    const Voyage voyage;
    const std::vector<Star> stars = stars_in_depth(*voyage.scene.stars);
    ASSERT_GT(stars.size(), 118'000u);
    const glm::dmat3 turn = world_from_equatorial(voyage.scene.stars->ahead_deg);
    const auto place = [&](double ra, double dec) { // light-years; J2000
        const Star* best = &stars[0];
        for (const Star& star : stars)
            if (glm::dot(star.direction, equatorial(ra, dec)) > glm::dot(best->direction, equatorial(ra, dec)))
                best = &star;
        return turn * best->direction * (best->distance_m / voyage.scene.unit_m);
    };
    const std::vector<Ship> ends = voyage.ends();
    std::vector<glm::dvec3> rests;
    for (std::size_t i = 0; i < ends.size(); ++i)
        if (std::holds_alternative<Thrust>(voyage.tour.steps[i].motion) && glm::length(ends[i].u.total()) < 1e-3)
            rests.push_back(ends[i].position.total());
    ASSERT_EQ(rests.size(), 2u);
    EXPECT_NEAR(glm::distance(rests[0], place(217.4290, -62.6795)), 0.01, 1e-4); // Proxima
    EXPECT_NEAR(glm::distance(rests[1], place(56.8712, 24.1051)), 2, 0.01); // Alcyone
    // From beside Proxima, alpha Centauri's two stars are a fifth of a light-year away.
    EXPECT_NEAR(glm::distance(rests[0], place(219.9021, -60.8340)), 0.22, 0.06);
    // The Sun's direction is on the ecliptic.
    const glm::dvec3 sun = equatorial(voyage.scene.stars->sun_deg->x, voyage.scene.stars->sun_deg->y);
    EXPECT_NEAR(glm::dot(sun, glm::dvec3(0, -std::sin(23.4393 * degree), std::cos(23.4393 * degree))), 0, 0.005);
}

// From Proxima the Sun has magnitude 0.4, in Cassiopeia: its absolute magnitude of 4.83 at 1.3 parsecs.
TEST(Voyage, TheSunIsAStarAmongOthers)
{
    const Voyage voyage;
    const StarField field = star_field(stars_in_depth(*voyage.scene.stars), *voyage.scene.stars, voyage.scene.unit_m);
    std::vector<shared::StarEntry> entries(field.stars.size());
    const glm::dvec3 ship(0, 0, -4.244);
    stars_from(field, ship, entries);
    const double unit = voyage.scene.stars->brightness_arcmin2 * std::pow(degree / 60, 2);
    double back = 0;
    for (std::size_t i = 0; i < entries.size(); ++i)
        if (entries[i].direction.z > 0.9999999)
            back += entries[i].light.y / unit;
    EXPECT_NEAR(-2.5 * std::log10(back), 4.83 + 5 * std::log10(4.244 / 3.2615638 / 10), 0.02);
}

} // namespace
} // namespace starbow::voyage_test
