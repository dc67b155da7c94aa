#pragma once
#include "alignment_mode.h"
#include "runtime/flight/flight.h"
#include "runtime/flight/record.h"
#include "runtime/light/exposure.h"
#include "runtime/render/offscreen.h"

namespace starbow {

/// A flight's pictures off-screen, frame by frame as the exhibit shows them.
class ReplayRenderer {
public:
    /// pattern: what the outputs show first. start_ev: the exposure that the flight begins with.
    ReplayRenderer(OffscreenRenderer& renderer, Pattern pattern, const Exposing& exposing, double start_ev);

    /// What a frame's controls do to the pictures: the head, test patterns, what a builder turns (which adds up, so every
    /// frame counts), the exposure. Writes no layout.
    void take(const RecordEntry& entry);

    /// Each output as RGBA8, rows from the top.
    std::vector<std::vector<std::uint8_t>> picture(const Flight& flight, const std::string& scene, const Panel* hud);

private:
    OffscreenRenderer& renderer_;
    Layout layout_;
    AlignmentMode alignment_;
    Exposing exposing_;
    double start_ev_;
    Exposure exposure_;
};

} // namespace starbow
