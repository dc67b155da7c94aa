#pragma once
#include "meter.h"
#include "view_passes.h"

namespace starbow {

/// Samples the luminance of all views beside the picture, for the exposure: of all outputs but previews, evenly for the
/// solid angle that the visitor sees.
class ViewMeter {
public:
    ViewMeter(Device& device, Pipelines& pipelines, const FrameState& state, const ViewSet& views, const EyeCubes& eyes,
        const StarPass& stars, const ViewConstants& constants, const ViewPasses& passes, std::uint32_t star_count)
        : device_(device)
        , pipelines_(pipelines)
        , state_(state)
        , views_(views)
        , eyes_(eyes)
        , stars_(stars)
        , constants_(constants)
        , passes_(passes)
        , star_count_(star_count)
    {
    }

    void prepare(); ///< makes its picture, where FrameState::meters asks for it
    void record(vk::CommandBuffer commands);
    /// The exposure for the last frame, EV. Nothing where it was dark or not metered. The device must have finished it.
    std::optional<double> metered() const;
    void reset() { meter_.reset(); } ///< the views are others now
    vk::DeviceSize memory() const { return meter_ ? meter_->memory() : 0; }

private:
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
    std::unique_ptr<Meter> meter_;
};

} // namespace starbow
