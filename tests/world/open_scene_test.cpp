// A glTF file without a scene: its outline against the whole world as it is drawn, and the scene around it.
#include "config/json/error.h"
#include "config/model/file_kind.h"
#include "config/model/shipped.h"
#include "runtime/world/fastest_motion.h"
#include "runtime/world/moving.h"
#include "runtime/world/open_scene.h"
#include "runtime/world/outline.h"
#include "tests/support/gltf_fixture.h"
#include <random>

namespace starbow::gltf_test::open_scene_test {
namespace {

using OpenSceneTest = GltfTest;

/// A box of two triangles from one corner to the other.
void add_box(Doc& doc, const glm::dvec3& low, const glm::dvec3& high)
{
    const std::vector<float> corners{float(low.x), float(low.y), float(low.z), float(high.x), float(low.y), float(low.z),
        float(high.x), float(high.y), float(high.z), float(low.x), float(high.y), float(high.z)};
    const int positions = doc.accessor<float>(corners, "VEC3");
    Json& accessor = doc.json["accessors"][std::size_t(positions)];
    accessor["min"] = {low.x, low.y, low.z}, accessor["max"] = {high.x, high.y, high.z};
    const int indices = doc.accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
    doc.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
}

/// A cube of two metres on a ground of a kilometre, under a painted sky.
Doc cube_on_a_ground()
{
    Doc doc;
    add_box(doc, {-1, 0, -1}, {1, 2, 1});
    add_box(doc, {-500, -0.1, -500}, {500, -0.1, 500});
    add_box(doc, {-4000, -4000, -4000}, {4000, 4000, 4000});
    return doc;
}

glm::dvec3 seen_from(const Shot& shot, const glm::dvec3& point)
{
    return glm::inverse(shot.ship_from_cockpit) * (point - shot.position);
}

TEST_F(OpenSceneTest, TheOutlineIsThatOfTheDrawnWorld)
{
    for (const std::string& name : shipped_names("scenes")) {
        SCOPED_TRACE(name);
        const SceneFile scene = load_scene_file(shipped_file("scenes", name));
        const World world = load_world(scene.gltf);
        glm::dvec3 low(1e300), high(-1e300);
        for (const Instance& instance : world.instances) {
            const Primitive& primitive = world.primitives[instance.primitive];
            for (std::uint32_t i = 0; i < primitive.index_count; ++i) {
                const std::uint32_t vertex
                    = world.indices[primitive.first_index + i] + std::uint32_t(primitive.vertex_offset);
                const glm::dvec3 at(instance.frame_from_local * glm::dvec4(glm::dvec3(world.vertices[vertex].position), 1));
                low = glm::min(low, at), high = glm::max(high, at);
            }
        }
        AlignedBox all{glm::dvec3(1e300), glm::dvec3(-1e300)};
        for (const AlignedBox& box : read_outline(scene.gltf).things)
            all = {glm::min(all.low, box.low), glm::max(all.high, box.high)};
        // A turned box is larger than what is in it, but never smaller.
        const double size = glm::distance(low, high);
        for (int k = 0; k < 3; ++k) {
            EXPECT_LE(all.low[k], low[k] + 1e-5 * size);
            EXPECT_GE(all.high[k], high[k] - 1e-5 * size);
            EXPECT_GT(all.low[k], low[k] - 0.3 * size);
            EXPECT_LT(all.high[k], high[k] + 0.3 * size);
        }
    }
}

TEST_F(OpenSceneTest, GroundAndSkyAreNotTheMiddle)
{
    const SceneFile scene = open_scene(write("cube.gltf", cube_on_a_ground().text()));
    EXPECT_EQ(scene.name, "cube");
    EXPECT_EQ(scene.unit_m, 1);
    // The cube is 3.46 m across: light takes some ten seconds, by a round speed.
    EXPECT_EQ(scene.light_speed_m_s, 0.5);
    EXPECT_LT(glm::length(scene.start.position), 10);
    EXPECT_GT(scene.start.position.y, -0.1);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 seen = seen_from(scene.start, {corner & 1 ? 1 : -1, corner & 2 ? 2 : 0, corner & 4 ? 1 : -1});
        EXPECT_LT(std::abs(seen.y), -seen.z * std::tan(glm::radians(30.0)));
        EXPECT_LT(std::abs(seen.x), -seen.z * std::tan(glm::radians(37.5)));
    }
    ASSERT_EQ(scene.lights.size(), 1u);
    // The sun is behind whoever looks, on the left, and above.
    const glm::dvec3 sun = glm::inverse(scene.start.ship_from_cockpit) * std::get<DirectionalLight>(scene.lights[0]).towards;
    EXPECT_LT(sun.x, -0.3);
    EXPECT_GT(sun.y, 0.3);
    EXPECT_GT(sun.z, 0.3);
    ASSERT_EQ(scene.notes.size(), 1u);
    EXPECT_NE(scene.notes[0].find("a unit is taken as 1 m, and light flies 0.5 m/s"), std::string::npos) << scene.notes[0];
}

TEST_F(OpenSceneTest, AnyBoxIsInViewFromItsOverview)
{
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int i = 0; i < 1000; ++i) {
        const double scale = std::pow(10, 6 * uniform(random));
        const glm::dvec3 a(uniform(random), uniform(random), uniform(random)),
            b(uniform(random), uniform(random), uniform(random));
        const AlignedBox box{scale * glm::min(a, b), scale * glm::max(a, b)};
        const Shot shot = overview(box, -1e300, {uniform(random), 0.5 * uniform(random), 0.1 + std::abs(uniform(random))});
        double fills = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 at(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                corner & 4 ? box.high.z : box.low.z);
            const glm::dvec3 seen = seen_from(shot, at);
            ASSERT_LT(seen.z, 0);
            fills = std::max({fills, std::abs(seen.x / seen.z) / std::tan(glm::radians(30.0)),
                std::abs(seen.y / seen.z) / std::tan(glm::radians(23.0))});
        }
        EXPECT_NEAR(fills, 1, 1e-6); // and it fills the view
    }
}

