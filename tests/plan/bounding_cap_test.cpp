// The cap around a rest frame's surfaces, as the ship sees it, against single directions that are aberrated one by one.
#include "runtime/plan/bounding_cap.h"
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace bounding_cap_test {

using namespace starbow;

namespace {

struct Random {
    std::mt19937 engine{7};
    std::normal_distribution<double> normal{};
    glm::dvec3 direction() { return glm::normalize(glm::dvec3(normal(engine), normal(engine), normal(engine))); }
    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
};

/// Aberration by the angle from the motion: tan of its half is divided by E.
glm::dvec3 seen_from_ship(const glm::dvec3& n, double E)
{
    const double angle = 2 * std::atan2(std::tan(0.5 * std::acos(n.z)), E), across = std::hypot(n.x, n.y);
    return {std::sin(angle) * n.x / across, std::sin(angle) * n.y / across, std::cos(angle)};
}

} // namespace

TEST(BoundingCap, HoldsEverySphere)
{
    Random random;
    for (int turn = 0; turn < 200; ++turn) {
        std::vector<BoundingSphere> spheres;
        for (int i = 0; i < 1 + turn % 5; ++i)
            spheres.push_back({random.direction() * random.between(2, 100), random.between(0.01, 1.9)});
        const BoundingCap cap = bounding_cap(spheres);
        for (const BoundingSphere& one : spheres)
            for (int k = 0; k < 50; ++k) {
                const glm::dvec3 to = glm::normalize(one.centre + one.radius * random.direction());
                EXPECT_LE(std::acos(glm::dot(to, cap.axis)), cap.radius_rad + 1e-7);
            }
    }
    EXPECT_LT(bounding_cap({}).radius_rad, 0);
    const BoundingSphere around{{0, 1, 0}, 2};
    EXPECT_EQ(cap_in_ship(bounding_cap({&around, 1}), 4).w, -2); // the eye is inside: any direction
}

TEST(BoundingCap, AberrationTakesItsEdgeToAnEdge)
{
    Random random;
    for (double E : {1.0, 1.3, 8.0, 200.0, 2e4})
        for (int turn = 0; turn < 200; ++turn) {
            const BoundingCap cap{random.direction(), random.between(0.001, 3)};
            const glm::dvec4 there = cap_in_ship(cap, E);
            EXPECT_NEAR(glm::length(glm::dvec3(there)), 1, 1e-12);
            const glm::dvec3 right = glm::normalize(glm::cross(cap.axis, random.direction()));
            // A step inside the edge lies inside, and a step outside it outside. The step is 1e-3 of the radius, and the
            // cosines' own rounding is far below the edge's distance.
            for (int side : {-1, 1}) {
                const double angle = std::min(cap.radius_rad * (1 + 1e-3 * side), 3.14159);
                const glm::dvec3 n = seen_from_ship(cap.axis * std::cos(angle) + right * std::sin(angle), E);
                const double beyond = there.w - glm::dot(n, glm::dvec3(there));
                EXPECT_TRUE(side > 0 ? beyond > -1e-12 : beyond < 1e-12) << E << " " << cap.radius_rad << " " << beyond;
            }
        }
}

TEST(BoundingCap, SurvivesTheGreatestSpeeds)
{
    for (double E : {1e6, 1e12, 1e100, 1e200})
        for (double radius : {1e-6, 0.1, 1.5, 3.1}) {
            const glm::dvec4 there = cap_in_ship({{0, 0.6, -0.8}, radius}, E);
            EXPECT_TRUE(std::isfinite(there.w) && std::isfinite(there.x + there.y + there.z)) << E << " " << radius;
        }
}

} // namespace bounding_cap_test
