#pragma once
#include "offscreen.h"

namespace starbow {

/// Errors of a stereo picture: distances between the shown points and where the eye would see them, in the picture's
/// pixels.
struct Disparity {
    double median = 0, high = 0, most = 0; ///< over all pixels that show a surface; high: the 99th percentile
    double hidden = 0; ///< share of these whose surface is more than 2 % nearer or farther than the one the eye would see
};

/// Measures an output of any stereo method. exact: a renderer of the same layout with a cube map for each eye. It is null
/// where no such layout exists (a baseline that turns); then `hidden` stays 0. Both renderers must be measured ones.
Disparity disparity(
    OffscreenRenderer& tested, OffscreenRenderer* exact, const Shot& shot, std::size_t output, const SceneFile& scene);

/// The eye's place relative to the middle of the head for the cockpit's direction n, metres, without hyper-stereo. The
/// warp pass computes the same where the baseline turns with the azimuth.
glm::dvec3 eye_beside(const Stereo& stereo, Eye eye, const glm::dvec3& n);

} // namespace starbow
