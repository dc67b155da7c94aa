#include "capture.h"
#include "config/json/error.h"
#include "config/json/file_name.h"
#include "config/json/whole_file.h"
#include "exr_check.h"
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#include <stdexcept>
#include <tinyexr.h>

namespace starbow {
namespace {

using Bytes = std::vector<unsigned char>;
using Stream = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

void require(bool right, const std::string& what, std::size_t is, std::size_t expected)
{
    if (!right)
        throw std::logic_error(what + ": " + std::to_string(is) + " given, " + std::to_string(expected) + " expected");
}

std::size_t pixels(glm::ivec2 size)
{
    require(size.x >= 1 && size.y >= 1, "capture: smallest side", std::size_t(std::max(0, std::min(size.x, size.y))), 1);
    return std::size_t(size.x) * std::size_t(size.y);
}

} // namespace

void check_writable(const std::filesystem::path& file)
{
    namespace fs = std::filesystem;
    std::error_code error;
    if (fs::exists(file, error) && !fs::is_regular_file(file, error))
        throw InputError(file.string(), "", "is there and is not a file; a name that is free or a file's is right");
    fs::path folder = fs::absolute(file, error).parent_path();
    while (!fs::exists(folder, error) && folder.has_relative_path())
        folder = folder.parent_path();
    if (!fs::is_directory(folder, error))
        throw InputError(file.string(), "", "can't be written: " + folder.string() + " is not a folder; a folder is right");
    if (access(folder.c_str(), W_OK | X_OK) != 0)
        throw InputError(file.string(), "",
            "can't be written: " + folder.string() + " is not writable by this user; give another folder");
}

void check_not_read(const std::filesystem::path& file, const std::vector<std::filesystem::path>& read)
{
    std::error_code not_there;
    for (const std::filesystem::path& each : read)
        if (std::filesystem::equivalent(file, each, not_there))
            throw InputError(file.string(), "", "is read, and would be replaced; another name for what is written is right");
}

void check_free(const std::filesystem::path& file, bool force)
{
    std::error_code not_there;
    if (!force && std::filesystem::exists(file, not_there))
        throw InputError(file.string(), "", "is there already; another name, or --force to replace it, is right");
}

void check_ending(const std::filesystem::path& file, const std::string& ending)
{
    if (ending_of(file) != ending)
        throw InputError(file.string(), "", "does not end in " + ending + "; a name that does is right");
}

std::vector<unsigned char> png_of(glm::ivec2 size, const std::vector<std::uint8_t>& rgba)
{
    require(rgba.size() == pixels(size) * 4, "png_of: bytes", rgba.size(), pixels(size) * 4);
    Bytes rgb;
    rgb.reserve(pixels(size) * 3);
    for (std::size_t i = 0; i < rgba.size(); i += 4)
        rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
    Bytes bytes;
    const auto append = [](void* to, void* data, int count) {
        const auto* from = static_cast<const unsigned char*>(data);
        static_cast<Bytes*>(to)->insert(static_cast<Bytes*>(to)->end(), from, from + count);
    };
    if (!stbi_write_png_to_func(append, &bytes, size.x, size.y, 3, rgb.data(), size.x * 3))
        throw std::bad_alloc();
    return bytes;
}

std::pair<glm::ivec2, std::vector<std::uint8_t>> read_png(const std::filesystem::path& file)
{
    const std::string bytes = read_whole(file, std::size_t(64) << 20, "a PNG file");
    glm::ivec2 size(0);
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> decoded(
        stbi_load_from_memory(
            reinterpret_cast<const stbi_uc*>(bytes.data()), int(bytes.size()), &size.x, &size.y, &channels, 4),
        stbi_image_free);
    if (!decoded)
        throw InputError(
            file.string(), "", "can't be read (" + std::string(stbi_failure_reason()) + "); a whole PNG file is right");
    return {size, {decoded.get(), decoded.get() + 4 * std::size_t(size.x) * std::size_t(size.y)}};
}

void write_png(const std::filesystem::path& file, glm::ivec2 size, const std::vector<std::uint8_t>& rgba)
{
    write_whole(file, png_of(size, rgba));
}

void write_exr(const std::filesystem::path& file, glm::ivec2 size, const Channels& channels)
{
    std::vector<const Channels::value_type*> sorted; // the format requires the order of names
    for (const auto& channel : channels) {
        require(channel.second.size() == pixels(size), "write_exr: samples of " + channel.first, channel.second.size(),
            pixels(size));
        require(!channel.first.empty() && channel.first.size() <= 255, "write_exr: letters of a name", channel.first.size(),
            255);
        sorted.push_back(&channel);
    }
    require(!channels.empty(), "write_exr: channels", 0, 1);
    std::sort(sorted.begin(), sorted.end(), [](auto* a, auto* b) { return a->first < b->first; });
    for (std::size_t i = 1; i < sorted.size(); ++i)
        require(sorted[i - 1]->first != sorted[i]->first, "write_exr: channels named " + sorted[i]->first, 2, 1);

    // Memory of this function: tinyexr only reads it, and its Free functions must not see it.
    std::vector<EXRChannelInfo> infos(sorted.size());
    std::vector<int> float_samples(sorted.size(), TINYEXR_PIXELTYPE_FLOAT);
    std::vector<unsigned char*> planes;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        std::memset(&infos[i], 0, sizeof infos[i]);
        std::memcpy(infos[i].name, sorted[i]->first.c_str(), sorted[i]->first.size());
        planes.push_back(reinterpret_cast<unsigned char*>(const_cast<float*>(sorted[i]->second.data())));
    }
    EXRHeader header;
    InitEXRHeader(&header);
    header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
    header.num_channels = int(sorted.size());
    header.long_name = std::any_of(sorted.begin(), sorted.end(), [](auto* c) { return c->first.size() > 31; });
    header.channels = infos.data();
    header.pixel_types = float_samples.data();
    header.requested_pixel_types = float_samples.data();
    EXRImage image;
    InitEXRImage(&image);
    image.num_channels = int(sorted.size());
    image.width = size.x;
    image.height = size.y;
    image.images = planes.data();

