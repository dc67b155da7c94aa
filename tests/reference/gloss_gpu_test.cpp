// Glossy surfaces live, beside the reference, which has the reflection in other forms: sums over microfacets instead of a
// table, the lobes by Smith's own function. Every kind of light and of spectrum meets gloss here.
#include "tests/support/beside_rays.h"
#include <cmath>

namespace starbow::gpu_test::gloss_gpu_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A ball of radius 1 with texture coordinates; its primitive without a material.
Json ball(Doc& doc)
{
    constexpr int n = 32;
    std::vector<float> places, uv;
    std::vector<std::uint16_t> indices;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= 2 * n; ++j) {
            const double polar = pi * i / n, turn = pi * j / n;
            for (double x : {std::sin(polar) * std::sin(turn), std::cos(polar), std::sin(polar) * std::cos(turn)})
                places.push_back(float(x));
            uv.insert(uv.end(), {float(j) / n, float(i) / n});
            if (i == n || j == 2 * n)
                continue;
            const auto at = std::uint16_t(i * (2 * n + 1) + j), below = std::uint16_t(at + 2 * n + 1);
            for (int corner : {at + 0, below + 0, at + 1, at + 1, below + 0, below + 1})
                indices.push_back(std::uint16_t(corner));
        }
    const int positions = doc.accessor(places, "VEC3");
    return {{"attributes", {{"POSITION", positions}, {"NORMAL", positions}, {"TEXCOORD_0", doc.accessor(uv, "VEC2")}}},
        {"indices", doc.accessor(indices, "SCALAR")}};
}

/// Soft waves as a normal map (red, green, blue), with occlusion in alpha's place left out; 32 x 32.
Bytes waves()
{
    Bytes rgba;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const double a = 0.4 * std::sin(2 * pi * x / 32), b = 0.3 * std::sin(2 * pi * y / 16);
            for (double v : {a, b, std::sqrt(1 - a * a - b * b)})
                rgba.push_back(std::uint8_t(std::lround(v * 127 + 128)));
            rgba.push_back(255);
        }
    return gltf_test::png(32, 32, rgba);
}

/// Occlusion, roughness and metal that vary smoothly.
Bytes patches()
{
    Bytes rgba;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const double a = 0.5 + 0.5 * std::sin(2 * pi * x / 32), b = 0.5 + 0.5 * std::cos(2 * pi * y / 32);
            for (double v : {0.4 + 0.6 * a, 0.2 + 0.7 * b, a})
                rgba.push_back(std::uint8_t(std::lround(255 * v)));
            rgba.push_back(255);
        }
    return gltf_test::png(32, 32, rgba);
}

/// Eight balls in two rows before the eye, each in a node of its own.
Doc balls(bool maps, const Json& extras = {})
{
    Doc doc;
    const Json shape = ball(doc);
    const auto image = [&](const Bytes& bytes) {
        doc.put("images", {{"bufferView", doc.view(bytes)}, {"mimeType", "image/png"}});
    };
    image(waves());
    image(patches());
    doc.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
    for (int i = 0; i < 8; ++i) {
        Json material = {{"pbrMetallicRoughness",
            {{"metallicFactor", i < 4 ? 1.0 : 0.0}, {"roughnessFactor", 0.15 + 0.25 * (i % 4)},
                {"baseColorFactor", {0.9, 0.5, 0.2, 1}}}}};
        if (!extras.is_null())
            material["extras"]["starbow"] = extras;
        if (maps) {
            material["normalTexture"] = {{"index", 0}, {"scale", 0.8}};
            material["occlusionTexture"] = {{"index", 1}};
            if (i % 2) {
                material["pbrMetallicRoughness"]["metallicFactor"] = 1;
                material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 1}};
            }
        }
        Json primitive = shape;
        primitive["material"] = doc.put("materials", material);
        doc.show(primitive);
        Json& node = doc.json["nodes"].back();
        node["name"] = "ball " + std::to_string(i);
        node["translation"] = {2.3 * (i % 4) - 3.45, i < 4 ? 1.2 : -1.2, -9};
        if (i == 3) // a mirrored node
            node["scale"] = {-1, 1, 1};
    }
    return doc;
}

const Json sun = {{"type", "directional"}, {"towards", {-0.4, 0.6, 0.7}}, {"radiance", {0.8, 0.75, 0.7}}};
const Json sky = {{"zenith", {0.1, 0.2, 0.5}}, {"horizon", {0.5, 0.55, 0.6}}, {"nadir", {0.2, 0.15, 0.1}}};

