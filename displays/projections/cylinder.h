#pragma once
#include "config/model/layout.h"
#include <optional>

namespace starbow {

/// A cylinder of radius 1 about the eye's upright axis, unrolled. picture.h has the contract of each function; a direction
/// whose azimuth lies beside the picture is at the nearer side.
class CylinderRays {
public:
    CylinderRays(const Cylinder& cylinder, glm::ivec2 size);
    std::optional<glm::dvec3> direction(glm::dvec2 pixel) const;
    std::optional<glm::dvec2> pixel(const glm::dvec3& direction) const; ///< nullopt straight up and down
    double pixel_angle(glm::dvec2 pixel) const; ///< at the point; for the whole pixel to the square of its angle

private:
    glm::dmat3 turned_;
    double middle_, top_; ///< azimuth of the middle column; height of the upper edge
    double half_width_; ///< pixels
    glm::dvec2 step_; ///< radians a column, height a row
};

} // namespace starbow
