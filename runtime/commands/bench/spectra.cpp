#include "spectra.h"
#include "runtime/commands/timing.h"
#include "runtime/render/offscreen.h"
#include "runtime/world/detail.h"
#include "runtime/world/spectral_errors.h"
#include <cmath>
#include <cstdio>

namespace starbow {
std::array<std::array<double, 2>, 3> bench_spectra(RenderContext& context, const Layout& layout, int rounds)
{
    Device& device = context.device;
    Shot shot = context.world.scene.start;
    shot.position.z = -8;
    shot.u = {0, 0, -std::sqrt(15.0)};
    shot.exposure_ev = -3;

    std::vector<GpuWorld> worlds;
    std::vector<OffscreenRenderer> studios;
    worlds.reserve(reflected_numbers.size());
    for (std::size_t level = 0; level < reflected_numbers.size(); ++level) {
        World world = load_world(context.world.scene.gltf);
        add_detail_levels(world);
        worlds.push_back(upload(device, context.pipelines, std::move(world), context.world.scene, {}, SpectralLevel(level)));
        studios.emplace_back(device, context.pipelines, worlds.back(), layout, default_quality(device, false), false);
        studios.back().picture(shot); // leaves the target in a known layout
    }

    // In turn within each round, so that whatever else the machine does falls on all alike.
    std::array<std::array<std::vector<double>, 2>, 3> times;
    for (int round = -1; round < rounds; ++round)
        for (std::size_t level = 0; level < studios.size(); ++level) {
            FrameRenderer& frame = studios[level].frame();
            const Target target = studios[level].target(0);
            frame.update(shot, nullptr);
            for (int pass = 0; pass < 2; ++pass) {
                const double ms = milliseconds([&] {
                    device.now([&](vk::CommandBuffer commands) {
                        if (pass == 0)
                            return frame.draw_cubes(commands);
                        make_writable(commands, target);
                        frame.passes().warp_output(commands, 0, target);
                    });
                });
                if (round >= 0)
                    times[level][std::size_t(pass)].push_back(ms);
            }
        }

    std::printf("\nspectral levels, at gamma 4 without stars; errors on a colour chart under the Sun at D from 1/8 to 8\n"
                "%-16s%10s%10s%10s%10s%22s%12s\n",
        "", "cube, ms", "ratio", "warp, ms", "ratio", "CIEDE2000 med, worst", "luminance");
    std::array<std::array<double, 2>, 3> ratios{};
    for (std::size_t level = 0; level < studios.size(); ++level) {
        double ms[2];
        for (std::size_t pass = 0; pass < 2; ++pass) {
            ms[pass] = median(times[level][pass]);
            ratios[level][pass] = ms[pass] / median(times[0][pass]);
        }
        const SpectralErrors errors = chart_errors(SpectralLevel(level), ChartFields::colours);
        std::printf("%-9s%3d   %11.2f%10.2f%10.2f%10.2f%14.2f%8.2f%10.1f %%\n", spectral_level_names[level],
            reflected_numbers[level], ms[0], ratios[level][0], ms[1], ratios[level][1], errors.median, errors.worst,
            100 * errors.luminance);
    }
    std::printf("%s\n", describe(needed_level(context.world.world, context.world.scene)).c_str());
    return ratios;
}

} // namespace starbow
