#include "spectra.h"
#include "avenue.h"
#include "config/model/shipped.h"
#include "runtime/commands/median.h"
#include "runtime/render/pass_timer.h"
#include "runtime/world/spectral_errors.h"
#include <cstdio>
#include <deque>

namespace starbow {

std::array<std::array<double, 2>, 3> bench_spectra(RenderContext& context, const Layout& layout, int rounds)
{
    Device& device = context.device;
    const SceneFile scene = load_scene_file(shipped_file("scenes", "chart")); // more different spectra than coefficients
    const Shot shot = along_avenue(scene.start, 4);

    std::vector<GpuWorld> worlds;
    std::deque<OffscreenRenderer> renderers; // which never moves them
    worlds.reserve(reflected_counts.size());
    for (std::size_t level = 0; level < reflected_counts.size(); ++level) {
        worlds.push_back(upload(device, context.pipelines, load_world(scene), scene, {}, SpectralLevel(level)));
        renderers.emplace_back(device, context.pipelines, worlds.back(), layout, default_quality(device, false), false);
        renderers.back().picture(shot); // warms every cache
    }

    // In turn within each round, so that the machine's other work falls on all alike.
    std::array<std::array<std::vector<double>, 2>, 3> times;
    for (int round = -1; round < rounds; ++round)
        for (std::size_t level = 0; level < renderers.size(); ++level) {
            PassTimer timer(device, renderers[level]);
            timer.update(shot);
            const double ms[2] = {timer.cubes(), timer.warp()};
            for (std::size_t pass = 0; round >= 0 && pass < 2; ++pass)
                times[level][pass].push_back(ms[pass]);
        }

    std::printf("\nspectral levels, the chart at gamma 4; errors on a chart's 18 colours under the Sun at D from 1/8 to 8\n"
                "%-16s%10s%10s%10s%10s%22s%12s\n",
        "", "cube, ms", "ratio", "warp, ms", "ratio", "CIEDE2000 med, worst", "luminance");
    std::array<std::array<double, 2>, 3> ratios{};
    for (std::size_t level = 0; level < renderers.size(); ++level) {
        double ms[2];
        for (std::size_t pass = 0; pass < 2; ++pass) {
            ms[pass] = median(times[level][pass]);
            ratios[level][pass] = ms[pass] / median(times[0][pass]);
        }
        const SpectralErrors errors = chart_errors(SpectralLevel(level));
        std::printf("%-9s%3d   %11.2f%10.2f%10.2f%10.2f%14.2f%8.2f%10.1f %%\n", spectral_level_names[level],
            reflected_counts[level], ms[0], ratios[level][0], ms[1], ratios[level][1], errors.median, errors.worst,
            100 * errors.luminance);
    }
    return ratios;
}

} // namespace starbow
