#pragma once
#include "spectrum.h"
#include <span>

namespace starbow {

/// The observed colours of several spectra, by D: [row * spectra + spectrum], the observer's sensors. Row i holds those at
/// log2 D = first + i / per_octave.
struct ColourTable {
    int spectra = 0;
    double first_log2_D = 0;
    int per_octave = 1;
    std::vector<glm::dvec3> seen;
    int rows() const { return spectra > 0 ? int(seen.size()) / spectra : 0; }
    const glm::dvec3* row(int i) const { return &seen[std::size_t(i) * std::size_t(spectra)]; }
};

/// A shift by D moves a spectrum along the logarithm of the wavelength. On a grid that is even in it, and whose step
/// divides the rows' step, all rows are sums with the same weights: each spectrum is evaluated once for each of some
/// 6,000 wavelengths. The sums equal those of seen() but for the curvature of a spectrum within 0.2 % of its wavelength.
ColourTable colour_table(
    std::span<const Spectrum> spectra, const StandardObserver& observer, double first_log2_D, int per_octave, int rows);

} // namespace starbow
