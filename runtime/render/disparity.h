#pragma once
#include "offscreen.h"

namespace starbow {

/// How far the points that a stereo picture shows lie from where the eye would see them, in the picture's own pixels.
struct Disparity {
    double median = 0, high = 0, most = 0; ///< over all pixels that show a surface; high: 99 of 100 are below
    double hidden = 0; ///< share of these that show a surface more than 2 % nearer or farther than the one the eye would see
};

/// Measures an output drawn by any method. exact: a renderer of the same layout with a cube map for each eye, or null where
/// there is none (a baseline that turns): then `hidden` stays 0. Both are measured ones.
Disparity disparity(
    OffscreenRenderer& tested, OffscreenRenderer* exact, const Shot& shot, std::size_t output, double unit_m);

/// The eye's place from the middle of the head for the cockpit's direction n, metres (hyper-stereo not counted): what the
/// warp pass computes where the baseline turns with the azimuth.
glm::dvec3 eye_beside(const Stereo& stereo, Eye eye, const glm::dvec3& n);

} // namespace starbow
