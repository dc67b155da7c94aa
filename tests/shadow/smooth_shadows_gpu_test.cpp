// Shadows on smooth things, which are drawn in fewer triangles than their shadow maps hold, against closed forms.
#include "runtime/render/render_context.h"
#include "tests/support/small_world.h"

namespace starbow::gpu_test::smooth_shadows_gpu_test {
namespace {

const Json sun = {{"type", "directional"}, {"towards", {1, 1, 0}}, {"radiance", {0.6, 0.6, 0.6}}};
const Json matt = {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}}};

/// A ball of 2 n² triangles, smoothly shaded.
void ball(Doc& doc, const dvec3& centre, double radius, int n)
{
    std::vector<float> positions, normals;
    std::vector<std::uint32_t> indices;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const double t = pi * j / n, f = 2 * pi * i / n; // both ends meet to a rounding
            for (const double x : {std::sin(t) * std::cos(f), std::cos(t), std::sin(t) * std::sin(f)})
                positions.push_back(float(radius * x)), normals.push_back(float(x));
        }
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const std::uint32_t a = std::uint32_t(j * (n + 1) + i), c = a + std::uint32_t(n) + 1;
            indices.insert(indices.end(), {a, a + 1, c, a + 1, c + 1, c});
        }
    const Json primitive
        = {{"attributes", {{"POSITION", doc.accessor(positions, "VEC3")}, {"NORMAL", doc.accessor(normals, "VEC3")}}},
            {"indices", doc.accessor(indices, "SCALAR")}, {"material", 0}};
    const Json node
        = {{"mesh", doc.put("meshes", {{"primitives", {primitive}}})}, {"translation", {centre.x, centre.y, centre.z}}};
    doc.json["scenes"][0]["nodes"].push_back(doc.put("nodes", node));
}

// The light of white balls and of the ground under them, in closed form: no ball shades itself where its normal faces the
// lamp, and each shades the ground around the line from the lamp through its middle. Balls of many triangles are drawn in
// fewer.
TEST(SmoothShadows, ASmoothBallHasTheLightOfItsNormalsAndTheGroundBelowHasNone)
{
    const Json lamp = {{"type", "point"}, {"position", {3, 9, 3}}, {"distance", 9}, {"radiance", {0.8, 0.8, 0.8}}};
    const Json low_sun = {{"type", "directional"}, {"towards", {0.9, 0.25, 0.35}}, {"radiance", {0.6, 0.6, 0.6}}};
    const std::vector<dvec3> centres{{0, 1, 0}, {0, 4, -6}}; // one stands, one floats
    long balls = 0, lit = 0, dark = 0;
    for (const auto& [name, light, ground] :
        {std::tuple("sun", sun, 20.0), {"wide", sun, 200.0}, {"low", low_sun, 20.0}, {"lamp", lamp, 20.0}})
        for (const int n : {24, 48, 128}) {
            const bool sample = name == std::string("wide") ? n == 48 : name != std::string("low") && n == 128;
            if (!testing::all_cases() && !sample)
                continue;
            Doc doc;
            doc.json["materials"] = {matt};
            quad(doc, {0, 0, 0}, {ground, 0, 0}, {0, 0, -ground}, 0);
            for (const dvec3& centre : centres)
                ball(doc, centre, 1, n);
            const GpuWorld world = shaded_world("balls", doc, {{"lights", {light}}});
            OffscreenRenderer live = renderer(world, one_view(Planar{.fov_y_deg = 50}, {300, 220}), true);
            for (const double away : {1.0, 3.0}) {
                const Shot shot = shot_at(away * dvec3(4, 3.5, 5), {0, 0, 0}, {-4, -2.5, -6});
                const Numbers numbers(live, shot);
                const auto place_of = [&](int i) { return shot.position + numbers.world(i) * numbers.depth(i); };
                // -1: the ground, or a ball's number; -2: something else is at the pixel or beside it.
                const auto thing_of = [&](int i) {
                    const int x = i % numbers.size.x, y = i / numbers.size.x;
                    if (x < 2 || y < 2 || x >= numbers.size.x - 2 || y >= numbers.size.y - 2)
                        return -2;
                    int thing = -3;
                    for (int k = 0; k < 25; ++k) {
                        const int at = i + k % 5 - 2 + (k / 5 - 2) * numbers.size.x;
                        if (std::isinf(numbers.depth(at)))
                            return -2;
                        const dvec3 place = place_of(at);
                        // Places are known to a part of their distance.
                        int own = std::abs(place.y) < 0.02 && glm::length(place) < 12 ? -1 : -2;
                        for (std::size_t k = 0; k < centres.size(); ++k)
                            own = std::abs(glm::distance(place, centres[k]) - 1) < 0.03 && place.y > 0.05 ? int(k) : own;
                        if (own == -2 || (thing != -3 && own != thing))
                            return -2;
                        thing = own;
                    }
                    return thing;
                };
                double sum = 0, right = 0;
                for (int i = 0; i < numbers.count(); ++i) {
                    const int thing = thing_of(i);
                    if (thing == -2)
                        continue;
                    const dvec3 place = place_of(i);
                    dvec3 way(0);
                    double strength = 0;
                    if (light["type"] == "point") {
                        const dvec3 to = dvec3(3, 9, 3) - place;
                        way = glm::normalize(to), strength = 0.8 * 81 / glm::dot(to, to);
                    } else {
                        way = glm::normalize(dvec3(light["towards"][0], light["towards"][1], light["towards"][2])),
                        strength = 0.6;
                    }
                    double clear = 10; // from the way to the lamp to the balls' surfaces
                    for (std::size_t k = 0; k < centres.size(); ++k)
                        if (const dvec3 off = centres[k] - place; int(k) != thing && glm::dot(off, way) > 0)
                            clear = std::min(clear, glm::length(off - way * glm::dot(off, way)) - 1);
                    const dvec3 normal = thing == -1 ? dvec3(0, 1, 0) : glm::normalize(place - centres[std::size_t(thing)]);
                    const double facing = glm::dot(normal, way), expected = strength * std::max(facing, 0.0);
                    const double seen = numbers.light(i).g;
                    if (thing >= 0 && clear > 0.2 && facing > 0.15) {
                        sum += seen, right += expected, ++balls;
                        ASSERT_NEAR(seen, expected, 0.1 * strength)
                            << name << ' ' << n << " away " << away << ": " << facing;
                    } else if (thing == -1 && clear > 0.2) {
                        ASSERT_NEAR(seen / expected, 1, 0.01)
                            << name << ' ' << n << " away " << away << ": " << place.x << ' ' << place.z;
                        ++lit;
                    } else if (thing == -1 && clear < -0.2) {
                        ASSERT_LT(seen, 0.01 * strength)
                            << name << ' ' << n << " away " << away << ": " << place.x << ' ' << place.z;
                        ++dark;
                    }
                }
                EXPECT_NEAR(sum / right, 1, 0.02) << name << ' ' << n << " away " << away;
            }
        }
    EXPECT_GT(balls, 10'000);
    EXPECT_GT(lit, 50'000);
    EXPECT_GT(dark, 1'000);
}

} // namespace
} // namespace starbow::gpu_test::smooth_shadows_gpu_test
