#include "picture_errors.h"
#include "config/model/angles.h"
#include "runtime/light/colour_difference.h"
#include "runtime/light/srgb.h"
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace starbow {
namespace {

/// One number for each pixel, rows from the top.
struct Brightness {
    glm::ivec2 size;
    std::vector<double> at;
    explicit Brightness(glm::ivec2 s)
        : size(s)
        , at(std::size_t(s.x) * std::size_t(s.y))
    {
    }
    double operator()(int x, int y) const
    {
        return at[std::size_t(std::clamp(y, 0, size.y - 1)) * std::size_t(size.x)
            + std::size_t(std::clamp(x, 0, size.x - 1))];
    }
};

/// Weights from -radius to radius.
using Kernel = std::vector<double>;

Kernel kernel(int radius, const std::function<double(double)>& weight)
{
    Kernel k;
    for (int i = -radius; i <= radius; ++i)
        k.push_back(weight(i));
    return k;
}

double sum(const Kernel& k)
{
    double all = 0;
    for (double w : k)
        all += w;
    return all;
}

/// Filters in both directions; beyond the edge its pixels are repeated.
Brightness filtered(const Brightness& from, const Kernel& across, const Kernel& down)
{
    Brightness half(from.size), whole(from.size);
    const auto pass = [&](const Brightness& in, Brightness& out, const Kernel& k, glm::ivec2 step) {
        const int radius = int(k.size() / 2);
        for (int y = 0; y < in.size.y; ++y)
            for (int x = 0; x < in.size.x; ++x) {
                double value = 0;
                for (int i = -radius; i <= radius; ++i)
                    value += k[std::size_t(i + radius)] * in(x + i * step.x, y + i * step.y);
                out.at[std::size_t(y) * std::size_t(in.size.x) + std::size_t(x)] = value;
            }
    };
    pass(from, half, across, {1, 0});
    pass(half, whole, down, {0, 1});
    return whole;
}

const glm::dmat3 xyz_from_rec709 = glm::transpose(glm::dmat3( // IEC 61966-2-1
    0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505));
const glm::dvec3 white = xyz_from_rec709 * glm::dvec3(1);

std::vector<glm::dvec3> linear_of(const Shown8& picture)
{
    double table[256];
    for (int i = 0; i < 256; ++i)
        table[i] = light_of_srgb(i / 255.0);
    std::vector<glm::dvec3> all(std::size_t(picture.size.x) * std::size_t(picture.size.y));
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = {table[picture.rgba[4 * i]], table[picture.rgba[4 * i + 1]], table[picture.rgba[4 * i + 2]]};
    return all;
}

/// The paper's opponent space, linear in the light, and back.
glm::dvec3 opponents(const glm::dvec3& rgb)
{
    const glm::dvec3 r = xyz_from_rec709 * rgb / white;
    return {116 * r.y - 16, 500 * (r.x - r.y), 200 * (r.y - r.z)};
}
glm::dvec3 light_of(const glm::dvec3& opponents)
{
    const double y = (opponents.x + 16) / 116;
    return glm::inverse(xyz_from_rec709) * (glm::dvec3(y + opponents.y / 500, y, y - opponents.z / 200) * white);
}

/// The Hunt effect: darker colours look less colourful.
glm::dvec3 hunt(const glm::dvec3& rgb)
{
    const glm::dvec3 lab = cielab(xyz_from_rec709 * rgb, white);
    return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}
double hyab(const glm::dvec3& one, const glm::dvec3& two)
{
    return std::abs(one.x - two.x) + std::hypot(one.y - two.y, one.z - two.z);
}

/// The perceived picture: each opponent channel blurred by its contrast sensitivity, with Hunt's colours.
std::vector<glm::dvec3> perceived(const std::vector<glm::dvec3>& rgb, glm::ivec2 size, double pixels_per_degree)
{
    struct Part {
        double a, b; // a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees
    };
    const std::vector<std::vector<Part>> channels = {{{1, 0.0047}}, {{1, 0.0053}}, {{34.1, 0.04}, {13.5, 0.025}}};
    const int radius = int(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * pixels_per_degree));
    std::vector<glm::dvec3> blurred(rgb.size(), glm::dvec3(0));
    for (int channel = 0; channel < 3; ++channel) {
        Brightness own(size);
        for (std::size_t i = 0; i < rgb.size(); ++i)
            own.at[i] = opponents(rgb[i])[channel];
        double all = 0;
        std::vector<std::pair<double, Kernel>> parts;
        for (const Part& part : channels[std::size_t(channel)]) {
            parts.push_back({part.a * std::sqrt(pi / part.b), kernel(radius, [&](double x) {
                                 return std::exp(-pi * pi * x * x / (pixels_per_degree * pixels_per_degree * part.b));
                             })});
            all += parts.back().first * std::pow(sum(parts.back().second), 2);
        }
        for (const auto& [weight, k] : parts) {
            const Brightness one = filtered(own, k, k);
            for (std::size_t i = 0; i < rgb.size(); ++i)
                blurred[i][channel] += one.at[i] * weight / all;
        }
    }
    for (glm::dvec3& colour : blurred)
        colour = hunt(glm::clamp(light_of(colour), 0.0, 1.0));
    return blurred;
}

/// The strength of the edges and of the points of a picture's lightness.
std::pair<std::vector<double>, std::vector<double>> features(
    const std::vector<glm::dvec3>& rgb, glm::ivec2 size, double pixels_per_degree)
{
    const double sigma = 0.5 * 0.082 * pixels_per_degree;
    const int radius = int(std::ceil(3 * sigma));
    Brightness lightness(size);
    for (std::size_t i = 0; i < rgb.size(); ++i)
        lightness.at[i] = (opponents(rgb[i]).x + 16) / 116;
    const Kernel bell = kernel(radius, [&](double x) { return std::exp(-x * x / (2 * sigma * sigma)); });
    const auto strength = [&](const std::function<double(double)>& factor) {
        Kernel k = kernel(radius, [&](double x) { return factor(x) * std::exp(-x * x / (2 * sigma * sigma)); });
        // The positive weights sum up to 1, the negative ones to -1.
        double above = 0, below = 0;
        for (double w : k)
            (w > 0 ? above : below) += w;
        for (double& w : k)
            w /= (w > 0 ? above : -below) * sum(bell);
        const Brightness x = filtered(lightness, k, bell), y = filtered(lightness, bell, k);
        std::vector<double> both(rgb.size());
        for (std::size_t i = 0; i < both.size(); ++i)
            both[i] = std::hypot(x.at[i], y.at[i]);
        return both;
    };
    return {strength([](double x) { return -x; }), strength([&](double x) { return x * x / (sigma * sigma) - 1; })};
}

} // namespace

