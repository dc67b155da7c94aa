#pragma once
#include "displays/compile/compiled_view.h"

namespace starbow {

/// A factor and an addend for the light of an output's pixels. Linear light, rows from the top; both empty where neither
/// is needed.
struct Shade {
    glm::ivec2 size{0};
    std::vector<glm::vec3> weight, black;
    bool empty() const { return weight.empty() && black.empty(); }
};

/// Combines the masks, the black levels and the calibrations' intensities of one output with the blend ramps. ramps[i]
/// belongs to views[i] (blend.h); it is empty where there is none. Throws InputError for a picture that can't be read.
Shade shade_of(const Layout& layout, std::size_t output, glm::ivec2 size, std::span<const CompiledView> views,
    std::span<const std::vector<float>> ramps);

/// The factor for the light of all outputs that leaves room for the highest black level of any.
double headroom(std::span<const Shade> shades);

} // namespace starbow
