#include "replay.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/shipped.h"
#include "runtime/commands/options/size.h"
#include "runtime/exhibit/replay_renderer.h"
#include "runtime/flight/replay.h"
#include "runtime/operation/log.h"
#include "runtime/operation/progress.h"
#include "runtime/operation/record_files.h"
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
        + " is not a range; the first and the last frame, counted from 0, such as 600:659, are "
          "right");
}

/// The time of a record's frames, seconds. A stall of the machine before a frame takes none.
double length_s(const std::string& file)
{
    Replay replay(file);
    std::int64_t ns = 0;
    while (const auto entry = replay.next())
        ns += entry->dt_ns;
    return 1e-9 * double(ns);
}

/// A record's pictures off-screen.
class Projector {
public:
    Projector(const ReplayOptions& options, const RecordHeader& header, const Flown& from)
        : hud_(options.hud)
        , information_(options.information)
        , words_(words_in(options.language))
        , start_(header.start)
        , context_(from.scene, device_options(false))
        , renderer_(context_.device, context_.pipelines, context_.world, from.layout, default_quality(context_.device, true),
              false)
        , replay_renderer_(renderer_, pattern_named(header.pattern), header.exposing, header.start.exposure_ev, words_,
              header.rules.comfort)
    {
    }
    void take(const RecordEntry& entry, const Flight& flight) { replay_renderer_.take(entry, flight); }
    Filming::Pictures picture(const Flight& flight)
    {
        std::optional<Panel> panel;
        if (hud_ && flight.hud)
            panel = typesetter_.draw(shown(flight), words_, renderer_.frame().views().hud_width());
        return replay_renderer_.picture(flight, start_.scene, panel ? &*panel : nullptr);
    }
    std::string device() const { return context_.device.name(); }
    bool complains() const { return !context_.device.complaints.empty(); }

private:
    Readings shown(const Flight& flight) const
    {
        const SceneFile& scene = context_.world.scene;
        Readings shown = readings(flight, scene);
        shown.lever = flight.lever, shown.mode = flight.mode, shown.frozen = flight.frozen;
        show_on(information_, start_.time * scene.seconds_per_time_unit(), shown);
        return shown;
    }

    bool hud_;
    Information information_;
    Words words_;
    Shot start_;
    RenderContext context_;
    OffscreenRenderer renderer_;
    ReplayRenderer replay_renderer_;
    Typesetter typesetter_;
};

/// Frames at an even rate: each shows the record's frame of its time.
int film_replay(const ReplayOptions& options, Replay& replay, const Flown& from)
{
    check_film(options.film, from.layout);
    const auto rate = double(options.film.frames_per_s);
    const long frames = std::max(1L, long(length_s(options.replay) * rate));
    const Words words = words_in(options.language);
    const auto film_on = [&](const std::string& device) {
        return Filming(options.film, from.layout, from.scene, words, frames, device,
            {{"record", shown_digest(digest_of({options.replay}))}, {"hud", options.hud},
                {"information", name_of(options.information)}});
    };
    if (options.film.joins)
        return film_on("").join();
    Projector projector(options, replay.header(), from);
    Filming film = film_on(projector.device());
    std::int64_t until_ns = 0;
    long number = 0;
    fly_again(replay, [&](const RecordEntry& entry, const Flight& flight) {
        projector.take(entry, flight);
        until_ns += entry.dt_ns;
        for (; number < frames && double(number) / rate < 1e-9 * double(until_ns); ++number)
            if (!film.take([&] { return projector.picture(flight); }))
                return false;
        return true;
    });
    const int status = film.finish();
    if (status == 0)
        std::printf("%s\n", replay.verdict().c_str());
    return status != 0 ? status : replay.differs() || projector.complains() ? 1 : 0;
}

/// The record's own frames, as they were on a screen.
int draw_frames(const ReplayOptions& options, Replay& replay, const Flown& from)
{
    const auto [first, last] = parse_frames(options.frames);
    const std::filesystem::path folder = options.out;
    check_writable(folder / (from.layout.outputs[0].name + ".png"));
    Projector projector(options, replay.header(), from);
    std::error_code error; // write_png reports it
    std::filesystem::create_directories(folder, error);

    long frame = 0, drawn = 0; // of the frames that were on a screen
    Progress progress;
    fly_again(replay, [&](const RecordEntry& entry, const Flight& flight) {
        projector.take(entry, flight);
        if (!entry.shown)
            return true;
        const long number = frame++;
        progress.show("frame " + std::to_string(number) + ", " + std::to_string(drawn) + " drawn", replay.part_read());
        if (number < first || number > last || (number - first) % options.every != 0)
            return true;
        const Filming::Pictures pictures = projector.picture(flight);
        char name[32];
        std::snprintf(name, sizeof name, "-%06ld.png", number);
        for (std::size_t i = 0; i < pictures.size(); ++i)
            write_png(folder / (from.layout.outputs[i].name + name), from.layout.outputs[i].size, pictures[i]);
        ++drawn;
        return true;
    });
    std::printf("%ld of %ld frames drawn into %s; %s\n", drawn, frame, options.out.c_str(), replay.verdict().c_str());
    return replay.differs() || projector.complains() ? 1 : 0;
}

} // namespace

int render_replay(const ReplayOptions& options)
{
    if (options.film.movie.empty() && options.out.empty())
        throw InputError("--out is empty; give the folder for the pictures, such as out/flight");
    Replay replay(options.replay);
    Flown from = find_flown(options.replay, replay.header(), options.layout, write_log);
    set_size(from.layout, options.size);
    return options.film.movie.empty() ? draw_frames(options, replay, from) : film_replay(options, replay, from);
}

} // namespace starbow
