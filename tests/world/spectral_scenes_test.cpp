// Three worlds that show spectra: their programs write the committed files, they load, and their geometry fits their shots.
#include "config/model/scene_file.h"
#include "config/model/shot.h"
#include "runtime/world/spectra.h"
#include "runtime/world/worldline.h"
#include "tests/support/files.h"
#include <map>
#include <set>

namespace spectral_scenes_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

const World& world_of(std::string_view name)
{
    static std::map<std::string, World> loaded;
    const auto [at, made] = loaded.try_emplace(std::string(name));
    if (made)
        at->second = load_world(source_dir() / "scenes" / name / (at->first + ".glb"));
    return at->second;
}

const Material& material(const World& world, std::string_view name)
{
    for (const Material& m : world.materials)
        if (m.name == name)
            return m;
    throw std::runtime_error("no material " + std::string(name));
}

struct Box {
    glm::dvec3 low{INFINITY}, high{-INFINITY};
};

/// The bounding box of everything made of a material, in the world.
Box box_of(const World& world, const std::string& name)
{
    Box box;
    for (const Instance& instance : world.instances) {
        const Primitive& p = world.primitives[instance.primitive];
        if (world.materials[std::size_t(p.material)].name != name)
            continue;
        for (std::uint32_t i = 0; i < p.index_count; ++i) {
            const Vertex& v = world.vertices[world.indices[p.first_index + i] + std::uint32_t(p.vertex_offset)];
            const glm::dvec3 at(instance.frame_from_local * glm::dvec4(v.position, 1));
            box.low = glm::min(box.low, at);
            box.high = glm::max(box.high, at);
        }
    }
    return box;
}

/// D in a direction `deg` from the motion, as the ship sees it.
double seen_D(double beta, double deg) { return std::sqrt(1 - beta * beta) / (1 - beta * std::cos(glm::radians(deg))); }

} // namespace

