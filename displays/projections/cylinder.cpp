#include "cylinder.h"
#include "config/model/angles.h"
#include "config/model/turn.h"
#include <cmath>

namespace starbow {

CylinderRays::CylinderRays(const Cylinder& cylinder, glm::ivec2 size)
    : turned_(cockpit_from_picture(cylinder.turn))
    , half_width_(size.x * 0.5)
{
    const Sides& sides = cylinder.sides;
    middle_ = glm::radians(sides.left_deg + sides.right_deg) / 2;
    top_ = std::tan(glm::radians(sides.up_deg));
    const double bottom = std::tan(glm::radians(sides.down_deg));
    step_ = glm::dvec2(glm::radians(sides.right_deg - sides.left_deg), top_ - bottom) / glm::dvec2(size);
}

std::optional<glm::dvec3> CylinderRays::direction(glm::dvec2 pixel) const
{
    const double azimuth = middle_ + (pixel.x - half_width_) * step_.x, height = top_ - pixel.y * step_.y;
    return glm::normalize(turned_ * glm::dvec3(std::sin(azimuth), height, -std::cos(azimuth)));
}

std::optional<glm::dvec2> CylinderRays::pixel(const glm::dvec3& direction) const
{
    const glm::dvec3 d = direction * turned_; // by the transpose: back into the picture's axes
    const double across = std::hypot(d.x, d.z), y = (top_ - d.y / across) / step_.y;
    if (!(across > 0) || !std::isfinite(y))
        return {};
    const double beside = std::remainder(std::atan2(d.x, -d.z) - middle_, 2 * pi);
    return glm::dvec2(half_width_ + beside / step_.x, y);
}

double CylinderRays::pixel_angle(glm::dvec2 pixel) const
{
    // The wall's area times the cosine of the incidence, 1 / distance, over the distance squared.
    const double height = top_ - pixel.y * step_.y, distance2 = 1 + height * height;
    return std::sqrt(step_.x * step_.y / (distance2 * std::sqrt(distance2)));
}

} // namespace starbow
