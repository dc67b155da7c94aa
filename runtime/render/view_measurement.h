#pragma once
#include "overlay_pass.h"
#include "view_passes.h"

namespace starbow {

/// The instruments' part of a frame: overlay, panel and probes.
struct Measuring {
    std::vector<ProbeRay> probes; ///< their light is read
    OverlayPass::Content over;
    const Panel* panel = nullptr; ///< readings, or null; the next frame reads it
    glm::vec4 scale{0}; ///< place of the false colours on the panel, see PanelPass::draw
};

/// The instruments' passes: probes of the picture, overlays over it, and the panel of readings. Each is made at its first
/// use. Switched off they cost nothing.
class ViewMeasurement {
public:
    ViewMeasurement(Device& device, Pipelines& pipelines, const GpuWorld& world, const FrameState& state,
        const ViewSet& views, const EyeCubes& eyes, const ViewConstants& constants, const ViewDescriptors& descriptors,
        const ViewPasses& passes)
        : device_(device)
        , pipelines_(pipelines)
        , world_(world)
        , state_(state)
        , views_(views)
        , eyes_(eyes)
        , constants_(constants)
        , descriptors_(descriptors)
        , passes_(passes)
    {
    }

    void set(const std::optional<Measuring>& what);
    bool overlay_on() const { return on_ && what_.over.any(); }
    void reset(); ///< call it when the views have changed
    /// The probes of this frame, for the plan; null without any.
    const Probe* probe();
    void prepare();
    void draw_probes(vk::CommandBuffer commands);
    void draw(vk::CommandBuffer commands, std::size_t output, std::size_t layer, const Target& last);

    /// The last frame's light along Measuring::probes, directions in the world's axes. The device must have finished that
    /// frame.
    std::vector<Probed> probed() const;
    /// The observer whose eye the i-th probe looks from, and the same between the eyes.
    const MeasuringObserver& observer(std::size_t i) const { return observers_[i].eye; }
    const MeasuringObserver& head(std::size_t i) const { return observers_[i].head; }
    vk::DeviceSize memory() const { return panel_ ? panel_->memory() : 0; }

private:
    MeasuringObserver measuring_observer_at(const ViewState& view, const glm::dvec3& eye_m) const;

    Device& device_;
    Pipelines& pipelines_;
    const GpuWorld& world_;
    const FrameState& state_;
    const ViewSet& views_;
    const EyeCubes& eyes_;
    const ViewConstants& constants_;
    const ViewDescriptors& descriptors_;
    const ViewPasses& passes_;
    bool on_ = false;
    Measuring what_;
    /// A probe's observer, in the eye and between the eyes, and the turns of its rays.
    struct ProbeObserver {
        MeasuringObserver eye, head;
        glm::dmat3 world_from_motion{1}, world_from_cube{1};
    };
    std::vector<ProbeObserver> observers_{1}; ///< by probe; one without probes
    std::unique_ptr<Probe> probe_;
    void prepare_overlay();
    const std::vector<glm::vec4>& figures();

    std::unique_ptr<OverlayPass> overlay_;
    std::optional<std::vector<glm::vec4>> figures_; ///< of the world's sky; none before their first use
    std::unique_ptr<PanelPass> panel_;
    std::vector<vk::Rect2D> boxes_; ///< the panel's box in each view
};

} // namespace starbow
