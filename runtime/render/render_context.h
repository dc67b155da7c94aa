#pragma once
#include "device.h"
#include "gpu_world.h"
#include "pipelines.h"
#include "runtime/plan/cube_map_plan.h"
#include <filesystem>
#include <string>

namespace starbow {

/// A scene's files, read, before they are on a device.
struct LoadedScene {
    SceneFile scene;
    World world;
    std::vector<Star> stars;
};

/// Reads a scene's files; it needs no device. Throws InputError.
LoadedScene load_scene(const std::filesystem::path& scene);

/// The device and one world on it, which most commands open first.
struct RenderContext {
    Device device;
    Pipelines pipelines;
    GpuWorld world;

    /// Reads scene and world before it touches the device, so that errors in the files come first. level: of the light;
    /// none: the level that the world needs. Throws InputError.
    RenderContext(
        const std::filesystem::path& scene, const Device::Options& options, std::optional<SpectralLevel> level = {});

private:
    RenderContext(LoadedScene&& loaded, const Device::Options& options, std::optional<SpectralLevel> level);
};

/// Another world on an open device, to take RenderContext::world's place. Throws InputError.
GpuWorld upload_scene(RenderContext& context, LoadedScene&& loaded, std::optional<SpectralLevel> level = {});

/// The scene's spectral level with its reason: a line for the log.
std::string describe_light(const RenderContext& context);

/// Device options from the environment: STARBOW_VALIDATION=1, STARBOW_GPU=part of a name.
Device::Options device_options(bool windows);

/// A quality reduced to a device's limits.
Quality within(const Device& device, Quality quality);
/// The default quality: `fine` for stills and on a GPU, `balanced` in software.
Quality default_quality(const Device& device, bool still);

} // namespace starbow
