#pragma once
#include "gpu_world.h"
#include "runtime/plan/cube_map_plan.h"
#include "runtime/plan/cull.h"

namespace starbow {

/// Near plane of every picture of the world, scene units; reversed z keeps its precision at any ratio of far to near.
constexpr double near_distance = 1e-6;

/// A picture that is drawn into: a swapchain's image or one of our own. In eColorAttachmentOptimal meanwhile.
struct Target {
    vk::Image image;
    vk::ImageView view;
    vk::Extent2D extent;
    vk::Format format;
};

/// What stands still around one eye, in the world and in the rest frame of each thing that moves, drawn into the images of a
/// plan: the atlas that the warp pass reads. Holds the device's memory for it; nothing of one frame is needed by the next.
class CubePass {
public:
    CubePass(Device& device, Pipelines& pipelines, const GpuWorld& world, const Quality& quality, bool keeps_depth);

    /// Whether the atlas is as large as the plan alone asks for, even where a larger one is there: coordinates in it are
    /// rounded alike each time, and so is what is shown. Otherwise it only grows, which takes less time.
    void repeatable(bool on) { repeatable_ = on; }

    /// Another quality from the next prepare() on, with as many samples and the same formats.
    void adopt(const Quality& quality) { quality_ = quality; }

    /// What the processor does: culls, makes room, uploads. The device must have finished the frame before. Every radiance
    /// is stored times pre_exposure. layers: the plan's.
    void prepare(const CubeMapPlan& plan, std::span<const EyeEvent> layers, double pre_exposure);
    /// What the device does: one pass over all images, then their mips. Leaves the atlas (and the depth, if it is kept) for
    /// fragment shaders to read.
    void record(vk::CommandBuffer commands);

    /// The same world drawn straight into a target, through one image alone: for comparison. Not beside prepare and record.
    void prepare_plain(const PlannedImage& image, const EyeEvent& eye_event);
    void record_plain(vk::CommandBuffer commands, const Target& target);

    /// Of the light's numbers four each; where something moves one more: how much of a texel is covered.
    const std::vector<Image>& atlases() const { return atlases_; }
    const Image& depth() const { return depth_; }
    bool layered() const { return layered_; } ///< something that moves is in view
    vk::BufferView tiles() const { return *tiles_view_; } ///< TileTable, as texels
    std::uint64_t tiles_serial() const { return tiles_.serial; }
    std::size_t triangles() const { return triangles_; } ///< sent to the device, all images
    vk::DeviceSize memory() const;

private:
    void fit(glm::ivec2 atlas_size, int levels);
    void upload(std::span<const EyeEvent> layers, bool plain);
    void write_set();
    shared::CubeConstants constants_of(const EyeEvent& eye_event, bool plain) const;
    Formats formats(bool layered) const;
    void draw_images(vk::CommandBuffer commands, const TargetKind& kind, bool plain);
    void make_mips(vk::CommandBuffer commands, const Image& atlas);

    Device& device_;
    Pipelines& pipelines_;
    const GpuWorld& world_;
    Quality quality_;
    bool keeps_depth_, sky_;
    bool layered_ = false; ///< something that moves is in view; the sky is then the warp's
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::raii::DescriptorSet set_ = nullptr;
    Buffer constants_, instances_, visible_, tiles_, times_; ///< times_: null without any
    vk::raii::BufferView tiles_view_ = nullptr;
    vk::DeviceSize stride_; ///< of constants_: one for each layer
    std::vector<Image> atlases_, atlas_samples_;
    Image depth_, depth_samples_;
    std::vector<PlannedImage> images_;
    std::vector<shared::TimeEntry> time_writes_; ///< kept for their room, as are blits_
    std::vector<vk::ImageBlit> blits_;
    std::vector<double> contractions_; ///< of each layer
    glm::ivec2 area_{0};
    double pre_exposure_ = 1;
    int levels_ = 1;
    bool repeatable_ = false;
    DrawList list_;
    std::size_t triangles_ = 0;
    std::array<std::uint64_t, 5> written_{}; ///< serials of the buffers that set_ holds
};

} // namespace starbow
