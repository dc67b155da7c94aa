#include "config/model/angles.h"
#include "runtime/world/shrink.h"
#include "tests/support/gltf_fixture.h"

namespace starbow::gltf_test::world_material_test {
namespace {

using WorldMaterialTest = GltfTest;

/// A triangle with one material. Its texture coordinates are 00, 10, 01 in set 0, and 55, 65, 56 in set 1.
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

TEST_F(WorldMaterialTest, BaseColourAndTextureAreRead)
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

TEST(ShrinkTest, LightIsAveragedAsLightAndNumbersAsNumbers)
{
    // Black beside white is half of all light, which sRGB stores as 188. 100 and 200 are 0.1274 and 0.5776 of white, their
    // mean 0.3525 is stored as 160.
    const Bytes rgba{0, 255, 100, 255, 255, 255, 200, 55};
    const Pixels four{rgba.data(), {2, 1}, 4};
    EXPECT_EQ(shrunk(four, {1, 1}, false), (Bytes{188, 255, 160, 155}));
    EXPECT_EQ(shrunk(four, {1, 1}, true), (Bytes{128, 255, 150, 155}));
    // Grey, grey with a cover, and colours without one.
    const Bytes grey{100, 200}, covered{100, 0, 200, 200}, colours{0, 255, 100, 255, 255, 200};
    EXPECT_EQ(shrunk({grey.data(), {1, 2}, 1}, {1, 1}, true), (Bytes{150, 150, 150, 255}));
    EXPECT_EQ(shrunk({grey.data(), {1, 2}, 1}, {1, 1}, false), (Bytes{160, 160, 160, 255}));
    EXPECT_EQ(shrunk({covered.data(), {1, 2}, 2}, {1, 1}, true), (Bytes{150, 150, 150, 100}));
    EXPECT_EQ(shrunk({colours.data(), {2, 1}, 3}, {1, 1}, true), (Bytes{128, 255, 150, 255}));
}

TEST_F(WorldMaterialTest, ImagesComeFromBufferViewsAndFiles)
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

/// A grey PNG of one bit a pixel, whose bytes are all `eight`; deflate's stored blocks, without its checksums.
Bytes large_png(int width, int height, std::uint8_t eight)
{
    const auto big = [](std::uint32_t n) {
        return Bytes{std::uint8_t(n >> 24), std::uint8_t(n >> 16), std::uint8_t(n >> 8), std::uint8_t(n)};
    };
    Bytes png{0x89, 'P', 'N', 'G', 13, 10, 26, 10};
    const auto add = [&](const Bytes& more) { png.insert(png.end(), more.begin(), more.end()); };
    const auto chunk = [&](const char* type, const Bytes& data) {
        add(big(std::uint32_t(data.size())));
        add(Bytes(type, type + 4));
        add(data);
        add(Bytes(4));
    };
    Bytes header = big(std::uint32_t(width)), lines, packed{0x78, 1};
    for (const Bytes& more : {big(std::uint32_t(height)), Bytes{1, 0, 0, 0, 0}})
        header.insert(header.end(), more.begin(), more.end());
    for (int y = 0; y < height; ++y) {
        lines.push_back(0);
        lines.insert(lines.end(), std::size_t(width / 8), eight);
    }
    for (std::size_t at = 0; at < lines.size(); at += 65535) {
        const std::size_t length = std::min<std::size_t>(65535, lines.size() - at);
        const bool last = at + length == lines.size();
        for (std::size_t byte : {std::size_t(last), length & 255, length >> 8, ~length & 255, ~length >> 8 & 255})
            packed.push_back(std::uint8_t(byte));
        packed.insert(packed.end(), lines.begin() + std::ptrdiff_t(at), lines.begin() + std::ptrdiff_t(at + length));
    }
    packed.insert(packed.end(), 4, 0);
    chunk("IHDR", header);
    chunk("IDAT", packed);
    chunk("IEND", {});
    return png;
}

TEST_F(WorldMaterialTest, ImagesBeyondTheLimitOfAllAreMadeSmaller)
{
    const auto looks_alike = [](Doc& doc, int count) {
        doc.json["materials"] = Json::array();
        for (int i = 0; i < count; ++i)
            doc.put("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}});
    };
    // Every other column is white: half the light of white, which sRGB stores as 188 (0.7354 of 255).
    const auto is_grey = [](const Texture& texture) {
        EXPECT_EQ(texture.rgba.size(), std::size_t(4) << 24);
        for (std::size_t i : {std::size_t(0), std::size_t(4) * 4095, texture.rgba.size() - 4})
            EXPECT_EQ(Bytes(&texture.rgba[i], &texture.rgba[i] + 4), (Bytes{188, 188, 188, 255}));
    };
    // The device makes the last step.
    write("large.png", large_png(8192, 8192, 0x55));
    Doc doc = painted(textured);
    doc.json["images"][0] = {{"uri", "large.png"}};
    World world = load(doc);
    EXPECT_EQ(world.textures.at(0).size, glm::ivec2(8192));
    ASSERT_TRUE(world.textures[0].large);
    EXPECT_EQ(world.textures[0].large->size, glm::ivec2(8192));
    const Texture smaller = halved(world.textures[0]);
    EXPECT_EQ(smaller.size, glm::ivec2(4096));
    is_grey(smaller);

    // Three of them take one step before.
    doc.json["samplers"] = {{{"wrapS", 33071}}, {{"wrapS", 33648}}, {{"wrapS", 10497}}};
    doc.json["textures"]
        = {{{"source", 0}, {"sampler", 0}}, {{"source", 0}, {"sampler", 1}}, {{"source", 0}, {"sampler", 2}}};
    looks_alike(doc, 3);
    world = load(doc);
    ASSERT_EQ(world.textures.size(), 3u);
    for (const Texture& texture : world.textures) {
        EXPECT_EQ(texture.size, glm::ivec2(4096));
        EXPECT_TRUE(texture.large);
        is_grey(texture);
    }

    // Two that fit one by one: both are too large, and a third, small one is not. An image of two samplers counts twice.
    write("wide.png", large_png(8192, 4096, 0xff));
    doc.json["images"] = {{{"uri", "wide.png"}}, {{"uri", png_uri()}}};
    doc.json["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}}, {{"source", 0}, {"sampler", 1}}};
    world = load(doc);
    ASSERT_EQ(world.textures.size(), 3u);
    EXPECT_TRUE(world.textures[0].large);
    EXPECT_EQ(world.textures[1].size, glm::ivec2(2, 1));
    EXPECT_FALSE(world.textures[1].large);
    EXPECT_TRUE(world.textures[2].large);
    EXPECT_EQ(world.textures[2].sampler.u, Wrap::mirror);
    EXPECT_EQ(world.textures[2].rgba, world.textures[0].rgba);
    doc.json["textures"].erase(2);
    looks_alike(doc, 2);
    world = load(doc);
    EXPECT_EQ(world.textures[0].size, glm::ivec2(8192, 4096));
    EXPECT_FALSE(world.textures[0].large);
    EXPECT_TRUE(world.notes.empty());
}

TEST_F(WorldMaterialTest, TextureCoordinatesMayHaveAnySetAndType)
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
    // The example of the extension's specification: the lower left quarter of the image, rotated clockwise by 90 degrees.
    Doc doc = painted(textured);
    Json& info = doc.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    info["extensions"]["KHR_texture_transform"] = {{"offset", {0, 1}}, {"rotation", pi / 2}, {"scale", {0.5, 0.5}}};
    doc.json["extensionsUsed"] = {"KHR_texture_transform"};
    World world = load(doc);
    EXPECT_NEAR(glm::distance(world.vertices[0].uv, glm::vec2(0, 1)), 0, 1e-7);
    EXPECT_NEAR(glm::distance(world.vertices[1].uv, glm::vec2(0, 0.5)), 0, 1e-7);
    EXPECT_NEAR(glm::distance(world.vertices[2].uv, glm::vec2(0.5, 1)), 0, 1e-7);
    EXPECT_TRUE(world.notes.empty());
    info["extensions"]["KHR_texture_transform"] = {{"scale", {2, -3}}, {"texCoord", 1}};
    EXPECT_EQ(load(doc).vertices[1].uv, glm::vec2(12, -15));
}

TEST_F(WorldMaterialTest, EmissiveStrengthMultipliesTheFactor)
{
    Doc doc = painted({{"emissiveFactor", {1, 0.5, 0.25}}, {"emissiveTexture", {{"index", 0}, {"texCoord", 1}}},
        {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 60}}}}}});
    World world = load(doc);
    EXPECT_EQ(world.materials[0].emissive, glm::vec3(60, 30, 15));
    EXPECT_EQ(world.materials[0].emissive_texture, 0);
    EXPECT_EQ(world.vertices[1].uv, glm::vec2(6, 5)) << "the only texture decides which coordinates are used";
    doc.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    world = load(doc);
    EXPECT_EQ(world.vertices[1].uv, glm::vec2(1, 0));
    EXPECT_EQ(world.textures.size(), 1u);
    ASSERT_TRUE(world.materials[0].emissive_map) << "with coordinates of its own";
    EXPECT_EQ(glm::vec2(world.vertex_maps.at(1).uvs), glm::vec2(6, 5));
    EXPECT_TRUE(world.notes.empty());
}

