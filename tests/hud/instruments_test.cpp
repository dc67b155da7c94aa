// Readings of the instruments without a device. The paper's clocks are calculated by hand, directions and lengths by the
// tests' own boosts in 33 digits. Further tests read the log as a spreadsheet does, and the texts of the pages.
#include "config/json/error.h"
#include "config/model/angles.h"
#include "config/model/scene_file.h"
#include "runtime/hud/hud_place.h"
#include "runtime/hud/lab_log.h"
#include "runtime/hud/lab_panel.h"
#include "runtime/world/eye_event.h"
#include "runtime/world/instances.h"
#include "runtime/world/worldline.h"
#include "tests/support/files.h"
#include "tests/support/quad.h"
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <regex>
#include <sstream>

namespace instruments_test {

using namespace starbow;
using namespace starbow::testing;
using glm::dvec3;

namespace {

constexpr const char* languages[] = {"en", "de"};

const World& clocks()
{
    static const World world = [] {
        World loaded = load_world(load_scene_file(source_dir() / "config/scenes/clocks.json").gltf);
        sort_instances(loaded);
        return loaded;
    }();
    return world;
}

/// The spot of the clock at x of the row.
Spot clock_at(double x)
{
    for (std::size_t i = 0; i < 5; ++i) {
        const Spot spot = snapped({.clock = i}, clocks());
        if (std::abs(spot.at.x - x) < 1e-6)
            return spot;
    }
    ADD_FAILURE() << "no clock at " << x;
    return {};
}

MeasuringObserver passing() { return measuring_observer_of(load_shot(source_dir() / "config/shots/clocks-passing.json")); }

std::vector<std::string> cells(const std::string& line)
{
    std::vector<std::string> all;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');)
        all.push_back(cell);
    if (line.ends_with(','))
        all.emplace_back();
    return all;
}

Measured some_measured()
{
    Measured m{.observer = passing(), .ship_s = 1.25, .world_s = passing().time};
    m.aim = read_spot(m.observer, clock_at(0), clocks(), 1);
    m.aim.light = 0.5;
    m.marks = {read_spot(m.observer, clock_at(-10), clocks(), 1), read_spot(m.observer, clock_at(10), clocks(), 1)};
    m.pair = read_pair(m.observer, clock_at(-10), clock_at(10), clocks(), 1);
    return m;
}

std::vector<std::string> lines_of(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

std::filesystem::path fresh(const std::string& name)
{
    std::filesystem::remove(scratch(name));
    return scratch(name);
}

void ignore(LogKind, const std::string&) { }

std::string refusal(const std::filesystem::path& file)
{
    try {
        LabLog log(file, ignore);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

// The paper's clocks, calculated by hand to the digits given.
TEST(Instruments, ThePapersClocksHaveTheirReadingsFromTheMovingShip)
{
    const MeasuringObserver ship = passing();
    const double readings_s[] = {-5.90909, -2.74403, 0, 2.21961, 3.80547};
    const double from_motion_deg[]
        = {104.70466, 97.69614, 90, 81.75503, 73.21615}; // 90 degrees minus the angle from the perpendicular
    for (int k = 0; k < 5; ++k) {
        const SpotReading reading = read_spot(ship, clock_at(5 * (k - 2)), clocks(), 1);
        EXPECT_NEAR(*reading.clock_s, readings_s[k], 1e-5);
        EXPECT_NEAR(*reading.emitted_s, readings_s[k], 1e-5); // their zero is the world's
        EXPECT_NEAR(*reading.from_motion_rad / degree, from_motion_deg[k], 1e-5);
    }
    const SpotReading middle = read_spot(ship, clock_at(0), clocks(), 1);
    EXPECT_NEAR(*middle.distance_s, 35.79572, 1e-5);
    EXPECT_NEAR(*middle.from_motion_world_rad / degree, 120, 1e-5);
    EXPECT_NEAR(*middle.ship_distance_s, 31, 1e-5); // across the motion it equals the distance at rest
    EXPECT_NEAR(middle.ray.D, 0.8660254, 1e-7);
    EXPECT_NEAR(middle.seen_nm, 550 / 0.8660254, 1e-4);
    const PairReading row = read_pair(ship, clock_at(-10), clock_at(10), clocks(), 1);
    EXPECT_NEAR(*row.apparent_s, 17.4853, 1e-4);
    EXPECT_NEAR(*row.rest_s, 20, 1e-12);
    EXPECT_NEAR(*row.contracted_s, 20 * std::sqrt(0.75), 1e-12);
    EXPECT_NEAR(*row.clocks_s, 9.71455, 2e-5);
    EXPECT_NEAR(row.angle_rad / degree, 14.70466 + 16.78385, 2e-5);
    EXPECT_NEAR(*unshifted_angle(ship) / degree, 74.45773, 1e-5);
}

// A ship that stops at once has the same readings at other angles.
TEST(Instruments, AStoppedShipHasTheSameReadings)
{
    MeasuringObserver ship = passing();
    ship.u = dvec3(0);
    EXPECT_NEAR(*read_pair(ship, clock_at(-10), clock_at(10), clocks(), 1).clocks_s, 9.71455, 2e-5);
    EXPECT_NEAR(read_pair(ship, clock_at(-10), clock_at(10), clocks(), 1).angle_rad / degree, 131.985 - 104.293, 2e-3);
    EXPECT_NEAR(*read_pair(ship, clock_at(-10), clock_at(10), clocks(), 1).apparent_s, 20, 1e-12);
    EXPECT_FALSE(unshifted_angle(ship));
    EXPECT_FALSE(read_spot(ship, clock_at(0), clocks(), 1).from_motion_rad);
}

// For any place, velocity and look: the direction of a resting point's light, and the point's place in the ship's frame, by
// boosts of events.
TEST(Instruments, DirectionsAndLengthsEqualBoostsOfEvents)
{
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    const auto any = [&] { return dvec3(normal(random), normal(random), normal(random)); };
    for (int i = 0; i < 300; ++i) {
        const double u = std::pow(10.0, std::uniform_real_distribution<double>(-3, 2)(random));
        const MeasuringObserver ship{.place = 10.0 * any(),
            .time = 5 * normal(random),
            .u = u * glm::normalize(any()),
            .ship_from_cockpit = glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random)))};
        const Spot a{.at = 20.0 * any()}, b{.at = 20.0 * any()};
        std::array<dvec3, 2> was;
        for (int k = 0; k < 2; ++k) {
            // The event of emission relative to the observer, boosted into the ship.
            const dvec3 to = (k == 0 ? a : b).at - ship.place;
            const quad::V3 way = quad::of(to);
            const quad::V4 emission = quad::boosted(quad::of(-ship.u), {-quad::length(way), way});
            was[std::size_t(k)] = {double(emission.x.x), double(emission.x.y), double(emission.x.z)};
            const SpotReading reading = read_spot(ship, k == 0 ? a : b, clocks(), 1);
            // The rounding of the place, which is 2 gamma times as large behind.
            const double tolerance = 1e-14 * (1 + u * u);
            EXPECT_LT(angle_between(reading.ray.ship, was[std::size_t(k)]), tolerance + 1e-13);
            EXPECT_NEAR(*reading.ship_distance_s / -double(emission.t), 1, tolerance + 1e-12);
            // The ray along that direction must lead back to the point.
            EXPECT_LT(angle_between(ray_from_ship(ship, reading.ray.ship).world, to), tolerance + 1e-12);
        }
        const PairReading pair = read_pair(ship, a, b, clocks(), 1);
        EXPECT_NEAR(*pair.apparent_s / glm::distance(was[0], was[1]), 1, 1e-12 * (1 + u * u));
        EXPECT_NEAR(pair.angle_rad, angle_between(was[0], was[1]), 1e-13 * (1 + u * u));
    }
}

TEST(Instruments, ReadingsThatDoNotExistAreLeftOut)
{
    const MeasuringObserver ship = passing();
    const Spot sky = spot_at(ship, {aim_of(ship), INFINITY}, clocks());
    EXPECT_TRUE(sky.sky);
    const SpotReading reading = read_spot(ship, sky, clocks(), 1);
    EXPECT_FALSE(reading.distance_s || reading.emitted_s || reading.clock_s || reading.ship_distance_s);
    EXPECT_NEAR(reading.ray.D, 0.8660254, 1e-7);
    const PairReading pair = read_pair(ship, sky, clock_at(0), clocks(), 1);
    EXPECT_FALSE(pair.apparent_s || pair.rest_s || pair.clocks_s);
    MeasuringObserver plain = ship; // without aberration the picture does not show this length
    plain.aberration = false;
    EXPECT_FALSE(read_pair(plain, clock_at(0), clock_at(5), clocks(), 1).apparent_s);
    EXPECT_LT(angle_between(ray_from_ship(plain, {0, 0, -1}).world, {0, 0, -1}), 1e-15);
}

TEST(Instruments, ADialIsAimedAtAnywhereOnIt)
{
    const MeasuringObserver ship = passing();
    const dvec3 at = clock_at(5).at + dvec3(1.2, -1.1, 0);
    const Spot aimed
        = spot_at(ship, {ray_from_world(ship, glm::normalize(at - ship.place)), glm::distance(at, ship.place)}, clocks());
    ASSERT_TRUE(aimed.clock);
    EXPECT_LT(glm::distance(aimed.at, at), 1e-12);
    EXPECT_LT(glm::distance(snapped(aimed, clocks()).at, clock_at(5).at), 1e-12);
    const dvec3 beside = clock_at(5).at + dvec3(2.4, 0, 0);
    EXPECT_FALSE(spot_at(
        ship, {ray_from_world(ship, glm::normalize(beside - ship.place)), glm::distance(beside, ship.place)}, clocks())
                     .clock);
}

TEST(Instruments, AClockOnAMovingBodyHasItsRetardedReading)
{
    // The middle clock is on a moving body, and the ship moves too. Bisection finds its event of emission in 33 digits.
    SceneFile scene = load_scene_file(source_dir() / "config/scenes/clocks.json");
    const dvec3 u(0.9, 0.2, -0.4);
    scene.bodies = {{"clock", {"dial 3"}, u, {2, {1, -1, 4}}, {}}};
    World world = load_world(scene);
    place_bodies(world, scene);
    sort_instances(world);
    ASSERT_EQ(world.frames.size(), 2u);
    const std::size_t dial = instances_of(world, 1).first;
    const dvec3 middle = snapped({.clock = dial}, world).at; // in its own frame
    MeasuringObserver ship{{3, 2, 20}, 40, {-0.3, 0.5, 1.2}};

    const quad::V3 qu = quad::of(u);
    auto event = [&](quad::Q tau) { // in the world, by the body's own time since the event (2, 1, -1, 4)
        const quad::V4 from = quad::boosted(qu, {tau, quad::of(middle)});
        return quad::V4{2 + from.t, quad::V3{1, -1, 4} + from.x};
    };
    quad::Q low = -1e4, high = 1e3;
    for (int i = 0; i < 150; ++i) {
        const quad::Q tau = (low + high) / 2;
        const quad::V4 e = event(tau);
        (e.t + quad::length(e.x - quad::of(ship.place)) > ship.time ? high : low) = tau;
    }
    const quad::V4 left = event(low);
    const quad::V3 way = left.x - quad::of(ship.place);
    const double delay = double(quad::length(way));
    const auto on_board = quad::camera_from_world(way, quad::of(ship.u));
    const dvec3 seen(double(on_board.n.x), double(on_board.n.y), double(on_board.n.z));
    // D is the product of the ship's Doppler factor and the body's.
    const auto body = quad::camera_from_world(way, qu);
    const double D = double(on_board.D / body.D);

    const Spot spot = spot_at(ship, {.ray = {seen}, .distance = delay, .frame = 1}, world);
    ASSERT_TRUE(spot.clock);
    EXPECT_EQ(*spot.clock, dial);
    EXPECT_LT(glm::distance(spot.at, middle), 1e-9);
    const SpotReading reading = read_spot(ship, snapped(spot, world), world, 1);
    EXPECT_NEAR(*reading.clock_s, double(low), 1e-9);
    EXPECT_NEAR(*reading.distance_s, delay, 1e-9);
    EXPECT_NEAR(*reading.emitted_s, ship.time - delay, 1e-9);
    EXPECT_NEAR(reading.ray.D / D, 1, 1e-12);
    EXPECT_LT(angle_between(reading.ray.ship, seen), 1e-12);
    // The page's formula of D gives D from the numbers that stand in it.
    const std::string line = why_page(Why::doppler, {.observer = ship, .aim = reading}, words("en")).numbers.at(0);
    std::vector<double> numbers;
    const std::regex number("(?:− ?)?[0-9][0-9.]*");
    for (std::sregex_iterator one(line.begin(), line.end(), number), end; one != end; ++one)
        numbers.push_back(std::stod(std::regex_replace(one->str(), std::regex("(?:−) ?"), "-")));
    ASSERT_EQ(numbers.size(), 6u) << line; // 1 / (gamma (1 - beta cos)) = D
    EXPECT_NEAR(numbers[5] / D, 1, 1e-3) << line;
    EXPECT_NEAR(1 / (numbers[1] * (1 + numbers[3] * numbers[4])) / D, 1, 3e-3) << line; // the sign came with beta
    // Points that move relative to each other have no length at rest.
    const Spot still{.at = {0, 0, 0}};
    const PairReading pair = read_pair(ship, spot, still, world, 1);
    EXPECT_FALSE(pair.rest_s || pair.contracted_s);
    EXPECT_TRUE(pair.apparent_s);
}

namespace {

dvec3 double_of(quad::V3 v) { return {double(v.x), double(v.y), double(v.z)}; }

/// A world whose middle clock rides on a body, and the picture's law for it by the tests' own boosts.
struct Riding {
    dvec3 u{0.9, 0.2, -0.4};
    World world;
    std::size_t dial = 0;
    dvec3 middle{0}; ///< of the dial, in the body's frame