TEST_F(OpenSceneTest, TheFirstCameraIsTheStart)
{
    Doc doc = cube_on_a_ground();
    doc.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    // A camera that looks along +x, below a node that is 3 m up.
    const int camera = doc.put(
        "nodes", {{"camera", 0}, {"rotation", {0, -std::sqrt(0.5), 0, std::sqrt(0.5)}}, {"translation", {-5, 0, 0}}});
    const int above = doc.put("nodes", {{"children", {camera}}, {"translation", {0, 3, 0}}});
    doc.json["scenes"][0]["nodes"].push_back(above);
    const SceneFile scene = open_scene(write("camera.gltf", doc.text()));
    EXPECT_LT(glm::distance(scene.start.position, glm::dvec3(-5, 3, 0)), 1e-9);
    EXPECT_LT(glm::distance(scene.start.ship_from_cockpit * glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0)), 1e-9);
    EXPECT_LT(glm::distance(scene.start.ship_from_cockpit * glm::dvec3(0, 1, 0), glm::dvec3(0, 1, 0)), 1e-9);
}

// Cameras of the kind that turntable previews leave: far away, or looking past the thing. The start is on their side, and
// fills the view.
TEST_F(OpenSceneTest, ACameraThatShowsTheWorldTooSmallIsNotTheStart)
{
    for (const bool past : {false, true}) {
        Doc doc;
        add_box(doc, {0, 0, 0}, {2, 1, 0.001});
        doc.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
        const double r = std::sqrt(0.5);
        Json node = {{"camera", 0}, {"translation", {1, 0.5, past ? 2.5 : 60.0}}};
        if (past)
            node["rotation"] = {0, r, 0, r}; // along -x
        doc.json["scenes"][0]["nodes"].push_back(doc.put("nodes", node));
        const SceneFile scene = open_scene(write("far.gltf", doc.text()));
        double fills = 0;
        for (const glm::dvec3& corner :
            {glm::dvec3(0, 0, 0), glm::dvec3(2, 0, 0), glm::dvec3(2, 1, 0), glm::dvec3(0, 1, 0)}) {
            const glm::dvec3 seen = seen_from(scene.start, corner);
            ASSERT_LT(seen.z, 0);
            fills = std::max({fills, std::abs(seen.x / seen.z) / std::tan(glm::radians(30.0)),
                std::abs(seen.y / seen.z) / std::tan(glm::radians(23.0))});
        }
        EXPECT_NEAR(fills, 1, 0.02) << past;
        EXPECT_GT(scene.start.position.z, 1) << "on the camera's side";
    }
}

