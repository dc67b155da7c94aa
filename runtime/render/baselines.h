#pragma once
#include "cube_pass.h"
#include "offscreen.h"

namespace starbow {

/// Simple work that the passes of a frame are compared with, in the same run: ratios hold where a machine's speed drifts.

/// The same world as a plain perspective picture of the renderer's first view, which must be flat: no cube map, no warp.
class PlainPictureBaseline {
public:
    PlainPictureBaseline(
        Device& device, Pipelines& pipelines, const GpuWorld& world, const Quality& quality, OffscreenRenderer& of);

    /// Preparing, recording and drawing, ms.
    double ms(const Shot& shot);

private:
    Device& device_;
    OffscreenRenderer& of_;
    CubePass pass_;
};

/// The bare look-up of a cube map of 512 texels a side, through the renderer's first view.
class BareLookupBaseline {
public:
    BareLookupBaseline(Device& device, Pipelines& pipelines);

    double ms(OffscreenRenderer& of);

private:
    Device& device_;
    Pipelines& pipelines_;
    Image cube_, no_map_;
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::raii::DescriptorSet set_ = nullptr;
    vk::raii::Sampler sampler_ = nullptr;
};

/// The images of plans that no view requested, drawn one plan after the other, ms.
double draw_plans_ms(Device& device, CubePass& pass, std::span<const CubeMapPlan> plans, const EyeEvent& eye_event);

} // namespace starbow
