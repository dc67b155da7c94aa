#pragma once
#include "bloom_pass.h"
#include "displays/compile/compiled_view.h"
#include "finish_pass.h"
#include "input/controls.h"
#include "lab_passes.h"
#include "meter.h"
#include "runtime/hud/hud.h"
#include "runtime/plan/cube_map_plan.h"
#include "runtime/world/observer.h"
#include "star_pass.h"
#include <functional>

namespace starbow {

/// The three pictures of numbers that `measure` fills instead: light and depth, camera and D, world.
struct MeasureTarget {
    Image light_and_depth, camera, world;
};

/// What the outputs show: the flight, or a pattern to line them up by.
enum class Pattern { none, grid, rings, names, wedges, overlap };
constexpr std::array<const char*, 6> pattern_names = {"none", "grid", "rings", "names", "wedges", "overlap"};

/// Draws a layout's outputs for a shot. Holds the device's memory that frames share; no frame depends on an earlier one, but
/// for the cube maps that Quality::frames_per_cube keeps.
/// One frame at a time: the caller waits for the device before the next prepare().
class Frame {
public:
    Frame(Device& device, Pipelines& pipelines, const GpuWorld& world, const Layout& layout, const Quality& quality,
        bool keeps_depth = false); ///< keeps_depth: so that record_measured can tell distances

    /// The part of the light that glows around what shines, 0 to 1. At 0 there is no pass for it, and no memory.
    void bloom(double part) { bloom_ = part; }

    /// The size in pixels of an output, when it is not the layout's.
    void resize(std::size_t output, glm::ivec2 size);

    /// Another layout with the same outputs: while someone turns its numbers. Its maps are not kept on disk. Throws
    /// InputError where a viewport would be left with nothing to show; then nothing has changed.
    void adopt(const Layout& layout);

    /// Moves every head from where the layout has it, and turns its eyes: what is seen through walls follows, but for a wall
    /// that would be seen from behind. Maps (mirrors, measured points) stay as they are.
    void move_head(const Head& head);

    /// Whether the same shot has the same bytes whatever was drawn before; takes longer where the plan changes.
    void repeatable(bool on);

    /// Another quality from the next frame on, with the same light, stereo and maps. What only the plan and the warp need
    /// changes at no cost; other samples or formats as a change of the layout.
    void adopt(const Quality& quality);

    void show(Pattern pattern) { pattern_ = pattern; }

    /// Whether the light of what all views of all outputs show is sampled beside each frame: of what is seen, not of
    /// previews, and evenly for the solid angle that the visitor sees.
    void meter(bool on) { meters_ = on; }
    /// The exposure for what the last frame showed. Nothing where it was dark, or not metered. The device must have
    /// finished it.
    std::optional<double> metered() const;

    /// What is laid over all views from the next frame on, and what is read of the picture; nothing: at no cost. The first
    /// time of a world without depth it makes room, which takes as long as a change of the layout.
    void measure(const std::optional<Measuring>& what);
    /// What the last frame showed along Measuring::probes, directions in the world's axes; the device must have finished it.
    std::vector<Probed> probed() const;
    /// Who measures, between the eyes, in that frame.
    const MeasuringObserver& head() const { return lab_->head; }
    /// The eye that saw what was probed, the first one.
    const MeasuringObserver& observer() const { return lab_->observer; }
    /// The unit direction in the cockpit that a point of an output (pixels from its top left) shows in its left eye.
    std::optional<glm::dvec3> direction(std::size_t output, const glm::dvec2& pixel) const;

    /// All that the processor does for a frame: eyes, plans, culling, uploads.
    void prepare(const Shot& shot, const Panel* hud);

    /// All that the device does, in order: for each eye the images of its plan; for each output its views, the head-up
    /// display, and what its screen wants. targets: one for each output.
    void record(vk::CommandBuffer commands, std::span<const Target> targets);

    /// The same for one output with numbers instead of a picture: the left eye's where both share pixels.
    void record_measured(vk::CommandBuffer commands, std::size_t output, const MeasureTarget& target);

