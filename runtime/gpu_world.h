#pragma once
#include "config/scene_file.h"
#include "pipelines.h"
#include "world.h"

namespace starbow {

/// A world on the device. The plain arrays of World that only it needs (vertices, indices, texels) are dropped.
struct GpuWorld {
    World world; ///< instances in drawing order
    SceneFile scene;
    double brightest = 1; ///< the greatest radiance of any surface, before any lamp comes closer than its distance

    Buffer vertices, indices;
    std::vector<Image> textures;
    std::vector<vk::raii::Sampler> samplers;
    Image white; ///< stands in where a material has no texture
    vk::raii::DescriptorPool pool = nullptr;
    std::vector<vk::raii::DescriptorSet> materials;

    SurfaceVariant variant(int material) const;
};

GpuWorld upload(Device& device, const Pipelines& pipelines, World world, const SceneFile& scene);

} // namespace starbow
