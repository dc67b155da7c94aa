#pragma once
#include "config/model/angles.h"
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <optional>

/// Geometry on the unit sphere for tests of displays. It shares no formula with them.
namespace sphere {

using starbow::pi;

inline void expect_near(const std::optional<glm::dvec3>& seen, const glm::dvec3& expected, double tolerance = 1e-14)
{
    ASSERT_TRUE(seen);
    EXPECT_NEAR(glm::distance(*seen, glm::normalize(expected)), 0, tolerance)
        << seen->x << " " << seen->y << " " << seen->z << " is not " << expected.x << " " << expected.y << " " << expected.z;
}

inline void expect_at(const std::optional<glm::dvec2>& pixel, const glm::dvec2& expected, double tolerance = 1e-9)
{
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(glm::distance(*pixel, expected), 0, tolerance)
        << pixel->x << " " << pixel->y << " is not " << expected.x << " " << expected.y;
}

/// Angle between unit vectors, accurate for small angles too.
inline double angle(const glm::dvec3& a, const glm::dvec3& b) { return 2 * std::asin(glm::distance(a, b) / 2); }

/// Area of a spherical triangle from its sides (L'Huilier).
inline double triangle_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
    const double x = angle(b, c), y = angle(c, a), z = angle(a, b), s = (x + y + z) / 2;
    const double t = std::tan(s / 2) * std::tan((s - x) / 2) * std::tan((s - y) / 2) * std::tan((s - z) / 2);
    return 4 * std::atan(std::sqrt(std::max(t, 0.0)));
}

/// Direction that is `azimuth_deg` to the right, then `elevation_deg` up.
inline glm::dvec3 towards(double azimuth_deg, double elevation_deg)
{
    const double a = azimuth_deg * pi / 180, e = elevation_deg * pi / 180;
    return {std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)};
}

} // namespace sphere
