#pragma once
#include <filesystem>
#include <span>
#include <string_view>

namespace starbow {

/// Durability of a written file: as the system's cache allows, or safe from a power cut on return.
enum class Lasting { as_the_system_likes, power_cut };

/// Throws the InputError for a file that can't be written; why: an errno.
[[noreturn]] void refuse_writing(const std::filesystem::path& file, int why);

/// Writes the whole file or nothing: no reader of the folder sees a part of it, and the old file stays until then. A link
/// stays a link. Throws InputError.
void write_whole(
    const std::filesystem::path& file, std::span<const unsigned char> bytes, Lasting lasting = Lasting::as_the_system_likes);

inline void write_whole(
    const std::filesystem::path& file, std::string_view text, Lasting lasting = Lasting::as_the_system_likes)
{
    write_whole(file, {reinterpret_cast<const unsigned char*>(text.data()), text.size()}, lasting);
}

} // namespace starbow
