#pragma once
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

    /// Each output as RGBA8, rows from the top.
    std::vector<std::vector<std::uint8_t>> picture(const Touring& touring);

private:
    OffscreenRenderer& renderer_;
    const Show& show_;
    const SceneFile& scene_;
    const Words& words_;
    Typesetter typesetter_;
};

} // namespace starbow
