#pragma once
#include "plan.h"
#include "world.h"

namespace starbow {

/// One indexed draw into one image of a plan: `count` instances, listed in DrawList::visible from `first`.
struct Draw {
    std::uint32_t image, primitive, first, count;
    std::uint32_t first_index, index_count;
};

/// What the cube pass of one eye draws.
struct DrawList {
    std::vector<shared::InstanceEntry> instances; ///< all of the world's, in front of this eye, in its order
    std::vector<std::uint32_t> visible; ///< indices into `instances`
    std::vector<Draw> draws; ///< by image, then by primitive
};

/// Moves the world around the eye (in double, rounded to float only there) and sorts out which instance each image can see.
/// Each is drawn at the coarsest level of detail that strays by at most half a texel of that image.
/// The instances of a world stand in order of their primitives (load_world's and sort_instances' promise).
DrawList cull(
    const World& world, const glm::dvec3& eye, const glm::dmat3& motion_from_world, const std::vector<PlanImage>& images);

/// Distance from a place to the nearest of all instances' bounding boxes, scene units: no surface is nearer.
double nearest_box(const World& world, const glm::dvec3& place);

/// Puts a world's instances in order of their primitives, these in order of their materials, clocks first.
void sort_instances(World& world);

} // namespace starbow
