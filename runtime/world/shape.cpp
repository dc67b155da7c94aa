#include "shape.h"
#include "moving.h"
#include <algorithm>

namespace starbow {

Shape::Shape(const World& world, const Instance& instance, double time)
    : world_(world)
    , instance_(instance)
    , deformation_(world.deformations[std::size_t(instance.deformation)])
    , own_s_((time - zero_of(world, instance)) * world.seconds_per_time_unit)
    , bones_(deformation_.bones.size())
    , joints_(deformation_.joints.size())
    , weights_(deformation_.weights.size())
{
}

const glm::dmat4& Shape::joint(int index)
{
    const auto at = std::size_t(std::ranges::lower_bound(deformation_.joints, index) - deformation_.joints.begin());
    if (!joints_[at]) {
        const int above = world_.joints[std::size_t(index)].above;
        joints_[at] = joint_pose(world_, index, above < 0 ? glm::dmat4(1) : joint(above), own_s_);
    }
    return *joints_[at];
}

const glm::dmat4& Shape::bone(std::size_t index)
{
    if (!bones_[index]) {
        const Motion& motion = deformation_.bones[index].motion;
        glm::dmat4 m = motion.joint < 0 ? motion.joint_from_local : joint(motion.joint) * motion.joint_from_local;
        m[3] += glm::dvec4(world_.motions[std::size_t(instance_.motion)].place, 0);
        bones_[index] = m;
    }
    return *bones_[index];
}

double Shape::weight(int target)
{
    const auto at = std::size_t(target / 4);
    if (!weights_[at])
        weights_[at] = value_at(world_.tracks[std::size_t(deformation_.weights[at])], own_s_);
    return (*weights_[at])[target % 4];
}

PlacedVertex Shape::vertex(std::uint32_t index)
{
    const Primitive& primitive = world_.primitives[instance_.primitive];
    const std::size_t own = index - std::size_t(primitive.vertex_offset);
    const glm::vec4* row = &world_.deforming[std::size_t(primitive.deforming) + DEFORMING_VERTEX_ROWS * own];
    glm::dvec3 position(row[0]), normal(row[1]);
    for (int target = 0; target < deformation_.targets; ++target) {
        const glm::vec4* added = &world_.deforming[std::size_t(primitive.displacements)
            + DISPLACEMENT_ROWS * (own * std::size_t(deformation_.targets) + std::size_t(target))];
        position += weight(target) * glm::dvec3(added[0]);
        normal += weight(target) * glm::dvec3(added[1]);
    }
    glm::dmat4 mean(0);
    for (int k = 0; k < BONES_PER_VERTEX; ++k)
        if (row[WEIGHTS_ROW + k / 4][k % 4] != 0)
            mean += double(row[WEIGHTS_ROW + k / 4][k % 4]) * bone(std::size_t(row[BONES_ROW + k / 4][k % 4]));
    const glm::dmat3 turn(mean);
    // Cofactors transform normals under any scale.
    const glm::dmat3 cofactors(glm::cross(turn[1], turn[2]), glm::cross(turn[2], turn[0]), glm::cross(turn[0], turn[1]));
    const bool mirrored = glm::determinant(turn) < 0;
    normal = cofactors * normal * (mirrored ? -1.0 : 1.0);
    const double length = glm::length(normal);
    return {glm::dvec3(mean * glm::dvec4(position, 1)), length > 0 ? normal / length : normal, turn * glm::dvec3(row[2]),
        mirrored};
}

int pose_entries(const World& world, const Instance& instance)
{
    if (instance.deformation < 0)
        return 1;
    const Deformation& deformation = world.deformations[std::size_t(instance.deformation)];
    return int(deformation.bones.size()) + (deformation.targets + WEIGHTS_PER_ENTRY - 1) / WEIGHTS_PER_ENTRY;
}

} // namespace starbow
