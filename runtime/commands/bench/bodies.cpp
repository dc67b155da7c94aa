#include "bodies.h"
#include "config/model/shipped.h"
#include "runtime/commands/timing.h"
#include "runtime/render/offscreen.h"
#include "runtime/render/render_context.h"
#include "runtime/world/detail.h"
#include <cstdio>

namespace starbow {
namespace {

struct Case {
    std::string name;
    int bodies = 0;
    bool seen = true;
    std::vector<double> ms{};
    std::unique_ptr<GpuWorld> world{};
    std::unique_ptr<OffscreenRenderer> renderer{};
};

} // namespace

int bench_bodies(int rounds)
{
    Device device(device_options(false));
    Pipelines pipelines(device);
    Layout layout = load_layout(shipped_file("layouts", "desk"));
    layout.outputs[0].size = {800, 600};
    Shot shot = load_shot(shipped_file("shots", "clocks-rest"));
    std::vector<Case> cases;
    cases.push_back({"all at rest"});
    for (int bodies : {1, 2, 4, 8})
        cases.push_back({std::to_string(bodies) + " in view", bodies});
    cases.push_back({"8 out of view", 8, false});
    for (Case& c : cases) {
        SceneFile scene = load_scene_file(shipped_file("scenes", "clocks"));
        // Light as the moving ones need it, also where nothing moves; and no stars.
        scene.stars.reset();
        for (int i = 0; i < c.bodies; ++i) {
            // A clock each, four light-seconds above the others, or behind the visitor, one a little faster than the other.
            Body body{"body " + std::to_string(i), {"case 3", "dial 3", "rim 3"}, {0.02 * (i + 1), 0, 0}, {}, {}};
            body.at = {shot.time - 31, {2.5 * i - 9, 4, c.seen ? 0.0 : 62.0}};
            scene.bodies.push_back(std::move(body));
        }
        World world = load_world(scene.gltf);
        add_detail_levels(world);
        c.world = std::make_unique<GpuWorld>(upload(device, pipelines, std::move(world), scene, {}, SpectralLevel::fine));
        c.renderer = std::make_unique<OffscreenRenderer>(
            device, pipelines, *c.world, layout, default_quality(device, false), false);
        c.renderer->picture(shot); // leaves the target in a known layout
    }
    // In turn within each round, so that whatever else the machine does falls on all alike.
    for (int round = -1; round < rounds; ++round)
        for (Case& c : cases) {
            const Target target = c.renderer->target(0);
            const double ms = milliseconds([&] {
                device.now([&](vk::CommandBuffer commands) {
                    make_writable(commands, target);
                    c.renderer->frame().draw(commands, shot, nullptr, std::span(&target, 1));
                });
            });
            if (round >= 0)
                c.ms.push_back(ms);
        }
    std::printf("%s; clocks at 800x600, all effects on; medians of %d rounds, whole frames\n\n%-16s%12s%12s%10s%14s\n",
        device.properties.deviceName.data(), rounds, "bodies", "ms", "relative", "images", "Mtexels");
    for (const Case& c : cases) {
        const CubeMapPlan& plan = c.renderer->frame().plans()[0];
        std::printf("%-16s%12.2f%12.2f%10zu%14.2f\n", c.name.c_str(), median(c.ms), median(c.ms) / median(cases[0].ms),
            plan.images.size(), plan.texels * 1e-6);
    }
    return 0;
}

} // namespace starbow
