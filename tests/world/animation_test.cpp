// Blinking, spinning and animated objects in numbers, compared with retarded times by bisection in 33 digits, and with
// glTF's formulas written independently.
#include "config/json/error.h"
#include "runtime/plan/cull.h"
#include "runtime/world/clock.h"
#include "runtime/world/fastest_motion.h"
#include "runtime/world/instances.h"
#include "runtime/world/moving.h"
#include "runtime/world/worldline.h"
#include "shaders/physics/physics.h"
#include "tests/support/gltf_fixture.h"
#include "tests/support/quad.h"
#include "tests/support/speeds.h"
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <random>

namespace animation_test {

using namespace starbow;
using glm::dvec3;

namespace {

using starbow::testing::u_of_beta;

/// One small box on a node "thing" with a blinking material.
World lamp(const Blink& blink)
{
    World world;
    world.materials.emplace_back();
    world.materials[0].blink = blink;
    world.primitives.push_back({0, 3, 0, 0, dvec3(-0.01), dvec3(0.01), dvec3(0), 0.02, {}});
    world.nodes.push_back({"thing", -1});
    world.instances.push_back({glm::dmat4(1), 0, 0});
    return world;
}

/// The event of an eye that rests in the world, in the coordinates of a frame.
EyeEvent eye_event_of(const World& world, int frame, const Event& at)
{
    Shot shot;
    shot.time = at.time, shot.position = at.position;
    const Shot there = in_frame(world.frames[std::size_t(frame)], shot);
    return {frame, there.position, there.time};
}

} // namespace

TEST(Blink, ArrivesAtDTimesItsRate)
{
    // A lamp passes by. Its blinks arrive at D times their own rate, along the whole way.
    for (double beta : {0.3, 0.8, 0.95}) {
        const double u = u_of_beta(beta), gamma = std::sqrt(1 + u * u), period = 0.02;
        World world = lamp({period, 0.25, 0.3});
        SceneFile scene;
        scene.bodies = {{"lamp", {"thing"}, {u, 0, 0}, {1, {0, 0, -2}}, {}}};
        place_bodies(world, scene);
        sort_instances(world);
        auto phase = [&](double t) {
            const auto entries = time_entries(world, eye_event_of(world, 1, {t, {0, 0, 0}}), 1);
            EXPECT_EQ(entries.size(), 1u);
            return double(entries.at(0).blink.x);
        };
        auto seen = [&](double t) { return physics::retarded_position({beta * (t - 1), 0, -2}, {1, 0, 0}, u, gamma); };
        const double step = 0.0005, window = 100 * step; // at most 6.3 blinks in a period of the eye's: 0.16 in a step
        double t = -15, before = phase(t), count = 0;
        for (; t < 18; t += window) {
            const double first = count;
            for (int i = 1; i <= 100; ++i) {
                const double now = phase(t + i * step);
                count += now - before < -0.5 ? now - before + 1 : now - before;
                before = now;
            }
            const double D = (seen(t).D + 4 * seen(t + window / 2).D + seen(t + window).D) / 6; // Simpson's mean
            // A window has 2.5 to 16 blinks; each of its ends is known to a float's 6e-8.
            const double blinks = D * window / period;
            EXPECT_NEAR((count - first) / blinks, 1, 1e-6 * std::max(1.0, 0.13 / blinks)) << beta << " at " << t;
        }
        // The total, from the light cone's equation by bisection.
        auto own = [&](double at) {
            quad::Q low = -1e4, high = 0;
            for (int k = 0; k < 150; ++k) {
                const quad::Q middle = (low + high) / 2; // time in the world since the emission
                const quad::Q x = quad::Q(beta) * (at + middle - 1);
                (middle + sqrtq(x * x + 4) > 0 ? high : low) = middle;
            }
            return (at + low - 1) / quad::Q(gamma);
        };
        EXPECT_NEAR(count / double((own(t) - own(-15)) / period), 1, 1e-9) << beta;
    }
}

TEST(Blink, StartsAtItsZeroInItsProperTime)
{
    World world = lamp({4, 0.25, 3});
    sort_instances(world);
    // The lamp is 10 s of light away, with two seconds for a unit of time: at 21 s its state of 11 s is seen.
    const auto entries = time_entries(world, {0, {0, 0, 5}, 10.5}, 2);
    ASSERT_EQ(entries.size(), 1u);
    EXPECT_NEAR(entries[0].blink.x, (11 - 3) % 4 / 4.0, 1e-7);
    EXPECT_EQ(entries[0].blink.y, 0.5f);
    EXPECT_EQ(entries[0].blink.z, 0.25f);
}

namespace {

using glm::dvec4;

dvec4 random4(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    return {normal(random), normal(random), normal(random), normal(random)};
}

/// glTF 2.0, appendix C; t lies within the keys.
dvec4 by_specification(const Track& track, double t)
{
    std::size_t k = 0;
    while (k + 2 < track.times_s.size() && track.times_s[k + 1] <= t)
        ++k;
    const double td = track.times_s[k + 1] - track.times_s[k], s = (t - track.times_s[k]) / td;
    if (track.interpolation == Interpolation::step)
        return track.values[k];
    if (track.interpolation == Interpolation::cubic) {
        const dvec4 v = track.values[3 * k + 1], b = track.values[3 * k + 2], a = track.values[3 * k + 3],
                    w = track.values[3 * k + 4];
        const double s2 = s * s, s3 = s2 * s;
        const dvec4 out
            = (2 * s3 - 3 * s2 + 1) * v + td * (s3 - 2 * s2 + s) * b + (-2 * s3 + 3 * s2) * w + td * (s3 - s2) * a;
        return track.rotation ? out / std::sqrt(glm::dot(out, out)) : out;
    }
    const dvec4 v = track.values[k], w = track.values[k + 1];
    if (!track.rotation)
        return (1 - s) * v + s * w;
    const double d = glm::dot(v, w), a = std::acos(std::abs(d)), sign = d < 0 ? -1 : 1;
    return std::sin(a * (1 - s)) / std::sin(a) * v + sign * std::sin(a * s) / std::sin(a) * w;
}

} // namespace

TEST(Animation, FollowsTheSpecification)
{
    std::mt19937 random(8);
    std::uniform_real_distribution<double> part(0, 1);
    for (int round = 0; round < 300; ++round) {
        Track track;
        track.interpolation
            = std::array{Interpolation::step, Interpolation::linear, Interpolation::cubic}[std::size_t(round % 3)];
        track.rotation = round % 2;
        const int keys = 2 + int(random() % 5), values = track.interpolation == Interpolation::cubic ? 3 : 1;
        double time = part(random) * (round % 4 == 0 ? 0 : 1);
        for (int i = 0; i < keys; ++i, time += 0.05 + part(random)) {
            track.times_s.push_back(time);
            for (int k = 0; k < values; ++k) {
                const dvec4 value = random4(random);
                track.values.push_back(track.rotation && (values == 1 || k == 1) ? glm::normalize(value) : value);
            }
        }
        track.length_s = track.times_s.back() + (round % 5 == 0 ? 0.7 : 0);
        for (int i = 0; i < 40; ++i) {
            const double t = part(random) * track.length_s;
            const double clamped = std::clamp(t, track.times_s.front(), track.times_s.back());
            dvec4 expected = by_specification(track, clamped);
            if (t >= track.times_s.back()) // a step's last value begins with its key
                expected = track.values[values == 3 ? track.values.size() - 2 : track.values.size() - 1];
            for (int rounds : {0, 1, -1, 7}) {
                dvec4 found = value_at(track, t + rounds * track.length_s);
                if (track.rotation && glm::dot(found, expected) < 0)
                    found = -found;
                EXPECT_LT(glm::length(found - expected), 1e-12)
                    << round << " at " << t; // the rounding of a time of some units
            }
        }
    }
}

TEST(Animation, UnbrokenSpansEndAtJumps)
{
    Track steps{Interpolation::step, false, 10, {1, 4, 6}, {dvec4(0), dvec4(1), dvec4(0)}};
    auto expect = [](const Unbroken& found, double begin, double end) {
        EXPECT_NEAR(found.begin_s, begin, 1e-12);
        EXPECT_NEAR(found.end_s, end, 1e-12);
    };
    expect(unbroken(steps, 4.5), 4, 6);
    expect(unbroken(steps, 8), 6, 14); // the track repeats here without a jump
    expect(unbroken(steps, -7), -14, -6);
}

namespace {

/// One instance of a box on an animated joint, at rest in the world.
World moving_world(const Joint& joint, std::vector<Track> tracks, const dvec3& low, const dvec3& high)
{
    World world;
    world.materials.emplace_back();
    world.primitives.push_back({0, 3, 0, 0, low, high, 0.5 * (low + high), 0.5 * glm::length(high - low), {}});
    world.nodes.push_back({"thing", -1});
    world.joints = {joint};
    world.tracks = std::move(tracks);
    world.motions = {{0}};
    Instance instance{glm::dmat4(1), 0, 0};
    instance.motion = 0;
    world.instances.push_back(instance);
    return world;
}

/// A movement between two places and back, at even speed, 20 s for both ways.
Track shuttle(const dvec3& a, const dvec3& b)
{
    return {Interpolation::linear, false, 20, {0, 10, 20}, {dvec4(a, 0), dvec4(b, 0), dvec4(a, 0)}};
}

quad::V3 shuttle_place(const dvec3& a, const dvec3& b, quad::Q t)
{
    t = t - 20 * floorq(t / 20);
    const quad::Q part = t < 10 ? t / 10 : 2 - t / 10;
    return quad::of(a) + (quad::of(b) - quad::of(a)) * part;
}

} // namespace

TEST(Animation, AShuttleIsSeenAtItsRetardedPosition)
{
    const dvec3 a(-1.3, 0.2, -4), b(0.5, 0.4, -4.6);
    for (const dvec3& u : {dvec3(0), dvec3(0.9, -0.4, 1.2)}) {
        World world = moving_world({.node = 0, .translations = 0}, {shuttle(a, b)}, dvec3(-0.1), dvec3(0.1));
        SceneFile scene;
        if (u != dvec3(0))
            scene.bodies = {{"shuttle", {"thing"}, u, {3, {0.1, 0.2, 0.3}}, {}}};
        place_bodies(world, scene);
        sort_instances(world);
        const int frame = u == dvec3(0) ? 0 : 1;
        for (double t : {-31.7, 0.0, 0.01, 5.0, 9.99, 27.2, 1e7 + 3.3}) {
            // The eye's event is where the body is; after months a resting eye would be far away.
            const Event at{t, u / physics::gamma_of(u) * (t - 3)};
            const EyeEvent eye_event = eye_event_of(world, frame, at);
            const SeenPose seen = seen_pose(world, world.instances[0], eye_event);
            const double zero = world.instances[0].existence < 0
                ? 0
                : world.existence_intervals[std::size_t(world.instances[0].existence)].zero;
            const dvec3 place = world.motions[std::size_t(world.instances[0].motion)].place;
            quad::Q low = eye_event.time - 100.0, high = eye_event.time;
            for (int i = 0; i < 150; ++i) {
                const quad::Q middle = (low + high) / 2;
                const quad::V3 from = shuttle_place(a, b, middle - zero) + quad::of(place) - quad::of(eye_event.place);
                (middle + quad::length(from) > eye_event.time ? high : low) = middle;
            }
            const quad::V3 expected = shuttle_place(a, b, low - zero) + quad::of(place);
            // 1e-12 of the distance, plus a double's rounding of the time.
            const double room = 1e-11 + 8 * 0x1p-52 * std::abs(eye_event.time);
            EXPECT_LT(double(quad::length(quad::of(dvec3(seen.frame_from_local[3])) - expected)), room) << t;
            EXPECT_NEAR(seen.sent, double(low), room) << t;
        }
    }
}

TEST(Animation, DuringAJumpAWholePoseIsAlwaysSeen)
{
    // At 5 s the object jumps away from the eye: for a while no light of either place arrives. At 10 s it jumps back, and
    // for a while the light of both arrives.
    Track jump{Interpolation::step, false, 20, {0, 5, 10}, {dvec4(0, 0, -1, 0), dvec4(0, 0, -8, 0), dvec4(0, 0, -1, 0)}};
    World world = moving_world({.node = 0, .translations = 0}, {jump}, dvec3(-3), dvec3(3));
    for (double t = 0; t < 40; t += 0.0625) {
        const EyeEvent eye_event{0, {0, 0, 0}, t};
        const SeenPose seen = seen_pose(world, world.instances[0], eye_event);
        const double away = -seen.frame_from_local[3].z;
        EXPECT_TRUE(away == 1 || away == 8) << t;
        const double in = std::fmod(t, 20);
        if (in < 5.9 || (in > 11.1 && in < 12.9)
            || in > 18.1) { // no light from 6 to 11 s, light of both places from 13 to 18 s
            EXPECT_EQ(away, 1) << t;
        }
        // All poses of the draw are the same place.
        for (double time : pose_times(world, world.instances[0], seen))
            EXPECT_EQ(pose_at(world, world.instances[0], time)[3].z, seen.frame_from_local[3].z) << t;
    }
}

TEST(Animation, EveryCornerLiesWithinTheBounds)
{
    // Bisection finds the retarded time of each box corner: the corner's distance from the middle, and its light-travel
    // offset, must lie within the bounds.
    std::mt19937 random(4);
    std::uniform_real_distribution<double> part(0, 1);
    std::normal_distribution<double> normal;
    double largest = 0;
    for (int round = 0; round < 200; ++round) {
        const dvec3 low(-part(random), -part(random), -part(random)), high(part(random), part(random), part(random));
        Joint joint{.node = 0};
        const double reach = std::sqrt(3.0); // the greatest extent, which keeps the tips below 0.2 c
        joint.spin = Spin{dvec3(normal(random), normal(random), normal(random)), 0.1 * part(random) / (2 * 3.1416 * reach)};
        joint.translations = 0;
        joint.above_from_parent = glm::translate(glm::dmat4(1), dvec3(normal(random), normal(random), normal(random)) * 3.0);
        World world
            = moving_world(joint, {shuttle({0, 0, 0}, dvec3(part(random), part(random), part(random)) * 0.5)}, low, high);
        const EyeEvent eye_event{0, {0, 0, 0}, 100 * part(random)};
        const SeenPose seen = seen_pose(world, world.instances[0], eye_event);
        const dvec3 middle(seen.frame_from_local * dvec4(0.5 * (low + high), 1));
        const auto times = pose_times(world, world.instances[0], seen);
        for (int corner = 0; corner < 8; ++corner) {
            const dvec4 point(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z, 1);
            double before = eye_event.time - 100, after = eye_event.time;
            for (int i = 0; i < 80; ++i) {
                const double time = 0.5 * (before + after);
                (time + glm::length(dvec3(pose_at(world, world.instances[0], time) * point)) > eye_event.time ? after
                                                                                                              : before)
                    = time;
            }
            const dvec3 at(pose_at(world, world.instances[0], before) * point);
            EXPECT_LE(glm::distance(at, middle), seen.window);
            EXPECT_LE(std::abs(before - seen.sent), seen.window);
            EXPECT_GE(before, times.front() - 1e-9);
            EXPECT_LE(before, times.back() + 1e-9);
            largest = std::max(largest, glm::distance(at, middle) / seen.window);
        }
    }
    EXPECT_GT(largest, 0.8); // the bound is not much wider than necessary
}

namespace {

using AnimationFile = gltf_test::GltfTest;
using gltf_test::Doc;
using gltf_test::Json;

/// A triangle on a fixed node below an animated one, which is below a rotated one.
Doc animated()
{
    Doc doc = gltf_test::triangle_doc();
    doc.json["nodes"][0]["translation"] = {1, 0, 0};
    const int arm = doc.put("nodes", {{"children", {0}}, {"name", "arm"}, {"scale", {2, 2, 2}}});
    const int base = doc.put(
        "nodes", {{"children", {arm}}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}, {"translation", {0, 5, 0}}});
    doc.json["scenes"][0]["nodes"] = {base};
    const int times = doc.accessor<float>({0.5, 20.5, 40.5}, "SCALAR");
    const int places = doc.accessor<float>({0, 0, 0, 1, 0, 0, 0, 0, 0}, "VEC3");
    const int turns = doc.accessor<std::int16_t>({0, 0, 0, 32767, 0, 0, 23170, 23170, 0, 0, 0, 32767}, "VEC4", true);
    doc.json["animations"] = {
        {{"samplers",
             {{{"input", times}, {"output", places}}, {{"input", times}, {"output", turns}, {"interpolation", "LINEAR"}}}},
            {"channels",
                {{{"sampler", 0}, {"target", {{"node", arm}, {"path", "translation"}}}},
                    {{"sampler", 1}, {"target", {{"node", arm}, {"path", "rotation"}}}}}}}};
    return doc;
}

} // namespace

