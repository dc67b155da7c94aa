// Tours while they run: compared with closed forms, at any frame rate, with and without visitors.
#include "config/model/shipped.h"
#include "input/scan.h"
#include "runtime/flight/measuring.h"
#include "runtime/flight/tour.h"
#include "runtime/hud/caption.h"
#include "runtime/world/clock.h"
#include "runtime/world/eye_event.h"
#include "runtime/world/instances.h"
#include "runtime/world/worldline.h"
#include "tests/support/controls.h"
#include "tests/support/dial.h"
#include "tests/support/files.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace tour_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

std::filesystem::path shipped_shot(const std::string& name) { return source_dir() / "config/shots" / (name + ".json"); }

Tour shipped_tour(const std::string& name)
{
    return load_tour(source_dir() / "config/tours" / (name + ".json"), words(), shipped_shot);
}

Tour tour_of(const std::string& steps)
{
    return load_tour(write_text("played.json", R"({ "scene": "avenue", "steps": [)" + steps + "] }"), words(), shipped_shot);
}

Touring played(const Show& show, double seconds, int frames_per_s, const Controls& controls = {})
{
    Touring touring = touring_at(show);
    std::int64_t before = 0;
    for (long frame = 1; frame <= std::lround(seconds * frames_per_s); ++frame) {
        const std::int64_t now = std::llround(double(frame) * 1e9 / frames_per_s);
        touring = advance(touring, show, controls, now - before);
        before = now;
    }
    return touring;
}

/// Advances a tour by this time, with 60 frames a second. Buttons count in the first frame only.
Touring later(Touring touring, const Show& show, double seconds, Controls controls = {})
{
    for (int frame = 0; frame < std::lround(60 * seconds); ++frame) {
        touring = advance(touring, show, controls, 16'666'667);
        controls = controls_with(
            Steering{.lever = controls.lever, .throttle_rate = controls.throttle_rate, .turn = controls.turn});
    }
    return touring;
}

glm::dvec3 place_of(const Touring& touring) { return touring.flight.ship.position.total(); }
glm::dvec3 u_of(const Touring& touring) { return touring.flight.ship.u.total(); }

/// The time at which a step begins in a tour that nobody flies, seconds. The questions of the steps before it are included.
double begin_of(const Show& show, std::size_t step)
{
    Touring touring = touring_at(show);
    double seconds = 0;
    while (touring.step() < step && !touring.over)
        touring = advance(touring, show, {}, 1'000'000), seconds += 0.001;
    return seconds;
}

/// The angular size of a small ball around a place straight ahead, by textbook aberration: tan(seen/2) = tan(true/2) /
/// e^rapidity.
long double seen_angle(const Touring& touring, const glm::dvec3& at, long double radius)
{
    const glm::dvec3 u = u_of(touring);
    const long double distance = glm::distance(place_of(touring), at), rapidity = std::asinh((long double)(glm::length(u)));
    return 2 * 2 * std::atan(std::tan(std::asin(radius / distance) / 2) * std::exp(-rapidity));
}

/// A clock's reading when its light left for the ship, by bisection.
double reading(const Touring& touring, const glm::dvec3& clock)
{
    const double now = touring.flight.ship.time.total();
    double low = now - 1e4, high = now; // light from `low` has passed, light from `high` is not here yet
    for (int i = 0; i < 100; ++i) {
        const double then = 0.5 * (low + high);
        (glm::distance(place_of(touring), clock) < now - then ? low : high) = then;
    }
    return 0.5 * (low + high);
}

constexpr const char* measured_size = R"({ "quantity": "size", "at": [0, 0, -46] })";

} // namespace

TEST(Tours, ATitleIsShownInItsStepsFirstSeconds)
{
    const Tour tour = tour_of(
        R"({ "seconds": 8, "cut": "start", "title": { "en": "One" }, "caption": { "en": "a" } }, { "seconds": 3, "caption": { "en": "b" } })");
    const Show show{tour, {}, 1, false};
    for (const auto& [seconds, title] : {std::pair{0., "One"}, {4.9, "One"}, {5.1, ""}, {7.9, ""}, {8.5, ""}, {12., ""}})
        EXPECT_EQ(title_of(played(show, seconds, 10), show), title) << seconds;
}

/// Each shipped tour begins with a title, and has another one after it, before the visitor flies.
TEST(Tours, ShippedToursBeginWithATitleAndEndWithASentence)
{
    for (const auto& file : shipped("config/tours")) {
        const Tour tour = shipped_tour(file.stem());
        EXPECT_NE(tour.steps.front().title, "") << file;
        std::size_t last = tour.steps.size();
        while (last > 0 && tour.steps[last - 1].title.empty())
            --last;
        EXPECT_GT(last, tour.steps.size() / 2) << file;
    }
}

