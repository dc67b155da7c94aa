// Metal, roughness, normals, occlusion and emission as glTF states them, with the vertices' data for their maps.
#include "tests/support/gltf_fixture.h"
#include <cmath>

namespace starbow::gltf_test::world_gloss_test {
namespace {

using WorldGlossTest = GltfTest;

/// A square of two triangles in the plane of x and y with outer normals +z, from -1 to 1. By default set 0 of its texture
/// coordinates grows along +x, and its v falls along +y.
Doc square(const Json& material, const std::vector<float>& uv = {0, 1, 1, 1, 1, 0, 0, 0})
{
    Doc doc;
    doc.json["materials"] = {material};
    doc.json["images"] = {{{"uri", png_uri()}}};
    doc.json["textures"] = {{{"source", 0}}};
    const Json positions = doc.accessor<float>({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, "VEC3");
    const Json normals = doc.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    doc.show({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", doc.accessor(uv, "VEC2")}}},
        {"indices", doc.accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR")}, {"material", 0}});
    return doc;
}

const Json bumpy = {{"normalTexture", {{"index", 0}, {"scale", 0.5}}}};

TEST_F(WorldGlossTest, FactorsAreTheFilesOrTheStandards)
{
    World world = load(square({{"pbrMetallicRoughness", {{"metallicFactor", 0.25}, {"roughnessFactor", 0.5}}}}));
    ASSERT_TRUE(world.materials[0].gloss);
    EXPECT_EQ(world.materials[0].gloss->metallic, 0.25);
    EXPECT_EQ(world.materials[0].gloss->roughness, 0.5);
    EXPECT_EQ(world.materials[0].gloss->dielectric, 0.04);
    world = load(square(Json::object()));
    ASSERT_TRUE(world.materials[0].gloss);
    EXPECT_EQ(world.materials[0].gloss->metallic, 1);
    EXPECT_EQ(world.materials[0].gloss->roughness, 1);
    Doc doc = square(Json::object());
    doc.json["meshes"][0]["primitives"][0].erase("material");
    world = load(doc);
    ASSERT_TRUE(world.materials.back().gloss) << "the standard's material without one is a rough metal";

    // Without metal and wholly rough: matt, as cheap as ever, with no data beside the vertices'.
    const Json matt = {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}}};
    world = load(square(matt));
    EXPECT_FALSE(world.materials[0].gloss);
    EXPECT_TRUE(world.vertex_maps.empty());
    Json unlit = {{"extensions", {{"KHR_materials_unlit", Json::object()}}}};
    EXPECT_FALSE(load(square(unlit)).materials[0].mapped());
}

TEST_F(WorldGlossTest, IndexOfRefractionIsAReflectance)
{
    Json material = {{"extensions", {{"KHR_materials_ior", {{"ior", 2.42}}}}}};
    EXPECT_NEAR(load(square(material)).materials[0].gloss->dielectric, std::pow(1.42 / 3.42, 2), 1e-12);
    material["extensions"]["KHR_materials_ior"] = Json::object();
    EXPECT_NEAR(load(square(material)).materials[0].gloss->dielectric, 0.04, 1e-12);
}

TEST_F(WorldGlossTest, MapsAreNumbersWithCoordinatesOfTheirOwn)
{
    Json material = {{"normalTexture", {{"index", 0}, {"scale", 0.5}}},
        {"occlusionTexture", {{"index", 0}, {"strength", 0.75}, {"texCoord", 1}}},
        {"pbrMetallicRoughness",
            {{"baseColorTexture", {{"index", 0}}},
                {"metallicRoughnessTexture",
                    {{"index", 0},
                        {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0.25}}, {"scale", {2, 3}}}}}}}}}}};
    Doc doc = square(material);
    doc.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"]
        = doc.accessor<float>({5, 6, 7, 8, 9, 10, 11, 12}, "VEC2");
    const World world = load(doc);
    const Gloss& gloss = *world.materials[0].gloss;
    EXPECT_EQ(gloss.normal_scale, 0.5);
    EXPECT_EQ(gloss.occlusion_strength, 0.75);
    // The image is there twice: its bytes are colours for the base colour, numbers for the rest.
    ASSERT_EQ(world.textures.size(), 2u);
    EXPECT_EQ(world.textures[0].rgba, world.textures[1].rgba);
    EXPECT_NE(world.textures[std::size_t(gloss.normal.texture)].numbers,
        world.textures[std::size_t(world.materials[0].base_texture)].numbers);
    EXPECT_TRUE(world.textures[std::size_t(gloss.normal.texture)].numbers);
    EXPECT_EQ(gloss.normal.texture, gloss.occlusion.texture);
    EXPECT_EQ(world.vertices[2].uv, glm::vec2(1, 0));
    const auto uv = [&](const Map& map, std::size_t vertex) {
        const glm::vec4& uvs = world.vertex_maps[vertex].uvs;
        return map.rotate_scale * (map.second ? glm::vec2(uvs.z, uvs.w) : glm::vec2(uvs)) + map.offset;
    };
    EXPECT_EQ(uv(gloss.normal, 2), glm::vec2(1, 0));
    EXPECT_EQ(uv(gloss.occlusion, 2), glm::vec2(9, 10));
    EXPECT_EQ(uv(gloss.metallic_roughness, 2), glm::vec2(2 * 1 + 0.5, 3 * 0 + 0.25));
}

