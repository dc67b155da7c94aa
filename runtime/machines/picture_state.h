#pragma once
#include "config/model/inset_view.h"
#include "config/model/pattern.h"
#include "input/controls.h"
#include "runtime/hud/highlights.h"
#include "runtime/hud/hud.h"
#include "runtime/hud/instruments.h"
#include "runtime/hud/overlay.h"
#include "runtime/hud/sky_labels.h"
#include "runtime/light/range_curve.h"

namespace starbow {

/// The head-up display's text.
struct HudText {
    std::int64_t number = 0; ///< another one: the text may have changed
    Readings readings{};
};

/// A sign at a thing: its lines, and the unit direction in which the thing is seen, cockpit axes.
struct ShownSign {
    std::vector<std::string> lines;
    glm::dvec3 towards{0, 0, -1};
};

/// The guide's pointer.
struct ShownPointer {
    glm::dvec3 towards{0, 0, -1}; ///< unit, cockpit axes
    double strength = 1; ///< from 0 to 1: the whole ring
};

/// The inset view.
struct InsetPicture {
    InsetView kind = InsetView::at_rest;
    double start_ev = 0; ///< as inset_shot()'s
    double fov_deg = inset_fov_deg;
    std::string name;
};

/// The instruments over the picture, and the probe straight ahead.
struct Instruments {
    Overlay overlay = Overlay::aim;
    std::array<std::optional<Spot>, 2> marks{};
    OverlayScale scale{};
    const Panel* panel = nullptr; ///< readings, or null; it must last until the frame is drawn
    std::int64_t panel_number = 0; ///< another one: the panel may be another picture; 0: there is none
    glm::vec4 scale_place{0}; ///< of the false colours on the panel, see PanelPass::draw
};

/// Everything that the pictures of one frame depend on, beside the layout, the world, the quality and the visitors' words.
struct PictureState {
    Shot shot; ///< with the head's look and the shown exposure
    Head head;
    std::optional<RangeCurve> range; ///< as FrameState's, and so are the next ones
    bool meters = false;
    double bloom = 0, fade = 0;
    Vignette vignette;
    double vignette_part = 0;
    Pattern pattern = Pattern::none;
    std::optional<HudText> hud; ///< none: it is off
    std::string title; ///< in large letters over the picture, or empty
    std::optional<ShownSign> sign;
    std::vector<ShownHighlight> highlights; ///< two at most; those that are enlarged have insets in place of `inset`
    bool figures = false; ///< the constellations' lines
    std::vector<SkyLabel> sky_labels;
    std::optional<ShownPointer> pointer;
    std::optional<InsetPicture> inset;
    std::optional<Instruments> instruments;
};

} // namespace starbow
