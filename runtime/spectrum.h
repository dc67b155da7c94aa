#pragma once
#include <functional>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

namespace starbow {

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

/// What an eye sees of light that is shifted by D (above 1 is blue), spectral radiance per frequency kept: CIE XYZ, summed
/// at every nanometre. The headlight effect's D^3 is the caller's. Luminance (Y) 1 is that of sunlit_white.
glm::dvec3 seen_xyz(const Spectrum& light, double D);

/// From XYZ under the Sun to Rec. 709 as an eye sees it that is adapted to sunlight (Bradford).
glm::dmat3 rec709_from_sunlit_xyz();

} // namespace starbow
