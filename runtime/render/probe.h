#pragma once
#include "displays/compile/cone_hierarchy.h"
#include "resources.h"
#include "runtime/hud/instruments.h"
#include <functional>

namespace starbow {

/// Reads the picture's light in a few directions. The measuring pass draws one pixel for each; they are read back after
/// the frame.
class Probe {
public:
    /// directions: unit, in the cockpit. pixel_angle: side of the averaged pixel, radians.
    Probe(const Device& device, const std::vector<glm::dvec3>& directions, double pixel_angle);

    /// The cone hierarchy of one probe, for the plan. It does not move in memory while this object lives.
    const ConeHierarchy& view(std::size_t i) const { return *pixels_[i].cones; }
    std::size_t count() const { return pixels_.size(); }
    /// True if the probe has these directions and this angle already.
    bool looks(const std::vector<glm::dvec3>& directions, double pixel_angle) const;

    /// draw: draws pixel (i, 0) of the target through direction = M (x, y, 1); x and y count from that pixel's corner.
    void record(
        vk::CommandBuffer commands, const std::function<void(std::size_t i, const glm::dmat3& cockpit_from_pixel)>& draw);
    /// The last frame's light, directions in motion axes. Empty before the first frame.
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
