#include "inset_view.h"
#include "angles.h"
#include "config/json/reader.h"
#include <algorithm>
#include <cmath>
#include <glm/gtx/quaternion.hpp>

namespace starbow {

InsetView inset_view_named(std::string_view name)
{
    return InsetView(index_named(name, {inset_view_names.begin(), inset_view_names.end()}, "inset"));
}

glm::dquat towards_flight(const Shot& shot)
{
    const double u = glm::length(shot.u);
    if (u < 1e-9)
        return shot.ship_from_cockpit;
    const glm::dvec3 ahead = shot.u / u, looks = shot.ship_from_cockpit * glm::dvec3(0, 0, -1);
    // By the shortest turn; for a flight backwards about the cockpit's up, so that the picture stays upright.
    if (glm::dot(ahead, looks) < -0.999999)
        return shot.ship_from_cockpit * glm::angleAxis(pi, glm::dvec3(0, 1, 0));
    return glm::normalize(glm::rotation(looks, ahead) * shot.ship_from_cockpit);
}

Shot looking(Shot shot, const glm::dvec3& towards)
{
    const glm::dvec3 up(0, std::abs(towards.y) < 0.999, std::abs(towards.y) >= 0.999);
    shot.ship_from_cockpit = glm::normalize(shot.ship_from_cockpit * glm::quatLookAt(towards, up));
    return shot;
}

double telescope_fov_deg(double u, double before)
{
    // Directions at right angles to the flight are seen at cos(angle) = beta, or tan(angle) = 1 / u.
    return stepped_fov_deg(std::min(2 * std::atan2(1, u) / degree, inset_fov_deg), before);
}

double stepped_fov_deg(double wanted, double before)
{
    if (before > 0 && before > 0.7 * wanted && before < 1.7 * wanted)
        return before;
    double least = inset_fov_deg;
    for (double decade = 10; decade > 1e-7; decade /= 10)
        for (const double step : {4.0, 3.0, 2.0, 1.5, 1.0, 0.8, 0.6})
            if (const double field = step * decade; field < least && field >= wanted)
                least = field;
    return least;
}

} // namespace starbow
