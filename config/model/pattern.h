#pragma once
#include <array>
#include <string>

namespace starbow {

/// Test patterns for the alignment of the outputs; none: the outputs show the flight.
enum class Pattern { none, grid, rings, names, wedges, overlap };
constexpr std::array<const char*, 6> pattern_names = {"none", "grid", "rings", "names", "wedges", "overlap"};
/// Throws InputError for an unknown name.
Pattern pattern_named(const std::string& name);

} // namespace starbow
