#include "runtime/world/fastest_motion.h"
#include "runtime/world/moving.h"
#include "runtime/world/open_scene.h"
#include "runtime/world/shape.h"
#include "tests/support/gltf_fixture.h"
#include <cstdlib>
#include <iostream>
#include <random>
#include <sys/resource.h>

#if defined(STARBOW_SANITIZED)
constexpr bool sanitized = true; // the sanitizer's shadow memory takes terabytes of address space
#else
constexpr bool sanitized = false;
#endif

namespace starbow::gltf_test::world_fuzz_test {
namespace {

using WorldFuzzTest = GltfTest;

/// A document with everything that the loader reads.
Doc rich()
{
    Doc doc = triangle_doc();
    Json& first = doc.json["meshes"][0]["primitives"][0];
    doc.json["accessors"][0]["min"] = {0, 0, 0}, doc.json["accessors"][0]["max"] = {2, 1, 0};
    doc.json["cameras"] = {{{"type", "perspective"}}};
    first["attributes"]["TEXCOORD_0"] = doc.accessor<std::uint16_t>({0, 0, 65535, 0, 0, 65535}, "VEC2", true);
    first["attributes"]["COLOR_0"] = doc.accessor<float>({0, 0, 0, 1, 1, 1, 1, 0, 1}, "VEC3");
    first["material"] = 0;
    first["attributes"]["TEXCOORD_1"] = doc.accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2");
    int strip = doc.accessor<std::uint16_t>({0, 1, 2, 1}, "SCALAR");
    int normals = doc.accessor<float>({0, 0, 1, 0, 1, 0, 1, 0, 0}, "VEC3");
    int indices = doc.view({1}), values = doc.view(bytes_of(std::vector<float>{5, 6, 7}));
    int sparse = doc.put("accessors",
        {{"bufferView", 0}, {"componentType", 5126}, {"type", "VEC3"}, {"count", 3},
            {"sparse",
                {{"count", 1}, {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                    {"values", {{"bufferView", values}}}}}});
    doc.show(
        {{"mode", 5}, {"indices", strip}, {"attributes", {{"POSITION", sparse}, {"NORMAL", normals}}}, {"material", 1}});
    doc.show({{"mode", 6}, {"attributes", {{"POSITION", 0}}}});
    doc.json["nodes"][1]["scale"] = {-1, 2, 1};
    doc.json["nodes"][1]["camera"] = 0;
    doc.json["nodes"].push_back({{"children", {0, 4}}, {"rotation", {0, 0.6, 0, 0.8}}, {"translation", {1, 2, 3}}});
    doc.json["nodes"].push_back({{"mesh", 1}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 5, 6, 1}}});
    doc.json["scenes"][0]["nodes"] = {3, 1, 2};
    doc.json["scene"] = 0;
    doc.json["images"] = {{{"uri", png_uri()}}, {{"bufferView", doc.view(grey_jpeg())}, {"mimeType", "image/jpeg"}}};
    doc.json["samplers"] = {{{"minFilter", 9985}, {"wrapS", 33071}}};
    doc.json["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}}};
    doc.json["materials"]
        = {{{"pbrMetallicRoughness",
                {{"baseColorTexture",
                     {{"index", 0},
                         {"extensions",
                             {{"KHR_texture_transform", {{"offset", {0, 1}}, {"scale", {2, 2}}, {"rotation", 1}}}}}}},
                    {"baseColorFactor", {1, 0.5, 0, 1}}}},
               {"alphaMode", "MASK"}, {"alphaCutoff", 0.3},
               {"extras",
                   {{"starbow",
                       {{"temperature_K", 288}, {"emissivity", 0.5}, {"infrared", 1}, {"clock", {{"zero_s", 5}}},
                           {"reflectance", {{300, 0}, {500, 1}}}}}}}},
            {{"emissiveFactor", {1, 0, 0}}, {"emissiveTexture", {{"index", 1}}},
                {"extras", {{"starbow", "{\"emission\": {\"table\": [[400, 1], [500, 2]]}}"}}},
                {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 9}}}}}}};
    // Gloss and its maps: computed tangents on the first surface, the file's on the second.
    Json& first_material = doc.json["materials"][0];
    first_material["normalTexture"] = {{"index", 1}, {"scale", 0.5}, {"texCoord", 1}};
    first_material["occlusionTexture"] = {{"index", 0}, {"strength", 0.5}};
    first_material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 1}, {"texCoord", 1}};
    first_material["pbrMetallicRoughness"]["metallicFactor"] = 0.5;
    first_material["pbrMetallicRoughness"]["roughnessFactor"] = 0.25;
    doc.json["materials"][1]["alphaMode"] = "BLEND";
    doc.json["materials"][1]["normalTexture"] = {{"index", 1}};
    doc.json["materials"][1]["extensions"]["KHR_materials_ior"] = {{"ior", 1.3}};
    doc.json["meshes"][1]["primitives"][0]["attributes"]["TANGENT"]
        = doc.accessor<float>({1, 0, 0, 1, 0, 1, 0, -1, 0, 0, 1, 1}, "VEC4");
    // Animated parts: tracks of each kind on two nodes, one below the other, a spin, and a blinking light.
    const int times = doc.accessor<float>({0, 1, 3}, "SCALAR"),
              places = doc.accessor<float>({0, 0, 0, 1, 0, 0, 0, 2, 0}, "VEC3");
    const int turns = doc.accessor<std::int16_t>({0, 0, 0, 32767, 0, 0, 23170, 23170, 0, 0, 0, 32767}, "VEC4", true);
    const int two = doc.accessor<float>({1, 2}, "SCALAR");
    const int curve = doc.accessor<float>({0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 2, 2, 2, 0, 0, 0}, "VEC3");
    doc.json["animations"]
        = {{{"samplers",
                {{{"input", times}, {"output", places}, {"interpolation", "STEP"}}, {{"input", times}, {"output", turns}},
                    {{"input", two}, {"output", curve}, {"interpolation", "CUBICSPLINE"}}}},
            {"channels",
                {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
                    {{"sampler", 1}, {"target", {{"node", 3}, {"path", "rotation"}}}},
                    {{"sampler", 2}, {"target", {{"node", 3}, {"path", "scale"}}}}}}}};
    doc.json["nodes"][4]["extras"] = {{"starbow", {{"spin", {{"axis", {0, 1, 0}}, {"turns_per_s", 0.5}}}}}};
    doc.json["materials"][1]["extras"]["starbow"]
        = "{\"emission\": {\"table\": [[400, 1], [500, 2]]}, \"blink\": {\"period_s\": 2, \"on\": 0.25}}";
    // A skin on two joints, a morph target, and a mesh in two places.
    Json& skinned = doc.json["meshes"][1]["primitives"][0];
    skinned["attributes"]["JOINTS_0"] = doc.accessor<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
    skinned["attributes"]["WEIGHTS_0"] = doc.accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0}, "VEC4");
    const int inverse = doc.accessor<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1}, "MAT4");
    doc.json["accessors"][std::size_t(inverse)]["count"] = 1;
    doc.json["skins"] = {{{"joints", {0}}, {"inverseBindMatrices", inverse}}, {{"joints", {3, 4}}}};
    doc.json["nodes"][1]["skin"] = 1;
    doc.json["meshes"][0]["primitives"][0]["targets"]
        = {{{"POSITION", doc.accessor<float>({0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3")}}};
    doc.json["meshes"][0]["weights"] = {0.5};
    doc.json["animations"][0]["samplers"].push_back(
        {{"input", times}, {"output", doc.accessor<std::uint8_t>({0, 255, 10}, "SCALAR", true)}});
    doc.json["animations"][0]["channels"].push_back({{"sampler", 3}, {"target", {{"node", 0}, {"path", "weights"}}}});
    doc.json["nodes"][2]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]
        = {{"TRANSLATION", doc.accessor<float>({0, 0, 0, 5, 0, 0}, "VEC3")},
            {"SCALE", doc.accessor<float>({1, 1, 1, 2, 2, 2}, "VEC3")}};
    doc.json["extensionsUsed"] = {"KHR_texture_transform", "KHR_materials_emissive_strength", "KHR_x"};
    doc.json["extensionsRequired"] = {"KHR_texture_transform"};
    return doc;
}

Json* random_value(Json& from, std::mt19937& rng)
{
    std::vector<Json*> all = {&from};
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i]->is_structured())
            for (Json& child : *all[i])
                all.push_back(&child);
    return all[rng() % all.size()];
}

void swap_json(Json& json, std::mt19937& rng)
{
    static const Json odd
        = Json::parse(R"([-1, 0, 1, 2, 3, 255, 65536, 300000, 2147483648, 4294967295, 4294967296, 9007199254740993,
            18446744073709551615, -9223372036854775808, 1e300, -1e-300, 0.5, 5120, 5121, 5122, 5123, 5125, 5126, 4, 5, 6, "", "VEC2",
            "VEC3", "VEC4", "SCALAR", "MAT4", "MASK", "..", "world.gltf", "a%", "data:;base64,AAAA", "data:", null, true, false, [], {},
            [0], [1, 2], [0, 0, 0], {"index": 0}, {"bufferView": 0}, {"count": 1}])");
    Json* value = random_value(json, rng);
    switch (rng() % 4) {
    case 0: {
        Json copy = *random_value(json, rng);
        *value = copy;
        break;
    }
    case 1:
        if (value->is_structured() && !value->empty()) {
            auto child = value->begin();
            std::advance(child, rng() % value->size());
            value->erase(child);
            break;
        }
        [[fallthrough]];
    default:
        *value = odd[rng() % odd.size()];
    }
}

