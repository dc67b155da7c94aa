#include "guard.h"
#include "compressed.h"
#include <algorithm>
#include <array>
#include <unistd.h>
#include <utility>

namespace starbow {
namespace {

constexpr std::array supported_extensions = {"KHR_materials_unlit", "KHR_materials_emissive_strength", "KHR_materials_ior",
    "KHR_texture_transform", "KHR_mesh_quantization", "EXT_meshopt_compression", "KHR_draco_mesh_compression",
    "EXT_texture_webp", "EXT_mesh_gpu_instancing", "KHR_node_visibility"};

/// Extensions without which a world is drawn nearly as it is meant, each with its stand-in.
constexpr std::array<std::pair<const char*, const char*>, 9> stand_ins{
    {{"KHR_materials_clearcoat", "clear coats: the surface below is drawn"},
        {"KHR_materials_transmission", "transmission: such surfaces are drawn opaque"},
        {"KHR_materials_volume", "volumes: such surfaces are drawn opaque"},
        {"KHR_materials_specular", "specular factors: highlights are drawn whole and white"},
        {"KHR_materials_sheen", "sheen: the surface below is drawn"},
        {"KHR_materials_iridescence", "iridescence: highlights have the lamps' colours"},
        {"KHR_materials_anisotropy", "anisotropy: highlights are as wide in all directions"},
        {"KHR_materials_variants", "variants: the first look is drawn"},
        {"KHR_lights_punctual", "lamps of the file (KHR_lights_punctual) shine where no scene file names its own lights"}}};

void guard_asset(const JsonSpot& root)
{
    JsonSpot asset = root["asset"];
    JsonSpot version = object(asset)["version"];
    if (!text(version).starts_with("2."))
        version.fail("is " + in_quotes(text(version)) + "; should be \"2.0\"");
    if (asset.has("minVersion") && text(asset["minVersion"]) != "2.0")
        asset["minVersion"].fail("is " + in_quotes(text(asset["minVersion"])) + "; 2.0 is supported");
}

void guard_extensions(const JsonSpot& root, GuardedGltf& out)
{
    auto each = [&](const char* key, auto unsupported) {
        if (!root.has(key))
            return;
        JsonSpot all = root[key];
        list(all, 0);
        for (std::size_t i = 0; i < all.size(); ++i)
            if (std::string name = text(all[i]); std::ranges::find(supported_extensions, name) == supported_extensions.end())
                unsupported(all[i], in_quotes(name));
    };
    const auto stand_in = [](const JsonSpot& spot) {
        const auto one = std::ranges::find(stand_ins, text(spot), [](const auto& each) { return std::string(each.first); });
        return one == stand_ins.end() ? nullptr : one->second;
    };
    each("extensionsRequired", [&](const JsonSpot& spot, const std::string& name) {
        if (text(spot) == "KHR_texture_basisu")
            spot.fail(
                "requires KTX2 textures (KHR_texture_basisu), which are not read; PNG, JPEG or WebP textures are right");
        if (!stand_in(spot))
            spot.fail("requires the extension " + name + ", which is not supported; export the world without it");
    });
    each("extensionsUsed", [&](const JsonSpot& spot, const std::string& name) {
        if (out.notes.size() < 100)
            note_once(out.notes, stand_in(spot) ? stand_in(spot) : "extension " + name + " is not supported");
    });
}

/// The extension EXT_meshopt_compression of a buffer or a view; nullopt without it.
std::optional<JsonSpot> meshopt_of(const JsonSpot& spot)
{
    if (!spot.has("extensions") || !object(spot["extensions"]).has("EXT_meshopt_compression"))
        return {};
    return object(spot["extensions"]["EXT_meshopt_compression"]);
}

} // namespace

void note_once(std::vector<std::string>& notes, const std::string& note)
{
    if (std::ranges::find(notes, note) == notes.end())
        notes.push_back(note);
}

MeshLimits mesh_limits(std::size_t bytes, std::size_t memory)
{
    // A packed vertex takes four bytes or more, a packed corner half a byte. In memory a corner is there for each level of
    // detail, and once more while they are made.
    constexpr std::size_t vertex_bytes = 2 * sizeof(Vertex), index_bytes = 4 * sizeof(std::uint32_t);
    const std::size_t half = memory / 2;
    MeshLimits limits;
    limits.vertices = std::max(limits.vertices, std::min(bytes / 4, half / 2 / vertex_bytes));
    limits.indices = std::max(limits.indices, std::min(2 * bytes, half / 2 / index_bytes));
    return limits;
}

std::size_t count_of(const JsonSpot& root, const char* key) { return root.has(key) ? list(root[key], 0).size() : 0; }

void guard_buffers(GltfFile& file, const JsonSpot& root, GuardedGltf& out)
{
    constexpr auto most = std::int64_t(GltfLimits::file_bytes);
    auto& buffers = out.model.buffers;
    guard_list(root, "buffers", buffers, [&](const JsonSpot& buffer, tinygltf::Buffer& written) {
        auto length = std::size_t(integer(buffer["byteLength"], 1, most));
        Bytes& bytes = written.data;
        if (const std::optional<JsonSpot> packing = meshopt_of(buffer);
            packing && packing->has("fallback") && boolean((*packing)["fallback"]))
            return; // every view of it is packed elsewhere
        if (buffer.has("uri"))
            bytes = read_uri(file, buffer["uri"]);
        else if (file.has_bin && buffers.empty())
            bytes = std::move(file.bin);
        else
            buffer.fail("has no uri; only the first buffer of a GLB with a BIN chunk can do without");
        if (bytes.size() < length)
            buffer["byteLength"].fail("is " + std::to_string(length) + "; the buffer has " + std::to_string(bytes.size()));
        bytes.resize(length);
    });
    const std::size_t stated = buffers.size();
    /// The part of a buffer that an object with buffer, byteOffset and byteLength names.
    const auto part_of = [&](const JsonSpot& view, tinygltf::BufferView& written) {
        auto buffer = index_into(view["buffer"], "buffer", stated);
        auto offset = integer_or(view, "byteOffset", 0, 0, most);
        auto length = integer(view["byteLength"], 1, most);
        auto held = std::int64_t(buffers[std::size_t(buffer)].data.size());
        if (offset + length > held)
            view.fail("ends at byte " + std::to_string(offset + length) + "; its buffer has " + std::to_string(held));
        written.buffer = int(buffer);
        written.byteOffset = std::size_t(offset);
        written.byteLength = std::size_t(length);
    };
    guard_list(root, "bufferViews", out.model.bufferViews, [&](const JsonSpot& view, tinygltf::BufferView& written) {
        if (const std::optional<JsonSpot> packed = meshopt_of(view)) {
            part_of(object(*packed), written);
            const Bytes& from = buffers[std::size_t(written.buffer)].data;
            Bytes unpacked = unpack_meshopt(*packed, std::span(from).subspan(written.byteOffset, written.byteLength));
            if (unpacked.size() > file.bytes_left)
                packed->fail("unpacks to more bytes than a file may have");
            file.bytes_left -= unpacked.size();
            written.buffer = int(buffers.size());
            written.byteOffset = 0;
            written.byteLength = unpacked.size();
            buffers.emplace_back().data = std::move(unpacked);
        } else
            part_of(view, written);
        if (view.has("byteStride")) {
            auto stride = integer(view["byteStride"], 4, 252);
            if (stride % 4 != 0)
                view["byteStride"].fail("is " + std::to_string(stride) + "; should be a multiple of 4");
            written.byteStride = std::size_t(stride);
        }
    });
    out.stated_views = out.model.bufferViews.size();
    std::size_t bytes = 0;
    for (const tinygltf::Buffer& buffer : buffers)
        bytes += buffer.data.size();
    out.limits = mesh_limits(bytes, std::size_t(sysconf(_SC_PHYS_PAGES)) * std::size_t(sysconf(_SC_PAGESIZE)));
}

GuardedGltf guard_gltf(const std::filesystem::path& path)
{
    GltfFile file = read_gltf_file(path);
    GuardedGltf out;
    out.name = file.name;
    JsonSpot root{file.json, "", out.name};
    object(root);
    guard_asset(root);
    guard_extensions(root, out);
    guard_buffers(file, root, out);
    guard_accessors(root, out);
    guard_materials(file, root, out);
    guard_meshes(root, out);
    guard_nodes(root, out);
    guard_skins(root, out);
    guard_animations(root, out);
    return out;
}

} // namespace starbow
