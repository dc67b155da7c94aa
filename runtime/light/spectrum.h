#pragma once
#include "config/model/emission.h"
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

namespace starbow {

constexpr double sun_K = 5772; ///< IAU 2015 nominal effective temperature

/// Spectral radiance per frequency at a wavelength in nm, in a scene's own unit.
using Spectrum = std::function<double(double nm)>;

/// A black body's spectral radiance per frequency; arguments in K and nm. In its unit a sunlit white surface at the Earth's
/// distance from the Sun has the luminance 1, so 5772 K itself is about 46,000.
Spectrum black_body(double kelvin);

/// The light of a white, matt surface that faces the Sun at the Earth's distance: luminance 1.
Spectrum sunlit_white();

/// A surface's reflectance from 0 to 1 at wavelengths in nm, rising. It is linear in the logarithm of the wavelength
/// between them and level beyond them.
struct Reflectance {
    std::vector<std::pair<double, double>> points;
    double operator()(double nm) const;
};

/// The smooth reflectance of a base colour (Rec. 709 linear, 0 to 1). It has its own values in the ultraviolet (below about
/// 360 nm) and in the near infrared (beyond about 820 nm). Under the Sun a base colour whose ultraviolet and infrared are
/// its mean looks exactly as given; other values change it by less than 1 %.
double base_reflectance(const glm::dvec3& rgb, double ultraviolet, double infrared, double nm);
/// The infrared value's part in base_reflectance at a wavelength, 0 to 1.
double infrared_part(double nm);

/// Three sensors that look at light together.
struct StandardObserver {
    struct Sample {
        double nm, width_nm;
        glm::dvec3 response; ///< to radiance per frequency, at that wavelength
    };
    std::vector<Sample> samples;
    std::function<glm::dvec3(double nm)> response; ///< the same, at any wavelength
    glm::dmat3 rec709; ///< from the sensors' values to the shown colour
};

/// The CIE 1931 observer, adapted to sunlight; its sensors measure XYZ. Luminance (Y) 1 is that of sunlit_white.
const StandardObserver& eye();

/// An observer that sees beyond the visible; sunlit_white is white. Red is the infrared (830 nm to 12 um), green the visible
/// (360 to 830 nm), blue the ultraviolet (40 to 360 nm), each all energy.
const StandardObserver& false_colours();

/// An observer's colour of light that is shifted by D (above 1 is blue), spectral radiance per frequency kept. The caller
/// applies the headlight effect's D^3. The sum takes every nanometre, for the false colours steps of 1 %.
glm::dvec3 seen(const StandardObserver& observer, const Spectrum& light, double D);

/// The properties of an emission that differ by its kind. A new kind does not compile until it has a law and a name.
struct EmissionLaw {
    Spectrum spectrum{}; ///< in the unit of seen(); none for a line
    double line_nm = 0; ///< of a line
    double sunlit_part = 1; ///< the amount, in the unit of seen(), that has the energy of sunlit_white
    double octaves = 0; ///< its wavelengths' part of sunlight's: it is seen at D as sunlight at D times 2 to this power
    bool smooth = false; ///< its colour changes slowly with D, so that it may be interpolated
    bool is_line() const { return !spectrum; }
};
EmissionLaw law_of(const Emission& emission);
/// The name of a lamp with this spectrum, for people.
std::string lamp_name(const Emission& emission);

/// The colour of an emission, as of a spectrum above: of a black body itself, or of a line or a table with the energy of
/// sunlit_white.
glm::dvec3 seen(const StandardObserver& observer, const EmissionLaw& law, double D);

/// The eye's XYZ of light that is shifted by D.
inline glm::dvec3 seen_xyz(const Spectrum& light, double D) { return seen(eye(), light, D); }

/// The matrix from XYZ under the Sun to Rec. 709 for an eye adapted to sunlight (Bradford).
glm::dmat3 rec709_from_sunlit_xyz();

} // namespace starbow
