#pragma once
#include "config/model/flying.h"
#include "config/model/layout.h"
#include "config/model/pattern.h"
#include "config/model/quality.h"
#include "config/model/shot.h"
#include "runtime/light/range_curve.h"
#include <cmath>
#include <optional>

namespace starbow {

/// The plain data that all parts of a frame read. FrameRenderer alone writes it.
struct FrameState {
    Quality quality;
    Layout layout; ///< with the quality's stereo method
    std::string node{}; ///< the machine whose outputs are drawn; empty: all are
    bool keeps_depth = false; ///< the cube map's depth is read after its pass
    bool repeatable = false; ///< equal shots have equal bytes, whatever was drawn before
    Pattern pattern = Pattern::none;
    double bloom = 0; ///< the part, 0 to 1, that glows around bright things
    double bloom_above = 1; ///< of the light brighter than this; a screen's white is 1
    double fade = 0; ///< the part of black over the finished picture, 0 to 1
    Vignette vignette;
    double vignette_part = 0; ///< that is seen, 0 to 1
    bool meters = false; ///< luminance is sampled beside the picture
    /// The curve by which everything shows at once; none: the shot's exposure. With a curve, the shot's EV moves the shown
    /// light.
    std::optional<RangeCurve> range;
    Shot shot; ///< the instant that is drawn
    bool all_light = false; ///< light counts however dim; otherwise none is drawn that no screen shows
    bool glows = false; ///< shaders have what shines above a globe's air in any case
    double pre_exposure = 1; ///< every radiance in the cube map is stored times this

    double exposure_of(const Shot& shown) const { return range ? 1 : std::exp2(shown.exposure_ev); } ///< of light, as drawn
    bool is_here(const Output& output) const { return is_shown_by(node, output); }
    bool reprojects() const { return layout.stereo.method == StereoMethod::reprojected; }
};

} // namespace starbow
