#pragma once
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace starbow {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180; ///< radians

/// The angle between directions of any length, radians; accurate for small and for opposite ones.
inline double angle_between(const glm::dvec3& a, const glm::dvec3& b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// The unit direction of the cockpit at an azimuth to the right of straight ahead (-z) and then an elevation up.
inline glm::dvec3 direction_of(const glm::dvec2& azimuth_elevation_deg)
{
    const glm::dvec2 at = glm::radians(azimuth_elevation_deg);
    return {std::cos(at.y) * std::sin(at.x), std::sin(at.y), -std::cos(at.y) * std::cos(at.x)};
}
/// The inverse, for a direction of any length: -180 to 180 and -90 to 90 degrees.
inline glm::dvec2 azimuth_elevation_deg(const glm::dvec3& d)
{
    return glm::degrees(glm::dvec2(std::atan2(d.x, -d.z), std::atan2(d.y, std::hypot(d.x, d.z))));
}

} // namespace starbow
