#pragma once
#include "config/model/scene_file.h"
#include "runtime/world/world.h"
#include <vector>

namespace starbow {

/// The boxes of a world's still things: around all but backdrops; and around most of them, where visitors look closely:
/// without the few that are farthest from the others, such as clouds and hills.
struct Boxes {
    AlignedBox all, middle;
    AlignedBox around_middle; ///< with a margin, and down to a ground not far below
};

/// world: after place_bodies.
Boxes boxes_of(const World& world);

/// True for each of the scene's lights that has shadows: all directional ones, and the first three point lights that rest
/// among the still things or within 16 of their longest sides: a map around a lamp that is farther away would be too coarse.
/// boxes: boxes_of the world.
std::vector<bool> lights_with_shadows(const Boxes& boxes, const SceneFile& scene);

/// Notes, once, that things that move have no shadows, where a scene's others have them.
void note_lacking_shadows(const SceneFile& scene, const World& world, std::vector<std::string>& notes);

} // namespace starbow
