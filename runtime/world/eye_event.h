#pragma once
#include "observer.h"

namespace starbow {

/// The turn from world axes to motion axes: z along u, y as near as possible to the cockpit's up. At rest z is the cockpit's
/// straight ahead. The same turn leads from the ship's axes to the motion axes in the ship's frame.
glm::dmat3 motion_from_world(const glm::dvec3& u, const glm::dquat& ship_from_cockpit);

/// An eye's event in one rest frame.
struct EyeEvent {
    int frame = 0; ///< index into World::frames
    glm::dvec3 place{0}; ///< the eye's place and time in that frame
    double time = 0;
    glm::dmat3 cube_from_frame{1}; ///< turn into the axes of the cube map: see RestFrameView
    bool now = false; ///< everything is shown at the ship's present, and contracted along z, the direction of motion
    double contraction = 1, beta = 0; ///< then: 1 / gamma, and the ship's speed along z
    double E = 1; ///< e^rapidity of the aberration from the frame to the observer
    glm::dvec3 ahead{0, 0, 1}; ///< the unit direction of motion, the cube map's axes
};

/// An observer's eye event: its place in the cockpit, scene units. frame: the index of the rest-frame view.
EyeEvent eye_event_of(const RestFrameView& rest_frame, int frame, const glm::dvec3& place);

/// An angle in the frame, in a direction of the cube map's axes, over the angle that the observer sees: D there. 1 with
/// `now`.
inline double growth_towards(const EyeEvent& eye_event, const glm::dvec3& from_eye)
{
    if (eye_event.now)
        return 1;
    const double along = glm::dot(from_eye, eye_event.ahead) / glm::length(from_eye);
    return 0.5 * (eye_event.E + 1 / eye_event.E + (eye_event.E - 1 / eye_event.E) * along);
}

/// The retarded time, in the eye event's own frame, of a place given from the eye in the cube map's axes. With `now` it is
/// the place's time at the ship's present. The difference of two places' retarded times is at most their distance.
inline double retarded_time(const EyeEvent& eye_event, const glm::dvec3& from_eye)
{
    return eye_event.time + (eye_event.now ? eye_event.beta * from_eye.z : -glm::length(from_eye));
}

} // namespace starbow
