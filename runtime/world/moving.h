#pragma once
#include "config/model/scene_file.h"
#include "eye_event.h"
#include "shaders/shared_structs.h"

namespace starbow {

/// The greatest speed of an animation in its rest frame. Colours ignore the Doppler shift of this motion, and animated
/// clocks are right to 2 %.
constexpr double most_own_speed = 0.2;

/// The pose of a joint's children at its own time, from its body's origin.
glm::dmat4 pose_of(const World& world, const Motion& motion, double own_s);

/// The longest period of the motions of a joint and its parents, seconds; 0: none moves.
double longest(const World& world, int joint);

/// The transform of an animated instance (Instance::motion) at a time of its frame.
glm::dmat4 pose_at(const World& world, const Instance& instance, double time);

/// The seen pose of an animated instance: at the retarded time of its box's middle.
struct SeenPose {
    double sent; ///< that retarded time, in the frame
    glm::dmat4 frame_from_local;
    double window; ///< the greatest difference of its points' retarded times from `sent`, scene time; it also bounds
                   ///< their distance from where the middle is seen
};
SeenPose seen_pose(const World& world, const Instance& instance, const EyeEvent& eye_event);

/// The times of a table of POSES poses, from `window` before to `window` after, evenly spaced on either side of the
/// middle one. The middle one is at the nearest key, because motions bend there. The table ends at a jump of its tracks:
/// an instance jumps as a whole, with its middle.
std::array<double, POSES> pose_times(const World& world, const Instance& instance, const SeenPose& seen);

/// The fastest point of all animations. Jumps do not count as speed.
struct FastestMotion {
    double per_s; ///< scene units in a second of its own time
    int node;
    double own_s; ///< its own time there
};
/// nullopt: nothing moves by itself.
std::optional<FastestMotion> fastest_motion(const World& world);

/// Throws InputError where any point is faster than most_own_speed.
void check_speeds(const World& world, const SceneFile& scene);

} // namespace starbow
