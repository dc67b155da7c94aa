#include "spectrum.h"
#include "colour.h"
#include "config/json/reader.h"
#include "config/model/angles.h"
#include "primaries.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr double second_radiation_nm_K = 1.438776877e7; // hc/k, CODATA 2018
/// A white surface's radiance over the Sun's own: the solid angle over pi, the square of the Sun's nominal radius over the
/// astronomical unit (IAU 2015, IAU 2012).
constexpr double dilution = (6.957e8 / 1.495978707e11) * (6.957e8 / 1.495978707e11);

/// nu^3 / (exp(h nu / kT) - 1) with nu in units of c / 500 nm.
double planck_per_frequency(double nm, double kelvin)
{
    const double nu = 500 / nm;
    return nu * nu * nu / std::expm1(std::min(second_radiation_nm_K / (nm * kelvin), 700.0));
}

/// Sum of response * radiance per frequency over frequencies, in units of c / nm.
glm::dvec3 sum(const StandardObserver& observer, const Spectrum& light, double D)
{
    glm::dvec3 sum(0);
    for (const StandardObserver::Sample& s : observer.samples)
        sum += s.response * (light(D * s.nm) * s.width_nm / (s.nm * s.nm));
    return sum;
}

/// A black body's radiance over all frequencies, in units of c / nm (Stefan and Boltzmann).
double energy(double kelvin) { return std::pow(pi, 4) / 15 * std::pow(500 * kelvin / second_radiation_nm_K, 4) / 500; }

double straight(const std::vector<std::pair<double, double>>& points, double nm)
{
    if (nm < points.front().first || nm > points.back().first)
        return 0;
    const auto after = std::upper_bound(points.begin() + 1, points.end() - 1, nm,
        [](double at, const std::pair<double, double>& point) { return at < point.first; });
    const auto before = after - 1;
    return std::lerp(before->second, after->second, (nm - before->first) / (after->first - before->first));
}

double energy(const SpectralTable& table)
{
    double energy = 0;
    for (std::size_t i = 1; i < table.points.size(); ++i)
        energy += 0.5 * (table.points[i].first - table.points[i - 1].first)
            * (table.points[i].second + table.points[i - 1].second);
    return energy;
}

/// The false colours' wavelengths of red, green and blue: from, to.
constexpr double bands[3][2] = {{830, longest_nm}, {360, 830}, {shortest_nm, 360}};

double logistic(double x) { return 1 / (1 + std::exp(-x)); }

EmissionLaw law(const BlackBody& body)
{
    return {.spectrum = black_body(body.kelvin),
        .sunlit_part = dilution * std::pow(sun_K / body.kelvin, 4),
        .octaves = std::log2(body.kelvin / sun_K),
        .smooth = true};
}
EmissionLaw law(const SpectralLine& line) { return {.line_nm = line.nm}; }
EmissionLaw law(const SpectralTable& table)
{
    // The table is per wavelength, the result per frequency.
    const double scale = dilution * energy(sun_K) / energy(table);
    return {.spectrum = [table, scale](double nm) { return scale * straight(table.points, nm) * nm * nm; }};
}

std::string name(const BlackBody& body) { return "a lamp of " + shown(body.kelvin) + " K"; }
std::string name(const SpectralLine&) { return "a lamp with a spectrum"; }
std::string name(const SpectralTable&) { return "a lamp with a spectrum"; }

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

double infrared_part(double nm) { return logistic(std::log(nm / 820) / 0.05); }

double base_reflectance(const glm::dvec3& rgb, double ultraviolet, double infrared, double nm)
{
    // The limits of the ultraviolet and the infrared, in the logarithm of the wavelength. Glass, paint and leaves change
    // there too.
    const double uv = logistic(-std::log(nm / 360) / 0.035), ir = infrared_part(nm);
    const double step = std::log(primaries_to_nm / primaries_from_nm) / double(primaries.size() - 1);
    const double at = std::clamp(std::log(nm / primaries_from_nm) / step, 0.0, double(primaries.size() - 1));
    const std::size_t i = std::min(std::size_t(at), primaries.size() - 2);
    double visible = 0;
    for (int c = 0; c < 3; ++c)
        visible += rgb[c]
            * std::lerp(double(primaries[i][std::size_t(c)]), double(primaries[i + 1][std::size_t(c)]), at - double(i));
    return uv * ultraviolet + ir * infrared + (1 - uv - ir) * visible;
}

