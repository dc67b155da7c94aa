#include "shadow_cache.h"
#include "config/json/error.h"
#include "config/json/hash.h"
#include "config/json/whole_file.h"
#include "occluders.h"
#include <cstring>

namespace starbow {
namespace {

constexpr std::uint64_t version = 10; // another computation has another number

struct Header {
    char magic[8] = {'S', 't', 'a', 'r', 'b', 'o', 'w', 'S'};
    std::uint64_t key = 0, texels = 0, sky = 0;
    std::int64_t size = 0, cells[3] = {};
    std::uint64_t content = 0;
};

/// True if the numbers of a header are those of the shadows' maps, and of a grid.
bool fits(const Header& header, const Shadows& shadows)
{
    std::uint64_t layers = 0, cells = 1;
    for (const ShadowMap& map : shadows.maps)
        layers += map.point ? 6 : 2;
    for (const std::int64_t count : header.cells) {
        if (count < 2 || count > 1'000'000 || cells > header.sky)
            return false;
        cells *= std::uint64_t(count);
    }
    return header.size == shadows.size && header.sky == 8 * cells
        && header.texels == layers * std::uint64_t(shadows.size) * std::uint64_t(shadows.size);
}

std::uint64_t content_of(const Shadows& shadows)
{
    ContentHash hash;
    hash.add(shadows.texels.data(), shadows.texels.size() * sizeof(std::uint16_t));
    hash.add(shadows.sky.data(), shadows.sky.size());
    hash.add(&shadows.low, sizeof shadows.low);
    hash.add(&shadows.cell, sizeof shadows.cell);
    hash.add(&shadows.cells, sizeof shadows.cells);
    return hash.value();
}

} // namespace

std::uint64_t shadows_key(const World& world, const World& placed, const SceneFile& scene)
{
    ContentHash hash;
    const std::uint64_t made_by[] = {version};
    hash.add(made_by, sizeof made_by);
    hash.add(world.vertices.data(), world.vertices.size() * sizeof(Vertex));
    hash.add(world.indices.data(), world.indices.size() * sizeof(std::uint32_t));
    for (const Instance& instance : placed.instances)
        if (hides_light(placed, instance)) {
            const Primitive& primitive = placed.primitives[instance.primitive];
            const Material& material = placed.materials[std::size_t(primitive.material)];
            const std::uint64_t range[] = {primitive.first_index, primitive.index_count,
                std::uint64_t(std::uint32_t(primitive.vertex_offset)), std::uint64_t(material.double_sided)};
            hash.add(range, sizeof range);
            hash.add(&instance.frame_from_local, sizeof instance.frame_from_local);
            const float mask[] = {material.alpha_cutoff, material.base_colour.a};
            hash.add(mask, sizeof mask);
            if (material.alpha_cutoff > 0 && material.base_texture >= 0) {
                const Texture& texture = world.textures[std::size_t(material.base_texture)];
                hash.add(texture.rgba.data(), texture.rgba.size());
            }
        }
    for (const Light& light : scene.lights) {
        const auto* far = std::get_if<DirectionalLight>(&light);
        const glm::dvec3 at = far ? far->towards : std::get<PointLight>(light).position;
        const std::uint64_t kind = far ? 0 : std::get<PointLight>(light).body.empty() ? 1 : 2;
        hash.add(&kind, sizeof kind);
        hash.add(&at, sizeof at);
    }
    return hash.value();
}

bool read_kept_shadows(const std::filesystem::path& path, std::uint64_t key, Shadows& shadows)
{
    RegularFile file(path);
    Header header;
    const Header right;
    const auto read = [&](void* to, std::size_t bytes) { return file.read({static_cast<char*>(to), bytes}) == bytes; };
    if (!read(&header, sizeof header) || std::memcmp(header.magic, right.magic, sizeof right.magic) != 0 || header.key != key
        || header.texels > file.size() || header.sky > file.size() || !fits(header, shadows)
        || file.size()
            != sizeof header + header.texels * sizeof(std::uint16_t) + header.sky + sizeof shadows.low + sizeof shadows.cell)
        return false;
    Shadows kept = shadows; // nothing of a damaged file remains
    kept.cells = glm::ivec3(int(header.cells[0]), int(header.cells[1]), int(header.cells[2]));
    kept.texels.resize(header.texels), kept.sky.resize(header.sky);
    if (!read(kept.texels.data(), header.texels * sizeof(std::uint16_t)) || !read(kept.sky.data(), header.sky)
        || !read(&kept.low, sizeof kept.low) || !read(&kept.cell, sizeof kept.cell) || content_of(kept) != header.content)
        return false;
    shadows = std::move(kept);
    return true;
}

bool write_kept_shadows(const std::filesystem::path& file, std::uint64_t key, const Shadows& shadows)
{
    Header header;
    header.key = key, header.texels = shadows.texels.size(), header.sky = shadows.sky.size();
    header.size = shadows.size, header.content = content_of(shadows);
    for (int k = 0; k < 3; ++k)
        header.cells[k] = shadows.cells[k];
    const auto bytes
        = [](const void* from, std::size_t count) { return std::span(static_cast<const unsigned char*>(from), count); };
    try {
        write_own(file,
            {bytes(&header, sizeof header), bytes(shadows.texels.data(), shadows.texels.size() * sizeof(std::uint16_t)),
                bytes(shadows.sky.data(), shadows.sky.size()), bytes(&shadows.low, sizeof shadows.low),
                bytes(&shadows.cell, sizeof shadows.cell)});
    } catch (const InputError&) {
        return false;
    }
    return true;
}

} // namespace starbow
