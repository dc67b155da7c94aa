// The darkness that red-shifted light reaches, against random mixtures of light.
#include "runtime/light/colour.h"
#include "runtime/light/light_bound.h"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace light_bound_test {

using namespace starbow;

namespace {

struct Random {
    std::mt19937 engine{11};
    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
};

std::vector<SpectralBasis> bases()
{
    const auto sunlit = [sun = sunlit_white()](const glm::dvec3& base) -> Spectrum {
        return [=](double nm) { return sun(nm) * base_reflectance(base, 1.0 / 3, 1.0 / 3, nm); };
    };
    const std::vector<Spectrum> primaries = {sunlit({1, 0, 0}), sunlit({0, 1, 0}), sunlit({0, 0, 1})};
    return {spectral_basis(primaries, 3, {}), spectral_basis({sunlit_white()}, 12, {BlackBody{1000}, BlackBody{40000}}),
        spectral_basis(primaries, 3, {BlackBody{288}})};
}

double peak(const glm::dvec3& colour) { return std::max({std::abs(colour.x), std::abs(colour.y), std::abs(colour.z)}); }

} // namespace

TEST(LightBound, NoMixtureIsBrighter)
{
    Random random;
    for (const SpectralBasis& basis : bases()) {
        const Response response = response_of(basis, eye());
        const LightBound greatest = greatest_light(response);
        const double rows = double(greatest.log2_of_row.size());
        std::vector<double> mixture(std::size_t(basis.size()));
        for (int turn = 0; turn < 20000; ++turn) {
            const double row = random.between(0, rows);
            for (double& coefficient : mixture)
                coefficient = turn % 2 ? random.between(-1, 1) : random.between(0, 1) < 0.5 ? -1 : 1;
            const double light = peak(seen(response, mixture, std::exp2(greatest.first_log2_D + row / greatest.per_octave)));
            EXPECT_LE(light, std::exp2(greatest.log2_of_row[std::size_t(row)])) << row;
        }
        for (std::size_t row = 1; row < greatest.log2_of_row.size(); ++row)
            EXPECT_GE(greatest.log2_of_row[row], greatest.log2_of_row[row - 1]);
    }
}

TEST(LightBound, BelowTheDarkNothingShowsAndNotFarAboveSomethingDoes)
{
    Random random;
    constexpr double least = 5e-6;
    for (const SpectralBasis& basis : bases()) {
        const Response response = response_of(basis, eye());
        const LightBound greatest = greatest_light(response);
        std::vector<double> mixture(std::size_t(basis.size()));
        for (const auto& [doppler, headlight] : {std::pair(true, true), std::pair(true, false), std::pair(false, true)})
            for (double most : {0.01, 1.0, 1e4, 1e9}) {
                const double dark = doppler_cutoff(greatest, doppler, headlight, most, least);
                const auto light_at
                    = [&](double D) { return peak(seen(response, mixture, doppler ? D : 1)) * (headlight ? D * D * D : 1); };
                for (int turn = 0; turn < 2000; ++turn) {
                    for (double& coefficient : mixture)
                        coefficient = random.between(0, 1) < 0.5 ? -most : most;
                    EXPECT_LT(light_at(dark * random.between(0, 1)), least * (1 + 1e-9)) << dark;
                }
                if (dark == 0)
                    continue; // visible however red-shifted
                // The bound adds all coefficients up, each in its strongest colour. Light rises steeply with D.
                double brightest = 0;
                for (std::size_t k = 0; k < mixture.size(); ++k) {
                    std::fill(mixture.begin(), mixture.end(), 0.0);
                    mixture[k] = most;
                    brightest = std::max(brightest, light_at(1.1 * dark));
                }
                EXPECT_GT(brightest, least / double(mixture.size())) << dark;
            }
        EXPECT_EQ(doppler_cutoff(greatest, false, false, 1, least), 0);
    }
}

TEST(LightBound, TheDarkEndsWithinOneRowOfItsTruePlace)
{
    // Light of any colour that is as strong at every D: alone the headlight effect's D^3 makes it dark.
    const LightBound constant{-20, 8, std::vector<double>(160, 0.0)};
    for (double least = 1e-12; least < 0.9; least *= 1.1) {
        const double dark = doppler_cutoff(constant, true, true, 1, least), truth = std::cbrt(least);
        EXPECT_LE(dark, truth * (1 + 1e-12)) << least;
        EXPECT_GT(dark, truth / std::exp2(1.01 / 8)) << least;
    }
    // Light that doubles from row to row, without that effect.
    LightBound rising{-20, 8, {}};
    for (int row = 0; row < 160; ++row)
        rising.log2_of_row.push_back(row - 160);
    for (int row = 1; row < 160; ++row)
        EXPECT_NEAR(doppler_cutoff(rising, true, false, 1, std::exp2(row - 160 - 0.5)), std::exp2(-20 + row / 8.0), 1e-12)
            << row;
}

TEST(LightBound, SunlightIsDarkBelowAQuarter)
{
    // Wien's law for the Sun's 5772 K: light that arrives at 700 nm left at 170 nm, e^-10 of that at 550 nm. The eye has a
    // two-hundredth of its response there, and D^3 is a seventieth: 3e-9. At 0.3 the same product is 5e-7, and what is
    // farther red, up to the eye's end at 830 nm, adds to both.
    const double dark = doppler_cutoff(greatest_light(response_of(bases().front(), eye())), true, true, 1, 5e-6);
    EXPECT_GT(dark, 0.2);
    EXPECT_LT(dark, 0.3);
}

} // namespace light_bound_test
