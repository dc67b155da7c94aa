#pragma once
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <optional>
#include <vector>

namespace starbow {

enum class Interpolation { step, linear, cubic };

/// A property of a node as a function of its own time, repeated over and over (glTF 2.0, 3.11 and appendix C).
struct Track {
    Interpolation interpolation = Interpolation::linear;
    bool rotation = false; ///< values are quaternions x, y, z, w of length 1
    double length_s = 0; ///< the animation's period; 0: it has a single moment
    std::vector<double> times_s; ///< not empty, rising, 0 to length_s
    std::vector<glm::dvec4> values; ///< one for each time; cubic: three, the tangent before, the value, the tangent after
};

/// The track's value at any time: before the first key it holds, and after the last until its animation begins again.
glm::dvec4 value_at(const Track& track, double time_s);

constexpr double for_ever = std::numeric_limits<double>::infinity();

/// The interval around a time in which a track does not jump. A track jumps at its steps and, if its end differs from its
/// beginning, at its period's end.
struct Unbroken {
    double begin_s, end_s; ///< infinite where it never jumps
};
Unbroken unbroken(const Track& track, double time_s);

/// The key time of a track nearest to a time; a track may bend at its keys.
double nearest_key(const Track& track, double time_s);

/// A constant rotation about the node's own origin; at its own time 0 the node has its written orientation.
struct Spin {
    glm::dvec3 axis; ///< not 0; right-handed
    double turns_per_s;
};

/// An animated node: it moves against its parent.
struct Joint {
    int node; ///< index into World::nodes
    int above = -1; ///< the next joint above it, of World::joints, with a smaller index
    glm::dmat4 above_from_parent{1}; ///< through the nodes between, which stand still
    glm::dvec3 translation{0}, scale{1}; ///< values of properties without a track
    glm::dquat rotation{1, 0, 0, 0};
    int translations = -1, rotations = -1, scales = -1; ///< index into World::tracks
    std::optional<Spin> spin; ///< rigid in the frame, whatever the scales above it
};

/// An instance's place in an animation: its joint, and the place of the joints' own frame.
struct Motion {
    int joint; ///< index into World::joints; -1: it stands still, as some bones do
    glm::dmat4 joint_from_local{1};
    glm::dvec3 place{0}; ///< in the instance's frame, from a body's origin
};

/// A part of a deforming mesh's motion: a joint of its skin, or the node that has the mesh.
struct Bone {
    Motion motion; ///< of the mesh's own coordinates; its place is the instance's
    glm::dvec3 centre{0}; ///< of a sphere around the vertices that hang on it, at any weights of the targets, in the mesh's
                          ///< own coordinates
    double radius = 0;
};

/// The changing shape of a node's mesh: its skin, and morph targets whose weights change (glTF 2.0, sections 3.7.2.2 and
/// 3.7.3). A vertex' displacements are added by their weights; then the mean of its bones moves it.
struct Deformation {
    std::vector<Bone> bones; ///< not empty
    int middle = 0; ///< the bone that has the most vertices; the instance's own motion is that bone's
    std::vector<int> weights; ///< of the targets: indices into World::tracks, each of four targets
    int targets = 0; ///< whose weights change
    std::vector<int> joints; ///< all joints that move the bones, rising
};

} // namespace starbow