TEST_F(WorldMaterialTest, AnUnlitMaterialEmitsNothingMore)
{
    World world = load(painted({{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}},
        {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}}},
        {"extensions", {{"KHR_materials_unlit", Json::object()}}}}));
    EXPECT_TRUE(world.materials[0].unlit);
    EXPECT_EQ(world.materials[0].emissive, glm::vec3(0));
    EXPECT_EQ(world.materials[0].emissive_texture, -1);
}

TEST_F(WorldMaterialTest, AlphaModesAndSidesAreRead)
{
    Doc doc = painted({{"alphaMode", "MASK"}, {"doubleSided", true}});
    EXPECT_EQ(load(doc).materials[0].alpha_cutoff, 0.5f);
    EXPECT_TRUE(load(doc).materials[0].double_sided);
    doc.json["materials"][0]["alphaCutoff"] = 0.25;
    EXPECT_EQ(load(doc).materials[0].alpha_cutoff, 0.25f);
    const Json glass = {{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.5}}}}};
    doc.json["materials"] = {glass, glass};
    EXPECT_EQ(load(doc).materials[0].alpha_cutoff, 0);
    EXPECT_TRUE(load(doc).materials[0].blended);
    EXPECT_TRUE(load(doc).notes.empty());
}

TEST_F(WorldMaterialTest, EqualSamplersShareATexture)
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
    // The default sampler equals the last one, so that the two share a texture.
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

