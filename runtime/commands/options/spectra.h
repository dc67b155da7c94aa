#pragma once
#include "runtime/world/spectra.h"
#include <CLI/CLI.hpp>
#include <algorithm>

namespace starbow {

inline CLI::Option* add_spectra(CLI::App& command, std::string& name)
{
    std::vector<std::string> names(spectral_level_names.begin(), spectral_level_names.end());
    names.insert(names.begin(), "needed");
    return command
        .add_option("--spectra", name,
            "How finely light is told: in 3 numbers (colours), 5 (middle), 12 (fine), or as the scene needs")
        ->check(CLI::IsMember(names))
        ->capture_default_str();
}

/// None for what the scene needs.
inline std::optional<SpectralLevel> level_of(const std::string& name)
{
    const auto at = std::find(spectral_level_names.begin(), spectral_level_names.end(), name);
    if (at == spectral_level_names.end())
        return std::nullopt;
    return SpectralLevel(at - spectral_level_names.begin());
}

} // namespace starbow
