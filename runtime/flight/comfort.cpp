#include "comfort.h"
#include "flight.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

const glm::dvec3 upward(0, 1, 0), rightward(1, 0, 0), forward(0, 0, -1);
constexpr double level_enough = 1e-12;

} // namespace

Aim aim_of(const glm::dquat& ship_from_cockpit)
{
    const glm::dvec3 ahead = ship_from_cockpit * forward, right = ship_from_cockpit * rightward;
    const double flat = std::hypot(ahead.x, ahead.z);
    return {flat > 1e-6 ? std::atan2(-ahead.x, -ahead.z) : std::atan2(-right.z, right.x), std::atan2(ahead.y, flat)};
}

glm::dquat level_cockpit(const Aim& aim)
{
    return glm::angleAxis(aim.heading, upward) * glm::angleAxis(aim.pitch, rightward);
}

glm::dquat levelled(const glm::dquat& ship_from_cockpit)
{
    const glm::dvec3 right = ship_from_cockpit * rightward, up = ship_from_cockpit * upward;
    Aim aim = aim_of(ship_from_cockpit);
    if (std::abs(right.y) < level_enough && up.y > 0 && std::abs(aim.pitch) <= most_pitch_rad + level_enough)
        return ship_from_cockpit;
    aim.pitch = std::clamp(aim.pitch, -most_pitch_rad, most_pitch_rad);
    return level_cockpit(aim);
}

glm::dvec2 turns_between(const Aim& from, const Aim& to)
{
    return {to.pitch - from.pitch, std::remainder(to.heading - from.heading, 2 * pi)};
}

glm::dvec3 about_cockpit(const glm::dvec3& turn, const glm::dquat& ship_from_cockpit, const Comfort& comfort)
{
    if (!comfort.level_horizon)
        return turn;
    return glm::dvec3(turn.x, 0, 0) + glm::inverse(ship_from_cockpit) * glm::dvec3(0, turn.y, 0);
}

double vignette_after(double now, double turned_rad, const Flying& rules)
{
    if (!rules.comfort.vignette || rules.comfort.turn_steps_deg > 0)
        return 0;
    constexpr double slowest = 0.02, whole = 0.5; // of the rules' rate; a slower turn is none
    constexpr double fades_s = 0.08, least = 1e-3;
    const double part = turned_rad / (tick_s * degree * rules.turn_deg_per_s);
    const double wanted = std::clamp((part - slowest) / (whole - slowest), 0.0, 1.0);
    const double next = now - std::expm1(-tick_s / fades_s) * (wanted - now);
    return wanted == 0 && next < least ? 0 : next;
}

} // namespace starbow
