#pragma once
#include "overlay_pass.h"
#include "panel_pass.h"
#include "probe.h"

namespace starbow {

/// What a frame does for who measures.
struct Measuring {
    std::vector<glm::dvec3> probes; ///< unit directions in the cockpit whose light is read
    OverlayPass::What over;
    const Panel* panel = nullptr; ///< of readings, or none; read by the next prepare()
    glm::vec4 scale{0}; ///< where the false colours stand on it, see PanelPass::draw
};

/// The passes for it, each made when first asked for.
struct LabPasses {
    Measuring what;
    MeasuringObserver observer; ///< of the eye that the probes look from
    MeasuringObserver head; ///< between the eyes: who measures
    glm::dmat3 world_from_motion{1};
    std::unique_ptr<Probe> probe;
    std::unique_ptr<OverlayPass> overlay;
    std::unique_ptr<PanelPass> panel;
    std::vector<vk::Rect2D> boxes; ///< of the panel in each view
};

} // namespace starbow
