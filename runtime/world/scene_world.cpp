#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/model/scene_file.h"
#include "globes.h"
#include "sky_cache.h"
#include <algorithm>

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

} // namespace

World load_world(const SceneFile& scene, const std::filesystem::path& cache)
{
    World world = load_world(scene.gltf);
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
