#pragma once
#include <filesystem>
#include <functional>
#include <string>

namespace starbow {

/// The frames of an unfinished movie: FILE.mp4.frames/ beside it, with a file that names their sources. An interrupted
/// movie continues; one whose sources have changed begins anew.
class MovieFrames {
public:
    /// made_from: everything that the frames depend on, as one line. say: is called with lines for the log. Throws
    /// InputError where the folder can't be made, or the name belongs to something else.
    MovieFrames(const std::filesystem::path& movie, const std::string& made_from,
        const std::function<void(const std::string&)>& say);

    /// The file of a frame of an output.
    std::filesystem::path file(const std::string& output, long frame) const;
    bool has(const std::string& output, long frame) const;
    const std::filesystem::path& folder() const { return folder_; }

    /// Removes the frames, and their folder if it is then empty.
    void remove() const;

private:
    std::filesystem::path folder_;
};

/// Throws InputError, one sentence, where ffmpeg can't be started.
void check_ffmpeg();

/// Makes a movie (H.264) of an output's frames, counted from 0: the whole file or nothing. Throws InputError with ffmpeg's
/// own reason.
void make_movie(const std::filesystem::path& movie, const MovieFrames& frames, const std::string& output, int frames_per_s);

} // namespace starbow
