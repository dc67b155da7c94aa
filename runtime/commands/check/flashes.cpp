#include "flashes.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/angles.h"
#include "config/model/shipped.h"
#include "displays/check/eye_fields.h"
#include "flash_sheet.h"
#include "runtime/commands/interrupt.h"
#include "runtime/exhibit/replay_renderer.h"
#include "runtime/exhibit/tour_renderer.h"
#include "runtime/flight/replay.h"
#include "runtime/flight/tour_film.h"
#include "runtime/images/capture.h"
#include "runtime/light/srgb.h"
#include "runtime/operation/log.h"
#include "runtime/operation/progress.h"
#include "runtime/operation/record_files.h"
#include "runtime/render/render_context.h"
#include "runtime/world/open_scene.h"
#include <cstdio>
#include <functional>
#include <unistd.h>

namespace starbow {
namespace {

/// The measured pictures' pixels are about so wide: 55 of them fill the area that may flash.
constexpr double pixel_deg = 0.6;
/// A tour's frames, as a movie's.
constexpr long frames_per_s = 30;

/// Each pixel is a mean over its square: a pattern that is finer than it is would flicker with each step of a coarse
/// picture, and does not on the exhibit's fine one.
Quality mean_of_pixels(Quality quality)
{
    constexpr int across = 3;
    quality.pixel_rays = across;
    quality.texels_per_pixel = across;
    quality.max_texels_per_pixel = 2 * across * across;
    return quality;
}

using Pictures = std::vector<std::vector<std::uint8_t>>;

std::array<float, 256> light_of_bytes()
{
    std::array<float, 256> light;
    for (std::size_t i = 0; i < light.size(); ++i)
        light[i] = float(light_of_srgb(double(i) / 255));
    return light;
}

/// One eye's counter, and what is drawn of each output for it.
struct Watcher {
    EyeField field;
    FlashCounter counter;
    std::vector<FlashStrip> strips; ///< by output
    std::vector<glm::vec3> light{};

    Watcher(const Layout& seen, EyeField of)
        : field(std::move(of))
        , counter(pixels_of(field), int(seen.outputs.size()))
        , strips(seen.outputs.size())
        , light(field.pixels.size())
    {
        for (std::size_t i = 0; i < strips.size(); ++i)
            strips[i].title = seen.outputs[i].name + eye_name(field), strips[i].size = seen.outputs[i].size;
    }

    static std::vector<SeenPixel> pixels_of(const EyeField& field)
    {
        std::vector<SeenPixel> pixels;
        for (const EyePixel& pixel : field.pixels)
            pixels.push_back({glm::vec3(pixel.direction), float(pixel.solid_angle_sr), int(pixel.output)});
        return pixels;
    }
    static std::string eye_name(const EyeField& field)
    {
        const std::string eye = field.eye == Eye::left ? ", left eye" : field.eye == Eye::right ? ", right eye" : "";
        return eye
            + (field.observer.at_rest                      ? ", observer at rest"
                    : field.observer == ViewportObserver{} ? ""
                                                           : ", passing observer");
    }
    bool shows(std::size_t output) const
    {
        return std::ranges::any_of(field.pixels, [&](const EyePixel& pixel) { return pixel.output == output; });
    }

