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
    SurfaceVariant variant_of(const Draw& draw, StoredLight light) const;
    float line_width(const PlannedImage& image) const; ///< texels
    void draw_images(vk::CommandBuffer commands, const TargetKind& kind);

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
};

} // namespace starbow
