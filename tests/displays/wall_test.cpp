// Walls as a tape measures them: the nearest rectangle against a search, and a picture askew against the projector that
// throws it.
#include "displays/projections/picture.h"
#include "displays/projections/wall.h"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace wall_test {

using namespace starbow;

namespace {

/// The sum of the squares by which three corners miss a rectangle.
double misses(const Wall& wall, const std::array<glm::dvec3, 4>& to)
{
    const glm::dvec3 off[]{to[0] - wall.lower_left_m, to[1] - wall.lower_right_m, to[3] - wall.upper_left_m};
    return glm::dot(off[0], off[0]) + glm::dot(off[1], off[1]) + glm::dot(off[2], off[2]);
}

/// A rectangle in a plane by its lower left corner, its angle and its sides.
std::array<glm::dvec3, 4> rectangle(const glm::dvec3& x, const glm::dvec3& y, const std::array<double, 5>& p)
{
    const glm::dvec3 right = p[3] * (std::cos(p[2]) * x + std::sin(p[2]) * y),
                     up = p[4] * (std::cos(p[2]) * y - std::sin(p[2]) * x), corner = p[0] * x + p[1] * y;
    return {corner, corner + right, corner + right + up, corner + up};
}

} // namespace

TEST(WallTest, TheNearestRectangleIsThatOfASearch)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int trial = 0; trial < 20; ++trial) {
        const glm::dvec3 x = glm::normalize(glm::dvec3(any(random), any(random), any(random))),
                         y = glm::normalize(glm::cross(x, glm::dvec3(any(random), any(random), any(random))));
        const double width = 2 + any(random), height = 2 + any(random), slip = 0.02 * any(random) * height;
        const glm::dvec3 corner = any(random) * x + any(random) * y;
        const Wall wall{corner, corner + width * x, corner + slip * x + height * y};
        const WallCorners fitted = fitted_corners(wall);
        const auto& at = fitted.at;
        EXPECT_NEAR(glm::dot(at[1] - at[0], at[3] - at[0]), 0, 1e-14);
        EXPECT_NEAR(glm::distance(at[2], at[1] + at[3] - at[0]), 0, 1e-14);
        EXPECT_NEAR(fitted.moved_m[0], glm::distance(at[0], wall.lower_left_m), 1e-15);
        EXPECT_NEAR(fitted.moved_m[1], glm::distance(at[1], wall.lower_right_m), 1e-15);
        EXPECT_NEAR(fitted.moved_m[3], glm::distance(at[3], wall.upper_left_m), 1e-15);
        // A pattern search from the measured edge.
        std::array<double, 5> best{glm::dot(corner, x), glm::dot(corner, y), 0, width, height};
        double least = misses(wall, rectangle(x, y, best));
        for (double step = 0.02; step > 1e-9;) {
            bool better = false;
            for (std::size_t k = 0; k < 5; ++k)
                for (const double way : {-step, step}) {
                    std::array<double, 5> other = best;
                    other[k] += way;
                    if (const double sum = misses(wall, rectangle(x, y, other)); sum < least)
                        least = sum, best = other, better = true;
                }
            if (!better)
                step /= 2;
        }
        EXPECT_LE(misses(wall, at), least * (1 + 1e-6) + 1e-18);
        EXPECT_GT(misses(wall, at), least * 0.99) << "the search ends near by";
    }
}

TEST(WallTest, ARectangleStaysAsItIs)
{
    const Wall wall{{-1.2, -0.675, -2}, {1.2, -0.675, -2}, {-1.2, 0.675, -2}};
    const WallCorners fitted = fitted_corners(wall);
    EXPECT_EQ(fitted.at[0], wall.lower_left_m);
    EXPECT_EQ(fitted.at[1], wall.lower_right_m);
    EXPECT_EQ(fitted.at[3], wall.upper_left_m);
    EXPECT_EQ(fitted.moved_m, (std::array<double, 4>{}));
}

// A projector stands askew before a wall. Each of its pixels lights the place where its ray meets the wall, and the eye sees
// that place: nothing here knows of projective maps.
TEST(WallTest, APictureAskewShowsWhatTheProjectorLights)
{
    const glm::dvec3 corner(-3, -1, -4), right = glm::normalize(glm::dvec3(1, 0, 0.2)), up(0, 1, 0),
                                         normal = glm::normalize(glm::cross(right, up));
    const glm::dvec3 lens(0.7, 2.5, 0.5), eye(0.3, 0.2, 0.4);
    const glm::ivec2 size(640, 400);
    const Picture projector{Planar{34, {}, {-12, -21, 3}}, size};
    const auto lit = [&](glm::dvec2 pixel) {
        const glm::dvec3 ray = *direction(projector, pixel);
        return lens + ray * (glm::dot(corner - lens, normal) / glm::dot(ray, normal));
    };
    const Wall wall{lit({0, 400}), lit({640, 400}), lit({0, 0}), lit({640, 0})};
    EXPECT_LT(fitted_corners(wall).moved_m[0], 1e-14);
    const PictureRays rays(Picture{wall, size, eye});
    ASSERT_TRUE(rays.planar_matrix());
    double worst = 0;
    for (int y = 0; y <= 400; y += 20)
        for (int x = 0; x <= 640; x += 20) {
            const glm::dvec3 seen = glm::normalize(lit({x, y}) - eye);
            worst = std::max(worst, glm::distance(*rays.direction({x, y}), seen));
            const auto back = rays.pixel(seen);
            ASSERT_TRUE(back);
            EXPECT_LT(glm::distance(*back, glm::dvec2(x, y)), 1e-8);
        }
    EXPECT_LT(worst, 1e-13);
    // A head that moves sees another picture of the same places.
    EXPECT_LT(glm::distance(*direction(Picture{wall, size, {-1, 0, 1}}, {320, 100}),
                  glm::normalize(lit({320, 100}) - glm::dvec3(-1, 0, 1))),
        1e-13);
    // Seen from behind, or with corners in the wrong order, it shows nothing.
    EXPECT_FALSE(direction(Picture{wall, size, {0, 0, -9}}, {1, 1}));
    EXPECT_FALSE(direction(
        Picture{Wall{wall.lower_left_m, wall.lower_right_m, *wall.upper_right_m, wall.upper_left_m}, size}, {1, 1}));
}

TEST(WallTest, FourCornersComeToTheNearestPlane)
{
    const Wall wall{{-1, -1, -2.01}, {1, -1, -1.99}, {-1, 1, -1.99}, {{1, 1, -2.01}}};
    const WallCorners fitted = fitted_corners(wall);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(fitted.at[i].z, -2, 1e-12);
        EXPECT_NEAR(fitted.moved_m[i], 0.01, 1e-12);
    }
}

} // namespace wall_test
