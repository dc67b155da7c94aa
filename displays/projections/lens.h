#pragma once
#include "config/model/layout.h"
#include "plane.h"
#include <array>

namespace starbow {

/// One colour of a headset's lens. At the distance r from the centre it shows g(r) = r f(r), as long as g grows from the
/// centre on. Beyond that it shows nothing, because the polynomial folds the picture back or has a pole. picture.h has
/// the contract of each function.
class LensRays {
public:
    LensRays(const Lens& lens, glm::ivec2 size, int colour); ///< colour: 0 red, 1 green, 2 blue
    std::optional<glm::dvec3> direction(glm::dvec2 pixel) const;
    std::optional<glm::dvec2> pixel(const glm::dvec3& direction) const; ///< to a few roundings of r
    double pixel_angle(glm::dvec2 pixel) const; ///< at the point

private:
    struct Growth {
        double f, slope; ///< of g
    };
    Growth growth(double r) const;

    Lens::Form form_;
    std::array<double, 4> k_;
    glm::dvec2 centre_; ///< pixels
    double half_height_; ///< pixels
    double reach_; ///< g grows from r = 0 up to here
    Plane flat_; ///< the unwarped picture: centre (0, 0), half its height 1, y down
};

} // namespace starbow
