#include "film.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/scene_file.h"
#include "runtime/commands/interrupt.h"
#include "runtime/images/capture.h"
#include "runtime/operation/record_files.h"
#include "runtime/world/open_scene.h"
#include <algorithm>
#include <charconv>
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

/// The device that the parts of a movie were drawn on, here or into the folders of others. Throws InputError where there
/// is no part.
std::string device_of_parts(const FilmOptions& options)
{
    std::vector<fs::path> folders{MovieFrames::folder_of(options.movie)};
    folders.insert(folders.end(), options.others.begin(), options.others.end());
    for (const fs::path& folder : folders) {
        const auto kept = nlohmann::json::parse(MovieFrames::made_from(folder), nullptr, false);
        if (kept.is_object())
            return kept.value("device", "");
    }
    throw InputError(one_line(folders.front().string()), "",
        "is not a folder of frames, so there is nothing to join; all parts drawn before, or --others with the folders of "
        "their frames, is right");
}

void print_line(const std::string& line) { std::fprintf(stderr, "starbow: %s\n", line.c_str()); }

} // namespace

void check_film(const FilmOptions& options, const Layout& layout)
{
    if (fs::path(options.movie).extension() != ".mp4")
        throw InputError(one_line(options.movie), "", "is not a name of a movie here; one that ends in .mp4 is right");
    for (const Output& output : layout.outputs)
        check_writable(movie_of(options.movie, layout, output.name));
    check_ffmpeg();
}

FilmPart film_part(const std::string& text)
{
    FilmPart part;
    const char* end = text.data() + text.size();
    const auto number = std::from_chars(text.data(), end, part.number);
    if (number.ec == std::errc() && number.ptr != end && *number.ptr == '/') {
        const auto count = std::from_chars(number.ptr + 1, end, part.count);
        if (count.ec == std::errc() && count.ptr == end && part.number >= 1 && part.number <= part.count
            && part.count <= 100'000)
            return part;
    }
    throw InputError("--part " + text + " is not a part; its number and the number of all parts, such as 2/8, are right");
}

Filming::Filming(const FilmOptions& options, const Layout& layout, const fs::path& scene, const Words& words, long frames,
    const std::string& device, nlohmann::ordered_json made_from)
    : options_(options)
    , layout_(layout)
    , frames_(frames)
    , kept_(options.movie,
          line_of(std::move(made_from), options, layout, scene, words, frames,
              options.joins ? device_of_parts(options) : device),
          options.joins || !options.part.whole(), print_line)
{
    catch_interrupts();
}

bool Filming::is_there(long frame) const
{
    return std::ranges::all_of(layout_.outputs, [&](const Output& output) { return kept_.has(output.name, frame); });
}

bool Filming::take(const std::function<Pictures()>& draw)
{
    if (options_.part.has(next_) && !is_there(next_)) {
        progress_->show(
            "frame " + std::to_string(next_) + " of " + std::to_string(frames_), double(next_) / double(frames_));
        if (interrupted())
            return false;
        const Pictures pictures = draw();
        for (std::size_t k = 0; k < pictures.size(); ++k)
            write_png(kept_.file(layout_.outputs[k].name, next_), layout_.outputs[k].size, pictures[k]);
        ++drawn_;
    }
    taken_ += options_.part.has(next_);
    ++next_;
    return true;
}

/// Reports an interruption and returns its exit status.
int Filming::report_interruption()
{
    std::fprintf(stderr, "%sstarbow: %s: interrupted with %ld of %ld frames drawn; the same command goes on from there\n",
        isatty(STDERR_FILENO) ? "\n" : "", one_line(options_.movie).c_str(), taken_,
        (frames_ - options_.part.number) / options_.part.count + 1);
    return 130;
}

int Filming::finish()
{
    progress_.reset();
    if (next_ < frames_)
        return report_interruption();
    const FilmPart& part = options_.part;
    if (drawn_ > 0 && drawn_ < taken_)
        std::printf("%ld frames were there already, %ld more drawn\n", taken_ - drawn_, drawn_);
    if (part.whole())
        return make_movies();
    std::printf(
        "part %ld of %ld: %ld of %ld frames are in %s; once all parts are drawn, the same command with --join instead "
        "of --part makes the movie\n",
        part.number, part.count, taken_, frames_, one_line(kept_.folder().string()).c_str());
    return 0;
}

int Filming::join()
{
    progress_.reset();
    for (const std::string& folder : options_.others)
        kept_.add(folder);
    long missing = 0, first = -1;
    for (long frame = 0; frame < frames_; ++frame)
        if (!is_there(frame)) {
            first = missing == 0 ? frame : first;
            ++missing;
        }
    if (missing > 0)
        throw InputError(kept_.folder().string(), "",
            std::to_string(missing) + " of " + std::to_string(frames_) + " frames are missing, frame "
                + std::to_string(first)
                + " the first of them; all parts drawn, and --join with the folders of those on other disks, is right");
    return make_movies();
}

int Filming::make_movies()
{
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
