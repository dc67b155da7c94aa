#pragma once
#include "gpu_world.h"
#include "mip_chain.h"
#include "runtime/plan/cube_map_plan.h"

namespace starbow {

/// The images that one eye's cube map is drawn into: an atlas for each four spectral coefficients, with their samples, and
/// the depth. Where something moves, one more atlas holds the covered share of each texel.
class CubeTarget {
public:
    /// The quality's samples and formats stay for the object's life. keeps_depth: shaders read the depth afterwards.
    CubeTarget(Device& device, Pipelines& pipelines, const GpuWorld& world, const Quality& quality, bool keeps_depth);

    /// on: an atlas gets exactly the plan's size in every frame. Coordinates in it are then rounded alike, and equal
    /// shots have equal bytes. off: the atlas only grows, which takes less time.
    void repeatable(bool on) { repeatable_ = on; }
    /// Gives the images back; the next fit() makes those that its plan needs. The device must have finished with them.
    void release();
    /// Makes room. Contents are lost where there was too little.
    void fit(glm::ivec2 size, int levels);
    /// Makes room in the depth alone, for a picture without an atlas.
    void fit_depth(glm::ivec2 size);

    /// The atlases that a frame draws. several_rest_frames: something that moves is in view. light: only coefficients
    /// need more than the first atlas.
    struct Use {
        bool several_rest_frames = false;
        StoredLight light = StoredLight::coefficients;
    };
    /// Their formats and samples.
    TargetKind kind(Use use) const;
    /// Begins rendering into an area from the corner on. clear: the colour of each atlas that is drawn. scenes: as
    /// Device::begin_rendering's.
    void begin(vk::CommandBuffer commands, Use use, glm::ivec2 area, std::span<const glm::vec4> clear, std::uint32_t scenes);
    /// Begins rendering into a target of its own, with this object's depth.
    void begin_plain(vk::CommandBuffer commands, const Target& target, const glm::vec4& clear);
    /// Ends the rendering of begin(), and makes the mips of the images. Afterwards fragment shaders may read the atlases,
    /// and the depth if it is kept.
    void end(vk::CommandBuffer commands, Use use, std::span<const PlannedImage> images, int levels);

    const std::vector<Image>& atlases() const { return atlases_; }
    const Image& depth() const { return depth_; }
    vk::DeviceSize memory() const;

private:
    bool uses(Use use, std::size_t atlas) const;
    static void make_mips(
        vk::CommandBuffer commands, const MipChain& chain, std::span<const PlannedImage> images, std::uint32_t levels);

    Device& device_;
    Pipelines& pipelines_;
    Formats formats_; ///< of a world in which something moves; without the last one of others
    int samples_;
    bool in_several_rest_frames_, keeps_depth_, repeatable_ = false;
    std::vector<Image> atlases_, atlas_samples_;
    Image depth_, depth_samples_;
    std::vector<std::unique_ptr<MipChain>> chains_; ///< of the atlases; empty where they have one level
};

} // namespace starbow