    void take(std::int64_t time_ns, const Pictures& pictures)
    {
        static const std::array<float, 256> light_of = light_of_bytes();
        for (std::size_t i = 0; i < light.size(); ++i) {
            const EyePixel& pixel = field.pixels[i];
            const int wide = strips[pixel.output].size.x;
            const std::uint8_t* at
                = &pictures[pixel.output][4 * (std::size_t(pixel.at.y) * std::size_t(wide) + std::size_t(pixel.at.x))];
            const glm::dvec3 shown(light_of[at[0]], light_of[at[1]], light_of[at[2]]);
            light[i] = glm::vec3(glm::clamp((shown - pixel.addend) / pixel.factor, 0.0, 1.0));
        }
        counter.take(time_ns, light);
        for (std::size_t output = 0; output < strips.size(); ++output) {
            FlashStrip& strip = strips[output];
            strip.times_s.push_back(1e-9 * double(time_ns));
            for (const FlashKind kind : {FlashKind::general, FlashKind::red}) {
                strip.changes[std::size_t(kind)].push_back(counter.now(kind, int(output)).changes);
                const Flashes& worst = counter.worst(kind, int(output));
                Flashes& known = strip.worst[std::size_t(kind)];
                const Flashes& other = strip.worst[1 - std::size_t(kind)];
                if (worst == known)
                    continue;
                known = worst;
                if (worst.changes >= other.changes)
                    keep_frame(strip, output, kind, pictures[output]);
            }
            if (strip.frame.empty())
                strip.frame = pictures[output];
        }
    }
    void keep_frame(FlashStrip& strip, std::size_t output, FlashKind kind, const std::vector<std::uint8_t>& picture) const
    {
        const Flashes& worst = strip.worst[std::size_t(kind)];
        strip.frame = picture;
        strip.flashing.assign(std::size_t(strip.size.x) * std::size_t(strip.size.y), 0);
        for (std::size_t i = 0; i < field.pixels.size(); ++i) {
            const EyePixel& pixel = field.pixels[i];
            if (pixel.output == output && counter.changes(kind)[i] >= worst.changes
                && angle_between(pixel.direction, worst.field) <= 0.5 * flash_field_deg * degree)
                strip.flashing[std::size_t(pixel.at.y) * std::size_t(strip.size.x) + std::size_t(pixel.at.x)] = 1;
        }
    }
};

std::string described(const char* name, const Flashes& worst)
{
    if (worst.changes == 0)
        return std::string(name) + " 0";
    char text[120];
    std::snprintf(text, sizeof text, "%s %.1f, over %.4f sr, at %.2f s", name, worst.flashes(), worst.area_sr,
        1e-9 * double(worst.time_ns));
    return text;
}

/// What is measured, opened.
struct Film {
    std::string name; ///< for files
    std::filesystem::path scene;
    Layout layout; ///< as its eyes see it
};

/// Draws all frames and hands them on. Returns false where it was interrupted.
using Draw
    = std::function<bool(OffscreenRenderer&, const GpuWorld&, const std::function<void(std::int64_t, const Pictures&)>&)>;

int measure(const FlashOptions& options, const Film& film, const Draw& draw)
{
    const std::filesystem::path file = options.out.empty() ? film.name + "-flashes.png" : options.out;
    check_ending(file, ".png");
    check_writable(file);
    std::vector<Watcher> watchers;
    for (EyeField& field : eye_fields(film.layout))
        watchers.emplace_back(film.layout, std::move(field));
    catch_interrupts();
    RenderContext context(film.scene, device_options(false));
    OffscreenRenderer renderer(context.device, context.pipelines, context.world, film.layout,
        mean_of_pixels(default_quality(context.device, true)), false);
    const bool whole = draw(renderer, context.world, [&](std::int64_t time_ns, const Pictures& pictures) {
        for (Watcher& watcher : watchers)
            watcher.take(time_ns, pictures);
    });
    if (!whole) {
        std::fprintf(stderr, "%sstarbow: interrupted; nothing is written\n", isatty(STDERR_FILENO) ? "\n" : "");
        return 130;
    }
    std::vector<FlashStrip> strips;
    bool breaks = false;
    for (Watcher& watcher : watchers)
        for (std::size_t output = 0; output < watcher.strips.size(); ++output) {
            if (!watcher.shows(output))
                continue;
            FlashStrip& strip = watcher.strips[output];
            const Flashes &general = strip.worst[0], &red = strip.worst[1];
            const bool too_many = general.breaks_limit() || red.breaks_limit();
            breaks = breaks || too_many;
            strip.title += ": most flashes in a second: " + described("general", general) + "; " + described("red", red)
                + (too_many ? " -- more than allowed" : "");
            std::printf("%s\n", strip.title.c_str());
            strips.push_back(std::move(strip));
        }
    std::error_code error; // write_png reports it
    if (file.has_parent_path())
        std::filesystem::create_directories(file.parent_path(), error);
    write_flash_sheet(file, strips);
    std::printf(
        "%s: at most %d flashes in any second may fill more than %.3f sr of a field of %.0f degrees (WCAG 2.3.1); %s\n%s\n",
        one_line(film.name).c_str(), most_flashes, flash_area_sr, flash_field_deg,
        breaks ? "this exceeds that limit" : "this keeps to that limit", file.c_str());
    return breaks || !context.device.complaints.empty() ? 1 : 0;
}

int measure_tour(const FlashOptions& options)
{
    const Words words = words_in("en");
    const Layout layout = load_layout(shipped_file("layouts", options.layout.empty() ? "desk" : options.layout));
    const Tour tour = seen_on(tour_in(options.film, words), layout.surrounds);
    const Film film{tour.file.stem().string(), scene_of(tour), seen_layout(layout, pixel_deg * degree)};
    const SceneFile scene = open_scene(film.scene);
    check_highlights(tour, scene);
    const Show show{tour, {}, scene.seconds_per_time_unit(), false};
    return measure(options, film, [&](OffscreenRenderer& renderer, const GpuWorld& world, const auto& take) {
        TourFilm frames(show, frames_per_s);
        TourRenderer pictures(renderer, show, world, words);
        if (options.mode == "range")
            pictures.range(1.0 / double(frames_per_s));
        Progress progress;
        for (long i = 0; i < frames.frames() && !interrupted(); ++i) {
            progress.show("frame " + std::to_string(i) + " of " + std::to_string(frames.frames()),
                double(i) / double(frames.frames()));
            take(frames.time_ns(i), pictures.picture(frames.at(i)));
        }
        return !interrupted();
    });
}

int measure_record(const FlashOptions& options)
{
    Replay replay(options.film);
    const RecordHeader& header = replay.header();
    const Flown from = find_flown(options.film, header, options.layout, write_log);
    const Film film{
        std::filesystem::path(options.film).stem().string(), from.scene, seen_layout(from.layout, pixel_deg * degree)};
    const Words words = words_in("en");
    return measure(options, film, [&](OffscreenRenderer& renderer, const GpuWorld& world, const auto& take) {
        ReplayRenderer pictures(
            renderer, pattern_named(header.pattern), header.exposing, header.start.exposure_ev, words, header.rules.comfort);
        const Typesetter typesetter;
        Progress progress;
        long frame = 0;
        fly_again(replay, [&](const RecordEntry& entry, const Flight& flight) {
            pictures.take(entry, flight);
            if (!entry.shown)
                return !interrupted();
            progress.show("frame " + std::to_string(frame++), replay.part_read());
            std::optional<Panel> panel;
            if (flight.hud)
                panel = typesetter.draw(readings(flight, world.scene), words, renderer.frame().views().hud_width());
            take(entry.controls.time_ns, pictures.picture(flight, header.start.scene, panel ? &*panel : nullptr));
            return !interrupted();
        });
        return !interrupted();
    });
}

} // namespace

int check_flashes(const FlashOptions& options)
{
    if (options.mode != "eye" && options.film.ends_with(".jsonl"))
        throw InputError("--exposure-mode is for a tour, and a record has its own; a tour is right");
    return options.film.ends_with(".jsonl") ? measure_record(options) : measure_tour(options);
}

} // namespace starbow
