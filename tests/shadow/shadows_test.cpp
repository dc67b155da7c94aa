// Shadows and daylight of still things, against places and parts of the sky known in closed form.
#include "runtime/shadow/add_shadows.h"
#include "runtime/shadow/fill.h"
#include "runtime/shadow/occluders.h"
#include "runtime/shadow/shadow_cache.h"
#include "runtime/shadow/still_things.h"
#include "runtime/world/shadows.h"
#include "runtime/world/worldline.h"
#include "tests/support/files.h"
#include "tests/support/gltf_fixture.h"
#include <cmath>
#include <random>
#include <tuple>

namespace starbow::gltf_test::shadows_test {
namespace {

class ShadowsTest : public GltfTest {
protected:
    /// A scene around a document, in the test's own folder.
    SceneFile scene_of(const Doc& doc, Json json) const
    {
        write("world.gltf", doc.text());
        json["gltf"] = "world.gltf";
        json["shadows"] = true;
        return load_scene_file(write("scene.json", json.dump()));
    }
};

/// Adds a rectangle with its front towards cross(right, up).
void wall(Doc& doc, const glm::dvec3& centre, const glm::dvec3& right, const glm::dvec3& up, Json material = Json::object(),
    Json node = Json::object())
{
    std::vector<float> places;
    for (const glm::dvec3& at : {centre - right - up, centre + right - up, centre + right + up, centre - right + up})
        places.insert(places.end(), {float(at.x), float(at.y), float(at.z)});
    const int uv = doc.accessor<float>({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2");
    doc.show({{"attributes", {{"POSITION", doc.accessor(places, "VEC3")}, {"TEXCOORD_0", uv}}},
        {"indices", doc.accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR")},
        {"material", doc.put("materials", std::move(material))}});
    doc.json["nodes"].back().update(node);
}

/// A ground of 20 by 20 at height 0.
void ground(Doc& doc) { wall(doc, {0, 0, 0}, {10, 0, 0}, {0, 0, -10}); }

const Json sun = {{"type", "directional"}, {"towards", {1, 1, 0}}, {"radiance", {1, 1, 1}}};

TEST_F(ShadowsTest, RaysMeetStillTrianglesAndTellTheirSides)
{
    Doc doc;
    wall(doc, {0, 0, -5}, {1, 0, 0}, {0, 1, 0}); // its front towards +z
    wall(doc, {0, 0, -9}, {1, 0, 0}, {0, 1, 0}, {{"doubleSided", true}});
    const World world = load(doc);
    const Occluders rays(world, world.instances);
    ASSERT_EQ(rays.triangles(), 4u);
    const auto front = rays.first({0.5, 0.5, 0}, {0, 0, -1}, 100);
    ASSERT_TRUE(front);
    EXPECT_NEAR(front->distance, 5, 1e-5);
    EXPECT_FALSE(front->back);
    const auto back = rays.first({0.5, 0.5, -8}, {0, 0, 1}, 100);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->distance, 3, 1e-5);
    EXPECT_TRUE(back->back);
    EXPECT_FALSE(rays.first({0.5, 0.5, -12}, {0, 0, 1}, 100)->back) << "it has two fronts";
    EXPECT_FALSE(rays.first({0.5, 0.5, 0}, {0, 0, -1}, 4.9));
    EXPECT_TRUE(rays.hidden({0.5, 0.5, 0}, {0, 0, -1}, 5.1));
    EXPECT_FALSE(rays.hidden({1.1, 0, 0}, {0, 0, -1}, 100));
}

TEST_F(ShadowsTest, MasksLetLightThrough)
{
    Doc doc;
    // Left opaque, right cut out.
    const Bytes image = png(2, 1, {255, 255, 255, 255, 255, 255, 255, 0});
    doc.put("images", {{"bufferView", doc.view(image)}, {"mimeType", "image/png"}});
    doc.json["samplers"] = {{{"magFilter", 9728}, {"minFilter", 9728}}};
    doc.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    wall(doc, {0, 0, -5}, {1, 0, 0}, {0, 1, 0},
        {{"alphaMode", "MASK"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    const World world = load(doc);
    const Occluders rays(world, world.instances);
    EXPECT_TRUE(rays.hidden({-0.5, 0, 0}, {0, 0, -1}, 100));
    EXPECT_FALSE(rays.hidden({0.5, 0, 0}, {0, 0, -1}, 100));
    EXPECT_FALSE(rays.first({0.5, 0, 0}, {0, 0, -1}, 100));
}

TEST_F(ShadowsTest, ABundleOfRaysMeetsWhatSingleRaysMeet)
{
    Doc doc;
    std::vector<std::uint8_t> texels;
    for (int i = 0; i < 8 * 8; ++i)
        texels.insert(texels.end(), {255, 255, 255, std::uint8_t(i * 5 % 3 ? 255 : 0)});
    doc.put("images", {{"bufferView", doc.view(png(8, 8, texels))}, {"mimeType", "image/png"}});
    doc.json["textures"] = {{{"source", 0}}};
    wall(doc, {0, 0, -5}, {4, 0, 0}, {0, 4, 0},
        {{"alphaMode", "MASK"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    wall(doc, {1, 1, -6}, {3, 0, 0}, {0, 3, 0}, {{"doubleSided", true}});
    wall(doc, {0, 0, 7}, {5, 0, 0}, {0, 5, 1});
    wall(doc, {-1, 2, 6}, {0, 2, 0}, {2, 0, 0});
    const World world = load(doc);
    const Occluders occluders(world, world.instances);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    int met = 0, backs = 0;
    for (int n = 0; n < 2000; ++n) {
        Occluders::Vectors from, ways;
        std::array<std::pair<glm::dvec3, glm::dvec3>, Occluders::bundle> rays;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const glm::vec3 place(any(random), any(random), any(random)),
                way = glm::normalize(glm::dvec3(any(random), any(random), any(random)));
            rays[i] = {place, way};
            from.set(i, place), ways.set(i, way);
        }
        const Occluders::Hits hits = occluders.first(from, ways);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const auto single = occluders.first(rays[i].first, rays[i].second, 1e37);
            ASSERT_EQ(std::isfinite(hits.distance[i]), single.has_value());
            if (single) {
                EXPECT_NEAR(hits.distance[i], single->distance, 1e-5 * single->distance);
                EXPECT_EQ(hits.back[i], single->back);
                ++met, backs += single->back;
            }
        }
    }
    EXPECT_GT(met - backs, 1000);
    EXPECT_GT(backs, 1000);
}

TEST_F(ShadowsTest, ThingsThatMoveOrShineHideNothing)
{
    Doc doc;
    wall(doc, {0, 0, -5}, {1, 0, 0}, {0, 1, 0}, {{"emissiveFactor", {1, 1, 1}}});
    wall(doc, {0, 0, -6}, {1, 0, 0}, {0, 1, 0}, {{"extensions", {{"KHR_materials_unlit", Json::object()}}}});
    wall(doc, {0, 0, -7}, {1, 0, 0}, {0, 1, 0}, Json::object(), {{"name", "body"}});
    wall(doc, {0, 0, -8}, {1, 0, 0}, {0, 1, 0});
    const Json body = {{"name", "body"}, {"nodes", {"body"}}, {"velocity", {{"direction", {1, 0, 0}}, {"beta", 0.5}}},
        {"at", {{"time", 0}, {"position", {0, 0, 0}}}}};
    const SceneFile scene = scene_of(doc, {{"lights", {sun}}, {"bodies", {body}}});
    World world = load_world(scene);
    std::vector<std::string> notes;
    for (int again = 0; again < 2; ++again)
        note_lacking_shadows(scene, world, notes);
    EXPECT_EQ(notes, std::vector<std::string>{"things that move cast no shadows and receive none"});
    place_bodies(world, scene);
    const Occluders rays(world, world.instances);
    EXPECT_EQ(rays.triangles(), 2u);
    EXPECT_NEAR(rays.first({0, 0, 0}, {0, 0, -1}, 100)->distance, 8, 1e-5);
}

/// The maps of a scene's lamps, without daylight, which takes longer.
Shadows maps_alone(const World& world, const SceneFile& scene)
{
    const Boxes boxes = boxes_of(world);
    Shadows shadows;
    int layers = 0;
    shadows.maps = maps_of(scene, boxes, shadows.size, layers);
    shadows.texels.resize(std::size_t(layers) * std::size_t(shadows.size) * std::size_t(shadows.size));
    const Occluders occluders(world, world.instances);
    for (const ShadowMap& map : shadows.maps)
        fill_map(shadows, map, occluders, {}, 0, 1);
    return shadows;
}

/// The number that a directional lamp's fine map holds of a place, as a place along the light; and the place's own.
std::pair<double, double> along_light(const Shadows& shadows, const ShadowMap& map, const glm::dvec3& place, int level)
{
    const glm::dvec2 at
        = (glm::dvec2(glm::dot(map.axes[0], place), glm::dot(map.axes[1], place)) - map.low[level]) / map.texel[level];
    const glm::ivec2 texel(glm::floor(at));
    const std::size_t size = std::size_t(shadows.size);
    const double part
        = shadows.texels[(std::size_t(map.layer + level) * size + std::size_t(texel.y)) * size + std::size_t(texel.x)]
        / 65535.0;
    return {map.nothing + part * (map.nearest - map.nothing), glm::dot(map.axes[2], place)};
}

TEST_F(ShadowsTest, ASunsMapsHoldWhatItsLightMeets)
{
    Doc doc;
    wall(doc, {0, 0, 0}, {2.9, 0, 0}, {0, 0, -2.9});
    wall(doc, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}); // a roof 1 above the ground: under 45 degrees its shadow is 1 to the left
    const SceneFile scene = scene_of(doc, {{"lights", {sun}}});
    const World world = load_world(scene);
    const Shadows shadows = maps_alone(world, scene);
    ASSERT_EQ(shadows.maps.size(), 1u);
    const ShadowMap& map = shadows.maps[0];
    EXPECT_NEAR(glm::distance(map.axes[2], glm::normalize(glm::dvec3(1, 1, 0))), 0, 1e-12);
    EXPECT_NEAR(glm::determinant(glm::dmat3(map.axes[0], map.axes[1], map.axes[2])), 1, 1e-12);
    for (int level = 0; level < 2; ++level)
        for (double x = -2.8; x <= 2.8; x += 0.17)
            for (double z = -2.8; z <= 2.8; z += 0.23) {
                const auto [met, own] = along_light(shadows, map, {x, 0, z}, level);
                const bool shaded = std::abs(x + 1) < 1 && std::abs(z) < 1;
                EXPECT_NEAR(met - own, shaded ? std::sqrt(2.0) : 0, 0.02) << x << ' ' << z;
            }
}

TEST_F(ShadowsTest, APointLampsMapsHoldDistances)
{
    Doc doc;
    wall(doc, {0, 0, 0}, {2.9, 0, 0}, {0, 0, -2.9});
    wall(doc, {0, 1, 0}, {1, 0, 0}, {0, 0, -1});
    const Json lamp = {{"type", "point"}, {"position", {0, 3, 0}}, {"distance", 3}, {"radiance", {1, 1, 1}}};
    Json far = lamp;
    far["position"] = {0, 300, 0};
    const SceneFile scene = scene_of(doc, {{"lights", {lamp, far, lamp, lamp, lamp}}});
    const World world = load_world(scene);
    EXPECT_EQ(lights_with_shadows(boxes_of(world), scene), (std::vector<bool>{true, false, true, true, false}))
        << "not of the far one, and of three at most";
    const Shadows shadows = maps_alone(world, scene);
    ASSERT_EQ(shadows.maps.size(), 3u);
    const ShadowMap& map = shadows.maps[0];
    for (double x = -2.8; x < 2.8; x += 0.21)
        for (double z = -2.8; z < 2.8; z += 0.23) {
            const glm::dvec3 way = glm::dvec3(x, 0, z) - glm::dvec3(0, 3, 0);
            glm::dvec2 at;
            const int face = cube_face(way, at);
            EXPECT_LT(glm::distance(cube_direction(face, at), glm::normalize(way)), 1e-12);
            const glm::ivec2 texel(glm::floor((0.5 + 0.5 * at) * double(shadows.size)));
            const std::size_t size = std::size_t(shadows.size);
            const double part
                = shadows.texels[(std::size_t(map.layer + face) * size + std::size_t(texel.y)) * size + std::size_t(texel.x)]
                / 65535.0;
            const double distance = -(map.nothing + part * (map.nearest - map.nothing));
            // The roof is two thirds as far: its shadow is half as wide again.
            const bool shaded = std::abs(x) < 1.5 && std::abs(z) < 1.5;
            EXPECT_NEAR(distance, glm::length(way) * (shaded ? 2.0 / 3 : 1), 0.03) << x << ' ' << z;
        }
}

/// The part of the sky that the grid tells for a surface: without interpolation.
double sky_part(const Shadows& shadows, const glm::dvec3& place, const glm::dvec3& normal)
{
    const glm::ivec3 at
        = glm::clamp(glm::ivec3(glm::round((place - shadows.low) / shadows.cell)), glm::ivec3(0), shadows.cells - 1);
    const auto bytes = [&](int which) {
        return &shadows.sky[4
            * ((std::size_t(2 * at.z + which) * std::size_t(shadows.cells.y) + std::size_t(at.y))
                    * std::size_t(shadows.cells.x)
                + std::size_t(at.x))];
    };
    double part = 0;
    for (int k = 0; k < 3; ++k)
        part += (bytes(0)[k] / 255.0 - 0.5) * normal[k] + bytes(1)[k] / 255.0 * normal[k] * normal[k];
    return part;
}

TEST_F(ShadowsTest, TheGridTellsTheVisiblePartOfTheSky)
{
    Doc doc;
    ground(doc);
    wall(doc, {-4, 5, 0}, {0, 0, -10}, {0, 5, 0}); // a wall as high as the ground is wide, its front towards +x
    const SceneFile scene = scene_of(doc, {{"lights", {sun}}});
    World world = load_world(scene);
    add_shadows(world, scene);
    const Shadows& shadows = *world.shadows;
    // Far from the wall the ground sees the whole sky, a surface at right angles half of it. The ground ends after 10.
    EXPECT_NEAR(sky_part(shadows, {9, 0.2, 0}, {0, 1, 0}), 0.97, 0.06);
    EXPECT_NEAR(sky_part(shadows, {0, 0.3, 0}, {0, -1, 0}), 0, 0.07);
    // InsetView a wall that fills a quarter of the sphere the ground sees half of its hemisphere by the cosine, and so does
    // the wall. The wall's end lets a little more in.
    EXPECT_NEAR(sky_part(shadows, {-3.8, 0.2, 0}, {0, 1, 0}), 0.5, 0.08);
    EXPECT_NEAR(sky_part(shadows, {-3.8, 0.2, 0}, {1, 0, 0}), 0.5, 0.08);
    // In the middle of the ground, d from a wall of height h and great width: (1 + d / sqrt(h^2 + d^2)) / 2, for the ground.
    EXPECT_NEAR(sky_part(shadows, {2, 0.2, 0}, {0, 1, 0}), 0.5 * (1 + 6 / std::hypot(10.0, 6.0)), 0.09);
}

/// The part of the ambient light at a surface, as shadow.glsl's ambient_part reads it from the grid.
double daylight(const Shadows& shadows, const glm::dvec3& place, const glm::dvec3& normal)
{
    const glm::dvec3 above = (place - shadows.low) / shadows.cell + normal,
                     at = glm::clamp(above, glm::dvec3(0), glm::dvec3(shadows.cells) - 1.001), first = glm::floor(at);
    double sums[8]{};
    for (int k = 0; k < 8; ++k) {
        const glm::dvec3 side(k & 1, k >> 1 & 1, k >> 2), part = at - first;
        const glm::dvec3 weights = glm::mix(1.0 - part, part, side);
        const glm::ivec3 cell(first + side);
        for (int c = 0; c < 8; ++c)
            sums[c] += weights.x * weights.y * weights.z / 255
                * shadows.sky[4
                        * ((std::size_t(2 * cell.z + c / 4) * std::size_t(shadows.cells.y) + std::size_t(cell.y))
                                * std::size_t(shadows.cells.x)
                            + std::size_t(cell.x))
                    + std::size_t(c % 4)];
    }
    double seen = 0;
    for (int k = 0; k < 3; ++k)
        seen += (sums[k] - 0.5) * normal[k] + sums[4 + k] * normal[k] * normal[k];
    const double margin = 255 * sums[7], near = margin / (margin + glm::distance(above, at)),
                 far = 1 - sums[3] * (0.5 - 0.5 * normal.y);
    return 0.4 + 0.6 * glm::mix(far, std::clamp(seen, 0.0, 1.0), near * near);
}

/// The form factor of a rectangle parallel to a surface, above it by h, from the place below its corner to a, b: Howell's
/// catalogue, B-3.
double above_corner(double a, double b, double h)
{
    const double x = a / h, y = b / h, p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
    return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / 6.283185307179586;
}

/// That of a rectangle at right angles to a surface and standing on it, c away, from the place beside its corner: B-4.
double beside_corner(double height, double width, double c)
{
    const double far = std::hypot(height, c);
    return (std::atan(width / c) - c / far * std::atan(width / far)) / 6.283185307179586;
}

TEST_F(ShadowsTest, DaylightIsThatOfTheOpenSkyWithinAHundredth)
{
    // A roof or a wall over a ground, of both sides and of one, at heights that are no multiples of a cell; some cells away
    // from the wall, for details smaller than a cell are lost.
    std::mt19937 random(3);
    const auto any = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    for (const auto& [both_sides, height] : {std::pair(false, 2.0), {true, 3.137}, {false, 6.0}}) {
        const Json material = {{"doubleSided", both_sides}};
        Doc roof, standing;
        wall(roof, {0, 0, 0}, {60, 0, 0}, {0, 0, -60}, material);
        wall(roof, {-5, height, 0}, {5, 0, 0}, {0, 0, 20}, material);
        wall(standing, {0, 0, 0}, {60, 0, 0}, {0, 0, -60}, material);
        wall(standing, {-1, 0.5 * height, 0}, {0, 0, -12}, {0, 0.5 * height, 0}, material);
        for (const bool is_roof : {true, false}) {
            if (!testing::all_cases() && height == 6)
                continue;
            const SceneFile scene = scene_of(is_roof ? roof : standing, {{"ambient", {1, 1, 1}}});
            World world = load_world(scene);
            add_shadows(world, scene);
            double worst = 0, least = 1, squares = 0;
            std::vector<double> open; // off on open ground
            glm::dvec3 where(0);
            for (int i = 0; i < 4000; ++i) {
                const glm::dvec3 place(any(is_roof ? -20 : 0.5, i % 2 ? 20 : 50), 0, any(-50, 50));
                double hidden = 0;
                if (is_roof) {
                    for (const auto& [x, z, sign] : {std::tuple(0, 20, 1), {0, -20, -1}, {-10, 20, -1}, {-10, -20, 1}})
                        hidden += sign * above_corner(x - place.x, z - place.z, height);
                } else {
                    hidden = beside_corner(height, 12 - place.z, place.x + 1)
                        + beside_corner(height, 12 + place.z, place.x + 1);
                }
                const double expected = 1 - 0.6 * hidden;
                least = std::min(least, expected);
                const double off = std::abs(daylight(*world.shadows, place, {0, 1, 0}) / expected - 1);
                if (off > worst)
                    worst = off, where = place;
                if (expected > 0.9)
                    open.push_back(off);
                squares += off * off / 4000;
            }
            std::ranges::sort(open);
            std::printf(
                "%s %.3f high: from %.2f on, off by at most %.2f %% at %.1f %.1f, %.2f %% on open ground, %.2f %% rms\n",
                is_roof ? "roof" : "wall", height, least, 100 * worst, where.x, where.z, 100 * open.back(),
                100 * std::sqrt(squares));
            EXPECT_LT(open.back(), 0.01);
            EXPECT_LT(std::sqrt(squares), 0.003);
            EXPECT_LT(worst, 0.02); // near the edges of roofs, where half of the rays meet them
        }
    }
}

TEST_F(ShadowsTest, KeptShadowsAreReadAgainAndDamagedOnesAreNot)
{
    Doc doc;
    ground(doc);
    // So low that the grid has few cells; and the maps of five suns are smaller than one sun's: both are made sooner.
    wall(doc, {0, 0.3, 0}, {1, 0, 0}, {0, 0, -1});
    const std::vector<Json> suns(5, sun);
    SceneFile scene = scene_of(doc, {{"lights", suns}});
    const std::filesystem::path kept = folder / "kept";
    std::filesystem::create_directories(kept);
    World first = load_world(scene);
    double last = -1;
    EXPECT_TRUE(add_shadows(first, scene, kept, [&](double part) {
        EXPECT_GE(part, last);
        EXPECT_LE(part, 1);
        last = part;
    }));
    EXPECT_GT(last, 0.5);
    World second = load_world(scene);
    EXPECT_FALSE(add_shadows(second, scene, kept, [](double) { FAIL() << "they are computed again"; }));
    EXPECT_EQ(second.shadows->texels, first.shadows->texels);
    EXPECT_EQ(second.shadows->sky, first.shadows->sky);
    EXPECT_EQ(second.shadows->cells, first.shadows->cells);
    EXPECT_EQ(second.shadows->low, first.shadows->low);
    const auto file = std::filesystem::directory_iterator(kept)->path();
    EXPECT_EQ(file.extension(), ".shadow");
    {
        std::fstream damaged(file, std::ios::in | std::ios::out | std::ios::binary);
        damaged.seekp(100'000);
        damaged.put('\x55');
        damaged.put('\x77');
    }
    World third = load_world(scene);
    EXPECT_TRUE(add_shadows(third, scene, kept));
    EXPECT_EQ(third.shadows->texels, first.shadows->texels);
    EXPECT_EQ(third.shadows->sky, first.shadows->sky);
    EXPECT_EQ(third.shadows->cells, first.shadows->cells);
    EXPECT_EQ(third.shadows->low, first.shadows->low);
    EXPECT_EQ(third.shadows->cell, first.shadows->cell);
    // Another sun has other shadows; a scene without them has none.
    std::vector<Json> moved = suns;
    moved[0]["towards"] = {0, 1, 1};
    EXPECT_NE(shadows_key(third, third, scene_of(doc, {{"lights", moved}})), shadows_key(third, third, scene));
    scene.shadows = false;
    World without = load_world(scene);
    EXPECT_FALSE(add_shadows(without, scene, kept));
    EXPECT_FALSE(without.shadows);
}

TEST_F(ShadowsTest, NothingOfADamagedFileRemainsWhicheverBitIsWrong)
{
    Shadows made;
    made.size = 4, made.maps.resize(1);
    for (int i = 0; i < 2 * 4 * 4; ++i)
        made.texels.push_back(std::uint16_t(1000 * i));
    made.cells = {2, 3, 2}, made.low = {1, 2, 3}, made.cell = 0.5;
    for (int i = 0; i < 8 * 2 * 3 * 2; ++i)
        made.sky.push_back(std::uint8_t(2 * i));
    const std::filesystem::path file = folder / "one.shadow";
    ASSERT_TRUE(write_kept_shadows(file, 77, made));
    const auto read = [&](Shadows& to) {
        to.size = made.size, to.maps = made.maps;
        return read_kept_shadows(file, 77, to);
    };
    Shadows kept;
    ASSERT_TRUE(read(kept));
    EXPECT_EQ(kept.texels, made.texels);
    EXPECT_EQ(kept.sky, made.sky);
    EXPECT_EQ(kept.cells, made.cells);
    std::ifstream stream(file, std::ios::binary);
    const std::string whole((std::istreambuf_iterator<char>(stream)), {});
    const auto expect_refused = [&](const std::string& bytes, std::size_t at) {
        starbow::testing::write_bytes(file, bytes);
        Shadows damaged;
        EXPECT_FALSE(read(damaged)) << at;
        EXPECT_TRUE(damaged.texels.empty() && damaged.sky.empty() && damaged.cells == glm::ivec3(0)) << at;
        EXPECT_EQ(damaged.low, glm::dvec3(0)) << at;
        EXPECT_EQ(damaged.cell, 1) << at;
    };
    for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
        std::string damaged = whole;
        damaged[bit / 8] ^= char(1 << bit % 8);
        expect_refused(damaged, bit);
    }
    for (std::size_t length = 0; length < whole.size(); ++length)
        expect_refused(whole.substr(0, length), length);
    expect_refused(whole + '0', whole.size() + 1);
}

} // namespace
} // namespace starbow::gltf_test::shadows_test
