#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

namespace starbow {

/// Throws InputError if a file of this name could not be written. Its folder, or the nearest existing one, may be no folder
/// or not writable, or something other than a file may have the name. Writes nothing; call it before long work.
void check_writable(const std::filesystem::path& file);

/// Throws InputError if writing the file would replace one that is read, by whatever name.
void check_not_read(const std::filesystem::path& file, const std::vector<std::filesystem::path>& read);

/// Throws InputError if the file exists and `force` does not allow replacing it.
void check_free(const std::filesystem::path& file, bool force);

/// Throws InputError unless the file's name ends in `ending`, such as ".png", in capital or small letters.
void check_ending(const std::filesystem::path& file, const std::string& ending);

/// A PNG file's bytes of RGBA8 rows from the top, alpha dropped.
std::vector<unsigned char> png_of(glm::ivec2 size, const std::vector<std::uint8_t>& rgba);

/// Writes RGBA8 rows from the top as PNG, alpha dropped. Written beside and renamed: a failure leaves no half file.
/// Throws InputError where the place can't be written.
void write_png(const std::filesystem::path& file, glm::ivec2 size, const std::vector<std::uint8_t>& rgba);

/// The RGBA8 rows of a PNG file, from the top. Throws InputError.
std::pair<glm::ivec2, std::vector<std::uint8_t>> read_png(const std::filesystem::path& file);

/// The names of the channels that describe a picture's numbers (docs/files.md), in the order of their values.
constexpr std::array<const char*, 14> number_channels
    = {"R", "G", "B", "cameraDirection.X", "cameraDirection.Y", "cameraDirection.Z", "worldDirection.X", "worldDirection.Y",
        "worldDirection.Z", "doppler", "depth", "worldAcross.X", "worldAcross.Y", "worldAcross.Z"};

/// Named planes of 32-bit floats, rows from the top; any order.
using Channels = std::vector<std::pair<std::string, std::vector<float>>>;
void write_exr(const std::filesystem::path& file, glm::ivec2 size, const Channels& channels);

/// Reads such a file back (for tests and tools). Throws InputError.
std::pair<glm::ivec2, Channels> read_exr(const std::filesystem::path& file);

} // namespace starbow
