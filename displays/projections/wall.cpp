#include "wall.h"

namespace starbow {

std::optional<Plane> wall_plane(const Wall& wall, glm::ivec2 size, const glm::dvec3& eye_m)
{
    const glm::dvec3 width = wall.lower_right_m - wall.lower_left_m, height = wall.upper_left_m - wall.lower_left_m;
    const glm::dvec3 to_room = glm::normalize(glm::cross(width, height));
    const double distance = glm::dot(eye_m - wall.lower_left_m, to_room);
    if (!(distance > 1e-9 * (glm::length(width) + glm::length(height)))) // also for collinear corners
        return {};
    // The wall is scaled towards the eye to distance 1; every angle stays.
    const glm::dvec3 right = width / (distance * size.x), down = height / (-distance * size.y);
    const Plane from_corner(-to_room, right, down, {0, 0});
    const glm::dvec2 corner = *from_corner.pixel((wall.upper_left_m - eye_m) / distance);
    return Plane(-to_room, right, down, -corner);
}

} // namespace starbow