/// docs/physics/relativity.md, (R28): from rest at the distance L with proper acceleration a, the size is smallest at e^eta
/// = 1 + aL, where it is 2 / (2 + aL). It has its first value again at e^eta = 1 + 2aL. Here L = 12 and a = 0.25.
TEST(Tours, TheFirstMinutesColumnFirstShrinks)
{
    const Tour tour = shipped_tour("first-minute");
    const Show show{tour, {}, 1, false};
    const glm::dvec3 column(0, 0, -46);
    constexpr double a = 0.25, L = 12;
    Touring touring = touring_at(show);
    ASSERT_NEAR(glm::distance(place_of(touring), column), L, 1e-12);
    const long double at_first = seen_angle(touring, column, 1e-6L);
    double smallest = 1, e_smallest = 0;
    std::size_t of = 0;
    while (!touring.over) {
        touring = advance(touring, show, {}, 10'000'000);
        const double size = double(seen_angle(touring, column, 1e-6L) / at_first),
                     E = std::exp(std::asinh(glm::length(u_of(touring))));
        if (touring.step() > 4)
            break;
        if (touring.step() == 2 || touring.step() == 4) {
            // The place of constant acceleration and the size there, in closed form.
            const double eta = std::log(E), x = (std::cosh(eta) - 1) / a;
            EXPECT_NEAR(place_of(touring).z, -34 - x, 1e-12 * 46);
            EXPECT_NEAR(size, L / (L - x) / E, 1e-9) << "a ball of 1e-6 equals a point up to its square, 1e-12";
        }
        const Measure measure{Measure::Quantity::size, column, {}};
        EXPECT_NEAR(measured(measure, touring.flight.ship, touring.starts.back().since, 1), size, 1e-9);
        if (size < smallest)
            smallest = size, e_smallest = E, of = touring.step();
    }
    EXPECT_NEAR(smallest, 2 / (2 + a * L), 1e-6) << "the smallest of all frames";
    EXPECT_NEAR(e_smallest, 1 + a * L, 0.02) << "a hundredth of a second near the flat minimum";
    EXPECT_GE(of, 2u);
    // The first thrust ends at the smallest size, the second at the first size again, exactly.
    const Touring least = played(show, begin_of(show, 3), 50);
    EXPECT_NEAR(std::exp(std::asinh(glm::length(u_of(least)))), 4, 1e-9);
    EXPECT_NEAR(double(seen_angle(least, column, 1e-6L) / at_first), 0.4, 1e-9);
    const Touring again = played(show, begin_of(show, 5), 50);
    EXPECT_NEAR(std::exp(std::asinh(glm::length(u_of(again)))), 7, 1e-9);
    EXPECT_NEAR(double(seen_angle(again, column, 1e-6L) / at_first), 1, 1e-9);
}

/// The clocks of docs/physics/relativity.md: -5.90909, -2.74403, 0, 2.21961, 3.80547 s relative to the middle one, in flight
/// and stopped.
TEST(Tours, SimultaneityShowsThePapersReadings)
{
    const Tour tour = shipped_tour("simultaneity");
    const Show show{tour, {}, 1, false};
    const double expected[] = {-5.90909, -2.74403, 0, 2.21961, 3.80547};
    const auto check = [&](const Touring& touring) {
        for (int i = 0; i < 5; ++i) {
            const glm::dvec3 clock(5 * (i - 2), 0, 0);
            EXPECT_NEAR(reading(touring, clock), expected[i], 1e-5) << i; // as many digits as are known
            const Measure measure{Measure::Quantity::reading_s, clock, {}};
            EXPECT_NEAR(measured(measure, touring.flight.ship, touring.flight.ship, 1), reading(touring, clock), 1e-9);
        }
    };
    Touring touring = played(show, begin_of(show, 3) + 1, 30);
    EXPECT_NEAR(glm::length(u_of(touring)), 0.5 / std::sqrt(0.75), 1e-12);
    check(touring);
    // The middle clock is seen at a right angle to the motion: in the world at cos = -beta.
    const glm::dvec3 way = -place_of(touring);
    EXPECT_NEAR(way.x / glm::length(way), -0.5, 1e-9);
    touring = played(show, begin_of(show, 6) + 1, 30);
    EXPECT_EQ(u_of(touring), glm::dvec3(0));
    check(touring);
    EXPECT_NEAR(touring.flight.ship.time.total(), 35.79571668975679, 1e-9) << "at the same instant";
}

