#include "dome.h"
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace starbow {
namespace {

constexpr double pi = glm::pi<double>();

/// The picture's axes in the cockpit. A positive tilt leans the zenith forward, so that the front rim sinks by as much.
struct Axes {
    glm::dvec3 zenith, front, right;
};

Axes axes(const Fisheye& dome)
{
    const double tilt = glm::radians(dome.tilt_deg), c = std::cos(tilt), s = std::sin(tilt);
    return {{0, c, -s}, {0, -s, -c}, {1, 0, 0}};
}

double radius_px(glm::ivec2 size) { return std::min(size.x, size.y) * 0.5; }
double rim_rad(const Fisheye& dome) { return glm::radians(dome.aperture_deg) / 2; }

/// A little beyond the rim, so that a direction computed for a point on the rim is still found on it.
constexpr double slack = 1e-12;

} // namespace

std::optional<glm::dvec3> dome_direction(const Fisheye& dome, glm::ivec2 size, glm::dvec2 pixel)
{
    const glm::dvec2 offset = pixel - glm::dvec2(size) * 0.5; // y down: towards the front
    const double r = glm::length(offset), radius = radius_px(size);
    if (r > radius * (1 + slack))
        return {};
    const double angle = r / radius * rim_rad(dome);
    const glm::dvec2 side = r > 0 ? offset / r * std::sin(angle) : glm::dvec2(0);
    const Axes a = axes(dome);
    return glm::normalize(a.zenith * std::cos(angle) + a.right * side.x + a.front * side.y);
}

std::optional<glm::dvec2> dome_pixel(const Fisheye& dome, glm::ivec2 size, const glm::dvec3& direction)
{
    const Axes a = axes(dome);
    const glm::dvec2 side(glm::dot(direction, a.right), glm::dot(direction, a.front));
    const double across = glm::length(side), angle = std::atan2(across, glm::dot(direction, a.zenith));
    const double rim = rim_rad(dome);
    if (!(angle <= rim * (1 + slack)))
        return {};
    const double r = angle / rim * radius_px(size);
    // Straight below the zenith every rim point of a whole sphere shows the direction: the front one stands for them.
    const glm::dvec2 way = across > 0 ? side / across : glm::dvec2(0, 1);
    return glm::dvec2(size) * 0.5 + way * r;
}

double dome_pixel_angle(const Fisheye& dome, glm::ivec2 size, glm::dvec2 pixel)
{
    const double r = glm::distance(pixel, glm::dvec2(size) * 0.5), radius = radius_px(size);
    if (r > radius * (1 + slack))
        return 0;
    // Along the radius a pixel covers `step`, across it step sin(angle) / angle. Where a whole sphere closes, the sine
    // vanishes at the rim though its pixels still show something: there its mean over the last half pixel stands in.
    const double step = rim_rad(dome) / radius;
    const double angle = std::min(r * step, pi - step / 4);
    const double shrink = angle > 1e-4 ? std::sin(angle) / angle : 1 - angle * angle / 6;
    return step * std::sqrt(std::max(shrink, 0.0));
}

} // namespace starbow
