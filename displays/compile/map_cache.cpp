#include "map_cache.h"
#include "config/json/error.h"
#include "config/json/kept_file.h"

namespace starbow {
namespace {

constexpr const char* map_kind = "map2";

/// A kept map's numbers, as a part of its file.
struct MapNumbers {
    std::int32_t width = 0, height = 0, channels = 0, intensities = 0;
};

} // namespace

std::shared_ptr<DirectionMap> read_kept_map(const std::filesystem::path& path, std::uint64_t key, glm::ivec2 size)
{
    KeptFile file(path, map_kind, key);
    MapNumbers numbers;
    auto map = std::make_shared<DirectionMap>();
    map->texels.resize(file.size(1) / sizeof(glm::vec4));
    map->intensity.resize(file.size(2) / sizeof(float));
    const std::size_t pixels = std::size_t(size.x) * std::size_t(size.y);
    if (!file.read({bytes_of(numbers), bytes_of(map->texels), bytes_of(map->intensity)}) || numbers.width != size.x
        || numbers.height != size.y || (numbers.channels != 1 && numbers.channels != 3)
        || map->texels.size() != pixels * std::size_t(numbers.channels)
        || map->intensity.size() != (numbers.intensities ? pixels : 0))
        return {};
    map->size = size;
    map->channels = numbers.channels;
    return map;
}

bool write_kept_map(const std::filesystem::path& file, std::uint64_t key, const DirectionMap& map)
{
    const MapNumbers numbers{map.size.x, map.size.y, map.channels, !map.intensity.empty()};
    try {
        write_kept(file, map_kind, key, {bytes_of(numbers), bytes_of(map.texels), bytes_of(map.intensity)});
    } catch (const InputError&) {
        return false;
    }
    return true;
}

} // namespace starbow
