#pragma once
#include <cmath>

namespace starbow {

/// Spectral radiance of a black body per wavelength, up to a constant: Planck's law. nm, K.
inline double planck(double nm, double kelvin)
{
    constexpr double second_radiation_nm_K = 1.438776877e7; // hc/k, CODATA 2018
    return std::pow(nm * 1e-3, -5) / std::expm1(second_radiation_nm_K / (nm * kelvin));
}

} // namespace starbow
