// A highlight's ring stands where its thing is seen: at rest, on a ship that turns, and at a globe, by formulas that share
// no code with the program's; in every shipped tour it is in the picture for as long as its step lasts.
#include "config/model/shipped.h"
#include "runtime/flight/tour_film.h"
#include "runtime/hud/highlights.h"
#include "runtime/world/open_scene.h"
#include "tests/support/files.h"
#include "tests/support/shots.h"
#include "tests/support/tour_frame.h"
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace highlights_test {

using namespace starbow;
using namespace starbow::testing;
using glm::dvec2, glm::dvec3;

namespace {

Frame frame_of(const Shot& shot)
{
    return {.time = shot.time,
        .at = shot.position,
        .u = shot.u,
        .cockpit = shot.ship_from_cockpit,
        .aberration = shot.effects[Effect::aberration]};
}

double apart_deg(const dvec3& a, const dvec3& b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / degree;
}

World bare_world(const SceneFile& scene) { return scene.globes ? load_world(scene) : World{}; }

/// The part of a sky, J2000, from the ways north and west of straight ahead.
dvec3 star(double distance, double ra_deg, double dec_deg, const dvec2& ahead_deg)
{
    const auto unit = [](double ra, double dec) {
        return dvec3(std::cos(dec * degree) * std::cos(ra * degree), std::cos(dec * degree) * std::sin(ra * degree),
            std::sin(dec * degree));
    };
    const dvec3 ahead = unit(ahead_deg.x, ahead_deg.y), west = glm::normalize(glm::cross(ahead, dvec3(0, 0, 1))),
                north = glm::cross(west, ahead), n = unit(ra_deg, dec_deg);
    return distance * dvec3(glm::dot(n, west), glm::dot(n, north), -glm::dot(n, ahead));
}

/// The place of a shipped tour's highlighted thing when its light left, and the greatest error of the ring, degrees.
struct Thing {
    std::function<dvec3(const Frame&)> at;
    double within_deg = 0.05;
};
const std::map<std::string, Thing>& things()
{
    const dvec2 proxima(217.429, -62.6795);
    const auto still = [](const dvec3& at) { return Thing{[at](const Frame&) { return at; }}; };
    static const std::map<std::string, Thing> all{
        {"first-minute.mark", still({0, 0, -46})}, // scenes/avenue/make.py: the column at the end
        {"simultaneity.left", still({-10, 0, 0})},
        {"simultaneity.middle", still({0, 0, 0})},
        {"simultaneity.right", still({10, 0, 0})}, // five clocks in a row, five apart
        // Light that arrives abreast has D = 1 / gamma; the tour's ship flies to -x at half the speed of light.
        {"rainbow.abreast",
            {[](const Frame& frame) {
                 double ahead = 0, behind = 40;
                 for (int i = 0; i < 60; ++i) {
                     const double x = 0.5 * (ahead + behind);
                     (frame.D({x, 0, -3}) > std::sqrt(0.75) ? ahead : behind) = x;
                 }
                 return dvec3(ahead, 0, -3);
             },
                0.1}},
        {"twins.home", still({-1.3, 0, 0})},
        {"twins.traveller", {travellers_dial, 1}}, // that is astern of the ship's origin by 0.05 of 3.4
        {"street.mark", still({5, 1.7, -2.257})}, // 4 m beside the rider where the step begins
        // The world's origin moves with the Earth, evenly: after 76 minutes the Earth is 63 km beside it, 4403 light-seconds
        // away.
        {"solar-system.earth_mark", still({0, 0, 0})},
        // Its place at the arrival by the tour's own numbers; 76 minutes before it was 0.15 light-seconds away, by 9.7 km/s.
        {"solar-system.saturn_mark", {[](const Frame&) { return dvec3(-1064.787, 245.624, -4265.775); }, 3}},
        {"voyage.proxima_mark", {[=](const Frame&) { return star(4.2441, 217.429, -62.6795, proxima); }, 0.05}},
        // SIMBAD: Alpha Centauri, 742.12 milliseconds of arc; Alcyone among the Pleiades; Sagittarius A*.
        {"voyage.alpha_mark", {[=](const Frame&) { return star(4.3949, 219.902, -60.834, proxima); }, 0.1}},
        {"voyage.sisters_mark", {[=](const Frame&) { return star(403, 56.871, 24.105, proxima); }, 0.1}},
        {"voyage.centre_mark", {[=](const Frame&) { return star(26673, 266.4168, -29.0078, proxima); }, 0.1}},
    };
    return all;
}

} // namespace

// The direction of light from a resting place is (1, -n) boosted; a ball's circle is that of its edges.
TEST(Highlights, AThingAtRestIsHighlightedWhereItIsSeen)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int i = 0; i < 300; ++i) {
        Shot shot = shot_at({any(random), any(random), any(random)}, 4.0 * dvec3(any(random), any(random), any(random)));
        shot.ship_from_cockpit = glm::normalize(glm::dquat(any(random), any(random), any(random), any(random)));
        shot.effects.on.set(Effect::aberration, i % 3 != 0);
        const Highlight highlight{.at = 20.0 * glm::normalize(dvec3(any(random), any(random), any(random))), .across = 0.2};
        const auto seen = seen_highlight(highlight, shot, World{}, SceneFile{});
        ASSERT_TRUE(seen);
        const Frame frame = frame_of(shot);
        EXPECT_LT(apart_deg(seen->towards, frame.seen(highlight.at)), 1e-6);
        // A small ball's radius over D: the next term is its square, 1e-4 of it.
        const double D = frame.aberration ? frame.D(highlight.at) : 1;
        EXPECT_NEAR(seen->radius, 0.1 / frame.away(highlight.at) / D, 2e-4 * seen->radius);
    }
    const auto within
        = seen_highlight({.at = {0, 0, 0.1}, .across = 1}, shot_at({0, 0, 0}, {0, 0, 0}), World{}, SceneFile{});
    EXPECT_EQ(within->radius, pi / 2) << "the ship is within the thing";
}