    /// Turns from a measured view's motion axes to its observer's own, after prepare(): each with the view's corner and size.
    struct Axes {
        glm::ivec2 corner, size;
        glm::dmat3 world_from_motion;
    };
    std::vector<Axes> measured_axes(std::size_t output) const;

    // The stages of record(), one by one, for those who time them.
    void draw_cubes(vk::CommandBuffer commands);
    void draw_meter(vk::CommandBuffer commands);
    void draw_stars(vk::CommandBuffer commands, std::size_t output, int layer); ///< the first part of warp_output
    void warp_output(vk::CommandBuffer commands, std::size_t output, const Target& target);
    void draw_hud(vk::CommandBuffer commands, std::size_t output, const Target& target);
    void finish_output(vk::CommandBuffer commands, std::size_t output, const Target& target);
    void draw_probes(vk::CommandBuffer commands);
    void draw_lab(vk::CommandBuffer commands, std::size_t output, const Target& target);

    /// What any other program would draw of the first view, which must be flat: the image and the axes of a straight
    /// perspective view, for CubePass::prepare_plain.
    PlannedImage plain_image(const Shot& shot, glm::dmat3& straight_from_world) const;
    /// The first view through Pipelines::lookup: the bare cost of a cube map's look-up.
    void look_up(vk::CommandBuffer commands, const Target& target, vk::Pipeline pipeline, vk::DescriptorSet set);

    /// The same for the panel of instruments, `aspect` high over its width.
    int lab_panel_width(double aspect) const;
    /// What the head-up display's panel would need across to be sharp in the finest viewport, pixels.
    int hud_width() const;
    const std::vector<CubeMapPlan>& plans() const { return plans_; }
    std::size_t triangles() const; ///< sent to the device for the last frame, all images of all eyes
    vk::DeviceSize memory() const; ///< of the images this object holds

private:
    struct Eye {
        glm::dvec3 place_m; ///< in the cockpit, before any head moves
        std::size_t observer; ///< whose: index into observers_
        CubePass cube;
        glm::dvec3 now_m; ///< where it is
        std::vector<EyeEvent> drawn{}; ///< from where its cube map was, of each layer
        std::vector<StarRun> stars{}; ///< that its views may show
        std::vector<RestFrameRequest> requests{}; ///< of its plan
        std::vector<EyeEvent> eye_events{}; ///< from where its cube map would be drawn now
        CubeMapPlan wanted{}; ///< and what it would hold
        std::vector<double> nearest{}; ///< of each layer: distance of the nearest surface that there may be, scene units; 1
                                       ///< where it does not count
    };
    struct ViewState {
        std::size_t output = 0, eye = 0;
        CompiledView compiled;
        std::optional<std::size_t> map; ///< index into maps_
        Image label; ///< of test patterns, once they were shown
        float shown_part = 1; ///< for them too
        vk::raii::DescriptorSet warp_set = nullptr, label_set = nullptr;
        vk::Rect2D hud_box;
        std::unique_ptr<BloomPass> bloom; ///< once it was asked for
        glm::dvec3 beside_m{0}; ///< the eye's place from its cube map's, in the cockpit
        Buffer layers; ///< RestFrameConstants, where something moves
        const View& view() const { return compiled.view; }
    };
    struct OutputState {
        glm::ivec2 size{0};
        std::unique_ptr<FinishPass> finish; ///< null where its target takes the light as it is
    };
    struct Map {
        std::shared_ptr<const DirectionMap> directions;
        Image image;
        Image inverse; ///< where there are stars
        bool closes = false; ///< InverseMap's
    };

