#include "config/model/scene_file.h"
#include "tests/support/files.h"

namespace scene_file_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

const std::string whole = R"({
    "gltf": "worlds/town.glb", // beside this file
    "unit_m": 2, "light_speed_m_s": 10,
    "sky": { "zenith": [0.1, 0.2, 0.3], "horizon": [1, 1, 1], "nadir": [0, 0, 0],
        "temperature_K": 2.725 },
    "stars": { "catalogue": "skies/few.txt", "in_depth": 70, "brightness_arcmin2": 30, "ahead_deg": [84, -19], "sun_deg": [10, -5],
        "sun_light": 0.25,
        "milky_way": { "panorama": "skies/milky.png", "peak_arcmin2": 0.5 } },
    "ambient": [0.25, 0.5, 0.75],
    "lights": [
        { "type": "directional", "towards": [0, 3, 4], "radiance": [1, 2, 3] },
        { "type": "point", "position": [1, 2, 3], "distance": 4, "radiance": [5, 6, 7], "temperature_K": 3000,
            "cone": { "axis": [0, -2, 0], "outer_deg": 30 } },
        { "type": "directional", "towards": [1, 0, 0], "radiance": [1, 1, 1], "line_nm": 589.3 },
        { "type": "point", "position": [0, 0, 0], "distance": 1, "radiance": [1, 1, 1],
          "spectrum": [[400, 0], [550.5, 1e3], [700, 0.25]] }
    ],
    "start": { "position": [0, 1.7, 0], "velocity": { "direction": [1, 0, 0], "gamma": 2 }, "exposure_ev": 1 }
})";

std::string with(const std::string& members) { return R"({ "gltf": "a.glb", )" + members + " }"; }
std::string light(const std::string& members) { return with(R"("lights": [{ )" + members + " }]"); }
std::string sun(const std::string& members)
{
    return light(R"("type": "directional", "towards": [0, 1, 0], "radiance": [1, 1, 1], )" + members);
}

} // namespace

