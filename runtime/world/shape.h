#pragma once
#include "world.h"

namespace starbow {

/// A vertex of an instance at a time of its frame, in the frame's axes.
struct PlacedVertex {
    glm::dvec3 place;
    glm::dvec3 normal; ///< unit, but for a surface that is flattened to nothing
    glm::dvec3 tangent; ///< VertexMaps::tangent, of any length; 0 without
    bool mirrored; ///< its transform turns a left hand into a right one
};

/// A deforming instance at a time of its frame. Each bone and weight is computed at its first use.
class Shape {
public:
    /// All arguments must outlive the object.
    Shape(const World& world, const Instance& instance, double time);

    /// The transform of a bone from the mesh's own coordinates to the frame.
    const glm::dmat4& bone(std::size_t index);
    double weight(int target);
    /// A vertex of World::vertices that belongs to the instance's primitive.
    PlacedVertex vertex(std::uint32_t index);

private:
    const glm::dmat4& joint(int index);

    const World& world_;
    const Instance& instance_;
    const Deformation& deformation_;
    double own_s_;
    std::vector<std::optional<glm::dmat4>> bones_, joints_; ///< joints_: as Deformation::joints
    std::vector<std::optional<glm::dvec4>> weights_; ///< as Deformation::weights
};

/// The number of InstanceEntries of each pose of an animated instance.
int pose_entries(const World& world, const Instance& instance);

} // namespace starbow
