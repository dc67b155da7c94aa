// The cube map's resolution where it matters: straight ahead, straight behind, and across the edges between its images.
#include "config/model/angles.h"
#include "displays/compile/compiled_view.h"
#include "runtime/images/picture_errors.h"
#include "runtime/reference/reference.h"
#include "runtime/world/worldline.h"
#include "shaders/physics/physics.h"
#include "tests/support/small_world.h"

namespace sampling_gpu_test {

using namespace starbow;
using namespace starbow::gpu_test;

namespace {

/// A ball around the eye, painted in ln tan(theta / 2) and in the azimuth about the z axis. There a boost along z is a
/// translation, so that the picture is equally rich at every speed, and an ideal sampling equally good.
World self_similar_world()
{
    constexpr double first = -17, last = 17; // of ln tan(theta / 2): beyond the range that a pixel shows at gamma 1000
    constexpr int steps = 32, sectors = 160; // steps for each e-fold
    World world;
    const int rings = int((last - first) * steps) + 1;
    for (int ring = 0; ring < rings; ++ring)
        for (int sector = 0; sector < sectors; ++sector) {
            const double s = first + double(ring) / steps, azimuth = 2 * pi * sector / sectors;
            const double t = std::exp(s), sine = 2 / (t + 1 / t), cosine = (1 / t - t) / (t + 1 / t);
            const double wave = 0.5 + 0.22 * std::sin(4 * pi * s) + 0.22 * std::sin(10 * azimuth),
                         other = 0.5 + 0.4 * std::sin(3 * azimuth + 2 * pi * s);
            Vertex vertex{};
            vertex.position = glm::vec3(10 * sine * std::cos(azimuth), 10 * sine * std::sin(azimuth), 10 * cosine);
            vertex.normal = -glm::normalize(vertex.position);
            const dvec3 colour(wave, 0.6 * wave + 0.4 * other, other);
            vertex.colour = 0xff000000;
            for (int c = 0; c < 3; ++c)
                vertex.colour |= std::uint32_t(std::lround(255 * colour[c])) << 8 * c;
            world.vertices.push_back(vertex);
        }
    for (int ring = 0; ring + 1 < rings; ++ring)
        for (int sector = 0; sector < sectors; ++sector) {
            const std::uint32_t a = std::uint32_t(ring * sectors + sector),
                                b = std::uint32_t(ring * sectors + (sector + 1) % sectors);
            for (std::uint32_t i : {a, b, b + sectors, a, b + sectors, a + sectors})
                world.indices.push_back(i);
        }
    Material material;
    material.unlit = true;
    material.double_sided = true;
    world.materials = {material};
    world.primitives = {{0, std::uint32_t(world.indices.size()), 0, 0, dvec3(-10), dvec3(10), dvec3(0), 10.01, {}}};
    world.instances = {{glm::dmat4(1), 0}};
    return world;
}

} // namespace

// docs/accuracy.md promises these bounds. A uniform cube map of 2048 texels a side falls from 37 to 7 dB here.
TEST(Sampling, StraightBackAndAheadIsAsGoodAtEverySpeed)
{
    SceneFile scene;
    const World world = self_similar_world();
    const GpuWorld gpu = upload(device(), pipelines(), world, scene);
    World placed = world;
    place_bodies(placed, scene);
    const std::vector<Star> none;
    const Layout layout = one_view(Planar{90}, {256, 256});
    OffscreenRenderer live(device(), pipelines(), gpu, layout, default_quality(device(), false), false);
    for (bool back : {true, false}) {
        double least = 1e9, most = 0;
        for (double gamma :
            starbow::testing::all_cases() ? std::vector{2.0, 4.0, 10.0, 100.0, 1000.0} : std::vector{2.0, 10.0, 1000.0}) {
            const Shot shot = shot_at({}, {0, 0, u_of_gamma(gamma)}, {0, 0, back ? -1.0 : 1.0});
            const auto truth = shown(reference({placed, scene, none}, layout, shot, 0, {.samples = 9}));
            const double dB = psnr_dB({{256, 256}, live.picture(shot)[0]}, {{256, 256}, truth});
            const CubeMapPlan& plan = live.frame().plans()[0];
            std::printf("%s, gamma %g: %.1f dB, %.2f texels a pixel in %zu images\n", back ? "back" : "ahead", gamma, dB,
                plan.texels / plan.pixels, plan.images.size());
            least = std::min(least, dB), most = std::max(most, dB);
        }
        EXPECT_GT(least, back ? 36 : 30);
        if (back) {
            EXPECT_LT(most - least, 2);
        }
    }
}

// Faces, nested images and outputs meet without a seam: between pixels the light changes as the sky does, within 1/255 of
// white. A pixel that shows more than 3 degrees of the sky shows a mean and is left out.
TEST(Sampling, NoSeamOnASmoothSky)
{
    Doc doc;
    gpu_test::quad(doc, dvec3(0, -1e4, 0), dvec3(0.001, 0, 0), dvec3(0, 0, 0.001),
        unlit(doc, dvec3(0.3, 0.2, 0.55))); // a world needs at least one object
    const GpuWorld world = open_world("seams", doc, {{"sky", smooth_sky}});
    for (const char* name : {"desk", "dome", "cave5", "wall3"}) {
        Layout layout = load_layout(starbow::testing::source_dir() / "config/layouts" / (std::string(name) + ".json"));
        for (Output& output : layout.outputs)
            output.size = ivec2(320, 320 * output.size.y / output.size.x);
        OffscreenRenderer live(device(), pipelines(), world, layout, default_quality(device(), false), true);
        for (double gamma :
            starbow::testing::all_cases() ? std::vector{1.0, 1.5, 4.0, 100.0, 1000.0} : std::vector{1.5, 100.0}) {
            int all_compared = 0;
            for (const dvec3& look : {dvec3(0, 0, -1), dvec3(1, 0.2, 0.3), dvec3(0.1, 0, 1)}) {
                const Shot shot = shot_at({}, {0, 0, -u_of_gamma(gamma)}, look);
                for (std::size_t output = 0; output < layout.outputs.size(); ++output) {
                    const gpu_test::Numbers numbers(live, shot, output);
                    double worst = 0;
                    int compared = 0;
                    for (int i = 0; i < numbers.count(); ++i)
                        for (int beside : {i % numbers.size.x + 1 < numbers.size.x ? i + 1 : -1, i + numbers.size.x}) {
                            if (beside < 0 || beside >= numbers.count() || !numbers.shown(i) || !numbers.shown(beside)
                                || between(numbers.world(i), numbers.world(beside)) > 3 * pi / 180)
                                continue;
                            const dvec3 live_step = numbers.light(beside) - numbers.light(i),
                                        step = sky_colour(numbers.world(beside)) - sky_colour(numbers.world(i));
                            for (int k = 0; k < 3; ++k)
                                worst = std::max(worst, std::abs(live_step[k] - step[k]));
                            ++compared;
                        }
                    EXPECT_LT(worst, 1.0 / 255) << name << ", gamma " << gamma << ", output " << output;
                    if (gamma < 10) {
                        EXPECT_GT(compared, 1000) << name << ", gamma " << gamma << ", output " << output;
                    }
                    all_compared += compared;
                }
            }
            // Ahead of a fast ship each pixel shows too much of the sky; the view behind is compared at any speed.
            std::printf("%s, gamma %g: %d pairs\n", name, gamma, all_compared);
            EXPECT_GT(all_compared, 10000) << name << ", gamma " << gamma;
        }
    }
}

} // namespace sampling_gpu_test
