#include "gltf_fixture.h"
#include <numbers>

namespace starbow::gltf_test {
namespace {

using WorldMaterialTest = GltfTest;

/// A triangle with texture coordinates 00, 10, 01 in set 0 and 55, 65, 56 in set 1, and one material.
Doc painted(const Json& material)
{
    Doc doc = triangle_doc();
    Json& primitive = doc.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = doc.accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2");
    primitive["attributes"]["TEXCOORD_1"] = doc.accessor<std::uint8_t>({5, 5, 6, 5, 5, 6}, "VEC2");
    primitive["material"] = 0;
    doc.json["materials"] = {material};
    doc.json["images"] = {{{"uri", png_uri()}}};
    doc.json["textures"] = {{{"source", 0}}};
    return doc;
}

const Json textured = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}};

TEST_F(WorldMaterialTest, BaseColourAndTexture)
{
    Doc doc = painted(textured);
    doc.json["materials"][0]["name"] = "paint";
    doc.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.1, 0.2, 0.3, 0.4};
    World world = load(doc);
    ASSERT_EQ(world.materials.size(), 1u);
    const Material& material = world.materials[0];
    EXPECT_EQ(material.name, "paint");
    EXPECT_EQ(material.base_colour, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(material.base_texture, 0);
    EXPECT_EQ(material.emissive_texture, -1);
    EXPECT_EQ(material.alpha_cutoff, 0);
    EXPECT_FALSE(material.double_sided);
    EXPECT_FALSE(material.unlit);
    ASSERT_EQ(world.textures.size(), 1u);
    EXPECT_EQ(world.textures[0].size, glm::ivec2(2, 1));
    EXPECT_EQ(world.textures[0].rgba, (Bytes{255, 0, 0, 255, 0, 0, 255, 128}));
    EXPECT_EQ(world.textures[0].sampler, Sampler{});
    EXPECT_EQ(world.vertices[1].uv, glm::vec2(1, 0));
}

TEST_F(WorldMaterialTest, ImagesInBufferViewsAndFilesAndJpeg)
{
    Doc doc = painted(textured);
    doc.json["images"][0] = {{"bufferView", doc.view(small_png())}, {"mimeType", "image/png"}};
    EXPECT_EQ(load(doc).textures.at(0).rgba.size(), 8u);
    write("grey.jpg", grey_jpeg());
    doc.json["images"][0] = {{"uri", "grey.jpg"}};
    World world = load(doc);
    EXPECT_EQ(world.textures.at(0).size, glm::ivec2(16, 8));
    EXPECT_NEAR(world.textures.at(0).rgba.at(64), 100, 2);
}

TEST_F(WorldMaterialTest, TextureCoordinatesOfAnySetAndType)
{
    Doc doc = painted(textured);
    Json& info = doc.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    info["texCoord"] = 1;
    EXPECT_EQ(load(doc).vertices[1].uv, glm::vec2(6, 5));
    auto uv = [&](auto values, bool normalized) {
        Json& attributes = doc.json["meshes"][0]["primitives"][0]["attributes"];
        attributes["TEXCOORD_1"] = doc.accessor(values, "VEC2", normalized);
        return load(doc).vertices.at(1).uv;
    };
    EXPECT_EQ(uv(std::vector<std::uint8_t>{0, 0, 255, 51, 0, 0}, true), glm::vec2(1, 0.2f));
    EXPECT_EQ(uv(std::vector<std::uint16_t>{0, 0, 65535, 13107, 0, 0}, true), glm::vec2(1, 0.2f));
    EXPECT_EQ(uv(std::vector<std::int8_t>{0, 0, -127, 127, 0, 0}, true), glm::vec2(-1, 1));
    EXPECT_EQ(uv(std::vector<std::int16_t>{0, 0, -300, 300, 0, 0}, false), glm::vec2(-300, 300));
    EXPECT_EQ(uv(std::vector<std::uint16_t>{0, 0, 300, 2, 0, 0}, false), glm::vec2(300, 2));
}

TEST_F(WorldMaterialTest, TextureTransformsAreBaked)
{
    // The extension's own example: the lower left quarter of the image, turned clockwise by 90 degrees.
    Doc doc = painted(textured);
    Json& info = doc.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    info["extensions"]["KHR_texture_transform"]
        = {{"offset", {0, 1}}, {"rotation", std::numbers::pi / 2}, {"scale", {0.5, 0.5}}};
    doc.json["extensionsUsed"] = {"KHR_texture_transform"};
    World world = load(doc);
    EXPECT_NEAR(glm::distance(world.vertices[0].uv, glm::vec2(0, 1)), 0, 1e-7);
    EXPECT_NEAR(glm::distance(world.vertices[1].uv, glm::vec2(0, 0.5)), 0, 1e-7);
    EXPECT_NEAR(glm::distance(world.vertices[2].uv, glm::vec2(0.5, 1)), 0, 1e-7);
    EXPECT_TRUE(world.notes.empty());
    info["extensions"]["KHR_texture_transform"] = {{"scale", {2, -3}}, {"texCoord", 1}};
    EXPECT_EQ(load(doc).vertices[1].uv, glm::vec2(12, -15));
}

