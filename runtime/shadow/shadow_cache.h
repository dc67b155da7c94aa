#pragma once
#include "config/model/scene_file.h"
#include "runtime/world/shadows.h"
#include "runtime/world/world.h"
#include <filesystem>

namespace starbow {

/// The key of a scene's shadows: a hash of everything that they depend on. placed: the world after place_bodies, without
/// vertices, indices and texels.
std::uint64_t shadows_key(const World& world, const World& placed, const SceneFile& scene);

/// Reads kept shadows into those without texels; false: there are none with this key, or the file is damaged.
bool read_kept_shadows(const std::filesystem::path& file, std::uint64_t key, Shadows& shadows);

/// False: the file can't be written.
bool write_kept_shadows(const std::filesystem::path& file, std::uint64_t key, const Shadows& shadows);

} // namespace starbow