    Riding()
    {
        SceneFile scene = load_scene_file(source_dir() / "config/scenes/clocks.json");
        scene.bodies = {{"clock", {"dial 3"}, u, {2, {1, -1, 4}}, {}}};
        world = load_world(scene);
        place_bodies(world, scene);
        sort_instances(world);
        dial = instances_of(world, 1).first;
        middle = snapped({.clock = dial}, world).at;
    }
    /// The dial's event at a time of its own, from the ship's event, in the world.
    quad::V4 event(quad::Q tau, const MeasuringObserver& ship) const
    {
        const quad::V4 from = quad::boosted(quad::of(u), {tau, quad::of(middle)});
        return {2 + from.t - ship.time, quad::V3{1, -1, 4} + from.x - quad::of(ship.place)};
    }
    /// The dial's own time at which `late` becomes above 0.
    template <class Function> quad::Q when(const MeasuringObserver& ship, const Function& late) const
    {
        quad::Q low = -1e4, high = 1e4;
        for (int i = 0; i < 150; ++i) {
            const quad::Q tau = (low + high) / 2;
            (late(event(tau, ship)) > 0 ? high : low) = tau;
        }
        return low;
    }
};

/// The rate of crests of a wave from the unit direction n where velocities simply add.
quad::Q galilean_D(quad::V3 n, quad::V3 u) { return 1 + quad::dot(n, u) / quad::gamma(u); }

/// The values that must be read.
struct Shown {
    dvec3 ship;
    double depth = 0; ///< the picture's, as its pixels have it
    quad::Q clock = 0;
    double D = 1, distance = 0, emitted = 0;
};

void expect_read(const MeasuringObserver& ship, const Riding& riding, const Shown& shown, bool moves, const Spot& at)
{
    const Spot spot
        = spot_at(ship, {.ray = ray_from_ship(ship, shown.ship), .distance = shown.depth, .frame = moves}, riding.world);
    ASSERT_TRUE(spot.clock);
    EXPECT_EQ(*spot.clock, *at.clock);
    EXPECT_LT(glm::distance(spot.at, at.at), 1e-8);
    const SpotReading reading = read_spot(ship, at, riding.world, 1);
    ASSERT_TRUE(reading.clock_s && reading.distance_s && reading.emitted_s);
    EXPECT_NEAR(*reading.clock_s, double(shown.clock), 1e-8);
    EXPECT_NEAR(*reading.distance_s, shown.distance, 1e-8);
    EXPECT_NEAR(*reading.emitted_s, shown.emitted, 1e-8);
    EXPECT_NEAR(reading.ray.D / shown.D, 1, 1e-10);
    EXPECT_NEAR(reading.seen_nm * shown.D / 550, 1, 1e-10);
    EXPECT_LT(angle_between(reading.ray.ship, shown.ship), 1e-9);
}

} // namespace

// Pictures that are wrong on purpose: a reading is that of the same thing, clock, place and shift that the pixel shows. Of
// each picture, the event that it shows is found here by the law in docs/physics/relativity.md, for a thing at rest and a
// moving one.
TEST(Instruments, AComparisonIsReadAsItIsShown)
{
    const Riding riding;
    const Spot resting = [&] {
        for (std::size_t i = 0; i < riding.world.instances.size(); ++i)
            if (i != riding.dial)
                if (const Spot spot = snapped({.clock = i}, riding.world); std::abs(spot.at.x - 10) < 1e-6)
                    return spot;
        return Spot{};
    }();
    ASSERT_TRUE(resting.clock);
    const Spot moving{.at = riding.middle, .frame = 1, .clock = riding.dial};
    for (const dvec3& u : {dvec3(-0.3, 0.5, 1.2), dvec3(2, 0.1, -0.7), dvec3(0, 0, -0.4)}) {
        MeasuringObserver ship{{3, 2, 20}, 40, u};
        const quad::V3 qu = quad::of(u), v = qu * (1 / quad::gamma(qu)), to = quad::of(resting.at - ship.place);
        const quad::Q far = quad::length(to);
        {
            SCOPED_TRACE("velocities simply add");
            ship.comparison = Comparison::galilean;
            const quad::V3 n = quad::unit(to);
            const double delay = double(far), D = double(galilean_D(n, qu));
            expect_read(ship, riding, {double_of(quad::unit(n + v)), delay, 40 - far, D, delay, 40 - delay}, false, resting);
            // A moving thing's picture is made in its own frame, and turned into the ship by way of the world.
            const quad::V3 body = quad::of(riding.u), back = body * -1;
            const quad::V4 eye = quad::boosted(back, {quad::Q(38), quad::of(ship.place - dvec3(1, -1, 4))}),
                           velocity = quad::boosted(back, {quad::gamma(qu), qu});
            const quad::V3 there = quad::of(riding.middle) - eye.x, n_there = quad::unit(there),
                           seen = quad::unit(n_there + velocity.x * (1 / velocity.t));
            const quad::V3 on_board = quad::boosted(qu * -1, quad::boosted(body, quad::boosted(velocity.x, {0, seen}))).x;
            // The pixel's depth is that of the world's ray in its direction, s n' - v with the length 1.
            const quad::Q along = quad::dot(on_board, v), s = along + sqrtq(along * along + 1 - quad::dot(v, v)),
                          D_there = galilean_D(n_there, velocity.x), D_world = galilean_D(on_board * s - v, qu);
            const quad::V4 left = quad::boosted(body, {-quad::length(there), there});
            expect_read(ship, riding,
                {double_of(on_board), double(quad::length(there) * D_there / D_world), eye.t - quad::length(there),
                    double(D_there), double(-left.t), double(40 + left.t)},
                true, moving);
            EXPECT_FALSE(read_spot(ship, resting, riding.world, 1).ship_distance_s);
            const PairReading pair = read_pair(ship, resting, resting, riding.world, 1);
            EXPECT_FALSE(pair.apparent_s || pair.contracted_s);
            // D is 1 abeam in the world.
            const double ring = std::atan2(1.0, double(quad::length(v)));
            EXPECT_NEAR(*unshifted_angle(ship), ring, 1e-14);
        }
        {
            SCOPED_TRACE("no light delay");
            ship.comparison = Comparison::no_light_delay;
            const auto simultaneous = [&](quad::V4 event) { return quad::boosted(qu * -1, event); };
            // At rest, the event at t + v r.
            const quad::Q later = quad::dot(v, to);
            const quad::V4 at_rest = simultaneous({later, to});
            EXPECT_LT(std::abs(double(at_rest.t)), 1e-20);
            const double away = double(quad::length(at_rest.x));
            expect_read(ship, riding, {double_of(quad::unit(at_rest.x)), away, 40 + later, 1, away, double(40 + later)},
                false, resting);
            const quad::Q tau = riding.when(ship, [&](quad::V4 event) { return simultaneous(event).t; });
            const quad::V4 event = riding.event(tau, ship);
            const quad::V3 on_board = simultaneous(event).x;
            const double far_off = double(quad::length(on_board));
            expect_read(ship, riding, {double_of(quad::unit(on_board)), far_off, tau, 1, far_off, double(40 + event.t)},
                true, moving);
            const PairReading pair = read_pair(ship, resting, moving, riding.world, 1);
            EXPECT_NEAR(*pair.apparent_s, double(quad::length(at_rest.x - on_board)), 1e-8);
            EXPECT_FALSE(unshifted_angle(ship));
        }
        {
            SCOPED_TRACE("without aberration");
            ship.comparison = Comparison::none, ship.aberration = false;
            const quad::Q tau = riding.when(ship, [&](quad::V4 event) { return event.t + quad::length(event.x); });
            const quad::V4 event = riding.event(tau, ship);
            const quad::V3 n = quad::unit(event.x);
            const double delay = double(-event.t);
            const quad::Q D = quad::world_from_camera(n, qu).D / quad::camera_from_world(n, quad::of(riding.u)).D;
            expect_read(ship, riding, {double_of(n), delay, tau, double(D), delay, 40 - delay}, true, moving);
        }
    }
}

// The traveller's clock lies at one place before it leaves and after it is back. The journey takes 20 s at home and 12 on
// board, so that the same spot reads 8 seconds less afterwards, and nothing while the traveller is away.
TEST(Instruments, AClockIsReadOnlyWhileItIsThere)
{
    SceneFile scene = load_scene_file(source_dir() / "config/scenes/twins.json");
    World world = load_world(scene);
    place_bodies(world, scene);
    sort_instances(world);
    const InstanceRange range = instances_of(world, 0);
    std::vector<dvec3> dials; // of things at rest, each ship's that faces astern, where the eye is
    for (std::size_t i = range.first; i < range.last; ++i) {
        const Primitive& primitive = world.primitives[world.instances[i].primitive];
        const dvec3 middle(world.instances[i].frame_from_local * glm::dvec4(0.5 * (primitive.low + primitive.high), 1));
        if (!world.materials[std::size_t(primitive.material)].clock)
            continue;
        const auto same
            = std::find_if(dials.begin(), dials.end(), [&](const dvec3& d) { return std::abs(d.x - middle.x) < 1e-6; });
        if (same == dials.end())
            dials.push_back(middle);
        else if (same->z < middle.z)
            *same = middle;
    }
    std::sort(dials.begin(), dials.end(), [](const dvec3& one, const dvec3& other) { return one.x < other.x; });
    ASSERT_EQ(dials.size(), 2u); // at home and the traveller's
    const auto spot_on = [&](const MeasuringObserver& eye, std::size_t k, const dvec3& beside = dvec3(0)) {
        const dvec3 to = dials[k] + beside - eye.place;
        return spot_at(eye, {{glm::normalize(to), glm::normalize(to)}, glm::length(to)}, world);
    };
    MeasuringObserver eye{.place = {0, 0.1, 2.9}};
    for (const auto& [time, seconds_behind] : {std::pair(-3.0, 0.0), {30.0, 8.0}, {1000.0, 8.0}}) {
        eye.time = time;
        const Spot home = spot_on(eye, 0), traveller = spot_on(eye, 1);
        const PairReading pair = read_pair(eye, snapped(home, world), snapped(traveller, world), world, 1);
        ASSERT_TRUE(pair.clocks_s) << time;
        // Both are as far away, but for the dials' places in the file, which are floats.
        EXPECT_NEAR(*pair.clocks_s, -seconds_behind, 1e-6) << time;
        EXPECT_NEAR(*read_spot(eye, home, world, 1).clock_s, time - glm::distance(dials[0], eye.place), 1e-6);
        // A thing as far before the dial as half its radius is not the clock.
        EXPECT_FALSE(spot_on(eye, 1, {0, 0, 0.4}).clock);
    }
    // A mark that was put there before the start.
    eye.time = -3;
    const Spot mark = snapped(spot_on(eye, 1), world);
    eye.time = 14;
    EXPECT_FALSE(spot_on(eye, 1).clock);
    EXPECT_FALSE(read_spot(eye, mark, world, 1).clock_s);
    eye.time = 30;
    EXPECT_NEAR(*read_spot(eye, mark, world, 1).clock_s, 30 - 8 - glm::distance(dials[1], eye.place), 1e-6);
}

TEST(Instruments, EveryLineOfALogHasTheSameColumns)
{
    const std::vector<std::string> names = cells(log_header());
    const Measured full = some_measured();
    Measured bare;
    for (const Measured& m : {full, bare})
        EXPECT_EQ(cells(log_line(m, "aim", "now")).size(), names.size());
    const auto value = [&](const Measured& m, const std::string& name) {
        const std::vector<std::string> all = cells(log_line(m, "aim", "2026-01-01T00:00:00.000Z"));
        const auto found = std::find(names.begin(), names.end(), name);
        return found == names.end() ? std::string("no column") : all[std::size_t(found - names.begin())];
    };
    EXPECT_EQ(value(full, "utc"), "2026-01-01T00:00:00.000Z");
    EXPECT_NEAR(std::stod(value(full, "beta")), 0.5, 1e-11);
    EXPECT_NEAR(std::stod(value(full, "mark_1_clock_s")), -5.90909, 1e-5);
    EXPECT_NEAR(std::stod(value(full, "mark_2_from_motion_deg")), 73.21615, 1e-5);
    EXPECT_NEAR(std::stod(value(full, "marks_apparent_length_light_s")), 17.4853, 1e-4);
    EXPECT_NEAR(std::stod(value(full, "aim_distance_light_s")), 35.79572, 1e-5);
    EXPECT_NEAR(std::stod(value(full, "ship_time_s")), 1.25, 1e-11);
    EXPECT_EQ(value(bare, "mark_1_doppler"), "");
    EXPECT_EQ(value(bare, "aim_clock_s"), "");
    EXPECT_EQ(value(bare, "doppler_1_from_motion_deg"), "");
    std::vector<std::string> sorted = names;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end()) << "a column's name is there twice";
}

TEST(Instruments, ALogIsContinuedOrRefused)
{
    const std::filesystem::path file = fresh("lab.csv");
    {
        LabLog log(file, ignore);
        EXPECT_TRUE(log.write(some_measured(), "aim"));
        // The line is in the file at once, even if the program crashes.
        ASSERT_EQ(lines_of(file).size(), 2u);
        EXPECT_EQ(log.lines(), 1);
    }
    {
        LabLog log(file, ignore);
        EXPECT_TRUE(log.write(some_measured(), "grid"));
        EXPECT_EQ(log.lines(), 2);
    }
    std::vector<std::string> lines = lines_of(file);
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[0], log_header() + "\r");
    for (const std::string& line : lines)
        EXPECT_TRUE(line.ends_with('\r'));
    // A loss of power cuts a line; the next line begins on its own.
    std::filesystem::resize_file(file, std::filesystem::file_size(file) - 9);
    LabLog(file, ignore).write(some_measured(), "ring");
    lines = lines_of(file);
    ASSERT_EQ(lines.size(), 4u);
    EXPECT_EQ(cells(lines[3]).size(), cells(lines[0]).size());

