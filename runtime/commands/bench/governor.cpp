#include "governor.h"
#include "avenue.h"
#include "config/model/shipped.h"
#include "runtime/commands/median.h"
#include "runtime/operation/governor.h"
#include "runtime/render/pass_timer.h"
#include "runtime/render/render_context.h"
#include <chrono>
#include <cstdio>
#include <thread>

namespace starbow {

int bench_governor(const std::string& ladder_name, double frame_budget_ms, int seconds)
{
    using Clock = std::chrono::steady_clock;
    const std::vector<PresetLevel> ladder = load_ladder(shipped_file("qualities", ladder_name));
    RenderContext context(shipped_file("scenes", "avenue"), device_options(false), ladder[0].quality.spectra);
    Device& device = context.device;
    const Shot shot = load_shot(shipped_file("shots", "starbow"));
    OffscreenRenderer renderer(
        device, context.pipelines, context.world, window_of({800, 600}), within(device, ladder.back().quality), false);
    renderer.frame().repeatable(false); // as the exhibit flies
    PassTimer timer(device, renderer);
    // Every level once, so that its pipelines are made; and the middle one's time.
    double middle = 0;
    for (std::size_t level = 0; level < ladder.size(); ++level) {
        renderer.frame().adopt(within(device, ladder[level].quality));
        std::vector<double> times;
        for (int i = 0; i < 5; ++i)
            times.push_back(timer.busy(shot, 1));
        if (level == ladder.size() / 2)
            middle = median(times);
    }
    if (frame_budget_ms <= 0)
        frame_budget_ms = 1.5 * middle;
    Governor governor(ladder, frame_budget_ms);
    renderer.frame().adopt(within(device, ladder[governor.level()].quality));
    std::printf(
        "%s; the starbow at 800x600, %.1f ms a frame held over %zu levels, a load that doubles and halves every 5 s\n",
        device.name(), frame_budget_ms, ladder.size());
    const auto began = Clock::now();
    const auto now_s = [&] { return std::chrono::duration<double>(Clock::now() - began).count(); };
    int frames = 0, late = 0, moves = 0, most_moves = 0;
    std::vector<double> moved;
    for (int second = 0; now_s() < seconds;) {
        const auto turn = Clock::now()
            + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(frame_budget_ms / 1000));
        const double ms = timer.busy(shot, int(now_s() / 5) % 2 ? 2 : 1);
        ++frames;
        late += ms > 1.5 * frame_budget_ms;
        if (governor.drawn(now_s(), ms)) {
            renderer.frame().adopt(within(device, ladder[governor.level()].quality));
            ++moves;
            moved.push_back(now_s());
            int near = 0;
            for (double at : moved)
                near += now_s() - at < 1;
            most_moves = std::max(most_moves, near);
        }
        std::this_thread::sleep_until(turn);
        if (int(now_s()) / 5 > second) {
            second = int(now_s()) / 5;
            std::printf(
                "%4d s: level %zu, %d frames, %d late, %d moves\n", 5 * second, governor.level() + 1, frames, late, moves);
            std::fflush(stdout);
        }
    }
    std::printf("%d of %d frames late by more than half a frame (%.2f %%), %d moves, at most %d in a second\n", late, frames,
        100.0 * late / std::max(frames, 1), moves, most_moves);
    return late <= 0.01 * frames && most_moves <= 2 ? 0 : 1;
}

} // namespace starbow
