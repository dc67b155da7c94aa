#pragma once
#include "config/model/layout.h"
#include <optional>

namespace starbow {

/// picture.h has the contract of each function; a direction whose azimuth lies beside the picture is at the nearer side.
class EquirectangularRays {
public:
    EquirectangularRays(const Equirectangular& equirectangular, glm::ivec2 size);
    std::optional<glm::dvec3> direction(glm::dvec2 pixel) const; ///< nullopt beyond the poles
    std::optional<glm::dvec2> pixel(const glm::dvec3& direction) const; ///< for a pole: its row's middle column
    double pixel_angle(glm::dvec2 pixel) const; ///< exact for the whole pixel, but for points within half a pixel of a pole

private:
    glm::dmat3 turned_;
    double middle_, top_; ///< azimuth of the middle column; elevation of the upper edge
    double half_width_; ///< pixels
    glm::dvec2 step_; ///< radians a column and a row
};

} // namespace starbow
