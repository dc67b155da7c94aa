// Names in the sky stand where their things are seen, none over another, and none before what hides its thing.
#include "config/model/shipped.h"
#include "runtime/hud/signs.h"
#include "runtime/hud/sky_labels.h"
#include "runtime/world/open_scene.h"
#include "tests/support/files.h"
#include "tests/support/shots.h"
#include "tests/support/tour_frame.h"
#include <gtest/gtest.h>

namespace sky_labels_test {

using namespace starbow;
using namespace starbow::testing;
using glm::dvec3;

namespace {

const SkyNames& names()
{
    static const SkyNames all = load_sky_names(source_dir() / "scenes/stars/names.json");
    return all;
}

double apart_deg(const dvec3& a, const dvec3& b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / degree;
}

/// By the letters' own widths, on a plane before the eye, in panels as they are drawn.
bool overlap(const SkyLabel& a, const SkyLabel& b)
{
    static const Typesetter typesetter;
    constexpr double degree_px = 20;
    const auto half = [&](const SkyLabel& label) {
        return 0.5 / degree_px * glm::dvec2(draw_name(typesetter, label.name, degree_px).size);
    };
    // From one to the other, across and up, degrees.
    const dvec3 right = glm::normalize(glm::cross(a.towards, dvec3(0, 1, 0))), up = glm::cross(right, a.towards);
    const glm::dvec2 away
        = apart_deg(a.towards, b.towards) * glm::normalize(glm::dvec2(glm::dot(b.towards, right), glm::dot(b.towards, up)));
    const glm::dvec2 room = half(a) + half(b);
    return std::abs(away.x) < 0.95 * room.x && std::abs(away.y) < 0.95 * room.y; // the plates' rounded corners may touch
}

const SkyLabel* find(const std::vector<SkyLabel>& labels, const std::string& name)
{
    const auto found = std::ranges::find(labels, name, &SkyLabel::name);
    return found == labels.end() ? nullptr : &*found;
}

} // namespace

// Orion's Rigel: 78.634 and -8.202 degrees; the scene's straight ahead is at 84 and -5 degrees.
TEST(SkyLabels, ANameIsAtItsStarAndMovesWithIt)
{
    const SceneFile scene = open_scene(shipped_file("scenes", "twins"));
    ASSERT_EQ(scene.stars->ahead_deg, glm::dvec2(84, -5));
    const double ra = (78.634 - 84) * degree, dec = -8.202 * degree, tilt = 5 * degree;
    const dvec3 from_equator(-std::cos(dec) * std::sin(ra), std::sin(dec), -std::cos(dec) * std::cos(ra));
    const dvec3 star(from_equator.x, from_equator.y * std::cos(tilt) - from_equator.z * std::sin(tilt),
        from_equator.z * std::cos(tilt) + from_equator.y * std::sin(tilt));
    for (const double u : {0.0, 0.5, 1.0}) {
        const Shot shot = shot_at({0, 0, 0}, {0, 0, -u});
        const std::vector<SkyLabel> labels = sky_labels(names(), shot, World{}, scene, "en");
        const SkyLabel* seen = find(labels, "Rigel");
        if (u == 0) {
            ASSERT_TRUE(seen);
            ASSERT_TRUE(find(labels, "Orion"));
        }
        if (seen) { // at speed another name may be too near
            const Frame frame{.at = shot.position, .u = shot.u, .cockpit = shot.ship_from_cockpit};
            EXPECT_LT(apart_deg(seen->towards, frame.seen(1e9 * star)), 0.02) << u;
        }
    }
    EXPECT_TRUE(find(sky_labels(names(), shot_at({0, 0, 0}, {0, 0, 0}), World{}, scene, "de"), "Stier"));
}

TEST(SkyLabels, NoneStandsOverAnother)
{
    const SceneFile scene = open_scene(shipped_file("scenes", "twins"));
    for (const double u : {0.0, 1.0, 4.0, 100.0})
        for (int i = 0; i < 24; ++i) {
            Shot shot = shot_at({0, 0, 0}, {0, 0, -u});
            shot.ship_from_cockpit = glm::angleAxis(i * 15 * degree, dvec3(0, 1, 0));
            const std::vector<SkyLabel> labels = sky_labels(names(), shot, World{}, scene, "en");
            EXPECT_LE(labels.size(), most_sky_labels);
            if (u < 2) {
                EXPECT_GE(labels.size(), 10u);
            }
            for (std::size_t a = 0; a < labels.size(); ++a)
                for (std::size_t b = 0; b < a; ++b)
                    EXPECT_FALSE(overlap(labels[a], labels[b])) << labels[a].name << ", " << labels[b].name;
        }
}

TEST(SkyLabels, GlobesAreNamedAndHideWhatIsBehind)
{
    const SceneFile scene = open_scene(shipped_file("scenes", "solar-system"));
    const World world = load_world(scene);
    // Six Earth's radii away: the Earth, 9.6 degrees in radius, hides what is behind it.
    const double earth_s = 6378.1 / 299792.458, away = 6 * earth_s;
    for (const dvec3& from : {dvec3(away, 0, 0), dvec3(0, 0, away), dvec3(-away, 0, 0), dvec3(0, 0, -away)}) {
        Shot shot = shot_at(from, {0, 0, 0});
        shot.ship_from_cockpit = orientation(-from, {0, 1, 0});
        const std::vector<SkyLabel> labels = sky_labels(names(), shot, world, scene, "de");
        ASSERT_FALSE(labels.empty());
        ASSERT_TRUE(find(labels, "Erde"));
        EXPECT_LT(apart_deg(find(labels, "Erde")->towards, {0, 0, -1}), 0.01);
        for (const SkyLabel& label : labels)
            EXPECT_TRUE(label.name == "Erde" || apart_deg(label.towards, {0, 0, -1}) > 9.5) << label.name;
    }
    // Near the ground it fills the picture, and everybody knows what it is.
    EXPECT_FALSE(find(sky_labels(names(), shot_at({0, 0, 1.1 * earth_s}, {0, 0, 0}), world, scene, "en"), "Earth"));
}

TEST(SkyLabels, FiguresBelongToTheSunsNeighbourhood)
{
    SceneFile scene = open_scene(shipped_file("scenes", "twins"));
    EXPECT_TRUE(figures_fit(shot_at({0, 0, 0}, {0, 0, 0}), scene));
    const Shot far = shot_at({2e7, 0, 0}, {0, 0, 0}); // light-seconds: two thirds of a year
    EXPECT_FALSE(figures_fit(far, scene));
    EXPECT_TRUE(sky_labels(names(), far, World{}, scene, "en").empty());
    scene.stars.reset();
    EXPECT_FALSE(figures_fit(shot_at({0, 0, 0}, {0, 0, 0}), scene));
    // Hills of a world with a horizon hide what is low.
    const SceneFile clocks = open_scene(shipped_file("scenes", "clocks"));
    for (const SkyLabel& label : sky_labels(names(), shot_at({0, 0, 31}, {0, 0, 0}), World{}, clocks, "en"))
        EXPECT_GT(label.towards.y, std::sin(7.9 * degree)) << label.name;
}

} // namespace sky_labels_test
