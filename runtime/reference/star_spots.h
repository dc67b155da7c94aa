#pragma once
#include "eye.h"
#include "view_rays.h"
#include "runtime/world/stars.h"

namespace starbow {

/// The sky's stars as one eye has them: those that nothing hides, each where it sees it.
class StarSpots {
public:
    /// beside: of the eye for a star's direction, as TracingEye::look has it.
    StarSpots(const std::vector<Star>& stars, const StarSky& sky, const TracingEye& eye, const Colours& colours,
        const std::function<glm::dvec3(const glm::dvec3& way)>& beside);

    /// The light that stars bring to a pixel: of those whose spots reach it, the spot's part there.
    glm::dvec3 light(const ViewRays& rays, const glm::ivec2& pixel, int channel) const;

private:
    struct Spot {
        glm::dvec3 way; ///< unit, cockpit
        glm::dvec3 light; ///< over a solid angle, as radiance is
    };
    void sort(std::size_t first, std::size_t end, int axis);
    void near(std::size_t first, std::size_t end, int axis, const glm::dvec3& way, double reach,
        std::vector<std::size_t>& found) const;
    std::vector<Spot> spots_; ///< a k-d tree: the middle one of a range parts it along an axis
};

} // namespace starbow
