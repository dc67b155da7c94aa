#pragma once
#include "config/model/scene_file.h"
#include "world.h"

namespace starbow {

/// The fastest point of all animations. Jumps do not count as speed.
struct FastestMotion {
    double per_s; ///< scene units in a second of its own time
    int node;
    double own_s; ///< its own time there
};
/// nullopt: nothing moves by itself.
std::optional<FastestMotion> fastest_motion(const World& world);

/// Throws InputError where any point is faster than most_own_speed.
void check_speeds(const World& world, const SceneFile& scene);

} // namespace starbow