TEST_F(OpenSceneTest, PointsAndLinesAloneStandBeforeTheDark)
{
    Doc doc;
    add_box(doc, {0, 0, 0}, {2, 1, 1});
    EXPECT_GT(open_scene(write("solid.gltf", doc.text())).sky.horizon.g, 0.1);
    doc.json["meshes"][0]["primitives"][0]["mode"] = 0;
    EXPECT_LT(open_scene(write("cloud.gltf", doc.text())).sky.horizon.g, 0.02);
}

TEST_F(OpenSceneTest, AThingWithoutAFloorStandsOnAGround)
{
    Doc doc;
    add_box(doc, {-1, 3, -1}, {1, 5, 1});
    const SceneFile scene = open_scene(write("thing.gltf", doc.text()));
    ASSERT_TRUE(scene.ground);
    EXPECT_NEAR(scene.ground->middle.y, 3, 0.02);
    EXPECT_LT(scene.ground->middle.y, 3) << "not in the plane of a floor that belongs to the thing";
    EXPECT_GT(scene.ground->half_width, 50) << "its edge is the horizon";
    // The written scene has it, too, and the world's last instance is drawn from it: level, facing up, under the thing
    // alone.
    const SceneFile again = load_scene_file(write("thing.json", scene_text(scene, folder)));
    ASSERT_TRUE(again.ground);
    EXPECT_EQ(again.ground->middle, scene.ground->middle);
    EXPECT_NEAR(again.ground->half_width, scene.ground->half_width, 1e-3) << "written with six digits";
    EXPECT_EQ(again.ground->colour, scene.ground->colour);
    const World world = load_world(again);
    ASSERT_EQ(world.instances.size(), 2u);
    const Instance& instance = world.instances.back();
    const Primitive& made = world.primitives[instance.primitive];
    EXPECT_EQ(world.nodes[std::size_t(instance.node)].name, "ground");
    double area = 0;
    for (std::uint32_t i = 0; i < made.index_count; i += 3) {
        glm::dvec3 at[3];
        for (std::uint32_t k = 0; k < 3; ++k) {
            const Vertex& vertex
                = world.vertices[world.indices[made.first_index + i + k] + std::uint32_t(made.vertex_offset)];
            EXPECT_EQ(vertex.normal, glm::vec3(0, 1, 0));
            at[k] = glm::dvec3(instance.frame_from_local * glm::dvec4(glm::dvec3(vertex.position), 1));
            EXPECT_NEAR(at[k].y, scene.ground->middle.y, 1e-9);
        }
        area += 0.5 * glm::cross(at[1] - at[0], at[2] - at[0]).y;
    }
    EXPECT_NEAR(area, 4 * scene.ground->half_width * scene.ground->half_width, 1e-3 * area) << "once, from above";
    // None where there is one, in a room, and under points alone.
    EXPECT_FALSE(open_scene(write("ground.gltf", cube_on_a_ground().text())).ground);
    Doc floor;
    add_box(floor, {-1, 0, -1}, {1, 2, 1});
    add_box(floor, {-2, 0, -2}, {2, 0, 2});
    EXPECT_FALSE(open_scene(write("floor.gltf", floor.text())).ground);
    doc.json["meshes"][0]["primitives"][0]["mode"] = 0;
    EXPECT_FALSE(open_scene(write("cloud.gltf", doc.text())).ground);
    // None that a scene could not have: far off, and too wide. What is written loads.
    for (const double away : {2e9, 0.0}) {
        const double half = away > 0 ? 1024 : 1e8;
        Doc large;
        add_box(large, {away - half, -half, -half}, {away + half, half, half});
        const SceneFile found = open_scene(write("large.gltf", large.text()));
        EXPECT_FALSE(found.ground) << away;
        EXPECT_EQ(load_scene_file(write("large.json", scene_text(found, folder))).light_speed_m_s, found.light_speed_m_s);
    }
}

TEST_F(OpenSceneTest, TheWrittenSceneIsTheSuggestedOne)
{
    const SceneFile scene = open_scene(write("cube.gltf", cube_on_a_ground().text()));
    std::filesystem::create_directories(folder / "own");
    const SceneFile again = load_scene_file(write("own/cube.json", scene_text(scene, folder / "own")));
    EXPECT_TRUE(std::filesystem::equivalent(again.gltf, scene.gltf));
    EXPECT_EQ(again.unit_m, scene.unit_m);
    EXPECT_EQ(again.light_speed_m_s, scene.light_speed_m_s);
    EXPECT_EQ(again.ambient, scene.ambient);
    EXPECT_EQ(again.sky.zenith, scene.sky.zenith);
    EXPECT_EQ(again.start.position, scene.start.position);
    EXPECT_LT(glm::distance(
                  again.start.ship_from_cockpit * glm::dvec3(1, 2, 3), scene.start.ship_from_cockpit * glm::dvec3(1, 2, 3)),
        1e-12);
    EXPECT_LT(glm::distance(std::get<DirectionalLight>(again.lights.at(0)).towards,
                  std::get<DirectionalLight>(scene.lights.at(0)).towards),
        1e-12);
    EXPECT_TRUE(load_world(again).notes.empty());
}

