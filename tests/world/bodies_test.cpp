// Moving bodies in numbers: rest frames compared with boosts in 33 digits, retarded times with bisection, worldlines, and
// the errors in scene files.
#include "config/json/error.h"
#include "config/model/angles.h"
#include "runtime/plan/cull.h"
#include "runtime/world/instances.h"
#include "runtime/world/worldline.h"
#include "shaders/physics/physics.h"
#include "tests/support/files.h"
#include "tests/support/quad.h"
#include "tests/support/speeds.h"
#include <gtest/gtest.h>
#include <random>

namespace bodies_test {

using namespace starbow;
using namespace starbow::testing;
using glm::dvec3;

namespace {

using starbow::testing::u_of_beta, starbow::testing::u_of_gamma;

dvec3 random_way(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    return glm::normalize(dvec3(normal(random), normal(random), normal(random)));
}

/// The 4-vector e of the world, in the frame that moves with u: a boost along and across the motion.
quad::V4 into(const quad::V3& u, const quad::V4& e) { return quad::boosted(u * -1, e); }

double off(const dvec3& a, const quad::V3& b) { return double(quad::length(quad::of(a) - b)); }

} // namespace

TEST(Relative, EqualsOneBoostAfterTheOther)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> decades(0, 6), small(-8, 0);
    for (int i = 0; i < 4000; ++i) {
        const double gamma = std::pow(10, decades(random));
        const dvec3 w = random_way(random) * u_of_gamma(gamma);
        // Every other pair is nearly equal.
        const dvec3 u = i % 2 ? random_way(random) * u_of_gamma(std::pow(10, decades(random)))
                              : w + random_way(random) * (gamma * std::pow(10, small(random)));
        const auto relative = physics::relative(w, u);
        const quad::V3 qw = quad::of(w), qu = quad::of(u);
        const quad::V4 truth = into(qw, {quad::gamma(qu), qu});
        const double size = double(quad::length(truth.x));
        // The tolerance is the effect of eight roundings of u or w: in the other's frame one rounding is gamma 1e-16 of a
        // turn.
        const double most = std::max(physics::gamma_of(u), gamma);
        EXPECT_LT(off(relative.u, truth.x), 8 * 0x1p-53 * most * (1 + size)) << "gamma " << gamma << " size " << size;
        // The cockpit's axes must satisfy boost(w) boost(relative) turn = boost(u); one axis is checked.
        const dvec3 x = random_way(random);
        const glm::dquat turn(relative.turn.w, relative.turn.x, relative.turn.y, relative.turn.z);
        const quad::V4 direct = quad::boosted(qu, {0, quad::of(x)});
        const quad::V4 around = quad::boosted(qw, quad::boosted(quad::of(relative.u), {0, quad::of(turn * x)}));
        EXPECT_LT(double(quad::length(direct.x - around.x)), 2e-14 * most * most) << "gamma " << gamma;
        EXPECT_NEAR(glm::length(turn), 1, 1e-15);
    }
}

TEST(Relative, OfTheSameVelocityIsRest)
{
    for (double gamma : {1.0, 4.0, 1e4, 1e8}) {
        const dvec3 u = glm::normalize(dvec3(1, 2, -3)) * u_of_gamma(gamma);
        const auto relative = physics::relative(u, u);
        EXPECT_EQ(relative.u, dvec3(0));
        EXPECT_EQ(relative.turn, glm::dvec4(0, 0, 0, 1));
    }
}

TEST(Relative, RotatesByTheWignerAngle)
{
    // Angles of perpendicular boosts from docs/physics/relativity.md.
    for (auto [a, b, angle] : {std::tuple(0.5, 0.5, 8.21321), {0.8, 0.6, 18.92464}, {0.9, 0.9, 42.89620}}) {
        const auto relative = physics::relative(dvec3(u_of_beta(a), 0, 0), dvec3(0, u_of_beta(b), 0));
        EXPECT_NEAR(2 * std::asin(glm::length(dvec3(relative.turn))) / degree, angle, 1e-5);
    }
}

