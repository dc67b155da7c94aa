#pragma once
#include "config/model/scene_file.h"
#include "eye_event.h"
#include "shaders/shared_structs.h"

namespace starbow {

/// The greatest speed of an animation in its rest frame. Colours ignore the Doppler shift of this motion, and animated
/// clocks are right to 2 %.
constexpr double most_own_speed = 0.2;

/// An instance's own time, 0, in its frame.
double zero_of(const World& world, const Instance& instance);

/// The pose of a joint's children at its own time, from its body's origin. above: that of the joint above it.
glm::dmat4 joint_pose(const World& world, int joint, const glm::dmat4& above, double own_s);
/// The pose of what a motion moves, from its body's origin.
glm::dmat4 pose_of(const World& world, const Motion& motion, double own_s);

/// The greatest stretch of a transform, or a little more where it shears.
double greatest_stretch(const glm::dmat3& m);

/// The longest period of the motions of a joint and its parents, seconds; 0: none moves.
double longest(const World& world, int joint);

/// The transform of an animated instance (Instance::motion) at a time of its frame; of a deforming one that of its middle
/// bone.
glm::dmat4 pose_at(const World& world, const Instance& instance, double time);

/// A point of an instance, in its own coordinates, for whose retarded time its clocks, its poses and its place in a picture
/// are found: its box's middle; of a deforming one that of its middle bone.
glm::dvec3 middle_of(const World& world, const Instance& instance);

/// Calls visit(track) with the index of each of a joint's own tracks.
template <class Visit> void each_track(const Joint& joint, Visit visit)
{
    for (int track : {joint.translations, joint.rotations, joint.scales})
        if (track >= 0)
            visit(track);
}

/// The seen pose of an animated instance: at the retarded time of its middle.
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

} // namespace starbow