TEST_F(AnimationFile, AppliesTheNodesAboveAndBelow)
{
    const World world = load(animated());
    EXPECT_EQ(world.notes, std::vector<std::string>{});
    ASSERT_EQ(world.motions.size(), 1u);
    ASSERT_EQ(world.joints.size(), 1u);
    ASSERT_EQ(world.tracks.size(), 2u);
    ASSERT_EQ(world.instances.size(), 1u);
    // The corner (0, 1, 0) by hand: translated by 1, scaled by 2, rotated by the animation, translated, rotated by 90
    // degrees, raised by 5.
    auto corner = [&](double time) { return dvec3(pose_at(world, world.instances[0], time) * dvec4(0, 1, 0, 1)); };
    const double root = std::sqrt(0.5);
    EXPECT_LT(glm::distance(corner(0), dvec3(-2, 7, 0)), 1e-6); // before the first key
    EXPECT_LT(glm::distance(corner(0.5), dvec3(-2, 7, 0)), 1e-6);
    // Halfway to the second key: 45 degrees, and a translation by 0.5.
    EXPECT_LT(
        glm::distance(corner(10.5), dvec3(-(2 * root + 2 * root), 5 + 0.5 + 2 * root - 2 * root, 0)), 1e-4); // 16-bit values
    EXPECT_LT(glm::distance(corner(20.5), dvec3(-2, 5 + 1 - 2, 0)), 1e-4);
    EXPECT_LT(glm::distance(corner(20.5 + 40.5), corner(20.5)), 1e-12);
    EXPECT_LT(glm::distance(corner(20.5 - 81), corner(20.5)), 1e-12);
    EXPECT_EQ(world.instances[0].frame_from_local, pose_at(world, world.instances[0], 0));
}