TEST_F(OpenSceneTest, LightIsFasterThanTheAnimations)
{
    Doc doc = triangle_doc();
    Json& positions = doc.json["accessors"][0];
    positions["min"] = {0, 0, 0}, positions["max"] = {2, 1, 0};
    const int times = doc.accessor<float>({0, 1}, "SCALAR"), places = doc.accessor<float>({0, 0, 0, 3, 0, 0}, "VEC3");
    doc.json["animations"] = {{{"samplers", {{{"input", times}, {"output", places}}}},
        {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    const SceneFile scene = open_scene(write("moving.gltf", doc.text()));
    EXPECT_EQ(scene.light_speed_m_s, 20); // 3 m/s are a fifth of 15
    EXPECT_NE(scene.notes[0].find("animations"), std::string::npos);
    EXPECT_NO_THROW(check_speeds(load_world(scene), scene));
}

TEST_F(OpenSceneTest, TheFilesOwnLampsShine)
{
    Doc doc = cube_on_a_ground();
    // Straight down, 2 lux; 8 cd from 4 m beside the middle, 0.5 lux there; and a dark one.
    doc.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}, {"intensity", 2}},
        {{"type", "spot"}, {"intensity", 8}, {"color", {1, 0, 0}}, {"spot", {{"outerConeAngle", 0.5}}}},
        {{"type", "point"}, {"intensity", 0}}};
    const auto lamp = [](int index) { return Json{{"KHR_lights_punctual", {{"light", index}}}}; };
    for (const Json& node : {Json{{"extensions", lamp(0)}, {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}}},
             Json{{"extensions", lamp(1)}, {"translation", {4, 1, 0}}}, Json{{"extensions", lamp(2)}}})
        doc.json["scenes"][0]["nodes"].push_back(doc.put("nodes", node));
    const SceneFile scene = open_scene(write("lamps.gltf", doc.text()));
    ASSERT_EQ(scene.lights.size(), 2u);
    const auto& far = std::get<DirectionalLight>(scene.lights[0]);
    const auto& near = std::get<PointLight>(scene.lights[1]);
    EXPECT_LT(glm::distance(far.towards, glm::dvec3(0, 1, 0)), 1e-9);
    EXPECT_NEAR(near.distance, 4, 1e-9);
    EXPECT_LT(glm::distance(near.position, glm::dvec3(4, 1, 0)), 1e-9);
    // Their ratio is that of 2 lux to 0.2126 * 8 / 16 lux; red keeps its hue, and its luminance is its part.
    const glm::dvec3 weights(0.2126, 0.7152, 0.0722);
    EXPECT_NEAR(glm::dot(far.radiance, weights) / glm::dot(near.radiance, weights), 2 / (0.2126 * 0.5), 1e-9);
    EXPECT_NEAR(glm::dot(far.radiance + near.radiance, weights), 1, 1e-9);
    EXPECT_EQ(near.radiance.g, 0);
    ASSERT_EQ(scene.notes.size(), 3u); // all lamps are scaled, one is dark, no scene file
    EXPECT_TRUE(scene.notes[0].find(" 2.11 lux ") != std::string::npos) << scene.notes[0];
    ASSERT_TRUE(near.cone);
    EXPECT_LT(glm::distance(near.cone->axis, glm::dvec3(0, 0, -1)), 1e-12);
    EXPECT_EQ(near.cone->inner_rad, 0);
    EXPECT_EQ(near.cone->outer_rad, 0.5);
    const SceneFile again = load_scene_file(write("lamps.json", scene_text(scene, folder)));
    ASSERT_EQ(again.lights.size(), 2u);
    EXPECT_EQ(std::get<PointLight>(again.lights[1]).radiance, near.radiance);
    EXPECT_EQ(std::get<PointLight>(again.lights[1]).cone->axis, near.cone->axis);
    EXPECT_NEAR(std::get<PointLight>(again.lights[1]).cone->outer_rad, 0.5, 1e-9);
    doc.json["extensions"]["KHR_lights_punctual"]["lights"][1]["spot"] = {{"outerConeAngle", 0.5}, {"innerConeAngle", 0.5}};
    EXPECT_THROW(open_scene(write("lamps.gltf", doc.text())), InputError);
}

