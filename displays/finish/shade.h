#pragma once
#include "displays/compile/compiled_view.h"

namespace starbow {

/// A factor and an addend for the light of an output's pixels. Linear light, rows from the top; both empty where neither
/// is needed. Where viewports overlap, `shares` has the factors, and `weight` is empty.
struct Shade {
    glm::ivec2 size{0};
    std::vector<glm::vec3> weight, black;
    /// A factor for each layer's light (View::layer), as composed() describes it: [canvas * layers + layer]. Empty where
    /// no viewports overlap.
    std::vector<std::vector<glm::vec4>> shares;
    int layers = 1;
    /// The layer with the largest part of each pixel of the first canvas, 255 where nothing is shown; empty as `shares`.
    std::vector<std::uint8_t> foremost;
    bool empty() const { return weight.empty() && black.empty(); }
};

/// The factors and the addend that a view's masks, its calibration and its ramp say.
class ViewShade {
public:
    /// ramp: of blend.h, or empty. All must outlive it. Throws InputError for a picture that can't be read.
    ViewShade(const Layout& layout, const CompiledView& view, std::span<const float> ramp);

    const CompiledView& view() const { return *view_; }
    bool shows(int x, int y, int channel) const; ///< at a pixel of the view
    glm::vec3 mask(int x, int y) const; ///< alpha_mask's light, or 1
    float brightness(int x, int y) const; ///< the calibration's intensity times the ramp
    glm::vec3 lift(int x, int y) const; ///< black_level's light, or 0
    bool dims() const; ///< true if mask or brightness may differ from 1
    bool has_lift() const { return black_.has_value(); }

private:
    const CompiledView* view_;
    std::span<const float> ramp_;
    std::optional<WarpMesh::Mask> alpha_, black_;
};

/// Combines the masks, the black levels and the calibrations' intensities of one output with the blend ramps. ramps[i]
/// belongs to views[i] (blend.h); it is empty where there is none. Throws InputError for a picture that can't be read.
Shade shade_of(const Layout& layout, std::size_t output, glm::ivec2 size, std::span<const CompiledView> views,
    std::span<const std::vector<float>> ramps);

/// The same for a preview, from its views: without shading, but for the parts of viewports that overlap.
Shade preview_shade(const Layout& layout, glm::ivec2 size, std::span<const CompiledView> views);

/// The factor for the light of all outputs that leaves room for the highest black level of any.
double headroom(std::span<const Shade> shades);

} // namespace starbow
