#include "turn.h"
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace starbow {

Turn turn_of(const glm::dmat3& axes)
{
    const glm::dvec3 ahead = -axes[2];
    // If the view is straight up or down, the picture's upper edge gives the azimuth.
    const bool level = std::hypot(ahead.x, ahead.z) > 1e-9;
    const double yaw = level ? std::atan2(ahead.x, -ahead.z) : std::atan2(-ahead.y * axes[1].x, ahead.y * axes[1].z);
    const glm::dvec3 right(std::cos(yaw), 0, std::sin(yaw));
    const glm::dvec3 up = glm::cross(right, ahead);
    const double roll = level ? std::atan2(-glm::dot(axes[0], up), glm::dot(axes[0], right)) : 0;
    return {glm::degrees(yaw), glm::degrees(std::asin(std::clamp(ahead.y, -1.0, 1.0))), glm::degrees(roll)};
}

Turn turn_of(double x, double y, double z, double w) { return turn_of(glm::mat3_cast(glm::dquat(w, x, y, z))); }

glm::dmat3 cockpit_from_picture(const Turn& turn)
{
    if (turn.yaw_deg == 0 && turn.pitch_deg == 0 && turn.roll_deg == 0)
        return glm::dmat3(1);
    const auto sine = [](double deg) { return std::sin(glm::radians(deg)); };
    const auto cosine = [](double deg) { return std::cos(glm::radians(deg)); };
    const double cy = cosine(turn.yaw_deg), sy = sine(turn.yaw_deg), cp = cosine(turn.pitch_deg), sp = sine(turn.pitch_deg);
    const double cr = cosine(turn.roll_deg), sr = sine(turn.roll_deg);
    // The columns are the images of x, y and z. Positive turns go from -z to the right, from -z up, and from up to the
    // right.
    const glm::dmat3 yaw{{cy, 0, sy}, {0, 1, 0}, {-sy, 0, cy}};
    const glm::dmat3 pitch{{1, 0, 0}, {0, cp, sp}, {0, -sp, cp}};
    const glm::dmat3 roll{{cr, -sr, 0}, {sr, cr, 0}, {0, 0, 1}};
    return yaw * pitch * roll;
}

glm::dvec3 dome_zenith(double tilt_deg)
{
    const double tilt = glm::radians(tilt_deg);
    return {0, std::cos(tilt), -std::sin(tilt)};
}

} // namespace starbow
