#pragma once
#include "gpu_world.h"

namespace starbow {

/// The picture of the stars alone that the warp pass adds to what it sees: scene-linear light, pixel for pixel an output's.
/// One for all outputs of a frame, one after the other. Of a world without stars it is nothing.
///
/// Each star looks for its pixel, rather than each pixel for its stars: the work per star is then bounded at every speed,
/// while at gamma 100 a pixel ahead would have a tenth of the sky to look through. Where a display is a map of directions,
/// InverseMap begins the search.
class StarPass {
public:
    StarPass(Device& device, const Pipelines& pipelines, const GpuWorld& world);

    bool on() const { return world_.star_count > 0; }
    /// Makes room for an output. The device must have finished the frame before.
    void fit(vk::Extent2D extent);
    /// One turn for each observer.
    void prepare(std::span<const glm::dmat3> motion_from_world, bool false_colours);

    /// From begin to end the viewports are drawn: bind a pipeline of Pipelines::stars for format(), its set 0 and the push
    /// constants, then draw() of those stars that may be seen. The picture is then for fragment shaders to read.
    void begin(vk::CommandBuffer commands, vk::Extent2D extent);
    void draw(vk::CommandBuffer commands, std::size_t observer, glm::ivec2 corner, glm::ivec2 size, int instances,
        std::span<const StarRun> stars);
    void end(vk::CommandBuffer commands);

    /// For the meter, into its own picture: each `every`-th star is a pixel of the rectangle, row by row. Bind a pipeline of
    /// Pipelines::star_meter and the rest as above, with the push constant `view` telling the rectangle's size and `every`.
    void sample(vk::CommandBuffer commands, std::size_t observer, glm::ivec2 corner, glm::ivec2 size, int every,
        bool channels) const;

    const Image& picture() const { return picture_; }
    vk::Format format() const { return format_; }

private:
    Device& device_;
    const Pipelines& pipelines_;
    const GpuWorld& world_;
    vk::Format format_;
    vk::raii::DescriptorPool pool_ = nullptr;
    std::array<vk::raii::DescriptorSet, 2> sets_ = {nullptr, nullptr}; ///< for eyes, for false colours
    bool false_colours_ = false;
    void bind(vk::CommandBuffer commands, std::size_t observer) const;
    void write_sets();

    Buffer constants_; ///< one for each observer
    vk::DeviceSize stride_ = 0;
    Image picture_;
};

} // namespace starbow
