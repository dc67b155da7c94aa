#include "sky_cache.h"
#include "config/json/error.h"
#include "config/json/hash.h"
#include "config/json/kept_file.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include "gltf/parts.h"
#include "painted_sky.h"
#include <cstring>

namespace starbow {
namespace {

/// Another way of painting has another number.
constexpr std::uint64_t version = 1;
const char* const right_panorama = "a PNG or JPEG of the whole sky, twice as wide as high,";

constexpr const char* sky_kind = "sky2";

/// A kept picture's numbers, as a part of its file.
struct SkyNumbers {
    std::uint64_t width = 0, height = 0;
};

std::uint64_t key_of(const StarSky& sky, const std::string& panorama)
{
    const std::string catalogue = read_whole(sky.catalogue, std::size_t(256) << 20, "a catalogue of stars");
    ContentHash hash;
    std::uint64_t peak = 0;
    static_assert(sizeof peak == sizeof sky.milky_way->peak_arcmin2);
    std::memcpy(&peak, &sky.milky_way->peak_arcmin2, sizeof peak);
    const std::uint64_t numbers[] = {version, sky.in_depth, peak, panorama.size(), catalogue.size()};
    hash.add(numbers, sizeof numbers);
    hash.add(panorama.data(), panorama.size());
    hash.add(catalogue.data(), catalogue.size());
    return hash.value();
}

std::optional<Texture> read_sky(const std::filesystem::path& path, std::uint64_t key)
{
    KeptFile file(path, sky_kind, key);
    SkyNumbers numbers;
    Texture texture;
    texture.rgba.resize(file.size(1));
    constexpr std::uint64_t most = 1 << 16;
    if (!file.read({bytes_of(numbers), bytes_of(texture.rgba)}) || numbers.width > most || numbers.height > most
        || texture.rgba.size() != numbers.width * numbers.height * 4)
        return {};
    texture.size = {int(numbers.width), int(numbers.height)};
    return texture;
}

Texture panorama_of(const std::filesystem::path& file, const std::string& bytes)
{
    const std::string name = one_line(file.string());
    Texture panorama = decode_image(name, "", {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, 0);
    if (panorama.size.x != 2 * panorama.size.y)
        throw InputError(name, "",
            "has " + std::to_string(panorama.size.x) + " x " + std::to_string(panorama.size.y) + " pixels; " + right_panorama
                + " is right");
    return panorama;
}

} // namespace

Texture load_sky(const StarSky& sky, const std::filesystem::path& folder)
{
    const std::filesystem::path& file = sky.milky_way->panorama;
    const std::string bytes = read_whole(file, std::size_t(256) << 20, right_panorama);
    std::uint64_t key = 0;
    std::filesystem::path kept_file;
    if (!folder.empty()) {
        key = key_of(sky, bytes);
        kept_file = folder / cache_key(key, ".sky");
        if (std::optional<Texture> kept = read_sky(kept_file, key))
            return std::move(*kept);
    }
    Texture panorama = panorama_of(file, bytes);
    if (const std::vector<Star> stars = painted_stars(sky); !stars.empty())
        panorama = painted(panorama, stars, sky.milky_way->peak_arcmin2);
    if (kept_file.empty())
        return panorama;
    const SkyNumbers numbers{std::uint64_t(panorama.size.x), std::uint64_t(panorama.size.y)};
    try {
        write_kept(kept_file, sky_kind, key, {bytes_of(numbers), bytes_of(panorama.rgba)});
    } catch (const InputError&) { // the picture serves all the same
    }
    return panorama;
}

} // namespace starbow
