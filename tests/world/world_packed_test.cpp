// Worlds in packed forms, each against the same world in plain glTF: meshes by Draco and meshoptimizer, WebP pictures, and
// one mesh in many places.
#include "config/json/error.h"
#include "runtime/world/gltf/guard.h"
#include "tests/support/gltf_fixture.h"
#include <draco/compression/encode.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <meshoptimizer.h>
#include <random>
#include <webp/encode.h>

namespace starbow::gltf_test::world_packed_test {
namespace {

using WorldPackedTest = GltfTest;

/// A wavy sheet of side x side vertices.
struct Sheet {
    std::vector<float> positions, normals, uv;
    std::vector<std::uint32_t> indices;

    explicit Sheet(int side)
    {
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                positions.insert(positions.end(), {float(x), float(std::sin(0.7 * x + 0.3 * y)), float(y)});
                const glm::vec3 normal
                    = glm::normalize(glm::vec3(-0.7 * std::cos(0.7 * x + 0.3 * y), 1, -0.3 * std::cos(0.7 * x + 0.3 * y)));
                normals.insert(normals.end(), {normal.x, normal.y, normal.z});
                uv.insert(uv.end(), {float(x) / side, float(y) / side});
            }
        for (int y = 0; y + 1 < side; ++y)
            for (int x = 0; x + 1 < side; ++x) {
                const auto at = [&](int i, int j) { return std::uint32_t((y + j) * side + x + i); };
                indices.insert(indices.end(), {at(0, 0), at(0, 1), at(1, 0), at(1, 0), at(0, 1), at(1, 1)});
            }
    }
    std::size_t count() const { return positions.size() / 3; }
};

Doc plain(const Sheet& sheet)
{
    Doc doc;
    const int positions = doc.accessor<float>(sheet.positions, "VEC3"), normals = doc.accessor<float>(sheet.normals, "VEC3"),
              uv = doc.accessor<float>(sheet.uv, "VEC2"), indices = doc.accessor<std::uint32_t>(sheet.indices, "SCALAR");
    doc.show({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uv}}}, {"indices", indices}});
    return doc;
}

/// The corners of all triangles in drawing order, whatever the vertices' order.
std::vector<Vertex> corners(const World& world)
{
    std::vector<Vertex> out;
    for (const Instance& instance : world.instances) {
        const Primitive& primitive = world.primitives[instance.primitive];
        for (std::uint32_t i = 0; i < primitive.index_count; ++i)
            out.push_back(world.vertices[world.indices[primitive.first_index + i] + std::uint32_t(primitive.vertex_offset)]);
    }
    return out;
}

/// by: the greatest difference of a position; normals and coordinates may differ by a hundredth.
void expect_same(const World& a, const World& b, double by)
{
    const auto one = corners(a), other = corners(b);
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
        ASSERT_LT(glm::distance(one[i].position, other[i].position), by) << i;
        ASSERT_LT(glm::distance(one[i].normal, other[i].normal), 0.02) << i;
        ASSERT_LT(glm::distance(one[i].uv, other[i].uv), 0.01) << i;
    }
}

