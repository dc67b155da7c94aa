#include "painted_sky.h"
#include "config/model/angles.h"
#include "runtime/light/spectrum.h"
#include "runtime/light/srgb.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace starbow {
namespace {

constexpr int least_width = 4096;
constexpr double width_texels = 1; ///< the standard deviation of a star's light
constexpr double reach = 4; ///< standard deviations to which a star is painted

/// A star's light on the panorama.
struct PaintedStar {
    double column, row; ///< of its middle, texels; whole numbers are the texels' middles
    glm::dvec3 light; ///< of its middle, over the panorama's white
};

/// Rec. 709 linear light of luminance 1 of a black body; sunlight is white.
glm::dvec3 colour_of(double temperature_K)
{
    const glm::dvec3 xyz = black_body_xyz(temperature_K);
    return glm::max(rec709_from_sunlit_xyz() * (xyz / xyz.y), glm::dvec3(0));
}

/// The spots in the order of their rows.
std::vector<PaintedStar> spots_of(const std::vector<Star>& stars, double peak_arcmin2, glm::ivec2 size)
{
    const double texel_arcmin = 180.0 * 60 / size.y, width_arcmin = width_texels * texel_arcmin;
    std::map<double, glm::dvec3> colours;
    std::vector<PaintedStar> spots;
    for (const Star& star : stars) {
        const auto [colour, added] = colours.try_emplace(star.temperature_K);
        if (added)
            colour->second = colour_of(star.temperature_K);
        const double ra = std::atan2(star.direction.y, star.direction.x), dec = std::asin(star.direction.z);
        const double light = std::pow(10, -0.4 * star.magnitude) / (2 * pi * width_arcmin * width_arcmin) / peak_arcmin2;
        spots.push_back({ra / (2 * pi) * size.x - 0.5, (0.5 - dec / pi) * size.y - 0.5, light * colour->second});
    }
    std::sort(spots.begin(), spots.end(), [](const PaintedStar& a, const PaintedStar& b) { return a.row < b.row; });
    return spots;
}

/// Adds the part of a star that falls on a row.
void add(const PaintedStar& spot, int row, glm::ivec2 size, std::span<glm::dvec3> light)
{
    const double down = row - spot.row;
    // A texel is narrower towards the poles, and at a pole itself the star fills the row. The haversine formula, for the
    // short way between two places.
    const double narrow
        = std::max(std::sqrt(std::sin((row + 0.5) / size.y * pi) * std::sin(std::max(spot.row + 0.5, 0.0) / size.y * pi)),
            1.0 / size.x);
    const int half = std::min(int(reach * width_texels / narrow) + 1, size.x / 2 - 1),
              middle = int(std::lround(spot.column));
    for (int column = middle - half; column <= middle + half; ++column) {
        const double across = narrow * size.x / pi * std::sin((column - spot.column) * pi / size.x);
        const double part = std::exp(-0.5 * (across * across + down * down) / (width_texels * width_texels));
        light[std::size_t((column % size.x + size.x) % size.x)] += part * spot.light;
    }
}

/// sRGB's codes of light: by the root of the light, in which the curve is nearly even.
class Codes {
public:
    Codes()
    {
        for (std::size_t i = 0; i < codes_.size(); ++i) {
            const double root = double(i) / double(codes_.size() - 1);
            codes_[i] = float(255 * srgb_of_light(root * root));
        }
    }
    float of(double light) const
    {
        return codes_[std::size_t(std::sqrt(std::min(light, 1.0)) * double(codes_.size() - 1) + 0.5)];
    }

private:
    std::array<float, 16385> codes_;
};

/// A number from -0.5 to 0.5 that looks like chance: the dark sky's steps would be contours.
float dither(std::uint32_t column, std::uint32_t row)
{
    std::uint32_t mixed = column * 0x9e3779b1u ^ (row + 0x7f4a7c15u) * 0x85ebca77u;
    mixed ^= mixed >> 15, mixed *= 0x2c1b3c6du, mixed ^= mixed >> 12, mixed *= 0x297a2d39u, mixed ^= mixed >> 15;
    return float(mixed) / 4294967296.0f - 0.5f;
}

} // namespace

Texture painted(const Texture& panorama, const std::vector<Star>& stars, double peak_arcmin2)
{
    const glm::ivec2 from = panorama.size;
    const int times = std::max(1, (least_width + from.x - 1) / from.x);
    Texture result{from * times, {}, panorama.sampler};
    const glm::ivec2 size = result.size;
    result.rgba.resize(std::size_t(size.x) * std::size_t(size.y) * 4);
    std::array<double, 256> linear;
    for (std::size_t code = 0; code < linear.size(); ++code)
        linear[code] = light_of_srgb(double(code) / 255);
    static const Codes codes;
    const std::vector<PaintedStar> spots = spots_of(stars, peak_arcmin2, size);
    std::vector<glm::dvec3> light(std::size_t(size.x)), coarse(std::size_t(from.x));
    std::size_t first = 0; // the first spot that may reach the row
    for (int row = 0; row < size.y; ++row) {
        // The panorama, bilinear: first its two rows, then along them.
        const double y = std::clamp((row + 0.5) / times - 0.5, 0.0, from.y - 1.0);
        const int above = int(y), below = std::min(above + 1, from.y - 1);
        for (int x = 0; x < from.x; ++x)
            for (int c = 0; c < 3; ++c) {
                const auto at = [&](int line) {
                    return linear[panorama.rgba[4 * (std::size_t(line) * std::size_t(from.x) + std::size_t(x))
                        + std::size_t(c)]];
                };
                coarse[std::size_t(x)][c] = std::lerp(at(above), at(below), y - above);
            }
        for (int column = 0; column < size.x; ++column) {
            const double x = (column + 0.5) / times - 0.5 + from.x;
            const auto left = std::size_t(int(x) % from.x), right = (left + 1) % std::size_t(from.x);
            light[std::size_t(column)] = glm::mix(coarse[left], coarse[right], x - std::floor(x));
        }
        while (first < spots.size() && spots[first].row < row - reach * width_texels)
            ++first;
        for (std::size_t i = first; i < spots.size() && spots[i].row <= row + reach * width_texels; ++i)
            add(spots[i], row, size, light);
        std::uint8_t* out = result.rgba.data() + 4 * std::size_t(row) * std::size_t(size.x);
        for (int column = 0; column < size.x; ++column, out += 4) {
            const float noise = dither(std::uint32_t(column), std::uint32_t(row));
            for (int c = 0; c < 3; ++c)
                out[c] = std::uint8_t(std::clamp(codes.of(light[std::size_t(column)][c]) + noise + 0.5f, 0.0f, 255.0f));
            out[3] = 255;
        }
    }
    return result;
}

} // namespace starbow
