#include "globes.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include "config/model/angles.h"
#include "gltf/parts.h"
#include "stars.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

Texture load_map(const std::filesystem::path& file)
{
    const std::string right = "a PNG or JPEG of a whole globe, twice as wide as high, its height a power of two,";
    const std::string bytes = read_whole(file, std::size_t(256) << 20, right);
    const std::string name = one_line(file.string());
    Texture map = decode_image(name, "", {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, 0);
    if (map.size.x != 2 * map.size.y || (map.size.y & (map.size.y - 1)))
        throw InputError(name, "",
            "has " + std::to_string(map.size.x) + " x " + std::to_string(map.size.y) + " pixels; " + right + " is right");
    return map;
}

/// A map of the size, linear between the middles of texels.
Texture enlarged(const Texture& map, const glm::ivec2& size)
{
    if (map.size == size)
        return map;
    Texture out{
        .size = size, .rgba = std::vector<std::uint8_t>(4 * std::size_t(size.x) * std::size_t(size.y)), .sampler = {}};
    const auto texel = [&](int x, int y, int c) {
        x = (x % map.size.x + map.size.x) % map.size.x, y = std::clamp(y, 0, map.size.y - 1);
        return double(map.rgba[4 * (std::size_t(y) * std::size_t(map.size.x) + std::size_t(x)) + std::size_t(c)]);
    };
    std::size_t at = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const glm::dvec2 from = (glm::dvec2(x, y) + 0.5) * glm::dvec2(map.size) / glm::dvec2(size) - 0.5;
            const int i = int(std::floor(from.x)), j = int(std::floor(from.y));
            for (int c = 0; c < 4; ++c)
                out.rgba[at++]
                    = std::uint8_t(std::lerp(std::lerp(texel(i, j, c), texel(i + 1, j, c), from.x - i),
                                       std::lerp(texel(i, j + 1, c), texel(i + 1, j + 1, c), from.x - i), from.y - j)
                        + 0.5);
        }
    return out;
}

/// Puts the red of one map into a channel of another of its size.
void put_channel(Texture& to, int channel, const Texture& from)
{
    for (std::size_t i = 0; i < to.rgba.size(); i += 4)
        to.rgba[i + std::size_t(channel)] = from.rgba[i];
}

/// Means over the globe's whole surface: of the kinds' parts where no cloud is, and of the clouds.
struct Means {
    glm::dvec4 parts{0};
    double clouds = 0;
};
Means means_of(const Texture& map, double scale, const Texture* sky)
{
    Means sum;
    double all = 0;
    for (int y = 0; y < map.size.y; ++y) {
        const double weight = std::sin((y + 0.5) / map.size.y * pi);
        for (int x = 0; x < map.size.x; ++x) {
            const std::size_t at = 4 * (std::size_t(y) * std::size_t(map.size.x) + std::size_t(x));
            const double clouds = sky ? sky->rgba[at] / 255.0 : 0, fourth = sky ? map.rgba[at + 3] / 255.0 : 0;
            sum.parts += weight * (1 - clouds)
                * glm::dvec4(glm::dvec3(map.rgba[at], map.rgba[at + 1], map.rgba[at + 2]) * (scale / 255), fourth);
            sum.clouds += weight * clouds, all += weight;
        }
    }
    return {sum.parts / all, sum.clouds / all};
}

} // namespace

std::shared_ptr<const Globes> load_globes(const std::filesystem::path& file)
{
    auto globes = std::make_shared<Globes>();
    globes->system = load_solar_system(file);
    glm::ivec2 size(0);
    for (const Globe& globe : globes->system.globes) {
        globes->maps.push_back(
            globe.map.empty() ? Texture{.size = glm::ivec2(0), .rgba = {}, .sampler = {}} : load_map(globe.map));
        if (!globe.air)
            size = glm::max(size, globes->maps.back().size);
    }
    for (std::size_t i = 0; i < globes->maps.size(); ++i) {
        const Globe& globe = globes->system.globes[i];
        Texture& map = globes->maps[i];
        Means means{glm::dvec4(0, 0, 0, 1)};
        if (globe.air) {
            put_channel(map, 3, enlarged(load_map(globe.air->water), map.size));
            globes->sky = enlarged(load_map(globe.air->clouds), map.size);
            put_channel(globes->sky, 1, enlarged(load_map(globe.air->lamps), map.size));
            means = means_of(map, globe.map_scale, &globes->sky);
            globes->clouds = means.clouds;
        } else if (!globe.map.empty()) {
            map = enlarged(map, size);
            means = means_of(map, globe.map_scale, nullptr);
        }
        globes->parts.push_back(means.parts);
    }
    return globes;
}

std::vector<SeenGlobe> globes_seen(const Globes& globes, const SceneFile& scene, const Shot& shot)
{
    const glm::dmat3 turn = world_from_equatorial(scene.stars ? scene.stars->ahead_deg : glm::dvec2(0));
    return globes_seen(globes.system, world_origin(globes.system, scene.globes.value()),
        {shot.position, shot.time, turn, scene.unit_m, scene.seconds_per_time_unit()});
}

} // namespace starbow
