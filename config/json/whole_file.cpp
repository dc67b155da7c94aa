#include "whole_file.h"
#include "error.h"
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <unistd.h>

namespace starbow {

void refuse_writing(const std::filesystem::path& file, int why)
{
    throw InputError(
        file.string(), "", std::string("can't be written (") + std::strerror(why) + "); a place for a file is right");
}

void write_whole(const std::filesystem::path& file, std::span<const unsigned char> bytes, Lasting lasting)
{
    // Renaming would replace a device such as /dev/null, or a link, by a plain file.
    std::error_code problem;
    std::filesystem::path target = std::filesystem::canonical(file, problem);
    if (problem)
        target = file;
    else if (!std::filesystem::is_regular_file(target, problem))
        throw InputError(file.string(), "", "is there and is not a file; a new name or that of a file is right");

    std::filesystem::path part = target;
    part += '.' + std::to_string(getpid()) + ".part";
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(part.c_str(), "wb"), std::fclose);
    if (!stream)
        refuse_writing(file, errno);
    bool good = std::fwrite(bytes.data(), 1, bytes.size(), stream.get()) == bytes.size();
    if (good && lasting == Lasting::power_cut)
        good = std::fflush(stream.get()) == 0 && fsync(fileno(stream.get())) == 0;
    int why = errno;
    if (std::fclose(stream.release()) != 0 && good) // a full disk may be reported only here
        good = false, why = errno;
    if (good && std::rename(part.c_str(), target.c_str()) != 0)
        good = false, why = errno;
    if (!good) {
        std::remove(part.c_str());
        refuse_writing(file, why);
    }
}

} // namespace starbow