/// One twin flies 8 light-seconds out and back at 0.8 c: gamma is 5/3, and 6 s on board are 10 s at home.
TEST(Tours, TheTwinsMeetAtTwentyAndTwelve)
{
    const Tour tour = shipped_tour("twins");
    const Show show{tour, {}, 1, false};
    const SceneFile scene = load_scene_file(source_dir() / "config/scenes/twins.json");
    World world = load_world(scene);
    place_bodies(world, scene);
    sort_instances(world);
    constexpr double deep
        = 0.08 * 0.62; // distance of each dial from its ship's middle, for those that face astern and those that face ahead

    // The readings on screen of those dials whose light has arrived. At the turn the traveller's may be seen twice.
    const auto shown = [&](const Flight& flight, const std::string& material, double way) {
        std::set<std::string> figures;
        const Shot shot = shot_of(flight, "twins");
        for (int frame = 0; frame < int(world.frames.size()); ++frame) {
            const Shot eye = in_frame(world.frames[std::size_t(frame)], shot);
            const auto entries = time_entries(world, {frame, eye.position, eye.time}, 1);
            for (std::size_t i = 0; i < entries.size(); ++i) {
                const Instance& instance = world.instances[instances_of(world, frame).first + i];
                const int index = world.primitives[instance.primitive].material;
                if (world.materials[std::size_t(index)].name == material && instance.frame_from_local[2].z * way > 0
                    && entries[i].there.x <= 0 && entries[i].there.y > 0)
                    figures.insert(dial_text(entries[i]));
            }
        }
        return figures.size() == 1 ? *figures.begin() : std::to_string(figures.size()) + " readings";
    };
    // The same by bisection, with the dial's way in the world calculated by hand, out and back.
    const auto traveller = [&](double own, double way) {
        const double ahead = -way * deep, on = own < 6 ? own : own - 6, g = 5.0 / 3, v = own < 6 ? 0.8 : -0.8;
        return std::pair(
            glm::dvec3(1.3, 0, -(own < 6 ? 0.0 : 8.0) - g * (ahead + v * on)), (own < 6 ? 0 : 10) + g * (on + v * ahead));
    };
    const auto seen = [&](const Flight& flight, double way) {
        double low = 0, high = 12;
        for (int i = 0; i < 60; ++i) {
            const double own = 0.5 * (low + high);
            const auto [place, time] = traveller(own, way);
            (time + glm::distance(flight.ship.position.total(), place) < flight.ship.time.total() ? low : high) = own;
        }
        return low;
    };
    const auto home = [&](const Touring& touring, double way) { return reading(touring, {-1.3, 0, way * deep}); };
    const auto tenths = [](double x) {
        std::array<char, 16> text;
        std::snprintf(text.data(), text.size(), "%.1f", x);
        return text.data() == std::string("-0.0") ? "0.0" : std::string(text.data());
    };

    // Each step at its beginning, and at its end a hundredth of a second before the next step.
    std::vector<Touring> first, last;
    for (Touring touring = touring_at(show); !touring.over; touring = advance(touring, show, {}, 10'000'000)) {
        if (touring.step() == first.size())
            first.push_back(touring), last.push_back(touring);
        last[touring.step()] = touring;
    }
    enum { here, leaves, far, at_question, returns, nearer, meet, aboard, before, turn, leap, homeward };
    ASSERT_GT(first.size(), std::size_t(homeward));

    EXPECT_EQ(shown(last[here].flight, "home dial", 1), "0.0");
    EXPECT_EQ(shown(last[here].flight, "traveller's dial", 1), "0.0");
    const struct {
        int step;
        double way; // the dial's side that is seen
        double rate; // the traveller's clock relative to the one at home, on the line between the two
    } flights[] = {{leaves, 1, 1 / 3.0}, {aboard, -1, 3}, {homeward, -1, 1 / 3.0}};
    for (const auto& [step, way, rate] : flights) {
        SCOPED_TRACE(step);
        const Touring &begun = first[std::size_t(step)], &ended = last[std::size_t(step)];
        for (const Touring& touring : {begun, ended}) {
            if (touring.flight.ship.time.total() > 4) { // the ship has left
                EXPECT_EQ(shown(touring.flight, "traveller's dial", way), tenths(seen(touring.flight, way)));
            }
            EXPECT_EQ(shown(touring.flight, "home dial", way), tenths(home(touring, way)));
        }
        const double board = seen(ended.flight, way) - seen(begun.flight, way), stayed = home(ended, way) - home(begun, way);
        EXPECT_NEAR(board / stayed / rate, 1, 0.1) << "the eye is a little aside of the line";
    }

    // The turn is seen while the whole dial is still on the way out. Its time at home decides which answer is right.
    EXPECT_EQ(shown(first[at_question].flight, "traveller's dial", 1), "6.0");
    EXPECT_EQ(shown(first[at_question].flight, "home dial", 1), "17.8");
    const Question& question = *tour.steps[at_question].question;
    const auto [place, time] = traveller(seen(first[at_question].flight, 1), 1);
    const double measured_s = measured(question.measure, first[at_question].flight.ship, first[at_question].flight.ship, 1);
    EXPECT_NEAR(measured_s, time, 1e-5) << "the tour names the place to 1e-6";
    EXPECT_NEAR(measured_s, 10, 0.14) << "0.04 s on board and the dial's depth before the turn";
    const auto& choices = std::get<std::vector<Choice>>(question.answer);
    ASSERT_EQ(choices.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(measured_s >= choices[i].from && measured_s < choices[i].below, i == 1);

    EXPECT_EQ(shown(first[meet].flight, "home dial", 1), "20.5");
    EXPECT_EQ(shown(first[meet].flight, "traveller's dial", 1), "12.5");

    // On board at the turn, 10 s at home: the present there is t - 0.8 * 8 before it and t + 0.8 * 8 after it, in the same
    // light.
    const auto now_at_home = [&](const Touring& touring, int step) {
        return measured(*tour.steps[std::size_t(step)].measure, touring.flight.ship, touring.flight.ship, 1);
    };
    EXPECT_NEAR(first[turn].starts[turn].flight.ship.time.total(), 10, 1e-9);
    EXPECT_NEAR(first[turn].starts[turn].flight.ship.position.total().z, -8, 1e-9);
    EXPECT_NEAR(now_at_home(first[turn], turn), 3.6, 1e-9);
    EXPECT_NEAR(now_at_home(first[leap], leap), 16.4, 1e-9);
    for (const Touring& touring : {first[turn], first[leap]})
        EXPECT_EQ(shown(touring.flight, "home dial", -1), "2.0");
}

/// docs/physics/relativity.md, (R8): at beta = 0.5, D is 1 at 74.45773 degrees from the motion.
TEST(Tours, TheRainbowShowsDOneAt74Degrees)
{
    const Tour tour = shipped_tour("rainbow");
    const Show show{tour, {}, 1, false};
    const Touring touring = played(show, begin_of(show, 4) + 1, 30);
    const glm::dvec3 u = u_of(touring);
    const double gamma = std::sqrt(1 + glm::dot(u, u)), beta = glm::length(u) / gamma;
    EXPECT_NEAR(beta, 0.5, 1e-12);
    EXPECT_LT(u.x, 0) << "the motion is to the left";
    const double degrees = 74.45773;
    EXPECT_NEAR(1 / (gamma * (1 - beta * std::cos(glm::radians(degrees)))), 1, 1e-7) << "D by its definition";
    const Measure measure{Measure::Quantity::own_colour_deg, {}, {}};
    EXPECT_NEAR(measured(measure, touring.flight.ship, touring.flight.ship, 1), degrees, 1e-5);
    // On screen it lies 29.5 degrees to the left of the view's middle, which looks 14 degrees behind the beam.
    const glm::dvec3 ahead = glm::normalize(u), look = touring.flight.ship.ship_from_cockpit * glm::dvec3(0, 0, -1);
    EXPECT_NEAR(glm::degrees(std::acos(glm::dot(ahead, look))), 104, 0.05);
}

/// The captions that name colours are shown only while these are in view, also on the narrowest screen: 4 to 3 with 60
/// degrees from top to bottom.
TEST(Tours, TheRainbowsCaptionsNameWhatIsInView)
{
    const Tour tour = shipped_tour("rainbow");
    const Show show{tour, {}, 1, false};
    const double half = std::atan(std::tan(glm::radians(30.0)) * 4 / 3);
    int checked = 0;
    for (Touring touring = touring_at(show); !touring.over; touring = advance(touring, show, {}, 50'000'000)) {
        const std::string& caption = tour.steps[touring.step()].caption;
        const bool back = caption == *words().tour("tour.rainbow.back"),
                   front = caption == *words().tour("tour.rainbow.front");
        if (!back && !front)
            continue;
        ++checked;
        // The lamp shines at 450 nm and lies beside the ship from far ahead to far behind.
        const glm::dvec3 u = u_of(touring), look = touring.flight.ship.ship_from_cockpit * glm::dvec3(0, 0, -1);
        const double gamma = std::sqrt(1 + glm::dot(u, u)), beta = glm::length(u) / gamma,
                     middle = std::acos(glm::dot(u, look) / glm::length(u));
        const auto wavelength = [&](double angle) { return 450 * gamma * (1 - beta * std::cos(angle)); };
        const double shortest = wavelength(middle - half), longest = wavelength(middle + half);
        if (back) {
            EXPECT_LT(shortest, 570) << "yellow is in view";
            EXPECT_GT(shortest, 500) << "and no blue";
            EXPECT_GT(longest, 750) << "and the dark";
        } else {
            EXPECT_GT(longest, 430) << "violet is in view";
            EXPECT_LT(longest, 490) << "and no green";
            EXPECT_LT(shortest, 360) << "and the dark";
        }
    }
    EXPECT_GT(checked, 200); // 14 seconds of them
}

/// Each measure is compared with a textbook formula with cosines, at values where these are accurate.
TEST(Tours, MeasuresEqualTheTextbooks)
{
    Ship ship, since;
    const double g = 1 / 0.6; // beta 0.8
    ship.u = Sum3({0, 0.8 * g, 0});
    ship.position = Sum3({1, 2, 3});
    ship.time.value = 50, ship.proper_time.value = 30;
    const glm::dvec3 at(4, 6, 3); // 5 away; the cosine of the angle from the motion is 0.8
    const auto value = [&](Measure::Quantity quantity) { return measured({quantity, at, {}}, ship, since, 2); };
    using enum Measure::Quantity;
    EXPECT_NEAR(value(gamma), g, 1e-12);
    EXPECT_NEAR(value(beta), 0.8, 1e-12);
    EXPECT_NEAR(value(rapidity), std::atanh(0.8), 1e-12);
    EXPECT_NEAR(value(ship_s), 60, 1e-12);
    EXPECT_NEAR(value(world_s), 100, 1e-12);
    EXPECT_NEAR(value(distance), 5, 1e-12);
    EXPECT_NEAR(value(angle_deg), glm::degrees(std::acos((0.8 + 0.8) / (1 + 0.8 * 0.8))), 1e-9);
    EXPECT_NEAR(value(doppler), g * (1 + 0.8 * 0.8), 1e-12);
    EXPECT_NEAR(value(doppler_ahead), 3, 1e-12);
    EXPECT_NEAR(value(own_colour_deg), 60, 1e-9);
    EXPECT_NEAR(value(reading_s), 2 * (50 - 5), 1e-12);
    EXPECT_NEAR(value(now_s), 2 * (50 + 0.8 * 4), 1e-12) << "4 along the motion";
    EXPECT_NEAR(value(size), std::sqrt(16 + 36 + 9) / (5 * g * (1 + 0.8 * 0.8)), 1e-12) << "relative to rest at the origin";
    EXPECT_NEAR(measured({distance, at, glm::dvec3(1, 2, 4)}, ship, since, 2), 4, 1e-12);
}

TEST(Tours, AnyFrameRateShowsTheSame)
{
    for (const auto& file : shipped("config/tours")) {
        SCOPED_TRACE(file.filename().string());
        const Tour tour = load_tour(file, words(), shipped_shot);
        const Show show{tour, {}, 1, false};
        for (double seconds = 0.5; seconds < length_s(tour); seconds += 6.5) {
            const Touring slow = played(show, seconds, 10), fast = played(show, seconds, 60);
            EXPECT_EQ(slow.step(), fast.step());
            EXPECT_NEAR(glm::distance(place_of(slow), place_of(fast)), 0, 1e-9) << seconds;
            EXPECT_NEAR(glm::distance(u_of(slow), u_of(fast)), 0, 1e-9) << seconds;
            EXPECT_NEAR(slow.flight.ship.time.total(), fast.flight.ship.time.total(), 1e-9) << seconds;
            EXPECT_NEAR(slow.flight.ship.proper_time.total(), fast.flight.ship.proper_time.total(), 1e-9) << seconds;
            EXPECT_NEAR(std::abs(glm::dot(slow.flight.ship.ship_from_cockpit, fast.flight.ship.ship_from_cockpit)), 1, 1e-9);
            EXPECT_EQ(caption_of(slow, show, words(), {}).text, caption_of(fast, show, words(), {}).text) << seconds;
        }
        EXPECT_FALSE(played(show, length_s(tour) - 0.1, 10).over);
        EXPECT_TRUE(played(show, length_s(tour) + 0.1, 10).over);
    }
}

/// A glide begins and ends at rest on the screen and follows the geodesic of velocities; world time advances by gamma.
TEST(Tours, AGlideIsSmoothAndFollowsTheGeodesic)
{
    const Tour tour = tour_of(R"({ "seconds": 1, "cut": { "position": [1, 2, 3], "time": 5,
                                   "velocity": { "direction": [0, 0, -1], "rapidity": 0.7 } } },
        { "seconds": 8, "ship_s_per_s": 0.5, "glide": { "position": [9, -2, 30], "look": [1, 0, 0],
                                   "velocity": { "direction": [1, 0, 0], "rapidity": 2 } } })");
    const Show show{tour, {}, 1, false};
    const auto at = [&](double seconds) {
        Touring touring = touring_at(show);
        return advance(touring, show, {}, std::llround(1e9 * (1 + seconds)));
    };
    EXPECT_NEAR(glm::distance(place_of(at(0)), glm::dvec3(1, 2, 3) + glm::dvec3(0, 0, -std::sinh(0.7))), 0, 1e-12);
    const Touring end = at(8 - 1e-9);
    EXPECT_NEAR(glm::distance(place_of(end), glm::dvec3(9, -2, 30)), 0, 1e-12);
    EXPECT_NEAR(glm::distance(u_of(end), glm::dvec3(std::sinh(2.0), 0, 0)), 0, 1e-9);
    // Speed, acceleration and jerk vanish at both ends: a hundredth of the time is less than a millionth of the way.
    const glm::dvec3 from = place_of(at(0)), to = place_of(end);
    for (double early : {0.08, 8 - 0.08})
        EXPECT_LT(std::min(glm::distance(place_of(at(early)), from), glm::distance(place_of(at(early)), to)),
            1e-6 * glm::distance(from, to));
    // Rapidity differences along a geodesic add up.
    const auto apart = [](const glm::dvec3& a, const glm::dvec3& b) {
        return std::acosh(std::sqrt(1 + glm::dot(a, a)) * std::sqrt(1 + glm::dot(b, b)) - glm::dot(a, b));
    };
    const glm::dvec3 a = u_of(at(0)), b = u_of(end), m = u_of(at(3));
    EXPECT_NEAR(apart(a, m) + apart(m, b), apart(a, b), 1e-9);
    EXPECT_NEAR(apart(a, b), std::acosh(std::cosh(0.7) * std::cosh(2.0)), 1e-9) << "at right angles";
    // World time is the sum of gamma in small steps.
    double time = at(0).flight.ship.time.total();
    constexpr int steps = 20000;
    for (int i = 0; i < steps; ++i) {
        const glm::dvec3 u = u_of(at(8 * (i + 0.5) / steps));
        time += 0.5 * 8.0 / steps * std::sqrt(1 + glm::dot(u, u));
    }
    EXPECT_NEAR(end.flight.ship.time.total(), time, 1e-6) << "the midpoint rule's error";
}

