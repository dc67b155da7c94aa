// Shadows and daylight in the live picture: at places known in closed form, and beside true rays in every shipped world.
#include "runtime/images/picture_errors.h"
#include "runtime/reference/reference.h"
#include "runtime/render/render_context.h"
#include "runtime/world/shadows.h"
#include "tests/support/small_world.h"

namespace starbow::gpu_test::shadows_gpu_test {
namespace {

const Json sun = {{"type", "directional"}, {"towards", {1, 1, 0}}, {"radiance", {0.6, 0.6, 0.6}}};
const Json matt = {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}}};

/// A white ground of 20 by 20, and above it a roof of 2 by 2 at height 2.
Doc roofed()
{
    Doc doc;
    doc.json["materials"] = {matt};
    quad(doc, {0, 0, 0}, {10, 0, 0}, {0, 0, -10}, 0);
    quad(doc, {0, 2, 0}, {1, 0, 0}, {0, 0, -1}, 0);
    quad(doc, {0, 1.99, 0}, {1, 0, 0}, {0, 0, 1}, 0); // its lower side
    return doc;
}

/// True for a pixel of the ground whose neighbours all show the ground: no light of the roof's rim is in it.
bool shows_ground(const Numbers& numbers, const Shot& shot, int i)
{
    const auto height = [&](int at) {
        return std::isinf(numbers.depth(at)) ? 9.0 : (shot.position + numbers.world(at) * numbers.depth(at)).y;
    };
    const int x = i % numbers.size.x, y = i / numbers.size.x;
    if (x < 2 || y < 2 || x >= numbers.size.x - 2 || y >= numbers.size.y - 2)
        return false;
    for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx)
            if (std::abs(height(i + dy * numbers.size.x + dx)) > 0.01)
                return false;
    return true;
}

