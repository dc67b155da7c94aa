#include "keystone.h"
#include "plane.h"
#include <algorithm>
#include <cmath>

namespace starbow {

Keystone::Keystone(const glm::dmat3& m)
    : m_(m)
    , inverse_(glm::inverse(m))
{
}

std::optional<glm::dvec2> Keystone::pixel(const glm::dvec3& direction) const
{
    const glm::dvec3 at = inverse_ * direction;
    const glm::dvec2 pixel = glm::dvec2(at) / at.z;
    if (!(at.z > 0) || !std::isfinite(pixel.x) || !std::isfinite(pixel.y))
        return {};
    return pixel;
}

double Keystone::pixel_angle(glm::dvec2 pixel) const
{
    const glm::dvec3 centre = m_ * glm::dvec3(pixel, 1), x = m_[0] / 2., y = m_[1] / 2.;
    return std::sqrt(
        pixel_solid_angle(centre - x - y, centre + x - y, centre + x + y, centre - x + y, std::abs(glm::determinant(m_))));
}

std::optional<Keystone> keystone(const glm::dvec3& upper_left, const glm::dvec3& upper_right, const glm::dvec3& lower_right,
    const glm::dvec3& lower_left, glm::ivec2 size)
{
    // A projective map of the unit square: its corners' lengths are those with which opposite corners have the same sum.
    const glm::dmat3 three(upper_right, lower_left, -upper_left);
    const double longest = std::max({glm::length(upper_left), glm::length(upper_right), glm::length(lower_left)});
    if (!(glm::determinant(three) < -1e-9 * longest * longest * longest))
        return {};
    const glm::dvec3 lengths = glm::inverse(three) * lower_right;
    if (!(lengths.x > 0 && lengths.y > 0 && lengths.z > 0))
        return {};
    const glm::dvec3 corner = lengths.z * upper_left;
    return Keystone(glm::dmat3(
        (lengths.x * upper_right - corner) / double(size.x), (lengths.y * lower_left - corner) / double(size.y), corner));
}

} // namespace starbow