/// With easing the rate of ship time is continuous: it begins and ends at 0, and the whole time passes.
TEST(Tours, AnEasedStepChangesItsRateContinuously)
{
    const Tour tour = tour_of(R"({ "seconds": 1, "cut": { "velocity": { "direction": [1, 0, 0], "beta": 0.6 } },
        "ship_s_per_s": 0 }, { "seconds": 6, "ship_s_per_s": 2, "ease_s": [1, 2] })");
    const Show show{tour, {}, 1, false};
    const auto ship_s = [&](double seconds) {
        return advance(touring_at(show), show, {}, std::llround(1e9 * (1 + seconds))).flight.ship.proper_time.total();
    };
    const auto rate = [&](double seconds) { return (ship_s(seconds + 1e-4) - ship_s(seconds - 1e-4)) / 2e-4; };
    EXPECT_NEAR(ship_s(6 - 1e-9), 12, 1e-8);
    EXPECT_NEAR(rate(2), 12 / 4.5, 1e-6) << "the whole time in one and a half seconds less";
    EXPECT_NEAR(rate(3.9), 12 / 4.5, 1e-6);
    EXPECT_NEAR(rate(0.5), 6 / 4.5, 1e-6) << "half the rate in the middle of the ramp";
    EXPECT_NEAR(rate(5), 6 / 4.5, 1e-6);
    EXPECT_LT(rate(0.02), 1e-3);
    EXPECT_LT(rate(5.98), 1e-3);
    EXPECT_NEAR(rate(1 - 1e-3), rate(1 + 1e-3), 1e-6) << "the ramp joins continuously";
    EXPECT_NEAR(rate(4 - 1e-3), rate(4 + 1e-3), 1e-6);
    const Touring end = advance(touring_at(show), show, {}, 7'000'000'000 - 1);
    EXPECT_NEAR(place_of(end).x, 0.75 * 12, 1e-7) << "the way follows from the time: u = 0.75";
}