    std::ofstream(fresh("other.csv")) << "date,weather\r\n1,2\r\n";
    EXPECT_NE(refusal(scratch("other.csv")).find("begins otherwise"), std::string::npos);
    EXPECT_EQ(lines_of(scratch("other.csv")).size(), 2u); // left as it was
    EXPECT_NE(refusal(scratch("no-such-folder") / "lab.csv").find("can't be written"), std::string::npos);
    EXPECT_NE(refusal(scratch("")).find("is a folder"), std::string::npos);
    std::ofstream(fresh("empty.csv")).flush();
    LabLog(scratch("empty.csv"), ignore).write(some_measured(), "aim");
    EXPECT_EQ(lines_of(scratch("empty.csv")).size(), 2u);
}

TEST(Instruments, APageOfAComparisonSaysThatItsFormulaDoesNotHold)
{
    for (const char* language : languages) {
        const Words& words = starbow::testing::words(language);
        Measured m = some_measured();
        for (const Comparison comparison : {Comparison::galilean, Comparison::no_light_delay})
            for (std::size_t page = 1; page < why_names.size(); ++page) {
                m.effects.comparison = comparison;
                const std::vector<std::string> numbers = why_page(Why(page), m, words).numbers;
                if (Why(page) == Why::dilation) { // of the clocks on the display, which no picture changes
                    EXPECT_EQ(numbers.size(), 2u);
                } else {
                    EXPECT_EQ(numbers, std::vector<std::string>{words("why.comparison")});
                }
            }
        EXPECT_EQ(reading_fields(m, words)[4].first, words("lab.shown_at"));
    }
}

