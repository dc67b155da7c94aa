#pragma once
#include "json.h"
#include <filesystem>
#include <string_view>

namespace starbow {

using Bytes = std::vector<std::uint8_t>;

/// Limits far above any world that can be drawn, and far below an amount that would hurt the machine.
struct GltfLimits {
    static constexpr std::size_t file_bytes = std::size_t(1) << 30; ///< total of the file and all files that it names
    static constexpr std::size_t json_bytes = std::size_t(256) << 20;
    static constexpr std::size_t json_values = 2'000'000;
    static constexpr std::size_t json_depth = 100;
    static constexpr std::size_t looks = 65'536; ///< materials, and so textures, images and samplers
    static constexpr std::size_t vertices = 16'000'000; ///< of small files: mesh_limits
    static constexpr std::size_t indices = 48'000'000;
    static constexpr std::size_t instances = 1'000'000;
    static constexpr std::size_t motions = 10'000; ///< animated instances
    static constexpr std::size_t bones = 20'000; ///< of all deforming meshes together
    static constexpr std::size_t deforming_rows = std::size_t(8) << 20; ///< each device reads a buffer of 128 MiB
    static constexpr std::size_t keys = 4'000'000; ///< keys of all animations
    static constexpr int joints_deep = 64; ///< animated nodes, one below another
    static constexpr std::size_t zeros = 1'000'000; ///< elements of an accessor without data in the file
    static constexpr std::size_t sparse_bytes = std::size_t(256) << 20;
    static constexpr int texture_side = 16384;
    static constexpr std::size_t texture_pixels = std::size_t(128) << 20; ///< pixels of one image
};

/// A .gltf or .glb file in parts. Its JSON is known to be well formed; no content is checked yet.
struct GltfFile {
    std::string name; ///< the user's name of the file, for messages
    std::filesystem::path folder; ///< the file's own, symbolic links resolved
    Json json;
    bool is_glb = false, has_bin = false;
    Bytes bin;
    std::size_t bytes_left = GltfLimits::file_bytes;
};

/// Reads a .gltf or .glb file. The content decides between the two, not the file's name. Throws InputError.
GltfFile read_gltf_file(const std::filesystem::path& file);

/// The same, but of a GLB only its JSON is read, and `bin` stays empty.
GltfFile read_gltf_json(const std::filesystem::path& file);

/// True for the beginning of a GLB file, whose first four bytes say so.
inline bool begins_glb(std::string_view bytes) { return bytes.starts_with("glTF"); }

/// The bytes behind a URI: base64 `data:`, or a path that stays inside the file's folder. Throws InputError at `spot`.
Bytes read_uri(GltfFile& file, const JsonSpot& spot);

} // namespace starbow
