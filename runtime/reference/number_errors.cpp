#include "number_errors.h"
#include "shaders/physics/physics.h"
#include <algorithm>
#include <cmath>
#include <map>

namespace starbow {
namespace {

double angle(const glm::dvec3& a, const glm::dvec3& b) { return 2 * std::asin(std::min(1.0, 0.5 * glm::length(a - b))); }

constexpr double resolved_rad = 6e-8; // three components, each rounded to a float
constexpr double resolved_part = 6e-8; // of the part across the motion

/// The angle between the world directions of the same pixel beyond a float's resolution. Close to the motion's axis the
/// parts across it resolve a pixel at any speed; elsewhere the directions do.
double apart(const Reference::Numbers& truth, const glm::dvec3& world, const glm::dvec3& across)
{
    const double sine = glm::length(truth.across);
    return sine < 0.01 ? glm::length(truth.across - across) - resolved_part * sine
                       : angle(truth.world, world) - resolved_rad;
}

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
               &D = *planes.at("doppler"), &across_x = *planes.at("worldAcross.X"), &across_y = *planes.at("worldAcross.Y"),
               &across_z = *planes.at("worldAcross.Z");
    NumberErrors errors;
    for (int row = 0; row < truth.size.y; ++row)
        for (int column = 0; column < truth.size.x; ++column) {
            const std::size_t i = std::size_t(row) * std::size_t(truth.size.x) + std::size_t(column);
            const Reference::Numbers& here = truth.numbers[i];
            if (!here.shown || std::isnan(x[i]))
                continue;
            for (const char* name : {"R", "G", "B", "worldDirection.X", "worldDirection.Y", "worldDirection.Z", "doppler",
                     "worldAcross.X", "worldAcross.Y", "worldAcross.Z"})
                errors.finite = errors.finite && std::isfinite((*planes.at(name))[i]);
            const double theta = angle(ahead, here.camera);
            const double greatest = doppler_at(std::max(0.0, theta - slack_rad)), least = doppler_at(theta + slack_rad);
            errors.doppler.push_back(std::max(
                {0.0, D[i] / here.D - std::max(1.0, greatest / here.D), std::min(1.0, least / here.D) - D[i] / here.D}));
            if (column + 1 == truth.size.x || !truth.numbers[i + 1].shown)
                continue;
            if (const double pixel = angle(here.world, truth.numbers[i + 1].world); pixel > 0)
                errors.directions_px.push_back(
                    std::max(0.0,
                        apart(here, glm::normalize(glm::dvec3(x[i], y[i], z[i])), {across_x[i], across_y[i], across_z[i]})
                            - slack_rad * greatest)
                    / pixel);
        }
    return errors;
}

} // namespace starbow
