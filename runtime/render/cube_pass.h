#pragma once
#include "cube_target.h"
#include "cube_uploads.h"

namespace starbow {

/// Near plane of every picture of the world, scene units. Reversed z keeps its precision at any ratio of far to near.
constexpr double near_distance = 1e-6;

/// Draws a cube-map plan: the world around one eye, each rest frame by itself, into the atlas that the warp pass reads.
/// Holds the device's memory for it. No frame needs data of an earlier one.
class CubePass {
public:
    CubePass(Device& device, Pipelines& pipelines, const GpuWorld& world, const Quality& quality, bool keeps_depth);

    void repeatable(bool on) { target_.repeatable(on); } ///< as CubeTarget's

    /// The angle of a pixel in the ship, radians: lines and points are as wide. 0: a texel.
    void pixel(double angle_rad) { pixel_rad_ = angle_rad; }

    /// Sets the quality from the next prepare() on. Samples and formats must be the same as before.
    void adopt(const Quality& quality) { quality_ = quality; }
    void release() { target_.release(); } ///< as CubeTarget's

    /// The processor's part: culls, makes room and uploads. The device must have finished the frame before. Every stored
    /// radiance is multiplied by pre_exposure. eye_events: the eye events of the plan's rest frames.
    void prepare(const CubeMapPlan& plan, std::span<const EyeEvent> eye_events, StoredLight light, double pre_exposure);
    /// The device's part: one pass over all images, then their mips. Afterwards fragment shaders may read the atlas, and
    /// the depth if it is kept.
    void record(vk::CommandBuffer commands);

    /// Draws the same world into a target through one single image, for comparison. Not beside prepare() and record().
    void prepare_plain(const PlannedImage& image, const EyeEvent& eye_event);
    void record_plain(vk::CommandBuffer commands, const Target& target);

    /// Each atlas holds four spectral coefficients. Where something moves, one more holds the covered share of each
    /// texel.
    const std::vector<Image>& atlases() const { return target_.atlases(); }
    StoredLight light() const { return use_.light; } ///< of the last prepare()
    const Image& depth() const { return target_.depth(); }
    const DrawList& list() const { return list_; } ///< of the last prepare()
    bool several_rest_frames() const { return use_.several_rest_frames; } ///< something that moves is in view
    vk::BufferView tiles() const { return uploads_.tiles(); } ///< TileTable, as texels
    std::uint64_t tiles_serial() const { return uploads_.tiles_serial(); }
    std::size_t triangles() const; ///< sent to the device, all images
    vk::DeviceSize memory() const { return target_.memory(); }

private:
    /// Pipeline, pictures and culling of a surface. Draws of one image with the same state are one call.
    struct SurfaceState {
        SurfaceVariant variant;
        std::size_t material_set; ///< index of GpuWorld::material_sets
        bool double_sided;
        bool operator==(const SurfaceState&) const = default;
    };
    /// Draws of one image that are one call: `count` of DrawList::draws, from `first`.
    struct Run {
        SurfaceState state;
        std::uint32_t image;
        bool blended;
        std::uint32_t first, count;
    };
    /// The state that the commands have bound so far, so that nothing is bound twice.
    struct BoundState {
        vk::Pipeline pipeline;
        std::optional<std::size_t> material_set;
        std::optional<bool> double_sided;
        int rest_frame = -1; ///< whose uploads are
    };
    SurfaceState state_of(const Draw& draw) const;
    void group_draws(); ///< makes runs_, and sorts the list's draws by them
    SurfaceVariant variant_of(const Draw& draw, StoredLight light) const;
    float line_width(const PlannedImage& image) const; ///< texels
    /// All images' surfaces, then the sky behind them, then what is blended.
    void draw_images(vk::CommandBuffer commands, const TargetKind& kind);
    void fill_clip_hole(vk::CommandBuffer commands, const PlannedImage& image) const;
    void draw_surfaces(vk::CommandBuffer commands, const TargetKind& kind, bool blended, BoundState& bound);
    void find_skies(); ///< of the images that the sky is drawn into
    void draw_sky(vk::CommandBuffer commands, const TargetKind& kind, BoundState& bound);
    void bind(vk::CommandBuffer commands, vk::Pipeline pipeline, std::size_t material_set, bool double_sided,
        BoundState& bound) const;
    void bind_uploads(vk::CommandBuffer commands, int rest_frame, BoundState& bound) const;
    void push(vk::CommandBuffer commands, const shared::CubePush& push) const;
    shared::CubePush constants_of(const PlannedImage& image) const;

    Device& device_;
    Pipelines& pipelines_;
    const GpuWorld& world_;
    Quality quality_;
    CubeTarget target_;
    CubeUploads uploads_;
    bool sky_; ///< it has a gradient or a panorama, so that clearing does not draw it
    CubeTarget::Use use_; ///< where something that moves is in view, the warp pass draws the sky
    std::vector<PlannedImage> images_;
    std::vector<EyeEvent> eye_events_; ///< one for each rest frame
    double pixel_rad_ = 0;
    glm::ivec2 area_{0};
    double pre_exposure_ = 1;
    int levels_ = 1;
    DrawList list_;
    std::vector<shared::SkyImage> skies_;
    std::vector<Run> runs_; ///< by image, in the order in which they are drawn
    std::vector<std::size_t> run_of_draw_; ///< of group_draws, kept for their memory
    std::vector<Draw> grouped_;
};

} // namespace starbow
