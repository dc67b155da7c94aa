#pragma once
// The live picture beside the reference: what the tests of one room share.
#include "runtime/images/picture_errors.h"
#include "runtime/light/srgb.h"
#include "runtime/reference/reference.h"
#include "runtime/shadow/add_shadows.h"
#include "tests/support/gpu_environment.h"
#include "tests/support/layouts.h"

namespace starbow::gpu_test {

using Bytes = std::vector<std::uint8_t>;

inline double psnr(const Bytes& a, const Bytes& b)
{
    const ivec2 size(int(a.size() / 4), 1);
    return psnr_dB({size, a}, {size, b});
}

/// The mean light of a picture, over white. Of bytes it would be more where edges are soft, for their curve is concave.
inline double mean_light(const Bytes& a)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (i % 4 < 3)
            sum += light_of_srgb(a[i] / 255.0);
    return sum / (0.75 * double(a.size()));
}

inline Shot shipped_shot(const std::string& name)
{
    return load_shot(starbow::testing::source_dir() / "config/shots" / (name + ".json"));
}

inline const ReferenceWorld& avenue_by_rays()
{
    static const ReferenceWorld world = open_reference_world(starbow::testing::source_dir() / "config/scenes/avenue.json");
    return world;
}

struct RayCase {
    const char* shot;
    double floor_db;
    // 12 coefficients represent shifted pigments mostly within 1 %; fp16 and the table's steps add 0.1 %.
    double light = 0.012;
};

/// A shipped shot's picture, light, D and distances against rays.
inline void expect_live_equals_rays(const RayCase& one)
{
    const Shot shot = shipped_shot(one.shot);
    const auto file = starbow::testing::source_dir() / "config/scenes" / (shot.scene + ".json");
    const ReferenceWorld world = open_reference_world(file);
    World again = load_world(world.scene);
    add_shadows(again, world.scene, map_cache_folder());
    const GpuWorld gpu = upload(device(), pipelines(), std::move(again), world.scene, world.stars);
    const Layout layout = one_view(Planar{.fov_y_deg = 60}, {240, 180});
    OffscreenRenderer live = renderer(gpu, layout, true);
    const Bytes picture = live.picture(shot)[0];
    // Painted stars are finer than a pixel: so many rays for their mean.
    const Reference truth = reference(world.input(), layout, shot, 0, {.samples = world.scene.stars ? 64 : 8});
    std::printf("%s: %.2f dB\n", one.shot, psnr(picture, shown(truth)));
    EXPECT_GT(psnr(picture, shown(truth)), one.floor_db) << one.shot;
    // Light, D and distances are compared by their median, which edges and noise don't affect; for D the 90th percentile
    // holds.
    const gpu_test::Numbers numbers(live, shot);
    std::vector<double> light, D, distance;
    // Stars that are painted on the sky are finer than a texel of the cube map, which spreads them: their light is
    // compared by squares of pixels.
    const int square = world.scene.stars ? 6 : 1;
    for (int y = 0; y + square <= numbers.size.y; y += square)
        for (int x = 0; x + square <= numbers.size.x; x += square) {
            dvec3 drawn(0), rays(0);
            for (int j = 0; j < square * square; ++j) {
                const int i = (y + j / square) * numbers.size.x + x + j % square;
                drawn += numbers.light(i);
                rays += (truth.light[0][std::size_t(i)] - truth.numbers[std::size_t(i)].glare) / truth.exposure;
            }
            light.push_back(glm::length(drawn - rays) / std::max(glm::length(rays), 1e-9));
        }
    for (int i = 0; i < numbers.count(); ++i) {
        const Reference::Numbers& rays_numbers = truth.numbers[std::size_t(i)];
        D.push_back(std::abs(numbers.D(i) / rays_numbers.D - 1));
        distance.push_back(std::isinf(rays_numbers.distance) != std::isinf(numbers.depth(i)) ? 1
                : std::isinf(rays_numbers.distance)                                          ? 0
                                                    : std::abs(numbers.depth(i) / rays_numbers.distance - 1));
        EXPECT_LT(between(numbers.camera(i), rays_numbers.camera), 1e-6);
    }
    auto part = [](std::vector<double>& all, double at) {
        const auto middle = all.begin() + std::ptrdiff_t(at * double(all.size() - 1));
        std::nth_element(all.begin(), middle, all.end());
        return *middle;
    };
    std::printf("   light %.5f D %.2e distance %.5f\n", part(light, 0.5), part(D, 0.9), part(distance, 0.5));
    EXPECT_LT(part(light, 0.5), one.light) << one.shot;
    EXPECT_LT(part(D, 0.9), 1e-4) << one.shot;
    // Distances are interpolated on each surface.
    EXPECT_LT(part(distance, 0.5), 1e-5) << one.shot;
}

} // namespace starbow::gpu_test
