#pragma once
#include "resources.h"
#include "runtime/light/exposure.h"

namespace starbow {

/// Samples of all views' luminance, on the device and read back; the exposure follows from them. A view's samples lie in
/// one cell of a small picture. Its stars have a cell of their own, with one sample for each star: stars are too small
/// for a coarse grid to meet them.
class Meter {
public:
    /// views: the size of each in pixels; 0: the view does not count. stars: number of the stars that count.
    Meter(const Device& device, std::span<const glm::ivec2> views, std::uint32_t stars);

    struct Cell {
        glm::ivec2 corner{0}, size{0};
    };
    const Cell& cell(std::size_t view) const { return cells_[view]; }
    const Cell& star_cell(std::size_t view) const { return star_cells_[view]; }
    int every() const { return every_; } ///< one star of so many has a sample

    /// Before the samples are drawn, and after.
    vk::RenderingAttachmentInfo begin(vk::CommandBuffer commands) const;
    vk::Extent2D extent() const { return picture_.extent; }
    void end(vk::CommandBuffer commands);

    /// The samples of the last frame, of surfaces and of stars; empty before the first. The device must have finished
    /// that frame.
    std::span<const LuminanceSample> view() const;
    std::span<const LuminanceSample> stars() const;
    /// The same of one view; they can be replaced.
    std::span<LuminanceSample> view(std::size_t view);
    std::span<LuminanceSample> stars(std::size_t view);

    std::size_t across() const { return picture_.extent.width; } ///< samples of a row of view()

    vk::DeviceSize memory() const { return picture_.bytes; }

private:
    std::span<LuminanceSample> rows(const Cell& cell);

    std::vector<Cell> cells_, star_cells_;
    int every_ = 1, view_rows_ = 0;
    Image picture_;
    Buffer back_;
    bool drawn_ = false;
};

} // namespace starbow
