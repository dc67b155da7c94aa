#include "pace.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace starbow {
namespace {

/// The time of the planned flight at a pace, s; infinite beyond ten times the planned one.
double time_of(
    const Pace& pace, const PlannedFlight& planned, const Shot& start, const Flying& rules, double seconds_per_time_unit)
{
    const glm::dvec3 ahead = start.ship_from_cockpit * glm::dvec3(0, 0, -1);
    const double step_s = planned.time_s / 2000, most = std::acosh(rules.max_gamma);
    Ship ship = ship_at(start);
    double w = rapidity_of(ship), flown = 0, time_s = 0;
    for (; flown < planned.distance; time_s += step_s) {
        if (time_s > 10 * planned.time_s)
            return std::numeric_limits<double>::infinity();
        ship.position = Sum3(start.position + flown * ahead);
        ship.u = Sum3(std::sinh(w) * ahead);
        const double gain = std::min(rules.rapidity_per_s, paced_gain(pace, ship, seconds_per_time_unit));
        const double after = std::min(w + gain * step_s, std::max(w, most));
        flown += 0.5 * (std::sinh(w) + std::sinh(after)) * step_s / seconds_per_time_unit;
        w = after;
    }
    return time_s;
}

} // namespace

double nearest(const Pace& pace, const glm::dvec3& place)
{
    if (pace.things.empty())
        return pace.least;
    double squared = std::numeric_limits<double>::infinity();
    for (const AlignedBox& box : pace.things) {
        // By components: this loop is half of the search for a pace, and glm::max stays a call at -O1.
        double apart = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double below = box.low[axis] - place[axis], above = place[axis] - box.high[axis];
            const double outside = below > above ? below : above;
            apart += outside > 0 ? outside * outside : 0;
        }
        squared = apart < squared ? apart : squared;
    }
    return std::max(std::sqrt(squared), pace.least);
}

double paced_gain(const Pace& pace, const Ship& ship, double seconds_per_time_unit)
{
    const double speed = glm::length(ship.u.total());
    return speed > 0 ? pace.per_s2 * nearest(pace, ship.position.total()) / speed * seconds_per_time_unit
                     : std::numeric_limits<double>::infinity();
}

Pace pace_for(const PlannedFlight& planned, std::vector<AlignedBox> things, const Shot& start, const Flying& rules,
    double seconds_per_time_unit)
{
    // Inside a thing's box, as in a house, the ship is as near to it as this.
    constexpr double least_part = 0.005;
    Pace pace{.least = least_part * planned.distance, .things = std::move(things)};
    // A faster pace makes a shorter flight, so a bisection of its logarithm finds it.
    double low = std::log(1e-9), high = std::log(1e9);
    for (int i = 0; i < 24; ++i) {
        const double middle = 0.5 * (low + high);
        pace.per_s2 = std::exp(middle);
        (time_of(pace, planned, start, rules, seconds_per_time_unit) > planned.time_s ? low : high) = middle;
    }
    pace.per_s2 = std::exp(high);
    return pace;
}

} // namespace starbow
