#pragma once
#include "file.h"
#include "runtime/world/world.h"
#include <functional>
#include <span>
#include <tiny_gltf.h>

namespace starbow {

constexpr double too_far = 1e30; ///< beyond it a float's square, and so a length, is infinite

/// A node's mesh in many places (EXT_mesh_gpu_instancing): accessors of equal count, -1 for those without one.
struct Instancing {
    int translations = -1, rotations = -1, scales = -1;
    std::size_t count = 0;
};

/// The most that a file's meshes may become: as much as any world needs, and more only as the file has bytes for it and
/// the machine has memory. A small file can't take much of either.
struct MeshLimits {
    std::size_t vertices = GltfLimits::vertices, indices = GltfLimits::indices;
};
/// bytes: of all buffers. memory: the machine's, in bytes.
MeshLimits mesh_limits(std::size_t bytes, std::size_t memory);

/// A glTF file in which every reference, range, type and path has been checked.
///
/// The types of `model` are tinygltf's; its parser stays unused. The parser is built for files that keep the rules: it opens
/// the files that URIs name, and it trusts indices. Here each member goes into `model` at the place that checks it, so the
/// file's JSON is parsed once. `model` holds no URI and no image.
struct GuardedGltf {
    std::string name;
    tinygltf::Model model;
    std::vector<Bytes> image_files;
    /// The stored bytes of each image, in the model's buffers or in image_files; empty where no colour needs them.
    std::vector<std::span<const std::uint8_t>> images;
    std::vector<Material> surfaces; ///< by the file's materials: the members from their extras, the rest not set
    std::vector<std::optional<Spin>> spins; ///< one for each node in the file
    std::vector<bool> hidden; ///< one for each node: it hides itself and all below it (KHR_node_visibility)
    std::vector<std::optional<Instancing>> instancing; ///< one for each node in the file
    MeshLimits limits;
    /// Numbers of those in the file; unpacked ones come after them.
    std::size_t stated_views = 0, stated_accessors = 0;
    std::vector<std::string> notes; ///< everything left out, each once
};

/// Reads and checks a file. Throws InputError.
GuardedGltf guard_gltf(const std::filesystem::path& file);

/// The parts of the check. Each takes the file's document and writes the accepted parts into `out.model`.
void guard_buffers(GltfFile& file, const JsonSpot& root, GuardedGltf& out);
void guard_accessors(const JsonSpot& root, GuardedGltf& out);
void guard_materials(GltfFile& file, const JsonSpot& root, GuardedGltf& out);
void guard_meshes(const JsonSpot& root, GuardedGltf& out);
void guard_nodes(const JsonSpot& root, GuardedGltf& out);
void guard_skins(const JsonSpot& root, GuardedGltf& out); ///< after accessors
void guard_animations(const JsonSpot& root, GuardedGltf& out); ///< after nodes and accessors

/// Calls `read` with the member "starbow" of an object's extras, an object or a text with one; not called without it.
void read_extras(const JsonSpot& owner, const std::function<void(const JsonSpot&)>& read);

/// The material that the extras' member "starbow" describes; `written` has the material's accepted members.
Material guard_surface(const JsonSpot& material, const tinygltf::Material& written);

/// A mesh's or a node's weights of its morph targets; empty without any.
std::vector<double> weights_of(const JsonSpot& owner);

/// glTF's name of an accessor's type, for messages.
std::string type_name(const tinygltf::Accessor& accessor);

void note_once(std::vector<std::string>& notes, const std::string& note);

/// The length of the document's list `key`; 0 without one.
std::size_t count_of(const JsonSpot& root, const char* key);

/// Calls `each(spot, written)` for every object of the document's list `key`, and then adds `written` to `out`.
template <typename T, typename Each> void guard_list(const JsonSpot& root, const char* key, std::vector<T>& out, Each each)
{
    if (!root.has(key))
        return;
    JsonSpot all = root[key];
    list(all, 0);
    for (std::size_t i = 0; i < all.size(); ++i) {
        T written;
        each(object(all[i]), written);
        out.push_back(std::move(written));
    }
}

} // namespace starbow
