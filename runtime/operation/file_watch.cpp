#include "file_watch.h"
#include <sys/stat.h>

namespace starbow {

FileWatch::FileWatch(std::vector<std::filesystem::path> files)
    : files_(std::move(files))
    , known_(look())
    , seen_(known_)
{
}

std::optional<std::vector<FileWatch::Stamp>> FileWatch::look() const
{
    std::vector<Stamp> stamps;
    for (const std::filesystem::path& file : files_) {
        struct stat found;
        if (stat(file.c_str(), &found) != 0)
            return {};
        stamps.push_back({.written_s = found.st_mtim.tv_sec,
            .written_ns = found.st_mtim.tv_nsec,
            .size = found.st_size,
            .number = found.st_ino});
    }
    return stamps;
}

bool FileWatch::changed(Clock::time_point now)
{
    if (now - looked_ < std::chrono::milliseconds(100))
        return false;
    looked_ = now;
    const auto stamps = look();
    if (stamps != seen_) {
        seen_ = stamps;
        seen_since_ = now;
    }
    if (seen_ == known_ || now - seen_since_ < std::chrono::milliseconds(seen_ ? 200 : 1000))
        return false;
    known_ = seen_;
    return true;
}

} // namespace starbow
