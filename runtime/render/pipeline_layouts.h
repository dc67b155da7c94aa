#pragma once
#include "device.h"

namespace starbow {

/// The layouts of descriptor sets, by their bindings, and of the pipelines that read them.
struct PipelineLayouts {
    explicit PipelineLayouts(const Device& device);

    vk::raii::DescriptorSetLayout eye_set
        = nullptr; ///< 0 constants, 1 instances, 2 visible, 3 columns of the spectra, 4 times
    vk::raii::DescriptorSetLayout material_set = nullptr; ///< 0 base, 1 emissive texture
    vk::raii::DescriptorSetLayout warp_set
        = nullptr; ///< 0 direction map, 1 atlas, 2 tiles, 3 rows of the response, 4 depth atlas, 5 picture of the stars, 6
                   ///< inverse of the direction map, 7 to 9 further atlases, 10 rows for emission basis spectra, 11
                   ///< coverage, 12 rest frames, 13 parts of layers, 14 the sky's panorama, 15 globes, 16 and 17 their maps,
                   ///< 18 their light, 19 the ring's profile, 20 the curve that shows everything at once
    vk::raii::DescriptorSetLayout star_set = nullptr; ///< 0 constants, 1 stars, 2 black bodies
    vk::raii::DescriptorSetLayout picture_set = nullptr; ///< 0 direction map, 1 panel, label or cube
    vk::raii::DescriptorSetLayout finish_set = nullptr; ///< 0 left, 1 right picture, 2 weights, 3 black level, 4 table
    vk::raii::DescriptorSetLayout overlay_set = nullptr; ///< 0 constants, 1 constellations
    vk::raii::PipelineLayout surface_layout = nullptr, warp_layout = nullptr, picture_layout = nullptr,
                             finish_layout = nullptr, star_layout = nullptr, ///< star_layout: warp_set, star_set
        overlay_layout = nullptr; ///< warp_set, overlay_set
};

} // namespace starbow