double quantile(std::vector<double> values, double part)
{
    if (values.empty())
        return 0;
    const double at = part * double(values.size() - 1);
    const auto low = values.begin() + std::ptrdiff_t(at);
    std::nth_element(values.begin(), low, values.end());
    const double first = *low;
    const double next = low + 1 == values.end() ? first : *std::min_element(low + 1, values.end());
    return first + (at - std::floor(at)) * (next - first);
}

double psnr_dB(const Shown8& picture, const Shown8& reference)
{
    double squares = 0;
    const std::size_t count = std::size_t(picture.size.x) * std::size_t(picture.size.y);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            squares += std::pow(double(picture.rgba[4 * i + c]) - double(reference.rgba[4 * i + c]), 2);
    return squares == 0 ? std::numeric_limits<double>::infinity()
                        : 10 * std::log10(255.0 * 255 * 3 * double(count) / squares);
}

std::vector<double> flip(const Shown8& picture, const Shown8& reference, double pixels_per_degree)
{
    const std::vector<glm::dvec3> own = linear_of(picture), its = linear_of(reference);
    const glm::ivec2 size = picture.size;
    constexpr double colour_power = 0.7, low = 0.4, low_to = 0.95, feature_power = 0.5;
    const double most = std::pow(hyab(hunt({0, 1, 0}), hunt({0, 0, 1})), colour_power);

    const auto own_colours = perceived(own, size, pixels_per_degree), its_colours = perceived(its, size, pixels_per_degree);
    const auto [own_edges, own_points] = features(own, size, pixels_per_degree);
    const auto [its_edges, its_points] = features(its, size, pixels_per_degree);
    std::vector<double> all(own.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double difference = std::pow(hyab(own_colours[i], its_colours[i]), colour_power);
        // Large differences are compressed.
        const double colour = difference < low * most
            ? difference * low_to / (low * most)
            : low_to + (difference - low * most) / (most - low * most) * (1 - low_to);
        const double feature = std::max(std::abs(own_edges[i] - its_edges[i]), std::abs(own_points[i] - its_points[i]));
        all[i] = std::pow(colour, 1 - std::min(1.0, std::pow(feature / std::sqrt(2.0), feature_power)));
    }
    return all;
}

