#pragma once
#include "eye.h"
#include "runtime/world/stars.h"
#include "view_rays.h"

namespace starbow {

/// The visible stars' spots as one eye sees them.
class StarSpots {
public:
    /// beside: the eye's place for a direction, as in TracingEye::look.
    StarSpots(const std::vector<Star>& stars, const StarSky& sky, double unit_m, const TracingEye& eye,
        const Colours& colours, const std::function<glm::dvec3(const glm::dvec3& way)>& beside);

    /// The light of stars in a pixel: the parts there of the spots that reach it.
    glm::dvec3 light(const ViewRays& rays, const glm::ivec2& pixel, int channel) const;

private:
    struct Spot {
        glm::dvec3 way; ///< unit, cockpit
        glm::dvec3 light; ///< divided by a solid angle, as a radiance
    };
    void sort(std::size_t first, std::size_t end, int axis);
    void near(std::size_t first, std::size_t end, int axis, const glm::dvec3& way, double reach,
        std::vector<std::size_t>& found) const;
    std::vector<Spot> spots_; ///< a k-d tree: the middle one of a range divides it along an axis
};

} // namespace starbow
