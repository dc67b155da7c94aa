#pragma once
#include "config/model/emission.h"
#include <functional>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

namespace starbow {

constexpr double sun_K = 5772; ///< IAU 2015 nominal effective temperature

/// Spectral radiance per frequency at a wavelength in nm, in a scene's own unit.
using Spectrum = std::function<double(double nm)>;

/// Of a black body, per frequency, where a sunlit white surface at the Earth's distance from the Sun has the luminance 1:
/// so 5772 K itself is about 46,000. nm, K.
Spectrum black_body(double kelvin);

/// Sunlight from a white, matt surface that faces the Sun at the Earth's distance: luminance 1.
Spectrum sunlit_white();

/// A surface's reflectance from 0 to 1 at wavelengths in nm, rising; between them straight in the logarithm of the
/// wavelength, beyond them level.
struct Reflectance {
    std::vector<std::pair<double, double>> points;
    double operator()(double nm) const;
};

/// The smooth reflectance that belongs to a base colour (Rec. 709 linear, 0 to 1) in the visible, and to values of its own
/// in the ultraviolet (below about 360 nm) and in the near infrared (beyond about 820 nm). A base colour whose ultraviolet
/// and infrared are its mean looks, lit by the Sun, exactly as it says; other values change it by less than 1 %.
double base_reflectance(const glm::dvec3& rgb, double ultraviolet, double infrared, double nm);
/// The part of it at a wavelength that is the infrared's.
double infrared_part(double nm);

/// Three sensors that look at light together.
struct StandardObserver {
    struct Sample {
        double nm, width_nm;
        glm::dvec3 response; ///< to radiance per frequency, at that wavelength
    };
    std::vector<Sample> samples;
    std::function<glm::dvec3(double nm)> response; ///< the same, anywhere
    glm::dmat3 rec709; ///< from what the sensors tell to the colour that is shown
};

/// CIE 1931's, adapted to sunlight; the sensors tell XYZ. Luminance (Y) 1 is that of sunlit_white.
const StandardObserver& eye();

/// One that sees beyond the visible: red is the infrared (830 nm to 12 um), green what the eye sees (360 to 830 nm), blue
/// the ultraviolet (40 to 360 nm), each all energy. sunlit_white is white.
const StandardObserver& false_colours();

/// What an observer sees of light that is shifted by D (above 1 is blue), spectral radiance per frequency kept. The
/// headlight effect's D^3 is the caller's. Summed at every nanometre, the false colours in steps of 1 %.
glm::dvec3 seen(const StandardObserver& observer, const Spectrum& light, double D);

/// The same of an emission: a black body itself, a line or a table with as much energy as sunlit_white.
glm::dvec3 seen(const StandardObserver& observer, const Emission& emission, double D);

/// How much of an emission, as seen() takes it, has as much energy as sunlit_white.
double sunlit_part(const Emission& emission);

/// A black body's or a table's spectrum, as seen() takes it. A line has none.
Spectrum spectrum_of(const Emission& emission);

/// What the eye sees: XYZ.
inline glm::dvec3 seen_xyz(const Spectrum& light, double D) { return seen(eye(), light, D); }

/// From XYZ under the Sun to Rec. 709 as an eye sees it that is adapted to sunlight (Bradford).
glm::dmat3 rec709_from_sunlit_xyz();

} // namespace starbow
