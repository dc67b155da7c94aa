#include "plane.h"
#include <cmath>

namespace starbow {
namespace {

/// The solid angle of a triangle with twice the area `area2` in a plane at distance 1 (van Oosterom and Strackee 1983).
/// Their triple product is just this area, so nothing cancels, however small the pixel.
double triangle_solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double area2)
{
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    return 2 * std::atan2(area2, la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la);
}

} // namespace

Plane::Plane(const glm::dvec3& ahead, const glm::dvec3& right, const glm::dvec3& down, glm::dvec2 axis)
    : ahead_(ahead)
    , right_(right)
    , down_(down)
    , axis_(axis)
{
    const glm::dvec3 across_down = glm::cross(down, ahead), across_right = glm::cross(right, ahead);
    along_right_ = across_down / glm::dot(across_down, right);
    along_down_ = across_right / glm::dot(across_right, down);
}

std::optional<glm::dvec2> Plane::pixel(const glm::dvec3& direction) const
{
    const double depth = glm::dot(direction, ahead_);
    const double x = glm::dot(direction, along_right_) / depth, y = glm::dot(direction, along_down_) / depth;
    if (!(depth > 0) || !std::isfinite(x) || !std::isfinite(y))
        return {};
    return axis_ + glm::dvec2(x, y);
}

double Plane::pixel_angle(glm::dvec2 pixel) const
{
    const glm::dvec3 centre = point(pixel), x = right_ / 2., y = down_ / 2.;
    const glm::dvec3 a = centre - x - y, b = centre + x - y, c = centre + x + y, d = centre - x + y;
    const double area2 = glm::length(glm::cross(right_, down_));
    return std::sqrt(triangle_solid_angle(a, b, c, area2) + triangle_solid_angle(a, c, d, area2));
}

glm::dmat3 Plane::matrix() const { return {right_, down_, point({0, 0})}; }

} // namespace starbow
