#include "bodies.h"
#include "avenue.h"
#include "config/model/shipped.h"
#include "runtime/commands/median.h"
#include "runtime/render/pass_timer.h"
#include "runtime/render/render_context.h"
#include "runtime/world/detail.h"
#include <cstdio>

namespace starbow {
namespace {

struct BodiesCase {
    std::string name;
    int bodies = 0;
    bool seen = true;
    std::vector<double> ms{};
    std::unique_ptr<GpuWorld> world{};
    std::unique_ptr<OffscreenRenderer> renderer{};
};

} // namespace

double bench_bodies(int rounds)
{
    Device device(device_options(false));
    Pipelines pipelines(device);
    const Layout layout = window_of({800, 600});
    Shot shot = load_shot(shipped_file("shots", "clocks-rest"));
    std::vector<BodiesCase> cases;
    cases.push_back({"all at rest"});
    for (int bodies : {1, 2, 4, 8})
        cases.push_back({std::to_string(bodies) + " in view", bodies});
    cases.push_back({"8 out of view", 8, false});
    for (BodiesCase& c : cases) {
        SceneFile scene = load_scene_file(shipped_file("scenes", "clocks"));
        // No stars, and below the spectral level of a moving world in all cases: they differ in their bodies alone.
        scene.stars.reset();
        for (int i = 0; i < c.bodies; ++i) {
            // A clock each, four light-seconds above the others, or behind the visitor, one a little faster than the other.
            Body body{"body " + std::to_string(i), {"case 3", "dial 3", "rim 3"}, {0.02 * (i + 1), 0, 0}, {}, {}};
            body.at = {shot.time - 31, {2.5 * i - 9, 4, c.seen ? 0.0 : 62.0}};
            scene.bodies.push_back(std::move(body));
        }
        World world = load_world(scene);
        add_detail_levels(world);
        c.world = std::make_unique<GpuWorld>(upload(device, pipelines, std::move(world), scene, {}, SpectralLevel::fine));
        c.renderer = std::make_unique<OffscreenRenderer>(
            device, pipelines, *c.world, layout, default_quality(device, false), false);
        c.renderer->picture(shot); // warms every cache
    }
    // In turn within each round, so that the machine's other work falls on all alike.
    for (int round = -1; round < rounds; ++round)
        for (BodiesCase& c : cases) {
            const double ms = PassTimer(device, *c.renderer).frame(shot);
            if (round >= 0)
                c.ms.push_back(ms);
        }
    std::printf("%s; clocks at 800x600, all effects on; medians of %d rounds, whole frames\n\n%-16s%12s%12s%10s%14s\n",
        device.name(), rounds, "bodies", "ms", "relative", "images", "Mtexels");
    for (const BodiesCase& c : cases) {
        const CubeMapPlan& plan = c.renderer->frame().plans()[0];
        std::printf("%-16s%12.2f%12.2f%10zu%14.2f\n", c.name.c_str(), median(c.ms), median(c.ms) / median(cases[0].ms),
            plan.images.size(), plan.texels * 1e-6);
    }
    return median(cases[1].ms) / median(cases[0].ms);
}

} // namespace starbow
