#pragma once
#include "config/model/scene_file.h"
#include "ephemeris.h"
#include "world.h"

namespace starbow {

/// Reads a file of globes and their maps. Throws InputError.
std::shared_ptr<const Globes> load_globes(const std::filesystem::path& file);

/// The globes as an eye at a shot's event in a scene's world sees them, the farthest first.
std::vector<SeenGlobe> globes_seen(const Globes& globes, const SceneFile& scene, const Shot& shot);

} // namespace starbow
