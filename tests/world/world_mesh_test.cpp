#include "tests/support/gltf_fixture.h"

namespace starbow::gltf_test::world_mesh_test {
namespace {

using WorldMeshTest = GltfTest;

std::vector<std::uint32_t> triangles(const World& world, std::uint32_t primitive = 0)
{
    const Primitive& p = world.primitives.at(primitive);
    std::vector<std::uint32_t> out;
    for (std::uint32_t i = 0; i < p.index_count; ++i)
        out.push_back(world.indices.at(p.first_index + i) + std::uint32_t(p.vertex_offset));
    return out;
}

/// The corners of the first primitive's triangles, in order.
std::vector<glm::vec3> corners(const World& world)
{
    std::vector<glm::vec3> out;
    for (std::uint32_t i : triangles(world))
        out.push_back(world.vertices.at(i).position);
    return out;
}

TEST_F(WorldMeshTest, ATriangleNeedsOnlyPositions)
{
    World world = load(triangle_doc());
    ASSERT_EQ(world.vertices.size(), 3u);
    EXPECT_EQ(world.vertices[1].position, glm::vec3(2, 0, 0));
    for (const Vertex& v : world.vertices) {
        EXPECT_EQ(v.normal, glm::vec3(0, 0, 1));
        EXPECT_EQ(v.uv, glm::vec2(0));
        EXPECT_EQ(v.colour, 0xffffffffu);
    }
    EXPECT_EQ(world.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    ASSERT_EQ(world.primitives.size(), 1u);
    EXPECT_EQ(world.primitives[0].index_count, 3u);
    EXPECT_EQ(world.primitives[0].material, 0);
    EXPECT_EQ(world.primitives[0].centre, glm::dvec3(1, 0.5, 0));
    EXPECT_DOUBLE_EQ(world.primitives[0].radius, std::sqrt(1.25));
    ASSERT_EQ(world.materials.size(), 1u);
    EXPECT_EQ(world.materials[0].base_colour, glm::vec4(1));
    ASSERT_EQ(world.instances.size(), 1u);
    EXPECT_EQ(world.instances[0].frame_from_local, glm::dmat4(1));
    EXPECT_TRUE(world.textures.empty());
    EXPECT_TRUE(world.notes.empty());
}

TEST_F(WorldMeshTest, GlbAndGltfGiveTheSameWorld)
{
    Doc doc = triangle_doc();
    World world = load_world(write("world.glb", glb_bytes(doc.json.dump(), doc.bin)));
    EXPECT_EQ(corners(world), corners(load(doc)));
}

TEST_F(WorldMeshTest, ListsStripsAndFansBecomeTriangles)
{
    const glm::vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(1, 1, 0), e(0, 2, 0);
    const std::vector<float> strip = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};
    auto build = [&](int mode, std::vector<std::uint8_t> indices) {
        Doc doc;
        Json primitive = {{"mode", mode}, {"attributes", {{"POSITION", doc.accessor(strip, "VEC3")}}}};
        if (!indices.empty())
            primitive["indices"] = doc.accessor(indices, "SCALAR");
        doc.show(primitive);
        return corners(load(doc));
    };
    using Corners = std::vector<glm::vec3>;
    EXPECT_EQ(build(5, {}), (Corners{a, b, c, b, d, c, c, d, e}));
    EXPECT_EQ(build(5, {1, 3, 2, 4}), (Corners{b, d, c, d, e, c}));
    EXPECT_EQ(build(6, {}), (Corners{b, c, a, c, d, a, d, e, a}));
    EXPECT_EQ(build(6, {0, 1, 3, 2}), (Corners{b, d, a, d, c, a}));
    EXPECT_EQ(build(4, {0, 1, 2, 1, 3, 2}), (Corners{a, b, c, b, d, c}));
    // A corner named twice reverses a strip; the degenerate triangles are left out.
    EXPECT_EQ(build(5, {0, 1, 2, 2, 4}), (Corners{a, b, c}));
}

template <typename T> World indexed(const GltfTest&, const std::function<World(const Doc&)>& load, std::vector<T> indices)
{
    Doc doc = triangle_doc();
    doc.json["meshes"][0]["primitives"][0]["indices"] = doc.accessor(indices, "SCALAR");
    return load(doc);
}

TEST_F(WorldMeshTest, IndicesMayHaveAnyType)
{
    auto load_doc = [&](const Doc& doc) { return load(doc); };
    const std::vector<glm::vec3> turned = {{0, 1, 0}, {0, 0, 0}, {2, 0, 0}};
    EXPECT_EQ(corners(indexed<std::uint8_t>(*this, load_doc, {2, 0, 1})), turned);
    EXPECT_EQ(corners(indexed<std::uint16_t>(*this, load_doc, {2, 0, 1})), turned);
    EXPECT_EQ(corners(indexed<std::uint32_t>(*this, load_doc, {2, 0, 1})), turned);
}

TEST_F(WorldMeshTest, PointsAndLinesStayWhatTheyAre)
{
    // By glTF 2.0, section 3.7.2.1: points, pairs of ends, a loop that closes, and a strip.
    const std::vector<std::vector<int>> right = {{0, 1, 2, 3}, {0, 1, 2, 3}, {0, 1, 1, 2, 2, 3, 3, 0}, {0, 1, 1, 2, 2, 3}};
    const glm::vec3 places[] = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 3}};
    for (const bool indexed : {false, true})
        for (std::size_t mode = 0; mode < right.size(); ++mode) {
            Doc doc;
            Json primitive = {{"mode", mode},
                {"attributes",
                    {{"POSITION", doc.accessor<float>({0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 3}, "VEC3")},
                        {"COLOR_0", doc.accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, "VEC3")}}}};
            if (indexed)
                primitive["indices"] = doc.accessor<std::uint8_t>({0, 1, 2, 3}, "SCALAR");
            doc.show(primitive);
            doc.json["nodes"][0]["scale"] = {-1, 1, 1}; // a mirrored one has no back either
            const World world = load(doc);
            EXPECT_EQ(world.notes, std::vector<std::string>{}) << mode;
            ASSERT_EQ(world.primitives.size(), 1u);
            EXPECT_EQ(world.primitives[0].topology, mode == 0 ? Topology::points : Topology::lines);
            const std::vector<glm::vec3> at = corners(world);
            ASSERT_EQ(at.size(), right[mode].size()) << mode;
            for (std::size_t i = 0; i < at.size(); ++i)
                EXPECT_EQ(at[i], places[right[mode][i]]) << mode << ' ' << i;
            EXPECT_EQ(world.vertices.size(), 4u) << "ends are shared";
            EXPECT_EQ(world.vertices[2].colour, 0xffff0000u);
            EXPECT_EQ(world.primitives[0].high, glm::dvec3(2, 1, 3));
            EXPECT_TRUE(world.materials[std::size_t(world.primitives[0].material)].unlit) << "they have no normals";
        }
}