// The traveller's dial, 0.05 astern of the ship's middle: found by trying the clock's readings one by one.
TEST(Highlights, AShipThatTurnsIsHighlightedWhereItIsSeen)
{
    const SceneFile scene = open_scene(shipped_file("scenes", "twins"));
    const Highlight highlight{.body = "traveller", .at = {0, 0, 0.08 * 0.62}, .across = 1.24};
    int checked = 0;
    for (const double beta : {0.0, 0.5})
        for (double time = -3; time < 24; time += 0.25) {
            Shot shot = shot_at({0, 0.15, 3.4}, dvec3(0, 0, -beta / std::sqrt(1 - beta * beta)));
            shot.time = time;
            const Frame frame = frame_of(shot);
            const auto seen = seen_highlight(highlight, shot, World{}, scene);
            if (std::isnan(travellers_clock(frame)))
                continue; // its two ways meet within a ten-thousandth of a second
            ASSERT_TRUE(seen) << time;
            const bool rests = travellers_clock(frame) <= 0 || travellers_clock(frame) >= 12;
            const dvec3 dial = rests ? dvec3(1.3, 0, 0.08 * 0.62) : travellers_dial(frame);
            EXPECT_LT(apart_deg(seen->towards, frame.seen(dial)), 0.05) << time << ' ' << beta;
            ++checked;
        }
    EXPECT_GT(checked, 180);
}

TEST(Highlights, AGlobeIsHighlightedWithItsOwnSize)
{
    const SceneFile scene = open_scene(shipped_file("scenes", "solar-system"));
    const World world = load_world(scene);
    for (const double u : {0.0, 2.0}) {
        const Shot shot = shot_at({3, 0, 4}, dvec3(0, 0, -u));
        const Frame frame = frame_of(shot);
        const auto seen = seen_highlight({.globe = "Earth"}, shot, world, scene);
        ASSERT_TRUE(seen);
        EXPECT_LT(apart_deg(seen->towards, frame.seen({0, 0, 0})), 1e-3);
        EXPECT_NEAR(seen->radius, 6378.1 / 299792.458 / 5 / frame.D({0, 0, 0}), 1e-4 * seen->radius);
    }
}