TEST(Instruments, EveryPageHasItsTextAndNumbers)
{
    Measured full = some_measured(), bare;
    bare.aim.distance_s.reset();
    const Typesetter typesetter;
    const std::regex c_number("[0-9][.][0-9]"), german_number("[0-9],[0-9]");
    for (const char* language : languages)
        for (std::size_t k = 1; k < why_names.size(); ++k)
            for (const Measured& m : {full, bare}) {
                SCOPED_TRACE(why_names[k] + std::string(" ") + language);
                const WhyPage page = why_page(Why(k), m, words(language));
                std::vector<std::string> all = page.sentence;
                all.insert(all.end(), page.numbers.begin(), page.numbers.end());
                all.insert(all.end(), {page.title, page.formula});
                EXPECT_FALSE(page.numbers.empty());
                for (const std::string& line : all) {
                    EXPECT_LT(typesetter.width_of(line, 20), 930)
                        << line << " needs letters smaller than a fiftieth of the panel";
                    EXPECT_FALSE(line.empty());
                    EXPECT_EQ(line.find_first_of("{}"), line.npos) << line;
                    EXPECT_EQ(line.find("nan"), line.npos) << line;
                    EXPECT_FALSE(std::regex_search(line, language == std::string("de") ? c_number : german_number)) << line;
                }
            }
    const auto holds = [&](Why why, const std::string& text, const char* language = "en") {
        for (const std::string& line : why_page(why, full, words(language)).numbers)
            if (line.find(text) != line.npos)
                return true;
        return false;
    };
    EXPECT_TRUE(holds(Why::aberration, "θ = 120.00° in the world, seen at θ′ = 90.00°"));
    EXPECT_TRUE(holds(Why::doppler, "= 0.866"));
    EXPECT_TRUE(holds(Why::doppler, "635 nm"));
    EXPECT_TRUE(holds(Why::headlight, "0.866³ = 0.650"));
    EXPECT_TRUE(holds(Why::delay, "35.80 s − 35.80 s on its way = 0.00 s"));
    EXPECT_TRUE(holds(Why::delay, "○ shows −5.91 s, ◇ 3.81 s: 9.71 s apart"));
    EXPECT_TRUE(holds(Why::dilation, "γ = 1.155"));
    EXPECT_TRUE(holds(Why::length, "contracted 17.32 light-s"));
    EXPECT_TRUE(holds(Why::length, "seen 17.49 light-s"));
    EXPECT_TRUE(holds(Why::delay, "○ zeigt −5,91 s, ◇ 3,81 s: 9,71 s Unterschied", "de"));
    EXPECT_TRUE(holds(Why::length, "in Ruhe 20,00 Licht-s, verkürzt 17,32 Licht-s", "de"));
}

