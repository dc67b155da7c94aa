#pragma once
#include "config/model/scene_file.h"
#include "pipelines.h"
#include "runtime/light/response.h"
#include "runtime/plan/star_cull.h"
#include "runtime/world/spectra.h"
#include "runtime/world/stars.h"
#include "runtime/world/world.h"

namespace starbow {

/// What an observer sees of a world's numbers, Response on the device, and of its stars.
struct ResponseBuffers {
    Buffer rows;
    vk::raii::BufferView texels = nullptr; ///< of rows
    float first_log2_D = 0, per_octave = 1;
    Buffer own_rows;
    Buffer black_bodies; ///< the table of black_body_table
};

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

    std::uint32_t star_count = 0;
    std::vector<StarPatch> star_patches;
    Buffer stars; ///< StarEntry each; null without stars

    Spectra spectra;
    Buffer columns; ///< of spectra
    ResponseBuffers eye, false_colours;

    const ResponseBuffers& response(const Effects& on) const { return on.false_colours ? false_colours : eye; }
    bool layered() const { return world.frames.size() > 1; } ///< something may move
    CoefficientCounts numbers() const { return {spectra.basis.reflected, int(spectra.basis.own.size())}; }
    /// plain: drawn as colours alone, whatever the spectra.
    SurfaceVariant variant(int material, bool plain = false) const;
};

/// Another level in its place. No frame of this world must be under way, and none is drawn by a Frame from before. Throws
/// InputError, before anything is changed, for a world with too many spectra of its own.
void put_spectra(Device& device, GpuWorld& world, SpectralLevel level);

/// stars: of the scene's catalogue; counted only where the scene has a sky of stars.
/// level: none: as needed_level says. Throws InputError as put_spectra does.
GpuWorld upload(Device& device, const Pipelines& pipelines, World world, const SceneFile& scene,
    const std::vector<Star>& stars = {}, std::optional<SpectralLevel> level = {});

/// Other stars in their place, none too. No frame of this world must be under way, and none is drawn by a Frame from before.
void put_stars(Device& device, GpuWorld& world, const std::vector<Star>& stars);

} // namespace starbow
