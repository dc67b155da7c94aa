#pragma once
#include "exposure.h"
#include "resources.h"

namespace starbow {

/// The whole view in a few thousand samples, on the device and back: what the exposure is chosen by. A pane's samples stand
/// in a cell of one small picture.
class Meter {
public:
    /// panes: the size of each in pixels, 0 where it does not count.
    Meter(const Device& device, std::span<const glm::ivec2> panes);

    struct Cell {
        glm::ivec2 corner{0}, size{0};
    };
    const Cell& cell(std::size_t pane) const { return cells_[pane]; }

    /// Before the samples are drawn, and after.
    vk::RenderingAttachmentInfo begin(vk::CommandBuffer commands) const;
    vk::Extent2D extent() const { return picture_.extent; }
    void end(vk::CommandBuffer commands);

    /// What was drawn last; the device must have finished it. Empty before that.
    std::span<const Glimpse> view() const;

    vk::DeviceSize memory() const { return picture_.bytes; }

private:
    std::vector<Cell> cells_;
    Image picture_;
    Buffer back_;
    bool drawn_ = false;
};

} // namespace starbow
