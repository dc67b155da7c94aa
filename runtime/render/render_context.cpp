#include "render_context.h"
#include "config/model/shipped.h"
#include "displays/compile/compiled_view.h"
#include "runtime/operation/progress.h"
#include "runtime/shadow/add_shadows.h"
#include "runtime/world/detail_cache.h"
#include "runtime/world/open_scene.h"
#include <cstdlib>

namespace starbow {

LoadedScene load_scene(const std::filesystem::path& file)
{
    SceneFile scene = open_scene(file);
    World world = load_world(scene, map_cache_folder());
    if (scene.stars && scene.stars->milky_way)
        bound_cache(map_cache_folder());
    Progress progress;
    const auto show = [&](double part) { progress.show("levels of detail of " + scene.name, part); };
    if (add_kept_detail_levels(world, map_cache_folder(), show))
        bound_cache(map_cache_folder());
    const auto show_shadows = [&](double part) { progress.show("shadows of " + scene.name, part); };
    if (add_shadows(world, scene, map_cache_folder(), show_shadows))
        bound_cache(map_cache_folder());
    std::vector<Star> stars;
    if (scene.stars)
        stars = stars_in_depth(*scene.stars);
    return {std::move(scene), std::move(world), std::move(stars)};
}

RenderContext::RenderContext(
    const std::filesystem::path& scene, const Device::Options& options, std::optional<SpectralLevel> level)
    : RenderContext(load_scene(scene), options, level)
{
}

RenderContext::RenderContext(LoadedScene&& loaded, const Device::Options& options, std::optional<SpectralLevel> level)
    : device(options)
    , pipelines(device)
    , world(upload(device, pipelines, std::move(loaded.world), loaded.scene, loaded.stars, level))
{
}

GpuWorld upload_scene(RenderContext& context, LoadedScene&& loaded, std::optional<SpectralLevel> level)
{
    return upload(context.device, context.pipelines, std::move(loaded.world), loaded.scene, loaded.stars, level);
}

std::string describe_light(const RenderContext& context)
{
    const NeededLevel needed = needed_level(context.world.world, context.world.scene);
    const SpectralLevel level = context.world.spectra.level;
    return describe(level == needed.level ? needed : NeededLevel{level, needed.spectra, "as requested"});
}

Device::Options device_options(bool windows)
{
    const char* validation = std::getenv("STARBOW_VALIDATION");
    const char* name = std::getenv("STARBOW_GPU");
    return {.windows = windows, .validation = validation && *validation == '1', .name = name ? name : ""};
}

Quality within(const Device& device, Quality quality)
{
    const vk::PhysicalDeviceLimits& limits = device.properties.limits;
    const auto counts = std::uint32_t(limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts);
    while (quality.cube_samples > 1 && !(counts & std::uint32_t(quality.cube_samples)))
        quality.cube_samples /= 2;
    // The atlas grows in steps of 256.
    quality.max_atlas_side = int(limits.maxImageDimension2D) / 256 * 256;
    return quality;
}

Quality default_quality(const Device& device, bool still)
{
    return within(device, load_quality(shipped_file("qualities", still || !device.on_processor() ? "fine" : "balanced")));
}

} // namespace starbow
