#pragma once
#include "picture_setup.h"
#include "runtime/flight/tour.h"
#include "runtime/hud/hud.h"
#include "runtime/render/offscreen.h"

namespace starbow {

/// Draws a tour's pictures off-screen, with its captions, titles and highlights.
class TourRenderer {
public:
    /// All must outlive it.
    TourRenderer(OffscreenRenderer& renderer, const Show& show, const GpuWorld& world, const Words& words)
        : renderer_(renderer)
        , show_(show)
        , world_(world)
        , words_(words)
    {
    }

    void bloom(double strength) { bloom_ = strength; } ///< as FrameRenderer has it
    /// From now on a curve shows everything at once, as the exhibit does with frames of frame_s seconds.
    void range(double frame_s) { range_frame_s_ = frame_s; }

    /// Each output as RGBA8, rows from the top.
    std::vector<std::vector<std::uint8_t>> picture(const Touring& touring);

private:
    void follow_range(Shot& shot);

    OffscreenRenderer& renderer_;
    const Show& show_;
    const GpuWorld& world_;
    const Words& words_;
    double bloom_ = 0;
    PictureSetup pictures_;
    std::array<double, 2> enlarged_deg_{}; ///< as shown_highlights has it
    double range_frame_s_ = 0; ///< 0: the exposure alone shows it
    RangeMode range_mode_;
};

} // namespace starbow
