#pragma once
#include "frame_renderer.h"

namespace starbow {

/// A small flat picture of another shot, to be laid over the views as a placard. It has a cube map of its own, as large as
/// its pixels need.
class Inset {
public:
    static constexpr double fov_y_deg = 60;
    static constexpr double aspect = 0.75; ///< height over width

    /// width: pixels. Throws InputError, NoRoom.
    Inset(Device& device, Pipelines& pipelines, const GpuWorld& world, const Quality& quality, int width);

    /// Draws it; from then on picture() can be sampled.
    void record(vk::CommandBuffer commands, const Shot& shot);
    const Image& picture() const { return picture_; }
    FrameRenderer& frame() { return frame_; }

private:
    Image picture_;
    FrameRenderer frame_;
};

} // namespace starbow
