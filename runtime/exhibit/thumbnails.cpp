#include "thumbnails.h"
#include "config/json/error.h"
#include "config/json/kept_file.h"
#include "config/json/reader.h"
#include "config/model/scene_file.h"
#include "config/model/shipped.h"
#include "runtime/flight/record.h"
#include "runtime/images/capture.h"
#include "runtime/render/offscreen.h"
#include "runtime/render/render_context.h"
#include "runtime/world/open_scene.h"
#include "session_content.h"
#include <algorithm>
#include <map>

namespace starbow {
namespace {

namespace fs = std::filesystem;

/// Another way of drawing is another version.
constexpr std::string_view version = "1";
/// Pixels are drawn this many times as fine in each direction, and averaged.
constexpr int finer = 2;

Layout layout_of()
{
    Layout layout;
    layout.outputs.resize(1);
    layout.outputs[0].name = "thumbnail";
    layout.outputs[0].size = finer * thumbnail_px;
    layout.outputs[0].viewports = {{.projection = Planar{60}}};
    return layout;
}

/// A digest of a world's scene and glTF. Its stars, globes and maps are left out: they change with the program.
std::uint64_t digest_of_world(const fs::path& scene)
{
    constexpr std::size_t most_bytes = std::size_t(1) << 30;
    return digest(read_whole(open_scene(scene).gltf, most_bytes, "a glTF file"),
        digest(read_whole(scene, most_bytes, "a scene"), digest(version)));
}

std::uint64_t digest_of_shot(const Shot& shot, std::uint64_t before)
{
    const auto& [scene, time, position, u, turned, effects, exposure_ev] = shot;
    std::vector<double> numbers{time, position.x, position.y, position.z, u.x, u.y, u.z, turned.w, turned.x, turned.y,
        turned.z, exposure_ev, double(effects.comparison)};
    for (const EffectEntry& one : all_effects)
        numbers.push_back(effects[one.which]);
    const std::span<const unsigned char> bytes = bytes_of(numbers);
    return digest(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()), before);
}

SessionContent content_of(const std::string& kind, const std::string& name, const Words& words)
{
    return kind == "tour" ? content_of_tour(name, words) : kind == "shot" ? content_of_shot(name) : content_of_scene(name);
}

/// Averages squares of pixels, in the encoded values.
std::vector<std::uint8_t> smaller(const std::vector<std::uint8_t>& rgba)
{
    std::vector<std::uint8_t> small;
    const std::size_t row = std::size_t(finer * thumbnail_px.x);
    for (std::size_t y = 0; y < std::size_t(thumbnail_px.y); ++y)
        for (std::size_t x = 0; x < std::size_t(thumbnail_px.x); ++x)
            for (std::size_t k = 0; k < 4; ++k) {
                int sum = 0;
                for (std::size_t i = 0; i < finer * finer; ++i)
                    sum += rgba[4 * ((finer * y + i / finer) * row + finer * x + i % finer) + k];
                small.push_back(std::uint8_t((sum + finer * finer / 2) / (finer * finer)));
            }
    return small;
}

/// The picture in a file; its size is 0 where the file is not there or can't be read.
SmallPicture picture_in(const fs::path& file)
{
    try {
        const auto [size, rgba] = read_png(file);
        SmallPicture picture{size, {}};
        for (std::size_t i = 0; i < rgba.size(); i += 4)
            picture.rgb.insert(picture.rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
        return picture;
    } catch (const InputError&) {
        return {};
    }
}

} // namespace

std::vector<Thumbnail> thumbnails(
    const fs::path& folder, const Words& words, const std::function<void(const std::string&)>& say)
{
    std::vector<Thumbnail> all;
    std::map<fs::path, std::uint64_t> worlds;
    for (const auto& [kind, files] : {std::pair{"scene", "scenes"}, {"tour", "tours"}, {"shot", "shots"}})
        for (const std::string& name : folder.empty() ? std::vector<std::string>() : shipped_names(files))
            try {
                SessionContent content = content_of(kind, name, words);
                if (!worlds.contains(content.scene))
                    worlds[content.scene] = digest_of_world(content.scene);
                const std::uint64_t key = digest_of_shot(content.start, worlds[content.scene]);
                all.push_back({kind, name, content.scene, content.start, folder / ("thumbnail-" + cache_key(key, ".png"))});
            } catch (const InputError& error) {
                say(one_line(error.what()) + "; the " + kind + " " + name + " has no small picture");
            }
    std::ranges::stable_sort(all, {}, &Thumbnail::scene);
    return all;
}

Thumbnails drawn_thumbnails(const fs::path& folder, const Words& words)
{
    Thumbnails all;
    try {
        for (const Thumbnail& one : thumbnails(folder, words, [](const std::string&) {}))
            if (SmallPicture picture = picture_in(one.file); picture.size.x > 0)
                all[one.kind + "/" + one.name] = std::move(picture);
    } catch (const std::exception&) {
        // Names alone are enough to choose from.
    }
    return all;
}

const SmallPicture* ThumbnailReader::find(const std::string& name)
{
    if (name.empty())
        return nullptr;
    if (read_)
        coming_ = std::async(std::launch::async, std::exchange(read_, {}));
    if (coming_.valid() && coming_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        here_ = coming_.get();
    const auto found = here_.find(name);
    return found == here_.end() ? nullptr : &found->second;
}

std::size_t draw_thumbnails(
    const std::vector<Thumbnail>& all, const std::function<void(const Thumbnail&, std::size_t)>& show)
{
    const Layout layout = layout_of();
    std::unique_ptr<RenderContext> context; // one world at a time
    fs::path shown;
    std::size_t drawn = 0;
    for (const Thumbnail& one : all) {
        std::error_code error;
        if (fs::is_regular_file(one.file, error))
            continue;
        show(one, std::size_t(&one - all.data()));
        fs::create_directories(one.file.parent_path(), error); // else the writer says so
        if (shown != one.scene) {
            context.reset();
            context = std::make_unique<RenderContext>(one.scene, device_options(false));
            shown = one.scene;
        }
        OffscreenRenderer renderer(
            context->device, context->pipelines, context->world, layout, default_quality(context->device, true), false);
        write_png(one.file, thumbnail_px, smaller(renderer.picture(one.shot)[0]));
        ++drawn;
    }
    return drawn;
}

} // namespace starbow
