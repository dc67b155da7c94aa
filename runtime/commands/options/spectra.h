#pragma once
#include "runtime/commands/options/command_line.h"
#include "runtime/world/spectra.h"
#include <algorithm>

namespace starbow {

inline Option* add_spectra(Subcommand& command, std::string& name)
{
    std::vector<std::string> names(spectral_level_names.begin(), spectral_level_names.end());
    names.insert(names.begin(), "needed");
    return command
        .add_option("--spectra", name,
            "Coefficients of each spectrum: 3 (colours), 5 (middle), 12 (fine), or as many as the scene needs")
        ->check(one_of(names))
        ->capture_default_str();
}

/// The level of a name; none: the level that the scene needs.
inline std::optional<SpectralLevel> level_of(const std::string& name)
{
    const auto at = std::find(spectral_level_names.begin(), spectral_level_names.end(), name);
    if (at == spectral_level_names.end())
        return std::nullopt;
    return SpectralLevel(at - spectral_level_names.begin());
}

} // namespace starbow
