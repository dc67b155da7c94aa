#include "number_errors.h"
#include "shaders/physics/physics.h"
#include <algorithm>
#include <cmath>
#include <map>

namespace starbow {
namespace {

double angle(const glm::dvec3& a, const glm::dvec3& b) { return 2 * std::asin(std::min(1.0, 0.5 * glm::length(a - b))); }

constexpr double resolved_rad = 6e-8; // three components, each rounded to a float

} // namespace

NumberErrors number_errors(const Reference& truth, const Channels& live, const glm::dvec3& u, double slack_rad)
{
    const double speed = glm::length(u), E = physics::exp_rapidity(speed);
    const glm::dvec3 ahead = speed > 0 ? u / speed : glm::dvec3(0, 0, 1);
    // D at an angle from straight ahead, on board.
    const auto doppler_at = [&](double theta) {
        const double s = std::pow(std::sin(0.5 * theta), 2), c = std::pow(std::cos(0.5 * theta), 2);
        return 1 / (c / E + s * E);
    };

    std::map<std::string, const std::vector<float>*> planes;
    for (const auto& [name, values] : live)
        planes[name] = &values;
    const auto &x = *planes.at("worldDirection.X"), &y = *planes.at("worldDirection.Y"), &z = *planes.at("worldDirection.Z"),
               &D = *planes.at("doppler");
    NumberErrors errors;
    for (int row = 0; row < truth.size.y; ++row)
        for (int column = 0; column < truth.size.x; ++column) {
            const std::size_t i = std::size_t(row) * std::size_t(truth.size.x) + std::size_t(column);
            const Reference::Numbers& here = truth.numbers[i];
            if (!here.shown || std::isnan(x[i]))
                continue;
            for (const char* name : {"R", "G", "B", "worldDirection.X", "worldDirection.Y", "worldDirection.Z", "doppler"})
                errors.finite = errors.finite && std::isfinite((*planes.at(name))[i]);
            const double theta = angle(ahead, here.camera);
            const double greatest = doppler_at(std::max(0.0, theta - slack_rad)), least = doppler_at(theta + slack_rad);
            errors.doppler.push_back(std::max(
                {0.0, D[i] / here.D - std::max(1.0, greatest / here.D), std::min(1.0, least / here.D) - D[i] / here.D}));
            if (column + 1 == truth.size.x || !truth.numbers[i + 1].shown)
                continue;
            if (const double pixel = angle(here.world, truth.numbers[i + 1].world); pixel > 0)
                errors.directions_px.push_back(std::max(0.0,
                                                   angle(here.world, glm::normalize(glm::dvec3(x[i], y[i], z[i])))
                                                       - resolved_rad - slack_rad * greatest)
                    / pixel);
        }
    return errors;
}

} // namespace starbow
