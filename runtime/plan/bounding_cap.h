#pragma once
#include "config/model/angles.h"
#include <glm/glm.hpp>
#include <span>

namespace starbow {

/// A bounding sphere of something drawn: centre from the eye, the cube map's axes; scene units.
struct BoundingSphere {
    glm::dvec3 centre;
    double radius;
};

/// A circle on the sphere of directions, with all inside it.
struct BoundingCap {
    glm::dvec3 axis{0, 0, 1}; ///< unit
    double radius_rad = pi; ///< up to pi, which is the whole sphere; below 0 there is nothing inside
    double filter_rad = 0; ///< the reach of the texels' filter around it
};

/// A cap that encloses all spheres as the origin sees them.
BoundingCap bounding_cap(std::span<const BoundingSphere> spheres);

/// The ship's directions n with dot(n, axis) >= least_cos, cockpit's frame; least_cos is -2 where that may be any direction.
struct ShipCap {
    glm::dvec3 axis;
    double least_cos;
};

/// The ship's directions towards a cap: those n with dot(n, xyz) >= w; xyz is unit, and w is -2 where that may be any
/// direction. Aberration takes circles to circles: the cap is the set of null vectors on one side of a hyperplane, and the
/// boost turns the hyperplane. Axes whose z is the motion; E: e^rapidity of the ship in the cap's frame.
glm::dvec4 cap_in_ship(const BoundingCap& cap, double E);

} // namespace starbow
