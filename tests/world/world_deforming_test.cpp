// Skins and morph targets that move, against the sums of their definition (glTF 2.0, sections 3.7.2.2 and 3.7.3).
#include "config/model/scene_file.h"
#include "runtime/plan/cull.h"
#include "runtime/world/fastest_motion.h"
#include "runtime/world/instances.h"
#include "runtime/world/moving.h"
#include "runtime/world/shape.h"
#include "runtime/world/worldline.h"
#include "tests/support/gltf_fixture.h"
#include <set>

namespace starbow::gltf_test::world_deforming_test {
namespace {

using WorldDeforming = GltfTest;
using glm::dvec3;

/// The triangle's corners hang on a joint that turns by 90 degrees about z in 10 s and back, on both joints alike, and on a
/// joint that stands still at (1, 0, 0). A third joint has no vertices.
Doc skinned()
{
    Doc doc = triangle_doc();
    Json& primitive = doc.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["JOINTS_0"] = doc.accessor<std::uint8_t>({2, 0, 0, 0, 2, 1, 0, 0, 1, 0, 0, 0}, "VEC4");
    primitive["attributes"]["WEIGHTS_0"]
        = doc.accessor<std::uint8_t>({255, 0, 0, 0, 100, 100, 0, 0, 255, 0, 0, 0}, "VEC4", true);
    const int turning = doc.put("nodes", {{"name", "turning"}, {"translation", {0, 5, 0}}});
    const int still = doc.put("nodes", {{"translation", {1, 0, 0}}});
    const int arm = doc.put("nodes", {{"children", {turning}}, {"translation", {0, 0, -3}}, {"scale", {2, 2, 2}}});
    const int unused = doc.put("nodes", {{"translation", {1000, 0, 0}}});
    for (int node : {arm, still, unused})
        doc.json["scenes"][0]["nodes"].push_back(node);
    std::vector<float> matrices;
    for (const float lower : {0.0f, 0.0f, 1.0f}) // the inverse bind matrices; the turning joint's lowers by 1
        for (int i = 0; i < 16; ++i)
            matrices.push_back(i == 13 ? -lower : i % 5 == 0 ? 1.0f : 0.0f);
    const int inverse = doc.accessor(matrices, "MAT4");
    doc.json["accessors"][std::size_t(inverse)]["type"] = "MAT4", doc.json["accessors"][std::size_t(inverse)]["count"] = 3;
    doc.json["skins"] = {{{"joints", {unused, still, turning}}, {"inverseBindMatrices", inverse}}};
    doc.json["nodes"][0]["skin"] = 0;
    doc.json["nodes"][0]["translation"] = {100, 100, 100}; // of no account for a skin
    const float r = float(std::sqrt(0.5));
    doc.json["animations"] = {{{"samplers",
                                   {{{"input", doc.accessor<float>({0, 10, 20}, "SCALAR")},
                                       {"output", doc.accessor<float>({0, 0, 0, 1, 0, 0, r, r, 0, 0, 0, 1}, "VEC4")}}}},
        {"channels", {{{"sampler", 0}, {"target", {{"node", turning}, {"path", "rotation"}}}}}}}};
    return doc;
}

/// The corners by hand.
std::array<dvec3, 3> corners_of_skinned(double time)
{
    const double round = time - 20 * std::floor(time / 20), angle = (round < 10 ? round : 20 - round) / 10 * std::acos(0.0);
    const auto turning = [&](const dvec3& at) {
        const double y = at.y - 1;
        return 2.0 * dvec3(std::cos(angle) * at.x - std::sin(angle) * y, std::sin(angle) * at.x + std::cos(angle) * y + 5, 0)
            + dvec3(0, 0, -3);
    };
    const auto still = [](const dvec3& at) { return at + dvec3(1, 0, 0); };
    const dvec3 a(0, 0, 0), b(2, 0, 0), c(0, 1, 0);
    return {turning(a), 0.5 * (turning(b) + still(b)), still(c)};
}

TEST_F(WorldDeforming, ASkinHangsOnItsMovingJoints)
{
    const World world = load(skinned());
    EXPECT_EQ(world.notes, std::vector<std::string>{});
    ASSERT_EQ(world.instances.size(), 1u);
    ASSERT_EQ(world.deformations.size(), 1u);
    EXPECT_EQ(world.deformations[0].bones.size(), 2u) << "a joint without vertices is not a bone";
    const Instance& instance = world.instances[0];
    const Primitive& primitive = world.primitives[instance.primitive];
    for (double time : {0.0, 2.5, 10.0, 17.0, 33.0, -4.0}) {
        Shape shape(world, instance, time);
        const auto right = corners_of_skinned(time);
        for (std::uint32_t i = 0; i < 3; ++i)
            EXPECT_LT(glm::distance(shape.vertex(std::uint32_t(primitive.vertex_offset) + i).place, right[i]), 1e-5)
                << time << ", corner " << i;
    }
    // At rest, the world's own vertices are the file's pose.
    for (std::uint32_t i = 0; i < 3; ++i)
        EXPECT_LT(glm::distance(
                      dvec3(world.vertices[std::size_t(primitive.vertex_offset) + i].position), corners_of_skinned(0)[i]),
            1e-5);
}

// The first corner names the turning joint without a weight; of the second, a fifth set of weights turns with it.
TEST_F(WorldDeforming, VerticesWithoutWeightsAndWithMoreThanFourMoveWithTheirJoints)
{
    Doc doc = skinned();
    Json& attributes = doc.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = doc.accessor<std::uint8_t>({2, 0, 0, 0, 1, 1, 1, 1, 1, 0, 0, 0}, "VEC4");
    attributes["WEIGHTS_0"] = doc.accessor<float>({0, 0, 0, 0, 0.125, 0.125, 0.125, 0.125, 1, 0, 0, 0}, "VEC4");
    attributes["JOINTS_1"] = doc.accessor<std::uint8_t>({0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    attributes["WEIGHTS_1"] = doc.accessor<float>({0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    const World world = load(doc);
    const Instance& instance = world.instances.at(0);
    for (double time : {0.0, 2.5, 10.0, 17.0}) {
        Shape shape(world, instance, time);
        for (std::uint32_t i = 0; i < 3; ++i) // each is where the first test has it
            EXPECT_LT(glm::distance(shape.vertex(std::uint32_t(world.primitives[0].vertex_offset) + i).place,
                          corners_of_skinned(time)[i]),
                1e-5)
                << time << ", corner " << i;
    }
}

/// The triangle whose corners move up by a target, and apart by another, with weights that change.
Doc morphed(const char* interpolation = "LINEAR")
{
    Doc doc = triangle_doc();
    const int lift = doc.accessor<float>({0, 1, 0, 0, 1, 0, 0, 3, 0}, "VEC3"),
              push = doc.accessor<float>({0, 0, 4, 0, 0, 0, 0, 0, 0}, "VEC3");
    doc.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", lift}}, {{"POSITION", push}}};
    doc.json["meshes"][0]["weights"] = {5, 5}; // the animation replaces them
    doc.json["animations"]
        = {{{"samplers",
                {{{"input", doc.accessor<float>({0, 10, 20}, "SCALAR")},
                    {"output", doc.accessor<float>({0, 0.5, 1, 0.5, 0, 0.5}, "SCALAR")}, {"interpolation", interpolation}}}},
            {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
    doc.json["nodes"][0]["translation"] = {7, 0, 0};
    return doc;
}

TEST_F(WorldDeforming, WeightsOfMorphTargetsChange)
{
    World world = load(morphed());
    EXPECT_EQ(world.notes, std::vector<std::string>{});
    const auto at = [&](double time, std::uint32_t corner) {
        Shape shape(world, world.instances[0], time);
        return shape.vertex(std::uint32_t(world.primitives[world.instances[0].primitive].vertex_offset) + corner).place;
    };
    EXPECT_LT(glm::distance(at(0, 0), dvec3(7, 0, 2)), 1e-6);
    EXPECT_LT(glm::distance(at(5, 0), dvec3(7, 0.5, 2)), 1e-6);
    EXPECT_LT(glm::distance(at(5, 2), dvec3(7, 2.5, 0)), 1e-6);
    EXPECT_LT(glm::distance(at(14, 2), dvec3(7, 1 + 0.6 * 3, 0)), 1e-6);
    EXPECT_LT(glm::distance(at(34, 2), at(14, 2)), 1e-9);
    const auto normal_at = [&](double time, std::uint32_t corner) {
        Shape shape(world, world.instances[0], time);
        return shape.vertex(std::uint32_t(world.primitives[world.instances[0].primitive].vertex_offset) + corner).normal;
    };
    const dvec3 normal = normal_at(5, 0);
    world = load(morphed("STEP"));
    EXPECT_LT(glm::distance(at(9, 2), dvec3(7, 1, 0)), 1e-6);
    EXPECT_LT(glm::distance(at(11, 2), dvec3(7, 4, 0)), 1e-6);
    // Below a node that turns, on a mirrored one, with several targets more than fit one track.
    Doc doc = morphed();
    Json& targets = doc.json["meshes"][0]["primitives"][0]["targets"];
    const Json first = targets[0];
    for (int i = 0; i < 3; ++i)
        targets.push_back(first);
    doc.json["animations"][0]["samplers"][0]["output"]
        = doc.accessor<float>({0, 0, 0, 0, 1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1}, "SCALAR");
    doc.json["nodes"][0]["scale"] = {-1, 1, 1};
    world = load(doc);
    ASSERT_EQ(world.deformations[0].targets, 5);
    EXPECT_EQ(world.deformations[0].weights.size(), 2u);
    EXPECT_LT(glm::distance(at(5, 2), dvec3(7, 1 + 1.5 * 3, 0)), 1e-6);
    EXPECT_LT(glm::distance(at(5, 1), dvec3(5, 1.5, 0)), 1e-6);
    EXPECT_GT(std::hypot(normal.y, normal.z), 0.1);
    EXPECT_LT(glm::distance(normal_at(5, 0), dvec3(-normal.x, normal.y, normal.z)), 1e-6) << "seen in a mirror";
}

TEST_F(WorldDeforming, NoVertexIsOutsideTheWindow)
{
    for (const bool skin : {true, false}) {
        World world = load(skin ? skinned() : morphed());
        const Instance& instance = world.instances[0];
        const Primitive& primitive = world.primitives[instance.primitive];
        const EyeEvent eye{0, {3, -2, 15}, 21};
        const SeenPose seen = seen_pose(world, instance, eye);
        const dvec3 middle(seen.frame_from_local * glm::dvec4(middle_of(world, instance), 1));
        EXPECT_NEAR(seen.sent, eye.time - glm::distance(middle, eye.place), 1e-9);
        const std::vector<double> sent_near{seen.sent - seen.window, seen.sent + seen.window};
        for (std::uint32_t i = 0; i < 3; ++i) {
            double time = eye.time;
            dvec3 place(0);
            for (int round = 0; round < 100; ++round) {
                Shape shape(world, instance, time);
                place = shape.vertex(std::uint32_t(primitive.vertex_offset) + i).place;
                time = eye.time - glm::distance(place, eye.place);
            }
            EXPECT_GT(time, sent_near[0]) << skin << ' ' << i;
            EXPECT_LT(time, sent_near[1]) << skin << ' ' << i;
            EXPECT_LT(glm::distance(place, middle), seen.window) << skin << ' ' << i;
        }
        // The table of poses reaches no further than it must, and holds both bones or the weights.
        sort_instances(world);
        const std::vector<PlannedImage> images = {{0, 0, {-1, -1}, {1, 1}, {64, 64}, {0, 0}, 64, 1}};
        EXPECT_EQ(cull(world, {{eye}}, images).instances.size(), 1u + POSES * 2) << skin;
    }
}

TEST_F(WorldDeforming, PrimitivesOfOneMeshShareTheirPoses)
{
    Doc doc = skinned();
    doc.json["meshes"][0]["primitives"].push_back(doc.json["meshes"][0]["primitives"][0]);
    doc.json["meshes"][0]["primitives"][1]["material"]
        = doc.put("materials", {{"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
    World world = load(doc);
    SceneFile scene;
    scene.bodies.push_back({});
    sort_instances(world);
    ASSERT_EQ(world.instances.size(), 2u);
    EXPECT_EQ(world.instances[0].motion, world.instances[1].motion);
    const std::vector<PlannedImage> images = {{0, 0, {-1, -1}, {1, 1}, {64, 64}, {0, 0}, 64, 1}};
    EXPECT_EQ(cull(world, {{EyeEvent{0, {0, 0, 30}, 0}}}, images).instances.size(), 2u + POSES * 2);
}

TEST_F(WorldDeforming, AVertexWithoutWeightsMovesWithTheJointThatItNamesFirst)
{
    Doc doc = skinned();
    doc.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"]
        = doc.accessor<float>({1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    const World world = load(doc);
    Shape shape(world, world.instances[0], 10);
    const auto first = std::uint32_t(world.primitives[world.instances[0].primitive].vertex_offset);
    // After 10 s the turning joint takes (x, y, z) to 2 (-(y - 1), x + 5, 0) - (0, 0, 3).
    EXPECT_LT(glm::distance(shape.vertex(first + 1).place, dvec3(2 * 1, 2 * (2 + 5), -3)), 1e-5);
    EXPECT_LT(glm::distance(shape.vertex(first).place, corners_of_skinned(10)[0]), 1e-5);
}

TEST_F(WorldDeforming, WhatIsTooFastIsRefused)
{
    SceneFile scene;
    scene.gltf = "w.glb";
    // The first corner is 1 below the joint, doubled by the arm, and turns by pi / 2 in 10 s; the second one is at a
    // distance of the root of 5, doubled, and hangs on it by half.
    const double skin = std::max(2.0, std::sqrt(5.0)) * std::acos(0.0) / 10;
    // The third corner is lifted by 3 in 10 s.
    for (const auto& [doc, speed] : {std::pair(skinned(), skin), std::pair(morphed(), 0.3)}) {
        scene.unit_m = scene.light_speed_m_s * 0.2 / speed * 1.01;
        EXPECT_NE(speed_complaint(load(doc), scene).find("moves at 0.202 of the scene's speed of light"), std::string::npos)
            << speed_complaint(load(doc), scene);
        scene.unit_m = scene.light_speed_m_s * 0.2 / speed * 0.99;
        EXPECT_EQ(speed_complaint(load(doc), scene), "");
    }
    EXPECT_EQ(speed_complaint(load(morphed("STEP")), scene), "");
}

TEST_F(WorldDeforming, FaultsOfWeightsAreNamed)
{
    const auto said = [&](const std::string& at, const Json& value) {
        Doc doc = morphed();
        doc.json[Json::json_pointer(at)] = value;
        return complaint(doc);
    };
    EXPECT_EQ(said("/animations/0/samplers/0/output", 0),
        "/animations/0/samplers/0/output: names accessor 0 of type VEC3 and component type 5126; weights should be SCALAR "
        "of 5126 or of normalized integers");
    Doc doc = morphed();
    doc.json["animations"][0]["samplers"][0]["output"] = doc.accessor<float>({0, 1, 0}, "SCALAR");
    EXPECT_EQ(complaint(doc), "/animations/0/samplers/0/output: has 3 values for 3 times and 2 targets; 6 is right");
    doc = morphed();
    doc.json["animations"][0]["samplers"][0]["output"] = doc.accessor<float>({0, 0, 0, 2e6f, 0, 0}, "SCALAR");
    EXPECT_NE(complaint(doc).find("element 3 is not finite or above 1e6; should be smaller"), std::string::npos)
        << complaint(doc);
    // Weights of a mesh without targets change nothing.
    doc = morphed();
    doc.json["meshes"][0]["primitives"][0].erase("targets");
    const World still = load(doc);
    EXPECT_TRUE(still.deformations.empty());
    EXPECT_EQ(still.notes, std::vector<std::string>{"animated weights of nodes without morph targets change nothing"});
}

TEST_F(WorldDeforming, AWorldWithoutAnyHasNoneOfItsData)
{
    const World world = load(triangle_doc());
    EXPECT_EQ(world.deformations.capacity() + world.deforming.capacity(), 0u);
}

} // namespace
} // namespace starbow::gltf_test::world_deforming_test
