#include "tests/support/gltf_fixture.h"
#include <sys/stat.h>

namespace starbow::gltf_test::world_broken_test {
namespace {

using WorldBrokenTest = GltfTest;

/// A valid world with one of everything, to be damaged.
Doc valid()
{
    Doc doc = triangle_doc();
    Json& primitive = doc.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["NORMAL"] = doc.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    primitive["attributes"]["TEXCOORD_0"] = doc.accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2");
    primitive["indices"] = doc.accessor<std::uint16_t>({0, 1, 2}, "SCALAR");
    primitive["material"] = 0;
    doc.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    doc.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    doc.json["samplers"] = {{{"magFilter", 9729}}};
    doc.json["images"] = {{{"uri", png_uri()}}};
    doc.json["nodes"].push_back({{"children", {0}}});
    doc.json["scenes"][0]["nodes"] = {1};
    doc.json["scene"] = 0;
    return doc;
}

struct Damage {
    std::string at, value; ///< JSON pointer; the new value, or "" to remove the old one
    std::string complaint; ///< the beginning of the message after the file's name
};

TEST_F(WorldBrokenTest, EveryFaultIsNamedByItsPointer)
{
    EXPECT_EQ(load(valid()).vertices.size(), 3u);
    const std::vector<Damage> damages = {
        {"/asset", "", "/: has no \"asset\""},
        {"/asset/version", "\"1.0\"", "/asset/version: is glTF \"1.0\"; 2.0 is right"},
        {"/asset/version", "1", "/asset/version: is glTF 1; 2.0 is right"},
        {"/asset/version", "\"3.0\"", "/asset/version: is \"3.0\"; should be \"2.0\""},
        {"/asset/version", "2.0", "/asset/version: is 2.0; should be a text"},
        {"/asset/minVersion", "\"2.1\"", "/asset/minVersion"},
        {"/extensionsRequired", "[\"KHR_texture_basisu\"]", "/extensionsRequired/0: requires KTX2 textures"},
        {"/extensionsUsed", "{}", "/extensionsUsed: is an object; should be a list"},
        {"/buffers", "3", "/buffers: is 3; should be a list"},
        {"/buffers/0", "[]", "/buffers/0: is a list of 0; should be an object"},
        {"/buffers/0/byteLength", "", "/buffers/0: has no \"byteLength\""},
        {"/buffers/0/byteLength", "100000", "/buffers/0/byteLength: is 100000; the buffer has"},
        {"/buffers/0/byteLength", "-1", "/buffers/0/byteLength: is -1; should be a whole number"},
        {"/buffers/0/byteLength", "1e99", "/buffers/0/byteLength: is 1e+99"},
        {"/buffers/0/uri", "\"\"", "/buffers/0/uri"},
        {"/buffers/0/uri", "\"missing.bin\"", "/buffers/0/uri: names \"missing.bin\", which cannot be found"},
        {"/buffers/0/uri", "\".\"", "/buffers/0/uri: names \".\", which is a folder"},
        {"/buffers/0/uri", "\"..\"", "/buffers/0/uri: is \"..\", which leads out of the file's folder"},
        {"/buffers/0/uri", "\"../../../../../../etc/passwd\"", "/buffers/0/uri: is"},
        {"/buffers/0/uri", "\"%2e%2e/%2e%2e/etc/passwd\"", "/buffers/0/uri"},
        {"/buffers/0/uri", "\"/etc/passwd\"", "/buffers/0/uri: is \"/etc/passwd\"; should be a data: URI or a relative"},
        {"/buffers/0/uri", "\"file:///etc/passwd\"", "/buffers/0/uri: is"},
        {"/buffers/0/uri", "\"https://example.org/a.bin\"", "/buffers/0/uri: is"},
        {"/buffers/0/uri", "\"a%00.bin\"", "/buffers/0/uri: is"},
        {"/buffers/0/uri", "\"a%2\"", "/buffers/0/uri: is \"a%2\"; a % should be followed by"},
        {"/buffers/0/uri", "\"data:text/plain,hello\"", "/buffers/0/uri: is"},
        {"/buffers/0/uri", "\"data:;base64,a*b=\"", "/buffers/0/uri: has a character that is not base64"},
        {"/buffers/0/uri", "\"a\\nb\"", "/buffers/0/uri: names \"a?b\""},
        {"/buffers/0/uri", "\"pipe\"", "/buffers/0/uri: names \"pipe\", which is a FIFO, not a file"},
        {"/buffers/0/uri", "\"out.bin\"", "/buffers/0/uri: is \"out.bin\", which leads out"},
        {"/buffers/0/uri", "\"loop.bin\"", "/buffers/0/uri: names \"loop.bin\", which cannot be found"},
        {"/bufferViews/1/buffer", "1", "/bufferViews/1/buffer: names buffer 1; the file has 0 to 0"},
        {"/bufferViews/1/byteOffset", "4294967295", "/bufferViews/1/byteOffset"},
        {"/bufferViews/1/byteLength", "500", "/bufferViews/1: ends at byte"},
        {"/bufferViews/1/byteLength", "0", "/bufferViews/1/byteLength: is 0"},
        {"/bufferViews/1/byteStride", "3", "/bufferViews/1/byteStride: is 3"},
        {"/bufferViews/1/byteStride", "6", "/bufferViews/1/byteStride: is 6; should be a multiple of 4"},
        {"/bufferViews/1/byteStride", "8", "/accessors/1: has elements of 12 bytes"},
        {"/accessors/1/bufferView", "9", "/accessors/1/bufferView: names buffer view 9"},
        {"/accessors/1/bufferView", "-1", "/accessors/1/bufferView: names buffer view -1"},
        {"/accessors/1/bufferView", "\"1\"", "/accessors/1/bufferView: names buffer view \"1\""},
        {"/accessors/1/byteOffset", "4", "/accessors/1: ends at byte 40 of a buffer view of 36"},
        {"/accessors/1/byteOffset", "9007199254740993", "/accessors/1/byteOffset"},
        {"/accessors/1/componentType", "5124", "/accessors/1/componentType: is 5124; should be 5120"},
        {"/accessors/1/componentType", "null", "/accessors/1/componentType: is null"},
        {"/accessors/1/type", "\"VEC5\"", "/accessors/1/type: is \"VEC5\""},
        {"/accessors/1/type", "\"MAT4\"", "/accessors/1: ends at byte 192"},
        {"/accessors/1/count", "4", "/accessors/1: ends at byte 48 of a buffer view of 36"},
        {"/accessors/1/count", "0", "/accessors/1/count: is 0"},
        {"/accessors/1/count", "4294967295", "/accessors/1: ends at byte"},
        {"/accessors/1/count", "18446744073709551616", "/accessors/1/count"},
        {"/accessors/1/count", "2", "/meshes/0/primitives/0/attributes/POSITION: has 3 elements; the other"},
        {"/accessors/1/normalized", "1", "/accessors/1/normalized: is 1; should be true or false"},
        {"/accessors/0", "{\"componentType\":5126,\"type\":\"VEC3\",\"count\":4294967295}",
            "/accessors/0/count: is 4294967295; without a bufferView"},
        {"/accessors/0/sparse", "{}", "/accessors/0/sparse: has no \"count\""},
        {"/accessors/0/sparse",
            "{\"count\":4,\"indices\":{\"bufferView\":3,\"componentType\":5121},\"values\":{\"bufferView\":0}}",
            "/accessors/0/sparse/count: is 4"},
        {"/accessors/0/sparse",
            "{\"count\":3,\"indices\":{\"bufferView\":3,\"componentType\":5121},\"values\":{\"bufferView\":0}}",
            "/accessors/0: has a sparse index that is out of order"},
        {"/accessors/0/sparse",
            "{\"count\":1,\"indices\":{\"bufferView\":1,\"byteOffset\":8,\"componentType\":5125},\"values\":{"
            "\"bufferView\":0}}",
            "/accessors/0: has a sparse index that is out of order or beyond"},
        {"/accessors/0/sparse",
            "{\"count\":1,\"indices\":{\"bufferView\":3,\"componentType\":5126},\"values\":{\"bufferView\":0}}",
            "/accessors/0/sparse/indices/componentType: is 5126"},
        {"/accessors/0/sparse",
            "{\"count\":1,\"indices\":{\"bufferView\":3,\"componentType\":5121},\"values\":{\"bufferView\":3}}",
            "/accessors/0/sparse/values: ends at byte 12"},
        {"/meshes/0/primitives", "[]", "/meshes/0/primitives: is a list of 0; should be a list of 1 or more"},
        {"/meshes/0/primitives/0/attributes", "", "/meshes/0/primitives/0: has no \"attributes\""},
        {"/meshes/0/primitives/0/attributes/POSITION", "7", "/meshes/0/primitives/0/attributes/POSITION: names accessor 7"},
        {"/meshes/0/primitives/0/attributes/POSITION", "2",
            "/meshes/0/primitives/0/attributes/POSITION: names accessor 2 of type VEC2"},
        {"/meshes/0/primitives/0/attributes/JOINTS_0", "70",
            "/meshes/0/primitives/0/attributes/JOINTS_0: names accessor 70"},
        {"/meshes/0/primitives/0/indices", "0", "/meshes/0/primitives/0/indices: names accessor 0 of type VEC3"},
        {"/accessors/3/bufferView", "", "/meshes/0/primitives/0/indices: names accessor 3, which has no bufferView"},
        {"/meshes/0/primitives/0/mode", "7", "/meshes/0/primitives/0/mode: is 7"},
        {"/meshes/0/primitives/0/material", "1", "/meshes/0/primitives/0/material: names material 1; the file has 0 to 0"},
        {"/accessors/3/count", "2", "/meshes/0/primitives/0/indices: has 2 corners; triangles take a multiple of 3"},
        {"/bufferViews/3/byteOffset", "44", "/meshes/0/primitives/0/indices: index 1 is 16256; the vertices are 0 to 2"},
        {"/materials/0/pbrMetallicRoughness/baseColorTexture/index", "1",
            "/materials/0/pbrMetallicRoughness/baseColorTexture/index: names texture 1"},
        {"/materials/0/pbrMetallicRoughness/baseColorTexture/index", "0.5",
            "/materials/0/pbrMetallicRoughness/baseColorTexture/index"},
        {"/materials/0/pbrMetallicRoughness/baseColorFactor", "[1,1,1]",
            "/materials/0/pbrMetallicRoughness/baseColorFactor: is a list of 3; should be a list of 4"},
        {"/materials/0/pbrMetallicRoughness/baseColorFactor", "[1,1,1,2]",
            "/materials/0/pbrMetallicRoughness/baseColorFactor/3: is 2; should be a number from 0.0 to 1.0"},
        {"/materials/0/alphaMode", "\"GLASS\"", "/materials/0/alphaMode: is \"GLASS\""},
        {"/materials/0/doubleSided", "\"yes\"", "/materials/0/doubleSided: is \"yes\""},
        {"/materials/0/extensions", "{\"KHR_materials_emissive_strength\":{\"emissiveStrength\":-1}}",
            "/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength: is -1"},
        {"/materials/0/name", "[1]", "/materials/0/name"},
        {"/textures/0/source", "1", "/textures/0/source: names image 1"},
        {"/textures/0/sampler", "true", "/textures/0/sampler: names sampler true"},
        {"/samplers/0/magFilter", "9987", "/samplers/0/magFilter: is 9987; should be one of [9728,9729]"},
        {"/images/0/uri", "", "/images/0: should have either a uri or a bufferView"},
        {"/images/0/bufferView", "0", "/images/0: should have either a uri or a bufferView"},
        {"/images/0/uri", "\"world.gltf\"", "/images/0: is neither PNG, JPEG nor WebP"},
        {"/images/0/uri", "\"data:image/png;base64,\"", "/images/0: is neither PNG, JPEG nor WebP"},
        {"/images/0/uri", "\"broken.png\"", "/images/0: cannot be decoded"},
        {"/images/0/uri", "\"huge.png\"", "/images/0: is 20000 x 10000 pixels; at most 16384 a side"},
        {"/images/0/uri", "\"vast.png\"", "/images/0: is 33554432 x 10000 pixels; at most 16384 a side"},
        {"/images/0/uri", "\"headless.png\"", "/images/0: has a broken header"},
        {"/images/0/uri", "\"hollow.png\"", "/images/0: is 8000 x 8000 pixels; its"},
        {"/nodes/0/mesh", "1", "/nodes/0/mesh: names mesh 1; the file has 0 to 0"},
        {"/nodes/0/camera", "0", "/nodes/0/camera: names camera 0, but the file has none"},
        {"/nodes/0/children", "[2]", "/nodes/0/children/0: names node 2"},
        {"/nodes/1/children", "[0,0]", "/nodes/1/children/1: names node 0, which is already a child of node 1"},
        {"/nodes/0/children", "[1]", "/nodes/0: is among its own descendants"},
        {"/nodes/0/children", "[0]", "/nodes/1/children/0: names node 0, which is already a child"},
        {"/nodes/0/translation", "[1,2]", "/nodes/0/translation: is a list of 2; should be a list of 3 numbers"},
        {"/nodes/0/translation", "[1,2,1e31]", "/nodes/0/translation/2: is 1e+31"},
        {"/nodes/0/rotation", "[0,0,0,0]", "/nodes/0/rotation: has the length 0.0; should be a unit"},
        {"/nodes/0/matrix", "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2]", "/nodes/0/matrix: has a last row other"},
        {"/nodes/0", "{\"mesh\":0,\"scale\":[1,1,1],\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}",
            "/nodes/0: has a matrix and also"},
        {"/nodes/0/mesh", "", "/scenes: shows nothing"},
        {"/scenes/0/nodes", "[0]", "/scenes/0/nodes/0: names node 0, which has a parent"},
        {"/scenes/0/nodes", "[1,1]", "/scenes/0/nodes/1: names node 1 twice"},
        {"/scenes/0/nodes", "[]", "/scenes/0/nodes: is a list of 0"},
        {"/scene", "1", "/scene: names scene 1; the file has 0 to 0"},
    };
    Bytes image = small_png();
    write("broken.png", Bytes(image.begin(), image.end() - 20));
    Bytes huge = image, hollow = image;
    huge[18] = 0x4e, huge[19] = 0x20, huge[22] = 0x27, huge[23] = 0x10;
    hollow[18] = hollow[22] = 0x1f, hollow[19] = hollow[23] = 0x40;
    write("huge.png", huge);
    Bytes vast = huge, headless = image;
    vast[16] = 2, vast[17] = vast[18] = vast[19] = 0;
    headless[12] = 'J';
    write("vast.png", vast);
    write("headless.png", headless);
    write("hollow.png", hollow);
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    std::filesystem::create_symlink("/etc/passwd", folder / "out.bin");
    std::filesystem::create_symlink("loop.bin", folder / "loop.bin");
    for (const Damage& damage : damages) {
        SCOPED_TRACE(damage.at + " = " + damage.value);
        Doc doc = valid();
        Json::json_pointer at(damage.at);
        if (damage.value.empty() && at.back() != "uri")
            doc.json[at.parent_pointer()].erase(at.back());
        else if (damage.value.empty())
            doc.json["images"][0].erase("uri");
        else
            doc.json[at] = Json::parse(damage.value);
        std::string line = complaint(doc);
        EXPECT_TRUE(line.starts_with(damage.complaint)) << line;
    }
    EXPECT_GE(damages.size(), 40u);
}

TEST_F(WorldBrokenTest, NumbersThatAreNotFiniteAreRefused)
{
    for (float bad : {NAN, INFINITY, -INFINITY, 1e30f})
        for (const char* attribute : {"POSITION", "NORMAL", "TEXCOORD_0"}) {
            Doc doc = valid();
            bool is_uv = attribute[0] == 'T';
            std::vector<float> values(is_uv ? 6 : 9, 1);
            values[is_uv ? 3 : 5] = bad;
            doc.json["meshes"][0]["primitives"][0]["attributes"][attribute] = doc.accessor(values, is_uv ? "VEC2" : "VEC3");
            std::string line = complaint(doc);
            EXPECT_TRUE(
                line.starts_with(std::string("/meshes/0/primitives/0/attributes/") + attribute + ": element 1 is not"))
                << line;
        }
    Doc doc = valid();
    doc.json["nodes"][0]["scale"] = doc.json["nodes"][1]["scale"] = {1e20, 1e20, 1e20};
    EXPECT_TRUE(complaint(doc).starts_with("/nodes/0: with its parents' transforms leads beyond"));
}

TEST_F(WorldBrokenTest, StripsOfTheWrongLengthAreRefused)
{
    Doc doc = valid();
    Json& primitive = doc.json["meshes"][0]["primitives"][0];
    primitive["indices"] = doc.accessor<std::uint8_t>({0, 1}, "SCALAR");
    primitive["mode"] = 5;
    EXPECT_TRUE(complaint(doc).starts_with("/meshes/0/primitives/0/indices: has 2 corners; a strip or fan takes 3"));
    primitive["indices"] = doc.accessor<std::uint8_t>({0, 1, 255}, "SCALAR");
    EXPECT_TRUE(complaint(doc).starts_with("/meshes/0/primitives/0/indices: index 2 is 255; the vertices are 0 to 2"));
}

TEST_F(WorldBrokenTest, OtherThanRegularFilesAreRefused)
{
    EXPECT_TRUE(complaint(folder / "missing.glb").starts_with("does not exist"));
    EXPECT_TRUE(complaint(folder).starts_with("is a folder"));
    ASSERT_EQ(::mkfifo((folder / "pipe.glb").c_str(), 0600), 0);
    EXPECT_TRUE(complaint(folder / "pipe.glb").starts_with("is a FIFO, not a file"));
    EXPECT_TRUE(complaint("/dev/zero").starts_with("is a device, not a file"));
    EXPECT_EQ(::truncate(write("vast.glb", std::string("glTF")).c_str(), (1ll << 30) + 1), 0);
    EXPECT_TRUE(complaint(folder / "vast.glb").starts_with("is larger than 1024 MiB; "));
}

TEST_F(WorldBrokenTest, TextsThatAreNoGltfAreRefused)
{
    auto text = [&](const std::string& content) { return complaint(write("world.gltf", content)); };
    EXPECT_TRUE(text("").starts_with("line 1, column 1: is neither glTF's JSON nor GLB"));
    EXPECT_TRUE(text("{\n  \"asset\": }").starts_with("line 2, column 12: is broken JSON; glTF's JSON is right"));
    const std::string chunk = "{\"asset\": }";
    const auto little = [](std::size_t n) { return std::string{char(n), char(n >> 8), char(n >> 16), char(n >> 24)}; };
    EXPECT_TRUE(
        complaint(write("world.glb", "glTF" + little(2) + little(20 + chunk.size()) + little(chunk.size()) + "JSON" + chunk))
            .starts_with("line 1, column 11: is broken JSON, counted in the GLB's first chunk"));
    EXPECT_TRUE(text("{\"asset\": {\"version\": \"2.0\"").starts_with("line 1, column"));
    EXPECT_TRUE(text("\xff\xfe{").starts_with("line 1, column"));
    EXPECT_TRUE(text("{\"a\": \"\xff\"}").starts_with("line 1, column"));
    EXPECT_TRUE(text("{\"a\": 1e999}").starts_with("/: holds a number out of range"));
    EXPECT_TRUE(text("[]").starts_with("/: is a list of 0; should be an object"));
    EXPECT_TRUE(text("\"glTF\"").starts_with("/: is \"glTF\"; should be an object"));
    EXPECT_TRUE(
        text("{\"asset\": " + std::string(1'000'000, '[')).starts_with("line 1: JSON nested deeper than 100 levels"));
    std::string many = "[0";
    for (int i = 0; i < 2'000'000; ++i)
        many += ",0";
    EXPECT_TRUE(text(many + "]").starts_with("line 1: more than 2000000 JSON values"));
}

TEST_F(WorldBrokenTest, WrongGlbIsRefused)
{
    Doc doc = valid();
    Bytes good = glb_bytes(doc.json.dump(), doc.bin);
    EXPECT_EQ(load_world(write("good.glb", good)).vertices.size(), 3u);
    auto damaged = [&](auto damage) {
        Bytes bytes = good;
        damage(bytes);
        return complaint(write("world.glb", bytes));
    };
    auto set32 = [](Bytes& bytes, std::size_t at, std::uint32_t value) { std::memcpy(&bytes[at], &value, 4); };
    std::size_t json_bytes = good[12] | good[13] << 8;
    EXPECT_TRUE(damaged([&](Bytes& b) { b.resize(11); }).starts_with("byte 0: a GLB of 11 bytes"));
    EXPECT_TRUE(damaged([&](Bytes& b) { set32(b, 4, 1); }).starts_with("byte 4: GLB version 1; should be 2"));
    EXPECT_TRUE(damaged([&](Bytes& b) { b.pop_back(); }).starts_with("byte 8: the header says"));
    EXPECT_TRUE(damaged([&](Bytes& b) { set32(b, 8, 0xffffffff); }).starts_with("byte 8: the header says 4294967295"));
    EXPECT_TRUE(damaged([&](Bytes& b) { set32(b, 12, 0xfffffffd); }).starts_with("byte 12: a chunk of 4294967293 bytes"));
    EXPECT_TRUE(damaged([&](Bytes& b) { set32(b, 16, 0x004E4942); }).starts_with("byte 16: the first chunk is not JSON"));
    EXPECT_TRUE(damaged([&](Bytes& b) { set32(b, 20 + json_bytes, 0xffffff00); }).find(": a chunk of 4294967040 bytes")
        != std::string::npos);
    EXPECT_TRUE(damaged([&](Bytes& b) { set32(b, 24 + json_bytes, 7); }).starts_with("/buffers/0: has no uri"));
    EXPECT_TRUE(damaged([&](Bytes& b) {
        append32(b, 0);
        set32(b, 8, std::uint32_t(b.size()));
    }).ends_with("ends inside a chunk's header"));
}

TEST_F(WorldBrokenTest, FaultyAnimationsAreNamedByTheirPointer)
{
    Doc moving = valid();
    const int times = moving.accessor<float>({0, 1, 2}, "SCALAR");
    const int places = moving.accessor<float>({0, 0, 0, 1, 0, 0, 0, 0, 0}, "VEC3");
    const int turns = moving.accessor<float>({0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1}, "VEC4");
    const int back = moving.accessor<float>({0, 2, 2}, "SCALAR"), early = moving.accessor<float>({-1, 0, 1}, "SCALAR");
    const int one = moving.accessor<float>({1}, "SCALAR"),
              tangents = moving.accessor<float>({0, 0, 0, 1, 1, 1, 0, 0, 0}, "VEC3");
    const int skewed = moving.accessor<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 1}, "VEC4");
    const int endless = moving.accessor<float>({0, 0, 0, 1, 0, INFINITY, 0, 0, 0}, "VEC3");
    moving.json["nodes"].push_back({{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
    moving.json["animations"] = {{{"samplers",
                                      {{{"input", times}, {"output", places}}, {{"input", times}, {"output", turns}},
                                          {{"input", one}, {"output", tangents}, {"interpolation", "CUBICSPLINE"}}}},
        {"channels",
            {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
                {{"sampler", 1}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
    EXPECT_EQ(load(moving).motions.size(), 1u);
    const std::string a = "/animations/0", sampler = a + "/samplers/0", channel = a + "/channels/0";
    auto accessor = [](int i) { return "/accessors/" + std::to_string(i); };
    const std::vector<Damage> damages = {
        {"/animations", "{}", "/animations: is an object; should be a list"},
        {a, "3", a + ": is 3; should be an object"},
        {a + "/samplers", "", a + ": has no \"samplers\""},
        {a + "/channels", "[]", a + "/channels: is a list of 0; should be a list of 1 or more"},
        {sampler + "/input", "99", sampler + "/input: names accessor 99"},
        {sampler + "/input", std::to_string(places),
            sampler + "/input: names accessor " + std::to_string(places) + " of type VEC3"},
        {sampler + "/output", "-1", sampler + "/output: names accessor -1"},
        {sampler + "/output", std::to_string(turns),
            sampler + "/output: names accessor " + std::to_string(turns)
                + " of type VEC4 and "
                  "component type 5126; a translation should be VEC3 and 5126"},
        {a + "/samplers/1/output", std::to_string(places), a + "/samplers/1/output: names accessor"},
        {sampler + "/interpolation", "\"SPLINE\"", sampler + "/interpolation: is \"SPLINE\"; should be \"STEP\""},
        {sampler + "/interpolation", "\"CUBICSPLINE\"", sampler + "/output: has 3 values for 3 times; 9 is right"},
        {channel + "/sampler", "3", channel + "/sampler: names sampler 3; the file has 0 to 2"},
        {channel + "/sampler", "2", a + "/samplers/2/output: has one key; a cubic spline should have two or more"},
        {channel + "/target", "", channel + ": has no \"target\""},
        {channel + "/target/path", "\"colour\"", channel + "/target/path: is \"colour\"; should be \"translation\""},
        {channel + "/target/node", "9", channel + "/target/node: names node 9; the file has 0 to 2"},
        {channel + "/target/node", "2", channel + "/target/node: names node 2, which has a matrix"},
        {a + "/channels/1", "{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"translation\"}}",
            a + "/channels/1/target: names the translation of node 0 again"},
        {sampler + "/input", std::to_string(back), accessor(back) + ": element 2 is 2.0; times should rise"},
        {sampler + "/input", std::to_string(early), accessor(early) + ": element 0 is -1.0; a key's time should be 0 to"},
        {sampler + "/output", std::to_string(endless), accessor(endless) + ": element 1 is not finite or above 1e30"},
        {a + "/samplers/1/output", std::to_string(skewed),
            accessor(skewed) + ": element 1 is not a rotation; should be a unit"},
        {"/nodes/1/extras", "{\"starbow\": 3}", "/nodes/1/extras/starbow: is 3; should be an object"},
        {"/nodes/1/extras", "{\"starbow\": {\"turn\": 1}}", "/nodes/1/extras/starbow/turn: is not known here"},
        {"/nodes/1/extras", "{\"starbow\": {\"spin\": {\"axis\": [0, 1, 0]}}}",
            "/nodes/1/extras/starbow/spin: has no \"turns_per_s\"; should say"},
        {"/nodes/1/extras", "{\"starbow\": {\"spin\": {\"axis\": [0, 0, 0], \"turns_per_s\": 1}}}",
            "/nodes/1/extras/starbow/spin/axis: has the length 0; should be a direction"},
        {"/nodes/1/extras", "{\"starbow\": {\"spin\": {\"axis\": [0, 1], \"turns_per_s\": 1}}}",
            "/nodes/1/extras/starbow/spin/axis: is a list of 2"},
        {"/nodes/1/extras", "{\"starbow\": {\"spin\": {\"axis\": [0, 1, 0], \"turns_per_s\": null}}}",
            "/nodes/1/extras/starbow/spin/turns_per_s: is null; should be a number"},
    };
    for (const Damage& damage : damages) {
        SCOPED_TRACE(damage.at + " = " + damage.value);
        Doc doc = moving;
        const Json::json_pointer at(damage.at);
        if (!damage.value.empty())
            doc.json[at] = Json::parse(damage.value);
        else
            doc.json[at.parent_pointer()].erase(at.back());
        const std::string line = complaint(doc);
        EXPECT_TRUE(line.starts_with(damage.complaint)) << line << "\n" << damage.complaint;
    }
    // A chain of spinning nodes, deeper than allowed.
    Doc deep = valid();
    for (int i = 0; i < 70; ++i) {
        Json node = {{"children", Json::array({deep.json["scenes"][0]["nodes"][0]})}};
        node["extras"]["starbow"]["spin"] = {{"axis", {0, 1, 0}}, {"turns_per_s", 0.001}};
        deep.json["scenes"][0]["nodes"] = {deep.put("nodes", node)};
    }
    std::string line = complaint(deep);
    EXPECT_NE(line.find("moves below more than 64 nodes that move"), std::string::npos) << line;
    // Two animated scales, one below the other, whose product exceeds the limit.
    deep = valid();
    const int zero = deep.accessor<float>({0}, "SCALAR"), huge = deep.accessor<float>({1e20f, 1e20f, 1e20f}, "VEC3");
    const int child = deep.put("nodes", {{"children", Json::array({deep.json["scenes"][0]["nodes"][0]})}});
    const int parent = deep.put("nodes", {{"children", {child}}});
    deep.json["scenes"][0]["nodes"] = {parent};
    deep.json["animations"] = {{{"samplers", {{{"input", zero}, {"output", huge}}}},
        {"channels",
            {{{"sampler", 0}, {"target", {{"node", child}, {"path", "scale"}}}},
                {{"sampler", 0}, {"target", {{"node", parent}, {"path", "scale"}}}}}}}};
    line = complaint(deep);
    EXPECT_NE(line.find("may lead beyond 1e30"), std::string::npos) << line;
}

} // namespace
} // namespace starbow::gltf_test::world_broken_test