TEST(SceneFileTest, EveryMemberIsRead)
{
    const auto file = write_text("town.json", whole);
    const SceneFile scene = load_scene_file(file);
    EXPECT_EQ(scene.name, "town");
    EXPECT_EQ(scene.gltf, file.parent_path() / "worlds/town.glb");
    EXPECT_EQ(scene.seconds_per_time_unit(), 0.2);
    EXPECT_EQ(scene.sky.zenith, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(scene.sky.horizon, glm::dvec3(1));
    EXPECT_EQ(scene.sky.temperature_K, 2.725);
    EXPECT_EQ(scene.ambient, glm::dvec3(0.25, 0.5, 0.75));
    ASSERT_TRUE(scene.stars);
    EXPECT_EQ(scene.stars->catalogue, file.parent_path() / "skies/few.txt");
    EXPECT_EQ(scene.stars->in_depth, 70u);
    EXPECT_EQ(scene.stars->brightness_arcmin2, 30);
    EXPECT_EQ(scene.stars->ahead_deg, glm::dvec2(84, -19));
    EXPECT_EQ(scene.stars->sun_deg, glm::dvec2(10, -5));
    EXPECT_EQ(scene.stars->sun_light, 0.25);
    EXPECT_EQ(scene.stars->milky_way.value().panorama, file.parent_path() / "skies/milky.png");
    EXPECT_EQ(scene.milky_way(), 15);
    ASSERT_EQ(scene.lights.size(), 4u);
    const auto sun = std::get<DirectionalLight>(scene.lights[0]);
    EXPECT_NEAR(glm::distance(sun.towards, glm::dvec3(0, 0.6, 0.8)), 0, 1e-15);
    EXPECT_EQ(sun.radiance, glm::dvec3(1, 2, 3));
    EXPECT_FALSE(sun.spectrum);
    const auto lamp = std::get<PointLight>(scene.lights[1]);
    EXPECT_EQ(lamp.position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(lamp.distance, 4);
    EXPECT_EQ(lamp.radiance, glm::dvec3(5, 6, 7));
    EXPECT_EQ(lamp.spectrum, Emission(BlackBody{3000}));
    EXPECT_EQ(lamp.cone.value().axis, glm::dvec3(0, -1, 0));
    EXPECT_EQ(lamp.cone->inner_rad, 0);
    EXPECT_NEAR(lamp.cone->outer_rad, std::acos(-1.0) / 6, 1e-15);
    EXPECT_FALSE(std::get<PointLight>(scene.lights[3]).cone);
    EXPECT_EQ(std::get<DirectionalLight>(scene.lights[2]).spectrum, Emission(SpectralLine{589.3}));
    EXPECT_EQ(
        std::get<PointLight>(scene.lights[3]).spectrum, Emission(SpectralTable{{{400, 0}, {550.5, 1e3}, {700, 0.25}}}));
    EXPECT_EQ(scene.start.scene, "town");
    EXPECT_EQ(scene.start.position, glm::dvec3(0, 1.7, 0));
    EXPECT_NEAR(scene.start.u.x, 1.7320508075688772, 1e-15);
}

TEST(SceneFileTest, ShippedScenesLoad)
{
    ASSERT_GE(shipped("config/scenes").size(), 10u);
    for (const auto& file : shipped("config/scenes")) {
        SCOPED_TRACE(file);
        EXPECT_EQ(load_scene_file(file).name, file.stem());
    }
}

TEST(SceneFileTest, WrongScenesAreRefused)
{
    std::string nine = R"("lights": [)";
    for (int i = 0; i < 9; ++i)
        nine += std::string(i ? "," : "") + R"({ "type": "directional", "towards": [0, 1, 0], "radiance": [1, 1, 1] })";
    nine += "]";
    expect_wrong(load_scene_file,
        {
            {R"({ "gltf": "" })", "/gltf", "\"\"", "is empty"},
            {R"({ "gltf": "a\u0000b" })", "/gltf", "\"a\\u0000b\"", "holds a control character"},
            {with(R"("boundary": { "centre": [0, 9, 0], "radius": 8 })"), "/boundary/radius", "8",
                "leaves the start outside, 9 from the centre"},
            {with(R"("light_speed_m_s": 1e309)"), "/light_speed_m_s", "1e309", "is too large for a number"},
            {with(R"("sky": { "nadir": [0, 0] })"), "/sky/nadir", "[0,0]", "has length 2; "},
            {with(R"("stars": { "catalogue": "a", "in_depth": 5000 })"), "/stars/in_depth", "5000",
                "leaves no place for the other stars"},
            {with(R"("stars": { "catalogue": "a", "sun_light": 1 })"), "/stars/sun_light", "1",
                "has no Sun that could shine"},
            {with(R"("stars": { "catalogue": "a", "ahead_deg": [84] })"), "/stars/ahead_deg", "[84]", "has length 1; "},
            {with(R"("ambient": 0.5)"), "/ambient", "0.5", "is not a list; a list of 3 numbers"},
            {with(nine), "/lights", R"([{"radiance":[1,1,1],"towards":[0,1,0],"type":"directional"}...)",
                "has length 9; a list of 0 to 8 lights"},
            {light(R"("type": "spot")"), "/lights/0/type", "\"spot\"", "\"directional\" or \"point\" is right"},
            {light(R"("type": "directional", "towards": [0, 0, 0], "radiance": [1, 1, 1])"), "/lights/0/towards", "[0,0,0]",
                "points nowhere"},
            {light(
                 R"("type": "point", "position": [0, 1, 0], "distance": 1, "radiance": [1, 1, 1], "cone": { "axis": [0, 0, 0], "outer_deg": 30 })"),
                "/lights/0/cone/axis", "[0,0,0]", "points nowhere; a direction of any length above 0 is right"},
            {light(
                 R"("type": "point", "position": [0, 1, 0], "distance": 1, "radiance": [1, 1, 1], "cone": { "axis": [0, 1, 0], "inner_deg": 30, "outer_deg": 30 })"),
                "/lights/0/cone", R"({"axis":[0,1,0],"inner_deg":30,"outer_deg":30})",
                "ends inside \"inner_deg\"; a larger \"outer_deg\" is right"},
            {with(R"("sky": { "temperature_K": 0.05 })"), "/sky/temperature_K", "0.05",
                "is too small; 0 for none, or a number from 0.1 to 1000000"},
            {light(
                 R"("line_nm": 500, "temperature_K": 3000, "type": "directional", "towards": [0, 1, 0], "radiance": [1, 1, 1])"),
                "/lights/0", R"({"line_nm":500,)", "has more than one spectrum; at most one of \"temperature_K\""},
            {sun(R"("spectrum": 589)"), "/lights/0/spectrum", "589", "is not a list; a list of 2 to 4096 pairs"},
            {sun(R"("spectrum": [[500, 1]])"), "/lights/0/spectrum", "[[500,1]]", "has length 1; "},
            {sun(R"("spectrum": [[500, 1], 600])"), "/lights/0/spectrum/1", "600", "is not a list; a list of 2 numbers"},
            {sun(R"("spectrum": [[500, 1], [600]])"), "/lights/0/spectrum/1", "[600]", "has length 1; "},
            {sun(R"("spectrum": [[500, 1], [500, 2]])"), "/lights/0/spectrum/1/0", "500",
                "does not rise; a wavelength above the one before, 500,"},
            {sun(R"("spectrum": [[600, 1], [500, 2]])"), "/lights/0/spectrum/1/0", "500", "does not rise"},
            {sun(R"("spectrum": [[500, 0], [600, 0]])"), "/lights/0/spectrum", "[[500,0],[600,0]]", "is dark everywhere"},
            {with(R"("start": { "velocity": { "direction": [1, 0, 0], "beta": 1 } })"), "/start/velocity/beta", "1",
                "nothing reaches the speed of light"},
            {with(R"("start": { "look": [0, 1, 0] })"), "/start/look", "[0,1,0]", "is parallel to \"up\""},
        });
}

TEST(SceneFileTest, MutatedScenesLoadOrAreRefused) { expect_survives(load_scene_file, {whole}); }

} // namespace scene_file_test