TEST_F(WorldMaterialTest, UnsupportedTexturesGiveAWarning)
{
    Doc doc = painted({{"normalTexture", {{"index", 1}}}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 1}}}}}});
    doc.put("textures", {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}});
    doc.json["images"][0]["uri"] = "missing.png"; // nothing reads it
    World world = load(doc);
    EXPECT_EQ(world.materials[0].base_texture, -1);
    EXPECT_EQ(world.materials[0].gloss->normal.texture, -1);
    EXPECT_EQ(world.notes, std::vector<std::string>{"textures without a PNG, JPEG or WebP image: their surfaces are plain"});
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

/// A material that emits, with these values as "starbow" in its extras.
Doc with_surface(const Json& surface)
{
    return painted({{"emissiveFactor", {0, 0.5, 0}}, {"extras", {{"starbow", surface}}}});
}

TEST_F(WorldMaterialTest, OtherExtrasChangeNoSurface)
{
    for (const Json& extras : {Json("mine"), Json::array({1, 2}), Json{{"exporter", {{"temperature_K", -1}}}}, Json()}) {
        const Material material = load(painted({{"name", "paint"}, {"extras", extras}})).materials.at(0);
        EXPECT_EQ(material.name, "paint");
        EXPECT_FALSE(material.ultraviolet || material.infrared || material.emission);
        EXPECT_TRUE(material.reflectance.empty());
        EXPECT_EQ(material.temperature_K, 0);
        EXPECT_EQ(material.emissivity, 0);
    }
}

TEST_F(WorldMaterialTest, StarbowExtrasDescribeTheSpectrum)
{
    const Json surface = {{"ultraviolet", 0.1}, {"infrared", 0.6}, {"reflectance", {{300, 0}, {550.5, 1}, {1000, 0.25}}},
        {"temperature_K", 288}, {"emissivity", 0.5}, {"emission", {{"line_nm", 450}}}};
    for (const Json& form : {surface, Json(surface.dump())}) { // an object, or the same as a text
        Doc doc = with_surface(form);
        doc.json["materials"][0]["name"] = "paint";
        doc.json["materials"].push_back({{"name", "plain"}});
        const World world = load(doc);
        const Material& material = world.materials.at(0);
        EXPECT_EQ(material.name, "paint");
        EXPECT_EQ(material.emissive, glm::vec3(0, 0.5f, 0));
        EXPECT_EQ(material.ultraviolet, 0.1);
        EXPECT_EQ(material.infrared, 0.6);
        EXPECT_EQ(material.reflectance, (std::vector<std::pair<double, double>>{{300, 0}, {550.5, 1}, {1000, 0.25}}));
        EXPECT_EQ(material.temperature_K, 288);
        EXPECT_EQ(material.emissivity, 0.5);
        EXPECT_EQ(material.emission, Emission(SpectralLine{450}));
        EXPECT_EQ(world.materials.at(1).temperature_K, 0);
        EXPECT_FALSE(world.materials[1].emission);
        EXPECT_TRUE(world.notes.empty());
    }
    EXPECT_EQ(load(with_surface({{"temperature_K", 300}})).materials[0].emissivity, 0.9);
    EXPECT_EQ(load(with_surface({{"emission", {{"black_body_K", 2856}}}})).materials[0].emission, Emission(BlackBody{2856}));
    EXPECT_EQ(load(with_surface({{"emission", {{"table", {{400, 0}, {500, 2e3}}}}}})).materials[0].emission,
        Emission(SpectralTable{{{400, 0}, {500, 2e3}}}));
    EXPECT_FALSE(load(with_surface(Json::object())).materials[0].emission);
}

