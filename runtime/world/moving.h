#pragma once
#include "config/model/scene_file.h"
#include "shaders/shared_structs.h"
#include "eye_event.h"

namespace starbow {

/// Of what moves by itself nothing is faster than this, in its rest frame: its own Doppler shift is not told by its colours,
/// and so its clocks are right to 2 %.
constexpr double most_own_speed = 0.2;

/// Where what hangs from a joint is at its own time, from its body's origin on.
glm::dmat4 pose_of(const World& world, const Motion& motion, double own_s);

/// The longest of the times after which a joint's own and its parents' motions begin again, seconds; 0: none moves.
double longest(const World& world, int joint);

/// Where an instance that moves by itself (Instance::motion) is at a time of its frame.
glm::dmat4 pose_at(const World& world, const Instance& instance, double time);

/// How such an instance is seen: as it was when the light left that now arrives from the middle of its box.
struct SeenPose {
    double sent; ///< that time, the frame's
    glm::dmat4 frame_from_local;
    double window; ///< light of none of its points left more than this before or after, scene time; and none is seen further
                   ///< from where the middle is seen
};
SeenPose seen_pose(const World& world, const Instance& instance, const EyeEvent& eye_event);

/// The times of a table of POSES poses, from `window` before to as much after, evenly on either side of the middle one. That
/// is at the nearest key, for there motions bend. At a jump of its tracks the table ends: things jump as a whole, as their
/// middle does.
std::array<double, POSES> pose_times(const World& world, const Instance& instance, const SeenPose& seen);

/// Throws InputError where something is faster than most_own_speed at any of its points. Jumps are no speed.
void check_speeds(const World& world, const SceneFile& scene);

} // namespace starbow
