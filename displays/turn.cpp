#include "turn.h"
#include <cmath>

namespace starbow {

glm::dmat3 cockpit_from_picture(const Turn& turn)
{
    if (turn.yaw_deg == 0 && turn.pitch_deg == 0 && turn.roll_deg == 0)
        return glm::dmat3(1);
    const auto sine = [](double deg) { return std::sin(glm::radians(deg)); };
    const auto cosine = [](double deg) { return std::cos(glm::radians(deg)); };
    const double cy = cosine(turn.yaw_deg), sy = sine(turn.yaw_deg), cp = cosine(turn.pitch_deg), sp = sine(turn.pitch_deg);
    const double cr = cosine(turn.roll_deg), sr = sine(turn.roll_deg);
    // Columns: where x, y and z go. Turns count from -z to the right, from -z up, from up to the right.
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
