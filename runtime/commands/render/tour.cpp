#include "tour.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/shipped.h"
#include "runtime/commands/interrupt.h"
#include "runtime/commands/options/size.h"
#include "runtime/exhibit/tour_renderer.h"
#include "runtime/flight/record_files.h"
#include "runtime/flight/tour_film.h"
#include "runtime/images/movie.h"
#include "runtime/operation/progress.h"
#include "runtime/render/offscreen.h"
#include "runtime/render/render_context.h"
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace starbow {
namespace {

namespace fs = std::filesystem;

/// Reports an interruption and returns its exit status.
int report_interruption(const std::string& movie, long drawn, long frames)
{
    std::fprintf(stderr, "%sstarbow: %s: interrupted with %ld of %ld frames drawn; the same command goes on from there\n",
        isatty(STDERR_FILENO) ? "\n" : "", one_line(movie).c_str(), drawn, frames);
    return 130;
}

/// The text that a frame shows over the world.
std::string text_of(const Caption& caption)
{
    std::string all = caption.text;
    for (const std::string& choice : caption.choices)
        all += '\n' + choice;
    return all;
}

/// The movie's file of one output: with several outputs each has its own.
fs::path movie_of(const fs::path& movie, const Layout& layout, const std::string& output)
{
    if (layout.outputs.size() == 1)
        return movie;
    return movie.parent_path() / (movie.stem().string() + "-" + output + movie.extension().string());
}

/// A digest of everything that the frames depend on: equal digests mean equal frames.
std::string made_from(const TourOptions& options, const Show& show, const Words& words, const fs::path& scene,
    const Layout& layout, const std::string& device)
{
    std::uint64_t shown = digest(std::string_view());
    TourFilm film(show, options.frames_per_s);
    for (long i = 0; i < film.frames(); ++i) {
        const Touring& touring = film.at(i);
        const std::uint64_t flight = digest(touring.flight);
        shown = digest({reinterpret_cast<const char*>(&flight), sizeof flight}, shown);
        shown = digest(text_of(caption_of(touring, show, words, {})), shown);
    }
    std::error_code error;
    nlohmann::ordered_json json;
    json["tour"] = show.tour.file.stem().string();
    json["language"] = words.language;
    json["frames"] = film.frames();
    json["frames_per_s"] = options.frames_per_s;
    json["states"] = shown_digest(shown);
    json["words"] = shown_digest(digest_of({words.file}));
    json["scene"] = shown_digest(digest_of({scene, load_scene_file(scene).gltf}));
    json["layout"] = shown_digest(digest_of(files_of(layout)));
    for (const Output& output : layout.outputs)
        json["sizes"].push_back(std::to_string(output.size.x) + "x" + std::to_string(output.size.y));
    json["bloom"] = options.bloom;
    json["device"] = device;
    json["program"] = shown_digest(digest_of({fs::read_symlink("/proc/self/exe", error)}));
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void print_line(const std::string& line) { std::fprintf(stderr, "starbow: %s\n", line.c_str()); }

} // namespace

int render_tour(const TourOptions& options)
{
    if (options.movie.empty())
        throw InputError("--tour is given without --movie; the movie's file, such as out/tour.mp4, is right");
    const fs::path movie = options.movie;
    if (movie.extension() != ".mp4")
        throw InputError(one_line(options.movie), "", "is no name of a movie here; one that ends in .mp4 is right");
    const Words words = words_in(options.language);
    const Tour tour = tour_in(options.tour, words);
    const fs::path scene = scene_of(tour);
    Layout layout = load_layout(shipped_file("layouts", options.layout.empty() ? "desk" : options.layout));
    if (!options.size.empty())
        for (Output& output : layout.outputs)
            output.size = parse_size(options.size);
    for (const Output& output : layout.outputs)
        check_writable(movie_of(movie, layout, output.name));
    check_ffmpeg();
    const Show show{tour, {}, load_scene_file(scene).seconds_per_time_unit(), false};
    TourFilm film(show, options.frames_per_s);
    const long frames = film.frames();
    RenderContext context(scene, device_options(false));
    const std::string device = context.device.name();
    const MovieFrames kept(movie, made_from(options, show, words, scene, layout, device), print_line);

    catch_interrupts();
    OffscreenRenderer renderer(
        context.device, context.pipelines, context.world, layout, default_quality(context.device, true), false);
    renderer.frame().bloom(options.bloom);
    TourRenderer tour_renderer(renderer, show, context.world.scene, words);
    long drawn = 0, found = 0;
    {
        Progress progress;
        for (long i = 0; i < frames; ++i) {
            bool there = true;
            for (const Output& output : layout.outputs)
                there = there && kept.has(output.name, i);
            if (there) {
                ++found;
                continue;
            }
            progress.show("frame " + std::to_string(i) + " of " + std::to_string(frames), double(i) / double(frames));
            if (interrupted())
                return report_interruption(options.movie, i, frames);
            const auto pictures = tour_renderer.picture(film.at(i));
            for (std::size_t k = 0; k < pictures.size(); ++k)
                write_png(kept.file(layout.outputs[k].name, i), layout.outputs[k].size, pictures[k]);
            ++drawn;
        }
    }
    if (found > 0 && drawn > 0)
        std::printf("%ld frames were there already, %ld more drawn\n", found, drawn);
    for (const Output& output : layout.outputs) {
        const fs::path file = movie_of(movie, layout, output.name);
        Progress progress;
        progress.show("ffmpeg makes the movie ...", 0);
        try {
            make_movie(file, kept, output.name, int(options.frames_per_s));
        } catch (const InputError&) {
            if (!interrupted()) // the interruption stops ffmpeg too
                throw;
            return report_interruption(options.movie, frames, frames);
        }
        std::printf("%s: %ld frames, %.1f s\n", one_line(file.string()).c_str(), frames,
            double(frames) / double(options.frames_per_s));
    }
    kept.remove();
    return context.device.complaints.empty() ? 0 : 1;
}

} // namespace starbow
