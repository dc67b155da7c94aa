#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/scene_file.h"
#include "globes.h"
#include "sky_cache.h"
#include <algorithm>
#include <cmath>

namespace starbow {

namespace {

/// True if a surface of the world emits light, or a lamp, the sky or the ambient light of its scene illuminates it.
bool has_light(const World& world, const SceneFile& scene)
{
    const auto black = [](const glm::dvec3& colour) { return !(colour.r > 0 || colour.g > 0 || colour.b > 0); };
    const bool sky
        = !black(scene.sky.zenith) || !black(scene.sky.horizon) || !black(scene.sky.nadir) || scene.sky.temperature_K > 0;
    return !scene.lights.empty() || !black(scene.ambient) || sky || scene.stars || scene.globes
        || std::ranges::any_of(world.materials, [&](const Material& material) {
               return material.unlit || !black(material.emissive) || (material.temperature_K > 0 && material.emissivity > 0);
           });
}

/// Adds the ground as a node "ground": tiles, so that its shape and its speed can be seen.
void add_ground(World& world, const Ground& ground)
{
    constexpr int across = 40; // tiles
    constexpr double darker = 0.86;
    const auto byte = [](double part) { return std::uint32_t(std::lround(255 * part)); };
    Primitive made{};
    made.first_index = std::uint32_t(world.indices.size());
    made.vertex_offset = std::int32_t(world.vertices.size());
    made.material = int(world.materials.size());
    Material material{.name = "ground"};
    material.base_colour = glm::vec4(glm::vec3(ground.colour), 1), material.double_sided = true;
    world.materials.push_back(std::move(material));
    const double tile = 2 * ground.half_width / across;
    for (int j = 0; j < across; ++j)
        for (int i = 0; i < across; ++i) {
            const auto first = std::uint32_t(4 * (across * j + i));
            const std::uint32_t shade = byte((i + j) % 2 ? darker : 1), colour = shade * 0x10101 | 0xff000000;
            for (const glm::dvec2 corner : {glm::dvec2(0, 0), {0, 1}, {1, 1}, {1, 0}}) {
                const glm::dvec2 at = (glm::dvec2(i, j) + corner) * tile - ground.half_width;
                world.vertices.push_back({glm::vec3(at.x, 0, at.y), glm::vec3(0, 1, 0), glm::vec2(0), colour});
            }
            for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u})
                world.indices.push_back(first + k);
        }
    made.index_count = std::uint32_t(world.indices.size()) - made.first_index;
    made.high = glm::dvec3(ground.half_width, 0, ground.half_width), made.low = -made.high;
    made.radius = glm::length(made.high);
    glm::dmat4 place(1);
    place[3] = glm::dvec4(ground.middle, 1);
    world.instances.push_back({place, std::uint32_t(world.primitives.size()), int(world.nodes.size())});
    world.primitives.push_back(made);
    world.nodes.push_back({"ground", -1});
    if (!world.vertex_maps.empty())
        world.vertex_maps.resize(world.vertices.size());
}

} // namespace

World load_world(const SceneFile& scene, const std::filesystem::path& cache)
{
    World world = load_world(scene.gltf);
    if (scene.ground)
        add_ground(world, *scene.ground);
    world.notes.insert(world.notes.begin(), scene.notes.begin(), scene.notes.end());
    if (!has_light(world, scene))
        world.notes.insert(world.notes.begin(),
            "nothing in this world shines, and every picture of it is black: \"lights\", \"ambient\" or a \"sky\" in "
                + scene.file + " are right; starbow check " + one_line(scene.gltf.string()) + " suggests some");
    if (scene.globes) {
        world.globes = load_globes(scene.globes->file);
        const std::vector<Globe>& globes = world.globes->system.globes;
        const std::string& origin = scene.globes->origin;
        if (std::none_of(globes.begin(), globes.end(), [&](const Globe& globe) { return globe.name == origin; }))
            throw InputError(scene.file, "/globes/origin",
                '"' + origin + "\" is not a globe of " + one_line(scene.globes->file.string())
                    + "; a \"body\" of that file is right");
    }
    if (!scene.stars || !scene.stars->milky_way)
        return world;
    Texture panorama = load_sky(*scene.stars, cache);
    panorama.sampler = {.u = Wrap::repeat, .v = Wrap::clamp};
    world.milky_way = int(world.textures.size());
    world.textures.push_back(std::move(panorama));
    return world;
}

} // namespace starbow
