// Blended surfaces: sums known in closed form, their order, moving ones, and the reference beside the live picture.
#include "tests/support/beside_rays.h"
#include <glm/gtc/quaternion.hpp>
#include <random>

namespace starbow::gpu_test::blended_gpu_test {
namespace {

/// A blended material whose colour needs no lamp.
int glass(Doc& doc, const dvec3& colour, double alpha, bool both_sides = false)
{
    const int material = unlit(doc, colour);
    Json& made = doc.json["materials"][std::size_t(material)];
    made["pbrMetallicRoughness"]["baseColorFactor"][3] = alpha;
    made["alphaMode"] = "BLEND";
    made["doubleSided"] = both_sides;
    return material;
}

const dvec3 red{0.8, 0.1, 0.1}, green{0.1, 0.7, 0.2}, blue{0.1, 0.2, 0.9}, grey{0.3, 0.3, 0.3};

/// The light in the middle of a picture straight ahead.
dvec3 middle_of(const GpuWorld& world, const Shot& shot)
{
    OffscreenRenderer live = renderer(world, one_view(Planar{.fov_y_deg = 20}, {33, 33}), true);
    return Numbers(live, shot).light(16 * 33 + 16);
}

TEST(Blended, EachLayerTakesItsPartAndAddsItsOwn)
{
    Doc doc;
    // In the file's order the nearest comes first: drawing sorts them.
    quad(doc, {0, 0, -4}, {1, 0, 0}, {0, 1, 0}, glass(doc, red, 0.5));
    quad(doc, {0, 0, -6}, {2, 0, 0}, {0, 2, 0}, glass(doc, green, 0.25));
    quad(doc, {0, 0, -9}, {3, 0, 0}, {0, 3, 0}, unlit(doc, grey));
    quad(doc, {0, 0, -12}, {3, 0, 0}, {0, 3, 0}, glass(doc, blue, 0.75)); // behind the wall
    const GpuWorld world = open_world("layers", doc, {});
    EXPECT_TRUE(
        near_colour(middle_of(world, shot_at({0, 0, 0}, {0, 0, 0})), 0.5 * red + 0.5 * (0.25 * green + 0.75 * grey), 0.002));
}

TEST(Blended, TheSkyShowsThrough)
{
    Doc doc;
    quad(doc, {0, 0, -4}, {1, 0, 0}, {0, 1, 0}, glass(doc, red, 0.5));
    const GpuWorld world = open_world("window", doc, {{"sky", smooth_sky}});
    const dvec3 sky = sky_colour({0, 0, -1});
    EXPECT_TRUE(near_colour(middle_of(world, shot_at({0, 0, 0}, {0, 0, 0})), 0.5 * red + 0.5 * sky, 0.004));
}

TEST(Blended, TwoSidesShowTheBackFirst)
{
    // A box without lid and floor of one mesh: its far walls show their inner sides.
    Doc doc;
    const int both = glass(doc, red, 0.5, true), one = glass(doc, red, 0.5);
    quad(doc, {0, 0, -6}, {-1, 0, 0}, {0, 1, 0}, both); // looks away
    quad(doc, {0, 0, -8}, {3, 0, 0}, {0, 3, 0}, unlit(doc, grey));
    quad(doc, {0, 5, -6}, {-1, 0, 0}, {0, 1, 0}, one);
    quad(doc, {0, 5, -8}, {3, 0, 0}, {0, 3, 0}, unlit(doc, grey));
    const GpuWorld world = open_world("sides", doc, {});
    EXPECT_TRUE(near_colour(middle_of(world, shot_at({0, 0, 0}, {0, 0, 0})), 0.5 * red + 0.5 * grey, 0.002));
    EXPECT_TRUE(near_colour(middle_of(world, shot_at({0, 5, 0}, {0, 0, 0})), grey, 0.002)) << "its back does not show";
}

TEST(Blended, APaneInFrontOfASmallThingIsDrawnAfterIt)
{
    // The pane's middle is far to the side, so that it is farther away than the thing's, behind it.
    for (const double behind : {-7.0, -5.0}) {
        Doc doc;
        quad(doc, {40, 0, -6}, {45, 0, 0}, {0, 5, 0}, glass(doc, green, 0.5));
        quad(doc, {0, 0, behind}, {0.5, 0, 0}, {0, 0.5, 0}, glass(doc, red, 0.5));
        quad(doc, {0, 0, -20}, {50, 0, 0}, {0, 50, 0}, unlit(doc, grey));
        const GpuWorld world = open_world("pane", doc, {});
        const dvec3 near = behind < -6 ? green : red, far = behind < -6 ? red : green;
        EXPECT_TRUE(
            near_colour(middle_of(world, shot_at({0, 0, 0}, {0, 0, 0})), 0.5 * near + 0.25 * far + 0.25 * grey, 0.002))
            << behind;
    }
}

/// Panes of glass and walls, of which one pane moves.
Doc panes()
{
    Doc doc;
    quad(doc, {0, 0, -12}, {9, 0, 0}, {0, 6, 0}, unlit(doc, grey));
    for (int i = 0; i < 5; ++i)
        quad(doc, {1.5 * i - 3, 0.4 * i - 1, -5 - i}, {1.2, 0, 0.3 * i}, {0, 1.2, 0.1},
            glass(doc, i % 2 ? green : red, 0.3 + 0.1 * i, true));
    quad(doc, {0, 0, 0}, {0.8, 0, 0.4}, {0, 0.8, 0}, glass(doc, blue, 0.5, true), {{"name", "body"}});
    return doc;
}

void compare(const char* name, const Doc& doc, const Json& scene, const dvec3& u, double floor_db)
{
    Shot shot = shot_at({0, 0, 0}, u);
    shot.effects = {};
    const auto [db, off] = beside_rays(doc, scene, one_view(Planar{.fov_y_deg = 60}, {240, 180}), shot, 16, false, 1e-3);
    std::printf("%s: %.1f dB, light off by %.4f in the middle, %.4f at 9 of 10\n", name, db, off[off.size() / 2],
        off[off.size() * 9 / 10]);
    EXPECT_GT(db, floor_db) << name;
    EXPECT_LT(off[off.size() / 2], 0.003) << name;
}

TEST(Blended, EqualsTheReference)
{
    const Json sky = {{"zenith", {0.1, 0.2, 0.5}}, {"horizon", {0.5, 0.55, 0.6}}, {"nadir", {0.2, 0.15, 0.1}}};
    const Json body = {{"name", "pane"}, {"nodes", {"body"}},
        {"worldline", {{{"time", -100}, {"position", {-60, 0, -4}}}, {{"time", 100}, {"position", {60, 0, -4}}}}}};
    compare("panes", panes(), {{"sky", sky}}, {0, 0, 0}, 36);
    compare("panes at speed", panes(), {{"sky", sky}}, {0.3, 0.1, -0.8}, 33);
    compare("a pane that moves", panes(), {{"sky", sky}, {"bodies", {body}}}, {0, 0, 0}, 33);
    compare("a pane that moves, at speed", panes(), {{"sky", sky}, {"bodies", {body}}}, {0.2, 0, -0.5}, 30);
}

/// A rectangle of a mesh, and its colour with alpha.
struct Pane {
    dvec3 centre, right, up;
    glm::dvec4 colour;
};

/// Adds one mesh of all panes, in their order. mode: glTF's alphaMode. picture: its texture; none without.
void one_mesh(Doc& doc, const std::vector<Pane>& panes, const char* mode, const std::string& picture = {}, bool lit = false)
{
    std::vector<float> positions, colours, coordinates, normals;
    std::vector<std::uint32_t> indices;
    for (const Pane& pane : panes) {
        const auto first = std::uint32_t(positions.size() / 3);
        for (const auto& [x, y] : {std::pair(-1, 1), {-1, -1}, {1, 1}, {1, -1}}) {
            const dvec3 corner = pane.centre + double(x) * pane.right + double(y) * pane.up,
                        n = glm::normalize(glm::cross(pane.right, pane.up));
            for (int k = 0; k < 3; ++k)
                positions.push_back(float(corner[k])), normals.push_back(float(n[k]));
            for (int k = 0; k < 4; ++k)
                colours.push_back(float(pane.colour[k]));
            coordinates.insert(coordinates.end(), {0.5f + 0.5f * float(x), 0.5f - 0.5f * float(y)});
        }
        for (const std::uint32_t k : {0, 1, 2, 2, 1, 3})
            indices.push_back(first + k);
    }
    const int material = unlit(doc, {1, 1, 1});
    Json& made = doc.json["materials"][std::size_t(material)];
    made["alphaMode"] = mode, made["doubleSided"] = true;
    if (lit)
        made.erase("extensions"), made["pbrMetallicRoughness"]["metallicFactor"] = 0;
    if (!picture.empty()) {
        const int image = doc.put("images", {{"uri", picture}});
        made["pbrMetallicRoughness"]["baseColorTexture"]["index"] = doc.put("textures", {{"source", image}});
    }
    doc.show({{"attributes",
                  {{"POSITION", doc.accessor(positions, "VEC3")}, {"NORMAL", doc.accessor(normals, "VEC3")},
                      {"COLOR_0", doc.accessor(colours, "VEC4")}, {"TEXCOORD_0", doc.accessor(coordinates, "VEC2")}}},
        {"indices", doc.accessor(indices, "SCALAR")}, {"material", material}});
}

/// Panes that stand askew in the cells of a grid: none meets another.
std::vector<Pane> panes_in_a_grid(int along, double least_alpha, double most_alpha)
{
    std::mt19937_64 random(5);
    const auto any = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    std::vector<Pane> panes;
    const double cell = 6.0 / along;
    for (int i = 0; i < along * along * along; ++i) {
        const dvec3 at(i % along, i / along % along, i / along / along);
        const glm::dmat3 turn = glm::dmat3(
            glm::mat3_cast(glm::angleAxis(any(0, 6), glm::normalize(dvec3(any(-1, 1), any(-1, 1), any(-1, 1))))));
        panes.push_back({cell * (at - 0.5 * (along - 1)) + dvec3(0, 0, -8), 0.5 / std::sqrt(2) * cell * turn[0],
            0.5 / std::sqrt(2) * cell * turn[1], {any(0, 1), any(0, 1), any(0, 1), any(least_alpha, most_alpha)}});
    }
    std::shuffle(panes.begin(), panes.end(), random);
    return panes;
}

TEST(Blended, TheTrianglesOfOneMeshAreDrawnFromBehindInAnyOrder)
{
    const Json sky = {{"zenith", {0.1, 0.2, 0.5}}, {"horizon", {0.5, 0.55, 0.6}}, {"nadir", {0.2, 0.15, 0.1}}};
    for (const int along : {3, 5}) {
        Doc doc;
        one_mesh(doc, panes_in_a_grid(along, 0.2, 0.8), "BLEND");
        compare("a grid of panes", doc, {{"sky", sky}}, {0, 0, 0}, 33);
        compare("a grid of panes, at speed", doc, {{"sky", sky}}, {0.3, 0.1, -0.8}, 33);
    }
    Doc large;
    std::vector<Pane> panes = panes_in_a_grid(3, 0.2, 0.8);
    panes.insert(panes.begin(), {{0, 0, -4}, {6, 0, 0}, {0, 6, 0}, {0.2, 0.8, 0.2, 0.5}});
    panes.push_back({{7, 0, -12}, {13, 0, 0}, {0, 6, 0}, {0.2, 0.2, 0.8, 0.5}});
    one_mesh(large, panes, "BLEND");
    compare("large panes before and behind", large, {{"sky", sky}}, {0, 0, 0}, 33);
    for (const double behind : {-7.0, -5.0}) {
        // The large one's middle is far to the side.
        Doc doc;
        one_mesh(doc,
            {{{40, 0, -6}, {45, 0, 0}, {0, 5, 0}, {0.1, 0.7, 0.2, 0.5}},
                {{0, 0, behind}, {2, 0, 0}, {0, 2, 0}, {0.8, 0.1, 0.1, 0.5}}},
            "BLEND");
        compare("a small pane beside a large one's middle", doc, {{"sky", sky}}, {0, 0, 0}, 33);
    }
}

/// Cards that cross each other, with a picture of round leaves: opaque or empty.
std::vector<Pane> cards(double far)
{
    std::mt19937_64 random(8);
    const auto any = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    std::vector<Pane> cards;
    for (int i = 0; i < 150; ++i) {
        const glm::dmat3 turn = glm::dmat3(
            glm::mat3_cast(glm::angleAxis(any(0, 6), glm::normalize(dvec3(any(-1, 1), any(-1, 1), any(-1, 1))))));
        const double size = any(0.2, 0.8);
        cards.push_back({{any(-2, 2), any(-2, 2), any(-2, 2) - far}, size * turn[0], size * turn[1],
            {any(0, 1), any(0, 1), any(0, 1), 1}});
    }
    return cards;
}

std::string leaves_uri()
{
    gltf_test::Bytes rgba;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const double from_middle = std::hypot(x % 16 - 7.5, y % 16 - 7.5);
            rgba.insert(rgba.end(), {255, 255, 255, std::uint8_t(from_middle < 6 ? 255 : 0)});
        }
    return "data:image/png;base64," + gltf_test::base64(gltf_test::png(32, 32, rgba));
}

TEST(Blended, OpaqueTexelsHideAsThoseOfAMask)
{
    const Json sky = {{"zenith", {0.1, 0.2, 0.5}}, {"horizon", {0.5, 0.55, 0.6}}, {"nadir", {0.2, 0.15, 0.1}}};
    const Json lamp = {{"type", "directional"}, {"towards", {0.4, 0.8, 0.5}}, {"radiance", {0.9, 0.85, 0.8}}};
    struct Case {
        double far;
        dvec3 u;
        bool infrared;
    };
    for (const Case& one :
        {Case{4, dvec3(0), false}, {12, {0.3, 0.1, -0.8}, false}, {12, {0.3, 0.1, -0.8}, true}, {40, dvec3(0), true}}) {
        double db[2];
        for (const bool blend : {false, true}) {
            Doc doc;
            one_mesh(doc, cards(one.far), blend ? "BLEND" : "MASK", leaves_uri(), true);
            if (one.infrared)
                doc.json["materials"][0]["extras"]["starbow"] = {{"infrared", 0.9}, {"ultraviolet", 0.1}};
            Shot shot = shot_at({0, 0, 0}, one.u);
            shot.effects = {};
            const Json scene = {{"sky", sky}, {"ambient", {0.2, 0.2, 0.25}}, {"lights", {lamp}}};
            db[blend] = beside_rays(doc, scene, one_view(Planar{.fov_y_deg = 50}, {160, 120}), shot, 16, false, 1e-3).db;
        }
        std::printf("leaves at %g, %.1f: as a mask %.1f dB, blended %.1f dB\n", one.far, glm::length(one.u), db[0], db[1]);
        EXPECT_GT(db[1], db[0] - 1) << one.far << ' ' << one.u.z << ' ' << one.infrared;
    }
}

TEST(Blended, MoreCoefficientsThanAColourHasAreBlendedAlike)
{
    const Json sky = {{"zenith", {0.1, 0.2, 0.5}}, {"horizon", {0.5, 0.55, 0.6}}, {"nadir", {0.2, 0.15, 0.1}}};
    const Json lamp = {{"type", "directional"}, {"towards", {0.4, 0.8, 0.5}}, {"radiance", {0.9, 0.85, 0.8}}};
    const Json kinds[] = {{{"infrared", 0.9}, {"ultraviolet", 0.1}},
        {{"infrared", 0.9}, {"ultraviolet", 0.1}, {"temperature_K", 3000}, {"emissivity", 0.1}},
        {{"reflectance", {{400, 0.1}, {500, 0.6}, {600, 0.2}, {700, 0.9}}}, {"temperature_K", 3000}, {"emissivity", 0.1}}};
    for (const Json& kind : kinds) {
        Doc doc;
        one_mesh(doc, panes_in_a_grid(3, 0.2, 0.8), "BLEND", {}, true);
        doc.json["materials"][0]["extras"]["starbow"] = kind;
        for (const dvec3& u : {dvec3(0), dvec3(0.3, 0.1, -0.8)})
            compare(kind.dump().c_str(), doc, {{"sky", sky}, {"ambient", {0.2, 0.2, 0.25}}, {"lights", {lamp}}}, u, 33);
    }
}

} // namespace
} // namespace starbow::gpu_test::blended_gpu_test
