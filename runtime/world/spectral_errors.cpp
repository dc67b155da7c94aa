#include "spectral_errors.h"
#include "illumination.h"
#include "runtime/light/colour_difference.h"
#include "runtime/light/response.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// CIEDE2000 of two colours scaled to half of the white's luminance.
double difference(const glm::dvec3& one, const glm::dvec3& two)
{
    static const glm::dvec3 white = seen_xyz(sunlit_white(), 1);
    return ciede2000(cielab(one * (0.5 / one.y), white), cielab(two * (0.5 / two.y), white));
}

/// Eighteen smooth reflectances, modelled on the coloured fields of a colour chart: a level, steps (s) and bumps (g). Beyond
/// the visible each has values of its own, as paints do.
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
            {0.07, {{'g', 0.33, 480, 48}, {'s', 0.1, 720, 20}}}};
    return fields;
}

constexpr double least_part = 1e-3; // of the brightest spectrum's luminance at the same D
constexpr int steps_per_octave = 8, octaves = 3;

/// Luminance and colour of each spectrum at each D by sums over every nanometre: [step * spectra + spectrum].
std::vector<glm::dvec3> truths(const std::vector<Spectrum>& spectra, std::span<const double> Ds)
{
    std::vector<glm::dvec3> all;
    for (double D : Ds)
        for (const Spectrum& spectrum : spectra)
            all.push_back(seen_xyz(spectrum, D));
    return all;
}

} // namespace

SpectralErrors spectral_errors(const std::vector<Spectrum>& spectra, int most, std::vector<double> importance)
{
    const SpectralBasis basis = spectral_basis(spectra, most, {}, std::move(importance));
    const Response response = response_of(basis, eye());
    const glm::dmat3 xyz_from_shown = glm::inverse(eye().rec709);
    std::vector<double> Ds;
    for (int step = -octaves * steps_per_octave; step <= octaves * steps_per_octave; ++step) // between rows of the table
        Ds.push_back(std::exp2(double(step) / steps_per_octave + (step < 0 ? 1 : -1) / 256.0));
    const std::vector<glm::dvec3> true_colours = truths(spectra, Ds);
    SpectralErrors errors;
    std::vector<double> all;
    const std::size_t n = spectra.size(), count = std::size_t(basis.reflected);
    for (std::size_t step = 0; step < Ds.size(); ++step) {
        double brightest = 0;
        for (std::size_t j = 0; j < n; ++j)
            brightest = std::max(brightest, true_colours[step * n + j].y);
        for (std::size_t j = 0; j < n; ++j) {
            const glm::dvec3& truth = true_colours[step * n + j];
            if (!(truth.y > least_part * brightest))
                continue;
            const glm::dvec3 shown
                = xyz_from_shown * seen(response, std::span(basis.columns).subspan(j * count, count), Ds[step]);
            const double off = shown.y > 0 ? difference(truth, shown) : 100;
            if (off > errors.worst)
                errors.worst = off, errors.worst_spectrum = int(j);
            errors.luminance = std::max(errors.luminance, std::abs(shown.y / truth.y - 1));
            all.push_back(off);
        }
    }
    if (all.empty())
        return errors;
    std::nth_element(all.begin(), all.begin() + std::ptrdiff_t(all.size() / 2), all.end());
    errors.median = all[all.size() / 2];
    return errors;
}

SpectralErrors chart_errors(SpectralLevel level)
{
    std::vector<Spectrum> fields;
    for (const Field& field : chart())
        fields.push_back([field, sun = sunlit_white()](double nm) { return sun(nm) * field(nm); });
    return spectral_errors(fields, reflected_counts[std::size_t(level)]);
}

SceneErrors scene_errors(const World& world, const SceneFile& scene, SpectralLevel level)
{
    const Illumination light = illumination_of(world, scene);
    const SpectralErrors errors
        = spectral_errors(spectra_of(light), reflected_counts[std::size_t(level)], importance_of(light));
    return {errors, name_of(light, light.reflected[std::size_t(errors.worst_spectrum)])};
}

} // namespace starbow
