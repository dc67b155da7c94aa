#include "parts.h"
#include <algorithm>
#include <cstring>
#include <memory>
#include <stb/stb_image.h>

namespace starbow {
namespace {

/// Deflate packs at most 1032 to 1, so a 1-bit PNG holds at most 8256 pixels per byte; JPEG needs more than that.
constexpr std::size_t pixels_per_byte = 8300;

/// A progressive JPEG is decoded once for each scan; encoders write about ten.
constexpr std::ptrdiff_t jpeg_scans = 100;

std::string suspicion(std::span<const std::uint8_t> bytes, int& width, int& height)
{
    static constexpr std::uint8_t png[] = {0x89, 'P', 'N', 'G', 13, 10, 26, 10}, jpeg[] = {0xff, 0xd8, 0xff};
    auto starts
        = [&](auto& magic) { return bytes.size() > sizeof magic && std::memcmp(bytes.data(), magic, sizeof magic) == 0; };
    int channels = 0;
    if (!starts(png) && !starts(jpeg))
        return "is neither PNG nor JPEG; glTF allows those two";
    if (!stbi_info_from_memory(bytes.data(), int(bytes.size()), &width, &height, &channels))
        return "has a broken header; should be a PNG or JPEG";
    std::string size = "is " + std::to_string(width) + " x " + std::to_string(height) + " pixels; ";
    if (width < 1 || height < 1 || width > GltfLimits::texture_side || height > GltfLimits::texture_side
        || std::size_t(width) * std::size_t(height) > GltfLimits::texture_pixels)
        return size + "at most " + std::to_string(GltfLimits::texture_side) + " a side and "
            + std::to_string(GltfLimits::texture_pixels) + " in all are allowed";
    if (std::size_t(width) * std::size_t(height) / pixels_per_byte > bytes.size())
        return size + "its " + std::to_string(bytes.size()) + " bytes cannot hold so many";
    static constexpr std::uint8_t scan[] = {0xff, 0xda};
    std::ptrdiff_t scans = 0;
    if (starts(jpeg))
        for (auto at = bytes.begin(); (at = std::search(at, bytes.end(), scan, scan + 2)) != bytes.end(); ++at)
            ++scans;
    return scans > jpeg_scans
        ? "is a JPEG of " + std::to_string(scans) + " scans; " + std::to_string(jpeg_scans) + " are allowed"
        : "";
}

Wrap wrap(int gl)
{
    return gl == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE  ? Wrap::clamp
        : gl == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror
                                                      : Wrap::repeat;
}

Sampler sampler_of(const tinygltf::Model& model, int index)
{
    Sampler out;
    if (index < 0)
        return out;
    const auto& from = model.samplers[std::size_t(index)];
    out.u = wrap(from.wrapS);
    out.v = wrap(from.wrapT);
    out.magnify_linear = from.magFilter != TINYGLTF_TEXTURE_FILTER_NEAREST;
    switch (from.minFilter) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
        out.minify_linear = out.mipmaps = out.mip_linear = false;
        break;
    case TINYGLTF_TEXTURE_FILTER_LINEAR:
        out.mipmaps = out.mip_linear = false;
        break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
        out.minify_linear = out.mip_linear = false;
        break;
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
        out.mip_linear = false;
        break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
        out.minify_linear = false;
        break;
    }
    return out;
}

/// Textures by image and sampler. Equal pairs share a texture.
struct TextureShelf {
    WorldBuild& build;
    std::map<int, int> of_gltf;
    std::map<int, std::vector<int>> of_image;
    std::size_t bytes_left = GltfLimits::texture_bytes;

    int place(int gltf_texture)
    {
        auto [known, is_new] = of_gltf.try_emplace(gltf_texture, -1);
        if (is_new)
            known->second = add(gltf_texture);
        return known->second;
    }

