#pragma once
#include "displays/compile/cone_hierarchy.h"
#include "resources.h"
#include "runtime/hud/instruments.h"
#include <functional>

namespace starbow {

/// What the picture shows in a few directions, as numbers: drawn by the pass that fills an EXR, a pixel each, and read back
/// when the device has finished the frame.
class Probe {
public:
    /// directions: unit, in the cockpit. pixel_angle: of the light that is averaged, radians.
    Probe(const Device& device, const std::vector<glm::dvec3>& directions, double pixel_angle);

    /// For the plan: what the cube map must hold. None moves while this object lives.
    const ConeHierarchy& view(std::size_t i) const { return *pixels_[i].cones; }
    std::size_t count() const { return pixels_.size(); }
    /// Whether it looks there already.
    bool looks(const std::vector<glm::dvec3>& directions, double pixel_angle) const;

    /// draw: draws pixel (i, 0) of the target through direction = M (x, y, 1), x and y from that pixel's corner.
    void record(
        vk::CommandBuffer commands, const std::function<void(std::size_t i, const glm::dmat3& cockpit_from_pixel)>& draw);
    /// Of the last frame, in motion axes. Empty before one was finished.
    std::vector<Probed> read() const;

private:
    struct Pixel {
        glm::dvec3 direction;
        glm::dmat3 cockpit_from_pixel;
        std::shared_ptr<ConeHierarchy> cones;
    };
    std::vector<Pixel> pixels_;
    double pixel_angle_;
    std::array<Image, 3> images_;
    Buffer back_;
    bool drawn_ = false;
};

} // namespace starbow
