#pragma once
#include "config/model/inset_view.h"
#include "view_measurement.h"
#include "view_meter.h"

namespace starbow {

/// Draws the outputs of a layout for one shot after another. draw() lists a frame's steps in order; the members hold the
/// device's memory that frames share. Frames are independent, but for the cube maps that Quality::frames_per_cube keeps.
/// One frame at a time: the caller waits for the device before the next.
class FrameRenderer {
public:
    /// keeps_depth: record_measured can then report distances. prepared: of this layout; without it, or where the quality
    /// needs others, the parts are computed here. Throws InputError for a wrong layout.
    FrameRenderer(Device& device, Pipelines& pipelines, const GpuWorld& world, const Layout& layout, const Quality& quality,
        bool keeps_depth = false, std::optional<PreparedLayout> prepared = {});
    FrameRenderer(const FrameRenderer&) = delete; // its parts know each other by reference
    FrameRenderer& operator=(const FrameRenderer&) = delete;

    /// The whole frame: observers, plan, culling and upload; cube maps; meter and probes; the inset; then each
    /// output's views, instruments, head-up display and finish. hud: the panel, or null. targets: one for each output. An
    /// output without a view is left out: it is minimised, or its monitor is away.
    void draw(vk::CommandBuffer commands, const Shot& shot, const Panel* hud, std::span<const Target> targets)
    {
        draw(commands, commands, shot, hud, targets);
    }
    /// The same in two parts: `world` touches no target, so that it need not wait for one; `outputs` comes after it.
    void draw(vk::CommandBuffer world, vk::CommandBuffer outputs, const Shot& shot, const Panel* hud,
        std::span<const Target> targets);

    /// The same steps one by one, for measurements and for parts of a frame. update() comes first and is the processor's
    /// part; then any of the passes may follow.
    void update(const Shot& shot, const Panel* hud);
    void draw_cubes(vk::CommandBuffer commands);
    void draw_meter(vk::CommandBuffer commands) { meter_.record(commands); }
    void draw_probes(vk::CommandBuffer commands) { measurement_.draw_probes(commands); }
    /// One output's measured channels instead of its picture; the left eye's where both eyes share pixels.
    void record_measured(vk::CommandBuffer commands, std::size_t output, std::size_t layer, const MeasureTarget& target);
    ViewPasses& passes() { return passes_; }

    /// Sets the size of an output in pixels, if it differs from the layout's. Throws InputError where the device can't hold
    /// so large a one; then nothing has changed.
    void resize(std::size_t output, glm::ivec2 size);
    /// Shows another layout with the same outputs, for a layout that is being edited. Its maps are not stored on disk.
    /// Throws InputError where a viewport would show nothing, or the device has no room; then nothing has changed.
    void adopt(const Layout& layout);
    /// Sets another quality from the next frame on, with the same light, stereo method and maps. A change of samples or
    /// formats takes as long as a change of the layout; other changes cost nothing.
    void adopt(const Quality& quality);
    /// Gives back the cube maps' images, which grow with the largest plan so far; the next frame makes what it needs. The
    /// device must have finished the frame before.
    void release_images() { eyes_.release(); }
    const Quality& quality() const { return state_.quality; }
    /// Moves every head from the layout's place and turns its eyes. Walls follow, unless they would be seen from behind.
    /// Maps of mirrors and of measured points stay as they are.
    void move_head(const Head& head);
    /// Draws the outputs of one machine alone, from the next frame on, as they are among all others; empty: all outputs.
    void only(const std::string& node) { state_.node = node; }
    /// on: equal shots have equal bytes, whatever was drawn before. It takes longer where the plan changes.
    void repeatable(bool on);
    /// on: light counts however dim, because numbers are read. Without it no light is drawn that no screen shows.
    void count_all_light(bool on) { counts_all_light_ = on; }
    void show(Pattern pattern) { state_.pattern = pattern; }
    /// part: share of the light that glows around bright things, 0 to 1. At 0 the pass takes no time and no memory.
    void bloom(double part, double above = 1) { state_.bloom = part, state_.bloom_above = above; }
    /// part: of black over the finished picture, 0 to 1. At 0 the pass takes no time.
    void fade(double part) { state_.fade = part; }
    /// part: of the vignette that is seen, 0 to 1. At 0 the pass takes no time. It darkens the world alone: instruments and
    /// the head-up display stay as they are, and so does the exposure's measure.
    void vignette(const Vignette& vignette, double part) { state_.vignette = vignette, state_.vignette_part = part; }
    /// The curve by which everything shows at once, from the next frame on, and by which the shot's EV moves the shown
    /// light; none: the shot's exposure.
    void range(const std::optional<RangeCurve>& curve) { state_.range = curve; }
    void glows(bool always) { state_.glows = always; } ///< FrameState::glows
    void meter(bool on) { state_.meters = on; }
    /// Lays callouts over all views, beside the head-up display, from the next frame on. They must last until it is drawn.
    void place(std::span<const Callout> callouts) { passes_.place(callouts); }
    /// Draws an inset of another shot of the same event as well, from the next frame on; not while a test pattern is
    /// shown. width: pixels. which: 0, or 1 for a second one. The device must have finished the frame before. Throws NoRoom;
    /// then there is none.
    void show_inset(const Shot& shot, int width, double fov_deg = inset_fov_deg, std::size_t which = 0);
    void drop_insets(std::size_t from = 0); ///< all but the first `from`; the device must have finished the frame before
    /// The inset's picture in the last frame; only while there is that inset.
    const Image& inset_picture(std::size_t which = 0) const { return views_.insets[which]->picture; }
    /// Sets the overlay of all views and the probes from the next frame on; none: at no cost. In a world whose depth is
    /// not kept, the first call takes as long as a change of the layout.
    void measure(const std::optional<Measuring>& what);

    /// The exposure for the last frame, EV; nothing where it was dark or not metered. The device must have finished that
    /// frame.
    std::optional<double> metered() const { return meter_.metered(); }
    /// The samples that it follows from; empty where nothing was metered.
    std::span<const LuminanceSample> surface_samples() const { return meter_.surfaces(); }
    std::size_t samples_across() const { return meter_.across(); } ///< the surfaces' samples lie in rows of so many
    std::span<const LuminanceSample> star_samples() const { return meter_.stars(); }
    /// The last frame's samples of this machine's views, and those of another's, which then count as its own. The device
    /// must have finished that frame.
    std::vector<ViewSamples> own_samples() const { return meter_.own_samples(); }
    void add_samples(std::span<const ViewSamples> others) { meter_.add_samples(others); }
    std::vector<Probed> probed() const { return measurement_.probed(); }
    const MeasuringObserver& head(std::size_t probe = 0) const { return measurement_.head(probe); }
    const MeasuringObserver& observer(std::size_t probe = 0) const { return measurement_.observer(probe); }
    const ViewSet& views() const { return views_; }
    const std::vector<CubeMapPlan>& plans() const { return eyes_.plans; }
    std::size_t triangles() const { return eyes_.triangles(); }
    vk::DeviceSize memory() const; ///< bytes of this object's images

private:
    void apply_layout(LayoutParts parts);
    template <class Undo> void apply_layout_or(bool rejects_empty, const Undo& undo);
    double pre_exposure(double most_E) const;
    double pre_exposure(const Shot& shot, double most_E, StoredLight light) const;

    Device& device_;
    Pipelines& pipelines_;
    const GpuWorld& world_;
    FrameState state_;
    bool counts_all_light_ = false;
    SeenStars seen_stars_;
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
