#pragma once
#include "colour_table.h"

namespace starbow {

/// A basis that represents the light of a scene by a few coefficients. It is made for the scene's own spectra: each of
/// them has a column of coefficients, and light is a sum of columns. Where the spectra that surfaces reflect are no more
/// than the coefficients for them, each spectrum has a coefficient of its own, and every sum is exact. Where they are
/// more, the coefficients are those whose colours, over all D, are closest to the spectra's: principal components under
/// weights that hold colour differences. Emissions of the scene have coefficients of their own, each exact.
struct SpectralBasis {
    int reflected = 0; ///< number of coefficients for `spectra`
    std::vector<Spectrum> spectra; ///< that surfaces reflect
    std::vector<double> importance; ///< of their errors, where they are more than the coefficients
    std::vector<double> columns; ///< of `spectra`: [spectrum * reflected + coefficient]
    std::vector<Emission> own;
    bool exact() const { return int(spectra.size()) == reflected; }
    int size() const { return reflected + int(own.size()); }
};

/// spectra: at least one. most: so many coefficients for them, at most. importance: 1 each where it is left out.
SpectralBasis spectral_basis(
    std::vector<Spectrum> spectra, int most, std::vector<Emission> own, std::vector<double> importance = {});

/// An observer's colours of the basis coefficients, by D: [row * coefficients + coefficient]. `rows` rows cover all D at
/// which any coefficient is visible; D = 1 is one. Beyond them all light falls as 1 / D^2, as every black body's tail does
/// (Rayleigh and Jeans).
ColourTable response_table(const SpectralBasis& basis, const StandardObserver& observer, int rows);

} // namespace starbow