std::vector<double> edge_displacements_px(const Shown8& picture, const Shown8& reference)
{
    constexpr int reach = 3;
    constexpr double steep = 0.04; // of full brightness, in a pixel
    const glm::ivec2 size = picture.size;
    const auto brightness = [&](const Shown8& from) {
        Brightness plane(size);
        for (std::size_t i = 0; i < plane.at.size(); ++i)
            plane.at[i] = (0.299 * from.rgba[4 * i] + 0.587 * from.rgba[4 * i + 1] + 0.114 * from.rgba[4 * i + 2]) / 255;
        const Kernel soft = {0.25, 0.5, 0.25};
        return filtered(plane, soft, soft);
    };
    const Brightness own = brightness(picture), its = brightness(reference);
    const auto slope
        = [&](int x, int y) { return 0.5 * glm::dvec2(its(x + 1, y) - its(x - 1, y), its(x, y + 1) - its(x, y - 1)); };
    std::vector<double> moved;
    for (int y = reach; y < size.y - reach; ++y)
        for (int x = reach; x < size.x - reach; ++x) {
            const glm::dvec2 here = slope(x, y);
            const double length = glm::length(here);
            if (length < steep)
                continue;
            const glm::dvec2 way = here / length;
            const glm::ivec2 next(glm::round(way));
            if (glm::length(slope(x + next.x, y + next.y)) > length || glm::length(slope(x - next.x, y - next.y)) > length)
                continue;
            double top = 0, bottom = 0;
            for (int j = -reach; j <= reach; ++j)
                for (int i = -reach; i <= reach; ++i) {
                    const double along = glm::dot(slope(x + i, y + j), way);
                    top += along * (its(x + i, y + j) - own(x + i, y + j));
                    bottom += along * along;
                }
            moved.push_back(top / bottom);
        }
    return moved;
}

PictureErrors picture_errors(const Shown8& picture, const Shown8& reference)
{
    PictureErrors errors{};
    errors.psnr_dB = psnr_dB(picture, reference);
    const std::vector<double> flips = flip(picture, reference);
    for (double one : flips)
        errors.flip += one / double(flips.size());
    const std::vector<glm::dvec3> own = linear_of(picture), its = linear_of(reference);
    std::vector<double> differences;
    for (std::size_t i = 0; i < own.size(); ++i) {
        differences.push_back(ciede2000(cielab(xyz_from_rec709 * own[i], white), cielab(xyz_from_rec709 * its[i], white)));
        errors.ciede2000_mean += differences.back() / double(own.size());
    }
    errors.ciede2000_95 = quantile(std::move(differences), 0.95);
    std::vector<double> moved = edge_displacements_px(picture, reference);
    for (double& one : moved)
        one = std::abs(one);
    errors.edges_95_px = quantile(std::move(moved), 0.95);
    return errors;
}

} // namespace starbow
