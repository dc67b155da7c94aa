#include "shimmer.h"
#include "config/json/whole_file.h"
#include "config/model/angles.h"
#include "runtime/operation/progress.h"
#include "runtime/reference/reference.h"
#include "runtime/render/offscreen.h"
#include <array>
#include <cmath>
#include <cstdio>

namespace starbow {
namespace {

constexpr std::array presets = {"draft", "balanced", "fine"};

/// A slow motion, frame by frame.
struct SlowMotion {
    std::string what;
    std::vector<Shot> frames;
    /// The bound of each shipped preset for the shot starbow on a desk: 1.5 dB below the least that was measured with
    /// 160x120, 320x240 and 640x480 pixels. It depends on the shot's contrast: 1.5 stops darker and before a bright sky,
    /// most values are 3 to 5 dB higher.
    std::array<double, presets.size()> least_dB;
};

/// Outputs of a frame, each as shown: sRGB, four bytes a pixel.
using Pictures = std::vector<std::vector<std::uint8_t>>;

/// The ship's velocity: heading_deg right of the look in the horizontal plane of the cockpit, and up_deg above it.
glm::dvec3 velocity(const Shot& shot, double rapidity, double heading_deg, double up_deg)
{
    const double right = heading_deg * degree, up = up_deg * degree;
    return shot.ship_from_cockpit
        * (std::sinh(rapidity) * glm::dvec3(std::cos(up) * std::sin(right), std::sin(up), -std::cos(up) * std::cos(right)));
}

std::vector<SlowMotion> motions(const Shot& start)
{
    constexpr int frames = 4;
    const auto each = [&](const std::string& what, std::array<double, presets.size()> least_dB, auto&& change) {
        SlowMotion motion{what, {}, least_dB};
        for (int i = 0; i < frames; ++i) {
            Shot shot = start;
            change(shot, i);
            motion.frames.push_back(shot);
        }
        return motion;
    };
    const auto heading = [](double beta, double from_deg, double step_deg) {
        return [=](Shot& shot, int i) { shot.u = velocity(shot, std::atanh(beta), from_deg + i * step_deg, 20); };
    };
    const auto look = [](double beta) {
        return [=](Shot& shot, int i) {
            shot.u = velocity(shot, std::atanh(beta), 30, 0);
            shot.ship_from_cockpit = shot.ship_from_cockpit * glm::angleAxis(0.05 * i * degree, glm::dvec3(0, 1, 0));
        };
    };
    const auto faster
        = [](double from) { return [=](Shot& shot, int i) { shot.u = velocity(shot, from + 0.0005 * i, 30, 20); }; };
    constexpr std::array<double, presets.size()> unseen = {45, 45, 45}; // what cannot be seen must not be seen
    return {
        each("heading, 70 degrees a frame, 1e-6 c", unseen, heading(1e-6, 10, 70)),
        each("heading, 1 degree a frame, 1e-6 c", unseen, heading(1e-6, 10, 1)),
        each("heading, 0.05 degrees a frame, 0.3 c", {36, 37, 38.5}, heading(0.3, 30, 0.05)),
        each("heading, 0.05 degrees a frame, 0.9 c", {27, 27, 30.5}, heading(0.9, 30, 0.05)),
        each("look, 0.05 degrees a frame, at rest", {30, 32, 33}, look(0)),
        each("look, 0.05 degrees a frame, 0.9 c", {27.5, 27.5, 29}, look(0.9)),
        each("faster by 0.0005 in rapidity a frame, from rest", {32, 37, 40.5}, faster(0)),
        each("the same at 0.3 c", {30, 30, 36}, faster(std::atanh(0.3))),
        each("the same across 0.51 c, where cube maps get other axes", {20, 20.5, 29}, faster(std::log(1.75) - 0.00075)),
        each("the same at 0.9 c", {34, 34, 38}, faster(std::atanh(0.9))),
    };
}

/// The pictures by rays of all frames of all motions.
std::vector<std::vector<Pictures>> truths_of(const Trial& trial, const std::vector<SlowMotion>& all)
{
    const ReferenceWorld world = open_reference_world(trial.scene);
    std::vector<std::vector<Pictures>> truths;
    Progress progress;
    for (const SlowMotion& motion : all) {
        progress.show("by rays: " + motion.what, double(truths.size()) / double(all.size()));
        std::vector<Pictures>& of_motion = truths.emplace_back();
        for (const Shot& shot : motion.frames) {
            Pictures& pictures = of_motion.emplace_back();
            for (std::size_t output = 0; output < trial.layout.outputs.size(); ++output)
                pictures.push_back(shown(reference(world.input(), trial.layout, shot, output, {.samples = trial.samples})));
        }
    }
    return truths;
}

/// The shimmer between the two worst frames, as a ratio of white to it, dB. An error that stays is none. Both pictures are
/// rounded to 8 bits, which by itself gives 53 dB where the pictures move and nothing where they stand still.
double shimmer_dB(const std::vector<Pictures>& live, const std::vector<Pictures>& truth)
{
    double most = 0;
    for (std::size_t frame = 1; frame < live.size(); ++frame) {
        double sum = 0, count = 0;
        for (std::size_t output = 0; output < live[frame].size(); ++output)
            for (std::size_t i = 0; i < live[frame][output].size(); ++i) {
                if (i % 4 == 3)
                    continue;
                const double change = double(live[frame][output][i]) - live[frame - 1][output][i],
                             should = double(truth[frame][output][i]) - truth[frame - 1][output][i];
                sum += (change - should) * (change - should);
                ++count;
            }
        most = std::max(most, sum / count);
    }
    return std::min(99.0, -10 * std::log10(most / (255.0 * 255)));
}

} // namespace

int measure_shimmer(const Trial& trial, const std::vector<Setting>& settings, const Device::Options& options)
{
    const bool bounded = trial.shots[0].first == "starbow" && trial.layout.file.stem() == "desk";
    Shot start = trial.shots[0].second;
    start.u = glm::dvec3(0);
    const std::vector<SlowMotion> all = motions(start);
    const std::vector<std::vector<Pictures>> truths = truths_of(trial, all);
    RenderContext context(trial.scene, options, {});
    std::string markdown = "| shimmer, dB |", rule = "\n|---|";
    std::printf("%-56s", "shimmer, dB");
    std::vector<std::unique_ptr<OffscreenRenderer>> renderers;
    for (const Setting& setting : settings) {
        std::printf(" %14s", setting.name.c_str());
        markdown += " " + setting.name + " |", rule += "---|";
        renderers.push_back(std::make_unique<OffscreenRenderer>(
            context.device, context.pipelines, context.world, trial.layout, within(context.device, setting.quality), false));
        renderers.back()->frame().repeatable(false); // as the exhibit flies
    }
    std::printf("\n");
    markdown += rule + "\n";
    int failures = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        std::printf("%-56s", all[i].what.c_str());
        markdown += "| " + all[i].what + " |";
        for (std::size_t k = 0; k < settings.size(); ++k) {
            std::vector<Pictures> live;
            for (const Shot& shot : all[i].frames)
                live.push_back(renderers[k]->picture(shot));
            const double dB = shimmer_dB(live, truths[i]);
            const bool holds = !bounded || k >= presets.size() || dB >= all[i].least_dB[k];
            failures += !holds;
            std::array<char, 32> cell;
            std::snprintf(cell.data(), cell.size(), "%.1f%s", dB, holds ? "" : " FAILS");
            std::printf(" %14s", cell.data());
            markdown += std::string(" ") + cell.data() + " |";
        }
        std::printf("\n");
        std::fflush(stdout);
        markdown += "\n";
    }
    if (!trial.folder.empty()) {
        write_whole(trial.folder / "shimmer.md", markdown);
        std::printf("%s/shimmer.md\n", trial.folder.c_str());
    }
    std::printf("%d of these fail\n", failures);
    return failures == 0 ? 0 : 1;
}

} // namespace starbow