struct Case {
    const char* name;
    Doc doc;
    Json scene;
    dvec3 u{0};
    Effects effects{};
    double median, floor_db;
};

void compare(const Case& one)
{
    Json scene = one.scene;
    scene["ambient"] = {0.3, 0.32, 0.35};
    Shot shot = shot_at({0, 0, 0}, one.u, {0, 0, -1});
    shot.effects = one.effects;
    const auto [db, off] = beside_rays(one.doc, scene, one_view(Planar{.fov_y_deg = 50}, {240, 160}), shot, 8, true, 0);
    ASSERT_GT(off.size(), 500u) << one.name;
    std::printf("%s: %.1f dB, light off by %.4f in the middle, %.4f at 9 of 10\n", one.name, db, off[off.size() / 2],
        off[off.size() * 9 / 10]);
    EXPECT_LT(off[off.size() / 2], one.median) << one.name;
    EXPECT_GT(db, one.floor_db) << one.name;
}

// Bounds: the lamps' light is exact; the mirrored sky is that around one direction instead of the sum over the microfacets,
// which is off by some 0.01 where a metal is rough, and more at the balls' rims, which are most of a ball that is far
// ahead. Rims against a black sky have 8 rays a pixel: some 30 dB.
TEST(Gloss, EqualsTheReferenceUnderASunAndASky)
{
    compare({"balls", balls(false), {{"lights", {sun}}, {"sky", sky}}, {}, {}, 0.01, 38});
    compare({"balls at gamma 2", balls(false), {{"lights", {sun}}, {"sky", sky}}, {0.3, 0.2, -1.7}, {}, 0.02, 33});
    compare({"balls in the dark", balls(false), {{"lights", {sun}}}, {}, {}, 0.01, 33});
    compare({"without Doppler", balls(true), {{"lights", {sun}}, {"sky", sky}}, {0, 0, -1}, effects_of(true, false, false),
        0.02, 33});
}

TEST(Gloss, MapsEqualTheReference)
{
    compare({"maps", balls(true), {{"lights", {sun}}, {"sky", sky}}, {}, {}, 0.015, 33});
    compare({"maps at gamma 2", balls(true), {{"lights", {sun}}, {"sky", sky}}, {0, 0, 1.7}, {}, 0.02, 33});
}

TEST(Gloss, MetalHasItsSpectrumAndADielectricsHighlightTheLamps)
{
    const Json warm = {{"type", "point"}, {"position", {2, 4, -4}}, {"distance", 6}, {"radiance", {0.6, 0.6, 0.6}},
        {"temperature_K", 2700}};
    const Json pigment = {{"reflectance", {{400, 0.9}, {500, 0.3}, {580, 0.05}, {640, 0.6}, {700, 0.8}}}};
    compare({"pigments under two lamps", balls(false, pigment), {{"lights", {sun, warm}}}, {}, {}, 0.015, 33});
    compare({"pigments under two lamps, moving", balls(false, pigment), {{"lights", {sun, warm}}}, {0, 0.2, -0.6}, {}, 0.015,
        28});
    const Json infrared = {{"infrared", 0.9}, {"ultraviolet", 0.1}};
    compare({"infrared", balls(true, infrared), {{"lights", {warm}}, {"sky", sky}}, {0, 0, -1.5}, {}, 0.02, 33});
}

TEST(Gloss, MovingBodiesAndMovingLampsShine)
{
    const Json body = {{"name", "pair"}, {"nodes", {"ball 1", "ball 5"}},
        {"worldline", {{{"time", -100}, {"position", {-50, 0, 0}}}, {{"time", 100}, {"position", {50, 0, 0}}}}}};
    compare({"bodies", balls(true), {{"lights", {sun}}, {"sky", sky}, {"bodies", {body}}}, {}, {}, 0.03, 30});
    const Json passing = {{"type", "point"}, {"position", {0, 0, -6}}, {"distance", 5}, {"radiance", {0.7, 0.7, 0.7}},
        {"temperature_K", 4000}, {"body", "lamp"}};
    const Json lamp_body = {{"name", "lamp"}, {"nodes", {"ball 7"}},
        {"worldline", {{{"time", -100}, {"position", {-30, 0, 0}}}, {{"time", 100}, {"position", {30, 0, 0}}}}}};
    compare({"a passing lamp", balls(false), {{"lights", {sun, passing}}, {"bodies", {lamp_body}}}, {}, {}, 0.03, 30});
}

} // namespace
} // namespace starbow::gpu_test::gloss_gpu_test
