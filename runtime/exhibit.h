#pragma once
#include "config/layout.h"
#include "config/shot.h"
#include "frame.h"
#include <filesystem>

namespace starbow {

/// Flies until the visitor leaves or `frames` frames have been shown (0: no end). start: where the visit begins and where
/// reset leads back to. pattern: what the outputs show first. Follows changes of the layout's files, of the monitors, and
/// the loss of the GPU. Returns the exit status; throws InputError for what is wrong at the start.
int fly_exhibit(const std::filesystem::path& scene, const Layout& layout, const Shot& start, long frames,
    Pattern pattern = Pattern::none);

} // namespace starbow
