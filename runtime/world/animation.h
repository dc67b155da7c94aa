#pragma once
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <optional>
#include <vector>

namespace starbow {

enum class Interpolation { step, linear, cubic };

/// How one property of a node goes with its own time, over and over again (glTF 2.0, 3.11 and appendix C).
struct Track {
    Interpolation interpolation = Interpolation::linear;
    bool rotation = false; ///< values are quaternions x, y, z, w of length 1
    double length_s = 0; ///< until its animation begins again; 0: it has one moment
    std::vector<double> times_s; ///< not empty, rising, 0 to length_s
    std::vector<glm::dvec4> values; ///< one for each time; cubic: three, the tangent before, the value, the tangent after
};

/// At any time: before the first key, and after the last until its animation begins again, it holds.
glm::dvec4 value_at(const Track& track, double time_s);

constexpr double for_ever = std::numeric_limits<double>::infinity();

/// Times around a time between which a track does not jump: its steps and, where its end is not its beginning, its rounds.
struct Unbroken {
    double begin_s, end_s; ///< infinite where it never does
};
Unbroken unbroken(const Track& track, double time_s);

/// The time nearest to a time at which a track has a key, and so may bend.
double nearest_key(const Track& track, double time_s);

/// Turns for ever about its own origin; at its own time 0 it stands as it is written.
struct Spin {
    glm::dvec3 axis; ///< not 0; right-handed
    double turns_per_s;
};

/// A node that moves against what it hangs from.
struct Joint {
    int node; ///< of World::nodes
    int above = -1; ///< of World::joints, with a smaller index: the next above it
    glm::dmat4 above_from_parent{1}; ///< of the nodes between, which stand still
    glm::dvec3 translation{0}, scale{1}; ///< where no track tells
    glm::dquat rotation{1, 0, 0, 0};
    int translations = -1, rotations = -1, scales = -1; ///< of World::tracks
    std::optional<Spin> spin; ///< rigid in the frame, whatever the scales above it
};

/// What moves by itself: an instance's way from a joint, and where the joints' own frame stands.
struct Motion {
    int joint; ///< of World::joints
    glm::dmat4 joint_from_local{1};
    glm::dvec3 place{0}; ///< in the instance's frame, of a body's origin
};

} // namespace starbow