TEST(RetardedPositionTest, IsOnThePastLightCone)
{
    // Bisection of the light cone's equation in 33 digits; it shares nothing with the closed form.
    std::mt19937 random(3);
    std::uniform_real_distribution<double> decades(0, 4), scale(-3, 3);
    for (int i = 0; i < 2000; ++i) {
        const double gamma = i < 4 ? std::array{1.0, 1 + 1e-9, 2.0, 1e4}[std::size_t(i)] : std::pow(10, decades(random));
        const double u = u_of_gamma(gamma);
        dvec3 r = random_way(random) * std::pow(10, scale(random));
        if (i % 3 == 0) // a close pass, where the two roots have very different sizes
            r.x *= 1 / gamma, r.y *= 1 / gamma;
        const quad::Q qg = gamma, qu = sqrtq(qg * qg - 1), v = qu / qg;
        auto late = [&](quad::Q t) { // time between the observer's event and the arrival of light that leaves at t < 0
            return t + quad::length({r.x, r.y, quad::Q(r.z) + v * t});
        };
        quad::Q low = -1, high = 0;
        while (late(low) > 0)
            low *= 2;
        for (int k = 0; k < 200; ++k) {
            const quad::Q middle = (low + high) / 2;
            (late(middle) > 0 ? high : low) = middle;
        }
        const double tau = double(low / qg), delay = double(-low);
        const double far = double(quad::Q(r.z) + v * low);
        const double D = double(-low / (qg * (-low) + qu * (quad::Q(r.z) + v * low)));
        const auto fine = physics_double::retarded_position(r, {0, 0, 1}, u, gamma);
        EXPECT_NEAR(fine.tau / tau, 1, 1e-14) << gamma;
        EXPECT_NEAR(fine.delay / delay, 1, 1e-14);
        EXPECT_NEAR(fine.D / D, 1, 1e-13);
        EXPECT_NEAR(fine.place.z, far, 1e-13 * std::max(delay, glm::length(r)));
        // In float with the same rounded inputs, retarded times agree within 1e-6.
        const glm::vec3 rf(r);
        const auto coarse = physics_float::retarded_position(rf, {0, 0, 1}, float(u), float(gamma));
        const auto rounded = physics_double::retarded_position(dvec3(rf), {0, 0, 1}, double(float(u)), double(float(gamma)));
        EXPECT_NEAR(coarse.tau / rounded.tau, 1, 1e-6) << gamma;
        EXPECT_NEAR(coarse.delay / rounded.delay, 1, 1e-6) << gamma;
        EXPECT_NEAR(coarse.D / rounded.D, 1, 1e-6) << gamma;
    }
}

TEST(RetardedPositionTest, APassHasTheTextbooksValues)
{
    for (double beta : {0.5, 0.9, 0.999}) {
        const double u = u_of_beta(beta), gamma = std::sqrt(1 + u * u), L = 3;
        // Abeam now: it is seen atan(gamma beta) behind, and its light travelled gamma L. Its own clock then showed -L, and
        // D = gamma.
        const auto abeam = physics::retarded_position({L, 0, 0}, {0, 0, 1}, u, gamma);
        EXPECT_NEAR(std::atan2(-abeam.place.z, abeam.place.x), std::atan(u), 1e-14);
        EXPECT_NEAR(abeam.delay, gamma * L, 1e-13 * gamma * L);
        EXPECT_NEAR(abeam.D, gamma, 1e-13 * gamma);
        // Seen abeam: D = 1 / gamma.
        const auto seen = physics::retarded_position({L, 0, beta * L}, {0, 0, 1}, u, gamma);
        EXPECT_NEAR(seen.place.z, 0, 1e-11);
        EXPECT_NEAR(seen.D, 1 / gamma, 1e-12);
        // The apparent speed before and after the closest point.
        const double step = 1e-4;
        auto apparent = [&](double from) {
            return std::abs(physics::retarded_position({0, 0, from + beta * step}, {0, 0, 1}, u, gamma).place.z
                       - physics::retarded_position({0, 0, from}, {0, 0, 1}, u, gamma).place.z)
                / step;
        };
        EXPECT_NEAR(apparent(-10) / (beta / (1 - beta)), 1, 1e-7);
        EXPECT_NEAR(apparent(10) / (beta / (1 + beta)), 1, 1e-7);
    }
}

TEST(Worldline, SegmentsKeepTheBodysProperTime)
{
    Body traveller;
    traveller.worldline = {{-5, {0, 0, 0}}, {0, {0, 0, 0}}, {10, {0, 0, -8}}, {20, {0, 0, 0}}, {30, {0, 0, 0}}};
    const auto segments = segments_of(traveller);
    ASSERT_EQ(segments.size(), 4u);
    EXPECT_EQ(segments[0].u, dvec3(0));
    EXPECT_NEAR(segments[1].u.z, -4.0 / 3, 1e-15);
    EXPECT_NEAR(segments[2].u.z, 4.0 / 3, 1e-15);
    // The twin ages by 5 at home, 6 out and 6 back: eight years less than the other.
    EXPECT_NEAR(segments[3].begin, 17, 1e-14);
    EXPECT_NEAR(segments[3].end, 27, 1e-14);
    EXPECT_EQ(segments[1].begin, segments[0].end);
}

