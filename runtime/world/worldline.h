#pragma once
#include "config/model/scene_file.h"
#include "world.h"

namespace starbow {

/// A straight piece of a body's worldline.
struct WorldlineSegment {
    glm::dvec3 u; ///< proper velocity
    Event from; ///< its origin's event at its own time `begin`, or at its own time 0 where `begin` is -inf
    double begin, end; ///< its own time since the worldline's first event; infinite where it goes on for ever
};
std::vector<WorldlineSegment> segments_of(const Body& body);

/// A world's event in a rest frame's coordinates, from the frame's own origin.
Event in_frame(const RestFrame& frame, const Event& world);

/// The quaternion of a formula's (x, y, z; w last).
inline glm::dquat quaternion(const glm::dvec4& q) { return {q.w, q.x, q.y, q.z}; }

/// A world's instant in a rest frame's coordinates: place and time from its origin, and the proper velocity there. Further
/// the cockpit among the axes that the pure boost from there carries. The two boosts in turn have turned them
/// (Thomas-Wigner).
Shot in_frame(const RestFrame& frame, const Shot& shot);

/// The direction, in the frame that moves with u, towards a source at infinity that lies at `towards` (unit) in the
/// world. D: the light's frequency in that frame over the world's.
glm::dvec3 aberrated(const glm::dvec3& u, const glm::dvec3& towards, double& D);

/// Moves a scene's bodies out of the world at rest. Each instance below one of a body's nodes gets a copy for every
/// worldline segment of the body, in that segment's rest frame. Each light becomes a lamp, or one lamp for every segment.
/// Call it once for a world. Throws InputError where a node is missing, or for more than MAX_REST_FRAMES velocities or
/// MAX_LIGHTS lamps.
void place_bodies(World& world, const SceneFile& scene);

} // namespace starbow
