// Spectral coefficients compared with sums over every nanometre: black bodies, lamps that pass, a colour chart, and
// reflectances as rough as they may be, at D from 1/8 to 8.
#include "runtime/light/colour.h"
#include "runtime/light/colour_difference.h"
#include "runtime/light/response.h"
#include "runtime/world/spectral_errors.h"
#include "tests/support/planck.h"
#include <cstdio>
#include <gtest/gtest.h>
#include <random>

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

TEST(SpectrumTest, ATableOfLightHoldsAtBothOfItsEndsAndIsDarkBeyond)
{
    // A table per wavelength; the result is per frequency, times the square of the wavelength.
    const Spectrum light = law_of(SpectralTable{{{400, 3}, {500, 1}, {600, 4}}}).spectrum;
    const double unit = light(500) / (500 * 500);
    for (const auto& [nm, value] : {std::pair(400.0, 3.0), {450.0, 2.0}, {550.0, 2.5}, {600.0, 4.0}})
        EXPECT_NEAR(light(nm) / (nm * nm), value * unit, 1e-12 * unit) << nm;
    for (const double nm : {1.0, 399.999, 600.001, 1e6})
        EXPECT_EQ(light(nm), 0) << nm;
}

TEST(SpectrumTest, EmissionsAreExact)
{
    const std::vector<double> kelvins = {1000, 2856, 5772, 40000};
    std::vector<Emission> emissions;
    for (double kelvin : kelvins)
        emissions.push_back(BlackBody{kelvin});
    const SpectralBasis basis = spectral_basis({sunlit_white()}, 12, emissions);
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
}

namespace {

/// Reflectances on 300 to 2500 nm as measured ones may be: a leaf with its water bands, a pigment whose infrared differs,
/// a step of 4 nm, three peaks of 30 nm, and a random walk of 6 % each 10 nm.
std::vector<Reflectance> measured_reflectances()
{
    auto of = [](double step_nm, auto&& at) {
        Reflectance all;
        for (double nm = 300; nm <= 2500; nm += step_nm)
            all.points.push_back({nm, std::clamp(double(at(nm)), 0.0, 1.0)});
        return all;
    };
    auto bump = [](double nm, double middle, double width) { return std::exp(-0.5 * std::pow((nm - middle) / width, 2)); };
    auto edge = [](double nm, double at, double width) { return 1 / (1 + std::exp(-(nm - at) / width)); };
    std::mt19937 random(5);
    double walk = 0.5;
    return {of(5,
                [&](double nm) {
                    return (0.06 + 0.08 * bump(nm, 550, 25) + 0.42 * edge(nm, 715, 12)) * (1 - 0.8 * bump(nm, 1450, 60))
                        * (1 - 0.9 * bump(nm, 1940, 70));
                }),
        of(5, [&](double nm) { return 0.55 * bump(nm, 450, 45) + 0.6 * edge(nm, 700, 15) - 0.3 * bump(nm, 1400, 200); }),
        Reflectance{{{500, 0.05}, {504, 0.9}}},
        of(2, [&](double nm) { return 0.03 + 0.8 * (bump(nm, 450, 12.7) + bump(nm, 540, 12.7) + bump(nm, 620, 12.7)); }),
        of(10, [&](double) { return walk += 0.12 * (random() / 4294967296.0 - 0.5); })};
}

std::vector<Spectrum> under(const Spectrum& light, const std::vector<Reflectance>& reflectances)
{
    std::vector<Spectrum> spectra;
    for (const Reflectance& one : reflectances)
        spectra.push_back([light, one](double nm) { return light(nm) * one(nm); });
    return spectra;
}

} // namespace

TEST(SpectrumTest, AnyReflectanceIsExactWhereEachHasACoefficient)
{
    const std::vector<Reflectance> reflectances = measured_reflectances();
    for (const auto& [name, light] : {std::pair<const char*, Spectrum>{"sunlight", sunlit_white()},
             {"2856 K", black_body(2856)}, {"10,000 K", black_body(10000)}}) {
        const SpectralErrors errors = spectral_errors(under(light, reflectances), 12);
        std::printf("  under %-8s: CIEDE2000 median %.3f, worst %.3f, luminance %.2f %%\n", name, errors.median,
            errors.worst, 100 * errors.luminance);
        // Halves have eleven bits; the rows are 1 nm apart or less, as the edges of a step are not.
        EXPECT_LT(errors.median, 0.05) << name;
        EXPECT_LT(errors.worst, 0.5) << name;
        EXPECT_LT(errors.luminance, 0.01) << name;
    }
}

