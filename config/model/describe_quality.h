#pragma once
#include "config/json/describe.h"
#include "quality.h"

namespace starbow {

// Quality files and ladders, as config/json/describe.h says.

inline const std::vector<std::pair<std::string_view, std::optional<SpectralLevel>>> spectral_levels{
    {"needed", {}}, {"colours", SpectralLevel::colours}, {"middle", SpectralLevel::middle}, {"fine", SpectralLevel::fine}};
inline const std::vector<std::pair<std::string_view, std::optional<StereoMethod>>> quality_methods{{"layout", {}},
    {"shared", StereoMethod::shared}, {"exact", StereoMethod::exact}, {"reprojected", StereoMethod::reprojected}};

/// A number of samples that devices have.
struct SampleCount {
    int read(const Place& place, const Folder&) const
    {
        for (const int count : {1, 2, 4, 8})
            if (*place.json == count)
                return count;
        fail_at(place, "is not a number of samples that devices have; 1, 2, 4 or 8 is right");
    }
    Json written(int count) const { return count; }
    Json schema(Json&) const { return {{"enum", {1, 2, 4, 8}}}; }
};

template <>
inline constexpr auto description<Quality> = describe_file<Quality>("quality",
    "The trade-off of speed and accuracy. It never changes the physics.",
    field("texels_per_pixel", Number{{0.05, 16}},
        "Linear density of the cube map in the views: texels along an output pixel.", &Quality::texels_per_pixel),
    field("max_texels_per_pixel", Number{{0.05, 1000}},
        "The limit of texels for each output pixel, over the whole cube map: beyond it the whole cube map is drawn coarser.",
        &Quality::max_texels_per_pixel),
    field("cube_samples", SampleCount{},
        "Samples of each texel, for edges. If the GPU lacks that number, the next smaller one is used. No unit.",
        &Quality::cube_samples),
    field("lod_error_texels", Number{{0, 100}},
        "The greatest error, in texels, of far surfaces drawn with fewer triangles; 0: always all triangles.",
        &Quality::lod_error_texels),
    field("lod_shading_texels", Number{{0, 1000}},
        "The greatest width, in texels, over which such a surface's shading may differ: 64 keeps a column's flutes, 128 "
        "loses "
        "them.",
        &Quality::lod_shading_texels),
    field("image_cost_texels", Number{{0, 1e12}},
        "The cost of one more image of the cube map beside its own texels, in texels. With a lower cost the cube map is "
        "divided "
        "more finely, and each image is closer to the resolution needed there.",
        &Quality::image_cost_texels),
    field("pixel_rays", Whole{1, 8},
        "Rays along each side of an output pixel; the square of this number of rays reads the cube map. No unit.",
        &Quality::pixel_rays),
    field("clip_levels", Whole{0, 42},
        "The greatest number of nested, finer images behind. 0: one image covers everything behind. No unit.",
        &Quality::clip_levels),
    field("mips", Flag{}, "true: the cube map also has mips, for pixels that cover several texels.", &Quality::mips),
    field("half_floats", Flag{}, "true: each coefficient of the light has 16 bits; false: 32.", &Quality::half_floats),
    field("matrices", Flag{},
        "true: flat views are represented by a matrix; false: by a direction map, as every other view. With a head tracker "
        "they "
        "always have a matrix.",
        &Quality::matrices),
    field("frames_per_cube", Whole{1, 60},
        "The number of frames that show one cube map, while the direction of motion stays. No unit.",
        &Quality::frames_per_cube),
    field("spectra", Named{&spectral_levels},
        "The number of coefficients for reflected light: 3 (colours), 5 (middle), 12 (fine), or as many as the scene needs.",
        &Quality::spectra),
    field("stereo", Named{&quality_methods}, "The stereo method; left out, the layout's.", &Quality::stereo),
    not_in_file(&Quality::max_texels, &Quality::max_atlas_side));
static_assert(is_complete<Quality>());

template <>
inline constexpr auto description<PresetLevel> = describe<PresetLevel>("level",
    "A quality with its time and its pictures' errors against the reference, as starbow measure found them.",
    needed("ms", Number{{0, 1e6, true}}, "The time of a frame, milliseconds; only the ratios between levels count.",
        &PresetLevel::ms),
    field("flip", Number{{0, 1}}, "The mean FLIP error against the reference. No unit.", &PresetLevel::flip),
    field("edges_px", Number{{0, 1e4}}, "The mean displacement of edges, pixels.", &PresetLevel::edges_px),
    needed("quality", Object<Quality>{}, "", &PresetLevel::quality));
static_assert(is_complete<PresetLevel>());

struct Ladder {
    std::vector<PresetLevel> levels;
};
template <>
inline constexpr auto description<Ladder> = describe_file<Ladder>("ladder",
    "Qualities from the fastest to the slowest, between which an exhibit with a frame_budget_ms moves.",
    needed(
        "levels", List{Object<PresetLevel>{}, 1, 100, "qualities"}, "The qualities, the fastest first.", &Ladder::levels));
static_assert(is_complete<Ladder>());
/// Throws unless the levels become slower, and differ in nothing that can't change in flight.
void check(const Place& place, const Ladder& ladder, const Folder&);

} // namespace starbow
