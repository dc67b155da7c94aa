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

} // namespace starbow
