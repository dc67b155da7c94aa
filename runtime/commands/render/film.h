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

/// A movie's file and rate.
struct FilmOptions {
    std::string movie;
    long frames_per_s = 30;
};

/// Checks, before anything is drawn, that the movies of a layout's outputs can be made. Throws InputError.
void check_film(const FilmOptions& options, const Layout& layout);

/// The movies of a layout's outputs, a frame after another. An interrupted film goes on with the same command, and begins
/// anew where anything has changed that its frames depend on.
class Filming {
public:
    /// Each output as RGBA8, rows from the top.
    using Pictures = std::vector<std::vector<std::uint8_t>>;

    /// made_from: everything that the frames depend on, beside the files and the program that this class looks at itself.
    /// device: its name. Throws InputError.
    Filming(const FilmOptions& options, const Layout& layout, const std::filesystem::path& scene, const Words& words,
        long frames, const std::string& device, nlohmann::ordered_json made_from);

    /// The next frame: it is drawn unless it is there already. Returns false if somebody has interrupted the film.
    bool take(const std::function<Pictures()>& draw);
    /// Makes the movies of all frames, or reports the interruption. Returns the exit status.
    int finish();

private:
    int report_interruption();

    FilmOptions options_;
    Layout layout_;
    long frames_, next_ = 0, drawn_ = 0;
    MovieFrames kept_;
    std::optional<Progress> progress_{std::in_place};
};

} // namespace starbow
