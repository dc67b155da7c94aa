#pragma once
#include "ephemeris.h"
#include "world.h"

namespace starbow {

/// Reads a file of globes and their maps. Throws InputError.
std::shared_ptr<const Globes> load_globes(const std::filesystem::path& file);

} // namespace starbow