void damage_bytes(Bytes& bytes, std::mt19937& rng)
{
    switch (rng() % 4) {
    case 0:
        bytes.resize(rng() % (bytes.size() + 1));
        break;
    case 1: {
        std::size_t from = rng() % bytes.size(), length = rng() % 16;
        bytes.erase(
            bytes.begin() + std::ptrdiff_t(from), bytes.begin() + std::ptrdiff_t(std::min(bytes.size(), from + length)));
        break;
    }
    default:
        for (std::size_t flips = 1 + rng() % 4; flips > 0; --flips)
            bytes[rng() % bytes.size()] ^= std::uint8_t(rng() % 3 ? 1u << rng() % 8 : rng());
    }
}

/// The n-th damaged world: swapped JSON values, or damaged bytes, in a .gltf or a .glb.
Bytes mutated(std::uint32_t n)
{
    static const std::vector<Doc> seeds = {rich(), triangle_doc()};
    std::mt19937 rng(n);
    Doc doc = seeds[rng() % 4 == 0];
    bool swapped = rng() % 3 != 0;
    for (std::size_t swaps = swapped ? 1 + (rng() % 3 == 0) : 0; swaps > 0; --swaps)
        swap_json(doc.json, rng);
    bool is_glb = rng() % 2, valid_json = swapped || rng() % 2;
    if (is_glb && valid_json && !swapped && !doc.bin.empty())
        damage_bytes(doc.bin, rng); // the chunks' headers stay valid
    Bytes bytes;
    if (is_glb)
        bytes = glb_bytes(doc.json.dump(), doc.bin);
    else {
        std::string text = doc.json.is_object() ? doc.text() : doc.json.dump();
        bytes.assign(text.begin(), text.end());
    }
    if (!swapped && !(is_glb && valid_json))
        damage_bytes(bytes, rng);
    return bytes;
}

