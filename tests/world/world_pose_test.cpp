// Skins and morph targets that stand still, against the sums of their definition (glTF 2.0, sections 3.7.2.2 and 3.7.3).
#include "runtime/world/outline.h"
#include "tests/support/gltf_fixture.h"
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace starbow::gltf_test::world_pose_test {
namespace {

using WorldPoseTest = GltfTest;

std::vector<glm::dvec3> places(const World& world, std::size_t instance = 0)
{
    std::vector<glm::dvec3> out;
    const Instance& one = world.instances[instance];
    const Primitive& primitive = world.primitives[one.primitive];
    for (std::uint32_t i = 0; i < primitive.index_count; ++i) {
        const Vertex& vertex
            = world.vertices[world.indices[primitive.first_index + i] + std::uint32_t(primitive.vertex_offset)];
        out.push_back(glm::dvec3(one.frame_from_local * glm::dvec4(glm::dvec3(vertex.position), 1)));
    }
    return out;
}

/// A triangle whose corners hang on two joints: on the first, on both alike, and on the second by bytes of 0 and 255.
Doc skinned()
{
    Doc doc = triangle_doc();
    Json& primitive = doc.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["JOINTS_0"] = doc.accessor<std::uint8_t>({0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, "VEC4");
    primitive["attributes"]["WEIGHTS_0"]
        = doc.accessor<std::uint8_t>({255, 0, 0, 0, 100, 100, 0, 0, 255, 0, 0, 0}, "VEC4", true);
    // The first joint lies at (0, 5, 0) below a node that turns by 90 degrees about z; the second one at (1, 0, 0).
    const double r = std::sqrt(0.5);
    const int first = doc.put("nodes", {{"translation", {0, 5, 0}}});
    const int arm = doc.put("nodes", {{"children", {first}}, {"rotation", {0, 0, r, r}}});
    const int second = doc.put("nodes", {{"translation", {1, 0, 0}}, {"scale", {1, 3, 1}}});
    doc.json["scenes"][0]["nodes"].push_back(arm);
    doc.json["scenes"][0]["nodes"].push_back(second);
    const int inverse = doc.accessor<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1, //
                                                1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
        "MAT4");
    doc.json["accessors"][std::size_t(inverse)]["type"] = "MAT4", doc.json["accessors"][std::size_t(inverse)]["count"] = 2;
    doc.json["skins"] = {{{"joints", {first, second}}, {"inverseBindMatrices", inverse}}};
    doc.json["nodes"][0]["skin"] = 0;
    doc.json["nodes"][0]["translation"] = {100, 100, 100}; // of no account for a skin
    return doc;
}

TEST_F(WorldPoseTest, ASkinHangsOnItsJoints)
{
    const World world = load(skinned());
    // By hand: the first joint takes (x, y, z) to (x, y - 1, z), lifts it by 5 and turns (x, y) to (-y, x); the second one
    // to (x + 1, 3 y, z).
    const auto first = [](const glm::dvec3& at) { return glm::dvec3(-(at.y - 1 + 5), at.x, at.z); };
    const auto second = [](const glm::dvec3& at) { return glm::dvec3(at.x + 1, 3 * at.y, at.z); };
    const glm::dvec3 a(0, 0, 0), b(2, 0, 0), c(0, 1, 0);
    const auto at = places(world);
    ASSERT_EQ(at.size(), 3u);
    EXPECT_LT(glm::distance(at[0], first(a)), 1e-6);
    EXPECT_LT(glm::distance(at[1], 0.5 * (first(b) + second(b))), 1e-6);
    EXPECT_LT(glm::distance(at[2], second(c)), 1e-6);
    EXPECT_TRUE(world.notes.empty());
    // Its bounds are those of the pose.
    const Primitive& primitive = world.primitives[world.instances[0].primitive];
    for (const glm::dvec3& place : at)
        EXPECT_LE(glm::distance(primitive.centre, place), primitive.radius + 1e-6);
}

TEST_F(WorldPoseTest, ASkinOfAnotherNodeIsAnotherPose)
{
    Doc doc = skinned();
    doc.json["nodes"].push_back({{"mesh", doc.json["nodes"][0]["mesh"]}, {"translation", {7, 0, 0}}});
    doc.json["scenes"][0]["nodes"].push_back(doc.json["nodes"].size() - 1);
    const World world = load(doc);
    ASSERT_EQ(world.instances.size(), 2u);
    const auto plain = places(world, 1);
    EXPECT_LT(glm::distance(plain[1], glm::dvec3(9, 0, 0)), 1e-6);
}

TEST_F(WorldPoseTest, FaultsOfSkinsAreNamed)
{
    const auto said = [&](const std::string& at, const Json& value) {
        Doc doc = skinned();
        doc.json[Json::json_pointer(at)] = value;
        return complaint(doc);
    };
    EXPECT_TRUE(said("/skins/0/joints", Json{2})
                    .starts_with("/meshes/0/primitives/0/attributes/JOINTS_0: element 1 names joint 1; the skin has 1"))
        << said("/skins/0/joints", Json{2});
    EXPECT_TRUE(said("/skins/0/joints/1", 99).starts_with("/skins/0/joints/1"));
    EXPECT_TRUE(
        said("/skins/0/inverseBindMatrices", 0).starts_with("/skins/0/inverseBindMatrices: names accessor 0 of type VEC3"));
    EXPECT_TRUE(
        said("/skins/0/joints", Json{1, 2, 3}).starts_with("/skins/0/inverseBindMatrices: has 2 matrices; the skin has 3"));
}

// One vertex without weights, in a file in centimetres, as exporters leave it: it stays with its mesh.
TEST_F(WorldPoseTest, AVertexWithoutWeightsHangsOnTheJointThatItNamesFirst)
{
    Doc doc = skinned();
    Json& attributes = doc.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["WEIGHTS_0"] = doc.accessor<float>({1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    attributes["JOINTS_0"] = doc.accessor<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
    const auto at = places(load(doc));
    EXPECT_LT(glm::distance(at[1], glm::dvec3(2 + 1, 0, 0)), 1e-6) << "the second joint takes (x, y, z) to (x + 1, 3 y, z)";
    EXPECT_LT(glm::distance(at[2], glm::dvec3(-(1 - 1 + 5), 0, 0)), 1e-6) << "the first one to (-(y - 1 + 5), x, z)";
    attributes["JOINTS_0"] = doc.accessor<std::uint8_t>({0, 0, 0, 0, 77, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
    EXPECT_LT(glm::distance(places(load(doc))[1], glm::dvec3(-(0 - 1 + 5), 2, 0)), 1e-6) << "of joints that the skin has";
}

TEST_F(WorldPoseTest, MoreThanFourJointsMoveAVertex)
{
    Doc doc = skinned();
    Json& attributes = doc.json["meshes"][0]["primitives"][0]["attributes"];
    // Of the first vertex a quarter hangs on the first joint, the rest, in two sets, on the second one.
    attributes["JOINTS_0"] = doc.accessor<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, "VEC4");
    attributes["WEIGHTS_0"] = doc.accessor<float>({0.25, 0.25, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    attributes["JOINTS_1"] = doc.accessor<std::uint8_t>({1, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
    attributes["WEIGHTS_1"] = doc.accessor<float>({0.25, 0.25, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
    const auto at = places(load(doc));
    const glm::dvec3 first(-4, 0, 0), second(1, 0, 0); // where the joints take (0, 0, 0)
    EXPECT_LT(glm::distance(at[0], 0.25 * first + 0.75 * second), 1e-6);
    EXPECT_LT(glm::distance(at[2], glm::dvec3(1, 3, 0)), 1e-6) << "its weights are in the second set alone";
    attributes["JOINTS_1"] = doc.accessor<std::uint8_t>({1, 2, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
    EXPECT_TRUE(complaint(doc).starts_with("/meshes/0/primitives/0/attributes/JOINTS_1: element 0 names joint 2"))
        << complaint(doc);
}

TEST_F(WorldPoseTest, HiddenNodesAndAllBelowThemAreNotDrawn)
{
    Doc doc = triangle_doc();
    const int mesh = doc.json["nodes"][0]["mesh"];
    const auto hide = [](bool visible) { return Json{{"KHR_node_visibility", {{"visible", visible}}}}; };
    const int child = doc.put("nodes", {{"mesh", mesh}, {"translation", {2, 0, 0}}, {"extensions", hide(true)}});
    const int parent = doc.put("nodes", {{"mesh", mesh}, {"children", {child}}, {"extensions", hide(false)}});
    const int shown = doc.put("nodes", {{"mesh", mesh}, {"translation", {3, 0, 0}}, {"extensions", hide(true)}});
    doc.json["scenes"][0]["nodes"].push_back(parent);
    doc.json["scenes"][0]["nodes"].push_back(shown);
    doc.json["extensionsUsed"] = {"KHR_node_visibility"};
    doc.json["extensionsRequired"] = {"KHR_node_visibility"};
    const World world = load(doc);
    EXPECT_EQ(world.notes, std::vector<std::string>{});
    ASSERT_EQ(world.instances.size(), 2u);
    EXPECT_EQ(world.instances[0].node, 0);
    EXPECT_EQ(world.instances[1].node, shown);
    Json& positions = doc.json["accessors"][0];
    positions["min"] = {0, 0, 0}, positions["max"] = {2, 1, 0};
    EXPECT_EQ(read_outline(write("world.gltf", doc.text())).things.size(), 2u);
    doc.json["nodes"][std::size_t(shown)]["extensions"] = {{"KHR_node_visibility", {{"visible", "no"}}}};
    EXPECT_TRUE(complaint(doc).starts_with("/nodes/3/extensions/KHR_node_visibility/visible")) << complaint(doc);
    // A skin on joints that are hidden is drawn, where they take it.
    Doc hidden = skinned();
    hidden.json["nodes"][1]["extensions"] = hide(false), hidden.json["nodes"][2]["extensions"] = hide(false);
    EXPECT_LT(glm::distance(places(load(hidden))[0], glm::dvec3(-4, 0, 0)), 1e-6);
}

TEST_F(WorldPoseTest, MorphTargetsAreAddedByTheirWeights)
{
    Doc doc = triangle_doc();
    const int lift = doc.accessor<float>({0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3"),
              push = doc.accessor<float>({0, 0, 4, 0, 0, 0, 0, 0, 0}, "VEC3");
    doc.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", lift}}, {{"POSITION", push}}};
    EXPECT_LT(glm::distance(places(load(doc))[0], glm::dvec3(0, 0, 0)), 1e-9); // weights of 0
    doc.json["meshes"][0]["weights"] = {2, 0.5};
    const auto mesh = places(load(doc));
    EXPECT_LT(glm::distance(mesh[0], glm::dvec3(0, 2, 2)), 1e-6);
    EXPECT_LT(glm::distance(mesh[1], glm::dvec3(2, 2, 0)), 1e-6);
    doc.json["nodes"][0]["weights"] = {-1, 0};
    EXPECT_LT(glm::distance(places(load(doc))[2], glm::dvec3(0, 0, 0)), 1e-6); // the node's own come first
    doc.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] = doc.accessor<float>({0, 1, 0}, "VEC3");
    EXPECT_NE(complaint(doc).find("has 1 elements; the attributes have 3"), std::string::npos) << complaint(doc);
}

} // namespace
} // namespace starbow::gltf_test::world_pose_test
