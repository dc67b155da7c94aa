#pragma once
#include "view_measurement.h"
#include "view_meter.h"

namespace starbow {

/// Draws the outputs of a layout for one shot after another. draw() tells a frame in order; the parts of it hold the
/// device's memory that frames share. No frame depends on an earlier one, but for the cube maps that
/// Quality::frames_per_cube keeps. One frame at a time: the caller waits for the device before the next.
class FrameRenderer {
public:
    /// keeps_depth: record_measured can then tell distances. Throws InputError for a layout that is wrong.
    FrameRenderer(Device& device, Pipelines& pipelines, const GpuWorld& world, const Layout& layout, const Quality& quality,
        bool keeps_depth = false);

    /// The whole frame: observers, plan, culling and upload; cube maps; meter and probes; then for each output its views,
    /// the instruments, the head-up display and the finish. hud: the panel, or null. targets: one for each output; an
    /// output without a view (minimised, or its monitor is away) is left out.
    void draw(vk::CommandBuffer commands, const Shot& shot, const Panel* hud, std::span<const Target> targets);

    /// The same steps one by one, for whoever times them or needs a part: first update(), which is all that the processor
    /// does, then any of the passes.
    void update(const Shot& shot, const Panel* hud);
    void draw_cubes(vk::CommandBuffer commands);
    void draw_meter(vk::CommandBuffer commands) { meter_.record(commands); }
    void draw_probes(vk::CommandBuffer commands) { measurement_.draw_probes(commands); }
    /// One output's numbers instead of its picture: the left eye's where both share pixels.
    void record_measured(vk::CommandBuffer commands, std::size_t output, const MeasureTarget& target);
    ViewPasses& passes() { return passes_; }

    /// The size in pixels of an output, where it is not the layout's.
    void resize(std::size_t output, glm::ivec2 size);
    /// Another layout with the same outputs, while somebody turns its numbers. Its maps are not kept on disk. Throws
    /// InputError where a viewport would be left with nothing to show; then nothing has changed.
    void adopt(const Layout& layout);
    /// Another quality from the next frame on, with the same light, stereo and maps. Other samples or formats take as long
    /// as a change of the layout; the rest costs nothing.
    void adopt(const Quality& quality);
    /// Moves every head from the layout's place, and turns its eyes; walls follow, unless they would be seen from behind.
    /// Maps (mirrors, measured points) stay as they are.
    void move_head(const Head& head);
    /// The same shot then has the same bytes, whatever was drawn before. It takes longer where the plan changes.
    void repeatable(bool on);
    void show(Pattern pattern) { state_.pattern = pattern; }
    /// part: of the light that glows around bright things, 0 to 1. At 0 there is no pass for it, and no memory.
    void bloom(double part) { state_.bloom = part; }
    void meter(bool on) { state_.meters = on; }
    /// Sets the overlay of all views and the probes from the next frame on; none: at no cost. In a world without
    /// depth the first time takes as long as a change of the layout.
    void measure(const std::optional<Measuring>& what);

    /// The exposure for the last frame, EV; nothing where it was dark or not metered. The device must have finished it.
    std::optional<double> metered() const { return meter_.metered(); }
    std::vector<Probed> probed() const { return measurement_.probed(); }
    const MeasuringObserver& head() const { return measurement_.head(); }
    const MeasuringObserver& observer() const { return measurement_.observer(); }
    const ViewSet& views() const { return views_; }
    const std::vector<CubeMapPlan>& plans() const { return eyes_.plans; }
    std::size_t triangles() const { return eyes_.triangles(); }
    vk::DeviceSize memory() const; ///< of the images this object holds, bytes

private:
    void apply_layout(ViewSet::Parts parts);
    double pre_exposure(double most_E) const;

    Device& device_;
    const GpuWorld& world_;
    FrameState state_;
    StarPass stars_;
    ViewSet views_;
    EyeCubes eyes_;
    ViewConstants constants_;
    ViewDescriptors descriptors_;
    ViewPasses passes_;
    ViewMeter meter_;
    ViewMeasurement measurement_;
};

} // namespace starbow
