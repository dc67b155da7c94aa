#pragma once
#include "picture_setup.h"
#include "runtime/flight/tour.h"
#include "runtime/hud/hud.h"
#include "runtime/render/offscreen.h"

namespace starbow {

/// Draws a tour's pictures off-screen, with its captions.
class TourRenderer {
public:
    /// All must outlive it.
    TourRenderer(OffscreenRenderer& renderer, const Show& show, const SceneFile& scene, const Words& words)
        : renderer_(renderer)
        , show_(show)
        , scene_(scene)
        , words_(words)
    {
    }

    /// From now on a curve shows everything at once, as the exhibit does with frames of frame_s seconds.
    void range(double frame_s) { range_frame_s_ = frame_s; }

    /// Each output as RGBA8, rows from the top.
    std::vector<std::vector<std::uint8_t>> picture(const Touring& touring);

private:
    void follow_range(Shot& shot);

    OffscreenRenderer& renderer_;
    const Show& show_;
    const SceneFile& scene_;
    const Words& words_;
    Typesetter typesetter_;
    Plate title_;
    std::vector<Callout> callouts_;
    double range_frame_s_ = 0; ///< 0: the exposure alone shows it
    RangeMode range_mode_;
};

} // namespace starbow
