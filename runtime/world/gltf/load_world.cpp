#include "parts.h"
#include "runtime/world/blended.h"
#include "runtime/world/moving.h"
#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace starbow {
namespace {

/// The primitives of a mesh in a pose: of all nodes that leave it as it is, or of one node, -1 or that node.
using Made = std::map<std::pair<int, int>, std::vector<std::uint32_t>>;

/// The primitives of a node's mesh, made at their first use.
const std::vector<std::uint32_t>& primitives_of(WorldBuild& build, int index, const StillPose& pose, Made& made)
{
    const tinygltf::Node& node = build.model.nodes[std::size_t(index)];
    const bool own_pose = !pose.joints.empty() || !node.weights.empty() || pose.deforms;
    auto [known, is_new] = made.try_emplace({node.mesh, own_pose ? index : -1});
    if (!is_new)
        return known->second;
    const auto& from = build.model.meshes[std::size_t(node.mesh)].primitives;
    for (std::size_t i = 0; i < from.size(); ++i)
        if (add_primitive(build, "/meshes/" + std::to_string(node.mesh) + "/primitives/" + std::to_string(i), from[i], pose))
            known->second.push_back(std::uint32_t(build.world.primitives.size()) - 1);
    return known->second;
}

/// The places of a node's mesh in its own frame: one, or those of EXT_mesh_gpu_instancing.
std::vector<glm::dmat4> places_of(WorldBuild& build, int node)
{
    const std::optional<Instancing>& instancing = build.file.instancing[std::size_t(node)];
    if (!instancing)
        return {glm::dmat4(1)};
    std::vector<glm::dmat4> places(instancing->count, glm::dmat4(1));
    const auto each = [&](int accessor, auto apply) {
        if (accessor < 0)
            return;
        const Elements elements = open(build, accessor);
        for (std::size_t i = 0; i < places.size(); ++i)
            apply(places[i], [&](int which) { return elements.component(i, which); });
    };
    each(instancing->rotations, [&](glm::dmat4& place, auto part) {
        const glm::dquat turn(part(3), part(0), part(1), part(2));
        const double length = glm::length(turn);
        if (!(length > 0.9 && length < 1.1))
            build.fail("/nodes/" + std::to_string(node), "has an instance whose rotation is not a unit quaternion");
        place = glm::mat4_cast(turn / length);
    });
    each(instancing->scales, [](glm::dmat4& place, auto part) {
        for (int i = 0; i < 3; ++i)
            place[i] *= part(i);
    });
    each(instancing->translations, [](glm::dmat4& place, auto part) { place[3] = {part(0), part(1), part(2), 1}; });
    return places;
}

/// Adds an animated node's instances.
void add_moving(WorldBuild& build, int node, const Motion& motion, const std::vector<std::uint32_t>& primitives)
{
    World& world = build.world;
    // The orientation is tested at several times, because an animation may begin with size 0.
    constexpr int moments = 64;
    double determinant = 0;
    for (int i = 0; i < moments; ++i) {
        const double own = glm::determinant(glm::dmat3(pose_of(world, motion, longest(world, motion.joint) * i / moments)));
        if (own * determinant < 0)
            note_once(world.notes, "animated scales through 0 turn surfaces inside out");
        determinant = determinant == 0 ? own : determinant;
    }
    if (determinant == 0) {
        note_once(world.notes, "nodes scaled to nothing are not drawn");
        return;
    }
    for (std::uint32_t primitive : primitives) {
        if (world.motions.size() >= GltfLimits::motions)
            build.fail("/nodes/" + std::to_string(node),
                "brings the world above " + std::to_string(GltfLimits::motions)
                    + " things that move by themselves; use fewer");
        Instance instance{pose_of(world, motion, 0), determinant < 0 ? turned_primitive(build, primitive) : primitive, node};
        instance.motion = int(world.motions.size());
        world.instances.push_back(instance);
        world.motions.push_back(motion);
    }
}

void refuse_far(WorldBuild& build, int node, const glm::dmat4& transform)
{
    for (int column = 0; column < 4; ++column)
        if (!(glm::length(transform[column]) < too_far))
            build.fail(
                "/nodes/" + std::to_string(node), "with its parents' transforms leads beyond 1e30; should stay below");
}

/// Adds a still node's instances.
void add_still(WorldBuild& build, int node, const glm::dmat4& world_from_local, const std::vector<std::uint32_t>& primitives)
{
    refuse_far(build, node, world_from_local);
    const double determinant = glm::determinant(glm::dmat3(world_from_local));
    if (determinant == 0) {
        note_once(build.world.notes, "nodes scaled to nothing are not drawn");
        return;
    }
    for (std::uint32_t primitive : primitives) {
        if (build.world.instances.size() >= GltfLimits::instances)
            build.fail("/nodes/" + std::to_string(node),
                "brings the world above " + std::to_string(GltfLimits::instances) + " instances; use fewer");
        // A mirrored node reverses the triangles' orientation. Reversing the corners here spares the renderer a second
        // case.
        build.world.instances.push_back(
            {world_from_local, determinant < 0 ? turned_primitive(build, primitive) : primitive, node});
    }
}

bool animated(const WorldBuild& build, int node)
{
    const auto tracks = build.node_tracks.find(node);
    return (tracks != build.node_tracks.end() && tracks->second.move()) || build.file.spins[std::size_t(node)];
}

/// Finds which nodes move, because they or nodes above them are animated.
void find_moving(WorldBuild& build)
{
    const auto& nodes = build.model.nodes;
    std::vector<int> open;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        build.moving.push_back(animated(build, int(i)));
        if (build.moving.back())
            open.push_back(int(i));
    }
    while (!open.empty()) {
        const std::vector<int>& children = nodes[std::size_t(open.back())].children;
        open.pop_back();
        for (const int child : children)
            if (!build.moving[std::size_t(child)])
                build.moving[std::size_t(child)] = true, open.push_back(child);
    }
}

