#include "parts.h"
#include "runtime/world/shrink.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <stb/stb_image.h>
#include <webp/decode.h>

namespace starbow {
namespace {

/// Deflate packs at most 1032 to 1, so a 1-bit PNG holds at most 8256 pixels per byte; JPEG needs more than that.
constexpr std::size_t pixels_per_byte = 8300;

/// A progressive JPEG is decoded once for each scan; encoders write about ten.
constexpr std::ptrdiff_t jpeg_scans = 100;

bool is_webp(std::span<const std::uint8_t> bytes)
{
    return bytes.size() > 12 && std::memcmp(bytes.data(), "RIFF", 4) == 0 && std::memcmp(bytes.data() + 8, "WEBP", 4) == 0;
}

std::uint32_t little(std::span<const std::uint8_t> bytes, std::size_t at, int count)
{
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i)
        value |= std::uint32_t(bytes[at + std::size_t(i)]) << 8 * i;
    return value;
}

/// The first frame of an animated WebP, a WebP of its own, and its place on the animation's canvas.
struct FirstFrame {
    std::vector<std::uint8_t> webp;
    glm::ivec2 canvas, place;
};

/// The first frame by the container's specification (RIFF chunks VP8X, ANIM and ANMF); nullopt for a WebP of one picture.
std::optional<FirstFrame> first_frame(std::span<const std::uint8_t> bytes)
{
    constexpr std::size_t header = 12, chunk_header = 8, extended = 10, frame_header = 16;
    const auto is = [&](std::size_t at, const char* name) { return std::memcmp(bytes.data() + at, name, 4) == 0; };
    if (bytes.size() < header + chunk_header + extended || !is(header, "VP8X") || !(bytes[header + chunk_header] & 2))
        return {};
    FirstFrame frame{{}, glm::ivec2(little(bytes, 24, 3), little(bytes, 27, 3)) + 1, {}};
    for (std::size_t at = header; at + chunk_header <= bytes.size();) {
        const std::size_t size = little(bytes, at + 4, 4), data = at + chunk_header;
        if (size > bytes.size() - data)
            return {};
        if (is(at, "ANMF") && size >= frame_header) {
            frame.place = 2 * glm::ivec2(little(bytes, data, 3), little(bytes, data + 3, 3));
            const std::span<const std::uint8_t> own = bytes.subspan(data + frame_header, size - frame_header);
            const bool opacity = own.size() > 4 && std::memcmp(own.data(), "ALPH", 4) == 0;
            const auto put = [&](const char* name, std::uint32_t value) {
                frame.webp.insert(frame.webp.end(), name, name + 4);
                for (int i = 0; i < 4; ++i)
                    frame.webp.push_back(std::uint8_t(value >> 8 * i));
            };
            put("RIFF", std::uint32_t(4 + (opacity ? chunk_header + extended : 0) + own.size()));
            frame.webp.insert(frame.webp.end(), {'W', 'E', 'B', 'P'});
            if (opacity) { // it needs the header that announces it
                put("VP8X", extended);
                frame.webp.insert(frame.webp.end(), {0x10, 0, 0, 0});
                frame.webp.insert(
                    frame.webp.end(), bytes.begin() + std::ptrdiff_t(data) + 6, bytes.begin() + std::ptrdiff_t(data) + 12);
            }
            frame.webp.insert(frame.webp.end(), own.begin(), own.end());
            return frame;
        }
        at = data + size + size % 2;
    }
    return {};
}

/// The picture of an animation's first frame on its canvas, clear around it; null for a frame that cannot be decoded.
std::uint8_t* decode_first(const FirstFrame& frame)
{
    glm::ivec2 size(0);
    // A frame states a size of its own: one that is larger than its canvas is not decoded.
    if (!WebPGetInfo(frame.webp.data(), frame.webp.size(), &size.x, &size.y)
        || glm::any(glm::greaterThan(frame.place + size, frame.canvas)))
        return nullptr;
    std::unique_ptr<std::uint8_t, void (*)(void*)> own(
        WebPDecodeRGBA(frame.webp.data(), frame.webp.size(), &size.x, &size.y), WebPFree);
    if (!own)
        return nullptr;
    const std::size_t row = 4 * std::size_t(frame.canvas.x);
    auto* all = static_cast<std::uint8_t*>(WebPMalloc(row * std::size_t(frame.canvas.y)));
    if (!all)
        return nullptr;
    std::memset(all, 0, row * std::size_t(frame.canvas.y));
    for (int y = 0; y < size.y; ++y)
        std::memcpy(all + row * std::size_t(frame.place.y + y) + 4 * std::size_t(frame.place.x),
            own.get() + 4 * std::size_t(size.x) * std::size_t(y), 4 * std::size_t(size.x));
    return all;
}

std::string suspicion(std::span<const std::uint8_t> bytes, int& width, int& height)
{
    static constexpr std::uint8_t png[] = {0x89, 'P', 'N', 'G', 13, 10, 26, 10}, jpeg[] = {0xff, 0xd8, 0xff};
    auto starts
        = [&](auto& magic) { return bytes.size() > sizeof magic && std::memcmp(bytes.data(), magic, sizeof magic) == 0; };
    int channels = 0;
    if (is_webp(bytes)) {
        if (!WebPGetInfo(bytes.data(), bytes.size(), &width, &height))
            return "has a broken header; should be a WebP";
    } else if (!starts(png) && !starts(jpeg))
        return "is neither PNG, JPEG nor WebP; one of those is right";
    else if (!stbi_info_from_memory(bytes.data(), int(bytes.size()), &width, &height, &channels)) {
        // The library also fails at sizes beyond its own limits; a PNG's header says what they are.
        const auto word = [&](std::size_t at) {
            return std::int64_t(bytes[at]) << 24 | bytes[at + 1] << 16 | bytes[at + 2] << 8 | bytes[at + 3];
        };
        if (starts(png) && bytes.size() >= 24 && std::memcmp(bytes.data() + 12, "IHDR", 4) == 0
            && std::max(word(16), word(20)) > GltfLimits::texture_side)
            return "is " + std::to_string(word(16)) + " x " + std::to_string(word(20)) + " pixels; at most "
                + std::to_string(GltfLimits::texture_side) + " a side and " + std::to_string(GltfLimits::texture_pixels)
                + " in all are allowed";
        return "has a broken header (" + std::string(stbi_failure_reason()) + "); should be a PNG or JPEG";
    }
    std::string size = "is " + std::to_string(width) + " x " + std::to_string(height) + " pixels; ";
    if (width < 1 || height < 1 || width > GltfLimits::texture_side || height > GltfLimits::texture_side
        || std::size_t(width) * std::size_t(height) > GltfLimits::texture_pixels)
        return size + "at most " + std::to_string(GltfLimits::texture_side) + " a side and "
            + std::to_string(GltfLimits::texture_pixels) + " in all are allowed";
    // A WebP of one colour takes a few bytes, whatever its size.
    if (!is_webp(bytes) && std::size_t(width) * std::size_t(height) / pixels_per_byte > bytes.size())
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

/// The size of an image, or 0 for one that can't be decoded.
glm::ivec2 image_size(std::span<const std::uint8_t> bytes)
{
    glm::ivec2 size(0);
    int channels = 0;
    if (is_webp(bytes))
        return WebPGetInfo(bytes.data(), bytes.size(), &size.x, &size.y) ? size : glm::ivec2(0);
    return stbi_info_from_memory(bytes.data(), int(bytes.size()), &size.x, &size.y, &channels) ? size : glm::ivec2(0);
}

/// True if a surface emits light from a texture.
bool glows_by_texture(const tinygltf::Material& material)
{
    const auto& factor = material.emissiveFactor;
    return material.emissiveTexture.index >= 0 && !material.extensions.contains("KHR_materials_unlit")
        && std::any_of(factor.begin(), factor.end(), [](double part) { return part != 0; });
}

/// The use of a glTF texture: its sampler, and whether it holds numbers instead of colours.
struct TextureUse {
    Sampler sampler;
    bool numbers;
    bool operator==(const TextureUse&) const = default;
};

/// The glTF textures that the materials use, by image, each use once.
std::map<int, std::vector<TextureUse>> used_images(const tinygltf::Model& model)
{
    std::map<int, std::vector<TextureUse>> used;
    const auto use = [&](int index, bool numbers) {
        if (index < 0 || model.textures[std::size_t(index)].source < 0)
            return;
        const auto& texture = model.textures[std::size_t(index)];
        std::vector<TextureUse>& uses = used[texture.source];
        const TextureUse one{sampler_of(model, texture.sampler), numbers};
        if (std::find(uses.begin(), uses.end(), one) == uses.end())
            uses.push_back(one);
    };
    for (const auto& material : model.materials) {
        use(material.pbrMetallicRoughness.baseColorTexture.index, false);
        if (glows_by_texture(material))
            use(material.emissiveTexture.index, false);
        if (material.extensions.contains("KHR_materials_unlit"))
            continue;
        for (int index : {material.pbrMetallicRoughness.metallicRoughnessTexture.index, material.normalTexture.index,
                 material.occlusionTexture.index})
            use(index, true);
    }
    return used;
}

/// How often each image's memory is quartered, by halving its sides, so that all textures together stay within their limit:
/// those above some number of pixels are halved until they have at most so many.
std::map<int, int> halvings(const WorldBuild& build)
{
    struct Size {
        int image;
        std::size_t pixels, textures;
    };
    std::vector<Size> sizes;
    for (const auto& [image, uses] : used_images(build.model)) {
        const glm::ivec2 size = image_size(build.file.images[std::size_t(image)]);
        sizes.push_back({image, std::size_t(size.x) * std::size_t(size.y), uses.size()});
    }
    std::map<int, int> result;
    for (std::size_t most = GltfLimits::texture_pixels; most > 0; most /= 2) {
        std::size_t sum = 0;
        for (Size size : sizes) {
            int& times = result[size.image] = 0;
            for (; size.pixels > most; size.pixels /= 4)
                ++times;
            sum += size.pixels * size.textures;
        }
        if (sum <= LargeImage::all_pixels)
            break;
    }
    return result;
}

/// Textures by image and use. Equal pairs share a texture.
struct TexturePool {
    WorldBuild& build;
    std::map<int, int> halved = halvings(build);
    std::map<std::pair<int, bool>, int> of_gltf;
    std::map<int, std::vector<int>> of_image;

    /// -1 without a texture, or where no image is in it.
    int place(int gltf_texture, bool numbers = false)
    {
        if (gltf_texture < 0)
            return -1;
        auto [known, is_new] = of_gltf.try_emplace({gltf_texture, numbers}, -1);
        if (is_new)
            known->second = add(gltf_texture, numbers);
        return known->second;
    }

    int add(int gltf_texture, bool numbers)
    {
        const auto& texture = build.model.textures[std::size_t(gltf_texture)];
        if (texture.source < 0) {
            note_once(build.world.notes, "textures without a PNG, JPEG or WebP image: their surfaces are plain");
            return -1;
        }
        const TextureUse use{sampler_of(build.model, texture.sampler), numbers};
        auto& textures = build.world.textures;
        auto& siblings = of_image[texture.source];
        for (int sibling : siblings)
            if (use == TextureUse{textures[std::size_t(sibling)].sampler, textures[std::size_t(sibling)].numbers})
                return sibling;
        // An image that was made smaller was made so as colours or as numbers.
        const auto like = std::ranges::find_if(siblings, [&](int sibling) {
            return textures[std::size_t(sibling)].numbers == numbers || halved.at(texture.source) == 0;
        });
        Texture made = like == siblings.end() ? decode(texture.source, numbers) : textures[std::size_t(*like)];
        made.sampler = use.sampler, made.numbers = numbers;
        textures.push_back(std::move(made));
        siblings.push_back(int(textures.size()) - 1);
        return siblings.back();
    }

    /// The last halving is left to the device, which may compress the image instead.
    Texture decode(int image, bool numbers)
    {
        const int times = halved.at(image);
        const auto& bytes = build.file.images[std::size_t(image)];
        Texture made
            = decode_image(build.file.name, "/images/" + std::to_string(image), bytes, std::max(times - 1, 0), numbers);
        if (times > 0)
            made.large = {image, image_size(bytes)};
        return made;
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

Bytes rgba_of(const Pixels& from)
{
    const std::size_t count = std::size_t(from.size.x) * std::size_t(from.size.y);
    Bytes rgba(4 * count);
    std::uint8_t* to = rgba.data();
    const std::uint8_t* at = from.values;
    for (std::size_t i = 0; i < count; ++i, to += 4, at += from.channels) {
        for (int c = 0; c < 3; ++c)
            to[c] = at[from.grey() ? 0 : c];
        to[3] = from.covers() ? 255 : at[from.channels - 1];
    }
    return rgba;
}

} // namespace

Texture decode_image(
    const std::string& file, const std::string& place, std::span<const std::uint8_t> bytes, int halvings, bool numbers)
{
    Pixels from;
    if (std::string problem = suspicion(bytes, from.size.x, from.size.y); !problem.empty())
        throw InputError(file, place, problem);
    // The image's own channels: a grey one takes a quarter of the memory until it is small.
    const bool webp = is_webp(bytes);
    const std::optional<FirstFrame> frame = webp ? first_frame(bytes) : std::nullopt;
    std::unique_ptr<std::uint8_t, void (*)(void*)> decoded(frame ? decode_first(*frame)
            : webp ? WebPDecodeRGBA(bytes.data(), bytes.size(), &from.size.x, &from.size.y)
                   : stbi_load_from_memory(bytes.data(), int(bytes.size()), &from.size.x, &from.size.y, &from.channels, 0),
        webp ? WebPFree : stbi_image_free);
    if (!decoded)
        throw InputError(file, place,
            frame
                ? "is an animated WebP whose first frame cannot be decoded; a whole one, or a WebP of one picture, is right"
                : webp ? "cannot be decoded; a whole WebP is right"
                       : "cannot be decoded: " + std::string(stbi_failure_reason()));
    from.values = decoded.get();
    Texture out;
    out.size = glm::max(from.size >> halvings, 1);
    out.rgba = halvings == 0 ? rgba_of(from) : shrunk(from, out.size, numbers);
    return out;
}

namespace {

/// The texture and coordinates of a map. sets: of VertexMaps::uvs, of which the map takes one or claims a free one.
template <typename Info> Map map_of(TexturePool& shelf, const Info& info, bool numbers, std::array<int, 2>& sets)
{
    Map map;
    map.texture = shelf.place(info.index, numbers);
    if (map.texture < 0)
        return map;
    const UvSource from = uv_source(info);
    auto set = std::ranges::find(sets, from.set);
    if (set == sets.end())
        set = std::ranges::find(sets, -1);
    if (set == sets.end()) {
        note_once(
            shelf.build.world.notes, "maps with a third set of texture coordinates in a material: they take the first");
        set = sets.begin();
    } else
        *set = from.set;
    map.second = set != sets.begin();
    map.rotate_scale = glm::mat2(from.rotate_scale);
    map.offset = glm::vec2(from.offset);
    return map;
}

/// glTF's metallic-roughness reflection; none for a matt surface: without metal, wholly rough and without maps. Of its
/// highlight, which is as wide as the sky, 4 % of the light are left out.
std::optional<Gloss> gloss_of(TexturePool& shelf, const tinygltf::Material& from, std::array<int, 2>& sets)
{
    const auto& pbr = from.pbrMetallicRoughness;
    Gloss gloss{.metallic = pbr.metallicFactor, .roughness = pbr.roughnessFactor};
    gloss.metallic_roughness = map_of(shelf, pbr.metallicRoughnessTexture, true, sets);
    gloss.normal = map_of(shelf, from.normalTexture, true, sets);
    gloss.occlusion = map_of(shelf, from.occlusionTexture, true, sets);
    gloss.normal_scale = from.normalTexture.scale, gloss.occlusion_strength = from.occlusionTexture.strength;
    if (const auto ior = from.extensions.find("KHR_materials_ior"); ior != from.extensions.end()) {
        const double index = ior->second.Get("ior").GetNumberAsDouble();
        gloss.dielectric = std::pow((index - 1) / (index + 1), 2);
    }
    const bool maps = gloss.metallic_roughness.texture >= 0 || gloss.normal.texture >= 0 || gloss.occlusion.texture >= 0;
    if (gloss.metallic == 0 && gloss.roughness == 1 && !maps)
        return {};
    return gloss;
}

} // namespace

void add_materials(WorldBuild& build)
{
    TexturePool shelf{build};
    for (const auto& from : build.model.materials) {
        Material to = build.file.surfaces[build.world.materials.size()];
        to.name = from.name;
        const auto& pbr = from.pbrMetallicRoughness;
        for (int i = 0; i < 4; ++i)
            to.base_colour[i] = float(pbr.baseColorFactor[std::size_t(i)]);
        to.base_texture = shelf.place(pbr.baseColorTexture.index);
        to.double_sided = from.doubleSided;
        to.alpha_cutoff = from.alphaMode == "MASK" ? float(from.alphaCutoff) : 0;
        to.blended = from.alphaMode == "BLEND";
        to.unlit = from.extensions.contains("KHR_materials_unlit");
        UvSource uv = uv_source(pbr.baseColorTexture);
        std::array<int, 2> sets{-1, -1};
        if (!to.unlit)
            to.gloss = gloss_of(shelf, from, sets);
        if (!to.unlit && !from.emissiveFactor.empty()) {
            auto strength = from.extensions.find("KHR_materials_emissive_strength");
            double factor
                = strength == from.extensions.end() ? 1 : strength->second.Get("emissiveStrength").GetNumberAsDouble();
            for (int i = 0; i < 3; ++i)
                to.emissive[i] = float(from.emissiveFactor[std::size_t(i)] * factor);
            if (to.emissive != glm::vec3(0))
                to.emissive_texture = shelf.place(from.emissiveTexture.index);
        }
        if (to.emissive_texture >= 0) {
            const UvSource emissive_uv = uv_source(from.emissiveTexture);
            if (to.base_texture < 0)
                uv = emissive_uv;
            if (to.gloss || emissive_uv != uv)
                to.emissive_map = map_of(shelf, from.emissiveTexture, false, sets);
        }
        build.world.materials.push_back(std::move(to));
        build.uv.push_back(uv);
        build.map_sets.push_back(sets);
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
        // glTF's default material is a rough metal (glTF 2.0, section 3.7.2.1 and 5.19).
        Material& made = build.world.materials.emplace_back();
        made.name = "default";
        made.gloss.emplace();
        build.uv.emplace_back();
        build.map_sets.push_back({-1, -1});
    }
    return build.default_material;
}

int stroke_material_of(WorldBuild& build, int gltf_material, bool lit)
{
    const auto [known, is_new] = build.stroke_materials.try_emplace({gltf_material, lit}, int(build.world.materials.size()));
    if (!is_new)
        return known->second;
    Material made = gltf_material >= 0 ? build.world.materials[std::size_t(gltf_material)] : Material{.name = "default"};
    made.gloss.reset(), made.emissive_map.reset();
    made.unlit = made.unlit || !lit, made.double_sided = true;
    build.world.materials.push_back(made);
    build.uv.push_back(gltf_material >= 0 ? build.uv[std::size_t(gltf_material)] : UvSource{});
    build.map_sets.push_back({-1, -1});
    return known->second;
}

} // namespace starbow