/// The light of the ground's places, as a picture from a place above them shows it.
void expect_ground(const GpuWorld& world, const std::function<double(double x, double z)>& light, double edge)
{
    const Layout layout = one_view(Planar{.fov_y_deg = 60}, {240, 240});
    OffscreenRenderer live = renderer(world, layout, true);
    const Shot shot = shot_at({-3, 8, 3}, {0, 0, 0}, {0.02, -1, -0.3});
    const Numbers numbers(live, shot);
    int compared = 0;
    for (int i = 0; i < numbers.count(); ++i) {
        const dvec3 place = shot.position + numbers.world(i) * numbers.depth(i);
        if (!shows_ground(numbers, shot, i))
            continue;
        // Away from the edges: all four places around have the same light.
        const double expected = light(place.x, place.z);
        bool even = true;
        for (const auto& [dx, dz] : {std::pair(edge, edge), {-edge, edge}, {edge, -edge}, {-edge, -edge}})
            even &= light(place.x + dx, place.z + dz) == expected;
        if (!even)
            continue;
        ++compared;
        ASSERT_NEAR(numbers.light(i).g, expected, 0.012) << place.x << ' ' << place.z;
    }
    EXPECT_GT(compared, 15'000);
}

TEST(Shadows, ARoofsShadowIsWhereTheSunPutsIt)
{
    // Without ambient light: the ground has the sun's at 45 degrees, or none.
    const GpuWorld world = shaded_world("roof", roofed(), {{"lights", {sun}}});
    expect_ground(
        world, [](double x, double z) { return std::abs(x + 2) < 1 && std::abs(z) < 1 ? 0 : 0.6 * std::sqrt(0.5); }, 0.08);
}

TEST(Shadows, ALampsShadowIsWhereItsRaysEnd)
{
    const Json lamp = {{"type", "point"}, {"position", {0, 6, 0}}, {"distance", 6}, {"radiance", {0.8, 0.8, 0.8}}};
    const GpuWorld world = shaded_world("lamp", roofed(), {{"lights", {lamp}}});
    // Its lower side is at 1.99.
    const double wide = 6 / (6 - 1.99);
    const Layout layout = one_view(Planar{.fov_y_deg = 60}, {240, 240});
    OffscreenRenderer live = renderer(world, layout, true);
    const Shot shot = shot_at({-3, 8, 3}, {0, 0, 0}, {0.02, -1, -0.3});
    const Numbers numbers(live, shot);
    int shaded = 0, lit = 0;
    for (int i = 0; i < numbers.count(); ++i) {
        const dvec3 place = shot.position + numbers.world(i) * numbers.depth(i);
        if (!shows_ground(numbers, shot, i))
            continue;
        const double away = std::max(std::abs(place.x), std::abs(place.z));
        if (std::abs(away - wide) < 0.08)
            continue;
        const double square = glm::dot(place - dvec3(0, 6, 0), place - dvec3(0, 6, 0));
        const double expected = away < wide ? 0 : 0.8 * 36 / square * 6 / std::sqrt(square);
        (away < wide ? shaded : lit) += 1;
        ASSERT_NEAR(numbers.light(i).g, expected, 0.004) << place.x << ' ' << place.z;
    }
    EXPECT_GT(shaded, 100);
    EXPECT_GT(lit, 15'000);
}

TEST(Shadows, UnderARoofThereIsLessDaylight)
{
    const GpuWorld world = shaded_world("dim", roofed(), {{"ambient", {0.5, 0.5, 0.5}}});
    OffscreenRenderer live = renderer(world, one_view(Planar{.fov_y_deg = 40}, {64, 64}), true);
    const auto at = [&](const dvec3& from, const dvec3& look) {
        const Numbers numbers(live, shot_at(from, {0, 0, 0}, look));
        return numbers.light(32 * 64 + 32).g;
    };
    // The open ground, whose neighbourhood is flat, has all of it. Under the middle of the roof the sky is hidden in a cone:
    // of a square of side 2 at height 2 the form factor is 0.239 (Howell, catalogue B-3, four quarters).
    const double open = at({7, 2, 7}, {0.01, -1, 0});
    EXPECT_NEAR(open, 0.5, 0.004);
    const double under = at({3, 1, 0}, {-1, -1.0 / 3, 0.0001});
    EXPECT_NEAR(under, 0.5 * (0.4 + 0.6 * (1 - 0.239)), 0.004);
    // The roof's lower side sees the ground instead of the sky.
    const double below = at({3, 0.5, 0}, {-1, 0.5, 0.0001});
    EXPECT_NEAR(below, 0.5 * 0.45, 0.06);
}

TEST(Shadows, MovingThingsKeepTheirLight)
{
    Doc doc = roofed();
    quad(doc, {-2, 0.5, 0}, {0.4, 0, 0}, {0, 0, -0.4}, 0, {{"name", "body"}}); // in the roof's shadow
    const Json body = {{"name", "body"}, {"nodes", {"body"}},
        {"worldline", {{{"time", -1000}, {"position", {-1e-3, 0, 0}}}, {{"time", 1000}, {"position", {1e-3, 0, 0}}}}}};
    const GpuWorld world = shaded_world("moving", doc, {{"lights", {sun}}, {"bodies", {body}}});
    OffscreenRenderer live = renderer(world, one_view(Planar{.fov_y_deg = 40}, {64, 64}), true);
    const Numbers numbers(live, shot_at({-2, 4, 0}, {0, 0, 0}, {0, -1, 0.0001}));
    EXPECT_NEAR(numbers.light(32 * 64 + 32).g, 0.6 * std::sqrt(0.5), 0.01);
}

TEST(Shadows, EqualTrueRaysInEveryShippedWorld)
{
    int worlds = 0;
    for (const auto& file : testing::shipped("config/scenes")) {
        const SceneFile scene = load_scene_file(file);
        if (!scene.shadows || (!testing::all_cases() && file.stem() != "clocks"))
            continue;
        ++worlds;
        const ReferenceWorld rays = open_reference_world(file);
        LoadedScene loaded = load_scene(file);
        const GpuWorld world = upload(device(), pipelines(), std::move(loaded.world), loaded.scene, loaded.stars);
        Layout layout = load_layout(testing::source_dir() / "config/layouts/desk.json");
        layout.outputs[0].size = {800, 600};
        Shot shot = scene.start;
        const Quality fine = within(device(), load_quality(testing::source_dir() / "config/qualities/fine.json"));
        OffscreenRenderer live(device(), pipelines(), world, layout, fine, false);
        const auto picture = live.picture(shot)[0];
        const Reference truth = reference(rays.input(), layout, shot, 0, {.samples = 16, .numbers = false});
        const double db = psnr_dB({layout.outputs[0].size, picture}, {layout.outputs[0].size, shown(truth)});
        std::printf("%s: %.1f dB\n", file.stem().c_str(), db);
        EXPECT_GT(db, 35) << file.stem();
    }
    EXPECT_GE(worlds, testing::all_cases() ? 6 : 1);
}

} // namespace
} // namespace starbow::gpu_test::shadows_gpu_test
