#include "solids.h"
#include "boundary.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace starbow {

glm::dvec3 place_of(const Solid& solid, double time)
{
    const double t = time / solid.span;
    glm::dvec3 place(0);
    for (std::size_t k = solid.path.size(); k-- > 0;)
        place = place * t + solid.path[k];
    return place;
}

double rapidity_above(std::span<const Solid> solids, const Ship& ship, const Flying& rules, double seconds_per_time_unit)
{
    const glm::dvec3 u = ship.u.total(), from = ship.position.total();
    const double speed = glm::length(u);
    const glm::dvec3 way = speed > 0 ? u / speed : ship.ship_from_cockpit * glm::dvec3(0, 0, -1);
    double least = std::numeric_limits<double>::infinity();
    for (const Solid& solid : solids) {
        const glm::dvec3 to = place_of(solid, ship.time.total()) - from;
        const double along = glm::dot(to, way);
        const double half_chord_squared = solid.radius * solid.radius - (glm::dot(to, to) - along * along);
        if (along > 0 && half_chord_squared > 0)
            least = std::min(least, along - std::sqrt(half_chord_squared));
    }
    return rapidity_to_stop(least, rules, seconds_per_time_unit);
}

Ship kept_outside(std::span<const Solid> solids, const glm::dvec3& before, Ship ship)
{
    for (const Solid& solid : solids) {
        const glm::dvec3 middle = place_of(solid, ship.time.total());
        const glm::dvec3 from = before - middle, to = ship.position.total() - middle, step = to - from;
        // The way from + part step meets the ground at the first root of a quadratic equation. A ship that a planet flies
        // into is inside without a way.
        const double a = glm::dot(step, step), half_b = glm::dot(from, step);
        const double root = half_b * half_b - a * (glm::dot(from, from) - solid.radius * solid.radius);
        const double part = half_b < 0 && root >= 0 ? std::max(0.0, (-half_b - std::sqrt(root)) / a) : 2;
        if (part > 1 && glm::length(to) >= solid.radius)
            continue;
        const glm::dvec3 up = glm::normalize(part > 1 ? to : from + part * step), u = ship.u.total();
        const double falls = -glm::dot(u, up);
        const glm::dvec3 along = u + falls * up;
        ship.position = Sum3(middle + solid.radius * up);
        if (falls > 0)
            ship.u = falls > glm::length(along) ? Sum3() : Sum3(along);
    }
    return ship;
}

} // namespace starbow
