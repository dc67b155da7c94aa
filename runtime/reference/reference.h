#pragma once
#include "config/model/scene_file.h"
#include "displays/finish/shade.h"
#include "runtime/images/capture.h"
#include "runtime/world/stars.h"
#include "runtime/world/world.h"
#include <filesystem>
#include <functional>

namespace starbow {

/// The reference picture for the live one, without cube map and device. Each pixel has rays along the exactly transformed
/// direction, in double, with whole spectra. It shares with the live picture the scene's loading and the formulas of
/// shaders/physics.
struct ReferenceInput {
    const World& world; ///< after place_bodies
    const SceneFile& scene;
    const std::vector<Star>& stars; ///< of the scene's catalogue; used only where the scene has a sky of stars
};

/// A world prepared for the reference.
struct ReferenceWorld {
    SceneFile scene;
    World world;
    std::vector<Star> stars;
    ReferenceInput input() const { return {world, scene, stars}; }
};
/// Opens a scene and its world. Throws InputError.
ReferenceWorld open_reference_world(const std::filesystem::path& scene);

/// One output, rows from the top.
struct Reference {
    /// The numbers at a pixel's centre, in the left eye's picture: an EXR's channels (docs/files.md).
    struct Numbers {
        glm::dvec3 camera, world; ///< unit directions, axes of the observer and of the world
        glm::dvec3 across; ///< the part of `world` at right angles to the observer's motion; at rest, all of it
        double D, distance;
        bool shown; ///< false: the other members are unset
        glm::dvec3 glare{0}; ///< the part of `light` that an eye's glare adds or takes, which an EXR lacks
    };
    glm::ivec2 size{0};
    std::vector<std::vector<glm::dvec3>> light; ///< by picture: one, or two where eyes share pixels. Rec. 709 linear,
                                                ///< exposed, before the tone curve; 0 where nothing is shown.
                                                ///< Of overlapping viewports it is that of the largest part
    std::vector<std::vector<glm::dvec3>> screens; ///< by picture, where viewports overlap: their light together, after the
                                                  ///< tone curve; otherwise empty
    std::vector<Numbers> numbers; ///< where options requested them
    double exposure = 1; ///< that `light` was multiplied by
    Packing packing = Packing::mono;
    Colour colour;
    Shade shade;
    double headroom = 1;
};

struct ReferenceOptions {
    int samples = 16; ///< rays of a pixel, at the same places in each pixel; at least 1
    bool numbers = true; ///< false: `numbers` stays empty
    std::function<void(int done, int rows)> progress{}; ///< after each row, from any thread, one at a time
    std::filesystem::path kept{}; ///< a file of finished rows, from which an interrupted picture goes on; rows of another
                                  ///< picture are dropped. Empty: none
};

/// Draws an output of the layout. The bytes do not depend on the number of threads or on interruptions. Throws InputError
/// for wrong files of the layout. options.kept stays, for the caller to remove once the picture is written.
Reference reference(const ReferenceInput& input, const Layout& layout, const Shot& shot, std::size_t output,
    const ReferenceOptions& options = {});

/// The picture as a screen gets it: tone curve, both eyes combined, blend and colour, the screen's curve; RGBA8, rounded,
/// not dithered.
std::vector<std::uint8_t> shown(const Reference& reference);

/// An EXR's channels, as OffscreenRenderer::numbers has them: light before exposure.
Channels channels(const Reference& reference);

} // namespace starbow
