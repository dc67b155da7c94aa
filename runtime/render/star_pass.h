#pragma once
#include "seen_stars.h"

namespace starbow {

/// Draws the stars alone into a picture of scene-linear light, pixel for pixel an output's; the warp pass adds it. One
/// picture serves all outputs of a frame in turn. In a world without stars it is empty.
///
/// Each star searches its pixel. The work for each star is then bounded at every speed; a pixel ahead would have to
/// search a tenth of the sky at gamma 100. Where a display is a direction map, InverseMap begins the search.
class StarPass {
public:
    /// exact: measured numbers need all bits.
    StarPass(Device& device, const Pipelines& pipelines, const GpuWorld& world, const SeenStars& seen, bool exact);

    bool on() const { return seen_.on(); }
    /// Makes room for an output. exact: the sums need all bits. The device must have finished the frame before.
    void fit(vk::Extent2D extent, bool exact);
    /// One of those who see the stars.
    struct Observer {
        glm::dmat3 motion_from_world;
        bool false_colours;
    };
    void prepare(std::span<const Observer> observers);

    /// Between begin and end the viewports are drawn: bind a pipeline of Pipelines::stars for format(), its set 0 and the
    /// push constants, then call draw() with the stars that may be in view. Afterwards fragment shaders may read the
    /// picture.
    void begin(vk::CommandBuffer commands, vk::Extent2D extent);
    void draw(vk::CommandBuffer commands, std::size_t observer, glm::ivec2 corner, glm::ivec2 size, int instances,
        std::span<const StarRun> stars);
    void end(vk::CommandBuffer commands);

    /// Draws the meter's samples into the meter's picture: each `every`-th of the brightest stars is a pixel of the
    /// rectangle, row by row. Bind a pipeline of Pipelines::star_meter and the rest as for draw(); the push constant `view`
    /// holds the rectangle's size and `every`.
    void sample(vk::CommandBuffer commands, std::size_t observer, glm::ivec2 corner, glm::ivec2 size, int every,
        bool channels) const;

    const Image& picture() const { return picture_; }
    vk::Format format() const { return format_; }

private:
    Device& device_;
    const Pipelines& pipelines_;
    const GpuWorld& world_;
    const SeenStars& seen_;
    bool exact_;
    vk::Format format_;
    vk::raii::DescriptorPool pool_ = nullptr;
    std::array<vk::raii::DescriptorSet, 2> sets_ = {nullptr, nullptr}; ///< standard observer; false colours
    std::vector<bool> false_colours_; ///< by observer
    void bind(vk::CommandBuffer commands, std::size_t observer) const;
    void write_sets();

    Buffer constants_; ///< one for each observer
    vk::DeviceSize stride_ = 0;
    Image picture_;
};

} // namespace starbow
