// Spectra against themselves at every nanometre: black bodies, sunlit greys and a chart of smooth reflectances, at D from
// 1/8 to 8, by few numbers and in full.
#include "runtime/colour.h"
#include "runtime/spectral_basis.h"
#include "tests/colour_difference.h"
#include <cstdio>
#include <gtest/gtest.h>

using namespace starbow;
using namespace starbow::testing;

namespace {

glm::dvec2 chromaticity(const glm::dvec3& xyz) { return glm::dvec2(xyz) / (xyz.x + xyz.y + xyz.z); }

/// At equal luminance, half of the white's.
double difference(const glm::dvec3& one, const glm::dvec3& two)
{
    static const glm::dvec3 white = seen_xyz(sunlit_white(), 1);
    return ciede2000(cielab(one * (0.5 / one.y), white), cielab(two * (0.5 / two.y), white));
}

/// Twenty-four smooth reflectances after the names and the kinds of a colour chart's fields: a level, steps (s) and bumps
/// (g). Each goes on beyond the visible as paints do: into a value of its own.
struct Field {
    double level;
    struct Feature {
        char kind;
        double height, middle_nm, width_nm;
    };
    std::vector<Feature> features;

    double visible(double nm) const
    {
        double value = level;
        for (const Feature& f : features) {
            const double x = (nm - f.middle_nm) / f.width_nm;
            value += f.height * (f.kind == 's' ? 1 / (1 + std::exp(-x)) : std::exp(-0.5 * x * x));
        }
        return std::clamp(value, 0.005, 0.98);
    }
    double operator()(double nm) const
    {
        if (features.empty())
            return level;
        double mean = 0;
        for (double at = 400; at <= 700; at += 10)
            mean += visible(at) / 31;
        const double uv = 1 / (1 + std::exp(std::log(nm / 360) / 0.035)),
                     ir = 1 / (1 + std::exp(-std::log(nm / 820) / 0.05));
        return uv * (0.5 * visible(380) + 0.02) + ir * (0.8 * mean + 0.05)
            + (1 - uv - ir) * visible(std::clamp(nm, 330.0, 900.0));
    }
};

const std::vector<Field>& chart()
{
    static const std::vector<Field> fields
        = {{0.06, {{'s', 0.14, 600, 35}}}, {0.22, {{'s', 0.2, 520, 60}, {'s', 0.28, 590, 15}, {'g', -0.06, 550, 14}}},
            {0.12, {{'g', 0.24, 450, 60}, {'s', 0.04, 700, 20}}}, {0.05, {{'g', 0.11, 550, 32}, {'s', 0.35, 710, 14}}},
            {0.2, {{'g', 0.26, 440, 48}, {'s', 0.3, 680, 25}}}, {0.2, {{'g', 0.42, 505, 52}, {'s', 0.15, 720, 20}}},
            {0.05, {{'s', 0.56, 588, 17}}}, {0.08, {{'g', 0.3, 440, 38}, {'s', 0.35, 700, 20}}},
            {0.1, {{'s', 0.48, 605, 16}, {'g', 0.04, 430, 30}}}, {0.045, {{'g', 0.15, 425, 32}, {'s', 0.32, 665, 25}}},
            {0.07, {{'s', 0.45, 520, 18}, {'g', -0.1, 640, 40}, {'s', 0.2, 720, 25}}}, {0.06, {{'s', 0.62, 560, 20}}},
            {0.05, {{'g', 0.29, 445, 30}, {'s', 0.15, 720, 20}}}, {0.055, {{'g', 0.3, 530, 35}, {'s', 0.15, 715, 25}}},
            {0.045, {{'s', 0.68, 617, 13}}}, {0.055, {{'s', 0.7, 515, 17}}},
            {0.1, {{'s', 0.7, 610, 18}, {'g', 0.3, 430, 45}, {'g', -0.03, 540, 25}}},
            {0.07, {{'g', 0.33, 480, 48}, {'s', 0.1, 720, 20}}}, {0.9, {}}, {0.59, {}}, {0.36, {}}, {0.19, {}}, {0.09, {}},
            {0.03, {}}};
    return fields;
}

struct Errors {
    std::vector<double> all;
    double luminance = 0;
    void add(const glm::dvec3& truth, const glm::dvec3& shown)
    {
        all.push_back(shown.y > 0 ? difference(truth, shown) : 100);
        luminance = std::max(luminance, std::abs(shown.y / truth.y - 1));
    }
    double worst() const { return *std::max_element(all.begin(), all.end()); }
    double median()
    {
        std::nth_element(all.begin(), all.begin() + std::ptrdiff_t(all.size() / 2), all.end());
        return all[all.size() / 2];
    }
};

Errors of_chart(const SpectralBasis& basis, bool greys)
{
    Errors errors;
    const Spectrum sun = sunlit_white();
    for (const Field& field : chart())
        if (field.features.empty() == greys) {
            const std::vector<double> numbers = sunlit(basis, field);
            for (int step = -24; step <= 24; ++step) {
                const double D = std::exp2(step / 8.0 + (step < 0 ? 1 : -1) / 256.0); // between two steps of the table
                errors.add(seen_xyz([&](double nm) { return sun(nm) * field(nm); }, D), seen_xyz(basis, numbers, D));
            }
        }
    return errors;
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

TEST(SpectrumTest, ABaseColourLooksAsItSaysUnderTheSun)
{
    const glm::dmat3 rec709 = rec709_from_sunlit_xyz();
    const Spectrum sun = sunlit_white();
    for (const glm::dvec3& rgb :
        {glm::dvec3(1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(0.2, 0.5, 0.7)}) {
        const double mean = (rgb.r + rgb.g + rgb.b) / 3;
        const glm::dvec3 seen
            = rec709 * seen_xyz([&](double nm) { return sun(nm) * base_reflectance(rgb, mean, mean, nm); }, 1);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(seen[c], rgb[c], 1e-4) << c; // the primaries are told to five digits
        for (double nm = 40; nm < 12000; nm *= 1.02) {
            EXPECT_GE(base_reflectance(rgb, mean, mean, nm), -1e-6);
            EXPECT_LE(base_reflectance(rgb, mean, mean, nm), 1 + 1e-6);
        }
        EXPECT_NEAR(base_reflectance(rgb, 0.3, 0.6, 100), 0.3, 1e-6);
        EXPECT_NEAR(base_reflectance(rgb, 0.3, 0.6, 5000), 0.6, 1e-6);
    }
}

TEST(SpectrumTest, ABlackBodyStaysOne)
{
    // The truth path: T at D is DT, in colour to rounding and in luminance as D^-3 once the headlight's D^3 is taken off.
    for (double kelvin : {1000.0, 2856.0, 5772.0, 40000.0})
        for (double D : {0.05, 0.5, 3.0, 20.0}) {
            if (kelvin * D < 300)
                continue; // nothing is seen
            const glm::dvec3 moving = seen_xyz(black_body(kelvin), D), hotter = seen_xyz(black_body(kelvin * D), 1);
            EXPECT_LT(glm::distance(chromaticity(moving), chromaticity(hotter)), 1e-12);
            EXPECT_NEAR(moving.y * D * D * D / hotter.y, 1, 1e-9);
        }
}

TEST(SpectrumTest, FewNumbersHoldBlackBodiesAndGreys)
{
    const std::vector<double> kelvins = {1000, 2856, 5772, 40000};
    const SpectralBasis basis = spectral_basis(12, kelvins);
    for (std::size_t i = 0; i < kelvins.size(); ++i)
        for (int step = -34; step <= 34; ++step) { // 1/20 to 20
            const double D = std::exp2(step * std::log2(20.0) / 34);
            std::vector<double> numbers(std::size_t(basis.size()), 0.0);
            numbers[std::size_t(basis.hats) + i] = 1;
            const glm::dvec3 shown = seen_xyz(basis, numbers, D), truth = seen_xyz(black_body(kelvins[i]), D);
            EXPECT_LT(glm::distance(chromaticity(shown), chromaticity(truth)), 0.002) << kelvins[i] << " K at " << D;
        }
    for (int size : {3, 4, 8, 12}) {
        const SpectralBasis own = spectral_basis(size, {});
        Errors greys = of_chart(own, true);
        std::printf(
            "  greys, %2d numbers: CIEDE2000 worst %.4f, luminance %.4f %%\n", size, greys.worst(), 100 * greys.luminance);
        EXPECT_LT(greys.worst(), 0.05);
        // Sunlight at D = 1/8 is that of 722 K, whose luminance grows as D^32: straight lines between the table's steps miss
        // it by (32 ln 2 / 128)^2 / 8.
        EXPECT_LT(greys.luminance, 3.8e-3);
    }
}

TEST(SpectrumTest, FewNumbersHoldAColourChart)
{
    for (int size : {3, 4, 8, 12}) {
        const SpectralBasis basis = spectral_basis(size, {});
        Errors errors = of_chart(basis, false);
        std::printf("  chart, %2d numbers: CIEDE2000 median %.2f, worst %.2f, luminance %.2f %%\n", size, errors.median(),
            errors.worst(), 100 * errors.luminance);
        if (size >= 12) {
            EXPECT_LT(errors.median(), 1);
            EXPECT_LT(errors.worst(), 3);
            EXPECT_LT(errors.luminance, 0.02);
        }
    }
}
