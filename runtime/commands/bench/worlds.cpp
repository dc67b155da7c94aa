#include "worlds.h"
#include "avenue.h"
#include "config/model/shipped.h"
#include "runtime/commands/median.h"
#include "runtime/render/pass_timer.h"
#include "runtime/render/render_context.h"
#include <cstdio>

namespace starbow {
namespace {

struct MovingShot {
    const char *scene, *shot;
};
constexpr MovingShot moving_shots[]
    = {{"gamow", "gamow-cycling"}, {"train", "train-roof"}, {"twins", "twins-meeting"}, {"alice-and-bob", "alice-and-bob"},
        {"solar-system", "earth-10km"}, {"solar-system", "earth-400km"}, {"solar-system", "saturn"}};

double time_shot(const MovingShot& one, int rounds)
{
    RenderContext context(shipped_file("scenes", one.scene), device_options(false));
    const Shot shot = load_shot(shipped_file("shots", one.shot));
    OffscreenRenderer renderer(context.device, context.pipelines, context.world, window_of({800, 600}),
        default_quality(context.device, false), false);
    PassTimer timer(context.device, renderer);
    std::vector<double> frame_ms, update_ms, cubes_ms, warp_ms;
    for (int round = -2; round < rounds; ++round) {
        const double frame = timer.frame(shot), update = timer.update(shot), cubes = timer.cubes(), warp = timer.warp();
        if (round >= 0) {
            frame_ms.push_back(frame), update_ms.push_back(update);
            cubes_ms.push_back(cubes), warp_ms.push_back(warp);
        }
    }
    const CubeMapPlan& plan = renderer.frame().plans()[0];
    std::printf("%-16s%10.1f%10.1f%10.1f%10.1f%10zu%10.2f\n", one.shot, median(frame_ms), median(update_ms),
        median(cubes_ms), median(warp_ms), plan.images.size(), plan.texels * 1e-6);
    std::fflush(stdout);
    return median(frame_ms);
}

} // namespace

std::map<std::string, double> bench_worlds(int rounds)
{
    std::printf("Worlds in which something moves, 800x600, the shots' own effects; medians of %d rounds, milliseconds\n\n"
                "%-16s%10s%10s%10s%10s%10s%10s\n",
        rounds, "", "frame", "plan", "cubes", "warp", "images", "Mtexels");
    std::map<std::string, double> ms;
    for (const MovingShot& one : moving_shots)
        ms[one.shot] = time_shot(one, rounds);
    return ms;
}

} // namespace starbow