TEST(Tours, AQuestionIsAnsweredFromTheState)
{
    const Tour tour = tour_of(R"({ "seconds": 1, "cut": { "velocity": { "direction": [0, 0, -1], "gamma": 4 } } },
        { "seconds": 5, "question": { "ask": { "en": "gamma?" }, "explanation": { "en": "it is {measured}" }, "explanation_s": 3,
          "measure": { "quantity": "gamma" }, "choices": [ { "text": { "en": "two" }, "from": 1.5, "below": 3 },
          { "text": { "en": "four" }, "from": 3, "below": 5 }, { "text": { "en": "six" }, "from": 5, "below": 7 } ] } },
        { "seconds": 5, "question": { "ask": { "en": "D?" }, "explanation": { "en": "{measured}" }, "explanation_s": 3,
          "measure": { "quantity": "doppler_ahead" }, "number": { "from": 1, "to": 10, "step": 0.5, "tolerance": 0.2 } } },
        { "seconds": 1 })");
    const Show show{tour, {}, 1, true};
    Controls right, left;
    right.turn = {0, -1, 0}, left.turn = {0, 1, 0};
    const Touring at_question = later(touring_at(show), show, 1.5);
    EXPECT_EQ(caption_of(at_question, show, words(), {}).text, "gamma?");
    EXPECT_EQ(caption_of(at_question, show, words(), {}).choices.size(), 3u);
    EXPECT_EQ(caption_of(at_question, show, words(), {}).chosen, -1);
    // A held stick chooses one answer; released and pushed again, it chooses the next.
    Touring touring = later(at_question, show, 0.3, right);
    EXPECT_EQ(touring.chosen, 0);
    touring = later(later(touring, show, 0.1), show, 0.3, right);
    EXPECT_EQ(touring.chosen, 1);
    const Touring answered = later(touring, show, 0.05, controls_with(Switches{Switch::stop}));
    EXPECT_EQ(answered.right, true);
    EXPECT_EQ(caption_of(answered, show, words(), {}).text, "Right! it is 4.00");
    EXPECT_EQ(caption_of(at_question, show, words(), {}).right, -1) << "not before the answer";
    const Caption solved = caption_of(answered, show, words(), {});
    EXPECT_EQ(solved.choices, (std::vector<std::string>{"two", "four", "six"}));
    EXPECT_EQ(solved.right, 1);
    EXPECT_EQ(solved.chosen, 1);
    EXPECT_EQ(verdict_of(solved), "✓ four");
    EXPECT_EQ(verdict_of(caption_of(at_question, show, words(), {})), "");
    const Caption missed
        = caption_of(later(at_question, show, 0.05, controls_with(Switches{Switch::headlight})), show, words(), {});
    EXPECT_EQ(missed.right, 1);
    EXPECT_EQ(missed.chosen, 2);
    EXPECT_EQ(verdict_of(missed), "✓ four   ✗ six");
    EXPECT_NEAR(u_of(answered).z, -std::sqrt(15.0), 1e-12) << "the button answers and does not stop the ship";
    touring = later(later(touring, show, 0.1), show, 0.3, left);
    EXPECT_EQ(caption_of(later(touring, show, 0.05, controls_with(Switches{Switch::stop})), show, words(), {}).text,
        "Not quite. it is 4.00");
    EXPECT_EQ(later(at_question, show, 0.05, controls_with(Switches{Switch::headlight})).right, false)
        << "3 is the third choice";
    EXPECT_TRUE(later(at_question, show, 0.05, controls_with(Switches{Switch::headlight})).flight.effects[Effect::headlight])
        << "the key must not switch the effect";
    EXPECT_FALSE(later(at_question, show, 0.05, controls_with(Switches{Switch::stop})).measured_answer)
        << "nothing chosen is not an answer";
    // The explanation stays for three seconds, whenever the answer came.
    EXPECT_EQ(later(answered, show, 2.8).step(), 1u);
    EXPECT_EQ(later(answered, show, 3.1).step(), 2u);
    const Touring silent = later(at_question, show, 4.8);
    EXPECT_EQ(caption_of(silent, show, words(), {}).text, "The answer: it is 4.00");
    EXPECT_EQ(caption_of(silent, show, words(), {}).right, 1);
    EXPECT_EQ(caption_of(silent, show, words(), {}).chosen, -1);
    EXPECT_FALSE(silent.right);
    // A held stick keeps changing the number.
    Touring number = later(answered, show, 3.2);
    EXPECT_EQ(number.number, 1);
    number = later(number, show, 1.75, right); // once at first, then ten times a second after half a second
    EXPECT_NEAR(number.number, 1 + 0.5 * 13, 0.51);
    while (number.number < 8)
        number = later(later(number, show, 0.04), show, 0.04, right);
    EXPECT_EQ(later(number, show, 0.05, controls_with(Switches{Switch::stop})).right, true) << "7.87 within 0.2 of 8";
    number = later(later(number, show, 0.04), show, 0.04, left);
    EXPECT_EQ(later(number, show, 0.05, controls_with(Switches{Switch::stop})).right, false);
}

