#include "shown.h"
#include "config/json/whole_file.h"
#include "config/model/shipped.h"
#include "runtime/operation/progress.h"
#include "runtime/render/offscreen.h"
#include "runtime/render/render_context.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

namespace starbow {
namespace {

constexpr int dimmest_seen = 13; ///< of 255: 0.0039 of white, above the black of a projector of 1000:1
constexpr double least_shown = 0.8; ///< of what has light, by the range curve

/// Parts of a picture's pixels.
struct Shown {
    double lit = 0, eye = 0, range = 0;
};

/// The pixels of each output that show a view, row by row, and how many these are and have light.
struct ViewPixels {
    std::vector<std::vector<std::size_t>> of_output;
    std::size_t count = 0, lit = 0;
};

ViewPixels view_pixels(OffscreenRenderer& renderer, const Shot& shot)
{
    ViewPixels pixels;
    for (std::size_t output = 0; output < renderer.layout().outputs.size(); ++output) {
        const Channels numbers = renderer.numbers(shot, output);
        const std::vector<float>&red = numbers[0].second, &green = numbers[1].second, &blue = numbers[2].second;
        std::vector<std::size_t>& own = pixels.of_output.emplace_back();
        for (std::size_t at = 0; at < red.size(); ++at) {
            if (std::isnan(red[at]))
                continue; // outside of every viewport and every dome's circle
            own.push_back(at);
            pixels.lit += red[at] != 0 || green[at] != 0 || blue[at] != 0;
        }
        pixels.count += own.size();
    }
    return pixels;
}

double part_above(const std::vector<std::vector<std::uint8_t>>& pictures, const ViewPixels& pixels)
{
    std::size_t above = 0;
    for (std::size_t output = 0; output < pictures.size(); ++output)
        for (const std::size_t at : pixels.of_output[output]) {
            const std::uint8_t* rgb = &pictures[output][4 * at];
            above += std::max({rgb[0], rgb[1], rgb[2]}) > dimmest_seen;
        }
    return double(above) / double(std::max<std::size_t>(pixels.count, 1));
}

Shown shown_by(OffscreenRenderer& renderer, Shot shot)
{
    renderer.frame().range({});
    const ViewPixels pixels = view_pixels(renderer, shot);
    Shown shown{.lit = double(pixels.lit) / double(std::max<std::size_t>(pixels.count, 1))};
    shown.eye = part_above(renderer.picture(shot), pixels);
    renderer.frame().range(renderer.ranged(shot));
    shot.exposure_ev = 0; // of an eye's exposure, the curve has what it needs
    shown.range = part_above(renderer.picture(shot), pixels);
    return shown;
}

} // namespace

int measure_shown(const std::filesystem::path& folder, const Layout& layout, const std::vector<ShotInScene>& shots,
    const Device::Options& options)
{
    std::printf("%-22s %6s %6s %6s   part of %s\n", "shot", "light", "eye", "range", layout.name.c_str());
    std::string table = "| shot | light | eye | range |\n|---|---|---|---|\n";
    Layout alone = layout;
    alone.blend.ramps = false; // where projectors overlap, their light adds up on the screen
    std::unique_ptr<RenderContext> context;
    std::unique_ptr<OffscreenRenderer> renderer;
    std::filesystem::path loaded;
    Progress progress;
    int failures = 0;
    for (std::size_t i = 0; i < shots.size(); ++i) {
        progress.show("drawing " + shots[i].name, double(i) / double(shots.size()));
        if (shots[i].scene != loaded) {
            renderer.reset(), context.reset();
            context = std::make_unique<RenderContext>(shots[i].scene, options);
            renderer = std::make_unique<OffscreenRenderer>(
                context->device, context->pipelines, context->world, alone, default_quality(context->device, false), true);
            loaded = shots[i].scene;
        }
        const Shown shown = shown_by(*renderer, shots[i].shot);
        const bool fails = shown.range < least_shown * shown.lit;
        failures += fails;
        std::array<char, 160> line;
        std::snprintf(line.data(), line.size(), "%-22s %6.2f %6.2f %6.2f%s", shots[i].name.c_str(), shown.lit, shown.eye,
            shown.range, fails ? " FAILS" : "");
        progress.clear();
        std::printf("%s\n", line.data());
        std::fflush(stdout);
        std::snprintf(line.data(), line.size(), "| `%s` | %.2f | %.2f | %.2f |\n", shots[i].name.c_str(), shown.lit,
            shown.eye, shown.range);
        table += line.data();
    }
    if (!folder.empty()) {
        write_whole(folder / "shown.md", table);
        std::printf("%s/shown.md\n", folder.c_str());
    }
    std::printf("by the range curve, %d of these show less than %.0f %% of what has light\n", failures, 100 * least_shown);
    return failures == 0 ? 0 : 1;
}

} // namespace starbow
