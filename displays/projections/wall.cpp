#include "wall.h"
#include <cmath>

namespace starbow {
namespace {

/// Corners that no rounding of a file's digits tells from a right angle stay as they are.
constexpr double right_angle = 1e-12;

/// The nearest rectangle to three corners. In their plane let b lead from the lower left corner to the lower right one, c to
/// the upper left one, and u and v be the rectangle's axes. The lower corners then miss its lower edge by b.v in all, and
/// the left ones its left edge by c.u; each corner takes half of it. The sum of squares is least where tan 2 angle = -2 c.x
/// c.y / (b^2 + c.y^2 - c.x^2), with x along b.
WallCorners rectangle(const Wall& wall)
{
    const glm::dvec3 b = wall.lower_right_m - wall.lower_left_m, c = wall.upper_left_m - wall.lower_left_m;
    const double width = glm::length(b), slip = glm::dot(b, c) / width;
    const glm::dvec3 x = b / width, y = glm::normalize(c - slip * x);
    if (std::abs(slip) <= right_angle * glm::length(c))
        return {{wall.lower_left_m, wall.lower_right_m, wall.lower_right_m + c, wall.upper_left_m}, {}};
    const double height = glm::dot(c, y);
    const double angle = 0.5 * std::atan2(-2 * slip * height, width * width + height * height - slip * slip);
    const glm::dvec3 u = std::cos(angle) * x + std::sin(angle) * y, v = std::cos(angle) * y - std::sin(angle) * x;
    const glm::dvec3 across = glm::dot(c, u) * u / 2., upward = glm::dot(b, v) * v / 2.;
    const glm::dvec3 lower_left = wall.lower_left_m + across + upward, lower_right = wall.lower_right_m - upward,
                     upper_left = wall.upper_left_m - across;
    return {{lower_left, lower_right, lower_right + (upper_left - lower_left), upper_left},
        {glm::length(across + upward), glm::length(upward), 0, glm::length(across)}};
}

} // namespace

WallCorners fitted_corners(const Wall& wall)
{
    if (!wall.upper_right_m)
        return rectangle(wall);
    // The nearest plane lies between the two diagonals.
    std::array<glm::dvec3, 4> at{wall.lower_left_m, wall.lower_right_m, *wall.upper_right_m, wall.upper_left_m};
    const glm::dvec3 normal = glm::normalize(glm::cross(at[1] - at[3], at[2] - at[0]));
    const double half = glm::dot(normal, at[1] - at[0]) / 2;
    for (std::size_t i = 0; i < 4; ++i)
        at[i] += (i % 2 == 0 ? half : -half) * normal;
    return {at, {std::abs(half), std::abs(half), std::abs(half), std::abs(half)}};
}

std::optional<Plane> wall_plane(const Wall& wall, glm::ivec2 size, const glm::dvec3& eye_m)
{
    const auto [lower_left, lower_right, upper_right, upper_left] = fitted_corners(wall).at;
    const glm::dvec3 width = lower_right - lower_left, height = upper_left - lower_left;
    const glm::dvec3 to_room = glm::normalize(glm::cross(width, height));
    const double distance = glm::dot(eye_m - lower_left, to_room);
    if (!(distance > 1e-9 * (glm::length(width) + glm::length(height)))) // also for collinear corners
        return {};
    // The wall is scaled towards the eye to distance 1; every angle stays.
    const glm::dvec3 right = width / (distance * size.x), down = height / (-distance * size.y);
    const Plane from_corner(-to_room, right, down, {0, 0});
    const glm::dvec2 corner = *from_corner.pixel((upper_left - eye_m) / distance);
    return Plane(-to_room, right, down, -corner);
}

std::optional<Keystone> wall_keystone(const Wall& wall, glm::ivec2 size, const glm::dvec3& eye_m)
{
    const auto [lower_left, lower_right, upper_right, upper_left] = fitted_corners(wall).at;
    return keystone(upper_left - eye_m, upper_right - eye_m, lower_right - eye_m, lower_left - eye_m, size);
}

} // namespace starbow
