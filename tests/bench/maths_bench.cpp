// Times the formulas in double, direction maps and the reference's rays.
#include "config/model/one_view.h"
#include "config/model/shipped.h"
#include "runtime/reference/reference.h"
#include "shaders/physics/physics.h"
#include "tests/support/speeds.h"
#include "tests/support/view.h"
#include <benchmark/benchmark.h>

namespace starbow {
namespace {

void boost(benchmark::State& state)
{
    const double E = physics::exp_rapidity(testing::u_of_gamma(4));
    glm::dvec3 n = glm::normalize(glm::dvec3(0.3, 0.4, 0.5));
    for (auto _ : state) {
        const auto ray = physics::world_from_camera(n, E, 1 / E);
        benchmark::DoNotOptimize(ray);
        n.x = -n.x;
    }
}
BENCHMARK(boost);

void map(benchmark::State& state)
{
    for (auto _ : state)
        benchmark::DoNotOptimize(testing::view_of(Fisheye{180, 0}, {512, 512}));
    state.SetItemsProcessed(state.iterations() * 512 * 512);
}
BENCHMARK(map)->Unit(benchmark::kMillisecond);

/// Draws the avenue at gamma 4 with one ray a pixel.
void rays(benchmark::State& state)
{
    const ReferenceWorld world = open_reference_world(shipped_file("scenes", "avenue"));
    const Layout layout = one_view(Planar{60}, {80, 60});
    Shot shot;
    shot.position = {0, 0, -8};
    shot.u = {0, 0, -testing::u_of_gamma(4)};
    shot.effects = {};
    for (auto _ : state)
        benchmark::DoNotOptimize(reference(world.input(), layout, shot, 0, {.samples = 1}));
    state.SetItemsProcessed(state.iterations() * 80 * 60);
}
BENCHMARK(rays)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace starbow
