#include "pictures.h"
#include "runtime/light/srgb.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

int wrapped(Wrap wrap, double at, int size)
{
    if (wrap == Wrap::clamp)
        return int(std::clamp(at, 0.0, size - 1.0));
    const double period = wrap == Wrap::mirror ? 2.0 * size : size;
    const int inside = std::min(int(at - std::floor(at / period) * period), int(period) - 1);
    return inside < size ? inside : 2 * size - 1 - inside;
}

} // namespace

Pictures::Pictures(const World& world)
    : world_(world)
{
    for (std::size_t i = 0; i < linear_.size(); ++i) {
        const double x = double(i) / 255;
        linear_[i] = light_of_srgb(x);
    }
}

glm::dvec4 Pictures::at(int texture, const glm::dvec2& uv) const
{
    if (texture < 0)
        return glm::dvec4(1);
    const Texture& picture = world_.textures[std::size_t(texture)];
    const glm::dvec2 place = uv * glm::dvec2(picture.size);
    if (!(std::abs(place.x) < 1e15 && std::abs(place.y) < 1e15))
        return glm::dvec4(0);
    auto texel = [&](double x, double y) {
        const int column = wrapped(picture.sampler.u, x, picture.size.x),
                  row = wrapped(picture.sampler.v, y, picture.size.y);
        const std::uint8_t* bytes
            = &picture.rgba[4 * (std::size_t(row) * std::size_t(picture.size.x) + std::size_t(column))];
        if (picture.numbers)
            return glm::dvec4(bytes[0], bytes[1], bytes[2], bytes[3]) / 255.0;
        return glm::dvec4(linear_[bytes[0]], linear_[bytes[1]], linear_[bytes[2]], bytes[3] / 255.0);
    };
    if (!picture.sampler.magnify_linear)
        return texel(std::floor(place.x), std::floor(place.y));
    const glm::dvec2 low = glm::floor(place - 0.5), part = place - 0.5 - low;
    return glm::mix(glm::mix(texel(low.x, low.y), texel(low.x + 1, low.y), part.x),
        glm::mix(texel(low.x, low.y + 1), texel(low.x + 1, low.y + 1), part.x), part.y);
}

} // namespace starbow
