#pragma once
#include "layout.h"
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace starbow {

/// How finely light that surfaces reflect is told, in numbers: 3, the base colours' own; 5, with the ultraviolet and the
/// infrared; 12, a spectrum. Lamps, glows and lines are exact at every level.
enum class SpectralLevel { colours, middle, fine };
constexpr std::array<const char*, 3> spectral_level_names = {"colours", "middle", "fine"};

/// The trade of speed for accuracy: what a frame may spend. It never changes the physics.
struct Quality {
    double texels_per_pixel = 1; ///< linear density of the cube map where it is looked at
    double max_texels_per_pixel = 3; ///< area: where the whole plan would hold more, all of it is drawn coarser
    int cube_samples = 1; ///< of each texel, for edges: 1, 2, 4 or 8
    double lod_error_texels = 1; ///< how far surfaces in fewer triangles may stray; 0: all triangles, always
    double lod_shading_texels = 16; ///< and as far what a vertex shades otherwise may lie from the next one that is drawn; a
                                ///< surface of 64 keeps its flutes where they are some texels wide, one of 128 loses them
    double image_cost_texels = 4096; ///< what one more image of the cube map costs beside its texels: how finely it is cut
    int pixel_rays = 1; ///< along each side of an output pixel: its square look up the cube map
    int clip_levels = 42; ///< nested ones behind, at most: with none of them, one image holds all that lies behind
    bool mips = true; ///< where several texels fall into one pixel
    bool half_floats = true; ///< light in 16 bits a number, else in 32
    bool matrices = true; ///< flat views are told by a matrix, else by a map as all others are
    int frames_per_cube = 1; ///< the cube map is drawn anew in each of so many, while the direction of motion stays
    std::optional<SpectralLevel> spectra{}; ///< none: as the scene needs
    std::optional<StereoMethod> stereo{}; ///< none: as the layout has it

    // Of the device, not of a file.
    double max_texels = 24e6; ///< of a whole plan: some devices end an image at 1 GiB, all samples counted
    int max_atlas_side = 16384; ///< of images, texels

    bool operator==(const Quality&) const = default;
};

/// Reads a quality. Throws InputError with file, line, JSON pointer, value and what would be right.
Quality load_quality(const std::filesystem::path& file);
/// The file that load_quality reads as this.
std::string quality_text(const Quality& quality);

/// One quality of a ladder that a frame's time is held by: what it takes, and how far its pictures are from the reference,
/// as `starbow measure` found them.
struct PresetLevel {
    Quality quality;
    double ms; ///< only how they stand to each other counts
    double flip = 0, edges_px = 0;
};
/// From the fastest to the slowest. Throws InputError as load_quality does.
std::vector<PresetLevel> load_ladder(const std::filesystem::path& file);
std::string ladder_text(const std::vector<PresetLevel>& ladder);

/// A layout with the stereo method that a quality asks for, where it has two eyes and can have that.
Layout with_stereo(Layout layout, const Quality& quality);

/// What differs from another quality, for people: "1.25 texels per pixel, 4 samples"; "" where nothing does.
std::string differences(const Quality& quality, const Quality& other);

} // namespace starbow