    unsigned char* memory = nullptr;
    const char* why = nullptr;
    const std::size_t count = SaveEXRImageToMemory(&image, &header, &memory, &why);
    const std::unique_ptr<unsigned char, void (*)(void*)> owned(memory, std::free);
    if (count == 0) {
        const std::string reason = why ? why : "no reason given";
        FreeEXRErrorMessage(why);
        throw std::logic_error("write_exr: tinyexr: " + reason);
    }
    write_whole(file, {memory, count});
}

std::pair<glm::ivec2, Channels> read_exr(const std::filesystem::path& file)
{
    const std::string read = starbow::read_whole(file, std::size_t(2) << 30, "an EXR file");
    const Bytes bytes(read.begin(), read.end());
    if (const std::string fault = exr_fault(bytes); !fault.empty())
        throw InputError(file.string(), "", fault);

    EXRHeader header;
    InitEXRHeader(&header);
    EXRImage image;
    InitEXRImage(&image);
    const std::unique_ptr<EXRHeader, int (*)(EXRHeader*)> header_owner(&header, FreeEXRHeader);
    EXRVersion version;
    const char* why = nullptr;
    bool loaded = ParseEXRVersionFromMemory(&version, bytes.data(), bytes.size()) == TINYEXR_SUCCESS
        && ParseEXRHeaderFromMemory(&header, &version, bytes.data(), bytes.size(), &why) == TINYEXR_SUCCESS;
    // tinyexr frees the image itself where loading fails, and as many planes as the image already declares.
    image.num_channels = header.num_channels;
    loaded = loaded && LoadEXRImageFromMemory(&image, &header, bytes.data(), bytes.size(), &why) == TINYEXR_SUCCESS;
    if (!loaded) {
        std::string reason = why ? why : "no reason given";
        FreeEXRErrorMessage(why);
        std::replace(reason.begin(), reason.end(), '\n', ' ');
        throw InputError(file.string(), "", "can't be read (" + reason + "); an EXR file that Starbow wrote is right");
    }
    const std::unique_ptr<EXRImage, int (*)(EXRImage*)> image_owner(&image, FreeEXRImage);
    const glm::ivec2 size(image.width, image.height);
    Channels channels;
    for (int i = 0; i < header.num_channels; ++i) {
        const float* plane = reinterpret_cast<const float*>(image.images[i]);
        channels.emplace_back(header.channels[i].name, std::vector<float>(plane, plane + pixels(size)));
    }
    return {size, channels};
}

} // namespace starbow
