#include "describe_quality.h"

namespace starbow {

void check(const Place& place, const Ladder& ladder, const Folder&)
{
    const std::vector<Place> places = elements(member(place, "levels"));
    const Quality& first = ladder.levels[0].quality;
    for (std::size_t i = 1; i < ladder.levels.size(); ++i) {
        const PresetLevel &level = ladder.levels[i], &before = ladder.levels[i - 1];
        if (level.ms <= before.ms)
            fail_at(member(places[i], "ms"),
                "is no more than the level's before, " + shown(before.ms)
                    + "; levels from the fastest to the slowest are right");
        if (level.quality.spectra != first.spectra || level.quality.stereo != first.stereo
            || level.quality.matrices != first.matrices)
            fail_at(member(places[i], "quality"),
                "has other spectra, stereo or matrices than the first level, which can't change in "
                "flight; the same are right");
    }
}

Quality load_quality(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    return read<Quality>(root(document));
}

std::string quality_text(const Quality& quality) { return written(quality).dump(4) + "\n"; }

std::vector<PresetLevel> load_ladder(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    return read<Ladder>(root(document)).levels;
}

std::string ladder_text(const std::vector<PresetLevel>& ladder) { return written(Ladder{ladder}).dump(4) + "\n"; }

Layout with_stereo(Layout layout, const Quality& quality)
{
    // A turning baseline needs reprojection.
    if (quality.stereo && !layout.stereo.turning)
        layout.stereo.method = *quality.stereo;
    return layout;
}

std::string differences(const Quality& quality, const Quality& other)
{
    std::string all;
    auto differs = [&](const auto& mine, const auto& its, const std::string& text) {
        if (mine != its)
            all += (all.empty() ? "" : ", ") + text;
    };
    auto count = [](int n, const std::string& one, const std::string& many) {
        return std::to_string(n) + " " + (n == 1 ? one : many);
    };
    const auto& [q, o] = std::tie(quality, other);
    differs(q.texels_per_pixel, o.texels_per_pixel,
        shown(q.texels_per_pixel) + (q.texels_per_pixel == 1 ? " texel" : " texels") + " along a pixel");
    differs(q.max_texels_per_pixel, o.max_texels_per_pixel, "at most " + shown(q.max_texels_per_pixel) + " in one");
    differs(q.cube_samples, o.cube_samples, count(q.cube_samples, "sample of a texel", "samples of a texel"));
    differs(q.lod_error_texels, o.lod_error_texels, "surfaces within " + shown(q.lod_error_texels) + " texels");
    differs(q.lod_shading_texels, o.lod_shading_texels, "shading within " + shown(q.lod_shading_texels) + " texels");
    differs(q.image_cost_texels, o.image_cost_texels, "an image for " + shown(q.image_cost_texels) + " texels");
    differs(q.pixel_rays, o.pixel_rays, count(q.pixel_rays * q.pixel_rays, "ray a pixel", "rays a pixel"));
    differs(q.clip_levels, o.clip_levels, count(q.clip_levels, "nested image behind", "nested images behind"));
    differs(q.mips, o.mips, q.mips ? "mips" : "no mips");
    differs(q.half_floats, o.half_floats, q.half_floats ? "16 bits a number" : "32 bits a number");
    differs(q.matrices, o.matrices, q.matrices ? "flat views by matrix" : "flat views by map");
    differs(q.frames_per_cube, o.frames_per_cube, "a cube map for " + count(q.frames_per_cube, "frame", "frames"));
    differs(q.spectra, o.spectra, "light: " + std::string(Named{&spectral_levels}.name_of(q.spectra)));
    differs(q.stereo, o.stereo, "stereo: " + std::string(Named{&quality_methods}.name_of(q.stereo)));
    return all;
}

} // namespace starbow
