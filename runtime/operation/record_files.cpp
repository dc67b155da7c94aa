#include "record_files.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include "config/model/scene_file.h"
#include "config/model/shipped.h"
#include "runtime/world/open_scene.h"
#include <array>

namespace starbow {
namespace fs = std::filesystem;
namespace {

/// No file of a scene or a layout may be larger (runtime/world/gltf/file.h).
constexpr std::uintmax_t most_bytes = std::uintmax_t(1) << 30;

std::uint64_t digest_of_scene(const fs::path& scene) { return digest_of({scene, open_scene(scene).gltf}); }

/// Names a shipped file by its name, which holds in any checkout, and other files by their whole path.
std::string name_of(const std::string& kind, const fs::path& file)
{
    std::error_code error;
    if (fs::equivalent(file.parent_path(), home() / "config" / kind, error))
        return file.stem().string();
    return fs::absolute(file).lexically_normal().string();
}

} // namespace

std::uint64_t digest_of(const std::vector<fs::path>& files)
{
    std::uint64_t sum = digest(std::string_view());
    std::vector<char> piece(1 << 16);
    for (const fs::path& file : files) {
        RegularFile stream(file);
        if (stream.size() > most_bytes)
            throw InputError(one_line(file.string()), "", "is larger than 1 GiB; a smaller file is right");
        while (const std::size_t got = stream.read(piece))
            sum = digest({piece.data(), got}, sum);
    }
    return sum;
}

std::vector<fs::path> files_of(const Layout& layout)
{
    std::vector<fs::path> files;
    auto add = [&](const fs::path& file) {
        if (!file.empty())
            files.push_back(file);
    };
    add(layout.file);
    for (const Output& output : layout.outputs)
        for (const Viewport& viewport : output.viewports) {
            if (viewport.warp) {
                add(viewport.warp->file);
                add(viewport.warp->frustum);
            }
            add(viewport.alpha_mask);
            add(viewport.black_level);
        }
    return files;
}

RecordHeader header_of(const fs::path& scene, const Layout& layout, const Shot& start, const Flying& rules,
    const Exposing& exposing, const std::string& pattern)
{
    return {.scene = name_of("scenes", scene),
        .layout = name_of("layouts", layout.file),
        .scene_digest = digest_of_scene(scene),
        .layout_digest = digest_of(files_of(layout)),
        .pattern = pattern,
        .seconds_per_time_unit = open_scene(scene).seconds_per_time_unit(),
        .start = {start},
        .rules = {rules},
        .exposing = exposing};
}

Flown find_flown(const fs::path& record, const RecordHeader& header, const std::string& layout, const LogTo& log)
{
    const std::string file = one_line(record.string());
    Flown flown{
        shipped_file("scenes", header.scene), load_layout(shipped_file("layouts", layout.empty() ? header.layout : layout))};
    const double unit = open_scene(flown.scene).seconds_per_time_unit();
    if (unit != header.seconds_per_time_unit)
        throw InputError(file + ":1", "/seconds_per_time_unit",
            shown(header.seconds_per_time_unit) + " no longer matches the scene, which has " + shown(unit) + " ("
                + one_line(flown.scene.string()) + "); the scene as it was when it was flown is right");
    if (digest_of_scene(flown.scene) != header.scene_digest)
        log(LogKind::record_differs,
            file + ": the scene " + header.scene
                + " has changed since; the flight will be the same, the pictures may not be");
    if (layout.empty() && digest_of(files_of(flown.layout)) != header.layout_digest)
        log(LogKind::record_differs,
            file + ": the layout " + header.layout
                + " has changed since; the flight will be the same, the pictures may not be");
    return flown;
}

} // namespace starbow