TEST_F(OpenSceneTest, AWorldWithoutLightIsSaidToBeBlack)
{
    write("cube.gltf", cube_on_a_ground().text());
    const auto notes
        = [&](const std::string& scene) { return load_world(load_scene_file(write("scene.json", scene))).notes; };
    const auto dark = notes(R"({ "gltf": "cube.gltf" })");
    ASSERT_EQ(dark.size(), 1u);
    EXPECT_NE(dark[0].find("every picture of it is black"), std::string::npos) << dark[0];
    for (const char* light : {R"("ambient": [0, 0.1, 0])", R"("sky": { "temperature_K": 2.725 })",
             R"("lights": [{ "type": "directional", "towards": [0, 1, 0], "radiance": [1, 1, 1] }])"})
        EXPECT_TRUE(notes(std::string(R"({ "gltf": "cube.gltf", )") + light + " }").empty()) << light;
    Doc glowing = triangle_doc();
    glowing.json["materials"] = {{{"emissiveFactor", {1, 0, 0}}}};
    glowing.json["meshes"][0]["primitives"][0]["material"] = 0;
    write("cube.gltf", glowing.text());
    EXPECT_TRUE(notes(R"({ "gltf": "cube.gltf" })").empty());
}

TEST_F(OpenSceneTest, QuantizedBoundsAreThoseOfThePositions)
{
    Doc doc;
    const int positions = doc.accessor<std::int16_t>({0, 0, 0, 0, 32767, 0, 0, 0, 0, 16384, 0, 0}, "VEC4", true);
    Json& accessor = doc.json["accessors"][std::size_t(positions)];
    accessor["type"] = "VEC3", accessor["count"] = 3;
    accessor["min"] = {0, 0, 0}, accessor["max"] = {32767, 16384, 0};
    doc.show({{"attributes", {{"POSITION", positions}}}});
    doc.json["nodes"][0]["scale"] = {10, 10, 10};
    const Outline outline = read_outline(write("small.gltf", doc.text()));
    ASSERT_EQ(outline.things.size(), 1u);
    EXPECT_LT(glm::distance(outline.things[0].high, glm::dvec3(10, 163840.0 / 32767, 0)), 1e-9);
}

TEST_F(OpenSceneTest, EveryShippedFileIsOfItsKind)
{
    const std::vector<std::pair<std::string, FileKind>> kinds{{"scenes", FileKind::scene}, {"layouts", FileKind::layout},
        {"tours", FileKind::tour}, {"shots", FileKind::shot}, {"exhibits", FileKind::exhibit}, {"words", FileKind::words},
        {"programmes", FileKind::programme}};
    for (const auto& [kind, right] : kinds)
        for (const std::string& name : shipped_names(kind)) {
            const std::filesystem::path file = shipped_file(kind, name);
            EXPECT_EQ(kind_of_file(file), right) << file;
            EXPECT_NO_THROW(shipped_file(kind, file.string())) << file;
        }
    const std::filesystem::path dome = shipped_file("layouts", "dome");
    try {
        shipped_file("scenes", dome.string());
        ADD_FAILURE() << "a layout is taken for a scene";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("is a layout; a scene is right here, and starbow run --layout "),
            std::string::npos)
            << error.what();
    }
    // A GLB is known by its first bytes, whatever its name; JSON by its members.
    const Doc doc = triangle_doc();
    EXPECT_EQ(kind_of_file(write("x.bin", glb_bytes(doc.json.dump(), doc.bin))), FileKind::gltf);
    EXPECT_EQ(kind_of_file(write("x.json", doc.text())), FileKind::gltf);
    EXPECT_EQ(kind_of_file(write("broken.gltf", std::string("{"))), FileKind::gltf);
    EXPECT_EQ(kind_of_file(write("broken.json", std::string("{"))), std::nullopt);
    EXPECT_EQ(kind_of_file(folder), std::nullopt);
}

} // namespace
} // namespace starbow::gltf_test::open_scene_test
