#include "scaling.h"
#include "avenue.h"
#include "config/model/angles.h"
#include "config/model/shipped.h"
#include "runtime/commands/median.h"
#include "runtime/render/pass_timer.h"
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>

namespace starbow {
namespace {

/// Balls of 960 triangles all over a wall ahead. Together they are always as large: more of them are smaller.
World wall_of_balls(int count)
{
    constexpr int around = 32, down = 16;
    World world;
    world.materials.resize(1);
    for (int j = 0; j <= down; ++j)
        for (int i = 0; i <= around; ++i) {
            const double a = 2 * pi * i / around, b = pi * j / down;
            const glm::vec3 n(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a));
            world.vertices.push_back({n, n, {0, 0}, 0xffffffff});
        }
    for (std::uint32_t j = 0; j < down; ++j)
        for (std::uint32_t i = 0; i < around; ++i) {
            const std::uint32_t at = j * (around + 1) + i, below = at + around + 1;
            if (j > 0)
                world.indices.insert(world.indices.end(), {at, at + 1, below + 1});
            if (j + 1 < down)
                world.indices.insert(world.indices.end(), {at, below + 1, below});
        }
    world.primitives.push_back({0, std::uint32_t(world.indices.size()), 0, 0, {-1, -1, -1}, {1, 1, 1}, {0, 0, 0}, 1, {}});
    std::mt19937 random(7);
    std::uniform_real_distribution<double> one(-1, 1);
    const double radius = 4 / std::sqrt(double(count));
    for (int i = 0; i < count; ++i) {
        const double x = 4 * one(random), y = 3 * one(random), z = -10 + one(random);
        Instance instance{};
        instance.frame_from_local = glm::dmat4(radius);
        instance.frame_from_local[3] = {x, y, z, 1};
        world.instances.push_back(instance);
    }
    return world;
}

struct ScalingCase {
    std::string name;
    double units; ///< pixels, triangles
    std::unique_ptr<GpuWorld> world{}; ///< none: the render context's
    std::unique_ptr<OffscreenRenderer> renderer{};
    std::vector<double> prepare{}, record{}, cube{}, warp{};
};

/// Times cases in turn within each round, so that the machine's other work falls on all alike.
void time_scaling(Device& device, std::vector<ScalingCase>& cases, const Shot& shot, int rounds)
{
    for (ScalingCase& c : cases)
        c.renderer->picture(shot); // warms every cache
    for (int round = -1; round < rounds; ++round)
        for (ScalingCase& c : cases) {
            PassTimer timer(device, *c.renderer);
            double record = 0;
            const double prepare = timer.update(shot), cube = timer.cubes(&record), warp = timer.warp();
            if (round < 0)
                continue;
            c.prepare.push_back(prepare);
            c.record.push_back(record);
            c.cube.push_back(cube);
            c.warp.push_back(warp);
        }
}

void bench_pixels(int rounds)
{
    RenderContext context(shipped_file("scenes", "avenue"), device_options(false));
    const Shot shot = along_avenue(context.world.scene.start, 4);
    std::printf("%s; the avenue at gamma 4, all effects on; medians of %d rounds\n\n%-14s%14s%14s%14s%14s\n",
        context.device.name(), rounds, "Mpixel", "texels/pixel", "cube, ns/px", "warp, ns/px", "frame, ns/px");
    std::vector<ScalingCase> cases;
    for (double pixels : {0.5e6, 1e6, 2e6, 4e6, 8e6, 16e6}) {
        const int height = int(std::sqrt(pixels * 0.75) / 4) * 4, width = height / 3 * 4;
        cases.push_back({"", double(width) * height});
        Quality quality = default_quality(context.device, false);
        quality.max_texels = 1e9; // as fine for all
        cases.back().renderer = std::make_unique<OffscreenRenderer>(
            context.device, context.pipelines, context.world, window_of({width, height}), quality, false);
    }
    time_scaling(context.device, cases, shot, rounds);
    for (const ScalingCase& c : cases) {
        const CubeMapPlan& plan = c.renderer->frame().plans()[0];
        const double cube = median(c.cube) * 1e6 / c.units, warp = median(c.warp) * 1e6 / c.units;
        std::printf("%-14.2f%14.2f%14.2f%14.2f%14.2f\n", c.units * 1e-6, plan.texels / plan.pixels, cube, warp,
            cube + warp + median(c.prepare) * 1e6 / c.units);
    }
}

void bench_triangles(int rounds)
{
    Device device(device_options(false));
    Pipelines pipelines(device);
    SceneFile scene;
    scene.lights = {};
    scene.ambient = glm::dvec3(1);
    const Layout layout = window_of({800, 600});
    std::printf("\nBalls of 960 triangles that fill the same part of the view at rest, without coarser levels\n%-14s%14s%14s"
                "%14s%20s%20s\n",
        "triangles", "sent", "cube, ms", "ns/triangle", "plan and cull, ms", "and record, ms");
    std::vector<ScalingCase> cases;
    for (double triangles : {1e4, 1e5, 1e6, 1e7}) {
        const int count = std::max(1, int(std::lround(triangles / 960)));
        cases.push_back({"", triangles});
        cases.back().world = std::make_unique<GpuWorld>(upload(device, pipelines, wall_of_balls(count), scene));
        cases.back().renderer = std::make_unique<OffscreenRenderer>(
            device, pipelines, *cases.back().world, layout, default_quality(device, false), false);
    }
    Shot shot;
    time_scaling(device, cases, shot, rounds);
    for (const ScalingCase& c : cases) {
        const double sent = double(c.renderer->frame().triangles());
        std::printf("%-14g%14g%14.2f%14.1f%20.3f%20.3f\n", c.units, sent, median(c.cube), median(c.cube) * 1e6 / sent,
            median(c.prepare), median(c.prepare) + median(c.record));
    }
}

} // namespace

void bench_scaling(int rounds)
{
    bench_pixels(rounds);
    std::fflush(stdout);
    bench_triangles(rounds);
}

} // namespace starbow
