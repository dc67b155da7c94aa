#pragma once
#include "config/model/scene_file.h"
#include "gpu_globes.h"
#include "pipelines.h"
#include "runtime/light/light_bound.h"
#include "runtime/world/sky_names.h"
#include "runtime/world/spectra.h"
#include "runtime/world/stars.h"
#include "runtime/world/world.h"
#include <map>

namespace starbow {

/// Response tables of one standard observer on the device, for basis coefficients and for stars.
struct ResponseBuffers {
    Buffer rows;
    vk::raii::BufferView texels = nullptr; ///< rows as texels
    Image picture; ///< the rows for the device's sampler; none where the processor draws
    float at_rest = 0, octave = 1; ///< of the table's width: the place of D = 1, and an octave of D
    float last_log2_D = 0; ///< of its last row
    Buffer own_rows;
    Buffer black_bodies; ///< made by black_body_table
    LightBound greatest;
};

/// The numbers that a cube map holds of a surface's light: basis coefficients, which have a colour at every D; or the colour
/// at D = 1, which is exact where no observer shifts light; or the plain base colours, whatever the spectra.
enum class StoredLight { coefficients, unshifted, plain };

/// A world on the device. Arrays that only the device needs (vertices, indices, texels) are dropped from World.
struct GpuWorld {
    World world; ///< instances in drawing order
    SceneFile scene;
    double brightest = 1; ///< the greatest radiance of any surface that counts in the range of stored light

    Buffer vertices, indices;
    Buffer deforming; ///< World::deforming; of one row without
    Buffer vertex_maps; ///< none where no material needs them
    MemoryArena texture_memory;
    std::vector<Image> textures; ///< in texture_memory
    std::map<Sampler, vk::raii::Sampler> samplers; ///< one for all textures that are sampled alike
    Image white; ///< for materials without a texture
    Image gloss_table; ///< gloss_table(); white where no material has gloss
    vk::raii::Sampler gloss_sampler = nullptr;
    Buffer surfaces; ///< a MaterialEntry for each material, and an empty one for the sky, in steps of surface_stride
    vk::DeviceSize surface_stride = 0;
    vk::raii::DescriptorPool pool = nullptr;
    std::vector<vk::raii::DescriptorSet> material_sets; ///< materials with the same pictures share one
    std::vector<std::size_t> set_of_material; ///< index of `material_sets`; last the sky's, which is like a material
    /// The surfaces of a set have one variant, which does what any of them needs: a draw for each variant would cost more.
    struct Needs {
        bool light = false, colours = false; ///< some emit light; some have colours at their corners
    };
    std::vector<Needs> needs_of_set;

    int shadows = 0; ///< SurfaceVariant::shadows of still surfaces
    int point_lamps = 0; ///< SurfaceVariant's, of surfaces that lamps illuminate
    Image shadow_maps, sky_cells; ///< of World::shadows, which has no texels any more; one texel without shadows
    vk::raii::Sampler nearest_sampler = nullptr, sky_sampler = nullptr; ///< theirs

    StarField stars; ///< empty without stars
    SkyNames sky_names;
    bool as_gpu = false; ///< Device::draws_as_gpu when it was uploaded
    std::unique_ptr<GpuGlobes> globes; ///< null: none

    Spectra spectra;
    std::optional<Spectra> unshifted; ///< the same light as colours at D = 1; see starbow::unshifted
    Buffer columns, unshifted_columns; ///< the matrix columns of both
    ResponseBuffers eye, false_colours;

    const ResponseBuffers& response(const Effects& on) const { return on[Effect::false_colours] ? false_colours : eye; }
    bool several_rest_frames() const { return world.frames.size() > 1; } ///< something may move
    /// The least numbers that are exact under the effects.
    StoredLight stored_light(const Effects& on) const
    {
        return unshifted && !on[Effect::doppler] && !on[Effect::false_colours] ? StoredLight::unshifted
                                                                               : StoredLight::coefficients;
    }
    /// The sky's picture and its sampler; white where it has none.
    const Image& milky_way() const { return world.milky_way < 0 ? white : textures[std::size_t(world.milky_way)]; }
    const vk::raii::Sampler& milky_way_sampler() const
    {
        return samplers.at(world.milky_way < 0 ? Sampler{} : world.textures[std::size_t(world.milky_way)].sampler);
    }
    const Spectra& spectra_of(StoredLight light) const { return light == StoredLight::unshifted ? *unshifted : spectra; }
    /// The numbers that a texel of the cube map holds.
    CoefficientCounts coefficients(StoredLight light) const
    {
        CoefficientCounts counts;
        if (light == StoredLight::coefficients) {
            counts.reflected = spectra.basis.reflected, counts.own = int(spectra.basis.own.size());
            counts.with_alpha = spectra.with_alpha && counts.reflected + counts.own > 3;
        }
        return counts;
    }
    SurfaceVariant variant(int material, StoredLight light) const;
};

/// The sky's constants for the passes. cube_from_frame: the turn to the axes of the world's cube map.
shared::SkyConstants sky_constants(
    const GpuWorld& world, StoredLight light, const glm::dmat3& cube_from_frame, double pre_exposure);

/// Sets another spectral level. No frame of this world may be under way, and FrameRenderers made before must not draw it.
/// Throws InputError, before anything is changed, for a world with too many emission basis spectra.
void put_spectra(Device& device, GpuWorld& world, SpectralLevel level);

/// stars: the scene's catalogue, used only if the scene has a sky of stars. level: none: as needed_level says. Throws
/// InputError as put_spectra does.
GpuWorld upload(Device& device, Pipelines& pipelines, World world, const SceneFile& scene,
    const std::vector<Star>& stars = {}, std::optional<SpectralLevel> level = {});

/// Replaces the stars; the list may be empty. No frame of this world may be under way, and FrameRenderers made before
/// must not draw it.
void put_stars(GpuWorld& world, const std::vector<Star>& stars);

} // namespace starbow
