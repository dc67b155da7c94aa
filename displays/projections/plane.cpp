#include "plane.h"
#include <cmath>

namespace starbow {
namespace {

/// The solid angle of a triangle by its corners and their triple product (van Oosterom and Strackee 1983). Where the product
/// is known otherwise, nothing cancels, however small the pixel.
double triangle_solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double triple)
{
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    return 2 * std::atan2(triple, la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la);
}

} // namespace

double pixel_solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d, double triple)
{
    return triangle_solid_angle(a, b, c, triple) + triangle_solid_angle(a, c, d, triple);
}

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
    // In a plane at distance 1 the triple product is the pixel's area.
    return std::sqrt(pixel_solid_angle(a, b, c, d, glm::length(glm::cross(right_, down_))));
}

glm::dmat3 Plane::matrix() const { return {right_, down_, point({0, 0})}; }

} // namespace starbow
