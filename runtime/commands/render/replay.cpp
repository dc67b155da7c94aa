#include "replay.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/shipped.h"
#include "runtime/commands/options/size.h"
#include "runtime/exhibit/replay_renderer.h"
#include "runtime/flight/record_files.h"
#include "runtime/flight/replay.h"
#include "runtime/operation/log.h"
#include "runtime/operation/progress.h"
#include "runtime/render/render_context.h"
#include <charconv>
#include <cstdio>
#include <optional>

namespace starbow {
namespace {

/// The first and the last frame of "A:B".
std::pair<long, long> parse_frames(const std::string& text)
{
    std::pair<long, long> frames{0, std::numeric_limits<long>::max()};
    if (text.empty())
        return frames;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, frames.first);
    if (first.ec == std::errc() && first.ptr != end && *first.ptr == ':') {
        const auto last = std::from_chars(first.ptr + 1, end, frames.second);
        if (last.ec == std::errc() && last.ptr == end && frames.first >= 0 && frames.second >= frames.first)
            return frames;
    }
    throw InputError("--frames " + text
        + " is no range; the first and the last frame, counted from 0, such as 600:659, are "
          "right");
}

} // namespace

int render_replay(const ReplayOptions& options)
{
    if (options.out.empty())
        throw InputError("--out is empty; give the folder for the pictures, such as out/flight");
    const auto [first, last] = parse_frames(options.frames);
    Replay replay(options.replay);
    const RecordHeader& header = replay.header();
    Flown from = find_flown(options.replay, header, options.layout, write_log);
    if (!options.size.empty())
        for (Output& output : from.layout.outputs)
            output.size = parse_size(options.size);
    const std::filesystem::path folder = options.out;
    check_writable(folder / (from.layout.outputs[0].name + ".png"));
    const Pattern pattern = pattern_named(header.pattern);
    RenderContext context(from.scene, device_options(false));
    const SceneFile& scene = context.world.scene;
    OffscreenRenderer renderer(
        context.device, context.pipelines, context.world, from.layout, default_quality(context.device, true), false);
    ReplayRenderer replay_renderer(renderer, pattern, header.exposing, header.start.exposure_ev, header.rules.comfort);
    Typesetter typesetter;
    const Words words = words_in(options.language);
    std::error_code error; // write_png reports it
    std::filesystem::create_directories(folder, error);

    long frame = 0, drawn = 0; // of the frames that were on a screen
    Progress progress;
    fly_again(replay, [&](const RecordEntry& entry, const Flight& flight) {
        replay_renderer.take(entry, flight);
        if (!entry.shown)
            return true;
        const long number = frame++;
        progress.show("frame " + std::to_string(number) + ", " + std::to_string(drawn) + " drawn", replay.part_read());
        if (number < first || number > last || (number - first) % options.every != 0)
            return true;
        std::optional<Panel> panel;
        if (options.hud && flight.hud)
            panel
                = typesetter.draw(readings(flight.ship, scene, flight.effects), words, renderer.frame().views().hud_width());
        const auto pictures = replay_renderer.picture(flight, header.start.scene, panel ? &*panel : nullptr);
        char name[32];
        std::snprintf(name, sizeof name, "-%06ld.png", number);
        for (std::size_t i = 0; i < pictures.size(); ++i)
            write_png(folder / (from.layout.outputs[i].name + name), from.layout.outputs[i].size, pictures[i]);
        ++drawn;
        return true;
    });
    std::printf("%ld of %ld frames drawn into %s; %s\n", drawn, frame, options.out.c_str(), replay.verdict().c_str());
    return replay.differs() || !context.device.complaints.empty() ? 1 : 0;
}

} // namespace starbow