TEST_F(AnimationFile, SpinsTurnRigidlyAboutTheNodesOrigin)
{
    Doc doc = gltf_test::triangle_doc();
    doc.json["nodes"][0]["translation"] = {3, 0, 0};
    doc.json["nodes"][0]["scale"] = {1, 2, 1};
    doc.json["nodes"][0]["extras"] = {{"starbow", {{"spin", {{"axis", {0, 0, 2}}, {"turns_per_s", 0.01}}}}}};
    World world = load(doc);
    auto at
        = [&](double time, const dvec3& point) { return dvec3(pose_at(world, world.instances[0], time) * dvec4(point, 1)); };
    EXPECT_LT(glm::distance(at(0, {2, 0, 0}), dvec3(5, 0, 0)), 1e-12);
    EXPECT_LT(glm::distance(at(25, {2, 0, 0}), dvec3(3, 2, 0)), 1e-12);
    EXPECT_LT(glm::distance(at(25, {0, 1, 0}), dvec3(1, 0, 0)), 1e-12);
    EXPECT_LT(glm::distance(at(1e7 + 25, {2, 0, 0}), dvec3(3, 2, 0)), 1e-9);
    // A mirroring node reverses the rotation.
    doc.json["nodes"][0]["scale"] = {-1, 2, 1};
    world = load(doc);
    EXPECT_LT(glm::distance(at(25, {2, 0, 0}), dvec3(3, 2, 0)), 1e-12);
    EXPECT_LT(glm::distance(at(0, {2, 0, 0}), dvec3(1, 0, 0)), 1e-12);
}

