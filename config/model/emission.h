#pragma once
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

namespace starbow {

// The spectra other than sunlight, without their strength. Each says its member's name in a scene's light and in the extras
// of a glTF material.
struct BlackBody {
    static constexpr const char *scene_member = "temperature_K", *gltf_member = "black_body_K";
    double kelvin;
    bool operator==(const BlackBody&) const = default;
};
struct SpectralLine {
    static constexpr const char *scene_member = "line_nm", *gltf_member = "line_nm";
    double nm;
    bool operator==(const SpectralLine&) const = default;
};
/// Relative radiance per wavelength at wavelengths in nm, rising; linear between them, 0 beyond them.
struct SpectralTable {
    static constexpr const char *scene_member = "spectrum", *gltf_member = "table";
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
