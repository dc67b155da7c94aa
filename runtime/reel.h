#pragma once
#include "exposure.h"
#include "flight.h"
#include "still.h"
#include "workbench.h"

namespace starbow {

/// A flight's pictures off-screen, frame by frame as the exhibit shows them.
class Reel {
public:
    /// pattern: what the outputs show first. start_ev: the exposure that the flight begins with.
    Reel(Studio& studio, Pattern pattern, const Exposing& exposing, double start_ev);

    /// What a frame's controls do to the pictures: the head, test patterns, what a builder turns (which adds up, so every
    /// frame counts), how the exposure follows what was seen dt_ns before. Writes no layout.
    void take(Controls controls, std::int64_t dt_ns);

    /// Each output as RGBA8, rows from the top.
    std::vector<std::vector<std::uint8_t>> picture(const Flight& flight, const std::string& scene, const Panel* hud);

    /// The frame is seen, but not wanted: the exposure follows it all the same.
    void skip(const Flight& flight, const std::string& scene);

private:
    Shot shot(const Flight& flight, const std::string& scene) const;

    Studio& studio_;
    Layout layout_;
    Workbench workbench_;
    Exposing exposing_;
    double start_ev_;
    Exposure exposure_;
    std::optional<double> metered_; ///< of the last frame that was seen
};

} // namespace starbow