const StandardObserver& eye()
{
    static const StandardObserver found = [] {
        StandardObserver eye;
        for (int nm = 360; nm <= 830; ++nm)
            eye.samples.push_back({double(nm), 1, xyz_response(nm)});
        const double scale = 1 / sum(eye, sunlit_white(), 1).y;
        for (StandardObserver::Sample& sample : eye.samples)
            sample.response *= scale;
        eye.response = [scale](double nm) { return scale * xyz_response(nm); };
        eye.rec709 = rec709_from_sunlit_xyz();
        return eye;
    }();
    return found;
}

const StandardObserver& false_colours()
{
    static const StandardObserver found = [] {
        StandardObserver all;
        for (int c = 0; c < 3; ++c) {
            const int steps = int(std::log(bands[c][1] / bands[c][0]) / 0.01) + 1;
            const double step = std::log(bands[c][1] / bands[c][0]) / steps;
            glm::dvec3 response(0);
            response[c] = 1;
            for (int i = 0; i < steps; ++i) {
                const double nm = bands[c][0] * std::exp((i + 0.5) * step);
                all.samples.push_back({nm, nm * step, response});
            }
        }
        const glm::dvec3 scale = 1.0 / sum(all, sunlit_white(), 1);
        for (StandardObserver::Sample& sample : all.samples)
            sample.response *= scale;
        all.response = [scale](double nm) {
            glm::dvec3 response(0);
            for (int c = 0; c < 3; ++c)
                if (nm >= bands[c][0] && nm < bands[c][1])
                    response[c] = scale[c];
            return response;
        };
        all.rec709 = glm::dmat3(1);
        return all;
    }();
    return found;
}

glm::dvec3 seen(const StandardObserver& observer, const Spectrum& light, double D) { return sum(observer, light, D); }

EmissionLaw law_of(const Emission& emission)
{
    return std::visit([](const auto& kind) { return law(kind); }, emission);
}

std::string lamp_name(const Emission& emission)
{
    return std::visit([](const auto& kind) { return name(kind); }, emission);
}

glm::dvec3 seen(const StandardObserver& observer, const EmissionLaw& law, double D)
{
    // A line's radiance per frequency is a narrow peak, which the shift broadens by D at the same height.
    if (law.is_line())
        return observer.response(law.line_nm / D) * (D * dilution * energy(sun_K));
    return seen(observer, law.spectrum, D);
}

glm::dmat3 rec709_from_sunlit_xyz()
{
    // Bradford's cones: ICC.1:2022, annex E. glm's matrices are written column by column.
    const glm::dmat3 cones
        = glm::transpose(glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
    const glm::dmat3 xyz_from_rec709
        = glm::transpose(glm::dmat3(0.4123907992659595, 0.3575843393838780, 0.1804807884018343, 0.2126390058715104,
            0.7151686787677559, 0.0721923153607337, 0.0193308187155918, 0.1191947797946259, 0.9505321522496608));
    glm::dvec3 sun(0);
    for (int nm = 360; nm <= 830; ++nm)
        sun += xyz_response(nm) * (planck_per_frequency(nm, sun_K) / (double(nm) * nm));
    const glm::dvec3 ratio = (cones * (xyz_from_rec709 * glm::dvec3(1))) / (cones * (sun / sun.y));
    const glm::dmat3 adapted = glm::inverse(cones) * glm::dmat3(ratio.x, 0, 0, 0, ratio.y, 0, 0, 0, ratio.z) * cones;
    return glm::inverse(xyz_from_rec709) * adapted;
}

} // namespace starbow
