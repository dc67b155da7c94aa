#pragma once
#include "frame_renderer.h"
#include <vector>

namespace starbow {

/// Draws, off-screen, a small picture for each state of the switches that a visitor can reach, so that no frame in flight
/// waits for a compiler. The states are effects, comparisons, false colours, overlays, a fade with a vignette, and test
/// patterns, at rest and in flight. Software renderers compile when they draw, so pictures are drawn and not only pipelines
/// made. They take up to a tenth of a second for each pipeline and therefore leave out combinations of a comparison or false
/// colours with effects switched off; these are compiled at their first use.
class WarmUp {
public:
    /// start: a shot in the world, which is warmed up in this quality. format: of the outputs' targets. meters: the exposure
    /// is automatic. draws: false records the passes alone, which makes their pipelines. Throws NoRoom and InputError.
    WarmUp(Device& device, Pipelines& pipelines, const GpuWorld& world, const Layout& layout, const Quality& quality,
        const Shot& start, vk::Format format, bool meters, double bloom, bool draws = true);
    ~WarmUp(); ///< waits for the device

    /// True if the device has drawn the picture before: step() will not wait.
    bool ready() const;
    /// Draws the next state that needs a new pipeline, or passes by a few that need none. hud: a panel, or null. Returns
    /// false once all states are drawn.
    bool step(const Panel* hud);
    std::size_t steps() const { return states_.size(); }
    std::size_t step_number() const { return next_; }
    std::size_t made() const { return pipelines_.count() - before_; } ///< pipelines since it began

    /// One state of the switches.
    struct State {
        glm::dvec3 u{0}; ///< proper velocity, cockpit's axes
        Effects effects{};
        Overlay overlay = Overlay::off;
        bool figures = false; ///< of the constellations
        Pattern pattern = Pattern::none;
        double fade = 0;
        bool range = false; ///< a curve shows everything at once
        bool glows = false; ///< what shines above a globe's air shows
        bool cut = false, mips = true; ///< tiles of several images; images with coarser levels, where the quality has any
    };

private:
    Device& device_;
    Pipelines& pipelines_;
    Shot start_;
    Quality quality_;
    std::vector<State> states_;
    std::size_t next_ = 0, before_ = pipelines_.count();
    FrameRenderer frame_;
    std::vector<Image> images_;
    std::vector<Target> targets_;
    vk::raii::CommandBuffer commands_ = nullptr;
    vk::raii::Fence done_;
    bool draws_, submitted_ = false;
};

} // namespace starbow