TEST(Worldline, AFrameSeesTheShipByTwoBoosts)
{
    std::mt19937 random(9);
    for (int i = 0; i < 200; ++i) {
        const RestFrame frame{random_way(random) * 3.0, {2, {1, -4, 5}}};
        Shot shot;
        shot.time = 7, shot.position = random_way(random) * 20.0, shot.u = random_way(random) * 2.0;
        shot.ship_from_cockpit = glm::normalize(glm::dquat(1, 0.2, -0.4, 0.7));
        const Shot moved = in_frame(frame, shot);
        const quad::V4 event
            = into(quad::of(frame.u), {shot.time - frame.origin.time, quad::of(shot.position - frame.origin.position)});
        EXPECT_NEAR(moved.time, double(event.t), 1e-12);
        EXPECT_LT(off(moved.position, event.x), 1e-12);
        // The origin of a light ray in the cockpit, by way of the frame and directly.
        const dvec3 ray = random_way(random);
        const auto direct = quad::world_from_camera(quad::of(shot.ship_from_cockpit * ray), quad::of(shot.u));
        const auto there = quad::world_from_camera(quad::of(moved.ship_from_cockpit * ray), quad::of(moved.u));
        const auto around = quad::world_from_camera(there.n, quad::of(frame.u));
        EXPECT_LT(quad::angle(direct.n, around.n), 1e-14);
        EXPECT_NEAR(double(there.D * around.D / direct.D), 1, 1e-14);
    }
}

TEST(Worldline, LightFromInfinityIsAberratedAsA4Vector)
{
    std::mt19937 random(4);
    for (double gamma : {1.0, 2.0, 50.0, 1e5})
        for (int i = 0; i < 50; ++i) {
            const dvec3 way = random_way(random),
                        u = (i % 2 ? random_way(random) : -way + 1e-3 / gamma * random_way(random)) * u_of_gamma(gamma);
            double D;
            const dvec3 n = aberrated(u, way, D);
            const quad::V4 p = into(quad::of(u), {1, quad::unit(quad::of(way)) * -1});
            EXPECT_NEAR(D / double(p.t), 1, 1e-9) << gamma;
            EXPECT_LT(quad::angle(quad::of(n), p.x * -1), 4e-15 * gamma + 1e-14)
                << gamma; // a few roundings, which are 2 gamma times as large behind
        }
}

TEST(Bodies, WrongFilesAreRefusedWithTheReason)
{
    const std::string before = R"({"gltf": "w.glb", "bodies": [)", after = "]}";
    const std::vector<std::pair<std::string, std::string>> wrong = {
        {R"({"name": "a", "nodes": ["x"]})", "lacks \"velocity\""},
        {R"({"name": "a", "nodes": [], "velocity": {"direction": [1,0,0], "beta": 0.5}})", "/bodies/0/nodes"},
        {R"({"name": "a", "nodes": ["x"], "velocity": {"direction": [1,0,0], "beta": 1}})",
            "nothing reaches the speed of light"},
        {R"({"name": "a", "nodes": ["x"], "worldline": [{"time": 0}]})", "/bodies/0/worldline"},
        {R"({"name": "a", "nodes": ["x"], "worldline": [{"time": 1}, {"time": 1}]})", "is not after the event before it"},
        {R"({"name": "a", "nodes": ["x"], "worldline": [{"time": 0}, {"time": 1, "position": [0, 1, 0]}]})",
            "can't be reached at less than the speed of light"},
        {R"({"name": "a", "nodes": ["x"], "velocity": {"direction": [1,0,0], "beta": 0.5}, "worldline": [{"time": 0}, {"time": 1}]})",
            "one of the two is right"},
        {R"({"name": "a", "nodes": ["x"], "worldline": [{"time": 0}, {"time": 1}]}, {"name": "a", "nodes": ["x"], "worldline": [{"time": 0}, {"time": 1}]})",
            "is the name of another body"},
    };
    for (const auto& [body, problem] : wrong) {
        const auto file = write_text("wrong-body.json", before + body + after);
        try {
            load_scene_file(file);
            ADD_FAILURE() << body;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(problem), std::string::npos) << error.what();
        }
    }
}

