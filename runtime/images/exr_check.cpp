#include "exr_check.h"
#include <cstdint>
#include <cstring>
#include <set>

namespace starbow {
namespace {

// Layout of the file: https://openexr.com/en/latest/OpenEXRFileLayout.html
constexpr int most_across = 16384;
constexpr std::size_t most_channels = 256;
constexpr unsigned char no_compression = 0, zip_compression = 3;
constexpr std::int32_t float_samples = 2;

/// Reads the bytes in order. After a step beyond the end it is broken and returns zeros.
struct Cursor {
    const std::vector<unsigned char>& bytes;
    std::size_t at = 0, end = 0;
    bool broken = false;

    template <class T> T read()
    {
        T value{};
        if (broken || end - at < sizeof(T))
            broken = true;
        else
            std::memcpy(&value, bytes.data() + at, sizeof(T)), at += sizeof(T);
        return value;
    }
    /// Up to 255 letters and the zero behind them.
    std::string name()
    {
        std::string text;
        while (const char c = read<char>())
            text += c;
        broken = broken || text.size() > 255;
        return text;
    }
};

struct Header {
    std::set<std::string> attributes, channels;
    unsigned char compression = no_compression;
    std::int64_t width = 0, height = 0;
};

std::string printable(std::string text)
{
    for (char& c : text)
        if (c < 0x20 || c == 0x7f)
            c = '?';
    return text;
}

bool read_channels(Cursor in, Header& header)
{
    for (std::string name = in.name(); !name.empty(); name = in.name()) {
        const auto type = in.read<std::int32_t>();
        in.read<std::int32_t>(); // linear, reserved
        const auto x_step = in.read<std::int32_t>(), y_step = in.read<std::int32_t>();
        if (type != float_samples || x_step != 1 || y_step != 1 || !header.channels.insert(name).second)
            return false;
    }
    return !in.broken && in.at == in.end && !header.channels.empty() && header.channels.size() <= most_channels;
}

bool read_attribute(const std::string& name, Cursor in, Header& header)
{
    const std::size_t size = in.end - in.at;
    if (name == "channels")
        return read_channels(in, header);
    if (name == "compression") {
        header.compression = in.read<unsigned char>();
        return size == 1 && (header.compression == no_compression || header.compression == zip_compression);
    }
    if (name == "dataWindow") {
        const auto x0 = in.read<std::int32_t>(), y0 = in.read<std::int32_t>();
        header.width = std::int64_t(in.read<std::int32_t>()) + 1, header.height = std::int64_t(in.read<std::int32_t>()) + 1;
        return size == 16 && x0 == 0 && y0 == 0 && header.width >= 1 && header.width <= most_across && header.height >= 1
            && header.height <= most_across;
    }
    if (name == "lineOrder") // tinyexr would turn the others' pictures upside down
        return size == 1 && in.read<unsigned char>() == 0;
    if (name == "displayWindow")
        return size == 16;
    if (name == "screenWindowCenter")
        return size == 8;
    return (name == "pixelAspectRatio" || name == "screenWindowWidth") && size == 4;
}

} // namespace

std::string exr_fault(const std::vector<unsigned char>& bytes)
{
    Cursor in{bytes, 0, bytes.size()};
    constexpr std::uint32_t long_names = 0x400;
    if (in.read<std::uint32_t>() != 20000630)
        return "is not an EXR file; a file that Starbow wrote is right";
    if ((in.read<std::uint32_t>() & ~long_names) != 2)
        return "is an EXR file of another kind; a plain image in rows, version 2, is right";

    Header header;
    for (std::string name = in.name(); !name.empty(); name = in.name()) {
        in.name(); // the attribute's type
        const auto size = in.read<std::uint32_t>();
        if (in.broken || size > in.end - in.at)
            return "breaks off inside its header; a whole file is right";
        if (!header.attributes.insert(name).second || !read_attribute(name, {bytes, in.at, in.at + size}, header))
            return "has a header \"" + printable(name) + "\" that can't be read here; a file that Starbow wrote is right";
        in.at += size;
    }
    for (const char* name : {"channels", "compression", "dataWindow", "displayWindow", "lineOrder", "pixelAspectRatio",
             "screenWindowCenter", "screenWindowWidth"})
        if (in.broken || !header.attributes.count(name))
            return std::string("lacks the header \"") + name + "\"; a whole file is right";

    const std::int64_t rows_per_block = header.compression == zip_compression ? 16 : 1;
    const std::int64_t row_bytes = header.width * 4 * std::int64_t(header.channels.size());
    for (std::int64_t row = 0; row < header.height; row += rows_per_block) {
        const auto place = in.read<std::uint64_t>();
        if (in.broken || place > bytes.size())
            return "breaks off at row " + std::to_string(row) + "; a whole file is right";
        Cursor block{bytes, place, bytes.size()};
        const auto number = block.read<std::int32_t>();
        const auto size = block.read<std::int32_t>();
        const std::int64_t full = row_bytes * std::min(rows_per_block, header.height - row);
        // Deflate packs at most 1032 to 1; a larger claim would reserve memory in vain.
        const bool fits = header.compression == zip_compression
            ? size > 0 && size <= full && full <= size * std::int64_t(1100)
            : size == full;
        if (block.broken || number != row || !fits || std::uint64_t(size) > block.end - block.at)
            return "is broken at row " + std::to_string(row) + "; a whole file is right";
    }
    return "";
}

} // namespace starbow