struct MemoryLimit {
    rlimit before{};
    explicit MemoryLimit(rlim_t bytes)
    {
        ::getrlimit(RLIMIT_AS, &before);
        rlimit now{bytes, before.rlim_max};
        if (!sanitized)
            ::setrlimit(RLIMIT_AS, &now);
    }
    ~MemoryLimit() { ::setrlimit(RLIMIT_AS, &before); }
};

/// Each vertex of a deforming instance has bones and displacements, and stays within range.
void expect_valid_shape(const World& world, const Instance& instance)
{
    ASSERT_LT(instance.deformation, int(world.deformations.size()));
    const Deformation& deformation = world.deformations[std::size_t(instance.deformation)];
    const Primitive& primitive = world.primitives[instance.primitive];
    ASSERT_GE(primitive.deforming, 0);
    ASSERT_LT(deformation.middle, int(deformation.bones.size()));
    std::uint32_t vertices = 0;
    for (std::uint32_t i = 0; i < primitive.index_count; ++i)
        vertices = std::max(vertices, world.indices[primitive.first_index + i] + 1);
    ASSERT_LE(std::size_t(primitive.deforming) + DEFORMING_VERTEX_ROWS * vertices, std::size_t(primitive.displacements));
    ASSERT_LE(std::size_t(primitive.displacements) + DISPLACEMENT_ROWS * std::size_t(deformation.targets) * vertices,
        world.deforming.size());
    for (std::uint32_t i = 0; i < vertices; ++i) {
        const glm::vec4* bones = &world.deforming[std::size_t(primitive.deforming) + DEFORMING_VERTEX_ROWS * i + BONES_ROW];
        for (int k = 0; k < BONES_PER_VERTEX; ++k)
            ASSERT_TRUE(bones[k / 4][k % 4] >= 0 && bones[k / 4][k % 4] < float(deformation.bones.size()));
        for (double time : {-1e7, 0.0, 1.5}) {
            Shape shape(world, instance, time);
            ASSERT_TRUE(glm::length(shape.vertex(std::uint32_t(primitive.vertex_offset) + i).place) < 1e60);
        }
    }
    const SeenPose seen = seen_pose(world, instance, {});
    ASSERT_FALSE(std::isnan(seen.window));
}