TEST_F(AnimationFile, AMovementThatIsTooFastIsRefused)
{
    SceneFile scene;
    scene.gltf = "w.glb";
    // The farthest corner, (2, 0, 0), is 6 from the arm's origin and moves by pi / 2 in 20 s. At its start the translation
    // of 1 / 20 is at right angles to that.
    const double most = std::hypot(6 * 1.5707963 / 20, 0.05);
    ASSERT_EQ(scene.unit_m, scene.light_speed_m_s); // one second for a unit
    scene.unit_m *= 0.2 / most * 1.01;
    const std::string fast = gltf_test::speed_complaint(load(animated()), scene);
    EXPECT_NE(fast.find("(\"arm\") moves at 0.2"), std::string::npos);
    EXPECT_TRUE(fast.ends_with("by a smaller \"unit_m\" or a larger \"light_speed_m_s\" in the scene")) << fast;
    scene.unit_m = scene.light_speed_m_s * 0.2 / most * 0.99;
    EXPECT_EQ(gltf_test::speed_complaint(load(animated()), scene), "");

    Doc doc = gltf_test::triangle_doc();
    doc.json["nodes"][0]["name"] = "wheel";
    scene.unit_m = scene.light_speed_m_s;
    for (auto [turns, wrong] :
        {std::pair(0.0158, false), {-0.0158, false}, {0.016, true}, {-0.016, true}}) { // 0.2 / (2 pi 2)
        doc.json["nodes"][0]["extras"] = {{"starbow", {{"spin", {{"axis", {0, 0, 1}}, {"turns_per_s", turns}}}}}};
        const std::string line = gltf_test::speed_complaint(load(doc), scene);
        EXPECT_EQ(line.starts_with("w.glb: /nodes/0: (\"wheel\") moves at 0.201 of the scene's speed of light"), wrong)
            << line;
    }
    // A step or a repetition is no speed.
    doc = animated();
    doc.json["animations"][0]["channels"].erase(1); // removes the rotation
    doc.json["animations"][0]["samplers"][0]["interpolation"] = "STEP";
    doc.json["animations"][0]["samplers"][0]["output"] = doc.accessor<float>({0, 0, 0, 100, 0, 0, 0, 90, 0}, "VEC3");
    EXPECT_EQ(gltf_test::speed_complaint(load(doc), scene), "");
}

TEST_F(AnimationFile, AWorldWithoutAnimationAllocatesNothingForIt)
{
    World world = load(gltf_test::triangle_doc());
    sort_instances(world);
    EXPECT_EQ(world.motions.capacity() + world.joints.capacity() + world.tracks.capacity(), 0u);
    EXPECT_FALSE(timed(world, world.instances[0]));
    EXPECT_EQ(time_entries(world, {}, 1).capacity(), 0u);
    const std::vector<PlannedImage> images = {{0, 0, {-1, -1}, {1, 1}, {64, 64}, {0, 0}, 64, 1}};
    EXPECT_EQ(cull(world, {{EyeEvent{0, {0, 0, 1}}}}, images).instances.size(), 1u);
    world = load(animated());
    sort_instances(world);
    EXPECT_TRUE(timed(world, world.instances[0]));
    EXPECT_EQ(cull(world, {{EyeEvent{0, {0, 0, 1}}}}, images).instances.size(), 1u + POSES);
}

} // namespace animation_test
