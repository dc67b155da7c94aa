// Colours under the Doppler effect: unchanged at rest, black bodies for greys, the rainbow for a pure blue.
#include "runtime/light/colour.h"
#include "runtime/light/response.h"
#include "shaders/shared_structs.h"
#include "tests/support/planck.h"
#include <cmath>
#include <cstdio>
#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

namespace colour_test {

using namespace starbow;

namespace {

/// A base colour under the Sun with default ultraviolet and infrared, as the device's table gives it.
glm::dvec3 shifted(const glm::dvec3& rgb, double D)
{
    auto sunlit = [sun = sunlit_white()](const glm::dvec3& primary) -> Spectrum {
        return [=](double nm) { return sun(nm) * base_reflectance(primary, 1.0 / 3, 1.0 / 3, nm); };
    };
    static const Response response
        = response_of(spectral_basis({sunlit({1, 0, 0}), sunlit({0, 1, 0}), sunlit({0, 0, 1})}, 3, {}), eye());
    return glm::max(seen(response, std::array{rgb.r, rgb.g, rgb.b}, D), 0.0);
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

// The rows for a device's sampler, interpolated here by hand, with the sampler's 8 bits for the place between two of them.
TEST(Colour, TheSamplersRowsAreTheTables)
{
    const auto sunlit = [sun = sunlit_white()](double middle_nm) -> Spectrum {
        return [=](double nm) { return sun(nm) * std::exp(-std::pow((nm - middle_nm) / 60, 2)); };
    };
    const Response response = response_of(spectral_basis({sunlit(450), sunlit(540), sunlit(620)}, 3, {}), eye());
    const std::vector<glm::u16vec4> picture = picture_of(response);
    ASSERT_EQ(picture.size(), std::size_t(3 * RESPONSE_ROWS));
    const std::array<double, 3> coefficients{0.7, 0.2, 1.3};
    double brightest = 0, worst = 0;
    for (double row = 0; row < RESPONSE_ROWS - 1.01; row += 0.37) {
        const double D = std::exp2(response.first_log2_D + row / response.per_octave);
        const int i = int(row);
        const double part = std::round(256 * (row - i)) / 256;
        glm::dvec3 light(0);
        double log2 = 0;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec4 here(glm::unpackHalf4x16(glm::packUint4x16(picture[std::size_t(k * RESPONSE_ROWS + i)])));
            const glm::dvec4 next(glm::unpackHalf4x16(glm::packUint4x16(picture[std::size_t(k * RESPONSE_ROWS + i + 1)])));
            light += coefficients[std::size_t(k)] * glm::dvec3(glm::mix(here, next, part));
            log2 += k < 2 ? glm::mix(here.w, next.w, part) : 0;
        }
        light *= std::exp2(log2);
        const glm::dvec3 right = seen(response, coefficients, D);
        const double most = std::max({std::abs(right.x), std::abs(right.y), std::abs(right.z)});
        if (most < 1e-34) // what a float cannot hold
            continue;
        // Up to there the steepest step between rows is of two stops, of which half of a 256th is 0.3 %.
        worst = std::max(worst, glm::length(light - right) / most);
        EXPECT_LE(glm::length(light - right), 0.004 * most) << D;
        brightest = std::max(brightest, most);
    }
    std::printf("  off by %.4f %% at most\n", 100 * worst);
    EXPECT_GT(brightest, 0.1);
}

TEST(Colour, AtRestColoursAreUnchanged)
{
    // D = 1 is a row of the table, exact apart from fp16's rounding.
    for (glm::dvec3 rgb : {glm::dvec3(1, 1, 1), glm::dvec3(0.2, 0.5, 0.8), glm::dvec3(0, 0, 1), glm::dvec3(1, 0.3, 0)})
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(shifted(rgb, 1)[i], rgb[i], 1e-3) << i;
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

TEST(Colour, TheObserverIsCIEsTable)
{
    // One value of CIE's table, and two between that CIE gives by its own interpolation.
    EXPECT_EQ(xyz_response(555), glm::dvec3(0.5120501, 1, 0.005749999));
    EXPECT_NEAR(xyz_response(552).y, 0.9980983, 1e-5);
    EXPECT_NEAR(xyz_response(553).y, 0.9991120, 1e-5);
    EXPECT_EQ(xyz_response(359), glm::dvec3(0));
    EXPECT_EQ(xyz_response(831), glm::dvec3(0));
    // Light of equal energy is white: the three functions have the same area (CIE 015).
    glm::dvec3 area(0);
    for (int nm = 360; nm <= 830; ++nm)
        area += xyz_response(nm);
    EXPECT_NEAR(area.x / area.y, 1, 2e-4);
    EXPECT_NEAR(area.z / area.y, 1, 4e-4);
    EXPECT_NEAR(area.y, 106.857, 0.001);
}

TEST(Colour, ASunlitGreyIsABlackBodyAtDT)
{
    // With the headlight effect a sunlit grey straight ahead at gamma 4 brightens by 118, not by D^3 = 488.
    double D = 4 + std::sqrt(15.0);
    glm::dvec3 rgb = shifted({1, 1, 1}, D) * (D * D * D);
    double luminance = 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b;
    double truth = black_body_xyz(5772 * D).y / black_body_xyz(5772).y;
    EXPECT_NEAR(truth, 118, 1); // from the integral over the spectra
    EXPECT_NEAR(luminance / truth, 1, 0.02); // the adaptation to the Sun gives the channels other luminances
    EXPECT_GT(rgb.b, rgb.r);
    glm::dvec3 red = shifted({1, 1, 1}, 0.5);
    EXPECT_GT(red.r, 3 * red.b);
}

TEST(Colour, BaseColoursShiftAsTheirReflectancesDo)
{
    // The sum over every nanometre of the smooth reflectance under the Sun.
    const Spectrum sun = sunlit_white();
    for (const glm::dvec3& rgb : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(0.8, 0.5, 0.1)})
        for (double D : {0.25, 0.5, 1 / 1.4434, 1 / 1.309, 1 / 1.1547, 1.5, 3.0}) {
            const double mean = (rgb.r + rgb.g + rgb.b) / 3;
            const glm::dvec3 truth = rec709_from_sunlit_xyz()
                * seen_xyz([&](double nm) { return sun(nm) * base_reflectance(rgb, mean, mean, nm); }, D);
            const double white = glm::length(shifted(glm::dvec3(1), D));
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(shifted(rgb, D)[c], std::max(truth[c], 0.0), 2e-3 * white) << D << " " << c;
        }
    // A surface that is blue at rest looks greener where light is shifted to the red: the rainbow of a cylinder at 0.5 c.
    const glm::dvec3 blue(0, 0, 1), centre = shifted(blue, 1 / 1.1547);
    EXPECT_GT(centre.g, centre.r);
    EXPECT_GT(centre.g / centre.b, 0.5);
}

} // namespace colour_test
