#pragma once
#include "config/model/scene_file.h"
#include "world.h"

namespace starbow {

/// A straight piece of a body's worldline.
struct WorldlineSegment {
    glm::dvec3 u; ///< proper velocity
    Event from; ///< its origin is there at its own time `begin`, or, where that is -inf, at its own time 0
    double begin, end; ///< its own time, on since the worldline's first event; infinite where it goes on for ever
};
std::vector<WorldlineSegment> segments_of(const Body& body);

/// A world's event as a rest frame has it, from its own origin.
Event in_frame(const RestFrame& frame, const Event& world);

/// A formula's unit quaternion (x, y, z; w last).
inline glm::dquat quaternion(const glm::dvec4& q) { return {q.w, q.x, q.y, q.z}; }

/// The same instant as a rest frame has it: place and time from its origin, the proper velocity there, and the cockpit among
/// the axes that the pure boost from there carries, which the two boosts in turn have turned (Thomas-Wigner).
Shot in_frame(const RestFrame& frame, const Shot& shot);

/// Direction towards a source at infinity that lies at `towards` (unit) in the world, in the frame that moves with u; D: of
/// its light, that frame's frequency over the world's.
glm::dvec3 aberrated(const glm::dvec3& u, const glm::dvec3& towards, double& D);

/// What of a scene moves is taken out of the world at rest: each instance below one of a body's nodes is put, for every leg
/// of the body, into that leg's rest frame; each light becomes a lamp, or for every leg one. Once for a world. Throws
/// InputError where a node is missing or there are more than MAX_REST_FRAMES velocities or MAX_LIGHTS lamps.
void place_bodies(World& world, const SceneFile& scene);

} // namespace starbow
