#pragma once
#include "layout.h"
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace starbow {

/// The spectral level: the number of coefficients for reflected light. 3 are the base colours' own; 5 have the ultraviolet
/// and the infrared too; 12 are a spectrum. Lamps, glows and lines are exact at every level.
enum class SpectralLevel { colours, middle, fine };
constexpr std::array<const char*, 3> spectral_level_names = {"colours", "middle", "fine"};

/// The trade of speed for accuracy. It never changes the physics.
struct Quality {
    double texels_per_pixel = 1; ///< linear density of the cube map in the views
    double max_texels_per_pixel = 3; ///< area: a whole plan with more is drawn coarser
    int cube_samples = 1; ///< samples of each texel, for edges: 1, 2, 4 or 8
    double lod_error_texels = 1; ///< greatest error of surfaces in fewer triangles; 0: all triangles, always
    double lod_shading_texels = 16; ///< the same for their shading: a column keeps its flutes at 64 where they are some
                                    ///< texels wide, and loses them at 128
    double image_cost_texels = 4096; ///< the cost of one more image of the cube map, beside its texels: it decides the
                                     ///< number of images
    int pixel_rays = 1; ///< along each side of an output pixel; the square of it reads the cube map
    int clip_levels = 42; ///< nested images behind, at most; 0: one image covers everything behind
    bool mips = true; ///< for pixels that cover several texels
    bool half_floats = true; ///< light in 16 bits a number, else in 32
    bool matrices = true; ///< flat views by a matrix, else by a map as all other views
    int frames_per_cube = 1; ///< frames that share one cube map, while the axes of the cube map stay
    std::optional<SpectralLevel> spectra{}; ///< nullopt: as the scene needs
    std::optional<StereoMethod> stereo{}; ///< nullopt: as the layout has it

    // Limits of the device, not of a file.
    double max_texels = 24e6; ///< of a whole plan: some devices limit an image to 1 GiB, all samples counted
    int max_atlas_side = 16384; ///< of images, texels

    bool operator==(const Quality&) const = default;
};

/// Reads a quality. Throws InputError with file, line, JSON pointer, value and what would be right.
Quality load_quality(const std::filesystem::path& file);
/// The text of a file that load_quality reads as this quality.
std::string quality_text(const Quality& quality);

/// A level of the ladder: a quality with its time and its pictures' errors against the reference, as `starbow measure`
/// found them.
struct PresetLevel {
    Quality quality;
    double ms; ///< only the ratios between levels count
    double flip = 0, edges_px = 0;
};
/// Reads a ladder, from the fastest to the slowest. Throws InputError as load_quality does.
std::vector<PresetLevel> load_ladder(const std::filesystem::path& file);
std::string ladder_text(const std::vector<PresetLevel>& ladder);

/// A layout with a quality's stereo method, where the layout has two eyes and can have that method.
Layout with_stereo(Layout layout, const Quality& quality);

/// The differences from another quality, for people: "1.25 texels per pixel, 4 samples"; "" without any.
std::string differences(const Quality& quality, const Quality& other);

} // namespace starbow
