#include "guard.h"
#include <algorithm>

namespace starbow {
namespace {

void guard_samplers(const Spot& root, GuardedGltf& out)
{
    guard_list(root, "samplers", out.json, [&](const Spot& sampler, Json& written) {
        auto one_of = [&](const char* key, std::vector<std::int64_t> legal) {
            if (!sampler.has(key))
                return;
            auto value = integer(sampler[key], 0, 65535);
            if (std::ranges::find(legal, value) == legal.end())
                sampler[key].fail("is " + std::to_string(value) + "; should be one of " + Json(legal).dump());
            written[key] = value;
        };
        one_of("magFilter", {9728, 9729});
        one_of("minFilter", {9728, 9729, 9984, 9985, 9986, 9987});
        one_of("wrapS", {33071, 33648, 10497});
        one_of("wrapT", {33071, 33648, 10497});
    });
}

void guard_textures(const Spot& root, GuardedGltf& out)
{
    guard_list(root, "textures", out.json, [&](const Spot& texture, Json& written) {
        if (texture.has("source"))
            written["source"] = index_into(texture["source"], "image", count_of(root, "images"));
        if (texture.has("sampler"))
            written["sampler"] = index_into(texture["sampler"], "sampler", count_of(root, "samplers"));
    });
}

/// The texture's index, its set of coordinates and KHR_texture_transform.
Json guard_texture_info(const Spot& info, const Spot& root)
{
    Json written = {{"index", index_into(object(info)["index"], "texture", count_of(root, "textures"))},
        {"texCoord", integer_or(info, "texCoord", 0, 0, 255)}};
    if (!info.has("extensions") || !object(info["extensions"]).has("KHR_texture_transform"))
        return written;
    Spot transform = info["extensions"]["KHR_texture_transform"];
    object(transform);
    Json kept = Json::object();
    for (const char* key : {"offset", "scale"})
        if (transform.has(key))
            kept[key] = numbers(transform[key], 2, -1e6, 1e6);
    if (transform.has("rotation"))
        kept["rotation"] = number(transform["rotation"], -1e6, 1e6);
    if (transform.has("texCoord"))
        written["texCoord"] = integer(transform["texCoord"], 0, 255);
    written["extensions"] = {{"KHR_texture_transform", kept}};
    return written;
}

void guard_pbr(const Spot& pbr, Json& written, const Spot& root, GuardedGltf& out)
{
    if (pbr.has("baseColorFactor"))
        written["baseColorFactor"] = numbers(pbr["baseColorFactor"], 4, 0, 1);
    if (pbr.has("baseColorTexture"))
        written["baseColorTexture"] = guard_texture_info(pbr["baseColorTexture"], root);
    if (pbr.has("metallicRoughnessTexture")) {
        guard_texture_info(pbr["metallicRoughnessTexture"], root);
        note_once(out.notes, "metallic-roughness textures: surfaces are matt");
    }
    if (pbr.has("roughnessFactor"))
        number(pbr["roughnessFactor"], 0, 1);
    if (pbr.has("metallicFactor") && number(pbr["metallicFactor"], 0, 1) > 0)
        note_once(out.notes, "metallic surfaces are drawn matt");
}

void guard_alpha(const Spot& material, Json& written, GuardedGltf& out)
{
    std::string mode = material.has("alphaMode") ? text(material["alphaMode"]) : "OPAQUE";
    if (mode == "BLEND")
        note_once(out.notes, "blended transparency: such surfaces are drawn opaque");
    else if (mode == "MASK")
        written["alphaMode"] = mode;
    else if (mode != "OPAQUE")
        material["alphaMode"].fail("is " + in_quotes(mode) + "; should be \"OPAQUE\", \"MASK\" or \"BLEND\"");
    if (material.has("alphaCutoff"))
        written["alphaCutoff"] = number(material["alphaCutoff"], 0, 1e6);
}

void guard_material(const Spot& material, Json& written, const Spot& root, GuardedGltf& out)
{
    if (material.has("name"))
        written["name"] = text(material["name"]);
    if (material.has("pbrMetallicRoughness"))
        guard_pbr(object(material["pbrMetallicRoughness"]), written["pbrMetallicRoughness"] = Json::object(), root, out);
    for (auto [key, note] :
        {std::pair{"normalTexture", "normal maps are not used"}, {"occlusionTexture", "occlusion maps are not used"}})
        if (material.has(key)) {
            guard_texture_info(material[key], root);
            note_once(out.notes, note);
        }
    if (material.has("emissiveTexture"))
        written["emissiveTexture"] = guard_texture_info(material["emissiveTexture"], root);
    if (material.has("emissiveFactor"))
        written["emissiveFactor"] = numbers(material["emissiveFactor"], 3, 0, 1);
    guard_alpha(material, written, out);
    if (material.has("doubleSided"))
        written["doubleSided"] = boolean(material["doubleSided"]);
    if (!material.has("extensions"))
        return;
    Spot extensions = material["extensions"];
    object(extensions);
    written["extensions"] = Json::object();
    if (extensions.has("KHR_materials_unlit"))
        written["extensions"]["KHR_materials_unlit"] = Json::object();
    if (extensions.has("KHR_materials_emissive_strength")) {
        Spot emissive = extensions["KHR_materials_emissive_strength"];
        double strength = object(emissive).has("emissiveStrength") ? number(emissive["emissiveStrength"], 0, 1e12) : 1;
        written["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength}};
    }
}

/// The images that give a surface its colour; only those are read.
std::vector<bool> coloured_images(const GuardedGltf& out, std::size_t count)
{
    std::vector<bool> used(count, false);
    auto use = [&](const Json& material, const char* key) {
        if (!material.contains(key))
            return;
        const Json& texture = out.json["textures"][material[key]["index"].get<std::size_t>()];
        if (texture.contains("source"))
            used[texture["source"].get<std::size_t>()] = true;
    };
    if (out.json.contains("materials"))
        for (const Json& material : out.json["materials"]) {
            use(material, "emissiveTexture");
            if (material.contains("pbrMetallicRoughness"))
                use(material["pbrMetallicRoughness"], "baseColorTexture");
        }
    return used;
}

void guard_images(GltfFile& file, const Spot& root, GuardedGltf& out)
{
    std::vector<bool> used = coloured_images(out, count_of(root, "images"));
    out.images.resize(used.size());
    for (std::size_t i = 0; i < used.size(); ++i) {
        Spot image = root["images"][i];
        object(image);
        if (image.has("bufferView") == image.has("uri"))
            image.fail("should have either a uri or a bufferView");
        if (image.has("bufferView")) {
            auto view_index = index_into(image["bufferView"], "buffer view", count_of(root, "bufferViews"));
            const Json& view = out.json["bufferViews"][std::size_t(view_index)];
            out.images[i] = std::span(out.buffers[view["buffer"].get<std::size_t>()])
                                .subspan(view["byteOffset"].get<std::size_t>(), view["byteLength"].get<std::size_t>());
        } else if (used[i]) {
            out.image_files.push_back(read_uri(file, image["uri"]));
            out.images[i] = out.image_files.back();
        }
    }
}

} // namespace

void guard_materials(GltfFile& file, const Spot& root, GuardedGltf& out)
{
    for (const char* key : {"materials", "textures", "images", "samplers"})
        if (count_of(root, key) > GltfLimits::looks)
            root[key].fail("has " + std::to_string(count_of(root, key)) + " entries; at most "
                + std::to_string(GltfLimits::looks) + " are allowed");
    guard_samplers(root, out);
    guard_textures(root, out);
    guard_list(root, "materials", out.json, [&](const Spot& material, Json& written) {
        guard_material(material, written, root, out);
        out.surfaces.push_back(guard_surface(material, written));
    });
    guard_images(file, root, out);
}

} // namespace starbow