TEST_F(WorldMaterialTest, FaultySurfacesAreNamedByTheirPointer)
{
    const std::string at = "/materials/0/extras/starbow";
    const std::vector<std::pair<const char*, std::string>> cases = {{"3", ": is 3; should be an object"},
        {"\"warm\"", ": is \"warm\", which is not JSON; should be an object"},
        {R"("{\"temperature_K\": 1e400}")", ": is \"{\"temperature_K\": 1e400}\", which is not JSON"},
        {"\"[]\"", ": is a list of 0; should be an object"},
        {R"("{\"emissivity\": 1}")", "/emissivity: says how well the surface glows"},
        {R"({"temperature": 288})",
            "/temperature: is not known here; should be one of \"ultraviolet\", \"infrared\", "
            "\"reflectance\", \"temperature_K\", \"emissivity\", \"emission\", \"clock\", \"blink\""},
        {R"({"a\nb": 288})", "/a?b: is not known here"},
        {R"({"ultraviolet": -0.1})", "/ultraviolet: is -0.1; should be a number from 0.0 to 1.0"},
        {R"({"infrared": 1.5})", "/infrared: is 1.5; should be a number from 0.0 to 1.0"},
        {R"({"infrared": null})", "/infrared: is null; should be a number"},
        {R"({"temperature_K": 0})", "/temperature_K: is 0; should be a number from 0.1 to 1000000.0"},
        {R"({"temperature_K": 1e7})", "/temperature_K: is 10000000.0; should be a number from 0.1"},
        {R"({"temperature_K": 288, "emissivity": 2})", "/emissivity: is 2; should be a number from 0.0 to 1.0"},
        {R"({"emissivity": 0.5})", "/emissivity: says how well the surface glows but not how warm it is; should stand"},
        {R"({"reflectance": 0.5})", "/reflectance: is not a list; should be a list of 2 to 4096 pairs"},
        {R"({"reflectance": [[500, 0.5]]})", "/reflectance: is a list of 1; should be a list of 2 to 4096 pairs"},
        {R"({"reflectance": [500, 0.5]})", "/reflectance/0: should be a pair [wavelength in nm, value]"},
        {R"({"reflectance": [[500, 0.5, 1], [600, 1]]})", "/reflectance/0: should be a pair"},
        {R"({"reflectance": [[500, 0.5], [600, 1.01]]})", "/reflectance/1/1: is 1.01; should be a number from 0.0 to 1.0"},
        {R"({"reflectance": [[500, 0.5], [500, 1]]})",
            "/reflectance/1/0: is 500; should be above the wavelength before, 500"},
        {R"({"reflectance": [[500, 0.5], [13000, 1]]})", "/reflectance/1/0: is 13000; should be a number from 40.0 to"},
        {R"({"emission": 450})", "/emission: is 450; should be an object"},
        {R"({"emission": {}})", "/emission: has 0 members; should have one of \"black_body_K\", \"line_nm\", \"table\""},
        {R"({"emission": {"line_nm": 450, "black_body_K": 3000}})", "/emission: has 2 members; should have one of"},
        {R"({"emission": {"temperature_K": 3000}})", "/emission/temperature_K: is not known here; should be one of"},
        {R"({"emission": {"line_nm": 39.9}})", "/emission/line_nm: is 39.9; should be a number from 40.0 to 12000.0"},
        {R"({"emission": {"black_body_K": 0.01}})", "/emission/black_body_K: is 0.01; should be a number from 0.1"},
        {R"({"emission": {"table": [[500, 0], [600, 0]]}})", "/emission/table: is 0 everywhere; should have a value above"},
        {R"({"emission": {"table": [[500, 1], [600, -1]]}})", "/emission/table/1/1: is -1; should be a number from 0.0"},
        {R"({"clock": true})", "/clock: is true; should be an object"},
        {R"({"clock": {"zero": 1}})", "/clock/zero: is not known here; should be one of \"zero_s\""},
        {R"({"clock": {"zero_s": "noon"}})", "/clock/zero_s: is \"noon\"; should be a number from -10000000000.0 to"},
        {R"({"clock": {"zero_s": 1e11}})", "/clock/zero_s: is 100000000000.0; should be a number from"},
        {R"({"blink": {}})", "/blink: has no \"period_s\"; should say how many seconds"},
        {R"({"blink": {"period_s": 0}})", "/blink/period_s: is 0; should be a number from"},
        {R"({"blink": {"period_s": 1, "on": 2}})", "/blink/on: is 2; should be a number from 0.0 to 1.0"},
        {R"({"blink": {"period_s": 1, "rate": 2}})", "/blink/rate: is not known here; should be one of \"period_s\""}};
    for (const auto& [surface, says] : cases) {
        const std::string line = complaint(with_surface(Json::parse(surface)));
        EXPECT_TRUE(line.starts_with(at + says)) << line << "\n" << at + says;
    }
    Doc long_list = with_surface(Json::object());
    Json& table = long_list.json["materials"][0]["extras"]["starbow"]["reflectance"] = Json::array();
    for (int i = 0; i < 4097; ++i)
        table.push_back({100 + i, 0.5});
    EXPECT_TRUE(complaint(long_list).starts_with(at + "/reflectance: is a list of 4097; should be a list of 2 to 4096"));
    table.erase(0);
    EXPECT_EQ(load(long_list).materials[0].reflectance.size(), 4096u);
}

TEST_F(WorldMaterialTest, AnEmissionThatWouldEmitNothingIsRefused)
{
    const Json extras = {{"starbow", {{"emission", {{"line_nm", 450}}}}}};
    const Json strength = {{"KHR_materials_emissive_strength", {{"emissiveStrength", 0}}}};
    const std::string at = "/materials/0/extras/starbow/emission: ";
    for (const Json& black : {Json{{"extras", extras}}, Json{{"extras", extras}, {"emissiveFactor", {0, 0, 0}}},
             Json{{"extras", extras}, {"emissiveFactor", {1, 1, 1}}, {"extensions", strength}}})
        EXPECT_TRUE(complaint(painted(black)).starts_with(at + "would emit nothing")) << black;
    EXPECT_TRUE(complaint(painted({{"extras", extras}, {"emissiveFactor", {1, 1, 1}},
                              {"extensions", {{"KHR_materials_unlit", Json::object()}}}}))
                    .starts_with(at + "stands beside KHR_materials_unlit"));
}

TEST_F(WorldMaterialTest, BlinkingHasDefaultsAndNeedsEmission)
{
    Json material = {{"emissiveFactor", {1, 1, 1}}, {"extras", {{"starbow", {{"blink", {{"period_s", 3}}}}}}}};
    EXPECT_EQ(load(painted(material)).materials[0].blink, (Blink{3, 0.5, 0}));
    material["extras"]["starbow"]["blink"] = {{"period_s", 3}, {"on", 0.1}, {"zero_s", -2}};
    EXPECT_EQ(load(painted(material)).materials[0].blink, (Blink{3, 0.1, -2}));
    material.erase("emissiveFactor");
    EXPECT_TRUE(complaint(painted(material)).starts_with("/materials/0/extras/starbow/blink: would emit nothing"));
    EXPECT_FALSE(load(painted(Json::object())).materials[0].blink);
}

TEST_F(WorldMaterialTest, ClocksStartAtTheirZero)
{
    EXPECT_EQ(load(with_surface({{"clock", {{"zero_s", -12.5}}}})).materials[0].clock, WorldClock{-12.5});
    EXPECT_EQ(load(with_surface({{"clock", Json::object()}})).materials[0].clock, WorldClock{0});
    EXPECT_EQ(load(with_surface("{\"clock\": {\"zero_s\": 3}}")).materials[0].clock, WorldClock{3});
    EXPECT_FALSE(load(with_surface(Json::object())).materials[0].clock);
}

TEST_F(WorldMaterialTest, AClocksDialNeedsTextureCoordinates)
{
    Doc doc = with_surface({{"clock", Json::object()}});
    doc.json["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
    EXPECT_EQ(complaint(doc),
        "/meshes/0/primitives/0/attributes: has no TEXCOORD_0 for a clock's dial; should have one that goes from 0 to 1 "
        "across "
        "it");
}

} // namespace
} // namespace starbow::gltf_test::world_material_test
