#include "shrink.h"
#include "runtime/light/srgb.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace starbow {

std::vector<std::uint8_t> shrunk(const Pixels& from, glm::ivec2 size, bool numbers)
{
    std::array<double, 256> light;
    for (std::size_t i = 0; i < light.size(); ++i)
        light[i] = numbers ? double(i) / 255 : light_of_srgb(double(i) / 255);
    std::vector<std::uint8_t> rgba;
    rgba.reserve(4 * std::size_t(size.x) * std::size_t(size.y));
    const int colours = from.grey() ? 1 : 3;
    const auto byte = [](double value) { return std::uint8_t(std::lround(std::clamp(value, 0.0, 255.0))); };
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const glm::ivec2 low = glm::ivec2(x, y) * from.size / size, high = glm::ivec2(x + 1, y + 1) * from.size / size;
            std::array<double, 3> sum{};
            double cover = 0;
            for (int j = low.y; j < high.y; ++j)
                for (int i = low.x; i < high.x; ++i) {
                    const std::uint8_t* at = from.at(i, j);
                    for (int c = 0; c < colours; ++c)
                        sum[std::size_t(c)] += light[at[c]];
                    cover += from.covers() ? 255 : at[from.channels - 1];
                }
            const double count = double(high.x - low.x) * (high.y - low.y);
            for (std::size_t c = 0; c < 3; ++c)
                rgba.push_back(byte(
                    255 * (numbers ? sum[from.grey() ? 0 : c] / count : srgb_of_light(sum[from.grey() ? 0 : c] / count))));
            rgba.push_back(byte(cover / count));
        }
    return rgba;
}

Texture halved(const Texture& texture)
{
    const glm::ivec2 size = glm::max(texture.size / 2, 1);
    return {size, shrunk({texture.rgba.data(), texture.size}, size, texture.numbers), texture.sampler, texture.numbers,
        texture.large};
}

} // namespace starbow
