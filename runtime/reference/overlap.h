#pragma once
#include <glm/glm.hpp>
#include <vector>

namespace starbow {

/// One viewport's contribution to a pixel.
struct BlendLayer {
    glm::dvec3 screen{0}; ///< its light after the tone curve
    glm::dvec3 mask{0}; ///< its share of what the higher orders leave to it, by colour; 0 where it shows nothing
    double brightness = 1; ///< of its calibration and its ramp
    int order = 0;
};

struct BlendResult {
    glm::dvec3 screen{0};
    std::size_t foremost = 0; ///< index of the coat with the largest part; of equal ones the upper
};

/// Lays the viewports of a pixel over each other, from the lowest order up: each order hides what lies below it by the sum
/// of its masks, at most wholly, and adds its own light (docs/displays.md). `coats` are in the layout's order, at least
/// one. plain: without brightness, and the parts made to add up to 1, as a preview shows it.
BlendResult laid_over(const std::vector<BlendLayer>& coats, bool plain);

} // namespace starbow
