#pragma once
#include "spectrum.h"
#include <optional>
#include <span>

namespace starbow {

/// Light as a few numbers. The first tell what reflects sunlight: either base_reflectance's own (the three primaries; with
/// the ultraviolet and the infrared, five), or basis functions, evenly spaced in the logarithm of the wavelength over what the eye sees
/// and a little more, each weighted by sunlight: what they add up to is a sunlit reflectance, level beyond the outermost,
/// and a grey is a black body at every D. The others are emissions of the scene's own, each exact by itself. A Doppler shift
/// moves the observer along the spectrum: what is seen is a table over ln D.
struct EmissionSpectrum {
    Emission emission;
    bool infrared = false; ///< infrared_part of it alone: of a lamp whose surfaces are other there than in the ultraviolet
    bool operator==(const EmissionSpectrum&) const = default;
};

struct SpectralBasis {
    int reflected = 0; ///< 3, 5; more: basis functions
    std::vector<EmissionSpectrum> own;
    std::vector<double> analysis; ///< [number * grid points + point]: from a sunlit reflectance's samples
    int size() const { return reflected + int(own.size()); }
};

/// reflected: 3, 5 or more.
SpectralBasis spectral_basis(int reflected, std::span<const EmissionSpectrum> own);

/// The numbers of a surface under full sunlight, or under a light as emissions are, sunlit_part of it. A white one under
/// the Sun has a 1 for every basis function. Another light must be among the basis' own: what the surface reflects of it as in the
/// ultraviolet, everywhere, is then exact; and if its infrared part is there too, so is what it reflects of that beside.
std::vector<double> lit(
    const SpectralBasis& basis, const std::optional<Emission>& light, const std::function<double(double nm)>& reflectance);

/// The same where the light comes shifted by D, spectral radiance per frequency kept. Best where the basis' own have
/// `shifted` of it: what the surface reflects as in the ultraviolet, everywhere, is then exact. Otherwise it is told as a
/// reflectance of sunlight, which is level beyond 280 and 1250 nm. A line must be among them.
std::vector<double> lit_shifted(const SpectralBasis& basis, const std::optional<Emission>& light, double D,
    const std::function<double(double nm)>& reflectance);
/// The emission that a light, none: sunlight, is when it comes shifted by D.
Emission shifted(const std::optional<Emission>& light, double D);

/// What an observer sees of each number, by D.
struct ResponseTable {
    int numbers = 0;
    double first_log2_D = 0, per_octave = 0; ///< row i: log2 D = first + i / per_octave
    std::vector<glm::dvec3> seen; ///< [row * numbers + number], the observer's sensors
    int rows() const { return int(seen.size()) / numbers; }
};

/// Over all D at which anything of the basis is seen and beyond which all of it falls as 1 / D^2, as every black body's tail
/// does (Rayleigh and Jeans).
ResponseTable response_table(const SpectralBasis& basis, const StandardObserver& observer, int rows);

} // namespace starbow
