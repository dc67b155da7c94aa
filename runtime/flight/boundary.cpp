#include "boundary.h"
#include "comfort.h"
#include "config/model/angles.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace starbow {
namespace {

/// The part of the radius at which the throttle's speed is 0 and the way home begins: the pilot follows a little late.
constexpr double edge = 0.9;
/// The part of the rules' gain with which the greatest rapidity falls, so that the late pilot has some left.
constexpr double followed_part = 0.4;

} // namespace

double rapidity_within(const Boundary& boundary, const Ship& ship, const Flying& rules, double seconds_per_time_unit)
{
    const glm::dvec3 from = ship.position.total() - boundary.centre;
    const double room = edge * boundary.radius - glm::length(from);
    if (room < 0 && glm::dot(from, ship.ship_from_cockpit * glm::dvec3(0, 0, -1)) < 0)
        return std::numeric_limits<double>::infinity();
    return rapidity_to_stop(room, rules, seconds_per_time_unit);
}

double rapidity_to_stop(double room, const Flying& rules, double seconds_per_time_unit)
{
    return std::acosh(1 + followed_part * rules.rapidity_per_s * std::max(0.0, room) * seconds_per_time_unit);
}

bool leaves(const Boundary& boundary, const Ship& ship)
{
    const glm::dvec3 from = ship.position.total() - boundary.centre;
    return glm::length(from) > edge * boundary.radius && glm::dot(from, ship.u.total()) > 0;
}

std::optional<glm::dvec3> turn_towards(const glm::dvec3& place, const Ship& ship, const Flying& rules)
{
    constexpr double there_rad = 3 * degree;
    const Comfort& comfort = rules.comfort;
    glm::dvec3 to = place - ship.position.total();
    if (!comfort.level_horizon)
        to = glm::inverse(ship.ship_from_cockpit) * to;
    Aim aim{std::atan2(-to.x, -to.z), std::atan2(to.y, std::hypot(to.x, to.z))};
    if (comfort.level_horizon) {
        aim.pitch = std::clamp(aim.pitch, -most_pitch_rad, most_pitch_rad);
        const glm::dvec2 turns = turns_between(aim_of(ship.ship_from_cockpit), aim);
        aim = {turns.y, turns.x};
    }
    const double yaw = aim.heading, pitch = aim.pitch;
    if (std::max(std::abs(yaw), std::abs(pitch)) < there_rad)
        return {};
    // It slows down over the last half second of the way.
    constexpr double closely_s = 0.5;
    const double rate = degree * (comfort.turn_steps_deg > 0 ? comfort.turn_steps_deg : rules.turn_deg_per_s * closely_s);
    // A pitch raises what lies ahead and lowers what lies behind, so it waits for the yaw.
    return glm::clamp(glm::dvec3(pitch * std::max(0.0, std::cos(yaw)), yaw, 0) / rate, -1.0, 1.0);
}

} // namespace starbow
