#pragma once
#include "meter.h"
#include "view_passes.h"

namespace starbow {

/// Samples the luminance of all views for the exposure. All outputs but previews count, each by the solid angle that the
/// visitor sees.
class ViewMeter {
public:
    ViewMeter(Device& device, Pipelines& pipelines, const FrameState& state, const ViewSet& views, const EyeCubes& eyes,
        const StarPass& stars, const ViewConstants& constants, const ViewPasses& passes, std::uint32_t star_count,
        bool in_space)
        : device_(device)
        , pipelines_(pipelines)
        , state_(state)
        , views_(views)
        , eyes_(eyes)
        , stars_(stars)
        , constants_(constants)
        , passes_(passes)
        , star_count_(star_count)
        , in_space_(in_space)
    {
    }

    void prepare(); ///< makes the meter's picture if FrameState::meters is set
    void record(vk::CommandBuffer commands);
    /// The exposure for the last frame, EV; nothing where it was dark or not metered. The device must have finished that
    /// frame.
    std::optional<double> metered() const;
    std::size_t across() const { return meter_ ? meter_->across() : 0; } ///< surfaces() lie in rows of so many
    /// Its samples; empty where nothing was metered.
    std::span<const LuminanceSample> surfaces() const;
    std::span<const LuminanceSample> stars() const;
    /// FrameRenderer describes both.
    std::vector<ViewSamples> own_samples() const;
    void add_samples(std::span<const ViewSamples> others);
    void reset() { meter_.reset(); } ///< call it when the views have changed
    vk::DeviceSize memory() const { return meter_ ? meter_->memory() : 0; }

private:
    bool counts_here(const ViewState& view) const; ///< an output of this machine, and no preview
    void meter_stars(vk::CommandBuffer commands, const ViewState& view, const Meter::Cell& cell);

    Device& device_;
    Pipelines& pipelines_;
    const FrameState& state_;
    const ViewSet& views_;
    const EyeCubes& eyes_;
    const StarPass& stars_;
    const ViewConstants& constants_;
    const ViewPasses& passes_;
    std::uint32_t star_count_;
    bool in_space_; ///< see metered_ev
    std::unique_ptr<Meter> meter_;
};

} // namespace starbow