TEST(SpectrumTest, TheErrorsOfTooManyReflectancesAreFound)
{
    // Twice as many spectra as coefficients: the errors are those of sums here, which share no code with spectral_errors
    // but the basis.
    std::vector<Reflectance> reflectances = measured_reflectances();
    std::mt19937 random(2);
    while (reflectances.size() < 24) {
        Reflectance peak;
        const double middle = 400 + 350 * (random() / 4294967296.0);
        for (double nm = 300; nm <= 2500; nm += 5)
            peak.points.push_back({nm, 0.05 + 0.9 * std::exp(-0.5 * std::pow((nm - middle) / 12, 2))});
        reflectances.push_back(peak);
    }
    const std::vector<Spectrum> spectra = under(sunlit_white(), reflectances);
    const SpectralErrors errors = spectral_errors(spectra, 12);
    std::printf("  24 in 12 coefficients: CIEDE2000 median %.2f, worst %.2f, luminance %.1f %%\n", errors.median,
        errors.worst, 100 * errors.luminance);
    EXPECT_GT(errors.worst, 3);
    const SpectralBasis basis = spectral_basis(spectra, 12, {});
    const Response response = response_of(basis, eye());
    double worst = 0;
    for (double D = 0.13; D < 8; D *= 1.07) {
        const std::span<const double> coefficients(&basis.columns[std::size_t(errors.worst_spectrum) * 12], 12);
        const glm::dvec3 shown = xyz_of_coefficients(response, coefficients, D),
                         truth = seen_xyz(spectra[std::size_t(errors.worst_spectrum)], D);
        worst = std::max(worst, glm::distance(chromaticity(shown), chromaticity(truth)));
        EXPECT_LT(std::abs(shown.y / truth.y - 1), errors.luminance * 1.2 + 0.01) << D;
    }
    EXPECT_GT(worst, 0.005);
}

TEST(SpectrumTest, LampsThatPassAreCloseInTwelveCoefficients)
{
    // A lamp passes grey, red, green and blue surfaces that sunlight reaches too; its light arrives at D' from 1/E to E.
    // The eye is at rest beside the surfaces, or moves.
    for (const auto& [kelvin, beta] : {std::pair(2856.0, 0.6), {5772.0, 0.6}, {2856.0, 0.9}}) {
        std::vector<Spectrum> spectra;
        auto add = [&](const Spectrum& light) {
            for (int c = 0; c < 3; ++c) {
                glm::dvec3 rgb(0);
                rgb[c] = 1;
                spectra.push_back([=](double nm) { return light(nm) * base_reflectance(rgb, 1.0 / 3, 1.0 / 3, nm); });
            }
        };
        add(sunlit_white());
        const double octaves = 0.5 * std::log2((1 + beta) / (1 - beta));
        for (int k = -int(16 * octaves); k <= int(16 * octaves); ++k)
            add([light = black_body(kelvin), D = std::exp2(k / 16.0)](double nm) { return light(nm * D); });
        const SpectralBasis basis = spectral_basis(spectra, 12, {});
        const Response response = response_of(basis, eye());
        for (double D : {1.0, 0.5, 0.7, 1.4, 2.0}) {
            const double least_part = 1e-3; // light that is darker beside the brightest is black on a screen
            const double brightest = seen_xyz(
                [&](double nm) {
                    return spectra[spectra.size() - 3](nm) + spectra[spectra.size() - 2](nm) + spectra.back()(nm);
                },
                D)
                                         .y;
            double grey = 0, primaries = 0;
            for (std::size_t kind = 1; kind < spectra.size() / 3; ++kind) {
                glm::dvec3 grey_shown(0), grey_truth(0);
                for (std::size_t c = 0; c < 3; ++c) {
                    const glm::dvec3 truth = seen_xyz(spectra[3 * kind + c], D),
                                     shown = xyz_of_coefficients(response, {&basis.columns[(3 * kind + c) * 12], 12}, D);
                    grey_shown += shown, grey_truth += truth;
                    if (truth.y > least_part * brightest)
                        primaries = std::max(primaries, glm::distance(shown, truth) / glm::length(truth));
                }
                if (grey_truth.y > least_part * brightest)
                    grey = std::max(grey, glm::distance(grey_shown, grey_truth) / glm::length(grey_truth));
            }
            std::printf("  %.0f K passing at %.1f c, seen at D = %.1f: grey %.2f %%, primaries %.2f %%\n", kelvin, beta, D,
                100 * grey, 100 * primaries);
            if (D == 1) { // the eye rests beside the surfaces
                EXPECT_LT(grey, 0.01);
                EXPECT_LT(primaries, 0.03);
            }
        }
    }
}