/// The sheet as a view of EXT_meshopt_compression for each accessor.
Doc by_meshopt(const Sheet& sheet)
{
    Doc doc = plain(sheet);
    const int fallback
        = doc.put("buffers", {{"byteLength", 1 << 20}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    Bytes packed_all;
    const auto pack = [&](int accessor, const Bytes& packed, std::size_t stride, std::size_t count, const char* mode,
                          const char* filter) {
        const int view = doc.view(packed);
        Json& to = doc.json["bufferViews"][std::size_t(view)];
        const Json from = to;
        to["extensions"]["EXT_meshopt_compression"]
            = {{"buffer", from.value("buffer", 0)}, {"byteOffset", from.value("byteOffset", 0)},
                {"byteLength", packed.size()}, {"byteStride", stride}, {"count", count}, {"mode", mode}, {"filter", filter}};
        to["buffer"] = fallback, to["byteOffset"] = 0, to["byteLength"] = stride * count;
        if (std::string(mode) == "ATTRIBUTES")
            to["byteStride"] = stride;
        doc.json["accessors"][std::size_t(accessor)]["bufferView"] = view;
        doc.json["accessors"][std::size_t(accessor)].erase("byteOffset");
    };
    const auto attributes = [&](const auto& values, std::size_t stride) {
        Bytes packed(meshopt_encodeVertexBufferBound(sheet.count(), stride));
        packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), values.data(), sheet.count(), stride));
        return packed;
    };
    pack(0, attributes(sheet.positions, 12), 12, sheet.count(), "ATTRIBUTES", "NONE");
    // Normals by their octahedron in eight bits.
    std::vector<float> four;
    for (std::size_t i = 0; i < sheet.count(); ++i)
        four.insert(four.end(), {sheet.normals[3 * i], sheet.normals[3 * i + 1], sheet.normals[3 * i + 2], 0});
    std::vector<std::int8_t> octahedra(4 * sheet.count());
    meshopt_encodeFilterOct(octahedra.data(), sheet.count(), 4, 8, four.data());
    pack(1, attributes(octahedra, 4), 4, sheet.count(), "ATTRIBUTES", "OCTAHEDRAL");
    doc.json["accessors"][1]["componentType"] = 5120, doc.json["accessors"][1]["normalized"] = true;
    std::vector<std::uint32_t> exponents(2 * sheet.count());
#if MESHOPTIMIZER_VERSION >= 200
    meshopt_encodeFilterExp(exponents.data(), sheet.count(), 8, 15, sheet.uv.data(), meshopt_EncodeExpSharedVector);
#else
    meshopt_encodeFilterExp(exponents.data(), sheet.count(), 8, 15, sheet.uv.data());
#endif
    pack(2, attributes(exponents, 8), 8, sheet.count(), "ATTRIBUTES", "EXPONENTIAL");
    Bytes packed(meshopt_encodeIndexBufferBound(sheet.indices.size(), sheet.count()));
    packed.resize(meshopt_encodeIndexBuffer(packed.data(), packed.size(), sheet.indices.data(), sheet.indices.size()));
    pack(3, packed, 4, sheet.indices.size(), "TRIANGLES", "NONE");
    doc.json["extensionsRequired"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
    return doc;
}

