#include "sky_cache.h"
#include "config/json/error.h"
#include "config/json/hash.h"
#include "config/json/kept_file.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include "gltf/parts.h"
#include "painted_sky.h"
#include <cstring>
#include <span>

namespace starbow {
namespace {

/// Another way of painting has another number.
constexpr std::uint64_t version = 1;
const char* const right_panorama = "a PNG or JPEG of the whole sky, twice as wide as high,";

struct Header {
    char magic[8] = {'S', 't', 'a', 'r', 'b', 'o', 'w', 'P'};
    std::uint64_t key = 0; ///< of what the sky is painted from
    std::uint64_t width = 0, height = 0;
    std::uint64_t content = 0; ///< hash of the texels; a damaged file is not read
};

std::uint64_t content_of(const std::vector<std::uint8_t>& rgba)
{
    ContentHash hash;
    hash.add(rgba.data(), rgba.size());
    return hash.value();
}

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

std::optional<Texture> read_kept(const std::filesystem::path& path, std::uint64_t key)
{
    RegularFile file(path);
    Header header;
    const Header right;
    const auto read = [&](void* to, std::size_t bytes) { return file.read({static_cast<char*>(to), bytes}) == bytes; };
    constexpr std::uint64_t most = 1 << 16;
    if (!read(&header, sizeof header) || std::memcmp(header.magic, right.magic, sizeof right.magic) != 0 || header.key != key
        || header.width > most || header.height > most
        || file.size() != sizeof header + header.width * header.height * 4)
        return {};
    Texture texture{{int(header.width), int(header.height)}, {}, {}};
    texture.rgba.resize(header.width * header.height * 4);
    if (!read(texture.rgba.data(), texture.rgba.size()) || content_of(texture.rgba) != header.content)
        return {};
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
    Header header;
    std::filesystem::path kept_file;
    if (!folder.empty()) {
        header.key = key_of(sky, bytes);
        kept_file = folder / kept_name(header.key, ".sky");
        if (std::optional<Texture> kept = read_kept(kept_file, header.key)) {
            mark_as_read(kept_file);
            return std::move(*kept);
        }
    }
    Texture panorama = panorama_of(file, bytes);
    if (const std::vector<Star> stars = painted_stars(sky); !stars.empty())
        panorama = painted(panorama, stars, sky.milky_way->peak_arcmin2);
    if (kept_file.empty())
        return panorama;
    header.width = std::uint64_t(panorama.size.x), header.height = std::uint64_t(panorama.size.y);
    header.content = content_of(panorama.rgba);
    try {
        write_own(kept_file, {{reinterpret_cast<const unsigned char*>(&header), sizeof header}, panorama.rgba});
    } catch (const InputError&) { // the picture serves all the same
    }
    return panorama;
}

} // namespace starbow
