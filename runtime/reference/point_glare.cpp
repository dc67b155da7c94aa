#include "point_glare.h"
#include "config/model/angles.h"
#include <algorithm>
#include <cmath>

namespace starbow {

double glare_per_sr(double angle_deg, double nearest)
{
    const double softened = std::hypot(angle_deg, nearest), age = 1 + std::pow(35 / 62.5, 4);
    return 10 / std::pow(softened, 3) + 5 * age / std::pow(softened, 2);
}

double light_of_glare(double end, double nearest)
{
    const double level = glare_per_sr(end, nearest);
    double part = 0;
    constexpr int rings = 400;
    for (int ring = 0; ring < rings; ++ring) {
        const auto edge = [&](double at) { return end * std::pow(at / rings, 3); };
        const double inner = edge(ring), outer = edge(ring + 1), middle = 0.5 * (inner + outer);
        part += (glare_per_sr(middle, nearest) - level) * pi * (outer * outer - inner * inner) * degree * degree;
    }
    return part;
}

double sun_glare_per_sr(double angle_deg, double nearest)
{
    return glare_per_sr(angle_deg, nearest) * std::pow(1 - std::pow(std::min(angle_deg / sun_glare_deg, 1.0), 2), 2);
}

double light_of_sun_glare(double nearest)
{
    double part = 0;
    constexpr int rings = 400;
    for (int ring = 0; ring < rings; ++ring) {
        const auto edge = [&](double at) { return sun_glare_deg * std::pow(at / rings, 3); };
        const double inner = edge(ring), outer = edge(ring + 1);
        part += sun_glare_per_sr(0.5 * (inner + outer), nearest) * pi * (outer * outer - inner * inner) * degree * degree;
    }
    return part;
}

double glare_radius(const glm::dvec3& light, double exposure, double farthest)
{
    constexpr double shown = 5e-4; // of white
    const double white = std::max({light.r, light.g, light.b}) * exposure;
    double low = 1e-3, high = 1e3;
    for (int i = 0; i < 60; ++i) {
        const double middle = std::sqrt(low * high);
        (white * glare_per_sr(middle, 0) > shown ? low : high) = middle;
    }
    return std::min(low, farthest);
}

} // namespace starbow
