#pragma once
#include "device.h"
#include "gpu_world.h"
#include "pipelines.h"
#include "runtime/plan/cube_map_plan.h"
#include <filesystem>
#include <string>

namespace starbow {

/// What every command opens first: the device and one world on it.
struct RenderContext {
    Device device;
    Pipelines pipelines;
    GpuWorld world;

    /// Reads scene and world before it touches the device, so that a wrong file is told first.
    /// level: of the light; none: what the world needs.
    RenderContext(
        const std::filesystem::path& scene, const Device::Options& options, std::optional<SpectralLevel> level = {});

private:
    RenderContext(struct LoadedScene&& loaded, const Device::Options& options, std::optional<SpectralLevel> level);
};

/// How the scene's light is told, and why: a line for the log.
std::string describe_light(const RenderContext& context);

/// Device options as the environment asks: STARBOW_VALIDATION=1, STARBOW_GPU=part of a name.
Device::Options device_options(bool windows);

/// A quality as far as a device can have it.
Quality within(const Device& device, Quality quality);
/// The shipped quality that counts where none is asked for: `fine` for stills and on a GPU, `balanced` in software.
Quality default_quality(const Device& device, bool still);

} // namespace starbow