    /// What is worked out of the layout before anything changes: what is wrong with its files shows here.
    struct Parts {
        std::vector<std::vector<CompiledView>> views; ///< of each output
        std::vector<Shade> shades;
    };
    Parts parts(bool refuses_dark);
    void apply_layout(Parts parts);
    void find_hud_box(ViewState& view) const;
    const Image& map_of(const ViewState& view) const;
    /// Draws over what an output shows already, view by view of each of its pictures.
    void lay_over(vk::CommandBuffer commands, std::size_t output, const Target& last,
        const std::function<void(std::size_t view, vk::Format target)>& draw) const;
    glm::dvec3 place_of_eye(const View& view) const;
    std::size_t eye_for(const View& view);
    std::optional<std::size_t> map_for(const CompiledView& view, std::vector<Map>& before);
    PixelBox panel_in(const ConeHierarchy& cones) const;
    glm::ivec2 sent_pixels(const ViewState& view) const;
    glm::dvec3 scene_units(const glm::dvec3& place_m) const;
    glm::dvec3 eye_offset(const ViewState& view, const RestFrameView& layer) const;
    glm::vec4 eye_constants(const ViewState& view, const RestFrameView& layer) const;
    const Observer& observer_of(const ViewState& view) const { return observers_[eyes_[view.eye].observer]; }
    void request_views(std::size_t eye);
    bool can_reuse(std::size_t eye) const;
    void prepare_eyes(double pre_exposure);
    void write_rest_frames(ViewState& view);
    void write_sets();
    const ResponseBuffers& response() const { return shot_.effects.false_colours ? world_.false_colours : world_.eye; }
    glm::vec4 boost(const ViewState& view, double exposure) const;
    void set_warp(vk::CommandBuffer commands, const ViewState& view, vk::Pipeline pipeline,
        const shared::ViewPush& constants, glm::ivec2 corner, glm::ivec2 size);
    shared::ViewPush star_push(const ViewState& view) const;
    void meter_stars(vk::CommandBuffer commands, const ViewState& view, const Meter::Cell& cell);
    void warp_view(vk::CommandBuffer commands, const ViewState& view, vk::Pipeline pipeline, double exposure);
    void bloom_view(vk::CommandBuffer commands, const ViewState& view);
    void pattern_view(vk::CommandBuffer commands, const ViewState& view, vk::Format target);
    WarpVariant variant(const ViewState& view) const;
    WarpVariant variant_shown(const ViewState& view) const;
    const PlannedImage* single_image(const ViewState& view) const;
    shared::ViewPush push(const ViewState& view, const glm::dmat3& axes_from_cockpit) const;
    Target picture_of(std::size_t output, int layer, const Target& last) const;
    bool reprojects() const { return layout_.stereo.method == StereoMethod::reprojected; }

    const ViewState& probed_view() const;
    MeasuringObserver measuring_observer_at(const glm::dvec3& eye_m) const;
    PanelPass::Place lab_place(double aspect) const;
    void request_probes(std::size_t eye, const glm::dmat3& motion_from_cockpit, std::vector<ViewRequest>& requests) const;
    void prepare_lab();
    void forget_lab();

    Quality quality_;
    Device& device_;
    Pipelines& pipelines_;
    const GpuWorld& world_;
    Layout layout_;
    bool keeps_depth_;
    MapStore store_;
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::raii::Sampler linear_ = nullptr, nearest_ = nullptr, finest_ = nullptr; ///< finest_: level 0 alone
    StarPass stars_;
    Image nothing_, no_map_; ///< stand in for what a view has not
    Buffer no_rest_frames_; ///< and for what a world has not
    std::vector<Map> maps_;
    std::vector<Eye> eyes_;
    std::vector<ViewState> views_;
    std::vector<OutputState> outputs_;
    std::vector<CubeMapPlan> plans_;
    bool repeatable_ = false;
    bool cubes_drawn_ = false; ///< and shown so often already
    int cubes_shown_ = 0;
    PlanScratch plan_scratch_;
    std::vector<glm::dmat3> star_turns_; ///< these and what follows are kept for their room
    std::vector<vk::DescriptorBufferInfo> buffer_infos_;
    std::vector<vk::DescriptorImageInfo> image_infos_;
    std::vector<vk::BufferView> texel_views_;
    std::vector<vk::WriteDescriptorSet> writes_;
    Shot shot_;
    double pre_exposure_ = 1;
    std::vector<Observer> observers_; ///< one for each observer that a view has
    Pattern pattern_ = Pattern::none;
    double bloom_ = 0;
    bool meters_ = false;
    std::unique_ptr<Meter> meter_; ///< once it was asked for
    std::unique_ptr<LabPasses> lab_; ///< while something is measured
    std::unique_ptr<PanelPass> hud_; ///< once it was asked for
    bool hud_on_ = false;
    PanelPass::Place hud_place_;
};

} // namespace starbow
