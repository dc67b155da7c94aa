#pragma once
#include "accessor.h"
#include "guard.h"
#include "runtime/world/world.h"
#include <array>
#include <map>
#include <span>
#include <tiny_gltf.h>

namespace starbow {

/// The source of a material's texture coordinates: a TEXCOORD set, then KHR_texture_transform as uv' = rotate_scale uv +
/// offset.
struct UvSource {
    int set = 0;
    glm::dmat2 rotate_scale{1};
    glm::dvec2 offset{0};
    bool operator==(const UvSource&) const = default;
};

/// A node's tracks, of World::tracks.
struct NodeTracks {
    int translations = -1, rotations = -1, scales = -1;
    bool move() const { return translations >= 0 || rotations >= 0 || scales >= 0; }
    std::vector<int> weights; ///< as Deformation::weights
    std::vector<double> greatest_weights; ///< of each target, without its sign
};

/// Bounds of a joint with all above it.
struct JointBounds {
    double scale = 1, place = 0; ///< its greatest stretch, and its origin's greatest distance
    int depth = 0;
};

/// The shape of a mesh in the file's own pose: its morph targets at their weights, then its skin's joints.
struct StillPose {
    std::vector<double> weights; ///< of the mesh's targets
    std::vector<glm::dmat4> joints; ///< world_from_mesh of each joint of its skin; empty: it has none
    bool deforms = false; ///< it has other shapes later
    int changing_targets = 0; ///< its first targets, whose weights change
};

/// The state of a world under construction.
struct WorldBuild {
    const GuardedGltf& file;
    const tinygltf::Model& model;
    World& world;
    std::vector<UvSource> uv; ///< one for each of the world's materials: of Vertex::uv
    std::vector<std::array<int, 2>> map_sets; ///< and the sets of VertexMaps::uvs
    int default_material = -1;
    std::map<std::pair<int, bool>, int>
        stroke_materials; ///< by the file's material, and whether it is lit: of lines and points
    std::size_t sparse_bytes_left = GltfLimits::sparse_bytes;
    std::size_t corners_left = file.limits.indices; ///< remaining limit of corners, including those of empty triangles
    std::vector<std::uint32_t> placed; ///< memory of add_primitive: a vertex's new index, reset after each
    std::map<std::uint32_t, std::uint32_t> turned; ///< reversed copies of primitives, for mirrored nodes

    std::vector<glm::dmat4> world_from_node; ///< in the file's pose; empty until a skin needs it

    std::map<int, NodeTracks> node_tracks; ///< by node; only of animated nodes
    std::vector<JointBounds> bounds; ///< one for each of the world's joints
    std::vector<bool> moving; ///< of each node: it or a node above it is animated
    std::map<int, Motion> node_motions; ///< of the nodes of the scene
    std::map<std::size_t, int> skins; ///< of the file, by index into World::deformations

    [[noreturn]] void fail(const std::string& place, const std::string& problem) const
    {
        throw InputError(file.name, place, problem);
    }
};

/// An accessor's elements; throws where open_accessor fails.
Elements open(WorldBuild& build, int accessor);

/// Decodes a PNG, JPEG or WebP and halves its sides so many times, as light or as numbers. Its whole size is in memory
/// while it is decoded.
Texture decode_image(const std::string& file, const std::string& place, std::span<const std::uint8_t> bytes,
    int halvings = 0, bool numbers = false);

/// Adds the materials, in the file's order, and the textures that they use.
void add_materials(WorldBuild& build);
int material_of(WorldBuild& build, int gltf_material);
/// The material of lines and points: matt, and without lighting unless they have normals (glTF 2.0, section 3.7.2.1).
int stroke_material_of(WorldBuild& build, int gltf_material, bool lit);

/// joint_from_mesh of each joint of a skin.
std::vector<glm::dmat4> inverse_bind_matrices(WorldBuild& build, const tinygltf::Skin& skin);

/// The file's own pose of a node's mesh.
StillPose still_pose(WorldBuild& build, int node);

/// The joints and weights of a primitive's vertices, four in each set; empty where its pose has no joints.
struct SkinSource {
    struct Set {
        Elements joints, weights;
    };
    std::vector<Set> sets;
    bool empty() const { return sets.empty(); }
};
SkinSource open_skin(WorldBuild& build, const tinygltf::Primitive& primitive, const StillPose& pose);

/// A joint of a vertex, and the part of its motion that the vertex takes.
struct Influence {
    int joint; ///< index into StillPose::joints
    double weight;
};
/// The joints of vertex `i`, whose weights' sum is 1: of all sets, the BONES_PER_VERTEX strongest. A vertex without weights
/// hangs on the joint that it names first, as it does in other programs: it stays with its mesh. Empty without a skin.
/// Throws InputError, at `place`, for a joint that the pose has not.
std::vector<Influence> influences_of(
    const WorldBuild& build, const StillPose& pose, const SkinSource& skin, std::uint32_t i, const std::string& place);

/// The transform that the joints give a vertex: their mean by its weights (glTF 2.0, section 3.7.3.3). skin_at: of vertex
/// `i`; throws as influences_of.
glm::dmat4 skin_of(const StillPose& pose, std::span<const Influence> influences);
glm::dmat4 skin_at(
    const WorldBuild& build, const StillPose& pose, const SkinSource& skin, std::uint32_t i, const std::string& place);

/// Adds one glTF primitive as vertices and a list of triangles: in the world's frame if the pose has joints, in the mesh's
/// without. Lines and points stay what they are. Returns false where nothing is left.
bool add_primitive(WorldBuild& build, const std::string& place, const tinygltf::Primitive& primitive, const StillPose& pose);

/// Gives the last primitive's vertices their VertexMaps. Where a normal map's tangents are computed, a vertex is doubled if
/// its triangles see the map from both sides. `source`: the glTF vertex of each of the primitive's vertices, also of
/// doubled ones.
void add_vertex_maps(WorldBuild& build, const std::string& place, const tinygltf::Primitive& primitive,
    const StillPose& pose, std::vector<std::uint32_t>& source);

/// Adds a copy with the corners in the reverse order; returns the copy's index.
std::uint32_t turned_primitive(WorldBuild& build, std::uint32_t primitive);

/// The root nodes of the scene; of a file without scenes, all roots.
std::vector<int> root_nodes(const tinygltf::Model& model);

glm::dmat4 local_transform(const tinygltf::Node& node);

/// An element of three numbers, below 1e18; throws, at `place`, for another.
glm::dvec3 element3(WorldBuild& build, const Elements& from, std::uint32_t i, const std::string& place);

/// Adds the rows of World::deforming of the last primitive, whose pose deforms.
void add_deforming(WorldBuild& build, const std::string& place, const tinygltf::Primitive& primitive, const StillPose& pose,
    const std::vector<std::uint32_t>& source);
/// Adds a deformation of a node's mesh and an instance for each of its primitives. motion: of the mesh's coordinates; a skin
/// has those of its joints, once all nodes are known.
void add_deforming_instances(
    WorldBuild& build, int node, const std::vector<std::uint32_t>& primitives, const std::optional<Motion>& motion);
/// Gives the deformations their bones.
void finish_deformations(WorldBuild& build);

/// Adds the animations' tracks, and assigns them to their nodes.
void add_tracks(WorldBuild& build);
/// Adds an animated or spinning node below a joint (above). Returns the new joint.
int add_joint(WorldBuild& build, int node, int above, const glm::dmat4& above_from_parent);

} // namespace starbow
