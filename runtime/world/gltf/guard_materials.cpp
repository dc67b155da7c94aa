#include "guard.h"
#include <algorithm>

namespace starbow {
namespace {

using tinygltf::Value;

void guard_samplers(const JsonSpot& root, GuardedGltf& out)
{
    guard_list(root, "samplers", out.model.samplers, [&](const JsonSpot& sampler, tinygltf::Sampler& written) {
        auto one_of = [&](const char* key, std::vector<std::int64_t> legal, int& to) {
            if (!sampler.has(key))
                return;
            auto value = integer(sampler[key], 0, 65535);
            if (std::ranges::find(legal, value) == legal.end())
                sampler[key].fail("is " + std::to_string(value) + "; should be one of " + Json(legal).dump());
            to = int(value);
        };
        one_of("magFilter", {9728, 9729}, written.magFilter);
        one_of("minFilter", {9728, 9729, 9984, 9985, 9986, 9987}, written.minFilter);
        one_of("wrapS", {33071, 33648, 10497}, written.wrapS);
        one_of("wrapT", {33071, 33648, 10497}, written.wrapT);
    });
}

void guard_textures(const JsonSpot& root, GuardedGltf& out)
{
    guard_list(root, "textures", out.model.textures, [&](const JsonSpot& texture, tinygltf::Texture& written) {
        if (texture.has("source"))
            written.source = int(index_into(texture["source"], "image", count_of(root, "images")));
        if (texture.has("extensions") && object(texture["extensions"]).has("EXT_texture_webp")) {
            const JsonSpot webp = object(texture["extensions"]["EXT_texture_webp"]);
            if (webp.has("source"))
                written.source = int(index_into(webp["source"], "image", count_of(root, "images")));
        }
        if (texture.has("sampler"))
            written.sampler = int(index_into(texture["sampler"], "sampler", count_of(root, "samplers")));
    });
}

/// The texture's index, its set of coordinates and KHR_texture_transform.
tinygltf::TextureInfo guard_texture_info(const JsonSpot& info, const JsonSpot& root)
{
    tinygltf::TextureInfo written;
    written.index = int(index_into(object(info)["index"], "texture", count_of(root, "textures")));
    written.texCoord = int(integer_or(info, "texCoord", 0, 0, 255));
    if (!info.has("extensions") || !object(info["extensions"]).has("KHR_texture_transform"))
        return written;
    JsonSpot transform = info["extensions"]["KHR_texture_transform"];
    object(transform);
    Value::Object kept;
    for (const char* key : {"offset", "scale"})
        if (transform.has(key)) {
            const auto pair = numbers(transform[key], 2, -1e6, 1e6);
            kept[key] = Value(Value::Array{Value(pair[0]), Value(pair[1])});
        }
    if (transform.has("rotation"))
        kept["rotation"] = Value(number(transform["rotation"], -1e6, 1e6));
    if (transform.has("texCoord"))
        written.texCoord = int(integer(transform["texCoord"], 0, 255));
    written.extensions["KHR_texture_transform"] = Value(std::move(kept));
    return written;
}

void guard_pbr(const JsonSpot& pbr, tinygltf::PbrMetallicRoughness& written, const JsonSpot& root)
{
    if (pbr.has("baseColorFactor"))
        written.baseColorFactor = numbers(pbr["baseColorFactor"], 4, 0, 1);
    if (pbr.has("baseColorTexture"))
        written.baseColorTexture = guard_texture_info(pbr["baseColorTexture"], root);
    if (pbr.has("metallicRoughnessTexture"))
        written.metallicRoughnessTexture = guard_texture_info(pbr["metallicRoughnessTexture"], root);
    if (pbr.has("roughnessFactor"))
        written.roughnessFactor = number(pbr["roughnessFactor"], 0, 1);
    if (pbr.has("metallicFactor"))
        written.metallicFactor = number(pbr["metallicFactor"], 0, 1);
}

/// A texture's info as another kind's, whose members begin alike.
template <typename Info> Info as(const tinygltf::TextureInfo& from)
{
    Info written;
    written.index = from.index, written.texCoord = from.texCoord, written.extensions = from.extensions;
    return written;
}

void guard_alpha(const JsonSpot& material, tinygltf::Material& written)
{
    std::string mode = material.has("alphaMode") ? text(material["alphaMode"]) : "OPAQUE";
    if (mode == "MASK" || mode == "BLEND")
        written.alphaMode = mode;
    else if (mode != "OPAQUE")
        material["alphaMode"].fail("is " + in_quotes(mode) + "; should be \"OPAQUE\", \"MASK\" or \"BLEND\"");
    if (material.has("alphaCutoff"))
        written.alphaCutoff = number(material["alphaCutoff"], 0, 1e6);
}

void guard_material(const JsonSpot& material, tinygltf::Material& written, const JsonSpot& root)
{
    if (material.has("name"))
        written.name = text(material["name"]);
    if (material.has("pbrMetallicRoughness"))
        guard_pbr(object(material["pbrMetallicRoughness"]), written.pbrMetallicRoughness, root);
    if (material.has("normalTexture")) {
        const JsonSpot spot = material["normalTexture"];
        written.normalTexture = as<tinygltf::NormalTextureInfo>(guard_texture_info(spot, root));
        written.normalTexture.scale = spot.has("scale") ? number(spot["scale"], -1e6, 1e6) : 1;
    }
    if (material.has("occlusionTexture")) {
        const JsonSpot spot = material["occlusionTexture"];
        written.occlusionTexture = as<tinygltf::OcclusionTextureInfo>(guard_texture_info(spot, root));
        written.occlusionTexture.strength = spot.has("strength") ? number(spot["strength"], 0, 1) : 1;
    }
    if (material.has("emissiveTexture"))
        written.emissiveTexture = guard_texture_info(material["emissiveTexture"], root);
    if (material.has("emissiveFactor"))
        written.emissiveFactor = numbers(material["emissiveFactor"], 3, 0, 1);
    guard_alpha(material, written);
    if (material.has("doubleSided"))
        written.doubleSided = boolean(material["doubleSided"]);
    if (!material.has("extensions"))
        return;
    JsonSpot extensions = material["extensions"];
    object(extensions);
    if (extensions.has("KHR_materials_unlit"))
        written.extensions["KHR_materials_unlit"] = Value(Value::Object());
    if (extensions.has("KHR_materials_ior")) {
        const JsonSpot ior = object(extensions["KHR_materials_ior"]);
        // 0 means a reflectance of 1, which suits other models.
        const double index = ior.has("ior") ? number(ior["ior"], 0, 1e6) : 1.5;
        written.extensions["KHR_materials_ior"] = Value(Value::Object{{"ior", Value(index)}});
    }
    if (extensions.has("KHR_materials_emissive_strength")) {
        JsonSpot emissive = extensions["KHR_materials_emissive_strength"];
        double strength = object(emissive).has("emissiveStrength") ? number(emissive["emissiveStrength"], 0, 1e12) : 1;
        written.extensions["KHR_materials_emissive_strength"] = Value(Value::Object{{"emissiveStrength", Value(strength)}});
    }
}

/// The images that surfaces use; only those are read.
std::vector<bool> used_images(const GuardedGltf& out, std::size_t count)
{
    std::vector<bool> used(count, false);
    auto use = [&](const auto& info) {
        if (info.index < 0)
            return;
        const int source = out.model.textures[std::size_t(info.index)].source;
        if (source >= 0)
            used[std::size_t(source)] = true;
    };
    for (const tinygltf::Material& material : out.model.materials) {
        use(material.emissiveTexture);
        use(material.normalTexture);
        use(material.occlusionTexture);
        use(material.pbrMetallicRoughness.baseColorTexture);
        use(material.pbrMetallicRoughness.metallicRoughnessTexture);
    }
    return used;
}

void guard_images(GltfFile& file, const JsonSpot& root, GuardedGltf& out)
{
    std::vector<bool> used = used_images(out, count_of(root, "images"));
    out.images.resize(used.size());
    for (std::size_t i = 0; i < used.size(); ++i) {
        JsonSpot image = root["images"][i];
        object(image);
        if (image.has("bufferView") == image.has("uri"))
            image.fail("should have either a uri or a bufferView");
        if (image.has("bufferView")) {
            auto view_index = index_into(image["bufferView"], "buffer view", count_of(root, "bufferViews"));
            const tinygltf::BufferView& view = out.model.bufferViews[std::size_t(view_index)];
            out.images[i]
                = std::span(out.model.buffers[std::size_t(view.buffer)].data).subspan(view.byteOffset, view.byteLength);
        } else if (used[i]) {
            out.image_files.push_back(read_uri(file, image["uri"]));
            out.images[i] = out.image_files.back();
        }
    }
}

} // namespace

void guard_materials(GltfFile& file, const JsonSpot& root, GuardedGltf& out)
{
    for (const char* key : {"materials", "textures", "images", "samplers"})
        if (count_of(root, key) > GltfLimits::looks)
            root[key].fail("has " + std::to_string(count_of(root, key)) + " entries; at most "
                + std::to_string(GltfLimits::looks) + " are allowed");
    guard_samplers(root, out);
    guard_textures(root, out);
    guard_list(root, "materials", out.model.materials, [&](const JsonSpot& material, tinygltf::Material& written) {
        guard_material(material, written, root);
        out.surfaces.push_back(guard_surface(material, written));
    });
    guard_images(file, root, out);
}

} // namespace starbow
