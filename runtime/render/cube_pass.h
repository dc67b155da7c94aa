#pragma once
#include "gpu_world.h"
#include "runtime/plan/cube_map_plan.h"
#include "runtime/plan/cull.h"

namespace starbow {

/// Near plane of every picture of the world, scene units. Reversed z keeps its precision at any ratio of far to near.
constexpr double near_distance = 1e-6;

/// A picture that a pass draws into, a swapchain's image or one of our own. It is in eColorAttachmentOptimal meanwhile.
struct Target {
    vk::Image image;
    vk::ImageView view;
    vk::Extent2D extent;
    vk::Format format;
};

/// Draws a cube-map plan: the world around one eye, each rest frame by itself, into the atlas that the warp pass reads.
/// Holds the device's memory for it. No frame needs data of an earlier one.
class CubePass {
public:
    CubePass(Device& device, Pipelines& pipelines, const GpuWorld& world, const Quality& quality, bool keeps_depth);

    /// on: the atlas gets exactly the plan's size in every frame. Coordinates in it are then rounded alike, and equal
    /// shots have equal bytes. off: the atlas only grows, which takes less time.
    void repeatable(bool on) { repeatable_ = on; }

    /// Sets the quality from the next prepare() on. Samples and formats must be the same as before.
    void adopt(const Quality& quality) { quality_ = quality; }

    /// The processor's part: culls, makes room and uploads. The device must have finished the frame before. Every stored
    /// radiance is multiplied by pre_exposure. layers: the eye events of the plan's rest frames.
    void prepare(const CubeMapPlan& plan, std::span<const EyeEvent> layers, double pre_exposure);
    /// The device's part: one pass over all images, then their mips. Afterwards fragment shaders may read the atlas, and
    /// the depth if it is kept.
    void record(vk::CommandBuffer commands);

    /// Draws the same world into a target through one single image, for comparison. Not beside prepare() and record().
    void prepare_plain(const PlannedImage& image, const EyeEvent& eye_event);
    void record_plain(vk::CommandBuffer commands, const Target& target);

    /// Each atlas holds four spectral coefficients. Where something moves, one more holds the covered share of each
    /// texel.
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
    bool layered_ = false; ///< something that moves is in view; the warp pass then draws the sky
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::raii::DescriptorSet set_ = nullptr;
    Buffer constants_, instances_, visible_, tiles_, times_; ///< times_: null without any
    vk::raii::BufferView tiles_view_ = nullptr;
    vk::DeviceSize stride_; ///< bytes from one rest frame's constants to the next
    std::vector<Image> atlases_, atlas_samples_;
    Image depth_, depth_samples_;
    std::vector<PlannedImage> images_;
    std::vector<shared::TimeEntry> time_writes_; ///< a member, as is blits_, so that its memory is reused
    std::vector<vk::ImageBlit> blits_;
    std::vector<double> contractions_; ///< one for each rest frame
    glm::ivec2 area_{0};
    double pre_exposure_ = 1;
    int levels_ = 1;
    bool repeatable_ = false;
    DrawList list_;
    std::size_t triangles_ = 0;
    std::array<std::uint64_t, 5> written_{}; ///< serials of the buffers that set_ holds
};

} // namespace starbow
