#pragma once
#include "displays/compile/cone_hierarchy.h"
#include "resources.h"
#include "runtime/hud/instruments.h"
#include "shaders/shared_structs.h"
#include <functional>
#include <limits>

namespace starbow {

/// A distance that a shader has written: infinite for the sky.
inline float distance_of(float written)
{
    return written > 0.1 * SKY_DISTANCE ? std::numeric_limits<float>::infinity() : written;
}

/// A ray of the probe.
struct ProbeRay {
    glm::dvec3 direction; ///< unit, in the cockpit
    std::optional<std::size_t> view{}; ///< the view whose eye it leaves: index into ViewSet::all; nullopt: probed_view's
    bool operator==(const ProbeRay&) const = default;
};

/// Reads the picture's light in a few directions. The measuring pass draws one pixel for each; they are read back after
/// the frame.
class Probe {
public:
    /// pixel_angle: side of the averaged pixel, radians.
    Probe(const Device& device, const std::vector<ProbeRay>& rays, double pixel_angle);

    /// The cone hierarchy of one probe, for the plan. It does not move in memory while this object lives.
    const ConeHierarchy& view(std::size_t i) const { return *pixels_[i].cones; }
    const ProbeRay& ray(std::size_t i) const { return pixels_[i].ray; }
    std::size_t count() const { return pixels_.size(); }
    /// True if the probe has these rays and this angle already.
    bool looks(const std::vector<ProbeRay>& rays, double pixel_angle) const;

    /// draw: draws pixel (i, 0) of the target through direction = M (x, y, 1); x and y count from that pixel's corner.
    void record(
        vk::CommandBuffer commands, const std::function<void(std::size_t i, const glm::dmat3& cockpit_from_pixel)>& draw);
    /// The last frame's light, directions in the ship in motion axes, and in the world in the axes of its cube map. Empty
    /// before the first frame.
    std::vector<Probed> read() const;

private:
    struct Pixel {
        ProbeRay ray;
        glm::dmat3 cockpit_from_pixel;
        std::shared_ptr<ConeHierarchy> cones;
    };
    std::vector<Pixel> pixels_;
    const Device& device_;
    double pixel_angle_;
    std::array<Image, 3> images_;
    Buffer back_;
    bool drawn_ = false;
};

} // namespace starbow