    int add(int gltf_texture)
    {
        const auto& texture = build.model.textures[std::size_t(gltf_texture)];
        if (texture.source < 0) {
            note_once(build.world.notes, "textures without a PNG or JPEG image: their surfaces are plain");
            return -1;
        }
        Sampler sampler = sampler_of(build.model, texture.sampler);
        auto& textures = build.world.textures;
        auto& siblings = of_image[texture.source];
        for (int sibling : siblings)
            if (textures[std::size_t(sibling)].sampler == sampler)
                return sibling;
        std::string at = "/images/" + std::to_string(texture.source);
        // One image behind two samplers is rare enough to be decoded twice.
        Texture made = decode_image(build.file.name, at, build.file.images[std::size_t(texture.source)], bytes_left);
        bytes_left -= made.rgba.size();
        made.sampler = sampler;
        textures.push_back(std::move(made));
        siblings.push_back(int(textures.size()) - 1);
        return siblings.back();
    }
};

template <typename TextureInfo> UvSource uv_source(const TextureInfo& info)
{
    UvSource out;
    out.set = info.texCoord;
    auto found = info.extensions.find("KHR_texture_transform");
    if (found == info.extensions.end())
        return out;
    auto pair = [&](const char* key, glm::dvec2 absent) {
        if (!found->second.Has(key))
            return absent;
        const auto& value = found->second.Get(key);
        return glm::dvec2(value.Get(0).GetNumberAsDouble(), value.Get(1).GetNumberAsDouble());
    };
    double angle = found->second.Has("rotation") ? found->second.Get("rotation").GetNumberAsDouble() : 0;
    double c = std::cos(angle), s = std::sin(angle);
    // Counter-clockwise with v downwards, as in the extension's text, its example and the Khronos viewer. The GLSL in its
    // text has the other sense.
    out.rotate_scale = glm::dmat2(c, -s, s, c);
    glm::dvec2 scale = pair("scale", glm::dvec2(1));
    out.rotate_scale[0] *= scale.x;
    out.rotate_scale[1] *= scale.y;
    out.offset = pair("offset", glm::dvec2(0));
    return out;
}

} // namespace

Texture decode_image(
    const std::string& file, const std::string& place, std::span<const std::uint8_t> bytes, std::size_t bytes_left)
{
    int width = 0, height = 0, channels = 0;
    if (std::string problem = suspicion(bytes, width, height); !problem.empty())
        throw InputError(file, place, problem);
    std::size_t size = std::size_t(width) * std::size_t(height) * 4;
    if (size > bytes_left)
        throw InputError(file, place,
            "brings the textures above the " + std::to_string(GltfLimits::texture_bytes >> 20)
                + " MiB that are allowed, uncompressed; use fewer or smaller images");
    std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
        stbi_load_from_memory(bytes.data(), int(bytes.size()), &width, &height, &channels, 4), &stbi_image_free);
    if (!pixels)
        throw InputError(file, place, "cannot be decoded: " + std::string(stbi_failure_reason()));
    Texture out;
    out.size = {width, height};
    out.rgba.assign(pixels.get(), pixels.get() + size);
    return out;
}

void add_materials(WorldBuild& build)
{
    TextureShelf shelf{build};
    for (const auto& from : build.model.materials) {
        Material to = build.file.surfaces[build.world.materials.size()];
        to.name = from.name;
        const auto& pbr = from.pbrMetallicRoughness;
        for (int i = 0; i < 4; ++i)
            to.base_colour[i] = float(pbr.baseColorFactor[std::size_t(i)]);
        if (pbr.baseColorTexture.index >= 0)
            to.base_texture = shelf.place(pbr.baseColorTexture.index);
        to.double_sided = from.doubleSided;
        to.alpha_cutoff = from.alphaMode == "MASK" ? float(from.alphaCutoff) : 0;
        to.unlit = from.extensions.contains("KHR_materials_unlit");
        UvSource uv = uv_source(pbr.baseColorTexture);
        if (!to.unlit && !from.emissiveFactor.empty()) {
            auto strength = from.extensions.find("KHR_materials_emissive_strength");
            double factor
                = strength == from.extensions.end() ? 1 : strength->second.Get("emissiveStrength").GetNumberAsDouble();
            for (int i = 0; i < 3; ++i)
                to.emissive[i] = float(from.emissiveFactor[std::size_t(i)] * factor);
            if (from.emissiveTexture.index >= 0 && to.emissive != glm::vec3(0))
                to.emissive_texture = shelf.place(from.emissiveTexture.index);
        }
        if (to.emissive_texture >= 0) {
            UvSource emissive_uv = uv_source(from.emissiveTexture);
            if (to.base_texture < 0)
                uv = emissive_uv;
            else if (emissive_uv != uv)
                note_once(
                    build.world.notes, "emissive textures with coordinates of their own: they follow the base texture");
        }
        build.world.materials.push_back(std::move(to));
        build.uv.push_back(uv);
    }
    if (build.world.materials.empty())
        material_of(build, -1);
}

int material_of(WorldBuild& build, int gltf_material)
{
    if (gltf_material >= 0)
        return gltf_material;
    if (build.default_material < 0) {
        build.default_material = int(build.world.materials.size());
        build.world.materials.emplace_back().name = "default";
        build.uv.emplace_back();
    }
    return build.default_material;
}

} // namespace starbow