TEST(SpectrumTest, CoefficientsRepresentAColourChart)
{
    for (SpectralLevel level : {SpectralLevel::colours, SpectralLevel::middle, SpectralLevel::fine}) {
        const SpectralErrors errors = chart_errors(level);
        std::printf("  chart, %2d coefficients: CIEDE2000 median %.2f, worst %.2f, luminance %.2f %%\n",
            reflected_counts[std::size_t(level)], errors.median, errors.worst, 100 * errors.luminance);
        if (level == SpectralLevel::fine) {
            EXPECT_LT(errors.median, 1);
            EXPECT_LT(errors.worst, 3);
            EXPECT_LT(errors.luminance, 0.03);
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
        const glm::dvec3 line = seen(eye(), law_of(SpectralLine{450}), D);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(line[c], sum[c], 5e-3 * sum[c] + 1e-9) << D; // the eye's response is curved within the nanometre
    }
    // A table with a narrow peak, and a table of the Sun's spectrum.
    const SpectralTable needle{{{448, 0}, {450, 1}, {452, 0}}};
    std::vector<std::pair<double, double>> points;
    for (double nm = 40; nm <= 12000; nm *= 1.005)
        points.push_back({nm, planck(nm, 5772)});
    for (double D : {0.7, 1.0, 1.3}) {
        const glm::dvec3 a = seen(eye(), law_of(needle), D), b = seen(eye(), law_of(SpectralLine{450}), D);
        const glm::dvec3 c = seen(eye(), law_of(SpectralTable{points}), D), d = seen(eye(), sunlit_white(), D);
        EXPECT_LE(glm::distance(a, b), 0.03 * glm::length(b)) << D; // two nanometres are two steps of the sum
        EXPECT_LT(glm::distance(c, d), 0.002 * glm::length(d)) << D; // the table ends at 12 um
    }
    // A lamp has a sunlit white's energy at any temperature.
    for (double kelvin : {300.0, 2856.0, 20000.0}) {
        double sum = 0;
        for (double nm = 1; nm < 1e7; nm *= 1.001)
            sum += black_body(kelvin)(nm) * 0.001 / nm;
        EXPECT_NEAR(sum * law_of(BlackBody{kelvin}).sunlit_part / energy, 1, 2e-3) << kelvin;
    }
}

TEST(SpectrumTest, FalseColoursShowTheInfraredAndTheUltraviolet)
{
    // Leaves are bright only in the infrared, so they are red; so is a room's own heat.
    const StandardObserver& all = false_colours();
    EXPECT_LT(glm::distance(seen(all, sunlit_white(), 1), glm::dvec3(1)), 1e-9);
    auto leaf = [sun = sunlit_white()](double nm) { return sun(nm) * base_reflectance({0.05, 0.1, 0.03}, 0.02, 0.5, nm); };
    const SpectralBasis basis = spectral_basis({sunlit_white(), leaf}, 12, {BlackBody{288}});
    const Response response = response_of(basis, all);
    EXPECT_LT(glm::distance(seen(response, std::array{1.0, 0.0, 0.0}, 1), glm::dvec3(1)), 2e-3);
    const glm::dvec3 warm = seen(response, std::array{0.0, 0.0, 1.0}, 1);
    EXPECT_GT(warm.r, 0.2); // 390 W/m2, of which 3/4 is below 12 um, over the Sun's infrared
    EXPECT_LT(warm.g + warm.b, 1e-9);
    const glm::dvec3 shown = seen(response, std::array{0.0, 1.0, 0.0}, 1);
    EXPECT_NEAR(shown.r, 0.5, 0.025); // at 860 nm it is as bright as beyond
    EXPECT_NEAR(shown.b, 0.02, 0.01);
    EXPECT_LT(shown.g, 0.2);
}

} // namespace spectrum_test
