#include "layout_parts.h"
#include "displays/finish/blend.h"

namespace starbow {

LayoutParts layout_parts(MapStore& store, const Layout& layout, const std::vector<glm::ivec2>& sizes, bool rejects_empty)
{
    LayoutParts parts;
    std::vector<CompiledView> lit; // without previews
    for (std::size_t output = 0; output < sizes.size(); ++output) {
        parts.views.push_back(compile_output(store, layout, output, sizes[output]));
        if (!layout.outputs[output].preview)
            lit.insert(lit.end(), parts.views.back().begin(), parts.views.back().end());
    }
    if (rejects_empty)
        reject_empty(layout, lit);
    std::vector<std::vector<float>> ramps;
    if (layout.blend.ramps)
        ramps = blend_ramps(layout, lit, layout.blend.power);
    parts.shades.resize(sizes.size());
    for (std::size_t output = 0; output < sizes.size(); ++output)
        parts.shades[output] = layout.outputs[output].preview ? preview_shade(layout, sizes[output], parts.views[output])
                                                              : shade_of(layout, output, sizes[output], lit, ramps);
    return parts;
}

bool uses_matrices(const Layout& layout, const Quality& quality)
{
    return quality.matrices || layout.head_tracker; // a map can't follow a head
}

PreparedLayout prepare_layout(
    const Layout& layout, const Quality& quality, const std::vector<glm::ivec2>& sizes, bool has_stars)
{
    const Layout shown = with_stereo(layout, quality);
    PreparedLayout prepared{
        .method = shown.stereo.method, .matrices = uses_matrices(shown, quality), .sizes = sizes, .parts = {}};
    MapStore store;
    store.matrices(prepared.matrices);
    prepared.parts = layout_parts(store, shown, sizes, true);
    for (const std::vector<CompiledView>& views : prepared.parts.views)
        for (const CompiledView& view : views)
            if (has_stars && view.map && !prepared.parts.inverses.contains(view.map.get()))
                prepared.parts.inverses.emplace(view.map.get(), inverse(*view.map));
    return prepared;
}

} // namespace starbow
