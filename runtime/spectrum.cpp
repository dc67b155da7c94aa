#include "spectrum.h"
#include "colour.h"
#include "primaries.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr double second_radiation_nm_K = 1.438776877e7; // hc/k, CODATA 2018
constexpr double sun_K = 5772; // IAU 2015 nominal effective temperature
/// A white surface's radiance over the Sun's own: the solid angle over pi, the square of the Sun's nominal radius over the
/// astronomical unit (IAU 2015, IAU 2012).
constexpr double dilution = (6.957e8 / 1.495978707e11) * (6.957e8 / 1.495978707e11);

/// nu^3 / (exp(h nu / kT) - 1) with nu in units of c / 500 nm.
double planck_per_frequency(double nm, double kelvin)
{
    const double nu = 500 / nm;
    return nu * nu * nu / std::expm1(std::min(second_radiation_nm_K / (nm * kelvin), 700.0));
}

glm::dvec3 sum_over_eye(const Spectrum& light, double D)
{
    glm::dvec3 xyz(0);
    for (int nm = 360; nm <= 830; ++nm)
        xyz += xyz_response(nm) * (light(D * nm) / (double(nm) * nm)); // per frequency, over wavelengths
    return xyz;
}

double scale()
{
    static const double found = 1 / sum_over_eye([](double nm) { return planck_per_frequency(nm, sun_K) * dilution; }, 1).y;
    return found;
}

double logistic(double x) { return 1 / (1 + std::exp(-x)); }

} // namespace

Spectrum black_body(double kelvin)
{
    return [kelvin](double nm) { return planck_per_frequency(nm, kelvin); };
}

Spectrum sunlit_white()
{
    return [](double nm) { return dilution * planck_per_frequency(nm, sun_K); };
}

double Reflectance::operator()(double nm) const
{
    if (points.empty())
        return 0;
    const auto after = std::upper_bound(points.begin(), points.end(), nm,
        [](double at, const std::pair<double, double>& point) { return at < point.first; });
    if (after == points.begin())
        return points.front().second;
    if (after == points.end())
        return points.back().second;
    const auto before = after - 1;
    const double part = std::log(nm / before->first) / std::log(after->first / before->first);
    return before->second + part * (after->second - before->second);
}

double base_reflectance(const glm::dvec3& rgb, double ultraviolet, double infrared, double nm)
{
    // Where the one ends and the other begins, in the logarithm of the wavelength: glass, paint and leaves change there too.
    const double uv = logistic(-std::log(nm / 360) / 0.035), ir = logistic(std::log(nm / 820) / 0.05);
    const double step = std::log(primaries_to_nm / primaries_from_nm) / double(primaries.size() - 1);
    const double at = std::clamp(std::log(nm / primaries_from_nm) / step, 0.0, double(primaries.size() - 1));
    const std::size_t i = std::min(std::size_t(at), primaries.size() - 2);
    double visible = 0;
    for (int c = 0; c < 3; ++c)
        visible += rgb[c]
            * std::lerp(double(primaries[i][std::size_t(c)]), double(primaries[i + 1][std::size_t(c)]), at - double(i));
    return uv * ultraviolet + ir * infrared + (1 - uv - ir) * visible;
}

glm::dvec3 seen_xyz(const Spectrum& light, double D) { return scale() * sum_over_eye(light, D); }

glm::dmat3 rec709_from_sunlit_xyz()
{
    // Bradford's cones: ICC.1:2022, annex E. glm's matrices are written column by column.
    const glm::dmat3 cones
        = glm::transpose(glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
    const glm::dmat3 xyz_from_rec709
        = glm::transpose(glm::dmat3(0.4123907992659595, 0.3575843393838780, 0.1804807884018343, 0.2126390058715104,
            0.7151686787677559, 0.0721923153607337, 0.0193308187155918, 0.1191947797946259, 0.9505321522496608));
    const glm::dvec3 ratio = (cones * (xyz_from_rec709 * glm::dvec3(1))) / (cones * seen_xyz(sunlit_white(), 1));
    const glm::dmat3 adapted = glm::inverse(cones) * glm::dmat3(ratio.x, 0, 0, 0, ratio.y, 0, 0, 0, ratio.z) * cones;
    return glm::inverse(xyz_from_rec709) * adapted;
}

} // namespace starbow
