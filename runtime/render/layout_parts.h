#pragma once
#include "config/model/quality.h"
#include "displays/compile/compiled_view.h"
#include "displays/compile/inverse_map.h"
#include "displays/finish/shade.h"
#include <map>

namespace starbow {

/// Everything that the processor computes from a layout and its files before the device is touched.
struct LayoutParts {
    std::vector<std::vector<CompiledView>> views; ///< one list for each output
    std::vector<Shade> shades;
    std::map<const DirectionMap*, InverseMap> inverses{}; ///< those of the views' maps that are computed already
};

/// Computes the parts. sizes: of the outputs, pixels. Throws InputError for a wrong file and, if `rejects_empty`, for a view
/// that shows nothing.
LayoutParts layout_parts(MapStore& store, const Layout& layout, const std::vector<glm::ivec2>& sizes, bool rejects_empty);

/// True if the views of such a layout get matrices where they can (MapStore::matrices).
bool uses_matrices(const Layout& layout, const Quality& quality);

/// The parts of a layout for a FrameRenderer that is still to be made, computed on another thread than it.
struct PreparedLayout {
    StereoMethod method; ///< these two depend on the quality too
    bool matrices;
    std::vector<glm::ivec2> sizes;
    LayoutParts parts;
};
/// has_stars: with the inverses of all maps. Throws InputError.
PreparedLayout prepare_layout(
    const Layout& layout, const Quality& quality, const std::vector<glm::ivec2>& sizes, bool has_stars);

} // namespace starbow
