#pragma once
#include "spectrum.h"
#include <span>

namespace starbow {

/// Light as a few numbers. The first are hats, evenly spaced in the logarithm of the wavelength over what the eye sees and a
/// little more, each weighted by sunlight: what they add up to is a sunlit reflectance, level beyond the outermost, and a
/// grey is a black body at every D. The others are black bodies of the scene's own temperatures, each exact by itself.
/// A Doppler shift moves the eye along the hats: what it sees is a table over ln D.
struct SpectralBasis {
    int hats = 0;
    std::vector<double> thermal_K;
    std::vector<double> analysis; ///< [hat * grid points + point]: a hat's number from a sunlit reflectance's samples
    std::vector<glm::dvec3> response; ///< [step * size() + number]: XYZ per unit of each number, shift alone
    int size() const { return hats + int(thermal_K.size()); }
};

/// Steps of the response table: log2 D from -response_below to +response_above.
constexpr int response_per_octave = 128;
constexpr double response_below = 6, response_above = 10;

/// size: of the whole, at least three more than there are temperatures.
SpectralBasis spectral_basis(int size, std::span<const double> thermal_K);

/// A sunlit surface's numbers: white under full sunlight has a 1 for every hat.
std::vector<double> sunlit(const SpectralBasis& basis, const std::function<double(double nm)>& reflectance);

/// What the eye sees of such numbers at D: as seen_xyz of the light that they stand for.
glm::dvec3 seen_xyz(const SpectralBasis& basis, std::span<const double> numbers, double D);

} // namespace starbow
