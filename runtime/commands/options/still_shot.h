#pragma once
#include "config/json/error.h"
#include "config/model/scene_file.h"
#include "config/model/shipped.h"
#include "config/model/shot.h"
#include "runtime/world/open_scene.h"
#include <string>

namespace starbow {

/// The shot of a still picture, its scene's file, and the shot's own file, which is the scene's where only a scene is named.
struct StillShot {
    Shot shot;
    std::filesystem::path scene, file;
};

/// By the options --shot and --scene: a shot in its own scene or in the named one, or the start of the named scene. Throws
/// InputError, also where neither is given.
inline StillShot still_shot(const std::string& shot, const std::string& scene)
{
    if (shot.empty() && scene.empty())
        throw InputError("None of --shot, --scene, --replay and --tour is given; one of them is right");
    StillShot still;
    if (!scene.empty())
        still.scene = still.file = shipped_file("scenes", scene);
    if (shot.empty()) {
        still.shot = open_scene(still.scene).start;
        return still;
    }
    still.file = shipped_file("shots", shot);
    still.shot = load_shot(still.file);
    if (scene.empty())
        still.scene = scene_of(still.shot, still.file);
    return still;
}

} // namespace starbow