void add_instances(WorldBuild& build)
{
    find_moving(build);
    struct Visit {
        int node, parent;
        glm::dmat4 world_from_parent;
        int joint; // the next animated node above it
        glm::dmat4 joint_from_parent;
        bool hidden; // by a node above it; its joints still move what hangs on them
    };
    std::vector<Visit> open;
    Made made;
    auto push_backwards = [&](const std::vector<int>& nodes, int parent, const glm::dmat4& world_from_parent, int joint,
                              const glm::dmat4& joint_from_parent, bool hidden) {
        for (auto node = nodes.rbegin(); node != nodes.rend(); ++node)
            open.push_back({*node, parent, world_from_parent, joint, joint_from_parent, hidden});
    };
    for (const auto& node : build.model.nodes)
        build.world.nodes.push_back({node.name, -1});
    push_backwards(root_nodes(build.model), -1, glm::dmat4(1), -1, glm::dmat4(1), false);
    while (!open.empty()) {
        auto [index, parent, world_from_parent, joint, joint_from_parent, hidden] = open.back();
        open.pop_back();
        hidden = hidden || build.file.hidden[std::size_t(index)];
        build.world.nodes[std::size_t(index)].parent = parent;
        const auto& node = build.model.nodes[std::size_t(index)];
        glm::dmat4 world_from_local = world_from_parent * local_transform(node);
        refuse_far(build, index, world_from_local);
        if (animated(build, index)) {
            joint = add_joint(build, index, joint, joint_from_parent);
            joint_from_parent = glm::dmat4(1);
        } else
            joint_from_parent = joint_from_parent * local_transform(node);
        push_backwards(node.children, index, world_from_local, joint, joint_from_parent, hidden);
        const Motion own{joint, joint < 0 ? world_from_local : joint_from_parent};
        build.node_motions.emplace(index, own);
        if (node.mesh < 0 || hidden)
            continue;
        const StillPose pose = still_pose(build, index);
        const std::vector<std::uint32_t>& primitives = primitives_of(build, index, pose, made);
        if (!pose.joints.empty()) {
            // A skin's vertices are in the world's frame, wherever its node is.
            if (pose.deforms)
                add_deforming_instances(build, index, primitives, {});
            else
                add_still(build, index, glm::dmat4(1), primitives);
            continue;
        }
        for (const glm::dmat4& at : places_of(build, index)) {
            refuse_far(build, index, own.joint_from_local * at);
            const Motion motion{own.joint, own.joint_from_local * at};
            if (pose.deforms)
                add_deforming_instances(build, index, primitives, motion);
            else if (joint >= 0)
                add_moving(build, index, motion, primitives);
            else
                add_still(build, index, motion.joint_from_local, primitives);
        }
    }
    finish_deformations(build);
}

} // namespace

std::vector<int> root_nodes(const tinygltf::Model& model)
{
    if (!model.scenes.empty())
        return model.scenes[std::size_t(std::max(model.defaultScene, 0))].nodes;
    std::vector<bool> is_child(model.nodes.size(), false);
    for (const auto& node : model.nodes)
        for (int child : node.children)
            is_child[std::size_t(child)] = true;
    std::vector<int> out;
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        if (!is_child[i])
            out.push_back(int(i));
    return out;
}

glm::dmat4 local_transform(const tinygltf::Node& node)
{
    if (node.matrix.size() == 16)
        return glm::make_mat4(node.matrix.data());
    glm::dmat4 out(1);
    if (node.rotation.size() == 4)
        out = glm::mat4_cast(glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]));
    for (int i = 0; i < 3 && node.scale.size() == 3; ++i)
        out[i] *= node.scale[std::size_t(i)];
    for (int i = 0; i < 3 && node.translation.size() == 3; ++i)
        out[3][i] = node.translation[std::size_t(i)];
    return out;
}

World load_world(const std::filesystem::path& path)
{
    GuardedGltf file = guard_gltf(path);
    World world;
    world.notes = std::move(file.notes);
    WorldBuild build{file, file.model, world};
    add_materials(build);
    add_tracks(build);
    add_instances(build);
    if (world.instances.empty())
        throw InputError(
            file.name, "/scenes", "shows nothing; a world needs at least one mesh of triangles, lines or points");
    if (!world.vertex_maps.empty())
        world.vertex_maps.resize(world.vertices.size());
    find_opaque_places(world);
    return world;
}

} // namespace starbow
