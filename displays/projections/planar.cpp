#include "planar.h"
#include "config/model/turn.h"
#include <cmath>

namespace starbow {

Plane planar_plane(const Planar& planar, glm::ivec2 size)
{
    const auto tangent = [](double deg) { return std::tan(glm::radians(deg)); };
    const glm::dmat3 turned = cockpit_from_picture(planar.turn);
    glm::dvec2 step, axis; // pixels are square unless the sides determine otherwise
    if (const auto& sides = planar.sides) {
        const double left = tangent(sides->left_deg), up = tangent(sides->up_deg);
        step = glm::dvec2(tangent(sides->right_deg) - left, up - tangent(sides->down_deg)) / glm::dvec2(size);
        axis = glm::dvec2(-left, up) / step;
    } else {
        step = glm::dvec2(2 * tangent(planar.fov_y_deg / 2) / size.y);
        axis = glm::dvec2(size) * 0.5;
    }
    return {-turned[2], turned[0] * step.x, turned[1] * -step.y, axis};
}

} // namespace starbow
