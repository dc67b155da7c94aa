#include "edid.h"
#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>

namespace starbow {
namespace {

constexpr std::size_t block = 128;
constexpr std::array<std::uint8_t, 8> header = {0, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0};

/// Reads 13 letters, ended by a line feed and padded with spaces.
std::string letters(std::span<const std::uint8_t> bytes)
{
    std::string text;
    for (std::uint8_t byte : bytes) {
        if (byte == '\n' || byte == 0)
            break;
        text += byte >= 0x20 && byte < 0x7f ? char(byte) : '?';
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
    return text;
}

/// The maker's three letters, five bits each (A is 1), and the product's number.
std::string maker_and_product(std::span<const std::uint8_t> bytes)
{
    const int packed = bytes[8] << 8 | bytes[9];
    std::string name;
    for (int shift : {10, 5, 0}) {
        const int letter = packed >> shift & 31;
        name += letter >= 1 && letter <= 26 ? char('A' + letter - 1) : '?';
    }
    std::array<char, 8> product;
    std::snprintf(product.data(), product.size(), "-%04X", unsigned(bytes[10] | bytes[11] << 8));
    return name + product.data();
}

} // namespace

std::optional<Edid> parse_edid(std::span<const std::uint8_t> bytes)
{
    if (bytes.size() < block || !std::equal(header.begin(), header.end(), bytes.begin()))
        return {};
    bytes = bytes.first(block);
    if (std::accumulate(bytes.begin(), bytes.end(), 0u) % 256 != 0)
        return {};

    Edid edid;
    edid.size_mm = 10 * glm::ivec2(bytes[21], bytes[22]); // if one of them is 0, the bytes are an aspect ratio
    if (bytes[21] == 0 || bytes[22] == 0)
        edid.size_mm = {0, 0};
    for (std::size_t at : {54, 72, 90, 108}) {
        const auto descriptor = bytes.subspan(at, 18);
        const bool timing = descriptor[0] != 0 || descriptor[1] != 0;
        if (timing) {
            const glm::ivec2 mm(
                descriptor[12] | (descriptor[14] & 0xf0) << 4, descriptor[13] | (descriptor[14] & 0x0f) << 8);
            if (at == 54 && mm.x > 0 && mm.y > 0)
                edid.size_mm = mm; // finer than centimetres
        } else if (descriptor[3] == 0xfc) {
            edid.model = letters(descriptor.subspan(5));
        } else if (descriptor[3] == 0xff) {
            edid.serial = letters(descriptor.subspan(5));
        }
    }
    if (edid.model.empty())
        edid.model = maker_and_product(bytes);
    const std::uint32_t number
        = bytes[12] | std::uint32_t(bytes[13]) << 8 | std::uint32_t(bytes[14]) << 16 | std::uint32_t(bytes[15]) << 24;
    if (edid.serial.empty() && number != 0)
        edid.serial = std::to_string(number);
    return edid;
}

} // namespace starbow
