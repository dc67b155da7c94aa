#pragma once
#include "file.h"
#include "runtime/world/world.h"
#include <functional>
#include <span>

namespace starbow {

/// Component types of accessors (glTF 2.0, 5.1.3).
constexpr int byte_type = 5120, ubyte_type = 5121, short_type = 5122, ushort_type = 5123, uint_type = 5125,
              float_type = 5126;

constexpr double too_far = 1e30; ///< beyond it a float's square, and so a length, is infinite

/// A glTF file in which every reference, range, type and path has been checked.
///
/// tinygltf expects files that keep the rules: it opens any file that a URI names, and trusts indices. It therefore never
/// sees the file itself. It sees `json`, written anew from the checked members and without URIs; the bytes stay here.
struct GuardedGltf {
    std::string name;
    Json json;
    std::vector<Bytes> buffers; ///< one for each in the file
    std::vector<Bytes> image_files;
    std::vector<std::span<const std::uint8_t>> images; ///< as stored, in the two above; empty where no colour needs it
    std::vector<Material> surfaces; ///< by the file's materials: the members from their extras, the rest not set
    std::vector<std::optional<Spin>> spins; ///< one for each node in the file
    std::vector<std::string> notes; ///< everything left out, each once
};

/// Reads and checks a file. Throws InputError.
GuardedGltf guard_gltf(const std::filesystem::path& file);

/// The parts of the check. Each takes the file's document and writes the accepted parts into `out.json`.
void guard_buffers(GltfFile& file, const Spot& root, GuardedGltf& out);
void guard_accessors(const Spot& root, GuardedGltf& out);
void guard_materials(GltfFile& file, const Spot& root, GuardedGltf& out);
void guard_meshes(const Spot& root, GuardedGltf& out);
void guard_nodes(const Spot& root, GuardedGltf& out);
void guard_animations(const Spot& root, GuardedGltf& out); ///< after nodes and accessors

/// Calls `read` with the member "starbow" of an object's extras, an object or a text with one; not called without it.
void read_extras(const Spot& owner, const std::function<void(const Spot&)>& read);

/// The material that the extras' member "starbow" describes; `written` has the material's accepted members.
Material guard_surface(const Spot& material, const Json& written);

void note_once(std::vector<std::string>& notes, const std::string& note);

/// The length of the document's list `key`; 0 without one.
std::size_t count_of(const Spot& root, const char* key);

/// Calls `each(spot, written)` for every object of the document's list `key`; `written` ends up in the list of `out`.
template <typename Each> void guard_list(const Spot& root, const char* key, Json& out, Each each)
{
    if (!root.has(key))
        return;
    Spot all = root[key];
    list(all, 0);
    Json written = Json::array();
    for (std::size_t i = 0; i < all.size(); ++i) {
        Json one = Json::object();
        each(object(all[i]), one);
        written.push_back(std::move(one));
    }
    out[key] = std::move(written);
}

} // namespace starbow
