#include "quality.h"
#include "config/json/reader.h"
#include <vector>

namespace starbow {
namespace {

const std::vector<std::pair<std::string_view, std::optional<SpectralLevel>>> levels = {
    {"needed", {}}, {"colours", SpectralLevel::colours}, {"middle", SpectralLevel::middle}, {"fine", SpectralLevel::fine}};
const std::vector<std::pair<std::string_view, std::optional<StereoMethod>>> methods = {{"layout", {}},
    {"shared", StereoMethod::shared}, {"exact", StereoMethod::exact}, {"reprojected", StereoMethod::reprojected}};

template <class Value>
std::string name_of(const Value& value, const std::vector<std::pair<std::string_view, Value>>& choices)
{
    return std::string(
        std::find_if(choices.begin(), choices.end(), [&](const auto& c) { return c.second == value; })->first);
}

void take_whole(const Place& place, const std::string& name, int& value, int low, int high)
{
    if (auto p = find_member(place, name))
        value = integer(*p, low, high);
}

Quality read_quality(const Place& top)
{
    reject_unknown_members(top,
        {"$schema", "texels_per_pixel", "max_texels_per_pixel", "cube_samples", "lod_error_texels", "lod_shading_texels",
            "image_cost_texels", "pixel_rays", "clip_levels", "mips", "half_floats", "matrices", "frames_per_cube",
            "spectra", "stereo"});
    Quality quality;
    take(top, "texels_per_pixel", quality.texels_per_pixel, {0.05, 16});
    take(top, "max_texels_per_pixel", quality.max_texels_per_pixel, {0.05, 1000});
    take_whole(top, "cube_samples", quality.cube_samples, 1, 8);
    if (quality.cube_samples & (quality.cube_samples - 1))
        complain(member(top, "cube_samples"), "is not a number of samples that devices have; 1, 2, 4 or 8 is right");
    take(top, "lod_error_texels", quality.lod_error_texels, {0, 100});
    take(top, "lod_shading_texels", quality.lod_shading_texels, {0, 1000});
    take(top, "image_cost_texels", quality.image_cost_texels, {0, 1e12});
    take_whole(top, "pixel_rays", quality.pixel_rays, 1, 8);
    take_whole(top, "clip_levels", quality.clip_levels, 0, 42);
    take(top, "mips", quality.mips);
    take(top, "half_floats", quality.half_floats);
    take(top, "matrices", quality.matrices);
    take_whole(top, "frames_per_cube", quality.frames_per_cube, 1, 60);
    if (auto p = find_member(top, "spectra"))
        quality.spectra = chosen(*p, levels);
    if (auto p = find_member(top, "stereo"))
        quality.stereo = chosen(*p, methods);
    return quality;
}

nlohmann::ordered_json json_of(const Quality& quality)
{
    return {{"texels_per_pixel", quality.texels_per_pixel}, {"max_texels_per_pixel", quality.max_texels_per_pixel},
        {"cube_samples", quality.cube_samples}, {"lod_error_texels", quality.lod_error_texels},
        {"lod_shading_texels", quality.lod_shading_texels}, {"image_cost_texels", quality.image_cost_texels},
        {"pixel_rays", quality.pixel_rays}, {"clip_levels", quality.clip_levels}, {"mips", quality.mips},
        {"half_floats", quality.half_floats}, {"matrices", quality.matrices}, {"frames_per_cube", quality.frames_per_cube},
        {"spectra", name_of(quality.spectra, levels)}, {"stereo", name_of(quality.stereo, methods)}};
}

} // namespace

Quality load_quality(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    return read_quality(root(document));
}

std::string quality_text(const Quality& quality) { return json_of(quality).dump(4) + "\n"; }

std::vector<PresetLevel> load_ladder(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    const Place top = root(document);
    reject_unknown_members(top, {"$schema", "levels"});
    std::vector<PresetLevel> ladder;
    for (const Place& place : items(member(top, "levels"), 1, 100, "qualities")) {
        reject_unknown_members(place, {"quality", "ms", "flip", "edges_px"});
        PresetLevel level{read_quality(member(place, "quality"))};
        level.ms = number(member(place, "ms"), {0, 1e6, true});
        take(place, "flip", level.flip, {0, 1});
        take(place, "edges_px", level.edges_px, {0, 1e4});
        if (!ladder.empty() && level.ms <= ladder.back().ms)
            complain(member(place, "ms"),
                "is no more than the level's before, " + shown(ladder.back().ms)
                    + "; levels from the fastest to the slowest are right");
        if (!ladder.empty()
            && (level.quality.spectra != ladder[0].quality.spectra || level.quality.stereo != ladder[0].quality.stereo
                || level.quality.matrices != ladder[0].quality.matrices))
            complain(member(place, "quality"),
                "has other spectra, stereo or matrices than the first level, which can't change in "
                "flight; the same are right");
        ladder.push_back(level);
    }
    return ladder;
}

std::string ladder_text(const std::vector<PresetLevel>& ladder)
{
    nlohmann::ordered_json levels = nlohmann::ordered_json::array();
    for (const PresetLevel& level : ladder)
        levels.push_back(
            {{"ms", level.ms}, {"flip", level.flip}, {"edges_px", level.edges_px}, {"quality", json_of(level.quality)}});
    return nlohmann::ordered_json{{"levels", levels}}.dump(4) + "\n";
}

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
    differs(q.spectra, o.spectra, "light: " + name_of(q.spectra, levels));
    differs(q.stereo, o.stereo, "stereo: " + name_of(q.stereo, methods));
    return all;
}

} // namespace starbow
