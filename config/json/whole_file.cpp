#include "whole_file.h"
#include "error.h"
#include "file_name.h"
#include "reader.h"
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

namespace starbow {
namespace {

/// The fault of a place that is no regular file, or "".
std::string fault_of(mode_t mode)
{
    return S_ISREG(mode) ? ""
        : S_ISDIR(mode)  ? "is a folder"
        : S_ISFIFO(mode) ? "is a FIFO, not a file"
        : S_ISSOCK(mode) ? "is a socket, not a file"
                         : "is a device, not a file";
}

/// Writes all parts to an open descriptor; returns 0 or an errno.
int write_parts(int to, std::span<const std::span<const unsigned char>> parts)
{
    for (std::span<const unsigned char> left : parts)
        while (!left.empty()) {
            const ssize_t wrote = ::write(to, left.data(), left.size());
            if (wrote < 0 && errno != EINTR)
                return errno;
            left = left.subspan(std::size_t(std::max<ssize_t>(wrote, 0)));
        }
    return 0;
}

/// Writes a new file beside the target and renames it. Throws InputError about `file`, the target's name for people.
void replace(const std::filesystem::path& file, const std::filesystem::path& target,
    std::span<const std::span<const unsigned char>> parts, Durability lasting, mode_t rights)
{
    std::filesystem::path part = target;
    static std::atomic<unsigned> count; // threads may write the same file
    part += "." + std::to_string(getpid()) + "-" + std::to_string(count++ % 4096) + ".part";
    constexpr int flags = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
    int to = ::open(part.c_str(), flags, rights);
    if (to < 0 && errno == EEXIST && ::unlink(part.c_str()) == 0) // of a process that ended here, or a planted link
        to = ::open(part.c_str(), flags, rights);
    if (to < 0)
        refuse_writing(file, errno);
    int why = write_parts(to, parts);
    if (why == 0 && lasting == Durability::fsync && fsync(to) != 0)
        why = errno;
    if (::close(to) != 0 && why == 0) // a full disk may be reported only here
        why = errno;
    if (why == 0 && std::rename(part.c_str(), target.c_str()) != 0)
        why = errno;
    if (why != 0) {
        ::unlink(part.c_str());
        refuse_writing(file, why);
    }
}

} // namespace

RegularFile::RegularFile(const std::filesystem::path& name)
{
    const std::filesystem::path file = as_stored(name);
    // Opening a device may do something; so its kind is looked at before, and again after, when nobody can exchange it.
    struct stat found { };
    if (stat(file.c_str(), &found) == 0)
        fault_ = fault_of(found.st_mode);
    else if (errno == ENOENT)
        fault_ = "does not exist", missing_ = file;
    else
        fault_ = std::string("can't be opened (") + std::strerror(errno) + ")";
    if (!fault_.empty())
        return;
    descriptor_ = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (descriptor_ < 0 || fstat(descriptor_, &found) != 0)
        fault_ = std::string("can't be opened (") + std::strerror(errno) + ")";
    else
        fault_ = fault_of(found.st_mode);
    size_ = std::uintmax_t(found.st_size);
}

std::string RegularFile::fault() const { return missing_.empty() ? fault_ : fault_ + nearest_names(missing_); }

RegularFile::~RegularFile()
{
    if (descriptor_ >= 0)
        ::close(descriptor_);
}

std::size_t RegularFile::read(std::span<char> bytes)
{
    std::size_t done = 0;
    while (fault_.empty() && done < bytes.size()) {
        const ssize_t got = ::read(descriptor_, bytes.data() + done, bytes.size() - done);
        if (got == 0)
            break;
        if (got > 0)
            done += std::size_t(got);
        else if (errno != EINTR)
            fault_ = std::string("can't be read (") + std::strerror(errno) + ")";
    }
    return done;
}

std::string RegularFile::read_all(std::size_t most)
{
    const auto too_large = [&] {
        fault_ = "is larger than " + (most >> 20 ? std::to_string(most >> 20) + " MiB" : std::to_string(most) + " bytes");
        return std::string();
    };
    if (fault_.empty() && size_ > most)
        return too_large();
    // The kernel's files say that they have no bytes, and any file may grow meanwhile: the end is where reading ends.
    std::string text(std::size_t(size_), '\0');
    std::size_t done = 0;
    for (std::size_t got = 1; got > 0; done += got) {
        if (done == text.size())
            text.resize(done + 4096);
        got = read({text.data() + done, text.size() - done});
        if (done + got > most)
            return too_large();
    }
    text.resize(done);
    return text;
}

std::string read_whole(const std::filesystem::path& file, std::size_t most, const std::string& right)
{
    RegularFile opened(file);
    std::string text = opened.read_all(most);
    if (opened.has_fault())
        throw InputError(one_line(file.string()), "", opened.fault() + "; " + right + " is right");
    return text;
}

void refuse_writing(const std::filesystem::path& file, int why)
{
    throw InputError(
        file.string(), "", std::string("can't be written (") + std::strerror(why) + "); a place for a file is right");
}

void make_folder_of(const std::filesystem::path& file)
{
    std::error_code ignored; // the write reports it
    std::filesystem::create_directories(file.parent_path(), ignored);
}

void write_whole(const std::filesystem::path& file, std::span<const unsigned char> bytes, Durability lasting)
{
    // Renaming would replace a device such as /dev/null, or a link, by a plain file.
    std::error_code problem;
    std::filesystem::path target = std::filesystem::canonical(file, problem);
    if (problem)
        target = file;
    else if (!std::filesystem::is_regular_file(target, problem))
        throw InputError(file.string(), "", "is there and is not a file; a new name or that of a file is right");
    replace(file, target, std::span(&bytes, 1), lasting, 0666);
}

void write_own(const std::filesystem::path& file, std::span<const std::span<const unsigned char>> parts, Durability lasting,
    unsigned rights)
{
    make_folder_of(file);
    replace(file, file, parts, lasting, rights);
}

int open_to_write(const std::filesystem::path& file, int flags, const std::string& right)
{
    const auto refuse = [&](const std::string& fault) {
        throw InputError(one_line(file.string()), "", fault + "; " + right + " is right");
    };
    struct stat found { };
    if (stat(file.c_str(), &found) == 0 && !S_ISCHR(found.st_mode)) {
        if (const std::string fault = fault_of(found.st_mode); !fault.empty())
            refuse(fault);
        if (flags & O_EXCL)
            refuse("is there already");
    } else if (S_ISCHR(found.st_mode)) {
        flags &= ~(O_EXCL | O_TRUNC);
    }
    const int to = ::open(file.c_str(), O_WRONLY | O_CREAT | O_NONBLOCK | O_CLOEXEC | O_NOCTTY | flags, 0644);
    if (to < 0)
        refuse(std::string("can't be written (") + std::strerror(errno) + ")");
    return to;
}

} // namespace starbow