TEST_F(WorldMeshTest, PointsWithNormalsAreLitAndWrongCountsAreNamed)
{
    Doc doc = triangle_doc();
    const int material = doc.put("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 1, 1}}}}});
    Json attributes = {{"POSITION", 0}, {"NORMAL", doc.accessor<float>({0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3")}};
    doc.show({{"mode", 0}, {"attributes", attributes}, {"material", material}});
    doc.show({{"mode", 2}, {"attributes", {{"POSITION", 0}}}, {"material", material}});
    const World world = load(doc);
    ASSERT_EQ(world.primitives.size(), 3u);
    const auto look = [&](std::size_t i) { return world.materials[std::size_t(world.primitives[i].material)]; };
    EXPECT_FALSE(look(1).unlit);
    EXPECT_TRUE(look(2).unlit);
    EXPECT_EQ(look(1).base_colour, glm::vec4(0.5, 0.25, 1, 1));
    EXPECT_EQ(look(2).base_colour, glm::vec4(0.5, 0.25, 1, 1));
    doc.json["meshes"].back()["primitives"][0]["mode"] = 1;
    EXPECT_NE(complaint(doc).find("has 3 ends; lines take an even number"), std::string::npos) << complaint(doc);
}

TEST_F(WorldMeshTest, OnlyUsedVerticesAreKept)
{
    Doc doc = triangle_doc();
    std::vector<float> positions(300, 7);
    for (int i = 0; i < 9; ++i)
        positions[std::size_t(i + 150)] = corner_positions[std::size_t(i)];
    std::vector<float> normals(300, 0);
    for (std::size_t i = 1; i < 300; i += 3)
        normals[i] = 2;
    Json& primitive = doc.json["meshes"][0]["primitives"][0];
    primitive["attributes"] = {{"POSITION", doc.accessor(positions, "VEC3")}, {"NORMAL", doc.accessor(normals, "VEC3")}};
    primitive["indices"] = doc.accessor(std::vector<std::uint8_t>{50, 51, 52, 52, 51, 50}, "SCALAR");
    World world = load(doc);
    EXPECT_EQ(world.vertices.size(), 3u);
    EXPECT_EQ(triangles(world), (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 0}));
    EXPECT_EQ(world.vertices[0].normal, glm::vec3(0, 1, 0));
}

TEST_F(WorldMeshTest, FlatNormalsSplitSharedCorners)
{
    Doc doc;
    // Two faces of a roof share their ridge.
    doc.show({{"attributes", {{"POSITION", doc.accessor<float>({0, 0, 0, 0, 0, 1, 1, 1, 0, 2, 0, 0}, "VEC3")}}},
        {"indices", doc.accessor<std::uint8_t>({0, 1, 2, 1, 3, 2}, "SCALAR")}});
    World world = load(doc);
    ASSERT_EQ(world.vertices.size(), 6u);
    glm::vec3 left = glm::normalize(glm::cross(glm::vec3(0, 0, 1), glm::vec3(1, 1, 0)));
    EXPECT_NEAR(glm::distance(world.vertices[1].normal, left), 0, 1e-6);
    EXPECT_GT(glm::distance(world.vertices[3].normal, left), 0.5);
}

/// Loads positions as small integers of type T, normalized or not.
template <typename T>
glm::vec3 quantized_corner(const std::function<World(const Doc&)>& load, std::vector<T> corner, bool normalized)
{
    Doc doc;
    std::vector<T> positions(16, 0);
    // KHR_mesh_quantization pads each element to a multiple of 4 bytes.
    std::size_t stride = (3 * sizeof(T) + 3) / 4 * 4;
    positions[0] = corner[0], positions[1] = corner[1], positions[2] = corner[2];
    positions[stride / sizeof(T)] = 1;
    positions[2 * stride / sizeof(T) + 1] = 1;
    int component = std::is_signed_v<T> ? (sizeof(T) == 1 ? 5120 : 5122) : (sizeof(T) == 1 ? 5121 : 5123);
    int accessor = doc.put("accessors",
        {{"bufferView", doc.view(bytes_of(positions), int(stride))}, {"componentType", component}, {"type", "VEC3"},
            {"count", 3}, {"normalized", normalized}});
    doc.json["extensionsUsed"] = doc.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    doc.show({{"attributes", {{"POSITION", accessor}}}});
    World world = load(doc);
    EXPECT_TRUE(world.notes.empty());
    return world.vertices.at(0).position;
}

TEST_F(WorldMeshTest, QuantizedPositionsAreScaled)
{
    auto load_doc = [&](const Doc& doc) { return load(doc); };
    EXPECT_EQ(quantized_corner<std::int8_t>(load_doc, {-128, 127, 5}, false), glm::vec3(-128, 127, 5));
    EXPECT_EQ(quantized_corner<std::int8_t>(load_doc, {-128, 127, -127}, true), glm::vec3(-1, 1, -1));
    EXPECT_EQ(quantized_corner<std::uint8_t>(load_doc, {0, 255, 51}, true), glm::vec3(0, 1, 0.2f));
    EXPECT_EQ(quantized_corner<std::uint8_t>(load_doc, {0, 255, 51}, false), glm::vec3(0, 255, 51));
    EXPECT_EQ(quantized_corner<std::int16_t>(load_doc, {-32768, 32767, 0}, true), glm::vec3(-1, 1, 0));
    EXPECT_EQ(quantized_corner<std::int16_t>(load_doc, {-32768, 32767, 9}, false), glm::vec3(-32768, 32767, 9));
    EXPECT_EQ(quantized_corner<std::uint16_t>(load_doc, {65535, 0, 13107}, true), glm::vec3(1, 0, 0.2f));
    EXPECT_EQ(quantized_corner<std::uint16_t>(load_doc, {65535, 0, 13107}, false), glm::vec3(65535, 0, 13107));
}

TEST_F(WorldMeshTest, InterleavedAttributesAreRead)
{
    Doc doc;
    std::vector<float> rows;
    for (int i = 0; i < 3; ++i)
        rows.insert(rows.end(),
            {corner_positions[std::size_t(3 * i)], corner_positions[std::size_t(3 * i + 1)], 0, 0, 3, 4, float(i), 0.5f});
    int view = doc.view(bytes_of(rows), 32);
    auto at = [&](int offset, const char* type) {
        return doc.put("accessors",
            {{"bufferView", view}, {"byteOffset", offset}, {"componentType", 5126}, {"type", type}, {"count", 3}});
    };
    doc.show({{"attributes", {{"POSITION", at(0, "VEC3")}, {"NORMAL", at(12, "VEC3")}, {"TEXCOORD_0", at(24, "VEC2")}}}});
    World world = load(doc);
    EXPECT_EQ(world.vertices[2].position, glm::vec3(0, 1, 0));
    EXPECT_EQ(world.vertices[2].normal, glm::vec3(0, 0.6f, 0.8f));
    EXPECT_EQ(world.vertices[2].uv, glm::vec2(2, 0.5f));
}

TEST_F(WorldMeshTest, SparseAccessorsReplaceElements)
{
    Doc doc = triangle_doc();
    int indices = doc.view({1});
    int values = doc.view(bytes_of(std::vector<float>{5, 6, 7}));
    doc.json["accessors"][0]["sparse"] = {
        {"count", 1}, {"indices", {{"bufferView", indices}, {"componentType", 5121}}}, {"values", {{"bufferView", values}}}};
    EXPECT_EQ(load(doc).vertices[1].position, glm::vec3(5, 6, 7));
    EXPECT_EQ(load(doc).vertices[2].position, glm::vec3(0, 1, 0));
    // Without a buffer view all other elements are zero.
    doc.json["accessors"][0].erase("bufferView");
    EXPECT_EQ(load(doc).vertices[1].position, glm::vec3(5, 6, 7));
    EXPECT_EQ(load(doc).vertices[2].position, glm::vec3(0));
}

TEST_F(WorldMeshTest, VertexColoursMayHaveAnyType)
{
    auto colours = [&](auto values, const char* type) {
        Doc doc = triangle_doc();
        doc.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = doc.accessor(values, type, true);
        return load(doc).vertices.at(1).colour;
    };
    EXPECT_EQ(colours(std::vector<float>{0, 0, 0, 1, 0.5f, 0, 0, 0, 0}, "VEC3"), 0xff0080ffu);
    EXPECT_EQ(colours(std::vector<float>{0, 0, 0, 0, 2, -1, 0.2f, 0, 0, 0, 0, 0}, "VEC4"), 0x003300ffu);
    EXPECT_EQ(colours(std::vector<std::uint8_t>{0, 0, 0, 1, 2, 3, 0, 0, 0}, "VEC3"), 0xff030201u);
    EXPECT_EQ(colours(std::vector<std::uint8_t>{0, 0, 0, 0, 1, 2, 3, 4, 0, 0, 0, 0}, "VEC4"), 0x04030201u);
    EXPECT_EQ(colours(std::vector<std::uint16_t>{0, 0, 0, 65535, 0, 257, 0, 0, 0}, "VEC3"), 0xff0100ffu);
    EXPECT_EQ(colours(std::vector<std::uint16_t>{0, 0, 0, 0, 65535, 0, 257, 514, 0, 0, 0, 0}, "VEC4"), 0x020100ffu);
}

TEST_F(WorldMeshTest, NodeTransformsMultiplyInDouble)
{
    Doc doc = triangle_doc();
    double s = std::sqrt(0.5);
    doc.json["nodes"] = {{{"translation", {1e9, 0.125, 0}}, {"children", {1, 2}}},
        {{"mesh", 0}, {"translation", {0.25, 0, 0}}, {"rotation", {0, 0, s, s}}, {"scale", {2, 3, 4}}},
        {{"mesh", 0}, {"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1}}}};
    doc.json["scenes"][0]["nodes"] = {0};
    World world = load(doc);
    ASSERT_EQ(world.instances.size(), 2u);
    EXPECT_EQ(world.primitives.size(), 1u) << "both nodes show the same mesh";
    glm::dvec4 point = world.instances[0].frame_from_local * glm::dvec4(1, 1, 1, 1);
    EXPECT_DOUBLE_EQ(point.x, 1e9 + 0.25 - 3); // exact to 1e-7; a float would be off by 30
    EXPECT_NEAR(point.y, 0.125 + 2, 1e-15);
    EXPECT_NEAR(point.z, 4, 1e-15);
    EXPECT_EQ(
        glm::dvec3(world.instances[1].frame_from_local * glm::dvec4(1, 2, 3, 1)), glm::dvec3(1e9 - 2 + 7, 1 + 8.125, 12));
}

TEST_F(WorldMeshTest, MirroredNodesKeepTheirFacing)
{
    Doc doc = triangle_doc();
    doc.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"scale", {-1, 1, 1}}}, {{"mesh", 0}, {"scale", {1, -2, 1}}},
        {{"mesh", 0}, {"scale", {-1, -1, 1}}}};
    doc.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
    World world = load(doc);
    ASSERT_EQ(world.instances.size(), 4u);
    EXPECT_EQ(world.primitives.size(), 2u) << "the original, and one reversed copy for both mirrors";
    EXPECT_EQ(world.vertices.size(), 3u);
    for (const Instance& instance : world.instances) {
        glm::dvec3 at[3];
        std::vector<std::uint32_t> corner = triangles(world, instance.primitive);
        for (int i = 0; i < 3; ++i)
            at[i] = instance.frame_from_local * glm::dvec4(world.vertices[corner[std::size_t(i)]].position, 1);
        glm::dvec3 outside = glm::transpose(glm::inverse(glm::dmat3(instance.frame_from_local)))
            * glm::dvec3(world.vertices[corner[0]].normal);
        EXPECT_GT(glm::dot(glm::cross(at[1] - at[0], at[2] - at[0]), outside), 0);
    }
}

TEST_F(WorldMeshTest, ScenesChooseWhatIsShown)
{
    Doc doc = triangle_doc();
    doc.json["nodes"] = {{{"mesh", 0}, {"translation", {1, 0, 0}}}, {{"mesh", 0}, {"translation", {2, 0, 0}}},
        {{"mesh", 0}, {"scale", {0, 0, 0}}}};
    doc.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1, 2}}}};
    doc.json["scene"] = 1;
    World world = load(doc);
    ASSERT_EQ(world.instances.size(), 1u);
    EXPECT_EQ(world.instances[0].frame_from_local[3][0], 2);
    EXPECT_EQ(world.notes, (std::vector<std::string>{"nodes scaled to nothing are not drawn"}));
    doc.json.erase("scene");
    EXPECT_EQ(load(doc).instances[0].frame_from_local[3][0], 1);
    doc.json.erase("scenes");
    EXPECT_EQ(load(doc).instances.size(), 2u);
}

