// The loading of two shipped worlds: gamow's file has the most JSON, avenue's the largest textures.
#include "config/model/scene_file.h"
#include "config/model/shipped.h"
#include "runtime/world/world.h"
#include <benchmark/benchmark.h>

namespace starbow {
namespace {

void load(benchmark::State& state, const char* scene)
{
    const std::filesystem::path file = load_scene_file(shipped_file("scenes", scene)).gltf;
    for (auto _ : state)
        benchmark::DoNotOptimize(load_world(file));
}
BENCHMARK_CAPTURE(load, gamow, "gamow")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(load, avenue, "avenue")->Unit(benchmark::kMillisecond);

} // namespace
} // namespace starbow