TEST_F(WorldMaterialTest, EmissiveFactorTextureAndStrength)
{
    Doc doc = painted({{"emissiveFactor", {1, 0.5, 0.25}}, {"emissiveTexture", {{"index", 0}, {"texCoord", 1}}},
        {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 60}}}}}});
    World world = load(doc);
    EXPECT_EQ(world.materials[0].emissive, glm::vec3(60, 30, 15));
    EXPECT_EQ(world.materials[0].emissive_texture, 0);
    EXPECT_EQ(world.vertices[1].uv, glm::vec2(6, 5)) << "the only texture says which coordinates are meant";
    doc.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    world = load(doc);
    EXPECT_EQ(world.vertices[1].uv, glm::vec2(1, 0));
    EXPECT_EQ(world.textures.size(), 1u);
    ASSERT_EQ(world.notes.size(), 1u);
}

TEST_F(WorldMaterialTest, UnlitHasNoGlowBeside)
{
    World world = load(painted({{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}},
        {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}}},
        {"extensions", {{"KHR_materials_unlit", Json::object()}}}}));
    EXPECT_TRUE(world.materials[0].unlit);
    EXPECT_EQ(world.materials[0].emissive, glm::vec3(0));
    EXPECT_EQ(world.materials[0].emissive_texture, -1);
}

TEST_F(WorldMaterialTest, AlphaModesAndSides)
{
    Doc doc = painted({{"alphaMode", "MASK"}, {"doubleSided", true}});
    EXPECT_EQ(load(doc).materials[0].alpha_cutoff, 0.5f);
    EXPECT_TRUE(load(doc).materials[0].double_sided);
    doc.json["materials"][0]["alphaCutoff"] = 0.25;
    EXPECT_EQ(load(doc).materials[0].alpha_cutoff, 0.25f);
    doc.json["materials"] = {{{"alphaMode", "BLEND"}}, {{"alphaMode", "BLEND"}}};
    EXPECT_EQ(load(doc).materials[0].alpha_cutoff, 0);
    EXPECT_EQ(load(doc).notes, (std::vector<std::string>{"blended transparency: such surfaces are drawn opaque"}));
}

TEST_F(WorldMaterialTest, SamplersAndSharedTextures)
{
    Doc doc = painted(textured);
    doc.json["samplers"] = {{{"magFilter", 9728}, {"minFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33648}},
        {{"minFilter", 9984}}, {{"minFilter", 9729}}, {{"minFilter", 9985}}, {{"minFilter", 9986}},
        {{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 10497}}};
    doc.json["textures"] = Json::array();
    doc.json["materials"] = Json::array();
    for (int i = 0; i < 6; ++i) {
        doc.put("textures", {{"source", 0}, {"sampler", i}});
        Json material = textured;
        material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = i;
        doc.put("materials", material);
    }
    // The default sampler means the same as the last one; the two share a texture.
    doc.put("textures", {{"source", 0}});
    doc.put("materials", {{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 6}}}});
    World world = load(doc);
    ASSERT_EQ(world.textures.size(), 6u);
    EXPECT_EQ(world.textures[0].sampler, (Sampler{Wrap::clamp, Wrap::mirror, false, false, false, false}));
    EXPECT_EQ(world.textures[1].sampler, (Sampler{.minify_linear = false, .mip_linear = false}));
    EXPECT_EQ(world.textures[2].sampler, (Sampler{.mipmaps = false, .mip_linear = false}));
    EXPECT_EQ(world.textures[3].sampler, (Sampler{.mip_linear = false}));
    EXPECT_EQ(world.textures[4].sampler, (Sampler{.minify_linear = false}));
    EXPECT_EQ(world.textures[5].sampler, Sampler{});
    EXPECT_EQ(world.materials[6].emissive_texture, 5);
}

TEST_F(WorldMaterialTest, WhatASurfaceCannotShowIsNoted)
{
    Doc doc = painted({{"normalTexture", {{"index", 0}}}, {"occlusionTexture", {{"index", 0}}},
        {"pbrMetallicRoughness",
            {{"metallicFactor", 1}, {"metallicRoughnessTexture", {{"index", 0}}}, {"baseColorTexture", {{"index", 1}}}}}});
    doc.put("textures", {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}});
    doc.json["images"][0]["uri"] = "missing.png"; // nothing reads it
    World world = load(doc);
    EXPECT_EQ(world.materials[0].base_texture, -1);
    EXPECT_EQ(world.notes,
        (std::vector<std::string>{"metallic-roughness textures: surfaces are matt", "metallic surfaces are drawn matt",
            "normal maps are not used", "occlusion maps are not used",
            "textures without a PNG or JPEG image: their surfaces are plain"}));
}

TEST_F(WorldMaterialTest, PrimitivesWithoutMaterialGetTheDefault)
{
    Doc doc = painted({{"name", "paint"}});
    doc.show({{"attributes", {{"POSITION", 0}}}});
    World world = load(doc);
    ASSERT_EQ(world.materials.size(), 2u);
    EXPECT_EQ(world.primitives[0].material, 0);
    EXPECT_EQ(world.primitives[1].material, 1);
}

} // namespace
} // namespace starbow::gltf_test
