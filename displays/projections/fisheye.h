#pragma once
#include "config/model/layout.h"
#include <optional>

namespace starbow {

/// A domemaster: the dome in a circle, seen from its middle with the eye towards the zenith. A function g of the angle a
/// from the zenith grows evenly from the centre to the rim: g = a (equidistant), 2 sin(a/2) (equisolid), 2 tan(a/2)
/// (stereographic), sin(a) (orthographic). A visitor who faces the front and tilts the head back sees the front below the
/// zenith and the right hand still on the right. In the picture, which is no mirror image, the front is therefore at the
/// bottom and the right is on the right. picture.h has the contract of each function.
class FisheyeRays {
public:
    FisheyeRays(const Fisheye& fisheye, glm::ivec2 size);
    std::optional<glm::dvec3> direction(glm::dvec2 pixel) const;
    std::optional<glm::dvec2> pixel(const glm::dvec3& direction) const;

    /// Computed at the point `pixel`. Up to 170 degrees from the zenith (75 in an orthographic picture) the solid angle
    /// over the whole pixel differs from its square by less than step² of itself; step is the angle between pixels at the
    /// centre. In equidistant pictures it is a tenth of that: 5e-6 in a domemaster of 1024 pixels.
    double pixel_angle(glm::dvec2 pixel) const;

private:
    FisheyeMapping mapping_;
    glm::dvec3 zenith_, right_, down_; ///< of the picture
    glm::dvec2 centre_;
    double radius_, rim_, scale_; ///< pixels; radians from the zenith; of g from one pixel to the next
};

} // namespace starbow
