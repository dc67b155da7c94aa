#pragma once
#include "config/model/scene_file.h"
#include "runtime/world/world.h"
#include <filesystem>
#include <functional>

namespace starbow {

/// Computes the shadows of a scene with SceneFile::shadows, and adds them to its world; nothing for others. Where its still
/// things have too many triangles for the machine's memory, or more lamps than there are maps for, it adds notes. world:
/// before place_bodies. folder: shadows are kept there by their content, and the next start reads them; empty: they are
/// not. progress: the done part, 0 to 1. Returns true if it has written a file.
bool add_shadows(World& world, const SceneFile& scene, const std::filesystem::path& folder = {},
    const std::function<void(double)>& progress = {});

} // namespace starbow