void expect_valid(const World& world)
{
    ASSERT_FALSE(world.instances.empty());
    ASSERT_FALSE(world.materials.empty());
    for (const Instance& instance : world.instances)
        ASSERT_LT(instance.primitive, world.primitives.size());
    for (const Instance& instance : world.instances) {
        ASSERT_LT(instance.motion, int(world.motions.size()));
        for (int column = 0; column < 4; ++column)
            ASSERT_TRUE(glm::length(instance.frame_from_local[column]) < 1e32);
        if (instance.motion < 0)
            continue;
        if (instance.deformation >= 0)
            expect_valid_shape(world, instance);
        for (double time : {-1e7, -0.3, 0.0, 1.5, 1e7 + 0.1})
            for (int column = 0; column < 4; ++column)
                ASSERT_TRUE(glm::length(pose_at(world, instance, time)[column]) < 1e32);
    }
    for (std::size_t i = 0; i < world.joints.size(); ++i)
        ASSERT_LT(world.joints[i].above, int(i));
    for (const Primitive& p : world.primitives) {
        ASSERT_LT(std::size_t(p.material), world.materials.size());
        ASSERT_LE(std::size_t(p.first_index) + p.index_count, world.indices.size());
        ASSERT_TRUE(std::isfinite(p.radius));
        for (std::uint32_t i = p.first_index; i < p.first_index + p.index_count; ++i)
            ASSERT_LT(world.indices[i] + std::uint64_t(p.vertex_offset), world.vertices.size());
    }
    for (const Material& m : world.materials)
        ASSERT_TRUE(!m.clock || std::abs(m.clock->zero_s) <= 1e10);
    for (const Material& m : world.materials)
        for (int texture : {m.base_texture, m.emissive_texture})
            ASSERT_LT(texture, int(world.textures.size()));
    for (const Texture& t : world.textures)
        ASSERT_EQ(t.rgba.size(), std::size_t(t.size.x) * std::size_t(t.size.y) * 4);
}

/// STARBOW_FUZZ_COUNT sets the number of mutations; the first ones are always the same.
TEST_F(WorldFuzzTest, DamagedFilesLoadOrAreRefused)
{
    const char* count_text = std::getenv("STARBOW_FUZZ_COUNT");
    const auto count = std::uint32_t(count_text ? std::atol(count_text) : 1000);
    MemoryLimit limit(rlim_t(2) << 30);
    std::uint32_t loaded = 0, fast = 0, opened = 0;
    std::string file = (folder / "world.gltf").string();
    for (std::uint32_t n = 0; n < count; ++n) {
        SCOPED_TRACE("mutation " + std::to_string(n));
        write("world.gltf", mutated(n));
        try {
            const SceneFile scene = open_scene(file);
            ASSERT_LT(glm::length(scene.start.position), 1e33);
            ASSERT_NEAR(glm::length(scene.start.ship_from_cockpit), 1, 1e-9);
            ASSERT_TRUE(scene.light_speed_m_s > 0 && scene.light_speed_m_s <= 299792458);
            if (n % 16 == 0) {
                write("scene.json", scene_text(scene, folder));
                ASSERT_EQ(load_scene_file(folder / "scene.json").light_speed_m_s, scene.light_speed_m_s);
            }
            ++opened;
        } catch (const InputError& error) {
            ASSERT_TRUE(std::string(error.what()).starts_with(file + ":")) << error.what();
        } catch (const std::exception& error) {
            FAIL() << "neither opened nor refused: " << error.what();
        }
        try {
            World world = load_world(file);
            expect_valid(world);
            try {
                check_speeds(world, {});
            } catch (const InputError&) {
                ++fast;
            }
            ++loaded;
        } catch (const InputError& error) {
            std::string line = error.what();
            ASSERT_TRUE(line.starts_with(file + ": ")) << line;
            ASSERT_EQ(line.find_first_of("\n\r"), std::string::npos) << line;
        } catch (const std::exception& error) {
            FAIL() << "neither loaded nor refused: " << error.what();
        }
    }
    // Otherwise nearly all damage would fail at the loader's first check.
    EXPECT_GT(loaded, count / 20);
    EXPECT_GT(opened, count / 10);
    std::cout << loaded << " of " << count << " damaged files loaded (" << fast << " too fast), the others were refused\n";
}

} // namespace
} // namespace starbow::gltf_test::world_fuzz_test
