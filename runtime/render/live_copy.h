#pragma once
#include "resources.h"

namespace starbow {

/// Copies a coarse version of a finished picture to the processor, for a remote's live picture: every so many rows, and of
/// these every so many pixels, so that the widest result is most_px. It makes no picture wait.
class LiveCopy {
public:
    static constexpr std::uint32_t most_px = 480;

    explicit LiveCopy(const Device& device)
        : device_(device)
    {
    }
    /// Copies rows of a finished target of a live format, whose image was made for transfers; it stays a target.
    void record(vk::CommandBuffer commands, const Target& target);
    /// The copy, three bytes a pixel, sRGB, from the top. The device must have finished the commands. Returns its size;
    /// 0 where nothing was recorded since the last call.
    glm::ivec2 take(std::vector<std::uint8_t>& rgb);

private:
    const Device& device_;
    Buffer rows_;
    vk::Extent2D extent_; ///< of the last recorded target
    std::uint32_t step_ = 0; ///< between copied rows and pixels; 0: nothing is recorded
    bool blue_first_ = false;
};

/// True for the formats that a LiveCopy reads.
bool is_live_format(vk::Format format);

} // namespace starbow
