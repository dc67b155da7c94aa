#pragma once
#include "config/model/flying.h"
#include "config/model/scene_file.h"
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace starbow {

struct World;

/// A lamp of the file (KHR_lights_punctual).
struct OutlineLamp {
    bool directional = false;
    glm::dvec3 colour{1}; ///< Rec. 709 linear
    double intensity = 1; ///< lux of a directional one, candela of the others
    std::optional<LightCone> cone{}; ///< of a "spot", in its own axes
    glm::dmat4 world_from_lamp{1}; ///< it stands at the origin and shines along its -z
};

/// A glTF file as seen from afar. Lengths are the file's.
struct Outline {
    std::vector<AlignedBox> things; ///< one around each mesh of each node of the file's scene, animated ones at their time 0
    std::optional<glm::dmat4> camera; ///< world_from_camera of the scene's first camera, which looks along its -z
    std::vector<OutlineLamp> lamps;
    std::shared_ptr<const World> world; ///< where it had to be read as a whole; else null
    bool moves = false; ///< it has animations, or nodes that spin
    bool surfaces = false; ///< it has triangles, not points and lines alone
};

/// The bounding box of a world's things without its backdrops, such as a ground to the horizon or a sphere painted as a sky.
/// A backdrop is more than three times as far across as all smaller things together.
struct Middle {
    AlignedBox box{glm::dvec3(-1), glm::dvec3(1)};
    double floor = -1; ///< the height of the ground below it
    double across() const { return glm::distance(box.low, box.high); }
};
Middle middle_of(std::vector<AlignedBox> things);

/// Reads the outline from the file's JSON alone, by the bounds that it states of its positions: buffers and pictures stay
/// closed, so that a file of a gigabyte takes as long as its JSON; but for skins and for meshes in many
/// places (EXT_mesh_gpu_instancing), whose bounds are not stated.
/// Throws InputError.
Outline read_outline(const std::filesystem::path& file);

} // namespace starbow
