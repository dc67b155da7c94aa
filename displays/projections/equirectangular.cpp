#include "equirectangular.h"
#include "config/model/angles.h"
#include "config/model/turn.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// Slack beyond the poles, for rows whose elevation was rounded.
constexpr double pole_slack = 1e-12;

} // namespace

EquirectangularRays::EquirectangularRays(const Equirectangular& equirectangular, glm::ivec2 size)
    : turned_(cockpit_from_picture(equirectangular.turn))
    , half_width_(size.x * 0.5)
{
    const Sides& sides = equirectangular.sides;
    middle_ = glm::radians(sides.left_deg + sides.right_deg) / 2;
    top_ = glm::radians(sides.up_deg);
    step_ = glm::radians(glm::dvec2(sides.right_deg - sides.left_deg, sides.up_deg - sides.down_deg)) / glm::dvec2(size);
}

std::optional<glm::dvec3> EquirectangularRays::direction(glm::dvec2 pixel) const
{
    const double azimuth = middle_ + (pixel.x - half_width_) * step_.x, elevation = top_ - pixel.y * step_.y;
    if (std::abs(elevation) > pi / 2 + pole_slack)
        return {};
    const double across = std::cos(elevation);
    return turned_ * glm::dvec3(across * std::sin(azimuth), std::sin(elevation), -across * std::cos(azimuth));
}

std::optional<glm::dvec2> EquirectangularRays::pixel(const glm::dvec3& direction) const
{
    const glm::dvec3 d = direction * turned_; // by the transpose: back into the picture's axes
    const double across = std::hypot(d.x, d.z);
    const double beside = across > 0 ? std::remainder(std::atan2(d.x, -d.z) - middle_, 2 * pi) : 0;
    return glm::dvec2(half_width_ + beside / step_.x, (top_ - std::atan2(d.y, across)) / step_.y);
}

double EquirectangularRays::pixel_angle(glm::dvec2 pixel) const
{
    const double elevation = std::abs(top_ - pixel.y * step_.y);
    if (elevation > pi / 2 + pole_slack)
        return 0;
    // sin(upper edge) - sin(lower edge), times one step's width. On a pole itself the mean over the last half pixel
    // replaces it.
    const double across = std::cos(std::min(elevation, pi / 2 - step_.y / 4));
    return std::sqrt(step_.x * 2 * std::sin(step_.y / 2) * std::max(across, 0.0));
}

} // namespace starbow