TEST(Instruments, ReadingsUseTheLanguagesWords)
{
    using Field = std::pair<std::string, std::string>;
    Measured m = some_measured();
    const auto english = reading_fields(m, words()), german = reading_fields(m, words("de"));
    EXPECT_EQ(english[1], Field("550 nm →", "635 nm"));
    EXPECT_EQ(english[3], Field("distance", "35.80 light-s"));
    EXPECT_EQ(english[7], Field("length", "17.49 (rest 20.00 light-s)"));
    EXPECT_EQ(german[0], Field("D", "0,866"));
    EXPECT_EQ(german[3], Field("Entfernung", "35,80 Licht-s"));
    EXPECT_EQ(german[6], Field("○–◇", "31,49°"));
    EXPECT_EQ(german[7], Field("Länge", "17,49 (Ruhe 20,00 Licht-s)"));
    m.pair.reset(), m.marks = {};
    m.aim.seen_nm = 4321;
    EXPECT_EQ(reading_fields(m, words("de"))[1].second, "4321 nm infrarot");
    EXPECT_EQ(reading_fields(m, words("de"))[6], Field("zwei Dinge markieren: X", ""));
}

// No letter is cut off on a panel of any width, and all letters are on the plate.
TEST(Instruments, LettersStayOnTheirPlate)
{
    Typesetter typesetter;
    for (const char* language : languages)
        for (int width : {300, 800, 1600})
            for (std::size_t why = 0; why < why_names.size(); ++why)
                for (std::size_t overlay = 1; overlay < overlay_names.size(); ++overlay) {
                    const Panel panel = draw_lab_panel(
                        typesetter, words(language), some_measured(), {Overlay(overlay), {0.5, 100, 2}, Why(why)}, width);
                    ASSERT_EQ(panel.size, glm::ivec2(width, int(width * lab_aspect(Overlay(overlay), Why(why)))));
                    long letters = 0;
                    for (int y = 0; y < panel.size.y; ++y)
                        for (int x = 0; x < width; ++x) {
                            const std::size_t at = 2 * (std::size_t(y) * width + x);
                            letters += panel.texels[at] > 128;
                            const bool edge = x < width / 100 || x >= width - width / 100 || y == 0 || y == panel.size.y - 1;
                            EXPECT_TRUE(!edge || panel.texels[at] < 128)
                                << language << ' ' << width << ' ' << why << ' ' << overlay << ' ' << x;
                        }
                    EXPECT_GT(letters, width * panel.size.y / 80);
                }
}

