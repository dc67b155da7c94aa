#pragma once
#include "spectrum.h"
#include <optional>
#include <span>

namespace starbow {

/// A basis that represents light by a few coefficients. The first coefficients represent reflected sunlight: either
/// base_reflectance's own (the three primaries; with the ultraviolet and the infrared, five), or triangular basis
/// functions (linear B-splines). The triangular functions are evenly spaced in the logarithm of the wavelength over the
/// visible and a little more, each weighted by sunlight. Their sum is a sunlit reflectance that is constant beyond the
/// outermost functions; a grey is a black body at every D. The other coefficients are the scene's emission basis spectra,
/// each exact by itself. A Doppler shift moves the observer along the spectrum, so the observed colour is a table over ln
/// D.
struct EmissionSpectrum {
    Emission emission;
    bool infrared = false; ///< only its infrared_part: of a lamp whose surfaces reflect otherwise there than in the
    ///< ultraviolet
    bool operator==(const EmissionSpectrum&) const = default;
};

struct SpectralBasis {
    int reflected = 0; ///< 3, 5; more: basis functions
    std::vector<EmissionSpectrum> own;
    std::vector<double> analysis; ///< [coefficient * grid points + point]: from a sunlit reflectance's samples
    int size() const { return reflected + int(own.size()); }
};

/// reflected: 3, 5 or more coefficients of reflected sunlight. own: the scene's emission spectra.
SpectralBasis spectral_basis(int reflected, std::span<const EmissionSpectrum> own);

/// The coefficients of a surface under full sunlight, or under a light in the unit of emissions (sunlit_part of it). A
/// white surface under the Sun has a 1 for every basis function. Another light must be in the basis as an emission basis
/// spectrum. A reflectance that equals its ultraviolet value everywhere is then exact. If the basis also has the light's
/// infrared part, the reflectance of that part is exact too.
std::vector<double> lit(
    const SpectralBasis& basis, const std::optional<Emission>& light, const std::function<double(double nm)>& reflectance);

/// The same for light that arrives shifted by D, with spectral radiance per frequency kept. It is exact for a reflectance
/// that equals its ultraviolet value everywhere, if the basis has the emission spectrum `shifted`. Otherwise it is
/// approximated by a reflectance of sunlight, which is constant beyond 280 and 1250 nm. The basis must have a line's
/// spectrum.
std::vector<double> lit_shifted(const SpectralBasis& basis, const std::optional<Emission>& light, double D,
    const std::function<double(double nm)>& reflectance);
/// The emission spectrum of a light that arrives shifted by D; light: nullopt is sunlight.
Emission shifted(const std::optional<Emission>& light, double D);

/// An observer's colour of each basis coefficient, by D.
struct ResponseTable {
    int coefficients = 0;
    double first_log2_D = 0, per_octave = 0; ///< row i: log2 D = first + i / per_octave
    std::vector<glm::dvec3> seen; ///< [row * coefficients + coefficient], the observer's sensors
    int rows() const { return int(seen.size()) / coefficients; }
};

/// Covers all D at which any coefficient is visible. Beyond them all light falls as 1 / D^2, as every black body's tail
/// does (Rayleigh and Jeans).
ResponseTable response_table(const SpectralBasis& basis, const StandardObserver& observer, int rows);

} // namespace starbow
