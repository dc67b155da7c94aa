#pragma once
#include "frame_renderer.h"
#include "runtime/images/capture.h"
#include <filesystem>
#include <memory>

namespace starbow {

/// Draws pictures of one layout in one world without a window.
class OffscreenRenderer {
public:
    /// measured: the renderer can also return numbers().
    OffscreenRenderer(Device& device, Pipelines& pipelines, const GpuWorld& world, const Layout& layout,
        const Quality& quality, bool measured);

    /// Each output as RGBA8, rows from the top.
    std::vector<std::vector<std::uint8_t>> picture(const Shot& shot, const Panel* hud = nullptr);

    /// One output's channels, as the EXR has them.
    Channels numbers(const Shot& shot, std::size_t output);

    /// The exposure for the shot in all outputs together, EV; nothing where all is dark.
    std::optional<double> metered(const Shot& shot);

    /// The curve by which everything in all outputs shows at once; nothing where all is dark. It begins from the shot's
    /// exposure as an eye's.
    std::optional<RangeCurve> ranged(const Shot& shot);

    /// The light along the directions of frame().measure()'s probes, for this shot.
    std::vector<Probed> probed(const Shot& shot);

    const Layout& layout() const { return layout_; }
    bool on_processor() const { return device_.on_processor(); }
    FrameRenderer& frame() { return frame_; }
    Target target(std::size_t output) const;

private:
    template <class Read> auto sampled(const Shot& shot, const Read& read);
    void read_numbers(std::size_t output, std::size_t layer, const MeasureTarget& target, Channels& channels);

    Device& device_;
    Layout layout_;
    FrameRenderer frame_;
    std::vector<Image> images_;
};

/// The quality in which a still's numbers are drawn: with a finer cube map, so that the outlines of bodies lie within half
/// a pixel and hardly a pixel's distance is that of the surface beside it.
Quality measured_quality(Quality quality);

/// Draws all outputs for `starbow render`, then writes DIR/<output>.png (and .exr). Writes nothing if any step fails
/// before all pictures are complete in memory. Returns the pictures.
std::vector<std::vector<std::uint8_t>> render_still(const std::filesystem::path& directory, OffscreenRenderer& renderer,
    const Shot& shot, bool exr, const Panel* hud = nullptr);

} // namespace starbow
