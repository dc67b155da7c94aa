// Points and lines in the picture: as wide as a pixel at any speed and distance, shifted like all light, and the reference
// beside the live picture.
#include "tests/support/beside_rays.h"

namespace starbow::gpu_test::strokes_gpu_test {
namespace {

/// Adds points, lines, a loop or a strip (glTF's modes 0 to 3) in one colour.
void strokes(Doc& doc, int mode, const std::vector<float>& places, const dvec3& colour, Json node = Json::object())
{
    const int material = unlit(doc, colour);
    doc.show({{"mode", mode}, {"attributes", {{"POSITION", doc.accessor<float>(places, "VEC3")}}}, {"material", material}});
    doc.json["nodes"].back().update(node);
}

/// A small galaxy, a wire model, a loop and a strip around the place (0, 0, -9).
Doc wires()
{
    Doc doc;
    std::vector<float> arms, loop, strip;
    for (int i = 0; i < 150; ++i) {
        const double r = 0.3 + 0.02 * i, a = 0.11 * i * (i % 2 ? 1 : -1);
        arms.insert(arms.end(), {float(r * std::cos(a)), float(0.4 * r * std::sin(a)), float(r * std::sin(a) - 9)});
    }
    for (int i = 0; i < 24; ++i)
        loop.insert(loop.end(), {float(3 * std::cos(0.2618 * i) - 1), float(2 * std::sin(0.2618 * i)), -7});
    for (int i = 0; i < 20; ++i)
        strip.insert(strip.end(), {float(0.4 * i - 4), float(1.5 + 0.5 * (i % 2)), float(-6 - 0.1 * i)});
    strokes(doc, 0, arms, {1, 0.9, 0.6});
    strokes(doc, 2, loop, {0.9, 0.2, 0.2});
    strokes(doc, 3, strip, {0.2, 0.9, 0.3});
    strokes(doc, 1, {-3, -2, -5, 3, -2, -5, 3, -2, -5, 3, -2, -12}, {0.3, 0.4, 1});
    return doc;
}

/// The means of both pictures' light, over white, and the live one's over squares of four pixels beside the reference's.
struct Together {
    dvec3 live{0}, rays{0};
    double squares = 0; ///< root of the mean square of the difference, over that of the reference
};

Together together(const Doc& doc, Json scene, const Layout& layout, const Shot& shot)
{
    testing::write_text("strokes.gltf", doc.text());
    scene["gltf"] = "strokes.gltf", scene["unit_m"] = 299792458;
    const ReferenceWorld world = open_reference_world(testing::write_text("strokes.json", scene.dump()));
    const GpuWorld gpu = upload(device(), pipelines(), load_world(world.scene), world.scene);
    OffscreenRenderer live = renderer(gpu, layout, true);
    const Numbers numbers(live, shot);
    const Reference truth = reference(world.input(), layout, shot, 0, {.samples = 64});
    Together out;
    double off = 0, all = 0;
    constexpr int side = 4;
    for (int y = 0; y + side <= truth.size.y; y += side)
        for (int x = 0; x + side <= truth.size.x; x += side) {
            dvec3 drawn(0), rays(0);
            for (int k = 0; k < side * side; ++k) {
                const int i = (y + k / side) * truth.size.x + x + k % side;
                if (!std::isfinite(numbers.light(i).r))
                    continue; // beyond a dome's rim
                drawn += numbers.light(i), rays += truth.light[0][std::size_t(i)] / truth.exposure;
            }
            off += glm::dot(drawn - rays, drawn - rays), all += glm::dot(rays, rays);
            out.live += drawn, out.rays += rays;
        }
    out.squares = std::sqrt(off / all);
    return out;
}

/// Devices may give lines their width along columns or rows, so that slanting ones are up to 30 % thinner than the rays'
/// lines, and a texel has four samples alone.
void expect_equal(const char* name, const Together& seen)
{
    constexpr double light = 0.2, squares = 0.3;
    std::printf("%s: light %.3f %.3f %.3f times the reference's, squares off by %.3f\n", name, seen.live.r / seen.rays.r,
        seen.live.g / seen.rays.g, seen.live.b / seen.rays.b, seen.squares);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(seen.live[c] / seen.rays[c], 1, light) << name;
    EXPECT_LT(seen.squares, squares) << name;
}

Shot shot_of(const dvec3& u)
{
    Shot shot = shot_at({0, 0, 0}, u);
    shot.effects = {};
    return shot;
}

} // namespace

TEST(Strokes, EqualTheReferenceAtAnySpeed)
{
    const Layout flat = one_view(Planar{.fov_y_deg = 60}, {240, 180});
    expect_equal("at rest", together(wires(), {}, flat, shot_of({0, 0, 0})));
    expect_equal("ahead", together(wires(), {}, flat, shot_of({0, 0, -1.5})));
    expect_equal("backwards", together(wires(), {}, flat, shot_of({0, 0, 0.6})));
    expect_equal("aside", together(wires(), {}, flat, shot_of({0.8, 0.2, -0.3})));
    // A surface that differs from the lines in its topology alone: each has a pipeline of its own.
    Doc both = wires();
    quad(both, {0, 0, -30}, {6, 0, 0}, {0, 6, 0}, unlit(both, {0, 0, 1}));
    expect_equal("before a surface", together(both, {}, flat, shot_of({0, 0, 0})));
}

TEST(Strokes, EqualTheReferenceInADomeForTwoEyesAndWhenTheyMove)
{
    expect_equal("dome", together(wires(), {}, one_view(Fisheye{180, 60}, {240, 240}), shot_of({0.3, 0, -0.8})));
    Layout two = one_view(Planar{.fov_y_deg = 60}, {320, 120});
    two.outputs[0].packing = Packing::side_by_side;
    two.stereo.separation_m = 0.5, two.stereo.hyper_stereo = 299792458;
    expect_equal("two eyes", together(wires(), {}, two, shot_of({0, 0, -0.5})));
    Doc doc;
    strokes(doc, 1, {-2, -1, 0, 2, -1, 0, 2, -1, 0, 2, 1, 0, 2, 1, 0, -2, 1, 0}, {0.9, 0.8, 0.2}, {{"name", "body"}});
    strokes(doc, 0, {0, 0, -8, 1, 1, -8, -1, 1, -8}, {0.9, 0.8, 0.9});
    const Json body = {{"name", "frame"}, {"nodes", {"body"}},
        {"worldline", {{{"time", -100}, {"position", {-50, 0, -9}}}, {{"time", 100}, {"position", {50, 0, -9}}}}}};
    expect_equal("a body of lines",
        together(doc, {{"bodies", {body}}}, one_view(Planar{.fov_y_deg = 60}, {240, 180}), shot_of({0, 0, -0.3})));
}

} // namespace starbow::gpu_test::strokes_gpu_test
