#pragma once
#include "config/layout.h"
#include "cube_pass.h"
#include "hud.h"
#include "plan.h"

namespace starbow {

/// The three pictures of numbers that `measure` fills instead: light and depth, camera and D, world.
struct MeasureTarget {
    Image light_and_depth, camera, world;
};

/// Draws a layout's outputs for a shot. Holds the device's memory that frames share; no frame depends on an earlier one.
/// One frame at a time: the caller waits for the device before the next prepare().
class Frame {
public:
    Frame(Device& device, Pipelines& pipelines, const GpuWorld& world, const Layout& layout, const Quality& quality,
        bool keeps_depth = false); ///< keeps_depth: so that record_measured can tell distances

    /// The size in pixels of an output, when it is not the layout's.
    void resize(std::size_t output, glm::ivec2 size);

    /// All that the processor does for a frame: eyes, plans, culling, uploads.
    void prepare(const Shot& shot, const Panel* hud);

    /// All that the device does, in order: for each eye the images of its plan; for each output its viewports, then the
    /// head-up display. targets: one for each output.
    void record(vk::CommandBuffer commands, std::span<const Target> targets);

    /// The same for one output with numbers instead of a picture.
    void record_measured(vk::CommandBuffer commands, std::size_t output, const MeasureTarget& target);

    // The stages of record(), one by one, for those who time them.
    void draw_cubes(vk::CommandBuffer commands);
    void warp_output(vk::CommandBuffer commands, std::size_t output, const Target& target);
    void draw_hud(vk::CommandBuffer commands, std::size_t output, const Target& target);

    /// What any other program would draw of the first viewport, which must be planar: the image and the axes of a straight
    /// perspective view, for CubePass::prepare_plain.
    PlanImage plain_image(const Shot& shot, glm::dmat3& straight_from_world) const;
    /// The first viewport through Pipelines::lookup: the bare cost of a cube map's look-up.
    void look_up(vk::CommandBuffer commands, const Target& target, vk::Pipeline pipeline, vk::DescriptorSet set);

    /// What the head-up display's panel would need across to be sharp in the finest viewport, pixels.
    int hud_width() const;
    const std::vector<Plan>& plans() const { return plans_; }
    std::size_t triangles() const; ///< sent to the device for the last frame, all images of all eyes
    vk::DeviceSize memory() const; ///< of the images this object holds

private:
    struct Eye {
        glm::dvec3 offset_m;
        CubePass cube;
    };
    struct ViewState {
        std::size_t output, eye;
        glm::ivec2 corner, size; ///< pixels in the output
        Projection projection;
        Image map; ///< of directions; empty for planar views
        glm::dmat3 cockpit_from_pixel{1};
        vk::raii::DescriptorSet warp_set = nullptr, hud_set = nullptr;
        glm::dmat3 motion_from_cockpit{1};
        vk::Rect2D hud_box;
        bool planar() const { return !*map.view; }
    };

    void place_view(ViewState& view, glm::ivec2 output_size);
    void write_sets();
    void warp_view(vk::CommandBuffer commands, const ViewState& view, vk::Pipeline pipeline, double exposure);
    WarpVariant variant(const ViewState& view) const;
    shared::ViewPush push(const ViewState& view, const glm::dmat3& axes_from_cockpit) const;

    Quality quality_;
    Device& device_;
    Pipelines& pipelines_;
    const GpuWorld& world_;
    Layout layout_;
    bool keeps_depth_;
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::raii::Sampler linear_ = nullptr, nearest_ = nullptr, finest_ = nullptr; ///< finest_: level 0 alone
    Buffer colours_;
    Image nothing_; ///< stands in for a map that a planar view has not
    std::vector<Eye> eyes_;
    std::vector<ViewState> views_;
    std::vector<Plan> plans_;
    Shot shot_;
    double E_ = 1;
    Image panel_;
    Buffer panel_pixels_;
    bool panel_new_ = false, hud_on_ = false;
    glm::dmat3 panel_from_cockpit_{1};
    glm::dvec2 panel_half_{1};
    std::vector<glm::ivec2> sizes_;
};

} // namespace starbow
