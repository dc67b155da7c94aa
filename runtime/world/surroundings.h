#pragma once
#include "config/model/scene_file.h"

namespace starbow {

/// The most boxes of things_at_rest; a world of more things has boxes around neighbours.
constexpr std::size_t most_things = 512;

/// Boxes around the things that rest in a scene's world, scene units: one for each mesh of each node, but for those of the
/// scene's bodies; and around its globes at its time 0. Animated nodes are where they stand at their time 0. It reads the
/// glTF file without its pictures, in milliseconds. Throws InputError as load_world does.
std::vector<AlignedBox> things_at_rest(const SceneFile& scene);

/// The grounds of a scene's globes, on their ways in the two days after its time 0, within a kilometre. Throws InputError.
std::vector<Solid> solid_globes(const SceneFile& scene);

} // namespace starbow
