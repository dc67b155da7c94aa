#include "pointer.h"
#include "config/model/angles.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// From one unit direction towards another along the great circle, by an angle at most.
glm::dvec3 turned(const glm::dvec3& from, const glm::dvec3& to, double most_rad)
{
    if (angle_between(from, to) <= most_rad)
        return to;
    glm::dvec3 across = to - glm::dot(from, to) * from;
    if (glm::length(across) < 1e-9) // right behind: any way is as short
        across = glm::cross(from, std::abs(from.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0));
    return glm::normalize(std::cos(most_rad) * from + std::sin(most_rad) * glm::normalize(across));
}

} // namespace

void Pointer::touch(double azimuth_deg, double elevation_deg)
{
    target_ = direction_of({azimuth_deg, elevation_deg});
    left_s_ = stays_s;
    if (strength_ == 0)
        towards_ = target_;
}

void Pointer::advance(double dt_s)
{
    towards_ = turned(towards_, target_, fastest_deg_per_s * degree * dt_s);
    strength_ = std::clamp(strength_ + (left_s_ > 0 ? dt_s : -dt_s) / fade_s, 0.0, 1.0);
    left_s_ = std::max(0.0, left_s_ - dt_s);
}

std::optional<Pointer::Shown> Pointer::shown() const
{
    if (strength_ == 0)
        return {};
    return Shown{towards_, strength_};
}

} // namespace starbow
