#pragma once
#include "instruments.h"
#include "pipelines.h"
#include "runtime/shared.h"
#include <array>

namespace starbow {

/// What is laid over every viewport for who measures, in the order of the key that steps through them.
enum class Overlay { off, aim, grid, ring, distance, emission };
constexpr std::array<const char*, 6> overlay_names = {"off", "aim", "grid", "ring", "distance", "emission"};

/// The scales of the false colours.
struct OverlayScale {
    double nearest_s = 1, farthest_s = 1000; ///< ends of the colours, seconds of light
    double emission_step_s = 1; ///< between contours of equal times of emission
};
/// Round ends around whatever a world has, as seen from a place, and a step that gives some ten contours near by.
OverlayScale overlay_scale(const World& world, const glm::dvec3& place, double seconds_per_time_unit);

/// Draws them. Holds the constants of each pane.
class OverlayPass {
public:
    OverlayPass(const Device& device, Pipelines& pipelines, std::size_t panes);

    struct What {
        Overlay overlay = Overlay::off;
        std::array<std::optional<Spot>, 2> marks;
        OverlayScale scale;
    };
    /// vantage: the pane's own eye. The device must have finished the frame before.
    void prepare(std::size_t pane, const What& what, const Vantage& vantage, double seconds_per_time_unit);

    /// Draws into the rendering under way; warp_set, constants: as for the pane's warp.
    void draw(vk::CommandBuffer commands, std::size_t pane, const WarpVariant& variant, Overlay overlay,
        vk::DescriptorSet warp_set, const shared::ViewPush& constants, glm::ivec2 corner, glm::ivec2 size,
        vk::Format target);

private:
    Pipelines& pipelines_;
    Buffer constants_;
    vk::raii::DescriptorPool pool_ = nullptr;
    std::vector<vk::raii::DescriptorSet> sets_;
};

} // namespace starbow
