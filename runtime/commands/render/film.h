#pragma once
#include "config/model/layout.h"
#include "config/model/words.h"
#include "runtime/images/movie.h"
#include "runtime/operation/progress.h"
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace starbow {

/// One of several parts of a movie, which any machines draw in any order: each count-th frame.
struct FilmPart {
    long number = 1, count = 1; ///< number: from 1 to count
    bool has(long frame) const { return frame % count == number - 1; }
    bool whole() const { return count == 1; }
};

/// "I/N". Throws InputError.
FilmPart film_part(const std::string& text);

/// A movie's file and rate.
struct FilmOptions {
    std::string movie;
    long frames_per_s = 30;
    FilmPart part{}; ///< that is drawn; a movie is only made of the whole
    bool joins = false; ///< the parts are drawn, and the movie is made of them without a device
    std::vector<std::string> others{}; ///< folders of frames that other machines have drawn, to be joined
};

/// Checks, before anything is drawn, that the movies of a layout's outputs can be made. Throws InputError.
void check_film(const FilmOptions& options, const Layout& layout);

/// The movies of a layout's outputs, a frame after another. An interrupted film goes on with the same command, and begins
/// anew where anything has changed that its frames depend on. The same is refused for a part, and where parts are joined.
class Filming {
public:
    /// Each output as RGBA8, rows from the top.
    using Pictures = std::vector<std::vector<std::uint8_t>>;

    /// made_from: everything that the frames depend on, beside the files and the program that this class looks at itself.
    /// device: its name, which joining takes from the frames. Throws InputError.
    Filming(const FilmOptions& options, const Layout& layout, const std::filesystem::path& scene, const Words& words,
        long frames, const std::string& device, nlohmann::ordered_json made_from);

    /// The next frame: it is drawn unless it is there already. Returns false if somebody has interrupted the film.
    bool take(const std::function<Pictures()>& draw);
    /// Makes the movies of all frames, or reports the part, or the interruption. Returns the exit status.
    int finish();
    /// Makes the movies of frames that are all there, in this film's folder and in those of FilmOptions::others. Throws
    /// InputError where some are missing.
    int join();

private:
    bool is_there(long frame) const;
    int report_interruption();
    int make_movies();

    FilmOptions options_;
    Layout layout_;
    long frames_, next_ = 0, taken_ = 0, drawn_ = 0; ///< taken_: of the part
    MovieFrames kept_;
    std::optional<Progress> progress_{std::in_place};
};

} // namespace starbow
