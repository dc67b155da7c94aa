#pragma once
#include "config/model/quality.h"
#include "config/model/scene_file.h"
#include "runtime/light/spectral_basis.h"
#include "shaders/shared_structs.h"
#include "world.h"
#include <array>
#include <string>

namespace starbow {

/// Of each SpectralLevel.
constexpr std::array<int, 3> reflected_numbers = {3, 5, 12};

/// The coarsest level that is exact for a world, or the finest.
struct NeededLevel {
    SpectralLevel level = SpectralLevel::colours;
    std::string why; ///< a sentence's subject and verb: the first thing that the level before does not tell
};
/// As a line for people.
std::string describe(const NeededLevel& needed);
NeededLevel needed_level(const World& world, const SceneFile& scene); ///< world: after place_bodies

/// What the passes need to know of a world's spectra, as plain arrays.
struct Spectra {
    SpectralLevel level = SpectralLevel::colours;
    SpectralBasis basis;
    int groups = 1; ///< of four numbers
    int kinds = 1; ///< of spectra that shine on surfaces; the first is sunlight
    /// Which kinds a light is for what rests in one frame: the one that it is where it rests too, and, where it moves there,
    /// so many of shifted light, evenly spaced in log2 D, between two of which the shader blends.
    struct Lamp {
        int kind = 0, first_shift = 0, shifts = 0;
        double first_log2_D = 0, per_octave = 0;
    };
    std::vector<std::vector<Lamp>> lamps; ///< [the scene's light][World::frames]
    bool matrices = false; ///< otherwise its colour, and what it is beyond the visible, are its numbers
    std::vector<glm::vec4> columns; ///< [set][kind][group][r, g, b, ultraviolet, infrared]

    struct Surface {
        glm::vec4 beyond; ///< CubePush's member
        double emission = 1; ///< of the emissive colour that counts as its number
        glm::dvec4 own{0}; ///< glow, numbers of its own spectra
    };
    std::vector<Surface> surfaces; ///< of each material
    std::array<std::array<glm::dvec4, MAX_GROUPS>, 3> sky; ///< zenith, horizon, nadir: numbers
    double most = 0; ///< the greatest number of the world's own
};

/// world: after place_bodies. Throws InputError where a world has more spectra of its own than MAX_OWN, or a line shines
/// from something that moves on something that doesn't move with it.
Spectra spectra_of(const World& world, const SceneFile& scene, SpectralLevel level);

} // namespace starbow
