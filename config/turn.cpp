#include "turn.h"
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace starbow {

Turn turn_of(const glm::dmat3& axes)
{
    const glm::dvec3 ahead = -axes[2];
    // The picture's upper edge tells the way where the view goes straight up or down.
    const bool level = std::hypot(ahead.x, ahead.z) > 1e-9;
    const double yaw = level ? std::atan2(ahead.x, -ahead.z) : std::atan2(-ahead.y * axes[1].x, ahead.y * axes[1].z);
    const glm::dvec3 right(std::cos(yaw), 0, std::sin(yaw));
    const glm::dvec3 up = glm::cross(right, ahead);
    const double roll = level ? std::atan2(-glm::dot(axes[0], up), glm::dot(axes[0], right)) : 0;
    return {glm::degrees(yaw), glm::degrees(std::asin(std::clamp(ahead.y, -1.0, 1.0))), glm::degrees(roll)};
}

Turn turn_of(double x, double y, double z, double w) { return turn_of(glm::mat3_cast(glm::dquat(w, x, y, z))); }

} // namespace starbow
