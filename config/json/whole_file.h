#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace starbow {

/// A regular file, opened for reading. Nothing else is opened: reading a FIFO, a socket or a device may never end.
class RegularFile {
public:
    explicit RegularFile(const std::filesystem::path& file);
    ~RegularFile();
    RegularFile(const RegularFile&) = delete;
    RegularFile& operator=(const RegularFile&) = delete;

    /// Why there is nothing more to read, as a predicate: "is a folder", "does not exist"; "" while all is well. Of a
    /// missing file it lists the folder, for the nearest names.
    std::string fault() const;
    bool has_fault() const { return !fault_.empty(); }
    std::uintmax_t size() const { return size_; } ///< when it was opened
    /// Fills `bytes` with the next ones and returns their number: fewer at the end of the file, and after a fault.
    std::size_t read(std::span<char> bytes);
    /// Reads all that is left. A file of more than `most` bytes is a fault, found before the first byte is read.
    std::string read_all(std::size_t most);

private:
    int descriptor_ = -1;
    std::uintmax_t size_ = 0;
    std::string fault_;
    std::filesystem::path missing_; ///< that does not exist; empty: it does
};

/// The whole file. Throws InputError "FILE: FAULT; RIGHT is right"; right: "a JSON file".
std::string read_whole(const std::filesystem::path& file, std::size_t most, const std::string& right);

/// Durability of a written file: as the system's cache allows, or safe from a power cut on return.
enum class Durability { of_the_system, fsync };

/// Throws the InputError for a file that can't be written; why: an errno.
[[noreturn]] void refuse_writing(const std::filesystem::path& file, int why);

/// Makes the folder of a file that is about to be written. Where it can't be made, the write says so.
void make_folder_of(const std::filesystem::path& file);

/// Writes the whole file or nothing: no reader of the folder sees a part of it, and the old file stays until then. A link
/// stays a link. Throws InputError.
void write_whole(
    const std::filesystem::path& file, std::span<const unsigned char> bytes, Durability lasting = Durability::of_the_system);

inline void write_whole(
    const std::filesystem::path& file, std::string_view text, Durability lasting = Durability::of_the_system)
{
    write_whole(file, {reinterpret_cast<const unsigned char*>(text.data()), text.size()}, lasting);
}

/// The same for a file of the program's own, in its cache or its state folder, which is made where it is missing. A link
/// in the file's place is replaced, not followed: whoever could write there once would choose what is overwritten.
/// rights: of the new file, before the process's mask takes some.
void write_own(const std::filesystem::path& file, std::span<const std::span<const unsigned char>> parts,
    Durability lasting = Durability::of_the_system, unsigned rights = 0666);

inline void write_own(
    const std::filesystem::path& file, std::string_view text, Durability lasting = Durability::of_the_system)
{
    const std::span<const unsigned char> bytes(reinterpret_cast<const unsigned char*>(text.data()), text.size());
    write_own(file, std::span(&bytes, 1), lasting);
}

/// Opens a file of the user's to write into piece by piece; returns the descriptor. flags: O_APPEND, O_TRUNC or O_EXCL. A
/// missing file is made. Devices that are there are opened, and no write to one waits: it fails with EAGAIN. A folder, a
/// FIFO and a socket are refused. Throws InputError "FILE: FAULT; RIGHT is right".
int open_to_write(const std::filesystem::path& file, int flags, const std::string& right);

} // namespace starbow
