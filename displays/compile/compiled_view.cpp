#include "compiled_view.h"
#include "bend.h"
#include "config/json/error.h"
#include "config/json/folder.h"
#include "config/json/hash.h"
#include "config/json/kept_file.h"
#include "map_cache.h"
#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <map_sources.h> // MAP_SOURCES, a digest of all sources that maps depend on: CMakeLists.txt
#include <sstream>
#include <unistd.h>

namespace starbow {
namespace {

/// The key of everything that a view's map depends on.
std::uint64_t key_of(const View& view, const std::string& warp)
{
    std::ostringstream text;
    text.precision(17);
    const glm::dvec3& eye = view.picture.eye_m;
    text << MAP_SOURCES << ' ' << view.size.x << ' ' << view.size.y << ' ' << view.picture.size.x << ' '
         << view.picture.size.y << ' ' << view.projection_given << ' ' << view.picture_from_pixel.x << ' '
         << view.picture_from_pixel.y << ' ' << eye.x << ' ' << eye.y << ' ' << eye.z << ' '
         << projection_key(view.picture.projection);
    Hash hash;
    hash.add(text.str());
    hash.add(warp);
    return hash.value;
}

} // namespace

struct MapStore::Kept {
    std::map<std::uint64_t, std::weak_ptr<const DirectionMap>> maps;
    std::map<std::string, std::weak_ptr<const WarpMesh>> meshes;
};

std::filesystem::path map_cache_folder()
{
    auto set = [](const char* name) -> std::filesystem::path {
        const char* value = std::getenv(name);
        return value ? value : "";
    };
    if (!set("STARBOW_CACHE").empty())
        return set("STARBOW_CACHE");
    if (!set("XDG_CACHE_HOME").empty())
        return set("XDG_CACHE_HOME") / "starbow";
    return set("HOME").empty() ? std::filesystem::path() : set("HOME") / ".cache" / "starbow";
}

void bound_cache(const std::filesystem::path& folder, std::uintmax_t most_bytes)
{
    namespace fs = std::filesystem;
    struct Kept {
        fs::file_time_type read;
        fs::path file;
        std::uintmax_t bytes;
    };
    const auto hour_ago = fs::file_time_type::clock::now() - std::chrono::hours(1); // no file takes so long to write
    std::error_code error;
    std::vector<Kept> all;
    std::uintmax_t sum = 0;
    each_entry(folder, [&](const char* name) {
        // Another exhibit may remove the file meanwhile.
        const fs::path file = folder / name;
        const fs::file_time_type read = fs::last_write_time(file, error);
        const std::uintmax_t bytes = error ? 0 : fs::file_size(file, error);
        if (error)
            return;
        if (const std::string kind = file.extension();
            kind == ".map" || kind == ".sky" || kind == ".detail" || kind == ".shadow") {
            all.push_back({read, file, bytes});
            sum += bytes;
        } else if (kind == ".part" && read < hour_ago) {
            fs::remove(file, error);
        }
    });
    std::sort(all.begin(), all.end(), [](const Kept& a, const Kept& b) { return a.read < b.read; });
    for (std::size_t i = 0; i < all.size() && sum > most_bytes; ++i) {
        fs::remove(all[i].file, error);
        sum -= all[i].bytes;
    }
}

MapStore::MapStore()
    : MapStore(map_cache_folder())
{
}

MapStore::MapStore(std::filesystem::path folder, std::uintmax_t most_bytes)
    : folder_(std::move(folder))
    , most_bytes_(most_bytes)
    , kept_(std::make_shared<Kept>())
{
}

std::shared_ptr<const WarpMesh> MapStore::mesh(const Warp& warp, std::string& content)
{
    const FloatMapForm& form = warp.map;
    content = warp.region + '\n' + (form.first_row_on_top ? "top" : "bottom") + (form.v_up ? " up" : "")
        + (form.edge_to_edge ? " edges" : "") + (form.offsets ? " offsets" : "")
        + (warp.aspect ? " aspect " + std::to_string(*warp.aspect) : "") + '\n' + warp.file.filename().string() + '\n'
        + read_warp_bytes(warp.file);
    // domeprojection's second file is named or found beside the first; its content is a part of the key in both cases.
    std::filesystem::path beside = warp.frustum;
    if (beside.empty()) {
        std::string name = warp.file.string();
        if (auto at = name.rfind("_mesh.csv"); at != name.npos)
            beside = name.replace(at, 9, "_frustum.csv");
    }
    std::error_code ignored;
    if (std::filesystem::exists(beside, ignored))
        content += read_warp_bytes(beside);
    std::weak_ptr<const WarpMesh>& kept = kept_->meshes[content];
    std::shared_ptr<const WarpMesh> mesh = kept.lock();
    if (!mesh)
        kept = mesh = std::make_shared<WarpMesh>(load_warp(warp));
    return mesh;
}

std::shared_ptr<const WarpMesh> MapStore::bent_mesh(
    const Viewport& viewport, const WarpMesh* mesh, const std::string& content)
{
    std::weak_ptr<const WarpMesh>& kept = kept_->meshes[content];
    std::shared_ptr<const WarpMesh> result = kept.lock();
    if (!result)
        kept = result = std::make_shared<WarpMesh>(bent(Bend(viewport.quad, viewport.grid), mesh));
    return result;
}

std::shared_ptr<const DirectionMap> MapStore::map(const View& view, const WarpMesh* mesh, std::uint64_t key)
{
    std::weak_ptr<const DirectionMap>& kept = kept_->maps[key];
    if (auto map = kept.lock())
        return map;
    // A small map is compiled faster than it is read.
    const bool on_disk = !folder_.empty() && std::size_t(view.size.x) * view.size.y > (1u << 18);
    const std::filesystem::path file = folder_ / cache_key(key, ".map");
    std::shared_ptr<DirectionMap> map = on_disk ? read_kept_map(file, key, view.size) : nullptr;
    if (!map) {
        map = std::make_shared<DirectionMap>(starbow::compile_direction_map(view, mesh));
        // Several exhibits may share the folder. A full disk only makes starts slower.
        if (on_disk && keep_ && write_kept_map(file, key, *map))
            bound_cache(folder_, most_bytes_);
    }
    kept = map;
    return map;
}

CompiledView MapStore::compile(const Layout& layout, const View& view)
{
    CompiledView compiled;
    compiled.view = view;
    std::string content;
    const std::string viewport = viewport_pointer(view.output, view.viewport);
    const Viewport& own = layout.outputs[view.output].viewports[view.viewport];
    if (const auto& warp = own.warp) {
        compiled.mesh = on_behalf_of(layout, viewport + "/warp", [&] { return mesh(*warp, content); });
        if (!view.projection_given && compiled.mesh->kind == WarpMesh::Kind::picture && !compiled.mesh->frustum)
            throw InputError(place_in(layout, viewport), "",
                "has no projection, and " + warp->file.filename().string()
                    + " does not say what its picture shows; a \"projection\" beside \"warp\" is right");
    } else if (matrices_ && !is_bent(own)) {
        compiled.matrix = view_matrix(view);
    }
    if (is_bent(own)) {
        content += bend_key(own);
        compiled.mesh = on_behalf_of(layout, viewport, [&] { return bent_mesh(own, compiled.mesh.get(), content); });
    }
    if (compiled.matrix) {
        compiled.cones = std::make_shared<ConeHierarchy>(*compiled.matrix, view.size);
    } else {
        compiled.map = map(view, compiled.mesh.get(), key_of(view, content));
        compiled.cones = std::make_shared<ConeHierarchy>(*compiled.map);
    }
    return compiled;
}

double finest_pixel_rad(double known, const CompiledView& view)
{
    const BoundingCone all = view.cones->cone(0, {0, 0});
    if (all.empty())
        return known;
    return known == 0 ? double(all.coarsest) : std::min(known, double(all.coarsest));
}

bool has_mask(const Layout& layout, const CompiledView& view)
{
    return !layout.outputs[view.view.output].viewports[view.view.viewport].alpha_mask.empty()
        || (view.mesh && view.mesh->alpha);
}

namespace {

/// Throws InputError for two viewports that overlap although nothing says how they combine. The layout's reader can't know
/// the masks that come with a warp file.
void reject_unordered(const Layout& layout, std::span<const CompiledView> views)
{
    for (const CompiledView& upper : views)
        for (const CompiledView& lower : views) {
            const std::vector<Viewport>& viewports = layout.outputs[upper.view.output].viewports;
            const Viewport &a = viewports[upper.view.viewport], &b = viewports[lower.view.viewport];
            if (lower.view.viewport < upper.view.viewport && a.order == b.order && overlap(a, b)
                && !(has_mask(layout, upper) && has_mask(layout, lower)))
                throw InputError(place_in(layout, viewport_pointer(upper.view.output, upper.view.viewport)), "",
                    unordered_overlap(lower.view.viewport));
        }
}

} // namespace

std::vector<CompiledView> compile_output(MapStore& store, const Layout& layout, std::size_t output, glm::ivec2 size)
{
    std::vector<CompiledView> compiled;
    for (const View& view : views_of(layout, output, size))
        compiled.push_back(store.compile(layout, view));
    if (!layout.outputs[output].preview)
        reject_unordered(layout, compiled);
    return compiled;
}

void reject_empty(const Layout& layout, std::span<const CompiledView> views)
{
    for (const CompiledView& view : views)
        if (view.cones->cone(0, {0, 0}).empty())
            throw InputError(place_in(layout, viewport_pointer(view.view.output, view.view.viewport)), "",
                "shows nothing: no pixel looks anywhere; a projection, and a warp, that lie within the picture are right");
}

} // namespace starbow
