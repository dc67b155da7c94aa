#pragma once
#include "whole_file.h"
#include <array>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace starbow {

// A file that the program keeps for a later start: a header with the file's kind, the key of its content, the lengths of its
// parts and a checksum over all of these and the parts; then the parts. A file of another kind, key or length, and one with
// a wrong bit anywhere, is not read.

/// The name of a cache's file by its content's key.
std::string cache_key(std::uint64_t key, const char* ending);

struct KeptHeader {
    std::array<char, 8> kind{};
    std::uint64_t key = 0;
    std::array<std::uint64_t, 6> sizes{}; ///< of the parts, bytes; the rest is 0
    std::uint64_t sum = 0; ///< of the members above and the parts; another way of summing has another kind
};
static_assert(std::has_unique_object_representations_v<KeptHeader> && sizeof(KeptHeader) == 72);

/// Writes such a file as write_own does. kind: at most 8 letters, of the content's form, too. At most 6 parts. Throws
/// InputError.
void write_kept(const std::filesystem::path& file, std::string_view kind, std::uint64_t key,
    std::initializer_list<std::span<const unsigned char>> parts, unsigned rights = 0666);

/// Reads one. A missing file has parts without bytes, and can't be read.
class KeptFile {
public:
    KeptFile(const std::filesystem::path& file, std::string_view kind, std::uint64_t key);

    /// The bytes of a part, whose sum the file has; 0 where the file can't be read.
    std::uint64_t size(std::size_t part) const { return header_.sizes[part]; }
    /// Fills all parts, and marks the file as just read, so that others are deleted first. Returns false for a file that is
    /// damaged, or has parts of other sizes; what was filled is then to be thrown away.
    bool read(std::initializer_list<std::span<unsigned char>> parts);

private:
    std::filesystem::path name_;
    RegularFile file_;
    KeptHeader header_;
    bool readable_ = false;
};

/// The bytes of a vector's elements, or of an object, as a part of a kept file.
template <class T> std::span<const unsigned char> bytes_of(const std::vector<T>& values)
{
    static_assert(std::is_trivially_copyable_v<T>);
    return {reinterpret_cast<const unsigned char*>(values.data()), values.size() * sizeof(T)};
}
template <class T> std::span<unsigned char> bytes_of(std::vector<T>& values)
{
    static_assert(std::is_trivially_copyable_v<T>);
    return {reinterpret_cast<unsigned char*>(values.data()), values.size() * sizeof(T)};
}
template <class T>
requires std::is_trivially_copyable_v<T> std::span<const unsigned char> bytes_of(const T& value)
{
    return {reinterpret_cast<const unsigned char*>(&value), sizeof value};
}
template <class T>
requires std::is_trivially_copyable_v<T> std::span<unsigned char> bytes_of(T& value)
{
    return {reinterpret_cast<unsigned char*>(&value), sizeof value};
}
inline std::span<const unsigned char> bytes_of(const std::string& text)
{
    return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}
inline std::span<unsigned char> bytes_of(std::string& text)
{
    return {reinterpret_cast<unsigned char*>(text.data()), text.size()};
}

} // namespace starbow
