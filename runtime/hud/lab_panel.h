#pragma once
#include "hud.h"
#include "overlay.h"
#include "why.h"

namespace starbow {

/// Height over width of the instruments' panels: the readings, the readings above a scale of colours, the page of
/// explanation, and the entry of a reading.
constexpr double readings_aspect = 0.2, scaled_aspect = 0.25, why_aspect = 0.56, entry_aspect = 0.4;
double lab_aspect(Overlay overlay, Why why);

/// The place of the scale of colours on such a panel, from its lower left to its upper right corner, 0 to 1; all 0: no
/// scale.
glm::vec4 scale_place(Overlay overlay, Why why);

/// How the instruments are shown.
struct LabView {
    Overlay overlay = Overlay::aim;
    OverlayScale scale;
    Why why = Why::none;
    bool by_eye = false; ///< scales alone, without figures: what is read is the student's
    std::string by_eye_says{}; ///< with by_eye: the last reading's sentence; empty: how a reading is made
};

/// Draws the readings, or the page, `width` pixels across. sketch_s: the time of the page's animated sketch.
Panel draw_lab_panel(const Typesetter& typesetter, const Words& words, const Measured& measured, const LabView& view,
    int width, double sketch_s = 0);

} // namespace starbow