TEST_F(WorldGlossTest, AThirdSetOfCoordinatesIsSaid)
{
    Json material = {{"normalTexture", {{"index", 0}}}, {"occlusionTexture", {{"index", 0}, {"texCoord", 1}}},
        {"emissiveTexture", {{"index", 0}, {"texCoord", 2}}}, {"emissiveFactor", {1, 1, 1}}};
    Doc doc = square(material);
    const World world = load(doc);
    EXPECT_EQ(world.notes,
        (std::vector<std::string>{"maps with a third set of texture coordinates in a material: they take the first",
            "textured surfaces without texture coordinates: they take one texel's colour",
            "maps without texture coordinates: their surfaces take one texel"}));
}

void expect_tangent(const VertexMaps& at, const glm::vec3& along, float sense)
{
    EXPECT_LT(glm::distance(glm::vec3(at.tangent), along), 1e-6f)
        << at.tangent.x << ' ' << at.tangent.y << ' ' << at.tangent.z;
    EXPECT_EQ(at.tangent.w, sense);
}

TEST_F(WorldGlossTest, TangentsPointWhereTheMapsColumnsGo)
{
    // cross(+z, +x) = +y: where v falls.
    for (const VertexMaps& at : load(square(bumpy)).vertex_maps)
        expect_tangent(at, {1, 0, 0}, 1);
    // A quarter turn: u grows along +y, v falls along -x.
    for (const VertexMaps& at : load(square(bumpy, {0, 0, 0, 1, 1, 1, 1, 0})).vertex_maps)
        expect_tangent(at, {0, 1, 0}, 1);
    // Mirrored: u falls along +x, v falls along +y, which is -cross(+z, -x).
    for (const VertexMaps& at : load(square(bumpy, {1, 1, 0, 1, 0, 0, 1, 0})).vertex_maps)
        expect_tangent(at, {-1, 0, 0}, -1);
    // The transform of the map turns it too.
    Json turned = bumpy;
    turned["normalTexture"]["extensions"]["KHR_texture_transform"] = {{"scale", {-1, 1}}};
    for (const VertexMaps& at : load(square(turned)).vertex_maps)
        expect_tangent(at, {-1, 0, 0}, -1);
}

TEST_F(WorldGlossTest, AVertexBetweenBothSensesIsDoubled)
{
    // The left half of a pair of squares mirrors the right one's map: they share the vertices of their edge.
    Doc doc;
    doc.json["materials"] = {bumpy};
    doc.json["images"] = {{{"uri", png_uri()}}};
    doc.json["textures"] = {{{"source", 0}}};
    const Json positions = doc.accessor<float>({-1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 1, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
    const Json normals = doc.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const Json uv = doc.accessor<float>({1, 1, 0, 1, 1, 1, 1, 0, 0, 0, 1, 0}, "VEC2");
    doc.show({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uv}}},
        {"indices", doc.accessor<std::uint16_t>({0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4}, "SCALAR")}, {"material", 0}});
    const World world = load(doc);
    ASSERT_EQ(world.vertices.size(), 8u);
    ASSERT_EQ(world.vertex_maps.size(), 8u);
    for (std::size_t i = 0; i < world.indices.size(); ++i) {
        const std::uint32_t vertex = world.indices[i];
        const bool left = i < 6;
        expect_tangent(world.vertex_maps[vertex], {left ? -1 : 1, 0, 0}, left ? -1 : 1);
        EXPECT_TRUE(left ? world.vertices[vertex].position.x <= 0 : world.vertices[vertex].position.x >= 0);
    }
}

TEST_F(WorldGlossTest, TheFilesTangentsAreTaken)
{
    Doc doc = square(bumpy);
    doc.json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"]
        = doc.accessor<float>({0, 2, 0, -1, 0, 2, 0, -1, 0, 2, 0, -1, 0, 2, 0, -1}, "VEC4");
    for (const VertexMaps& at : load(doc).vertex_maps)
        expect_tangent(at, {0, 1, 0}, -1);
    doc.json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"]
        = doc.accessor<float>({0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0}, "VEC3");
    EXPECT_NE(complaint(doc).find("/attributes/TANGENT"), std::string::npos);
}

TEST_F(WorldGlossTest, WrongNumbersAreRefused)
{
    EXPECT_NE(complaint(square({{"occlusionTexture", {{"index", 0}, {"strength", 2}}}})).find("/occlusionTexture/strength"),
        std::string::npos);
    EXPECT_NE(complaint(square({{"normalTexture", {{"index", 7}}}})).find("/normalTexture/index"), std::string::npos);
    EXPECT_NE(
        complaint(square({{"pbrMetallicRoughness", {{"metallicFactor", -1}}}})).find("/metallicFactor"), std::string::npos);
}

} // namespace
} // namespace starbow::gltf_test::world_gloss_test