Doc by_draco(const Sheet& sheet)
{
    draco::Mesh mesh;
    mesh.set_num_points(std::uint32_t(sheet.count()));
    const auto add = [&](draco::GeometryAttribute::Type type, const std::vector<float>& values, int components) {
        draco::GeometryAttribute attribute;
        attribute.Init(type, nullptr, std::int8_t(components), draco::DT_FLOAT32, false, 4 * components, 0);
        const int id = mesh.AddAttribute(attribute, true, std::uint32_t(sheet.count()));
        for (std::uint32_t i = 0; i < sheet.count(); ++i)
            mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &values[i * std::size_t(components)]);
        return int(mesh.attribute(id)->unique_id());
    };
    const int positions = add(draco::GeometryAttribute::POSITION, sheet.positions, 3),
              normals = add(draco::GeometryAttribute::NORMAL, sheet.normals, 3),
              uv = add(draco::GeometryAttribute::TEX_COORD, sheet.uv, 2);
    for (std::size_t i = 0; i < sheet.indices.size(); i += 3)
        mesh.AddFace({draco::PointIndex(sheet.indices[i]), draco::PointIndex(sheet.indices[i + 1]),
            draco::PointIndex(sheet.indices[i + 2])});
    draco::Encoder encoder;
    encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING); // keeps the triangles' order
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 16);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, 10);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 12);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
    Doc doc = plain(sheet);
    const int view = doc.view(Bytes(buffer.data(), buffer.data() + buffer.size()));
    doc.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]
        = {{"bufferView", view}, {"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uv}}}};
    for (Json& accessor : doc.json["accessors"])
        accessor.erase("bufferView");
    doc.json["extensionsUsed"] = doc.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return doc;
}

TEST_F(WorldPackedTest, MeshoptIsThePlainMesh)
{
    const Sheet sheet(20);
    expect_same(load(by_meshopt(sheet)), load(plain(sheet)), 1e-7);
}

TEST_F(WorldPackedTest, DracoIsThePlainMesh)
{
    const Sheet sheet(20);
    expect_same(load(by_draco(sheet)), load(plain(sheet)), 20.0 / (1 << 15));
}

TEST_F(WorldPackedTest, FaultsOfPackedMeshesAreNamed)
{
    const Sheet sheet(8);
    const auto said = [&](Doc doc, const std::string& at, const Json& value) {
        doc.json[Json::json_pointer(at)] = value;
        return complaint(doc);
    };
    const Doc meshopt = by_meshopt(sheet), draco = by_draco(sheet);
    const std::string first = "/bufferViews/4/extensions/EXT_meshopt_compression";
    EXPECT_TRUE(said(meshopt, first + "/mode", "OTHER").starts_with(first + "/mode: is \"OTHER\""));
    EXPECT_TRUE(said(meshopt, first + "/byteStride", 6).starts_with(first + "/byteStride: is 6"));
    EXPECT_TRUE(said(meshopt, first + "/count", 65).starts_with(first + ": cannot be decoded"));
    EXPECT_TRUE(said(meshopt, first + "/count", 40000000).starts_with(first + "/count: is 40000000"));
    EXPECT_TRUE(said(meshopt, first + "/filter", "QUATERNION").starts_with(first + "/filter: is QUATERNION"));
    EXPECT_TRUE(said(meshopt, first + "/byteLength", 1 << 24).starts_with(first + ": ends at byte"));
    const std::string packed = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
    EXPECT_TRUE(
        said(draco, packed + "/attributes/POSITION", 77).starts_with(packed + "/attributes/POSITION: names attribute 77"));
    EXPECT_TRUE(said(draco, packed + "/bufferView", 0).starts_with(packed + ": cannot be decoded"));
    EXPECT_TRUE(said(draco, packed + "/bufferView", 99).starts_with(packed + "/bufferView"));
}

/// STARBOW_FUZZ_COUNT sets the number of mutations; the first ones are always the same.
TEST_F(WorldPackedTest, DamagedPackedMeshesLoadOrAreRefused)
{
    const char* count_text = std::getenv("STARBOW_FUZZ_COUNT");
    const int count = count_text ? int(std::atol(count_text)) : 600;
    const Sheet sheet(6);
    const std::vector<Doc> seeds{by_meshopt(sheet), by_draco(sheet)};
    int loaded = 0;
    for (int n = 0; n < count; ++n) {
        SCOPED_TRACE("mutation " + std::to_string(n));
        std::mt19937 random{std::uint32_t(n)};
        Doc doc = seeds[std::size_t(n % 2)];
        // Any byte may be another one, and any whole number of the packing.
        for (std::size_t flips = 1 + random() % 4; flips > 0; --flips)
            doc.bin[random() % doc.bin.size()] ^= std::uint8_t(1u << random() % 8);
        if (n % 2 == 0 && random() % 2) {
            Json& packed = doc.json["bufferViews"][4 + random() % 4]["extensions"]["EXT_meshopt_compression"];
            const char* members[] = {"byteOffset", "byteLength", "byteStride", "count"};
            packed[members[random() % 4]] = random() % 3 ? random() % 300 : random();
        }
        const auto file = write("world.gltf", doc.text());
        try {
            const World world = load_world(file);
            for (const std::uint32_t index : world.indices)
                ASSERT_LT(index, world.vertices.size());
            ++loaded;
        } catch (const InputError& error) {
            ASSERT_TRUE(std::string(error.what()).starts_with(file.string() + ": ")) << error.what();
        } catch (const std::exception& error) {
            FAIL() << "neither loaded nor refused: " << error.what();
        }
    }
    EXPECT_GT(loaded, count / 20);
    std::printf("%d of %d damaged packed meshes loaded, the others were refused\n", loaded, count);
}

TEST(MeshLimits, GrowWithTheFileAndTheMachine)
{
    constexpr std::size_t GB = 1'000'000'000;
    EXPECT_EQ(mesh_limits(1000, 64 * GB).vertices, GltfLimits::vertices);
    EXPECT_EQ(mesh_limits(1000, 64 * GB).indices, GltfLimits::indices);
    // 20 million triangles of ten million vertices, in half a gigabyte, on a machine of 16 GB.
    const MeshLimits large = mesh_limits(GB / 2, 16 * GB);
    EXPECT_GE(large.vertices, 10'000'000u);
    EXPECT_GE(large.indices, 60'000'000u);
    // The machine's memory bounds what a large file may take.
    const MeshLimits bounded = mesh_limits(GB, 8 * GB);
    EXPECT_LE(bounded.vertices * 2 * sizeof(Vertex) + bounded.indices * 16, 4 * GB);
}

TEST_F(WorldPackedTest, WebpIsThePicture)
{
    constexpr int width = 5, height = 3;
    Bytes rgba;
    std::mt19937 random(1);
    for (int i = 0; i < width * height; ++i)
        rgba.insert(rgba.end(),
            {std::uint8_t(random()), std::uint8_t(random()), std::uint8_t(random()), std::uint8_t(random() | 1)});
    std::uint8_t* encoded = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(rgba.data(), width, height, 4 * width, &encoded);
    ASSERT_GT(size, 0u);
    const Bytes webp(encoded, encoded + size);
    WebPFree(encoded);
    Doc doc = triangle_doc();
    doc.json["images"] = {{{"uri", png_uri()}}, {{"bufferView", doc.view(webp)}, {"mimeType", "image/webp"}}};
    doc.json["textures"] = {{{"source", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}}};
    doc.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    doc.json["meshes"][0]["primitives"][0]["material"] = 0;
    doc.json["extensionsRequired"] = {"EXT_texture_webp"};
    const World world = load(doc);
    ASSERT_EQ(world.textures.size(), 1u);
    EXPECT_EQ(world.textures[0].size, glm::ivec2(width, height));
    EXPECT_EQ(world.textures[0].rgba, rgba);
    // Half of it is refused.
    doc.json["bufferViews"].back()["byteLength"] = size / 2;
    EXPECT_TRUE(complaint(doc).starts_with("/images/1: ")) << complaint(doc);
}

// The container by its specification, put together by hand: a canvas of 7 x 5, whose first frame is at (2, 2).
TEST_F(WorldPackedTest, OfAnAnimatedWebpTheFirstFrameIsThePicture)
{
    const auto chunk = [](Bytes& to, const char* name, const Bytes& data) {
        to.insert(to.end(), name, name + 4);
        append32(to, std::uint32_t(data.size()));
        to.insert(to.end(), data.begin(), data.end());
        if (data.size() % 2)
            to.push_back(0);
    };
    const auto put24 = [](Bytes& to, int value) {
        to.insert(to.end(), {std::uint8_t(value), std::uint8_t(value >> 8), std::uint8_t(value >> 16)});
    };
    const auto still = [](const Bytes& rgba, bool lossy) {
        std::uint8_t* encoded = nullptr;
        const std::size_t size = lossy ? WebPEncodeRGBA(rgba.data(), 4, 2, 16, 90, &encoded)
                                       : WebPEncodeLosslessRGBA(rgba.data(), 4, 2, 16, &encoded);
        Bytes webp(encoded, encoded + size);
        WebPFree(encoded);
        return webp;
    };
    const auto animated = [&](const std::vector<Bytes>& frames, int left = 2) {
        Bytes body{'W', 'E', 'B', 'P'}, canvas{0x12, 0, 0, 0}, all{'R', 'I', 'F', 'F'};
        put24(canvas, 7 - 1), put24(canvas, 5 - 1);
        chunk(body, "VP8X", canvas);
        chunk(body, "ANIM", {0, 0, 0, 0, 0, 0});
        for (const Bytes& frame : frames) {
            Bytes data;
            put24(data, left / 2), put24(data, 1), put24(data, 4 - 1), put24(data, 2 - 1), put24(data, 100);
            data.push_back(0);
            std::size_t from = 12; // behind RIFF, its size and WEBP
            if (std::memcmp(frame.data() + from, "VP8X", 4) == 0)
                from += 18;
            data.insert(data.end(), frame.begin() + std::ptrdiff_t(from), frame.end());
            chunk(body, "ANMF", data);
        }
        append32(all, std::uint32_t(body.size()));
        all.insert(all.end(), body.begin(), body.end());
        return all;
    };
    Bytes red, blue;
    for (int i = 0; i < 8; ++i)
        red.insert(red.end(), {200, 0, 0, 128}), blue.insert(blue.end(), {0, 0, 255, 255});
    const auto with = [&](const Bytes& webp) {
        Doc doc = triangle_doc();
        doc.json["images"] = {{{"bufferView", doc.view(webp)}, {"mimeType", "image/webp"}}};
        doc.json["textures"] = {{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}};
        doc.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
        doc.json["meshes"][0]["primitives"][0]["material"] = 0;
        return doc;
    };
    for (const bool lossy : {false, true}) {
        const World world = load(with(animated({still(red, lossy), still(blue, lossy)})));
        ASSERT_EQ(world.textures.size(), 1u);
        ASSERT_EQ(world.textures[0].size, glm::ivec2(7, 5));
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 7; ++x) {
                const std::uint8_t* texel = &world.textures[0].rgba[std::size_t(4 * (7 * y + x))];
                const bool inside = x >= 2 && x < 6 && y >= 2 && y < 4;
                EXPECT_NEAR(texel[3], inside ? 128 : 0, lossy ? 3 : 0) << x << ' ' << y;
                EXPECT_NEAR(texel[0], inside ? 200 : 0, lossy ? 12 : 0) << x << ' ' << y;
            }
    }
    // A frame that reaches beyond its canvas.
    EXPECT_NE(complaint(with(animated({still(red, false)}, 4))).find("animated WebP whose first frame cannot be decoded"),
        std::string::npos);
}

