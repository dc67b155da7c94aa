#include "counts.h"
#include "avenue.h"
#include "config/model/shipped.h"
#include "runtime/hud/hud.h"
#include "runtime/render/pass_timer.h"
#include <cmath>
#include <cstdio>

namespace starbow {
namespace {

/// The scene from its start at a gamma, along the pilot's line of sight.
Shot ahead(const Shot& start, double gamma)
{
    Shot shot = start;
    shot.u = std::sqrt((gamma - 1) * (gamma + 1)) * (start.ship_from_cockpit * glm::dvec3(0, 0, -1));
    return shot;
}

struct CountedWorld {
    const char *scene, *layout;
    Shot (*shot_at)(const Shot& start, double gamma);
};
constexpr CountedWorld counted_worlds[] = {{"avenue", "desk", along_avenue}, {"gamow", "desk", ahead},
    {"clocks", "desk", ahead}, {"avenue", "dome", along_avenue}, {"avenue", "stereo", along_avenue}};

void count(const CountedWorld& one)
{
    RenderContext context(shipped_file("scenes", one.scene), device_options(false));
    count_commands(context.device);
    OffscreenRenderer renderer(context.device, context.pipelines, context.world,
        load_layout(shipped_file("layouts", one.layout)), default_quality(context.device, false), false);
    renderer.frame().meter(true); // as the exhibit flies
    PassTimer timer(context.device, renderer);
    for (const auto& [name, gamma] : bench_speeds) {
        const Shot shot = one.shot_at(context.world.scene.start, gamma);
        const Panel panel = Typesetter().draw(readings(ship_at(shot), context.world.scene, shot.effects), words_in("en"),
            renderer.frame().views().hud_width());
        timer.counts(shot, &panel); // makes room and pipelines
        const CommandCounts counts = timer.counts(shot, &panel);
        std::printf("%-8s%-8s%-10s", one.scene, one.layout, name);
        for (const std::uint64_t number : counts.of)
            std::printf("%10llu", static_cast<unsigned long long>(number));
        std::printf("\n");
        std::fflush(stdout);
    }
}

} // namespace

void bench_counts()
{
    std::printf("One frame's calls of Vulkan, the default quality, with the meter and the head-up display\n\n%-26s", "");
    for (const std::string_view name : command_count_names) // the last word below, the others above
        std::printf("%10.*s", int(name.find(' ') == name.npos ? 0 : name.find(' ')), name.data());
    std::printf("\n%-26s", "");
    for (const std::string_view name : command_count_names)
        std::printf("%10s", name.substr(name.find(' ') == name.npos ? 0 : name.find(' ') + 1).data());
    std::printf("\n");
    for (const CountedWorld& one : counted_worlds)
        count(one);
}

} // namespace starbow
