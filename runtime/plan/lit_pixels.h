#pragma once
#include "bounding_cap.h"
#include "displays/compile/cone_hierarchy.h"
#include <span>

namespace starbow {

/// A rectangle of pixels, from low to before high.
struct PixelRect {
    glm::ivec2 low, high;
};

/// Divides a view's pixels into rectangles on a grid of squares. lit: some pixel's light comes with at least dark_D. dark:
/// no pixel's does. with_bodies: lit, and something that moves may be seen there. Squares that show nothing at all are in
/// none. motion_from_cockpit: as ViewRequest's. spread: the greatest distance of a pixel's rays from its centre, pixels. The
/// lists keep their memory.
struct LitPixels {
    std::vector<PixelRect> lit, dark, with_bodies;
    void find(const ConeHierarchy& cones, const glm::dmat3& motion_from_cockpit, double E, double dark_D, double spread,
        std::span<const ShipCap> bodies = {});

private:
    enum class Square : char { empty, dark, lit, with_bodies };
    struct Walk;
    std::vector<Square> squares_; ///< rows from the top
};

} // namespace starbow
