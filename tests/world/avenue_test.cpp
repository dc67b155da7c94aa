#include "config/json/error.h"
#include "runtime/world/world.h"
#include "tests/support/files.h"
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <unistd.h>

namespace starbow::avenue_test {
namespace {

const std::filesystem::path avenue = starbow::testing::source_dir() / "scenes/avenue";

const World& world()
{
    static const World loaded = load_world(avenue / "avenue.glb");
    return loaded;
}

struct Shown {
    glm::dvec3 position; ///< of the instance's origin
    glm::dvec3 low{INFINITY}, high{-INFINITY};
    const Material* material;
    std::vector<glm::dvec3> points;
};

/// All instances with the material of this name, in the world's frame.
std::vector<Shown> shown(const std::string& material)
{
    std::vector<Shown> out;
    for (const Instance& instance : world().instances) {
        const Primitive& p = world().primitives[instance.primitive];
        if (world().materials[std::size_t(p.material)].name != material)
            continue;
        Shown one{.position = instance.frame_from_local[3], .material = &world().materials[std::size_t(p.material)]};
        for (std::uint32_t i = 0; i < p.index_count; ++i) {
            const Vertex& v = world().vertices[world().indices[p.first_index + i] + std::uint32_t(p.vertex_offset)];
            one.points.emplace_back(instance.frame_from_local * glm::dvec4(v.position, 1));
            one.low = glm::min(one.low, one.points.back());
            one.high = glm::max(one.high, one.points.back());
        }
        out.push_back(std::move(one));
    }
    return out;
}

double diameter(const Shown& ball)
{
    double radius = 0;
    for (const glm::dvec3& point : ball.points)
        radius = std::max(radius, glm::distance(point, ball.position));
    return 2 * radius;
}

/// Angle between two directions from the start, in degrees.
double apart_deg(const glm::dvec3& a, const glm::dvec3& b)
{
    return glm::degrees(std::acos(glm::dot(glm::normalize(a), glm::normalize(b))));
}

/// True if the line from the start to a place passes through the object.
bool stands_before(const Shown& thing, const glm::dvec3& place)
{
    for (std::size_t i = 0; i < thing.points.size(); i += 3) {
        const glm::dvec3 &a = thing.points[i], &b = thing.points[i + 1], &c = thing.points[i + 2];
        double ab = glm::dot(place, glm::cross(a, b)), bc = glm::dot(place, glm::cross(b, c)),
               ca = glm::dot(place, glm::cross(c, a));
        if (((ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0)) && glm::dot(place, a + b + c) > 0)
            return true;
    }
    return false;
}

std::string content(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(AvenueTest, GeneratorWritesTheCommittedBytes)
{
    std::filesystem::path made
        = std::filesystem::path(::testing::TempDir()) / ("avenue" + std::to_string(::getpid()) + ".glb");
    ASSERT_NO_FATAL_FAILURE(starbow::testing::run_generator(avenue, made));
    EXPECT_TRUE(content(made) == content(avenue / "avenue.glb")) << "run scenes/avenue/make.py and commit what it writes";
    std::filesystem::remove(made);
    EXPECT_LT(std::filesystem::file_size(avenue / "avenue.glb"), 3.5 * 1024 * 1024);
}

TEST(AvenueTest, LoadsWithoutAWarning)
{
    EXPECT_EQ(world().notes, std::vector<std::string>{});
    EXPECT_LT(world().indices.size() / 3, 65000u);
    EXPECT_EQ(world().textures.size(), 4u);
}

TEST(AvenueTest, ColumnsStandAtTheirPlaces)
{
    std::multiset<std::pair<double, double>> expected = {{0, -46}}, found;
    for (int k = 0; k < 20; ++k)
        for (double x : {-0.8, 0.8})
            expected.insert({x, -3 - 2 * k});
    for (int z = 1; z <= 11; z += 2)
        for (double x : {-0.8, 0.8})
            expected.insert({x, z});
    for (const Shown& column : shown("limestone")) {
        found.insert({column.position.x, column.position.z});
        EXPECT_NEAR(column.low.y, -1.5, 1e-6);
        EXPECT_NEAR(column.high.y, 1.5, 1e-6);
        EXPECT_LT(column.high.x - column.low.x, 0.5);
    }
    EXPECT_EQ(found, expected);
}

TEST(AvenueTest, TheColumnsMiddleIsAboutAsThickAsPlanned)
{
    double widest = 0;
    Shown column = shown("limestone").at(0);
    for (const glm::dvec3& point : column.points)
        if (std::abs(point.y) < 0.2)
            widest = std::max(widest, std::hypot(point.x - column.position.x, point.z - column.position.z));
    EXPECT_NEAR(widest, 0.145, 0.005);
}

TEST(AvenueTest, HoopsAndCubesHaveTheirPlacesAndSizes)
{
    const std::map<std::string, double> hoops
        = {{"red", 4}, {"yellow", 7}, {"green", 10}, {"cyan", -15}, {"violet", -27}, {"orange", -39}};
    for (auto [colour, z] : hoops) {
        std::vector<Shown> hoop = shown(colour + " hoop");
        ASSERT_EQ(hoop.size(), 1u) << colour;
        EXPECT_EQ(hoop[0].position, glm::dvec3(0, 0, z));
        EXPECT_NEAR(hoop[0].high.x, 1.66, 1e-4);
        EXPECT_NEAR(hoop[0].high.z - hoop[0].low.z, 0.12, 1e-4);
    }
    std::size_t cubes = 0, behind = 0;
    for (const char* colour : {"red", "gold", "green", "blue", "white", "magenta"})
        for (const Shown& cube : shown(std::string(colour) + " cube")) {
            ++cubes;
            behind += cube.position.z > 0;
            double x = std::abs(cube.position.x);
            EXPECT_TRUE(std::abs(x - 2.4) < 1e-9 || std::abs(x - 3.4) < 1e-9) << x;
            EXPECT_NEAR(diameter(cube), 0.6 * std::sqrt(3), 1e-5);
            EXPECT_LE(cube.position.z, 12);
            EXPECT_GE(cube.position.z, -40);
        }
    EXPECT_EQ(cubes, 42u);
    EXPECT_EQ(behind, 10u);
}

TEST(AvenueTest, EarthAndSunHaveTheirSizes)
{
    Shown earth = shown("Earth").at(0), sun = shown("Sun").at(0);
    // Mean diameters 12 742 km and 1 392 000 km (IAU 2015 nominal: 1 391 400), the astronomical unit 149 597 870.7 km.
    const double light_second_km = 299792.458;
    EXPECT_NEAR(diameter(earth), 0.0425, 0.0001);
    EXPECT_NEAR(diameter(earth), 12742 / light_second_km, 1e-4);
    EXPECT_NEAR(diameter(sun), 4.64, 0.001);
    EXPECT_NEAR(diameter(sun), 1391400 / light_second_km, 0.005);
    EXPECT_NEAR(glm::length(sun.position), 149597870.7 / light_second_km, 0.01);
    EXPECT_EQ(earth.position, glm::dvec3(0.16, 0.10, -0.55));
    EXPECT_NEAR(glm::distance(glm::dvec3(sun.material->emissive), glm::dvec3(60, 56, 48)), 0, 1e-4);
    EXPECT_EQ(sun.material->base_colour, glm::vec4(0, 0, 0, 1));
}

TEST(AvenueTest, TheSunIsSeenBesideTheEarthFromTheStart)
{
    glm::dvec3 earth = shown("Earth").at(0).position, sun = shown("Sun").at(0).position;
    EXPECT_GT(apart_deg(earth, sun), 3);
    EXPECT_LT(apart_deg(earth, sun), 8);
    EXPECT_GT(sun.x / -sun.z, earth.x / -earth.z) << "the Sun must be to the right of the Earth";
    EXPECT_GT(sun.y / -sun.z, earth.y / -earth.z) << "the Sun must be above the Earth";
    for (const Material& material : world().materials) {
        if (material.name == "Sun")
            continue;
        for (const Shown& thing : shown(material.name))
            for (double right : {-0.3, 0.0, 0.3})
                for (double up : {-0.3, 0.0, 0.3}) {
                    glm::dvec3 rim = sun + glm::length(sun) * glm::radians(1.0) * glm::dvec3(right, up, 0);
                    EXPECT_FALSE(stands_before(thing, rim)) << material.name;
                }
    }
}

TEST(AvenueTest, TheSceneFileNamesThisWorldAndItsSun)
{
    std::filesystem::path file = avenue.parent_path().parent_path() / "config/scenes/avenue.json";
    nlohmann::json scene = nlohmann::json::parse(content(file), nullptr, true, true);
    EXPECT_TRUE(
        std::filesystem::equivalent(file.parent_path() / scene.at("gltf").get<std::string>(), avenue / "avenue.glb"));
    EXPECT_EQ(scene.at("unit_m"), 299792458);
    const auto& lamp = scene.at("lights").at(1);
    glm::dvec3 position(lamp.at("position").at(0), lamp.at("position").at(1), lamp.at("position").at(2));
    EXPECT_NEAR(glm::distance(position, shown("Sun").at(0).position), 0, 0.001);
    const auto& key = scene.at("lights").at(0).at("towards");
    EXPECT_NEAR(glm::length(glm::dvec3(key.at(0), key.at(1), key.at(2))), 1, 1e-6);
}

TEST(AvenueTest, TheStippledCylinderHasItsPlaceAndColour)
{
    Shown cylinder = shown("stippled blue").at(0);
    EXPECT_EQ(cylinder.position, glm::dvec3(-14, 0, 8));
    EXPECT_NEAR(cylinder.low.x, -22, 1e-5);
    EXPECT_NEAR(cylinder.high.x, -6, 1e-5);
    EXPECT_NEAR(cylinder.high.y - cylinder.low.y, 0.7, 1e-5);
    EXPECT_EQ(cylinder.material->base_colour, glm::vec4(0.02f, 0.06f, 1, 1));
    EXPECT_GE(cylinder.material->base_texture, 0);
    EXPECT_EQ(cylinder.material->emissive_texture, cylinder.material->base_texture);
}

TEST(AvenueTest, ClosedShapesFaceOutwards)
{
    for (const char* material : {"Earth", "Sun", "stippled blue", "red hoop", "gold cube", "limestone"}) {
        Shown thing = shown(material).at(0);
        // Six times the volume that the triangles enclose (Gauss).
        double volume = 0;
        for (std::size_t i = 0; i < thing.points.size(); i += 3)
            volume += glm::dot(thing.points[i] - thing.position,
                glm::cross(thing.points[i + 1] - thing.position, thing.points[i + 2] - thing.position));
        EXPECT_GT(volume, 0) << material;
    }
    for (const Primitive& p : world().primitives)
        for (std::uint32_t i = p.first_index; i < p.first_index + p.index_count; i += 3) {
            const Vertex* v[3];
            for (std::uint32_t k = 0; k < 3; ++k)
                v[k] = &world().vertices[world().indices[i + k] + std::uint32_t(p.vertex_offset)];
            glm::vec3 across = glm::cross(v[1]->position - v[0]->position, v[2]->position - v[0]->position);
            ASSERT_GT(glm::dot(across, v[0]->normal + v[1]->normal + v[2]->normal), 0)
                << world().materials[std::size_t(p.material)].name << " triangle " << i / 3;
        }
}

} // namespace
} // namespace starbow::avenue_test
