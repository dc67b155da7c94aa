#pragma once
#include "bloom_pass.h"
#include "displays/compile/compiled_view.h"
#include "runtime/plan/lit_pixels.h"
#include <memory>

namespace starbow {

/// A view of the layout with its objects on the device.
struct ViewState {
    std::size_t output = 0; ///< index into ViewSet::outputs; none for the inset
    std::size_t eye = 0; ///< index of its eye's cube map in EyeCubes::all
    std::size_t observer = 0; ///< index into EyeCubes::observers
    CompiledView compiled;
    std::optional<std::size_t> map; ///< index into ViewSet::maps
    Image label; ///< label of the test patterns, made at their first use
    float shown_part = 1; ///< see pattern_label.h; for test patterns
    vk::raii::DescriptorSet warp_set = nullptr, label_set = nullptr;
    std::vector<std::uint64_t> written; ///< serials of the two sets' resources
    vk::Rect2D hud_box;
    std::unique_ptr<BloomPass> bloom; ///< null without glow
    glm::dvec3 cube_m{0}; ///< place from which its cube map is drawn, cockpit frame, metres
    glm::dvec3 beside_m{0}; ///< the eye's place relative to cube_m
    LitPixels pixels; ///< at which something shows, for this frame
    Buffer globes; ///< GlobeConstants; null in worlds without
    double brightest_glow = 0; ///< GpuGlobes::brightest_glow, or infinite by FrameState::glows
    Buffer rest_frames; ///< RestFrameConstants; null where no shader reads them
    const View& geometry() const { return compiled.view; }
};

} // namespace starbow
