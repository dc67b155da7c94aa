#include "parts.h"
#include <array>
#include <memory>
#include <stb/stb_image.h>
#include <zlib.h>

namespace starbow {
namespace {

std::uint32_t big32(std::string_view bytes, std::size_t at)
{
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << 8 | std::uint8_t(bytes[at + i]);
    return value;
}

/// True if every chunk up to the end is as long as it says: the decoder allocates before it looks.
bool whole(std::string_view png)
{
    for (std::size_t at = 8; at + 12 <= png.size();) {
        const std::size_t length = big32(png, at);
        if (length > png.size() - at - 12)
            return false;
        if (png.substr(at + 4, 4) == "IEND")
            return true;
        at += length + 12;
    }
    return false;
}

/// True if a whole picture's data become no more than `most` bytes and come to their end. They are counted and not kept: the
/// decoder would keep all of them.
bool inflates_to(std::string_view png, std::size_t most)
{
    z_stream stream{};
    if (inflateInit(&stream) != Z_OK)
        throw std::bad_alloc();
    const std::unique_ptr<z_stream, int (*)(z_stream*)> owner(&stream, inflateEnd);
    std::size_t total = 0;
    int status = Z_OK;
    for (std::size_t at = 8; status == Z_OK && png.substr(at + 4, 4) != "IEND";) {
        const std::size_t length = big32(png, at);
        if (png.substr(at + 4, 4) == "IDAT") {
            stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(png.data() + at + 8));
            stream.avail_in = uInt(length);
            while (status == Z_OK && (stream.avail_in > 0 || stream.avail_out == 0)) {
                Bytef piece[16384];
                stream.next_out = piece;
                stream.avail_out = sizeof piece;
                status = inflate(&stream, Z_NO_FLUSH);
                total += sizeof piece - stream.avail_out;
                if (total > most)
                    return false;
            }
            if (status == Z_BUF_ERROR)
                status = Z_OK; // wants more, which the next chunk may bring
        }
        at += length + 12;
    }
    return status == Z_STREAM_END;
}

} // namespace

WarpMesh::Mask read_mask(const WarpFile& file, const std::string& place, std::size_t most_bytes)
{
    const std::string_view png = file.content;
    const std::string right = "; a PNG of 8 or 16 bits is right";
    if (!png.starts_with("\x89PNG\r\n\x1a\n") || png.size() < 33 || png.substr(12, 4) != "IHDR")
        refuse(file, place, "is not a PNG" + right);
    if (!whole(png))
        refuse(file, place, "ends early or has a chunk that says it is longer than the file" + right);
    const auto* bytes = reinterpret_cast<const stbi_uc*>(png.data());
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(bytes, int(png.size()), &width, &height, &channels))
        refuse(file, place, std::string("can't be read (") + stbi_failure_reason() + ")" + right);
    if (width > most_grid || height > most_grid)
        refuse(file, place,
            std::to_string(width) + " x " + std::to_string(height) + " pixels are too many; at most "
                + std::to_string(most_grid) + " a side is right");
    const std::size_t pixels = std::size_t(width) * std::size_t(height), depth = std::uint8_t(png[24]);
    const std::size_t bits = depth * std::array<std::size_t, 8>{1, 0, 3, 1, 2, 0, 4, 0}[std::uint8_t(png[25]) % 8];
    if (png[28] != 0)
        refuse(file, place, "is interlaced; a PNG that is not is right");
    if (pixels * 4 * (depth > 8 ? 2 : 1) > most_bytes)
        refuse(file, place,
            std::to_string(width) + " x " + std::to_string(height) + " pixels are too many for a file of this size" + right);
    const std::size_t data = std::size_t(height) * (1 + (std::size_t(width) * bits + 7) / 8); // a row begins with its filter
    if (!inflates_to(png, data))
        refuse(file, place,
            "has damaged data, or more than its " + std::to_string(width) + " x " + std::to_string(height) + " pixels take"
                + right);

    const bool deep = stbi_is_16_bit_from_memory(bytes, int(png.size()));
    const std::unique_ptr<void, void (*)(void*)> decoded(deep
            ? static_cast<void*>(stbi_load_16_from_memory(bytes, int(png.size()), &width, &height, &channels, 0))
            : static_cast<void*>(stbi_load_from_memory(bytes, int(png.size()), &width, &height, &channels, 0)),
        stbi_image_free);
    if (!decoded)
        refuse(file, place, std::string("can't be read (") + stbi_failure_reason() + ")" + right);
    const auto value = [&](std::size_t i) {
        return deep ? static_cast<const stbi_us*>(decoded.get())[i] / 65535.0f
                    : static_cast<const stbi_uc*>(decoded.get())[i] / 255.0f;
    };
    const std::size_t stride = std::size_t(channels);
    bool grey = true;
    for (std::size_t i = 0; grey && channels >= 3 && i < pixels; ++i)
        grey = value(stride * i) == value(stride * i + 1) && value(stride * i) == value(stride * i + 2);
    WarpMesh::Mask mask;
    mask.size = {width, height};
    mask.channels = grey ? 1 : 3;
    if (pixels * std::size_t(mask.channels) * sizeof(float) > most_bytes)
        refuse(file, place,
            std::to_string(width) + " x " + std::to_string(height)
                + " coloured pixels are too many for a file of this size; a grey picture or a smaller one is right");
    mask.values.reserve(pixels * std::size_t(mask.channels));
    for (std::size_t i = 0; i < pixels; ++i)
        for (std::size_t c = 0; c < std::size_t(mask.channels); ++c)
            mask.values.push_back(value(stride * i + c));
    return mask;
}

} // namespace starbow