TEST(Highlights, NothingIsHighlightedWhereThingsStandElsewhere)
{
    Shot shot = shot_at({0, 0, 0}, {0, 0, -1});
    for (const Comparison comparison : {Comparison::no_light_delay, Comparison::galilean}) {
        shot.effects.comparison = comparison;
        EXPECT_FALSE(seen_highlight({.at = {0, 0, -5}, .across = 1}, shot, World{}, SceneFile{}));
    }
    SceneFile scene;
    scene.bodies
        = {{.name = "flash", .worldline = {{.time = 0, .position = {0, 0, -5}}, {.time = 1, .position = {0, 0, -5}}}}};
    shot.effects.comparison = Comparison::none;
    for (const auto& [time, seen] : {std::pair{4.9, false}, {5.1, true}, {5.9, true}, {6.1, false}}) {
        shot.time = time;
        EXPECT_EQ(seen_highlight({.body = "flash", .across = 1}, shot, World{}, scene).has_value(), seen) << time;
    }
}

TEST(Highlights, EveryHighlightOfEveryTourIsAtItsThingAndInThePicture)
{
    std::map<std::string, std::string> key_of; // by the English name
    for (const auto& [key, text] : words().texts)
        for (const auto& [name, thing] : things())
            if (key == "tour." + name)
                key_of[text] = name;
    std::map<std::string, long> frames;
    struct InView {
        bool now = false; ///< in the last frame
        long in = 0, all = 0;
    };
    std::map<std::tuple<std::filesystem::path, std::size_t, std::string>, InView> steps;
    for (const auto& [file, tour, half_view_deg] : shown_tours()) {
        const SceneFile scene = open_scene(scene_of(tour));
        EXPECT_NO_THROW(check_highlights(tour, scene));
        const World world = bare_world(scene);
        const Show show{tour, {}, unit_s_of(file), false};
        TourFilm film(show, 4);
        for (long i = 0; i < film.frames(); ++i) {
            const Touring& touring = film.at(i);
            const Step& step = tour.steps[touring.step()];
            const Frame frame = starbow::testing::frame_of(touring);
            for (const Highlight& highlight : step.highlights) {
                SCOPED_TRACE(file.stem().string() + ", step " + std::to_string(touring.step()) + ", " + highlight.name);
                ASSERT_TRUE(key_of.contains(highlight.name)) << "a thing that is not listed here";
                const Thing& thing = things().at(key_of[highlight.name]);
                const auto seen = seen_highlight(highlight, shot_of(touring.flight, tour.scene), world, scene);
                ASSERT_TRUE(seen);
                EXPECT_LT(apart_deg(seen->towards, frame.seen(thing.at(frame))), thing.within_deg);
                const dvec2 at = dvec2(seen->towards.x, seen->towards.y) / (-seen->towards.z * std::tan(30 * degree));
                InView& view = steps[{file, touring.step(), highlight.name}];
                view.now = seen->towards.z < 0 && std::abs(at.x) < 16. / 9 && std::abs(at.y) < 1;
                view.in += view.now, ++view.all;
                ++frames[key_of[highlight.name]];
            }
        }
    }
    for (const auto& [where, view] : steps) { // a view that turns to a thing shows it at its end
        EXPECT_TRUE(view.now && view.in > 0.4 * double(view.all))
            << std::get<0>(where) << ", step " << std::get<1>(where) << ", " << std::get<2>(where)
            << ": in a picture of 16 to 9 in " << view.in << " of " << view.all << " frames";
    }
    for (const auto& [name, thing] : things())
        EXPECT_GT(frames[name], 0) << name << " is in no tour";
}

