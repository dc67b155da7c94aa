#pragma once
#include "cube_map_plan.h"
#include <span>

namespace starbow {

/// Stars that are neighbours in a StarField's order, and the bounding cone that holds them.
struct StarPatch {
    glm::dvec3 axis; ///< unit, world, from the eye
    double radius_rad;
    std::uint32_t first, count;
};

/// Divides all entries into at most about two thousand patches. before: a list whose memory is reused.
std::vector<StarPatch> star_patches(std::span<const shared::StarEntry> stars, std::vector<StarPatch> before = {});

/// A run of entries, from `first` on.
struct StarRun {
    std::uint32_t first, count;
};

/// The stars that views of these images may show, including spots that reach in across an edge. The runs are in order,
/// few and long. before: a list whose memory is reused.
std::vector<StarRun> stars_in(std::span<const PlannedImage> images, std::span<const StarPatch> patches,
    const glm::dmat3& cube_from_world, std::vector<StarRun> before = {});

} // namespace starbow
