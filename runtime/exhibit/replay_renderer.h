#pragma once
#include "alignment_mode.h"
#include "input/choices.h"
#include "picture_setup.h"
#include "runtime/flight/flight.h"
#include "runtime/flight/record.h"
#include "runtime/render/offscreen.h"
#include "runtime/visit/shown_light.h"

namespace starbow {

/// Draws a recorded flight's pictures off-screen, frame by frame as the exhibit shows them.
class ReplayRenderer {
public:
    /// pattern: the outputs' first test pattern. start_ev: the flight's first exposure, EV. words: for the
    /// inset's name. comfort: of the flight's rules.
    ReplayRenderer(OffscreenRenderer& renderer, Pattern pattern, const Exposing& exposing, double start_ev, Words words,
        const Comfort& comfort = {});

    /// Applies a frame's controls to the pictures: head, test patterns, the builder's changes, exposure,
    /// the inset. Changes add up,
    /// so every frame must be applied. flight: after the frame. Writes no layout.
    void take(const RecordEntry& entry, const Flight& flight);

    /// on: the pictures are metered, for a flight that goes on after the record.
    void meter(bool on) { now_.meters = on; }

    /// Each output as RGBA8, rows from the top.
    std::vector<std::vector<std::uint8_t>> picture(const Flight& flight, const std::string& scene, const Panel* hud);

    /// The curve of the next picture; none: the exposure alone shows it.
    const std::optional<RangeCurve>& curve() const { return light_.curve(); }

private:
    void queue_move(const Command& command);

    OffscreenRenderer& renderer_;
    Layout kept_, layout_; ///< by its file, and with the builder's changes
    AlignmentMode alignment_;
    ShownLight light_;
    double start_ev_;
    Words words_;
    Comfort comfort_;
    Choices choices_; ///< by the visitor's switches
    double telescope_deg_ = 0; ///< its telescope's field; 0: none
    PictureSetup pictures_;
    PictureState now_;
};

} // namespace starbow