TEST_F(WorldMeshTest, UnsupportedFeaturesGiveOneWarningEach)
{
    Doc doc = triangle_doc();
    doc.json["extensionsUsed"]
        = {"KHR_lights_punctual", "KHR_materials_unlit", "EXT_other", "KHR_materials_clearcoat", "KHR_lights_punctual"};
    doc.json["cameras"] = {{{"type", "perspective"}}, {{"type", "perspective"}}};
    doc.json["skins"] = {{{"joints", {0}}}};
    const int times = doc.accessor<float>({0, 1}, "SCALAR"), weights = doc.accessor<float>({0, 1}, "SCALAR");
    doc.json["animations"] = {{{"samplers", {{{"input", times}, {"output", weights}}}},
        {"channels",
            {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}},
                {{"sampler", 0}, {"target", {{"path", "pointer"}}}}}}}};
    doc.json["nodes"][0]["camera"] = 1;
    doc.json["nodes"][0]["skin"] = 0;
    doc.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
    EXPECT_EQ(load(doc).notes,
        (std::vector<std::string>{"lamps of the file (KHR_lights_punctual) shine where no scene file names its own lights",
            "extension \"EXT_other\" is not supported", "clear coats: the surface below is drawn",
            "animations of other things than nodes are not supported"}));
}

TEST_F(WorldMeshTest, BuffersMayBeFilesInsideTheFolder)
{
    Doc doc = triangle_doc();
    std::filesystem::create_directories(folder / "a b");
    write("a b/d\xc3\xa4ta.bin", doc.bin);
    doc.json["buffers"][0]["uri"] = "a%20b/d%C3%A4ta.bin";
    EXPECT_EQ(load(doc).vertices.size(), 3u);
    doc.json["buffers"][0]["uri"] = "a b/../a b/./d\xc3\xa4ta.bin";
    EXPECT_EQ(load(doc).vertices.size(), 3u) << "a path may use .. inside the folder";
    std::filesystem::create_symlink("a b/d\xc3\xa4ta.bin", folder / "link.bin");
    doc.json["buffers"][0]["uri"] = "link.bin";
    EXPECT_EQ(load(doc).vertices.size(), 3u) << "a link may point inside the folder";
}

} // namespace
} // namespace starbow::gltf_test::world_mesh_test
