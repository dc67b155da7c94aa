#include "film.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/scene_file.h"
#include "runtime/commands/interrupt.h"
#include "runtime/images/capture.h"
#include "runtime/operation/record_files.h"
#include "runtime/world/open_scene.h"
#include <cstdio>
#include <unistd.h>
#include <utility>

namespace starbow {
namespace {

namespace fs = std::filesystem;

/// The movie's file of one output: with several outputs each has its own.
fs::path movie_of(const fs::path& movie, const Layout& layout, const std::string& output)
{
    if (layout.outputs.size() == 1)
        return movie;
    return movie.parent_path() / (movie.stem().string() + "-" + output + movie.extension().string());
}

/// Everything that the frames depend on as one line: equal lines mean equal frames.
std::string line_of(nlohmann::ordered_json json, const FilmOptions& options, const Layout& layout, const fs::path& scene,
    const Words& words, long frames, const std::string& device)
{
    std::error_code error;
    json["language"] = words.language;
    json["frames"] = frames;
    json["frames_per_s"] = options.frames_per_s;
    json["words"] = shown_digest(digest_of({words.file}));
    json["scene"] = shown_digest(digest_of({scene, open_scene(scene).gltf}));
    json["layout"] = shown_digest(digest_of(files_of(layout)));
    for (const Output& output : layout.outputs)
        json["sizes"].push_back(std::to_string(output.size.x) + "x" + std::to_string(output.size.y));
    json["device"] = device;
    json["program"] = shown_digest(digest_of({fs::read_symlink("/proc/self/exe", error)}));
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void print_line(const std::string& line) { std::fprintf(stderr, "starbow: %s\n", line.c_str()); }

} // namespace

void check_film(const FilmOptions& options, const Layout& layout)
{
    if (fs::path(options.movie).extension() != ".mp4")
        throw InputError(one_line(options.movie), "", "is no name of a movie here; one that ends in .mp4 is right");
    for (const Output& output : layout.outputs)
        check_writable(movie_of(options.movie, layout, output.name));
    check_ffmpeg();
}

Filming::Filming(const FilmOptions& options, const Layout& layout, const fs::path& scene, const Words& words, long frames,
    const std::string& device, nlohmann::ordered_json made_from)
    : options_(options)
    , layout_(layout)
    , frames_(frames)
    , kept_(options.movie, line_of(std::move(made_from), options, layout, scene, words, frames, device), print_line)
{
    catch_interrupts();
}

bool Filming::take(const std::function<Pictures()>& draw)
{
    bool there = true;
    for (const Output& output : layout_.outputs)
        there = there && kept_.has(output.name, next_);
    if (!there) {
        progress_->show(
            "frame " + std::to_string(next_) + " of " + std::to_string(frames_), double(next_) / double(frames_));
        if (interrupted())
            return false;
        const Pictures pictures = draw();
        for (std::size_t k = 0; k < pictures.size(); ++k)
            write_png(kept_.file(layout_.outputs[k].name, next_), layout_.outputs[k].size, pictures[k]);
        ++drawn_;
    }
    ++next_;
    return true;
}

/// Reports an interruption and returns its exit status.
int Filming::report_interruption()
{
    std::fprintf(stderr, "%sstarbow: %s: interrupted with %ld of %ld frames drawn; the same command goes on from there\n",
        isatty(STDERR_FILENO) ? "\n" : "", one_line(options_.movie).c_str(), next_, frames_);
    return 130;
}

int Filming::finish()
{
    progress_.reset();
    if (next_ < frames_)
        return report_interruption();
    if (drawn_ > 0 && drawn_ < frames_)
        std::printf("%ld frames were there already, %ld more drawn\n", frames_ - drawn_, drawn_);
    for (const Output& output : layout_.outputs) {
        const fs::path file = movie_of(options_.movie, layout_, output.name);
        Progress progress;
        progress.show("ffmpeg makes the movie ...", 0);
        try {
            make_movie(file, kept_, output.name, int(options_.frames_per_s));
        } catch (const InputError&) {
            if (!interrupted()) // the interruption stops ffmpeg too
                throw;
            return report_interruption();
        }
        std::printf("%s: %ld frames, %.1f s\n", one_line(file.string()).c_str(), frames_,
            double(frames_) / double(options_.frames_per_s));
    }
    kept_.remove();
    return 0;
}

} // namespace starbow
