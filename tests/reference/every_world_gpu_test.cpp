// The live picture and its distances compared with the reference in every shipped layout and every world, with clocks,
// bodies, lines and glows.
#include "live_and_rays.h"
#include <map>
#include <set>

namespace every_world_gpu_test {

using namespace starbow;
using namespace starbow::gpu_test;

TEST(LivePicture, ConvergesToTheReferenceInEveryShippedLayout)
{
    const Shot shot = shipped_shot("avenue-gamma4");
    for (const auto& file : starbow::testing::shipped("config/layouts")) {
        // A mirror's rim shows so much in a pixel that the light of a picture of 128 is 1.2 % too much, of 192 0.3 %.
        const Layout layout = starbow::testing::small_layout(file, file.stem() == "mirror" ? 192 : 128);
        std::vector<Bytes> truth;
        for (std::size_t i = 0; i < layout.outputs.size(); ++i)
            truth.push_back(shown(reference(avenue_by_rays().input(), layout, shot, i, {.samples = 8})));
        std::map<double, std::vector<double>> error; // the squares' mean over that of white, by the texels along a pixel
        for (const double texels : {0.6, 2.0, 4.0}) {
            Quality quality = test_quality();
            quality.texels_per_pixel = texels, quality.max_texels_per_pixel = 200;
            OffscreenRenderer live(device(), pipelines(), avenue().world, layout, quality, false);
            const auto pictures = live.picture(shot);
            for (std::size_t i = 0; i < layout.outputs.size(); ++i) {
                ASSERT_EQ(pictures[i].size(), truth[i].size());
                const std::string name = file.stem().string() + ", " + layout.outputs[i].name;
                const double decibels = psnr(pictures[i], truth[i]);
                std::printf("%s: %.2f texels along a pixel: %.2f dB, light %+.2f %%\n", name.c_str(), texels, decibels,
                    100 * (mean_light(pictures[i]) / mean_light(truth[i]) - 1));
                error[texels].push_back(std::pow(10, -decibels / 10));
                EXPECT_NEAR(mean_light(pictures[i]), mean_light(truth[i]), 0.02 * mean_light(truth[i]) + 1e-4) << name;
            }
        }
        // The texels' own error is of second order, a tenth of it at 2 remains; the rest is of the pixel's one ray and of
        // the reference's noise. A picture shifted by one pixel, or another eye's, has at most 20 dB; the noise allows 35.
        for (std::size_t i = 0; i < layout.outputs.size(); ++i) {
            const double rest = error[4][i], coarse = error[0.6][i] - rest, fine = error[2][i] - rest;
            EXPECT_LT(fine, 0.2 * coarse) << file.stem() << ", " << layout.outputs[i].name;
            EXPECT_LT(error[2][i], std::pow(10, -2.9)) << file.stem() << ", " << layout.outputs[i].name;
        }
    }
}

TEST(LivePicture, EqualsTheReferenceInEveryWorld)
{
    // In Gamow's street most light is daylight in the shade of houses, of which the grid shows no details below a metre.
    // The worlds have bodies, clocks, existence intervals, spins, a line, a glow, and pigments under lamps, all
    // Doppler-shifted.
    for (const RayCase& one : {RayCase{"alice-and-bob", 30}, {"train-aboard-long", 30}, {"light-clock-flying", 30},
             {"twins-turn", 28}, {"clocks-passing", 30}, {"gamow-cycling", 28, 0.04}, {"rainbow-line", 30},
             {"warm-wall-4", 30}, {"chart-0.5", 30}})
        expect_live_equals_rays(one);
}

namespace {

/// The part of all pixels whose distance is not within a thousandth of the ray's, at the size for which docs/files.md states
/// it.
double distances_off(const GpuWorld& gpu, const ReferenceWorld& world, const Shot& shot)
{
    const Layout layout = one_view(Planar{.fov_y_deg = 60}, {400, 300});
    OffscreenRenderer live(device(), pipelines(), gpu, layout, measured_quality(default_quality(device(), true)), true);
    const gpu_test::Numbers numbers(live, shot);
    const Reference truth = reference(world.input(), layout, shot, 0, {.samples = 1});
    int off = 0;
    for (int i = 0; i < numbers.count(); ++i) {
        const double ray = truth.numbers[std::size_t(i)].distance;
        off += std::isinf(ray) ? !std::isinf(numbers.depth(i)) : !(std::abs(numbers.depth(i) / ray - 1) < 1e-3);
    }
    return double(off) / numbers.count();
}

} // namespace

// The EXR's distances in every world and at any speed: 99 of 100 pixels. With every case it takes every shot and more
// speeds, otherwise one shot of each world, and of Gamow's street, which has the most edges, one more.
TEST(LivePicture, DistancesAreTheRaysInEveryWorld)
{
    std::set<std::string> left;
    for (const auto& file : starbow::testing::shipped("config/scenes"))
        left.insert(file.stem());
    EXPECT_GE(left.size(), 11u);
    for (const auto& file : starbow::testing::shipped("config/shots")) {
        const bool first = left.erase(load_shot(file).scene) > 0;
        if (!starbow::testing::all_cases() && !first && file.stem() != "gamow-walking")
            continue;
        const Shot shot = load_shot(file);
        const ReferenceWorld world
            = open_reference_world(starbow::testing::source_dir() / "config/scenes" / (shot.scene + ".json"));
        World again = load_world(world.scene);
        add_shadows(again, world.scene, map_cache_folder());
        const GpuWorld gpu = upload(device(), pipelines(), std::move(again), world.scene, world.stars);
        std::vector<Shot> all{shot};
        if (starbow::testing::all_cases())
            for (const double gamma : {1.0, 2.0, 100.0}) {
                all.push_back(shot);
                all.back().u = std::sqrt(gamma * gamma - 1)
                    * (shot.ship_from_cockpit * dvec3(0.2, 0.1, -1) / glm::length(dvec3(0.2, 0.1, -1)));
            }
        for (const Shot& one : all) {
            const double off = distances_off(gpu, world, one);
            std::printf(
                "%s at gamma %.2f: %.2f %% off\n", file.stem().c_str(), std::sqrt(1 + glm::dot(one.u, one.u)), 100 * off);
            EXPECT_LT(off, 0.01) << file.stem();
        }
    }
    EXPECT_EQ(left, std::set<std::string>()) << "worlds without a shot";
}

} // namespace every_world_gpu_test
