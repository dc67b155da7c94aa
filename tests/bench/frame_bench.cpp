// Times the processor's work for a frame: cube-map plan, culling, stars, and a step of the flight.
#include "runtime/flight/flight.h"
#include "runtime/plan/cube_map_plan.h"
#include "runtime/plan/cull.h"
#include "runtime/plan/star_cull.h"
#include "shaders/physics/physics.h"
#include "tests/support/boxes.h"
#include "tests/support/speeds.h"
#include "tests/support/view.h"
#include <benchmark/benchmark.h>
#include <random>

namespace starbow {
namespace {

/// The request of one view whose eye flies along -z.
RestFrameRequest looking(const CompiledView& view, double gamma)
{
    const glm::dvec3 u(0, 0, -testing::u_of_gamma(gamma));
    return {{{view.cones.get(), motion_from_world(u, glm::dquat(1, 0, 0, 0))}}, physics::exp_rapidity(glm::length(u))};
}
/// The values of the preset `balanced`.
const Quality quality{.texels_per_pixel = 0.8, .max_texels_per_pixel = 1, .image_cost_texels = 32768};

void plan(benchmark::State& state, const Projection& projection, glm::ivec2 size)
{
    const CompiledView view = testing::view_of(projection, size);
    const std::vector<RestFrameRequest> requests{looking(view, double(state.range(0)))};
    PlanScratch room;
    CubeMapPlan plan;
    for (auto _ : state)
        plan = plan_cube_map(requests, quality, room, std::move(plan));
    state.counters["images"] = double(plan.images.size());
    state.counters["texels a pixel"] = plan.texels / plan.pixels;
}
BENCHMARK_CAPTURE(plan, window, Planar{60}, glm::ivec2(800, 600))->Arg(1)->Arg(4)->Arg(100)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(plan, dome, Fisheye{180, 0}, glm::ivec2(1024, 1024))
    ->Arg(1)
    ->Arg(4)
    ->Arg(100)
    ->Unit(benchmark::kMicrosecond);

void table(benchmark::State& state)
{
    const CompiledView view = testing::view_of(Planar{60}, {800, 600});
    const CubeMapPlan plan = plan_cube_map({looking(view, double(state.range(0)))}, quality);
    const auto table = std::make_unique<shared::TileTable>();
    for (auto _ : state) {
        write_tiles(plan, *table);
        benchmark::ClobberMemory();
    }
}
BENCHMARK(table)->Arg(4)->Arg(100)->Unit(benchmark::kMicrosecond);

/// Culls range(0) boxes around a window's view at gamma 4.
void culling(benchmark::State& state)
{
    const World world = testing::boxes(int(state.range(0)), 7);
    const CompiledView view = testing::view_of(Planar{60}, {800, 600});
    const CubeMapPlan plan = plan_cube_map({looking(view, 4)}, quality);
    EyeEvent eye_event;
    eye_event.cube_from_frame = motion_from_world({0, 0, -testing::u_of_gamma(4)}, glm::dquat(1, 0, 0, 0));
    DrawList list;
    for (auto _ : state)
        list = cull(world, {&eye_event, 1}, plan.images, quality, std::move(list));
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(culling)->RangeMultiplier(10)->Range(100, 10000)->Unit(benchmark::kMicrosecond);

void stars(benchmark::State& state)
{
    std::vector<shared::StarEntry> entries;
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    for (int i = 0; i < state.range(0); ++i)
        entries.push_back(
            {glm::vec4(glm::vec3(glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)))), 5772),
                glm::vec4(1)});
    const std::vector<StarPatch> patches = star_patches(entries);
    const CompiledView view = testing::view_of(Planar{60}, {800, 600});
    const CubeMapPlan plan = plan_cube_map({looking(view, 4)}, quality);
    std::vector<StarRun> runs;
    for (auto _ : state)
        runs = stars_in(plan.images, patches, glm::dmat3(1), std::move(runs));
    state.counters["patches"] = double(patches.size());
}
BENCHMARK(stars)->Arg(9000)->Arg(1000000)->Unit(benchmark::kMicrosecond);

void flight(benchmark::State& state)
{
    Shot start;
    Flight flight = flight_at(start);
    Controls controls;
    for (auto _ : state)
        flight = step(flight, controls, 16'666'667, {}, 1, start);
}
BENCHMARK(flight)->Unit(benchmark::kMicrosecond);

} // namespace
} // namespace starbow
