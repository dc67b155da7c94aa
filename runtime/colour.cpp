#include "colour.h"
#include "runtime/shared.h"
#include <cmath>

namespace starbow {
namespace {

double lobe(double x, double middle, double below, double above)
{
    double t = (x - middle) * (x < middle ? below : above);
    return std::exp(-0.5 * t * t);
}

// Three bands around the primaries: middle (nm) and width in ln(wavelength). Their shifted colours run along the spectrum.
constexpr double band_nm[3] = {611, 545, 455};
constexpr double band_width = 0.042;

double band(int i, double wavelength_nm)
{
    double t = std::log(wavelength_nm / band_nm[i]) / band_width;
    return std::exp(-0.5 * t * t);
}

/// Colour of a spectral radiance per frequency, f(wavelength in nm), whose light is shifted by D, intensity per frequency
/// kept: the sum of f(D l) / l^2 dl over the eye's response.
template <class Spectrum> glm::dvec3 shifted_colour(Spectrum&& f, double D)
{
    glm::dvec3 xyz(0);
    constexpr double first_nm = 360.5, end_nm = 830, step = 1;
    // The eye is the same at every step of the table.
    static const std::vector<glm::dvec3> eye = [] {
        std::vector<glm::dvec3> responses;
        for (double nm = first_nm; nm < end_nm; nm += step)
            responses.push_back(xyz_response(nm));
        return responses;
    }();
    for (std::size_t i = 0; i < eye.size(); ++i) {
        double nm = first_nm + double(i) * step;
        xyz += eye[i] * (f(D * nm) * step / (nm * nm));
    }
    return rec709_linear_from_xyz(xyz);
}

} // namespace

glm::dvec3 xyz_response(double nm)
{
    return {1.056 * lobe(nm, 599.8, 0.0264, 0.0323) + 0.362 * lobe(nm, 442.0, 0.0624, 0.0374)
            - 0.065 * lobe(nm, 501.1, 0.0490, 0.0382),
        0.821 * lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * lobe(nm, 530.9, 0.0613, 0.0322),
        1.217 * lobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * lobe(nm, 459.0, 0.0385, 0.0725)};
}

glm::dvec3 rec709_linear_from_xyz(const glm::dvec3& xyz)
{
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
        -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
        0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

double planck(double nm, double kelvin)
{
    constexpr double second_radiation_nm_K = 1.438776877e7; // hc/k, CODATA 2018
    return std::pow(nm * 1e-3, -5) / std::expm1(second_radiation_nm_K / (nm * kelvin));
}

std::vector<glm::vec4> doppler_table()
{
    constexpr double sun_K = 5772; // IAU 2015 nominal effective temperature
    auto sunlight = [](double nm) { return planck(nm, sun_K) * nm * nm; }; // per frequency
    glm::dvec3 white = shifted_colour(sunlight, 1); // a sunlit grey looks neutral to an eye that lives under the Sun
    auto bands = [](double D) {
        glm::dmat3 columns;
        for (int i = 0; i < 3; ++i)
            columns[i] = shifted_colour([i](double nm) { return band(i, nm); }, D);
        return columns;
    };
    glm::dmat3 at_rest = glm::inverse(bands(1));
    std::vector<glm::vec4> table;
    for (int step = 0; step < COLOUR_STEPS; ++step) {
        double D = std::exp2(COLOUR_RANGE * (2.0 * step / (COLOUR_STEPS - 1) - 1));
        glm::dmat3 chromatic = bands(D) * at_rest;
        glm::dvec3 grey = shifted_colour(sunlight, D) / white;
        for (int row = 0; row < 3; ++row)
            table.push_back(glm::vec4(chromatic[0][row], chromatic[1][row], chromatic[2][row], grey[row]));
    }
    return table;
}

} // namespace starbow