TEST_F(WorldPackedTest, ManyPlacesAreThoseOfAsManyNodes)
{
    std::mt19937_64 random(3);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<float> places, turns, sizes;
    Doc nodes = triangle_doc();
    const int mesh = nodes.json["nodes"][0]["mesh"];
    Json children = Json::array();
    for (int i = 0; i < 50; ++i) {
        const glm::quat turn = glm::normalize(glm::quat(uniform(random), uniform(random), uniform(random), uniform(random)));
        const glm::vec3 place(10 * uniform(random), uniform(random), uniform(random)),
            size(1, 2 + uniform(random), i % 5 == 0 ? -1 : 1);
        places.insert(places.end(), {place.x, place.y, place.z});
        turns.insert(turns.end(), {turn.x, turn.y, turn.z, turn.w});
        sizes.insert(sizes.end(), {size.x, size.y, size.z});
        children.push_back(nodes.put("nodes",
            {{"mesh", mesh}, {"translation", {place.x, place.y, place.z}}, {"rotation", {turn.x, turn.y, turn.z, turn.w}},
                {"scale", {size.x, size.y, size.z}}}));
    }
    nodes.json["nodes"][0] = {{"children", children}, {"translation", {1, 2, 3}}, {"scale", {2, 2, 2}}};
    Doc many = triangle_doc();
    const int t = many.accessor<float>(places, "VEC3"), r = many.accessor<float>(turns, "VEC4"),
              s = many.accessor<float>(sizes, "VEC3");
    many.json["nodes"][0]["translation"] = {1, 2, 3}, many.json["nodes"][0]["scale"] = {2, 2, 2};
    many.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]
        = {{"TRANSLATION", t}, {"ROTATION", r}, {"SCALE", s}};
    const World one = load(many), other = load(nodes);
    ASSERT_EQ(one.instances.size(), 50u);
    ASSERT_EQ(other.instances.size(), 50u);
    for (std::size_t i = 0; i < 50; ++i) {
        for (int column = 0; column < 4; ++column)
            EXPECT_LT(
                glm::distance(one.instances[i].frame_from_local[column], other.instances[i].frame_from_local[column]), 1e-6);
        EXPECT_EQ(one.instances[i].primitive, other.instances[i].primitive);
        EXPECT_EQ(one.instances[i].node, 0);
    }
    many.json["accessors"][std::size_t(r)]["count"] = 49;
    EXPECT_NE(complaint(many).find("has 49 elements; the other attributes have 50"), std::string::npos) << complaint(many);
}

} // namespace
} // namespace starbow::gltf_test::world_packed_test
