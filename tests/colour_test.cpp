// The Doppler table: nothing at rest, black bodies for greys, the rainbow for a pure blue.
#include "runtime/colour.h"
#include "runtime/shared.h"
#include <cmath>
#include <gtest/gtest.h>

using namespace starbow;

namespace {

/// What seen.glsl does with the table, in double.
glm::dvec3 shifted(const glm::dvec3& rgb, double D)
{
    static const std::vector<glm::vec4> table = doppler_table();
    double grey = std::min({rgb.r, rgb.g, rgb.b});
    glm::dvec4 parts(rgb - grey, grey);
    double at = (std::log2(D) + COLOUR_RANGE) * (COLOUR_STEPS - 1) / (2 * COLOUR_RANGE);
    int i = std::min(int(at), COLOUR_STEPS - 2);
    glm::dvec3 out;
    for (int row = 0; row < 3; ++row)
        out[row] = glm::dot(glm::mix(glm::dvec4(table[3 * i + row]), glm::dvec4(table[3 * i + 3 + row]), at - i), parts);
    return glm::max(out, 0.0);
}

glm::dvec2 chromaticity(const glm::dvec3& xyz) { return glm::dvec2(xyz) / (xyz.x + xyz.y + xyz.z); }

glm::dvec3 black_body_xyz(double kelvin)
{
    glm::dvec3 sum(0);
    for (double nm = 360; nm <= 830; nm += 1)
        sum += xyz_response(nm) * planck(nm, kelvin);
    return sum;
}

} // namespace

TEST(Colour, AtRestNothingChanges)
{
    // D = 1 is a step of the table (their number is odd), exact but for float.
    for (glm::dvec3 rgb : {glm::dvec3(1, 1, 1), glm::dvec3(0.2, 0.5, 0.8), glm::dvec3(0, 0, 1), glm::dvec3(1, 0.3, 0)})
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(shifted(rgb, 1)[i], rgb[i], 1e-6) << i;
}

TEST(Colour, BlackBodiesHaveTheirChromaticity)
{
    // CIE 1931 chromaticities of Planckian radiators, known to four digits.
    const double known[][3] = {{1273.15, 0.6152, 0.3747}, {2856, 0.4475, 0.4074}, {5772, 0.3266, 0.3358},
        {10000, 0.2806, 0.2883}, {45443, 0.2462, 0.2433}};
    for (auto& [kelvin, x, y] : known) {
        glm::dvec2 xy = chromaticity(black_body_xyz(kelvin));
        EXPECT_NEAR(xy.x, x, 1e-4) << kelvin;
        EXPECT_NEAR(xy.y, y, 1e-4) << kelvin;
    }
}

TEST(Colour, TheObserverIsTheTable)
{
    // A value of the table, and two between that CIE gives too, by its own interpolation.
    EXPECT_EQ(xyz_response(555), glm::dvec3(0.5120501, 1, 0.005749999));
    EXPECT_NEAR(xyz_response(552).y, 0.9980983, 1e-5);
    EXPECT_NEAR(xyz_response(553).y, 0.9991120, 1e-5);
    EXPECT_EQ(xyz_response(359), glm::dvec3(0));
    EXPECT_EQ(xyz_response(831), glm::dvec3(0));
    // Equal energy is equally white: the three functions have the same area (CIE 015).
    glm::dvec3 area(0);
    for (int nm = 360; nm <= 830; ++nm)
        area += xyz_response(nm);
    EXPECT_NEAR(area.x / area.y, 1, 2e-4);
    EXPECT_NEAR(area.z / area.y, 1, 4e-4);
    EXPECT_NEAR(area.y, 106.857, 0.001);
}

TEST(Colour, ASunlitGreyIsABlackBodyAtDT)
{
    // Headlight on: D^3 times the shift. A grey under the Sun brightens straight ahead at gamma 4 by 118, not by D^3 = 488.
    double D = 4 + std::sqrt(15.0);
    glm::dvec3 rgb = shifted({1, 1, 1}, D) * (D * D * D);
    double luminance = 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b;
    double truth = black_body_xyz(5772 * D).y / black_body_xyz(5772).y;
    EXPECT_NEAR(truth, 118, 1); // the figure of the spectra's own integral
    EXPECT_NEAR(luminance / truth, 1, 0.1); // the white point is adapted channel by channel
    EXPECT_GT(rgb.b, rgb.r);
    glm::dvec3 red = shifted({1, 1, 1}, 0.5);
    EXPECT_GT(red.r, 3 * red.b);
}

TEST(Colour, BlueRunsThroughGreenToRed)
{
    // The rainbow cylinder at 0.5 c: 1/D is 1.155 across the motion, 1.309 at 105.5 degrees, 1.443 at 120.
    glm::dvec3 blue(0, 0, 1), centre = shifted(blue, 1 / 1.1547), right = shifted(blue, 1 / 1.3090),
                              edge = shifted(blue, 1 / 1.4434);
    EXPECT_GT(centre.g, 2 * centre.r);
    EXPECT_GT(centre.g, 2 * centre.b);
    EXPECT_GT(right.r, right.b);
    EXPECT_GT(right.r, right.g);
    EXPECT_GT(edge.r, 5 * edge.g);
    EXPECT_GT(edge.r, 5 * edge.b);
}

TEST(Colour, StepsAreFineEnoughToInterpolate)
{
    // Half way between two steps, against the mean of a table twice as coarse there: the interpolation error is a quarter of
    // it.
    const std::vector<glm::vec4> table = doppler_table();
    double worst = 0;
    for (int step = 1; step + 1 < COLOUR_STEPS; ++step)
        for (int row = 0; row < 3; ++row)
            for (int i = 0; i < 4; ++i)
                worst = std::max(worst,
                    std::abs(
                        0.5 * (table[3 * (step - 1) + row][i] + table[3 * (step + 1) + row][i]) - table[3 * step + row][i])
                        / 4.0);
    EXPECT_LT(worst, 0.02); // of a full primary whose shifted light is up to five times as bright as itself
    std::printf("  doppler table: worst interpolation error %.4f\n", worst);
}

TEST(Colour, EveryEntryIsFinite)
{
    for (const glm::vec4& row : doppler_table())
        for (int i = 0; i < 4; ++i)
            ASSERT_TRUE(std::isfinite(row[i]));
}