TEST(Highlights, ASmallThingIsEnlargedAndFillsItsInset)
{
    for (double across = 0.001; across < 5.9; across *= 1.07) {
        const double field = enlarged_fov_deg({.radius = 0.5 * across * degree}, enlarged_below_deg, 0);
        EXPECT_GT(across / field, 0.45) << across;
        EXPECT_LE(across / field, 0.8 + 1e-9) << across;
        // While it grows the field stays for as long as it suits, and is never so small that the thing is cut.
        for (const double grown : {1.05, 1.2}) {
            const double kept = enlarged_fov_deg({.radius = 0.5 * grown * across * degree}, enlarged_below_deg, field);
            EXPECT_TRUE(kept == 0 || grown * across < kept) << across;
        }
    }
    const SeenHighlight large{.radius = 3.1 * degree};
    EXPECT_EQ(enlarged_fov_deg(large, enlarged_below_deg, 0), 0);
    EXPECT_GT(enlarged_fov_deg(large, enlarged_below_deg, 8), 0) << "it stays a little longer than it comes";
    EXPECT_EQ(enlarged_fov_deg({.radius = 0}, enlarged_below_deg, 0), 0) << "a point stays a point";

    const Highlight one{.name = "one", .at = {0, 0, -10}, .across = 1.5, .enlarged = true}; // 8.6 degrees
    Highlight other = one;
    other.at.x = 3;
    const Shot shot = shot_at({0, 0, 0}, {0, 0, 0});
    std::array<double, 2> before{};
    EXPECT_EQ(shown_highlights({one}, shot, World{}, SceneFile{}, before)[0].enlarged_deg, 0);
    const std::vector<ShownHighlight> both = shown_highlights({one, other}, shot, World{}, SceneFile{}, before);
    ASSERT_EQ(both.size(), 2u);
    EXPECT_EQ(both[0].name, "one");
    EXPECT_GT(both[0].enlarged_deg, 8.5) << "two that are compared stand side by side";
    EXPECT_EQ(both[0].enlarged_deg, before[0]);
    EXPECT_EQ(both[1].enlarged_deg, before[1]);
}

TEST(Highlights, TheRingIsAroundTheMiddleAndTheNameAboveIt)
{
    const Typesetter typesetter;
    const double degree_px = 10, ring_px = 40;
    for (const std::string name : {"A", "the middle of the galaxy, far away"}) {
        const Panel panel = draw_ring(typesetter, name, ring_px, degree_px);
        ASSERT_EQ(panel.texels.size(), 2 * std::size_t(panel.size.x) * std::size_t(panel.size.y));
        const dvec2 middle(0.5 * panel.size.x, panel.size.y - ring_middle_px(ring_px, degree_px));
        double light = 0, away = 0, above = 0;
        for (int y = 0; y < panel.size.y; ++y)
            for (int x = 0; x < panel.size.x; ++x) {
                const double bright = panel.texels[2 * (std::size_t(y) * panel.size.x + x)] / 255.0;
                const double from = glm::distance(dvec2(x, y) + 0.5, middle);
                if (from < ring_px + 4)
                    light += bright, away += bright * std::abs(from - ring_px);
                else
                    above += bright * (y < middle.y - ring_px);
                if (from < ring_px - 5) {
                    EXPECT_EQ(panel.texels[2 * (std::size_t(y) * panel.size.x + x) + 1], 0) << "the thing stays free";
                }
            }
        EXPECT_NEAR(light, 2 * pi * ring_px * 2.2, 0.1 * light) << "a ring of 0.22 degrees";
        EXPECT_LT(away / light, 1);
        EXPECT_GT(above, 20) << "letters";
    }
    EXPECT_EQ(ring_deg({.radius = 20 * degree}), 0) << "nobody needs a ring around a house before the nose";
    EXPECT_GT(ring_deg({.radius = 5 * degree}), 5);
    EXPECT_GT(ring_deg({.radius = 0}), 1);
}

TEST(Highlights, ABodyOrAGlobeThatTheSceneLacksIsRefused)
{
    const auto message = [](const char* scene, const Highlight& highlight) -> std::string {
        Tour tour{.file = "x.json", .scene = scene, .steps = {Step{.seconds = 1, .highlights = {{}, highlight}}}};
        try {
            check_highlights(tour, open_scene(shipped_file("scenes", scene)));
            return "";
        } catch (const InputError& error) {
            return error.what();
        }
    };
    EXPECT_EQ(message("twins", {.body = "traveller"}), "");
    EXPECT_EQ(message("solar-system", {.globe = "Saturn"}), "");
    EXPECT_EQ(message("twins", {.body = "nobody"}),
        "x.json: /steps/0/highlights/1/body: is nobody, but the scene twins has no such body; the name of one that it has "
        "is "
        "right");
    EXPECT_NE(message("twins", {.globe = "Saturn"}).find("no such globe"), std::string::npos);
    EXPECT_NE(message("solar-system", {.globe = "Vulcan"}).find("no such globe"), std::string::npos);
}

} // namespace highlights_test