// One button: the answers are marked in turn, and a press takes the marked one, whichever it is and however long one waits.
TEST(Tours, OneButtonGivesEveryAnswer)
{
    const Tour tour = tour_of(
        R"({ "seconds": 1, "cut": { "look": [0, 0, -1] } }, { "seconds": 30, "question": { "ask": { "en": "gamma?" }, "explanation": { "en": "it is {measured}" },
        "explanation_s": 3, "measure": { "quantity": "gamma" }, "choices": [ { "text": { "en": "one" }, "below": 1.5 },
        { "text": { "en": "two" }, "from": 1.5, "below": 3 }, { "text": { "en": "four" }, "from": 3 } ] } })");
    const Show show{tour, {}, 1, true};
    const OneButton rules;
    for (int round = 0; round < 2; ++round)
        for (int wanted = 0; wanted < 3; ++wanted) {
            Touring touring = later(touring_at(show), show, 1.1);
            Scan scan;
            double time_s = 0;
            int passed = 0, before = -1;
            for (; asks(touring, show) && time_s < 25; time_s += 0.016) {
                passed += touring.chosen != before && touring.chosen == wanted;
                before = touring.chosen;
                const bool presses = touring.chosen == wanted && passed > round;
                touring = later(touring, show, 0.016,
                    controls_of(advance_in_menu(scan, rules, {presses, presses}, 0, std::size_t(-1), 16'000'000)));
            }
            ASSERT_FALSE(asks(touring, show)) << wanted;
            EXPECT_EQ(touring.chosen, wanted);
            EXPECT_EQ(touring.right, wanted == 0);
            EXPECT_NEAR(time_s, (3 * round + wanted + 1) * rules.scan_s, 0.2);
        }
}