TEST(SpectralScenesTest, ProgramsWriteTheCommittedBytes)
{
    for (const std::string name : {"rainbow", "warm-wall", "chart"})
        expect_made_by_its_program(name, 200'000);
}

TEST(SpectralScenesTest, ShotsNameScenesWhoseWorldsLoadWithoutAWarning)
{
    for (const std::string shot : {"rainbow-line", "warm-wall-1.5", "warm-wall-4", "chart-rest", "chart-0.5"}) {
        const Shot seen = load_shot(source_dir() / "config/shots" / (shot + ".json"));
        const SceneFile scene = load_scene_file(source_dir() / "config/scenes" / (seen.scene + ".json"));
        const World& world = world_of(seen.scene);
        EXPECT_TRUE(std::filesystem::equivalent(scene.gltf, source_dir() / "scenes" / seen.scene / (seen.scene + ".glb")));
        EXPECT_EQ(world.notes, std::vector<std::string>{});
        // At most four emission basis spectra can be drawn besides sunlight.
        std::set<double> kelvins, lines;
        if (scene.sky.temperature_K > 0)
            kelvins.insert(scene.sky.temperature_K);
        for (const Material& m : world.materials) {
            if (m.temperature_K > 0)
                kelvins.insert(m.temperature_K);
            if (m.emission && std::holds_alternative<BlackBody>(*m.emission))
                kelvins.insert(std::get<BlackBody>(*m.emission).kelvin);
            if (m.emission && std::holds_alternative<SpectralLine>(*m.emission))
                lines.insert(std::get<SpectralLine>(*m.emission).nm);
        }
        EXPECT_GE(kelvins.size() + lines.size(), 1u) << shot;
        EXPECT_LE(kelvins.size() + lines.size(), 4u) << shot;
    }
}

TEST(SpectralScenesTest, TheLampLiesAcrossTheRainbowsView)
{
    const Material& lamp = material(world_of("rainbow"), "450 nm");
    ASSERT_TRUE(lamp.emission);
    EXPECT_EQ(std::get<SpectralLine>(*lamp.emission).nm, 450);
    const Shot shot = load_shot(source_dir() / "config/shots/rainbow-line.json");
    const Box box = box_of(world_of("rainbow"), "450 nm");
    const double away = shot.position.z - (box.low.z + box.high.z) / 2;
    EXPECT_NEAR(away, 3, 1e-6);
    EXPECT_NEAR((box.low.y + box.high.y) / 2, shot.position.y, 1e-6);
    EXPECT_LT(box.low.x, shot.position.x - 16);
    EXPECT_GT(box.high.x, shot.position.x + 16);

    const double beta = glm::length(shot.u) / std::sqrt(1 + glm::dot(shot.u, shot.u));
    EXPECT_NEAR(beta, 0.5, 1e-12);
    EXPECT_LT(shot.u.x, 0);
    const glm::dvec3 look = shot.ship_from_cockpit * glm::dvec3(0, 0, -1);
    const double middle_deg = glm::degrees(std::acos(glm::dot(look, glm::dvec3(-1, 0, 0))));
    // The desk's height of 60 degrees at 4:3.
    const double half_deg = glm::degrees(std::atan(std::tan(glm::radians(30.0)) * 4 / 3));
    EXPECT_GT(seen_D(beta, middle_deg - half_deg), 1) << "the lamp's own colour must be within the view";
    EXPECT_GT(450 / seen_D(beta, middle_deg - half_deg), 400) << "the spectrum must be visible up to the view's edge";
    EXPECT_GT(450 / seen_D(beta, middle_deg + half_deg), 700) << "the other edge must be deep red";
    // The wavelengths in the paper.
    EXPECT_NEAR(450 / seen_D(beta, 90), 520, 0.5);
    EXPECT_NEAR(450 / seen_D(beta, 105.5), 589, 0.5);
    EXPECT_NEAR(450 / seen_D(beta, 120), 650, 0.5);
}

TEST(SpectralScenesTest, TheCourtIsDarkAndTheSkyBehindTheMicrowavesOpen)
{
    const SceneFile scene = load_scene_file(source_dir() / "config/scenes/warm-wall.json");
    EXPECT_TRUE(scene.lights.empty() && !scene.stars);
    EXPECT_EQ(scene.ambient + scene.sky.zenith + scene.sky.horizon + scene.sky.nadir, glm::dvec3(0));
    EXPECT_EQ(scene.sky.temperature_K, 2.725);
    const World& world = world_of("warm-wall");
    double low = 1, high = 0;
    for (const Material& m : world.materials) {
        EXPECT_GT(m.temperature_K, 270) << m.name;
        EXPECT_LT(m.temperature_K, 310) << m.name;
        EXPECT_EQ(m.emissive, glm::vec3(0)) << m.name;
        EXPECT_LE(double(m.base_colour.r) + m.emissivity, 1)
            << m.name << ": reflectance and emissivity add up to more than 1";
        if (m.temperature_K == 288) {
            low = std::min(low, m.emissivity);
            high = std::max(high, m.emissivity);
        }
    }
    EXPECT_GT(high / low, 5) << "the wall needs a visible pattern";
}

TEST(SpectralScenesTest, TheChartsFieldsHaveReflectancesFrom300To1000Nm)
{
    const World& world = world_of("chart");
    int fields = 0;
    for (const Material& m : world.materials)
        if (!m.reflectance.empty()) {
            ++fields;
            EXPECT_EQ(m.reflectance.size(), 71u) << m.name;
            EXPECT_EQ(m.reflectance.front().first, 300);
            EXPECT_EQ(m.reflectance.back().first, 1000);
            EXPECT_EQ(m.base_colour, glm::vec4(1)) << m.name << ": it would scale the table";
        }
    EXPECT_EQ(fields, 24);
    const auto at
        = [&](const char* name, int nm) { return material(world, name).reflectance.at(std::size_t(nm - 300) / 10).second; };
    EXPECT_EQ(at("white", 300), 0.9);
    EXPECT_EQ(at("neutral 5", 1000), 0.19);
    // Calculated by hand, where a step is halfway and the other terms are saturated or zero.
    EXPECT_NEAR(at("dark skin", 600), 0.06 + 0.14 / 2, 2e-3);
    EXPECT_NEAR(at("yellow", 620), 0.055 + 0.7, 5e-3);
    EXPECT_NEAR(at("red", 500), 0.045, 1e-3);
    EXPECT_GT(at("foliage", 800), 1.5 * at("foliage", 550)) << "leaves are bright in the infrared";
    for (const auto& [name, kelvin] : {std::pair{"2000 K", 2000.0}, {"2856 K", 2856.0}, {"10000 K", 10000.0}})
        EXPECT_EQ(std::get<BlackBody>(material(world, name).emission.value()).kelvin, kelvin);
}

TEST(SpectralScenesTest, TablesUnderALineAloneHaveABasis)
{
    // No base colour, no sunlight, and a lamp whose light is one emission: no spectrum is reflected.
    World world;
    world.materials = {Material{.name = "leaf", .reflectance = {{400, 0.1}, {600, 0.5}}}};
    world.primitives = {Primitive{}};
    world.instances = {Instance{glm::dmat4(1), 0}};
    SceneFile scene;
    scene.lights = {PointLight{{0, 0, 0}, 1, glm::dvec3(1), SpectralLine{500}}};
    place_bodies(world, scene);
    const NeededLevel needed = needed_level(world, scene);
    const Spectra spectra = spectra_of(world, scene, needed.level);
    ASSERT_GE(spectra.basis.reflected, 1);
    ASSERT_EQ(spectra.basis.own.size(), 1u);
    // The table's column under the lamp is the line alone, times the reflectance there: 0.1 + 0.4 ln(5/4) / ln(3/2).
    const int k = spectra.basis.reflected, set = 1, kind = spectra.lamps[0][0].kind;
    glm::dvec3 found(0);
    for (int group = 0; group < spectra.groups; ++group)
        for (int c = 0; c < 3; ++c)
            for (int part = 0; part < 4; ++part) {
                const double value
                    = spectra.columns[std::size_t(((set * spectra.kinds + kind) * spectra.groups + group) * 5 + c)][part];
                if (4 * group + part == k)
                    found[c] = value;
                else
                    EXPECT_EQ(value, 0);
            }
    EXPECT_NEAR(found.x + found.y + found.z, 0.1 + 0.4 * std::log(1.25) / std::log(1.5), 1e-6);
}

} // namespace spectral_scenes_test
