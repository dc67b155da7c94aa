#pragma once
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

namespace starbow {

/// A spectrum other than sunlight, up to how strong it is.
struct BlackBody {
    double kelvin;
    bool operator==(const BlackBody&) const = default;
};
struct SpectralLine {
    double nm;
    bool operator==(const SpectralLine&) const = default;
};
/// Radiance per wavelength, relative, at wavelengths in nm, rising; straight between them, nothing beyond them.
struct SpectralTable {
    std::vector<std::pair<double, double>> points;
    bool operator==(const SpectralTable&) const = default;
};

using Emission = std::variant<BlackBody, SpectralLine, SpectralTable>;

/// What spectra are told over.
constexpr double shortest_nm = 40, longest_nm = 12000;
/// Temperatures that a file may ask for: from below the microwave background's to above any star's surface.
constexpr double coldest_K = 0.1, hottest_K = 1e6;
/// How many points a table may have.
constexpr std::size_t least_points = 2, most_points = 4096;

} // namespace starbow
