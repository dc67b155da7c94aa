#pragma once
#include "config/model/scene_file.h"
#include "displays/finish/shade.h"
#include "runtime/images/capture.h"
#include "runtime/world/stars.h"
#include "runtime/world/world.h"
#include <filesystem>
#include <functional>

namespace starbow {

/// The picture as it is by definition, to hold the live one against: for every pixel rays along the exactly transformed
/// direction, in double, with whole spectra; no cube map, no device. It shares the scene's loading and the formulas of
/// shaders/physics with the live picture.
struct ReferenceInput {
    const World& world; ///< after place_bodies
    const SceneFile& scene;
    const std::vector<Star>& stars; ///< of the scene's catalogue; counted only where the scene has a sky of stars
};

/// A world made ready for it.
struct ReferenceWorld {
    SceneFile scene;
    World world;
    std::vector<Star> stars;
    ReferenceInput input() const { return {world, scene, stars}; }
};
/// Throws InputError.
ReferenceWorld open_reference_world(const std::filesystem::path& scene);

/// One output, rows from the top.
struct Reference {
    /// At a pixel's centre, of the left eye's picture: as an EXR has them (docs/files.md).
    struct Numbers {
        glm::dvec3 camera, world; ///< unit directions, axes of the observer and of the world
        double D, distance;
        bool shown; ///< otherwise the rest is nothing
    };
    glm::ivec2 size{0};
    std::vector<std::vector<glm::dvec3>> light; ///< of each picture: one, or two where eyes share pixels. Rec. 709 linear,
                                                ///< exposed, before the tone curve; 0 where nothing is shown
    std::vector<Numbers> numbers; ///< where they were asked for
    double exposure = 1; ///< that `light` was multiplied by
    Packing packing = Packing::mono;
    Colour colour;
    Shade shade;
    double headroom = 1;
};

struct ReferenceOptions {
    int samples = 16; ///< rays of a pixel, the same places in each; at least 1
    bool numbers = true; ///< whether they are found too
    std::function<void(int done, int rows)> progress{}; ///< after each row, from any thread, one at a time
    std::filesystem::path kept{}; ///< a file of finished rows, from which an interrupted picture goes on; of one made from
                                  ///< other things none are taken. Empty: none
};

/// Draws an output of the layout. The same bytes whatever the number of threads, and whether it was interrupted or not.
/// Throws InputError for wrong files of the layout. Leaves options.kept to who calls, to remove it once the picture is
/// written.
Reference reference(const ReferenceInput& input, const Layout& layout, const Shot& shot, std::size_t output,
    const ReferenceOptions& options = {});

/// As a screen gets it: tone curve, both eyes put together, blend and colour, its curve; RGBA8, rounded, not dithered.
std::vector<std::uint8_t> shown(const Reference& reference);

/// An EXR's channels, as OffscreenRenderer::numbers has them: light before exposure.
Channels channels(const Reference& reference);

} // namespace starbow
