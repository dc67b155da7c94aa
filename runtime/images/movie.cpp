#include "movie.h"
#include "config/json/error.h"
#include "config/json/other_program.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include <array>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>
#include <unistd.h>
#include <vector>
#include <zlib.h>

namespace starbow {
namespace fs = std::filesystem;
namespace {

constexpr const char* sources_name = "made-from.json";

std::string text_of(const fs::path& file) { return RegularFile(file).read_all(1 << 20); }

bool is_frame(const fs::path& file)
{
    const std::string name = file.filename().string();
    return name.ends_with(".png") && name.size() > 11 && name[name.size() - 11] == '-'
        && name.find_first_not_of("0123456789", name.size() - 10) == name.size() - 4;
}

/// True for a PNG file without a wrong bit or a missing end: each of its pieces has a checksum. ffmpeg would draw what it
/// can of a damaged one.
bool is_whole_png(const fs::path& file)
{
    constexpr std::string_view begin = "\x89PNG\r\n\x1a\n";
    const std::string text = RegularFile(file).read_all(std::size_t(2) << 30);
    if (!text.starts_with(begin))
        return false;
    const auto* bytes = reinterpret_cast<const unsigned char*>(text.data());
    const auto number = [&](std::size_t at) {
        return std::size_t(bytes[at]) << 24 | std::size_t(bytes[at + 1]) << 16 | std::size_t(bytes[at + 2]) << 8
            | std::size_t(bytes[at + 3]);
    };
    // A piece: the number of its bytes, four letters, the bytes, and the sum of the letters and the bytes.
    for (std::size_t at = begin.size(); text.size() - at >= 12;) {
        const std::size_t count = number(at);
        if (count > text.size() - at - 12 || crc32_z(0, bytes + at + 4, count + 4) != number(at + 8 + count))
            return false;
        const bool end = text.compare(at + 4, 4, "IEND") == 0;
        at += 12 + count;
        if (end)
            return at == text.size();
    }
    return false;
}

/// True where a folder's contents are not ours to touch: it has no sources, nor is it new.
bool is_foreign(const fs::path& folder)
{
    std::error_code error;
    if (!fs::is_directory(folder, error))
        return true;
    bool sources = false, others = false;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        sources = sources || name == sources_name;
        others = others || !name.starts_with(sources_name); // another program may be writing them just now
    }
    return others && !sources;
}

/// Names the first member in which two lines of sources differ.
[[noreturn]] void refuse_sources(const fs::path& folder, const std::string& there, const std::string& here)
{
    using nlohmann::json;
    const json theirs = json::parse(there, nullptr, false), ours = json::parse(here, nullptr, false);
    std::string how = "other sources";
    for (const auto& [name, value] : ours.items())
        if (!theirs.is_object() || theirs.value(name, json()) != value) {
            how = "another \"" + name + "\": " + (theirs.is_object() ? theirs.value(name, json()).dump() : "none")
                + " there, " + value.dump() + " here";
            break;
        }
    throw InputError(folder.string(), "",
        "its frames have " + one_line(how)
            + "; the same files, options, program and kind of GPU for all parts, or another name for the movie, is right");
}

} // namespace

fs::path MovieFrames::folder_of(const fs::path& movie)
{
    fs::path folder = fs::absolute(movie).lexically_normal();
    folder += ".frames";
    return folder;
}

std::string MovieFrames::made_from(const fs::path& folder)
{
    std::error_code error;
    const fs::path sources = folder / sources_name;
    return fs::is_regular_file(sources, error) ? text_of(sources) : "";
}

MovieFrames::MovieFrames(
    const fs::path& movie, const std::string& made_from, bool shared, const std::function<void(const std::string&)>& say)
    : folder_(folder_of(movie))
    , made_from_(made_from)
{
    std::error_code error;
    if (fs::exists(folder_, error)) {
        if (is_foreign(folder_))
            throw InputError(folder_.string(), "",
                "is there and holds no frames of a movie; another name for the movie, or another place for that, is right");
        const std::string before = this->made_from(folder_);
        if (before == made_from)
            return;
        const bool has_sources = fs::exists(folder_ / sources_name, error); // an empty file says nothing of the frames
        if (has_sources && shared)
            refuse_sources(folder_, before, made_from);
        if (has_sources) {
            say(one_line(folder_.string())
                + ": the sources of these frames, or their settings, have changed; the movie begins again");
            remove();
        }
    }
    fs::create_directories(folder_, error);
    if (error)
        throw InputError(
            folder_.string(), "", "can't be made (" + error.message() + "); a place that can be written to is right");
    write_whole(folder_ / sources_name, made_from);
}

void MovieFrames::add(const fs::path& folder) const
{
    const std::string sources = made_from(folder);
    if (sources.empty())
        throw InputError(folder.string(), "",
            "holds no frames of a movie; the folder that a part was drawn into, such as out/tour.mp4.frames, is right");
    if (sources != made_from_)
        refuse_sources(folder, sources, made_from_);
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const fs::path to = folder_ / entry.path().filename();
        if (!is_frame(entry.path()) || is_whole_png(to) || !is_whole_png(entry.path()))
            continue;
        fs::path half = to;
        half += ".part";
        if (fs::copy_file(entry.path(), half, fs::copy_options::overwrite_existing, error))
            fs::rename(half, to, error);
        if (error)
            throw InputError(to.string(), "", "can't be written (" + error.message() + "); room for all frames is right");
    }
}

fs::path MovieFrames::file(const std::string& output, long frame) const
{
    std::array<char, 16> number;
    std::snprintf(number.data(), number.size(), "-%06ld.png", frame);
    return folder_ / (output + number.data());
}

bool MovieFrames::has(const std::string& output, long frame) const { return is_whole_png(file(output, frame)); }

void MovieFrames::remove() const
{
    std::error_code error;
    std::vector<fs::path> ours;
    for (const auto& entry : fs::directory_iterator(folder_, error))
        if (is_frame(entry.path()))
            ours.push_back(entry.path());
    for (const fs::path& file : ours)
        fs::remove(file, error);
    fs::remove(folder_ / sources_name, error);
    fs::remove(folder_, error); // it stays if something else is in it
}

void check_ffmpeg()
{
    const Ended ended = ran({"ffmpeg", "-version"}, "/");
    if (ended.status != 0)
        throw InputError("ffmpeg, which makes movies of pictures, can't be started (" + how(ended)
            + "); Debian's package ffmpeg, installed, is right");
}

void make_movie(const fs::path& movie, const MovieFrames& frames, const std::string& output, int frames_per_s)
{
    std::string pattern; // a % in ffmpeg's pattern begins a number
    for (char c : output)
        pattern += c == '%' ? std::string("%%") : std::string(1, c);
    // Frames are sRGB in full range; movies are Rec. 709 in television range, with even width and height.
    const Ended ended = make_whole(movie, [&](const fs::path& part) {
        return ran(
            {"ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-y", "-framerate", std::to_string(frames_per_s),
                "-start_number", "0", "-i", "file:" + pattern + "-%06d.png", "-vf",
                "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv", "-c:v", "libx264", "-preset",
                "medium", "-crf", "16", "-pix_fmt", "yuv420p", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1",
                "-colorspace", "bt709", "-movflags", "+faststart", "-f", "mp4", "file:" + part.string()},
            frames.folder());
    });
    if (ended.status != 0)
        throw InputError(one_line(movie.string()), "",
            "ffmpeg could not make it (" + how(ended) + "); its frames are kept, and the same command goes on from there");
}

} // namespace starbow
