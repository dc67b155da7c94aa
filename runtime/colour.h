#pragma once
#include <glm/glm.hpp>
#include <vector>

namespace starbow {

/// CIE 1931 2-degree colour matching functions at a wavelength in nm, from the tables; nothing below 360 and above 830.
glm::dvec3 xyz_response(double wavelength_nm);

/// CIE XYZ to linear Rec. 709 primaries with a D65 white.
glm::dvec3 rec709_linear_from_xyz(const glm::dvec3& xyz);

/// Spectral radiance of a black body per wavelength, up to a constant: Planck's law. nm, K.
double planck(double wavelength_nm, double temperature_K);

} // namespace starbow
