#pragma once
#include "cone_hierarchy.h"
#include <memory>

namespace starbow {

/// A view in the device's form: a matrix if its directions are linear in the pixel, otherwise a map.
struct CompiledView {
    View view;
    std::optional<glm::dmat3> matrix; ///< direction = M (x, y, 1), pixels from the view's corner
    std::shared_ptr<const WarpMesh> mesh; ///< of the viewport's warp file and its handles, or null
    std::shared_ptr<const DirectionMap> map; ///< null where there is a matrix
    std::shared_ptr<const ConeHierarchy> cones;

    int channels() const { return map ? map->channels : 1; }
};

/// The folder of compiled maps: STARBOW_CACHE, else starbow in XDG_CACHE_HOME or ~/.cache. Empty where none of these is
/// set; maps are then kept in memory only.
std::filesystem::path map_cache_folder();

/// The most bytes of the maps and the worlds' skies, levels of detail and shadows in the folder.
constexpr std::uintmax_t most_cached_bytes = std::uintmax_t(4) << 30;
/// Removes the files that were read longest ago, and the unfinished files of processes that ended while they wrote.
void bound_cache(const std::filesystem::path& folder, std::uintmax_t most_bytes = most_cached_bytes);

/// Compiled maps by content: the view's projection, its size, the bytes of its warp file. They stay in memory while they
/// are in use, and in map_cache_folder across starts. An unusable folder only makes starts slower. The folder is kept
/// under 4 GiB; the maps that were read longest ago are deleted first.
class MapStore {
public:
    MapStore();
    /// folder: empty for memory only. most_bytes: of the maps in the folder.
    explicit MapStore(std::filesystem::path folder, std::uintmax_t most_bytes = most_cached_bytes);

    /// False: new maps are not written to the folder, for example while a builder changes a dome's tilt.
    void keep(bool on_disk) { keep_ = on_disk; }
    /// True: views whose directions are linear in the pixel get a matrix; false: they get a map too.
    void matrices(bool on) { matrices_ = on; }

    /// Compiles a view or finds it. Throws InputError for a warp file that is wrong.
    CompiledView compile(const Layout& layout, const View& view);

private:
    std::shared_ptr<const WarpMesh> mesh(const Warp& warp, std::string& content);
    std::shared_ptr<const WarpMesh> bent_mesh(const Viewport& viewport, const WarpMesh* mesh, const std::string& content);
    std::shared_ptr<const DirectionMap> map(const View& view, const WarpMesh* mesh, std::uint64_t key);

    std::filesystem::path folder_;
    std::uintmax_t most_bytes_;
    bool keep_ = true, matrices_ = true;
    struct Kept;
    std::shared_ptr<Kept> kept_;
};

/// The angle of a pixel of the finest view, radians, where that view's pixels look widest, as in a flat picture's middle.
/// Points and lines of a world are as wide. known: that of the views so far, 0 without any; a further view makes it less or
/// leaves it.
double finest_pixel_rad(double known, const CompiledView& view);

/// True for a view with an alpha mask, from the layout or from its warp file.
bool has_mask(const Layout& layout, const CompiledView& view);

/// Compiles all views of one output. Throws InputError also for viewports that overlap without an order and without masks.
std::vector<CompiledView> compile_output(MapStore& store, const Layout& layout, std::size_t output, glm::ivec2 size);

/// Throws InputError, with the layout's place, for a view that shows nothing at all.
void reject_empty(const Layout& layout, std::span<const CompiledView> views);

} // namespace starbow