namespace {

/// Small boxes, each on a node with a name of its own.
World boxes(const std::vector<std::string>& names)
{
    World world;
    world.materials.emplace_back();
    world.primitives.push_back({0, 3, 0, 0, dvec3(-1), dvec3(1), dvec3(0), std::sqrt(3.0), {}});
    for (const std::string& name : names) {
        world.instances.push_back({glm::dmat4(glm::dmat3(0.01)), 0, int(world.nodes.size())});
        world.nodes.push_back({name, -1});
    }
    return world;
}

} // namespace

TEST(Bodies, AreSeenInTheFrameOfTheirSegment)
{
    World world = boxes({"home", "ship", "wheel"});
    world.nodes[2].parent = 1; // part of the ship
    SceneFile scene;
    scene.gltf = "w.glb";
    scene.bodies = {{"ship", {"ship"}, {}, {}, {{0, {0, 0, 0}}, {10, {0, 0, -8}}, {20, {0, 0, 0}}}}};
    place_bodies(world, scene);
    sort_instances(world);
    ASSERT_EQ(world.frames.size(), 3u);
    ASSERT_EQ(world.instances.size(), 5u);
    EXPECT_EQ(instances_of(world, 0).last, 1u);
    for (int frame : {1, 2}) {
        const auto range = instances_of(world, frame);
        EXPECT_EQ(range.last - range.first, 2u);
        EXPECT_TRUE(timed(world, world.instances[range.first]));
    }
    // The ship turns at (10, -8), and the light of the turn reaches home at 18: until then the ship is seen going out.
    auto seen = [&](double time) {
        std::array<std::size_t, 3> counts{};
        for (int frame = 0; frame < 3; ++frame) {
            Shot shot;
            shot.time = time, shot.position = dvec3(0, 0.01, 0);
            const Shot there = in_frame(world.frames[std::size_t(frame)], shot);
            counts[std::size_t(frame)] = bounding_spheres(world, {frame, there.position, there.time}).size();
        }
        return counts;
    };
    EXPECT_EQ(seen(-5), (std::array<std::size_t, 3>{1, 0, 0}));
    EXPECT_EQ(seen(15), (std::array<std::size_t, 3>{1, 2, 0}));
    EXPECT_EQ(seen(19.9), (std::array<std::size_t, 3>{1, 0, 2}));
    EXPECT_EQ(seen(35), (std::array<std::size_t, 3>{1, 0, 0}));
}

TEST(Bodies, MissingNodesAndTooManyVelocitiesAreRefused)
{
    SceneFile scene;
    scene.file = "s.json", scene.gltf = "w.glb";
    scene.bodies = {{"ship", {"boat"}, {1, 0, 0}, {}, {}}};
    World world = boxes({"ship"});
    EXPECT_THROW(
        try { place_bodies(world, scene); } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("names the node \"boat\""), std::string::npos) << error.what();
            throw;
        },
        InputError);
    scene.bodies.clear();
    for (int i = 0; i < 20; ++i)
        scene.bodies.push_back({"ship " + std::to_string(i), {"ship"}, {0.1 * (i + 1), 0, 0}, {}, {}});
    world = boxes({"ship"});
    EXPECT_NE(complaint([&] { place_bodies(world, scene); }).find("different velocities; so many at most is right"),
        std::string::npos);
}

TEST(CubeMapPlan, AFrameOutsideTheViewGetsNoImages)
{
    const ConeHierarchy cones(
        glm::dmat3(glm::dvec3(0.01, 0, 0), glm::dvec3(0, -0.01, 0), glm::dvec3(-0.5, 0.5, -1)), {100, 100});
    const glm::dmat3 turn = motion_from_world({}, glm::dquat(1, 0, 0, 0));
    auto plan_with = [&](const dvec3& centre) {
        return plan_cube_map(
            {RestFrameRequest{{{&cones, turn}}, 1},
                RestFrameRequest{{{&cones, turn}}, 3, false, std::vector<BoundingSphere>{{turn * centre, 1}}}},
            {});
    };
    const CubeMapPlan none = plan_cube_map({RestFrameRequest{{{&cones, turn}}, 1}}, {});
    for (const dvec3& behind : {dvec3(0, 0, 20), dvec3(30, 0, 5)})
        EXPECT_EQ(plan_with(behind).images.size(), none.images.size());
    const CubeMapPlan seen = plan_with({0, 0, -20});
    EXPECT_GT(seen.images.size(), none.images.size());
    EXPECT_LT(seen.texels, 1.3 * none.texels); // a ball 6 degrees wide in a view of 53 degrees
}

} // namespace bodies_test
