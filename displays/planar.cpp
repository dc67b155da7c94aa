#include "planar.h"
#include <cmath>

namespace starbow {
namespace {

/// Width of a pixel in the plane one unit ahead; pixels are square.
double pixel_size(const Planar& planar, glm::ivec2 size)
{
    return 2 * std::tan(glm::radians(planar.fov_y_deg) / 2) / size.y;
}

/// The point of the plane one unit ahead that a pixel shows.
glm::dvec3 in_plane(const Planar& planar, glm::ivec2 size, glm::dvec2 pixel)
{
    const double step = pixel_size(planar, size);
    return {(pixel.x - size.x * 0.5) * step, (size.y * 0.5 - pixel.y) * step, -1};
}

/// Solid angle of a triangle of that plane with twice the area `area2` (van Oosterom and Strackee 1983). For a plane at
/// distance 1 their triple product is just this area, so nothing cancels, however small the pixel.
double triangle_solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double area2)
{
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    return 2 * std::atan2(area2, la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la);
}

} // namespace

glm::dmat3 planar_direction_matrix(const Planar& planar, glm::ivec2 size)
{
    const double step = pixel_size(planar, size);
    return {{step, 0, 0}, {0, -step, 0}, {-size.x * 0.5 * step, size.y * 0.5 * step, -1}};
}

glm::dvec3 planar_direction(const Planar& planar, glm::ivec2 size, glm::dvec2 pixel)
{
    return glm::normalize(in_plane(planar, size, pixel));
}

std::optional<glm::dvec2> planar_pixel(const Planar& planar, glm::ivec2 size, const glm::dvec3& direction)
{
    const double step = pixel_size(planar, size);
    const double x = direction.x / -direction.z / step, y = direction.y / -direction.z / step;
    if (!(direction.z < 0) || !std::isfinite(x) || !std::isfinite(y))
        return {};
    return glm::dvec2(size.x * 0.5 + x, size.y * 0.5 - y);
}

double planar_pixel_angle(const Planar& planar, glm::ivec2 size, glm::dvec2 pixel)
{
    const double step = pixel_size(planar, size), half = step / 2;
    const glm::dvec3 centre = in_plane(planar, size, pixel);
    const glm::dvec3 a = centre + glm::dvec3(-half, -half, 0), b = centre + glm::dvec3(half, -half, 0);
    const glm::dvec3 c = centre + glm::dvec3(half, half, 0), d = centre + glm::dvec3(-half, half, 0);
    const double area2 = step * step;
    return std::sqrt(triangle_solid_angle(a, b, c, area2) + triangle_solid_angle(a, c, d, area2));
}

} // namespace starbow
