#pragma once
#include "world.h"

namespace starbow {

/// A decoded image: 1 to 4 channels, of which an even number ends with the cover.
struct Pixels {
    const std::uint8_t* values = nullptr;
    glm::ivec2 size{0};
    int channels = 4;

    const std::uint8_t* at(int x, int y) const
    {
        return values + (std::size_t(y) * std::size_t(size.x) + std::size_t(x)) * std::size_t(channels);
    }
    bool grey() const { return channels < 3; }
    bool covers() const { return channels % 2 == 1; } ///< everything: there is no channel of cover
};

/// The image in fewer pixels, of four channels. Each is the mean of those that it takes the place of: of their light, or of
/// numbers, and of the cover.
std::vector<std::uint8_t> shrunk(const Pixels& from, glm::ivec2 size, bool numbers);

/// The texture with halved sides.
Texture halved(const Texture& texture);

} // namespace starbow
