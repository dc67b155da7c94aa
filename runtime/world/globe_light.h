#pragma once
#include "config/model/solar_system.h"
#include "runtime/light/spectrum.h"
#include <map>

namespace starbow {

/// The kinds of light that globes send, as rows of the table that shaders/globes.glsl reads. A kind has GLOBE_LEVELS rows,
/// of light whose way leads through more and more air, (2^level - 1) / 2 vertical columns; of the Sun, from its limb (cosine
/// 0) to the middle of its disc; or one row and its copy.
struct GlobeRows {
    std::vector<Spectrum> spectra; ///< one for each row: radiance of a surface that scatters as white one does, in sunlight
                                   ///< at the Earth's distance; or of the Sun, or of lamps
    std::map<std::string, int> first; ///< row of each kind's level 0
    /// A globe's mean light, over that of a globe of the same scattering and geometric albedo 1: its first row.
    std::vector<int> means;
};
/// parts, clouds: as Globes has them.
GlobeRows globe_rows(const SolarSystem& system, std::span<const glm::dvec4> parts, double clouds);

/// Rows as a shader reads them, by log2 D (GLOBE_COLUMNS columns): Rec. 709 over a scale, and the scale's binary logarithm.
std::vector<glm::vec4> globe_light(const GlobeRows& rows, const StandardObserver& observer);

/// The colour of a row at D, as globes.glsl computes it.
glm::dvec3 globe_colour(std::span<const glm::vec4> texels, int row, double D);

/// The optical depth of the Earth's air from the ground upwards, which scatters light: Bodhaine and others, "On Rayleigh
/// optical depth calculations", 1999, equation 30.
double rayleigh_depth(double nm);

/// The Sun's radiance at a wavelength, and the cosine of the angle from its normal. Its mean over the disc is that of
/// sunlit_white over the square of its angular radius at the Earth's distance.
double sun_radiance(const SolarSystem& system, double radius_m, double cosine, double nm);

/// A globe's light at a phase angle, over that at 0: of its whole disc. Matt: Lambert's sphere; dusty: Lommel and
/// Seeliger's, and its measured dimming.
double phase_part(const Globe& globe, double phase_deg);
/// The factor of a dusty globe's surface, by which the whole disc has that light; otherwise 1.
double phase_dimming(const Globe& globe, double phase_deg);

} // namespace starbow
