// Spectral coefficients compared with sums over every nanometre: black bodies, sunlit greys and a chart of smooth
// reflectances, at D from 1/8 to 8.
#include "runtime/light/colour.h"
#include "runtime/light/colour_difference.h"
#include "runtime/light/response.h"
#include "runtime/world/spectral_errors.h"
#include "tests/support/planck.h"
#include <cstdio>
#include <gtest/gtest.h>

namespace spectrum_test {

using namespace starbow;

namespace {

glm::dvec2 chromaticity(const glm::dvec3& xyz) { return glm::dvec2(xyz) / (xyz.x + xyz.y + xyz.z); }

/// Converts the displayed colour back to XYZ.
glm::dvec3 xyz_of_coefficients(const Response& response, std::span<const double> coefficients, double D)
{
    return glm::inverse(eye().rec709) * seen(response, coefficients, D);
}

} // namespace

TEST(SpectrumTest, ColourDifferencesAreThePublishedOnes)
{
    // Sharma, Wu and Dalal 2005, table 1.
    const std::vector<std::tuple<glm::dvec3, glm::dvec3, double>> pairs
        = {{{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425}, {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
            {{50, 2.5, 0}, {73, 25, -18}, 27.1492}, {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
            {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
            {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082}};
    for (const auto& [one, two, known] : pairs) {
        EXPECT_NEAR(ciede2000(one, two), known, 5e-5);
        EXPECT_NEAR(ciede2000(two, one), known, 5e-5);
    }
}

TEST(SpectrumTest, ABaseColourHasItsColourUnderTheSun)
{
    const glm::dmat3 rec709 = rec709_from_sunlit_xyz();
    const Spectrum sun = sunlit_white();
    for (const glm::dvec3& rgb :
        {glm::dvec3(1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(0.2, 0.5, 0.7)}) {
        const double mean = (rgb.r + rgb.g + rgb.b) / 3;
        const glm::dvec3 seen
            = rec709 * seen_xyz([&](double nm) { return sun(nm) * base_reflectance(rgb, mean, mean, nm); }, 1);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(seen[c], rgb[c], 1e-4) << c; // the primaries' tables have five digits
        for (double nm = 40; nm < 12000; nm *= 1.02) {
            EXPECT_GE(base_reflectance(rgb, mean, mean, nm), -1e-6);
            EXPECT_LE(base_reflectance(rgb, mean, mean, nm), 1 + 1e-6);
        }
        EXPECT_NEAR(base_reflectance(rgb, 0.3, 0.6, 100), 0.3, 1e-6);
        EXPECT_NEAR(base_reflectance(rgb, 0.3, 0.6, 5000), 0.6, 1e-6);
    }
}

TEST(SpectrumTest, AShiftedBlackBodyIsABlackBody)
{
    // The reference's path: T at D becomes DT, in colour to rounding, and in luminance as D^-3 without the headlight
    // effect's D^3.
    for (double kelvin : {1000.0, 2856.0, 5772.0, 40000.0})
        for (double D : {0.05, 0.5, 3.0, 20.0}) {
            if (kelvin * D < 300)
                continue; // nothing visible
            const glm::dvec3 moving = seen_xyz(black_body(kelvin), D), hotter = seen_xyz(black_body(kelvin * D), 1);
            EXPECT_LT(glm::distance(chromaticity(moving), chromaticity(hotter)), 1e-12);
            EXPECT_NEAR(moving.y * D * D * D / hotter.y, 1, 1e-9);
        }
}

TEST(SpectrumTest, CoefficientsRepresentBlackBodiesAndGreys)
{
    const std::vector<double> kelvins = {1000, 2856, 5772, 40000};
    std::vector<EmissionSpectrum> spectra;
    for (double kelvin : kelvins)
        spectra.push_back({BlackBody{kelvin}});
    const SpectralBasis basis = spectral_basis(12, spectra);
    const Response response = response_of(basis, eye());
    for (std::size_t i = 0; i < kelvins.size(); ++i)
        for (int step = -34; step <= 34; ++step) { // D from 1/20 to 20
            const double D = std::exp2(step * std::log2(20.0) / 34);
            std::vector<double> coefficients(std::size_t(basis.size()), 0.0);
            coefficients[std::size_t(basis.reflected) + i] = 1;
            const glm::dvec3 shown = xyz_of_coefficients(response, coefficients, D),
                             truth = seen_xyz(black_body(kelvins[i]), D);
            EXPECT_LT(glm::distance(chromaticity(shown), chromaticity(truth)), 0.002) << kelvins[i] << " K at " << D;
        }
    for (SpectralLevel level : {SpectralLevel::colours, SpectralLevel::middle, SpectralLevel::fine}) {
        const SpectralErrors greys = chart_errors(level, ChartFields::greys);
        std::printf("  greys, %2d coefficients: CIEDE2000 worst %.4f, luminance %.4f %%\n",
            reflected_counts[std::size_t(level)], greys.worst, 100 * greys.luminance);
        EXPECT_LT(greys.worst, 0.05); // fp16 has eleven bits
        EXPECT_LT(greys.luminance, 1e-3);
    }
}

TEST(SpectrumTest, CoefficientsRepresentAColourChart)
{
    for (SpectralLevel level : {SpectralLevel::colours, SpectralLevel::middle, SpectralLevel::fine}) {
        const SpectralErrors errors = chart_errors(level, ChartFields::colours);
        std::printf("  chart, %2d coefficients: CIEDE2000 median %.2f, worst %.2f, luminance %.2f %%\n",
            reflected_counts[std::size_t(level)], errors.median, errors.worst, 100 * errors.luminance);
        if (level == SpectralLevel::fine) {
            EXPECT_LT(errors.median, 1);
            EXPECT_LT(errors.worst, 3);
            EXPECT_LT(errors.luminance, 0.02);
        }
    }
}

TEST(SpectrumTest, ALineIsShiftedAndKeepsItsEnergy)
{
    // A rectangle one nanometre wide, summed at every hundredth of one: 450 nm, with D from 0.6 to 1.2.
    const double energy = [] {
        double sum = 0;
        const Spectrum sun = sunlit_white();
        for (double nm = 40; nm < 200000; nm *= 1.001)
            sum += sun(nm) * 0.001 / nm;
        return sum;
    }();
    for (double D : {0.6, 0.8660254, 1.0, 1.2}) {
        glm::dvec3 sum(0);
        for (double nm = 449.505; nm < 450.5; nm += 0.01)
            sum += eye().response(nm / D) * (energy * nm * nm * 0.01 / (nm * nm)) * D; // d nm' / nm'^2 = D d nm / nm^2
        const glm::dvec3 line = seen(eye(), Emission(SpectralLine{450}), D);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(line[c], sum[c], 5e-3 * sum[c] + 1e-9) << D; // the eye's response is curved within the nanometre
    }
    // A table with a narrow peak, and a table of the Sun's spectrum.
    const SpectralTable needle{{{448, 0}, {450, 1}, {452, 0}}};
    std::vector<std::pair<double, double>> points;
    for (double nm = 40; nm <= 12000; nm *= 1.005)
        points.push_back({nm, planck(nm, 5772)});
    for (double D : {0.7, 1.0, 1.3}) {
        const glm::dvec3 a = seen(eye(), Emission(needle), D), b = seen(eye(), Emission(SpectralLine{450}), D);
        const glm::dvec3 c = seen(eye(), Emission(SpectralTable{points}), D), d = seen(eye(), sunlit_white(), D);
        EXPECT_LE(glm::distance(a, b), 0.03 * glm::length(b)) << D; // two nanometres are two steps of the sum
        EXPECT_LT(glm::distance(c, d), 0.002 * glm::length(d)) << D; // the table ends at 12 um
    }
    // A lamp has a sunlit white's energy at any temperature.
    for (double kelvin : {300.0, 2856.0, 20000.0}) {
        double sum = 0;
        for (double nm = 1; nm < 1e7; nm *= 1.001)
            sum += black_body(kelvin)(nm) * 0.001 / nm;
        EXPECT_NEAR(sum * sunlit_part(BlackBody{kelvin}) / energy, 1, 2e-3) << kelvin;
    }
}

TEST(SpectrumTest, LampsWithTheirOwnSpectrumLightGreysExactly)
{
    const std::vector<Emission> lamps = {BlackBody{2856}, SpectralLine{589.3}};
    const SpectralBasis basis = spectral_basis(
        12, std::array{EmissionSpectrum{lamps[0]}, EmissionSpectrum{lamps[0], true}, EmissionSpectrum{lamps[1]}});
    const Response response = response_of(basis, eye());
    for (double D : {0.5, 0.9, 1.0, 1.1, 2.0}) {
        const glm::dvec3 grey = xyz_of_coefficients(response, lit(basis, lamps[0], [](double) { return 0.5; }), D);
        const glm::dvec3 truth = 0.5 * sunlit_part(lamps[0]) * seen(eye(), lamps[0], D);
        EXPECT_LT(glm::distance(grey, truth), 2e-3 * glm::length(truth)) << D;
        // A line stays a line on any surface, times the reflectance at its wavelength.
        auto ramp = [](double nm) { return std::clamp((nm - 400) / 400, 0.0, 1.0); };
        const glm::dvec3 sodium = xyz_of_coefficients(response, lit(basis, lamps[1], ramp), D);
        const glm::dvec3 known = ramp(589.3) * seen(eye(), lamps[1], D);
        EXPECT_LT(glm::distance(sodium, known), 0.02 * std::max(glm::length(known), 1e-3)) << D; // rows are 5 nm apart
        // A smooth reflectance under the lamp has errors like those of the chart under the Sun.
        const glm::dvec3 shown = xyz_of_coefficients(response, lit(basis, lamps[0], ramp), D);
        const glm::dvec3 lamp = sunlit_part(lamps[0])
            * seen(
                eye(), [&](double nm) { return ramp(nm) * black_body(2856)(nm); }, D);
        const glm::dvec3 white = sunlit_part(lamps[0]) * seen(eye(), lamps[0], D);
        EXPECT_LT(glm::distance(shown, lamp), 0.025 * glm::length(white))
            << D; // the ramp has corners, sharper than the basis functions
    }
}

TEST(SpectrumTest, FalseColoursShowTheInfraredAndTheUltraviolet)
{
    // At any level a sunlit white is white. Leaves are bright only in the infrared, so they are red; so is a room's own
    // heat.
    const StandardObserver& all = false_colours();
    EXPECT_LT(glm::distance(seen(all, sunlit_white(), 1), glm::dvec3(1)), 1e-9);
    for (int count : {3, 12}) {
        const SpectralBasis basis = spectral_basis(count, std::array{EmissionSpectrum{BlackBody{288}}});
        const Response response = response_of(basis, all);
        EXPECT_LT(glm::distance(seen(response, lit(basis, {}, [](double) { return 1; }), 1), glm::dvec3(1)), 2e-3);
        std::vector<double> room(std::size_t(basis.size()), 0.0);
        room.back() = 1;
        const glm::dvec3 warm = seen(response, room, 1);
        EXPECT_GT(warm.r, 0.2); // 390 W/m2, of which 3/4 is below 12 um, over the Sun's infrared
        EXPECT_LT(warm.g + warm.b, 1e-9);
    }
    const SpectralBasis basis = spectral_basis(12, {});
    const Response response = response_of(basis, all);
    const glm::dvec3 leaf = seen(response,
        lit(basis, {},
            [](double nm) {
                return base_reflectance({0.05, 0.1, 0.03}, 0.02, 0.5, nm);
            }),
        1);
    EXPECT_NEAR(leaf.r, 0.5, 0.025); // at 860 nm it is as bright as beyond
    EXPECT_NEAR(leaf.b, 0.02, 0.01);
    EXPECT_LT(leaf.g, 0.2);
}

} // namespace spectrum_test
