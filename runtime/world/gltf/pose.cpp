#include "accessor.h"
#include "parts.h"
#include "shaders/shared_structs.h"
#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

namespace starbow {
namespace {

/// True for a mesh that a skin moves. One with and without joints in its primitives is taken for one without.
bool has_joints(const tinygltf::Mesh& mesh)
{
    return std::ranges::all_of(mesh.primitives, [](const tinygltf::Primitive& primitive) {
        return primitive.attributes.contains("JOINTS_0") && primitive.attributes.contains("WEIGHTS_0");
    });
}

/// The transforms of all nodes as the file states them, also of those outside its scene.
std::vector<glm::dmat4> transforms_of(const tinygltf::Model& model)
{
    std::vector<int> parent(model.nodes.size(), -1), order;
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        for (const int child : model.nodes[i].children)
            parent[std::size_t(child)] = int(i);
    for (std::size_t i = 0; i < parent.size(); ++i)
        if (parent[i] < 0)
            order.push_back(int(i));
    for (std::size_t i = 0; i < order.size(); ++i) { // parents before their children
        const std::vector<int>& children = model.nodes[std::size_t(order[i])].children;
        order.insert(order.end(), children.begin(), children.end());
    }
    std::vector<glm::dmat4> all(model.nodes.size(), glm::dmat4(1));
    for (const int node : order) {
        const glm::dmat4 own = local_transform(model.nodes[std::size_t(node)]);
        all[std::size_t(node)] = parent[std::size_t(node)] < 0 ? own : all[std::size_t(parent[std::size_t(node)])] * own;
    }
    return all;
}

} // namespace

SkinSource open_skin(WorldBuild& build, const tinygltf::Primitive& primitive, const StillPose& pose)
{
    SkinSource skin;
    for (int set = 0; !pose.joints.empty(); ++set) {
        const auto joints = primitive.attributes.find("JOINTS_" + std::to_string(set)),
                   weights = primitive.attributes.find("WEIGHTS_" + std::to_string(set));
        if (joints == primitive.attributes.end() || weights == primitive.attributes.end())
            break;
        skin.sets.push_back({open(build, joints->second), open(build, weights->second)});
    }
    return skin;
}

std::vector<Influence> influences_of(
    const WorldBuild& build, const StillPose& pose, const SkinSource& skin, std::uint32_t i, const std::string& place)
{
    std::vector<Influence> all;
    for (std::size_t set = 0; set < skin.sets.size(); ++set)
        for (int k = 0; k < 4; ++k) {
            const double weight = skin.sets[set].weights.component(i, k), joint = skin.sets[set].joints.component(i, k);
            if (!(weight > 0)) // NaN neither
                continue;
            if (!(joint >= 0 && joint < double(pose.joints.size())))
                build.fail(place + "/attributes/JOINTS_" + std::to_string(set),
                    "element " + std::to_string(i) + " names joint "
                        + std::to_string(std::int64_t(std::clamp(joint, -1.0, 1e9))) + "; the skin has "
                        + std::to_string(pose.joints.size()));
            all.push_back({int(joint), weight});
        }
    if (all.empty() && !skin.empty()) {
        const double first = skin.sets[0].joints.component(i, 0);
        return {{first >= 0 && first < double(pose.joints.size()) ? int(first) : 0, 1}};
    }
    if (all.size() > BONES_PER_VERTEX) {
        std::ranges::stable_sort(all, std::ranges::greater(), &Influence::weight);
        all.resize(BONES_PER_VERTEX);
    }
    double sum = 0;
    for (const Influence& one : all)
        sum += one.weight;
    for (Influence& one : all)
        one.weight /= sum;
    return all;
}

glm::dmat4 skin_of(const StillPose& pose, std::span<const Influence> influences)
{
    glm::dmat4 sum(0);
    for (const Influence& one : influences)
        sum += one.weight * pose.joints[std::size_t(one.joint)];
    return sum;
}

glm::dmat4 skin_at(
    const WorldBuild& build, const StillPose& pose, const SkinSource& skin, std::uint32_t i, const std::string& place)
{
    return skin_of(pose, influences_of(build, pose, skin, i, place));
}

std::vector<glm::dmat4> inverse_bind_matrices(WorldBuild& build, const tinygltf::Skin& skin)
{
    std::vector<glm::dmat4> matrices(skin.joints.size(), glm::dmat4(1));
    if (skin.inverseBindMatrices < 0)
        return matrices;
    const Elements from = open(build, skin.inverseBindMatrices);
    for (std::size_t joint = 0; joint < matrices.size(); ++joint)
        for (int i = 0; i < 16; ++i)
            glm::value_ptr(matrices[joint])[i] = from.component(joint, i);
    return matrices;
}

StillPose still_pose(WorldBuild& build, int index)
{
    const tinygltf::Node& node = build.model.nodes[std::size_t(index)];
    StillPose pose;
    pose.weights = node.weights.empty() ? build.model.meshes[std::size_t(node.mesh)].weights : node.weights;
    if (const auto tracks = build.node_tracks.find(index); tracks != build.node_tracks.end())
        pose.changing_targets = int(tracks->second.greatest_weights.size());
    pose.deforms = pose.changing_targets > 0;
    if (node.skin < 0 || !has_joints(build.model.meshes[std::size_t(node.mesh)]))
        return pose;
    const tinygltf::Skin& skin = build.model.skins[std::size_t(node.skin)];
    if (build.world_from_node.empty())
        build.world_from_node = transforms_of(build.model);
    const std::vector<glm::dmat4> joint_from_mesh = inverse_bind_matrices(build, skin);
    for (std::size_t joint = 0; joint < skin.joints.size(); ++joint) {
        const int at = skin.joints[joint];
        pose.deforms = pose.deforms || build.moving[std::size_t(at)];
        pose.joints.push_back(build.world_from_node[std::size_t(at)] * joint_from_mesh[joint]);
    }
    return pose;
}

} // namespace starbow
