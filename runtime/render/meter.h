#pragma once
#include "resources.h"
#include "runtime/light/exposure.h"

namespace starbow {

/// The whole view in a few thousand samples, on the device and back: what the exposure is chosen by. A view's samples stand
/// in a cell of one small picture, and its stars in another, a sample each: they are too small to be met by chance.
class Meter {
public:
    /// views: the size of each in pixels, 0 where it does not count. stars: of the world.
    Meter(const Device& device, std::span<const glm::ivec2> views, std::uint32_t stars);

    struct Cell {
        glm::ivec2 corner{0}, size{0};
    };
    const Cell& cell(std::size_t view) const { return cells_[view]; }
    const Cell& star_cell(std::size_t view) const { return star_cells_[view]; }
    int every() const { return every_; } ///< of so many stars one has a sample

    /// Before the samples are drawn, and after.
    vk::RenderingAttachmentInfo begin(vk::CommandBuffer commands) const;
    vk::Extent2D extent() const { return picture_.extent; }
    void end(vk::CommandBuffer commands);

    /// What was drawn last, surfaces and stars; the device must have finished it. Empty before that.
    std::span<const LuminanceSample> view() const;
    std::span<const LuminanceSample> stars() const;

    vk::DeviceSize memory() const { return picture_.bytes; }

private:
    std::vector<Cell> cells_, star_cells_;
    int every_ = 1, view_rows_ = 0;
    Image picture_;
    Buffer back_;
    bool drawn_ = false;
};

} // namespace starbow
