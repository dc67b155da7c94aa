#pragma once
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

namespace starbow {

/// A spectrum other than sunlight, without its strength.
struct BlackBody {
    double kelvin;
    bool operator==(const BlackBody&) const = default;
};
struct SpectralLine {
    double nm;
    bool operator==(const SpectralLine&) const = default;
};
/// Relative radiance per wavelength at wavelengths in nm, rising; linear between them, 0 beyond them.
struct SpectralTable {
    std::vector<std::pair<double, double>> points;
    bool operator==(const SpectralTable&) const = default;
};

using Emission = std::variant<BlackBody, SpectralLine, SpectralTable>;

/// The wavelengths of all spectra, nm.
constexpr double shortest_nm = 40, longest_nm = 12000;
/// The temperatures that a file may have: from below the microwave background's to above any star's surface.
constexpr double coldest_K = 0.1, hottest_K = 1e6;
/// The greatest number of a table's points.
constexpr std::size_t least_points = 2, most_points = 4096;

} // namespace starbow
