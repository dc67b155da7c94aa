#pragma once
#include <glm/glm.hpp>

namespace starbow {

/// CIE 1931 2-degree colour matching functions at a wavelength in nm, from the tables; nothing below 360 and above 830.
glm::dvec3 xyz_response(double wavelength_nm);

} // namespace starbow