TEST(Tours, AVisitorFliesATryUntilItIsReached)
{
    const Tour tour = tour_of(R"({ "seconds": 1, "cut": "start" },
        { "seconds": 10, "try": { "max_gamma": 3 }, "question": { "ask": { "en": "go" }, "explanation": { "en": "{measured}" },
          "explanation_s": 2, "measure": { "quantity": "gamma" }, "reach": { "from": 2, "to": 2.9 } } },
        { "seconds": 4, "try": {} }, { "seconds": 2 })");
    Show show{tour, {}, 1, true};
    const Touring given = later(touring_at(show), show, 1.1);
    EXPECT_TRUE(flies(given, show));
    // If the throttle is open when the visitor takes over a resting ship, it is inhibited until it has been closed.
    EXPECT_EQ(glm::length(u_of(later(touring_at(show), show, 4, controls_with(Steering{.lever = 0.9})))), 0);
    Touring touring = later(given, show, 0.1, controls_with(Steering{.lever = 0.0}));
    touring = later(touring, show, 2.5, controls_with(Steering{.lever = 0.9}));
    EXPECT_TRUE(touring.measured_answer) << "the place is reached";
    EXPECT_EQ(touring.right, true);
    EXPECT_GT(*touring.measured_answer, 2);
    EXPECT_FALSE(flies(touring, show));
    const Touring idle = later(given, show, 10.5);
    EXPECT_TRUE(idle.measured_answer) << "the time is over";
    EXPECT_FALSE(idle.right);
    // Home leads to the next step. Without visitors the step is left out.
    EXPECT_EQ(later(given, show, 0.05, controls_with(Switches{Switch::home})).step(), 2u);
    show.visitors = false;
    EXPECT_EQ(played(show, 1.5, 60).step(), 3u);
    EXPECT_NEAR(length_s(tour), 3, 1e-12);
}