// An upright picture that looks down has no room opposite its display; the panel is right above it.
TEST(Instruments, ThePanelIsWithinThePicture)
{
    Layout layout;
    layout.outputs.resize(1);
    layout.outputs[0].size = {300, 400};
    MapStore store{std::filesystem::path()};
    const HudPlacement hud{0, -26, 20};
    for (const Projection& projection : {Projection(Planar{50, {}, {0, -20, 0}}), Projection(Fisheye{100, 45})}) {
        layout.outputs[0].viewports = {{.projection = projection}};
        const std::vector<std::vector<CompiledView>> views = {compile_output(store, layout, 0, {300, 400})};
        const HudPlacement place = instruments_place(hud, readings_aspect, views);
        const bool flat = std::holds_alternative<Planar>(projection);
        if (flat) {
            EXPECT_NEAR(place.elevation_deg, -26 + 20 * panel_aspect, 3);
        } else {
            EXPECT_GT(place.elevation_deg, 15);
        }
    }
}

// The panel is opposite the display and never covers it.
TEST(Instruments, ThePanelDoesNotCoverTheDisplay)
{
    for (const double elevation : {-30.0, -24.5, -21.0, -13.0, -6.0, 0.0, 6.5, 20.0})
        for (const double width : {26.0, 40.0, 62.0})
            for (const double aspect : {readings_aspect, scaled_aspect, why_aspect}) {
                const HudPlacement hud{10, elevation, width}, place = instruments_place(hud, aspect, {});
                const double half = std::tan(width / 2 * degree), at = std::tan(elevation * degree),
                             own_at = std::tan(place.elevation_deg * degree);
                EXPECT_GE(std::abs(own_at - at), half * (panel_aspect + aspect) * 0.999) << elevation << ' ' << width;
                EXPECT_EQ(place.azimuth_deg, 10);
                EXPECT_EQ(place.width_deg, width);
            }
}

} // namespace instruments_test
