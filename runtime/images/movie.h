#pragma once
#include <filesystem>
#include <functional>
#include <string>

namespace starbow {

/// The frames of an unfinished movie: FILE.mp4.frames/ beside it, with a file that names their sources. An interrupted
/// movie continues; one whose sources have changed begins anew, unless several programs draw it.
class MovieFrames {
public:
    /// made_from: everything that the frames depend on, as one line of JSON. shared: other programs draw frames into the
    /// same folder, or have drawn them, so that other sources are refused. say: is called with lines for the log. Throws
    /// InputError where the folder can't be made, or the name belongs to something else.
    MovieFrames(const std::filesystem::path& movie, const std::string& made_from, bool shared,
        const std::function<void(const std::string&)>& say);

    static std::filesystem::path folder_of(const std::filesystem::path& movie);
    /// The line that a folder of frames was made from; empty where there is none.
    static std::string made_from(const std::filesystem::path& folder);

    /// Copies the whole frames of another folder that this one lacks. Throws InputError where its sources are others.
    void add(const std::filesystem::path& folder) const;

    /// The file of a frame of an output.
    std::filesystem::path file(const std::string& output, long frame) const;
    /// True where the frame's file is there, and whole.
    bool has(const std::string& output, long frame) const;
    const std::filesystem::path& folder() const { return folder_; }

    /// Removes the frames, and their folder if it is then empty.
    void remove() const;

private:
    std::filesystem::path folder_;
    std::string made_from_;
};

/// Throws InputError, one sentence, where ffmpeg can't be started.
void check_ffmpeg();

/// Makes a movie (H.264) of an output's frames, counted from 0: the whole file or nothing. Throws InputError with ffmpeg's
/// own reason.
void make_movie(const std::filesystem::path& movie, const MovieFrames& frames, const std::string& output, int frames_per_s);

} // namespace starbow