TEST(Tours, GuidesCanPauseSkipAndGoBack)
{
    const Tour tour = tour_of(R"({ "seconds": 3, "cut": "start" }, { "seconds": 3, "thrust": { "rapidity_per_s": 1 } },
        { "seconds": 3, "turn": { "look": [1, 0, 0] } })");
    const Show show{tour, {}, 1, true};
    const Touring flying = later(touring_at(show), show, 5.5);
    EXPECT_EQ(flying.step(), 1u);
    const Touring still = later(flying, show, 2, controls_with(Switches{Switch::stop}));
    EXPECT_TRUE(still.paused);
    EXPECT_TRUE(later(flying, show, 2, controls_with(Switches{Switch::freeze})).paused);
    // The display says what the keys or the stick's buttons do; a movie has neither.
    EXPECT_EQ(caption_of(flying, show, words(), {}).aside, "Space: pause · R: next · Backspace: back");
    const InputCapabilities stick{.stick = true, .stop_button = 1, .home_button = 2, .undo_button = 3};
    EXPECT_EQ(caption_of(flying, show, words(), stick).aside, "button 1: pause · 2: next · 3: back");
    EXPECT_EQ(caption_of(still, show, words(), stick).aside, "paused · button 1: go on");
    EXPECT_EQ(caption_of(flying, {tour, {}, 1, false}, words(), {}).aside, "");
    EXPECT_EQ(u_of(still), u_of(flying)) << "a paused tour stands still to the bit";
    EXPECT_EQ(caption_of(still, show, words(), {}).aside, "paused · Space: go on");
    EXPECT_EQ(later(still, show, 1, controls_with(Switches{Switch::stop})).step(), 2u) << "stop again continues the tour";
    // Home skips to the state at the step's end.
    const Touring on = later(flying, show, 0.01 + 1e-9, controls_with(Switches{Switch::home}));
    EXPECT_EQ(on.step(), 2u);
    EXPECT_NEAR(std::asinh(glm::length(u_of(on))), 3, 1e-6);
    // Undo leads to the step's beginning, and soon after that to the step before.
    Touring back = later(flying, show, 0.02, controls_with(Switches{Switch::undo}));
    EXPECT_EQ(back.step(), 1u);
    EXPECT_LT(glm::length(u_of(back)), 0.1);
    back = later(back, show, 0.02, controls_with(Switches{Switch::undo}));
    EXPECT_EQ(back.step(), 0u);
    EXPECT_EQ(later(on, show, 0.02, controls_with(Switches{Switch::reset})).step(), 0u);
    // Flight controls do nothing to a tour that flies by itself; looking around works.
    Controls hands;
    hands.lever = 1.0, hands.throttle_rate = 1, hands.turn = {1, 1, 1};
    const Touring touched = advance(flying, show, hands, 100'000'000), untouched = advance(flying, show, {}, 100'000'000);
    EXPECT_EQ(u_of(touched), u_of(untouched));
    EXPECT_EQ(touched.flight.ship.ship_from_cockpit, untouched.flight.ship.ship_from_cockpit);
    EXPECT_EQ(
        advance(flying, show, controls_with(Looking{.look_rad = {0.3, 0.1}}), 1).flight.look_rad, glm::dvec2(0.3, 0.1));
}

TEST(Tours, AtTheEndTheVisitorFliesUntilAReset)
{
    const Tour tour = tour_of(R"({ "seconds": 1, "cut": "start" }, { "seconds": 1, "thrust": { "rapidity_per_s": 0.5 } })");
    const Show show{tour, {}, 1, true};
    Touring touring = later(touring_at(show), show, 2.5);
    EXPECT_TRUE(touring.over);
    EXPECT_TRUE(caption_of(touring, show, words(), {}).text.empty());
    EXPECT_NEAR(std::asinh(glm::length(u_of(touring))), 0.5, 0.05) << "the ship flies on with its last velocity";
    touring = later(touring, show, 10, controls_with(Steering{.throttle_rate = 1}));
    EXPECT_GT(std::asinh(glm::length(u_of(touring))), 5);
    EXPECT_TRUE(later(touring, show, 300).over) << "the end of a visit is not the tour's own affair";
    touring = later(touring, show, 0.01, controls_with(Switches{Switch::reset}));
    EXPECT_FALSE(touring.over);
    EXPECT_EQ(touring.step(), 0u);
    EXPECT_EQ(u_of(touring), glm::dvec3(0));
}

TEST(Tours, ExposureChangesSmoothlyAndKeepsTheVisitorsCorrection)
{
    const Tour tour = tour_of(R"({ "seconds": 2, "cut": { "exposure_ev": -2 } }, { "seconds": 2, "exposure_ev": 4 },
        { "seconds": 2 }, { "seconds": 2, "cut": {}, "exposure_ev": 1, "effects": { "doppler": false } })");
    const Show show{tour, {}, 1, true};
    EXPECT_EQ(played(show, 1, 10).flight.exposure_ev, -2);
    EXPECT_NEAR(played(show, 3, 10).flight.exposure_ev, 1, 1e-9) << "in the middle of the change";
    EXPECT_NEAR(played(show, 5, 10).flight.exposure_ev, 4, 1e-9);
    EXPECT_EQ(played(show, 7, 10).flight.exposure_ev, 1);
    EXPECT_FALSE(played(show, 7, 10).flight.effects[Effect::doppler]);
    EXPECT_NEAR(played(show, 1, 10, controls_with(Looking{.exposure = 1})).brighter_ev, exposure_ev_per_s, 1e-6);
}

TEST(Tours, CaptionsShowTheirMeasuredNumber)
{
    const Tour tour = tour_of(std::string(R"({ "seconds": 1, "cut": { "position": [0, 0, -34] } },
        { "seconds": 9, "glide": { "position": [0, 0, -40] }, "caption": "tour.first-minute.back", "measure": )")
        + measured_size + "}");
    const Show show{tour, {}, 1, false};
    const Touring end = advance(touring_at(show), show, {}, 10'000'000'000 - 1);
    EXPECT_NE(caption_of(end, show, words("de"), {}).text.find(" 2,00 times "), std::string::npos)
        << caption_of(end, show, words("de"), {}).text;
}

TEST(Captions, WrapAtSpaces)
{
    const auto letters = [](const std::string& text) { return double(text.size()); };
    EXPECT_EQ(wrapped("a bb ccc dddd", 6, letters), (std::vector<std::string>{"a bb", "ccc", "dddd"}));
    EXPECT_EQ(wrapped("incomprehensible it is", 6, letters), (std::vector<std::string>{"incomprehensible", "it is"}));
    EXPECT_EQ(wrapped("", 6, letters), (std::vector<std::string>{""}));
}

} // namespace tour_test
