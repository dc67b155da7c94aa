#pragma once
#include <filesystem>
#include <span>
#include <string_view>

namespace starbow {

/// Whether a file has to outlast a power cut from the moment it is there.
enum class Lasting { as_the_system_likes, power_cut };

/// Throws the InputError for a file that can't be written; why: an errno.
[[noreturn]] void refuse_writing(const std::filesystem::path& file, int why);

/// The whole file or nothing: a reader of the folder never meets half a one, and what was there before stays until then. A
/// link stays a link. Throws InputError.
void write_whole(
    const std::filesystem::path& file, std::span<const unsigned char> bytes, Lasting lasting = Lasting::as_the_system_likes);

inline void write_whole(
    const std::filesystem::path& file, std::string_view text, Lasting lasting = Lasting::as_the_system_likes)
{
    write_whole(file, {reinterpret_cast<const unsigned char*>(text.data()), text.size()}, lasting);
}

} // namespace starbow
