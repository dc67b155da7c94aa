#pragma once
#include "frame_renderer.h"
#include "runtime/images/capture.h"
#include <filesystem>
#include <memory>

namespace starbow {

/// Off-screen pictures of one layout in one world.
class OffscreenRenderer {
public:
    /// Numbers as well as pictures if `measured`.
    OffscreenRenderer(Device& device, Pipelines& pipelines, const GpuWorld& world, const Layout& layout,
        const Quality& quality, bool measured);

    /// Each output as RGBA8, rows from the top.
    std::vector<std::vector<std::uint8_t>> picture(const Shot& shot, const Panel* hud = nullptr);

    /// One output's numbers: the EXR's channels. Shared by all who check the picture.
    Channels numbers(const Shot& shot, std::size_t output);

    /// The exposure for what the shot shows in all outputs together, EV; nothing where all is dark.
    std::optional<double> metered(const Shot& shot);

    /// What the shot shows along the directions that the frame was told to measure.
    std::vector<Probed> probed(const Shot& shot);

    const Layout& layout() const { return layout_; }
    FrameRenderer& frame() { return frame_; }
    Target target(std::size_t output) const;

private:
    Device& device_;
    Layout layout_;
    FrameRenderer frame_;
    std::vector<Image> images_;
};

/// What `starbow render` does: draws all outputs, then writes DIR/<output>.png (and .exr). Writes nothing if anything fails
/// before all are complete in memory. Returns the pictures.
std::vector<std::vector<std::uint8_t>> render_still(const std::filesystem::path& directory, OffscreenRenderer& renderer,
    const Shot& shot, bool exr, const Panel* hud = nullptr);

} // namespace starbow
