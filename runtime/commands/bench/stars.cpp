#include "stars.h"
#include "avenue.h"
#include "config/model/angles.h"
#include "config/model/shipped.h"
#include "runtime/commands/median.h"
#include "runtime/exhibit/callouts.h"
#include "runtime/exhibit/picture_setup.h"
#include "runtime/render/pass_timer.h"
#include "runtime/render/render_context.h"
#include "runtime/world/detail.h"
#include <cmath>
#include <cstdio>
#include <deque>
#include <random>

namespace starbow {
namespace {

/// Evenly all around; four times as many with each magnitude (of an endless even swarm), the faintest of magnitude 12.
std::vector<Star> swarm(int count)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> one(0, 1);
    std::vector<Star> stars;
    for (int i = 0; i < count; ++i) {
        const double z = 2 * one(random) - 1, a = 2 * pi * one(random), across = std::sqrt(1 - z * z);
        const double magnitude = 12 + std::log(1 - one(random)) / std::log(4.0);
        stars.push_back({{across * std::cos(a), across * std::sin(a), z}, magnitude,
            temperature_of(-0.2 + 0.01 * double(random() % 180))});
    }
    return stars;
}

struct StarsCase {
    const char* name;
    GpuWorld world;
    bool names; ///< of the sky, with the constellations' lines
    std::vector<double> ms;
};

} // namespace

void bench_stars(int rounds)
{
    Device device(device_options(false));
    Pipelines pipelines(device);
    const SceneFile scene = load_scene_file(shipped_file("scenes", "avenue"));
    const Layout layout = window_of({800, 600});
    const Words words = words_in("en");
    auto under = [&](const char* name, const std::vector<Star>& stars, bool names = false) {
        World world = load_world(scene);
        add_detail_levels(world);
        return StarsCase{name, upload(device, pipelines, std::move(world), scene, stars), names, {}};
    };
    std::vector<StarsCase> cases;
    cases.push_back(under("no stars", {}));
    std::vector<Star> stars = load_stars(scene.stars.value().catalogue); // the brightest first
    cases.push_back(under("118,216 stars", stars));
    cases.push_back(under("with names", stars, true));
    stars.resize(5'000);
    cases.push_back(under("5,000 of them", stars));
    cases.push_back(under("1,000,000 stars", swarm(1'000'000)));
    std::printf(
        "%s; avenue at 800x600 from above, all effects on; medians of %d rounds, whole frames, milliseconds\n\n%-12s",
        device.name(), rounds, "");
    for (const StarsCase& c : cases)
        std::printf("%26s", c.name);
    for (double gamma : {1.0, 4.0, 100.0}) {
        Shot shot = load_shot(shipped_file("shots", "orion"));
        shot.u = shot.ship_from_cockpit * glm::dvec3(0, 0, -std::sqrt((gamma - 1) * (gamma + 1)));
        shot.exposure_ev = gamma > 1 ? -3 : 0;
        std::deque<PictureSetup> setups; // with the names' letters; a deque never moves them
        std::deque<OffscreenRenderer> renderers;
        for (StarsCase& c : cases) {
            c.ms.clear();
            renderers.emplace_back(device, pipelines, c.world, layout, default_quality(device, false), false);
            if (c.names) {
                PictureState named{.shot = shot};
                name_sky(c.world, "en", named);
                setups.emplace_back().set_up(named, words, renderers.back().frame());
            }
            renderers.back().picture(shot); // warms every cache
        }
        // In turn within each round, so that the machine's other work falls on all alike.
        for (int round = -1; round < rounds; ++round)
            for (std::size_t i = 0; i < cases.size(); ++i) {
                const double ms = PassTimer(device, renderers[i]).frame(shot);
                if (round >= 0)
                    cases[i].ms.push_back(ms);
            }
        std::printf("\ngamma %-6g", gamma);
        for (const StarsCase& c : cases)
            std::printf("%14.2f (x %7.2f)", median(c.ms), median(c.ms) / median(cases[0].ms));
        std::fflush(stdout);
    }
    std::printf("\n");
}

} // namespace starbow
