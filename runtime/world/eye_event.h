#pragma once
#include "observer.h"

namespace starbow {

/// Turn from world axes to motion axes: z along u, y as near as possible to the cockpit's up; at rest z is the cockpit's
/// straight ahead. The same turn leads from the ship's axes to the motion axes in the ship's frame.
glm::dmat3 motion_from_world(const glm::dvec3& u, const glm::dquat& ship_from_cockpit);

/// An eye before what stands still in one rest frame.
struct EyeEvent {
    int frame = 0; ///< of World::frames
    glm::dvec3 place{0}; ///< the eye's event, that frame's place and time
    double time = 0;
    glm::dmat3 motion_from_frame{1}; ///< turn
    bool now = false; ///< everything is shown where it is now, in the ship's frame: along z as much closer
    double contraction = 1, beta = 0; ///< then: 1 / gamma, and the ship's speed along z
};

/// An eye of someone who looks: its place in his cockpit, scene units. frame: which of his layers it is.
EyeEvent eye_event_of(const RestFrameView& layer, int frame, const glm::dvec3& place);

/// When, by the eye event's own frame, the light left that reaches it now from a place, given from the eye in motion axes; or
/// what time it is there, where that is what is shown. How much later light leaves one place than another is at most as
/// large as their distance.
inline double retarded_time(const EyeEvent& eye_event, const glm::dvec3& from_eye)
{
    return eye_event.time + (eye_event.now ? eye_event.beta * from_eye.z : -glm::length(from_eye));
}

} // namespace starbow
