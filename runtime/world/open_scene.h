#pragma once
#include "config/model/scene_file.h"

namespace starbow {

/// Opens a scene file; or a glTF file without one (.glb or .gltf, by its content or its name), as scene_around does. Throws
/// InputError.
SceneFile open_scene(const std::filesystem::path& file);

/// The place from which all of a box is in view in a window of 60 degrees or a wider one, and the way to look. away: from
/// the box towards that place, not vertical. It is above the floor's height.
Shot overview(const AlignedBox& box, double floor, const glm::dvec3& away);

/// A scene for a glTF file that has none: a unit is a metre, light crosses the world in some ten seconds, and a sun, a
/// sky and ambient light show it. The start is at the file's first camera if
/// that shows the world well, or where the whole world fills the view; points and lines alone stand before the dark. A note
/// says so. Throws InputError.
SceneFile scene_around(const std::filesystem::path& gltf);

/// The text of a scene file for such a scene, to be written into `folder`. It names the glTF from there.
std::string scene_text(const SceneFile& scene, const std::filesystem::path& folder);

} // namespace starbow
