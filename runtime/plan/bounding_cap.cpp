#include "bounding_cap.h"
#include <algorithm>
#include <cmath>

namespace starbow {

BoundingCap bounding_cap(std::span<const BoundingSphere> spheres)
{
    BoundingCap cap{.radius_rad = -1};
    glm::dvec3 sum(0);
    for (const BoundingSphere& one : spheres)
        if (const double distance = glm::length(one.centre); distance > one.radius)
            sum += one.centre / distance * (one.radius / distance);
    if (glm::length(sum) > 0)
        cap.axis = glm::normalize(sum);
    for (const BoundingSphere& one : spheres) {
        const double distance = glm::length(one.centre);
        if (!(distance > one.radius * 1.0001))
            return {.axis = cap.axis}; // the eye is inside
        const double away = angle_between(cap.axis, one.centre / distance);
        cap.radius_rad = std::max(cap.radius_rad, std::min(pi, away + std::asin(one.radius / distance)));
    }
    return cap;
}

glm::dvec4 cap_in_ship(const BoundingCap& cap, double E)
{
    const double radius = cap.radius_rad + cap.filter_rad;
    if (!(radius < pi))
        return {0, 0, 1, -2};
    const double cosh = 0.5 * (E + 1 / E), sinh = 0.5 * (E - 1 / E), least = std::cos(radius);
    const glm::dvec3 axis(cap.axis.x, cap.axis.y, cosh * cap.axis.z + sinh * least);
    const double length = glm::length(axis), part = (sinh * cap.axis.z + cosh * least) / length;
    return std::isfinite(part) && length > 0 ? glm::dvec4(axis / length, part) : glm::dvec4(0, 0, 1, -2);
}

} // namespace starbow
