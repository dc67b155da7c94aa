#include "theatre.h"
#include "detail.h"
#include <cstdlib>

namespace starbow {

struct LoadedScene {
    SceneFile scene;
    World world;
    std::vector<Star> stars;
};

static LoadedScene load(const std::filesystem::path& file)
{
    SceneFile scene = load_scene_file(file);
    World world = load_world(scene.gltf);
    add_detail_levels(world);
    std::vector<Star> stars;
    if (scene.stars)
        stars = load_stars(scene.stars->catalogue);
    return {std::move(scene), std::move(world), std::move(stars)};
}

Theatre::Theatre(const std::filesystem::path& scene, const Device::Options& options, std::optional<SpectralLevel> level)
    : Theatre(load(scene), options, level)
{
}

Theatre::Theatre(LoadedScene&& loaded, const Device::Options& options, std::optional<SpectralLevel> level)
    : device(options)
    , pipelines(device)
    , world(upload(device, pipelines, std::move(loaded.world), loaded.scene, loaded.stars, level))
{
}

std::string light_told(const Theatre& theatre)
{
    const NeededLevel needed = needed_level(theatre.world.world, theatre.world.scene);
    const SpectralLevel level = theatre.world.spectra.level;
    return told(level == needed.level ? needed : NeededLevel{level, "as was asked"});
}

Device::Options device_options(bool windows)
{
    const char* validation = std::getenv("STARBOW_VALIDATION");
    const char* name = std::getenv("STARBOW_GPU");
    return {.windows = windows, .validation = validation && *validation == '1', .name = name ? name : ""};
}

Quality default_quality(const Device& device, bool still)
{
    Quality quality;
    if (still)
        quality = {.texels_per_pixel = 1.25, .max_texels_per_pixel = 8, .samples = 4, .shading_texels = 2};
    else if (device.on_processor())
        quality = {.texels_per_pixel = 0.8, .max_texels_per_pixel = 1.5, .samples = 1, .shading_texels = 64};
    else
        quality = {.texels_per_pixel = 1.25, .max_texels_per_pixel = 16, .samples = 4, .shading_texels = 16};
    // The atlas grows in steps of 256.
    quality.max_atlas_side = int(device.properties.limits.maxImageDimension2D) / 256 * 256;
    return quality;
}

} // namespace starbow
