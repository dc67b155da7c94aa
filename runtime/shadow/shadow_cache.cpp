#include "shadow_cache.h"
#include "config/json/error.h"
#include "config/json/hash.h"
#include "config/json/kept_file.h"
#include "occluders.h"

namespace starbow {
namespace {

constexpr std::uint64_t version = 11; // another computation has another number
constexpr const char* shadows_kind = "shadows2";

/// The numbers of kept shadows, as a part of their file.
struct ShadowNumbers {
    std::int64_t size = 0, cells[3] = {};
    double low[3] = {}, cell = 0;
};

/// True if the numbers of a file are those of the shadows' maps, and of a grid.
bool fits(const ShadowNumbers& numbers, const Shadows& shadows)
{
    std::uint64_t layers = 0, cells = 1;
    for (const ShadowMap& map : shadows.maps)
        layers += map.point ? 6 : 2;
    for (const std::int64_t count : numbers.cells) {
        if (count < 2 || count > 1'000'000 || cells > shadows.sky.size())
            return false;
        cells *= std::uint64_t(count);
    }
    return numbers.size == shadows.size && shadows.sky.size() == 8 * cells
        && shadows.texels.size() == layers * std::uint64_t(shadows.size) * std::uint64_t(shadows.size);
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
    KeptFile file(path, shadows_kind, key);
    ShadowNumbers numbers;
    Shadows kept = shadows; // nothing of a damaged file remains
    kept.texels.resize(file.size(1) / sizeof(std::uint16_t)), kept.sky.resize(file.size(2));
    if (!file.read({bytes_of(numbers), bytes_of(kept.texels), bytes_of(kept.sky)}) || !fits(numbers, kept))
        return false;
    kept.cells = glm::ivec3(int(numbers.cells[0]), int(numbers.cells[1]), int(numbers.cells[2]));
    kept.low = {numbers.low[0], numbers.low[1], numbers.low[2]}, kept.cell = numbers.cell;
    shadows = std::move(kept);
    return true;
}

bool write_kept_shadows(const std::filesystem::path& file, std::uint64_t key, const Shadows& shadows)
{
    const ShadowNumbers numbers{shadows.size, {shadows.cells.x, shadows.cells.y, shadows.cells.z},
        {shadows.low.x, shadows.low.y, shadows.low.z}, shadows.cell};
    try {
        write_kept(file, shadows_kind, key, {bytes_of(numbers), bytes_of(shadows.texels), bytes_of(shadows.sky)});
    } catch (const InputError&) {
        return false;
    }
    return true;
}

} // namespace starbow
