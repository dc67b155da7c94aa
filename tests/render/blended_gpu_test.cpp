// Blended surfaces: sums known in closed form, their order, moving ones, and the reference beside the live picture.
#include "tests/support/beside_rays.h"

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
    shot.effects = {true, true, true};
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

} // namespace
} // namespace starbow::gpu_test::blended_gpu_test
