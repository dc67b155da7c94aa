// An eye's glare: the equation's published values, and that its closed forms are its sums.
#include "config/model/angles.h"
#include "shaders/physics/physics.h"
#include <gtest/gtest.h>

namespace starbow::glare_test {
namespace {

// CIE 146:2002 by hand, for 35 years: 1 + (35 / 62.5)^4 = 1.098345.
TEST(GlareTest, IsThePublishedEquation)
{
    EXPECT_NEAR(physics_double::glare_at(1), 10 + 5 * 1.098345, 1e-5);
    EXPECT_NEAR(physics_double::glare_at(0.01), 10000 + 5 * 1.098345 * 100, 1e-3);
    EXPECT_NEAR(physics_double::glare_at(100), 0.01 + 5 * 1.098345 / 100, 1e-7);
}

TEST(GlareTest, ItsPartIsTheSumOfItsRings)
{
    for (const double least : {0.1, 0.2, 1.0})
        for (const double angle : {0.15, 0.5, 2.0, 6.0}) {
            const double level = physics_double::glare_at(angle * angle + least * least);
            double sum = 0;
            constexpr int rings = 20000;
            for (int ring = 0; ring < rings; ++ring) {
                const double at = (ring + 0.5) / rings * angle;
                sum += (physics_double::glare_at(at * at + least * least) - level) * 2 * pi * at * angle / rings * degree
                    * degree;
            }
            EXPECT_NEAR(physics_double::glare_within(angle, least, level) / sum, 1, 1e-5) << least << ' ' << angle;
            EXPECT_LT(sum, 0.3); // the spot keeps most of the light
            EXPECT_NEAR(physics_float::glare_within(float(angle), float(least), float(level)), sum, 2e-5);
        }
}

TEST(GlareTest, EndsWhereItHasFallenToALevel)
{
    for (double level = 1e-3; level < 1e9; level *= 3) {
        const double end = physics_double::glare_end(level);
        EXPECT_NEAR(physics_double::glare_at(end * end) / level, 1, 2e-3) << level;
        EXPECT_NEAR(physics_float::glare_end(float(level)) / end, 1, 1e-4) << level;
    }
}

} // namespace
} // namespace starbow::glare_test
