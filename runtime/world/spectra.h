#pragma once
#include "config/model/quality.h"
#include "config/model/scene_file.h"
#include "light_kinds.h"
#include "runtime/light/spectral_basis.h"
#include "shaders/shared_structs.h"
#include "world.h"
#include <array>
#include <optional>
#include <span>
#include <string>

namespace starbow {

/// By SpectralLevel: the greatest number of coefficients for the spectra that surfaces reflect.
constexpr std::array<int, 3> reflected_counts = {3, 5, 12};

/// The coarsest level that is exact for a world, because it has a coefficient for each spectrum that surfaces reflect; or
/// else the finest.
struct NeededLevel {
    SpectralLevel level = SpectralLevel::colours;
    int spectra = 3; ///< number of different spectra that surfaces reflect
    std::string why; ///< a sentence's subject and verb: a reason against the level before
};
/// A line for people.
std::string describe(const NeededLevel& needed);
NeededLevel needed_level(const World& world, const SceneFile& scene); ///< world: after place_bodies

/// A world's spectral data for the passes, as plain arrays.
struct Spectra {
    SpectralLevel level = SpectralLevel::colours;
    SpectralBasis basis;
    bool with_alpha = false; ///< PLACE_IN_GROUPS's: the world has blended surfaces
    int groups = 1; ///< number of groups of coefficients
    int kinds = 1; ///< number of kinds of spectra that illuminate surfaces; the first is sunlight
    std::vector<std::vector<LampKinds>> lamps; ///< [the scene's light][World::frames]
    bool matrices = false; ///< otherwise the coefficients are the colour itself, and its parts beyond the visible
    bool unshifted = false; ///< light is stored as its colour at D = 1, in one group
    double gain = 1; ///< unshifted: the greatest channel of light of any kind on white; of sunlight it is 1
    std::vector<glm::vec4> columns; ///< [set][kind][group][r, g, b, ultraviolet, infrared]; unshifted: after a colour for
                                    ///< each emission spectrum of the world's own

    struct Surface {
        glm::vec4 beyond; ///< SurfaceEntry's member
        double emission = 1; ///< the emissive colour's part in its coefficient
        glm::dvec4 own{0}; ///< glow: coefficients of the world's own emission spectra
    };
    std::vector<Surface> surfaces; ///< one for each material
    /// Coefficients of the sky's light: at the zenith, the horizon and the nadir; and of the Milky Way's red, green and
    /// blue.
    std::array<std::array<glm::dvec4, MAX_GROUPS>, 6> sky;
    double most = 0; ///< the greatest coefficient of the world's own emission spectra

    /// The place of the k-th coefficient: 4 * group + component.
    std::size_t place(std::size_t k) const { return std::size_t(PLACE_IN_GROUPS(k, with_alpha)); }
};

/// Computes a world's spectral data. world: after place_bodies. Throws InputError where a world has more emission spectra of
/// its own than MAX_OWN. It throws too where a spectral line illuminates a surface that moves relative to it.
Spectra spectra_of(const World& world, const SceneFile& scene, SpectralLevel level);

/// The colours of Spectra::sky, as those of sunlight on a surface.
std::array<glm::dvec3, 6> sky_colours(const SceneFile& scene);

/// The light that glossy surfaces of a rest frame reflect beside the lamps', as colours of sunlight: at the zenith, the
/// horizon and the nadir. In the world's frame it is the sky's gradient, if that is not black; else the ambient light from
/// all sides. Not the sky's stars, Milky Way, glow and globes.
std::array<glm::dvec3, 3> surroundings_of(const SceneFile& scene, int frame);

/// The same light, stored as its colour at D = 1: three numbers are exact where no observer shifts it. colours: of the
/// basis coefficients at D = 1 (Response::unshifted). None where the coefficients are such colours already, or the matrices
/// have no room.
std::optional<Spectra> unshifted(const Spectra& spectra, std::span<const glm::dvec3> colours);

} // namespace starbow
