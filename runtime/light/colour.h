#pragma once
#include <glm/glm.hpp>

namespace starbow {

/// The CIE 1931 2-degree colour matching functions at a wavelength in nm, interpolated in the tables; 0 below 360 and
/// above 830.
glm::dvec3 xyz_response(double wavelength_nm);

} // namespace starbow
