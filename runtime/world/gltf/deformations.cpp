#include "accessor.h"
#include "parts.h"
#include "runtime/world/moving.h"
#include <algorithm>
#include <cmath>
#include <set>

namespace starbow {
namespace {

/// The file's data of a deforming primitive's vertices.
struct DeformingSource {
    Elements position, normal;
    SkinSource skin;
    bool has_normal = false;
    struct Target {
        Elements position, normal;
        bool has_position = false, has_normal = false;
    };
    std::vector<Target> targets;
};

DeformingSource open_deforming(WorldBuild& build, const tinygltf::Primitive& primitive, const StillPose& pose)
{
    DeformingSource out;
    out.position = open(build, primitive.attributes.at("POSITION"));
    out.has_normal = primitive.attributes.contains("NORMAL");
    if (out.has_normal)
        out.normal = open(build, primitive.attributes.at("NORMAL"));
    out.skin = open_skin(build, primitive, pose);
    for (const auto& target : primitive.targets) {
        DeformingSource::Target& to = out.targets.emplace_back();
        to.has_position = target.contains("POSITION"), to.has_normal = target.contains("NORMAL") && out.has_normal;
        if (to.has_position)
            to.position = open(build, target.at("POSITION"));
        if (to.has_normal)
            to.normal = open(build, target.at("NORMAL"));
    }
    return out;
}

/// The bones of a vertex and their weights, whose sum is 1; of a mesh without a skin, the one that moves its node.
void put_bones(const std::vector<Influence>& influences, shared::DeformingVertex& to)
{
    if (influences.empty())
        to.weights[0].x = 1;
    for (std::size_t k = 0; k < influences.size(); ++k)
        to.weights[k / 4][int(k % 4)] = float(influences[k].weight),
                                  to.bones[k / 4][int(k % 4)] = float(influences[k].joint);
}

glm::dvec3 unit_or_zero(const glm::dvec3& v)
{
    const double length = glm::length(v);
    return length > 0 && length < 1e300 ? v / length : glm::dvec3(0);
}

template <class Row> void append(std::vector<glm::vec4>& rows, const Row& row)
{
    const auto* first = reinterpret_cast<const glm::vec4*>(&row);
    rows.insert(rows.end(), first, first + sizeof(Row) / sizeof(glm::vec4));
}

void make_deforming_room(const WorldBuild& build, const std::string& place, std::size_t rows)
{
    if (build.world.deforming.size() + rows > GltfLimits::deforming_rows)
        build.fail(place,
            "brings the data of skins and changing morph targets above "
                + std::to_string(GltfLimits::deforming_rows * sizeof(glm::vec4) >> 20)
                + " MiB; use fewer vertices or targets");
}

} // namespace

void add_deforming(WorldBuild& build, const std::string& place, const tinygltf::Primitive& primitive, const StillPose& pose,
    const std::vector<std::uint32_t>& source)
{
    World& world = build.world;
    Primitive& made = world.primitives.back();
    const DeformingSource from = open_deforming(build, primitive, pose);
    const auto changing = std::size_t(pose.changing_targets);
    make_deforming_room(build, place, source.size() * (DEFORMING_VERTEX_ROWS + DISPLACEMENT_ROWS * changing));
    made.deforming = int(world.deforming.size());
    for (std::size_t i = 0; i < source.size(); ++i) {
        const std::uint32_t vertex = source[i];
        const std::size_t own = std::size_t(made.vertex_offset) + i;
        glm::dvec3 position = element3(build, from.position, vertex, place + "/attributes/POSITION"), normal(0);
        if (from.has_normal)
            normal = element3(build, from.normal, vertex, place + "/attributes/NORMAL");
        for (std::size_t t = 0; t < from.targets.size() && t < pose.weights.size() && changing == 0; ++t) {
            const DeformingSource::Target& target = from.targets[t];
            if (target.has_position)
                position += pose.weights[t] * element3(build, target.position, vertex, place + "/targets");
            if (target.has_normal)
                normal += pose.weights[t] * element3(build, target.normal, vertex, place + "/targets");
        }
        shared::DeformingVertex row{};
        const std::vector<Influence> influences = influences_of(build, pose, from.skin, vertex, place);
        put_bones(influences, row);
        // Normals and tangents of the world's vertices are those of the file's own pose: the joints' turn is undone.
        const glm::dmat3 turn(from.skin.empty() ? glm::dmat4(1) : skin_of(pose, influences));
        if (!from.has_normal)
            normal = glm::transpose(turn) * glm::dvec3(world.vertices[own].normal);
        glm::dvec3 tangent(0);
        if (own < world.vertex_maps.size()) {
            tangent = glm::dvec3(world.vertex_maps[own].tangent);
            tangent = unit_or_zero(glm::determinant(turn) != 0 ? glm::inverse(turn) * tangent : tangent);
        }
        row.position = glm::vec4(position, 0), row.normal = glm::vec4(unit_or_zero(normal), 0);
        row.tangent = glm::vec4(tangent, 0);
        append(world.deforming, row);
    }
    made.displacements = int(world.deforming.size());
    for (const std::uint32_t vertex : source)
        for (std::size_t t = 0; t < changing; ++t) {
            shared::Displacement row{};
            if (t < from.targets.size() && from.targets[t].has_position)
                row.position = glm::vec4(element3(build, from.targets[t].position, vertex, place + "/targets"), 0);
            if (t < from.targets.size() && from.targets[t].has_normal)
                row.normal = glm::vec4(element3(build, from.targets[t].normal, vertex, place + "/targets"), 0);
            append(world.deforming, row);
        }
}

void add_deforming_instances(
    WorldBuild& build, int node, const std::vector<std::uint32_t>& primitives, const std::optional<Motion>& motion)
{
    World& world = build.world;
    if (primitives.empty())
        return;
    glm::dmat4 frame_from_local(1);
    bool mirrored = false;
    Deformation deformation;
    if (motion) {
        frame_from_local = pose_of(world, *motion, 0);
        const double determinant = glm::determinant(glm::dmat3(frame_from_local));
        if (determinant == 0) {
            note_once(world.notes, "nodes scaled to nothing are not drawn");
            return;
        }
        mirrored = determinant < 0;
        deformation.bones.push_back({*motion});
    } else
        build.skins.emplace(world.deformations.size(), build.model.nodes[std::size_t(node)].skin);
    if (const auto tracks = build.node_tracks.find(node); tracks != build.node_tracks.end()) {
        deformation.weights = tracks->second.weights;
        deformation.targets = int(tracks->second.greatest_weights.size());
    }
    if (world.motions.size() >= GltfLimits::motions)
        build.fail("/nodes/" + std::to_string(node),
            "brings the world above " + std::to_string(GltfLimits::motions) + " things that move by themselves; use fewer");
    for (const std::uint32_t primitive : primitives) {
        Instance instance{frame_from_local, mirrored ? turned_primitive(build, primitive) : primitive, node};
        instance.motion = int(world.motions.size()), instance.deformation = int(world.deformations.size());
        world.instances.push_back(instance);
    }
    world.motions.push_back(motion.value_or(Motion{-1}));
    world.deformations.push_back(std::move(deformation));
}

namespace {

/// The vertices that hang on a bone: their box, and how far displacements reach from there.
struct Hanging {
    glm::dvec3 low{1e300}, high{-1e300};
    double weights = 0;
    void add(const glm::dvec3& place, double reach, double weight)
    {
        low = glm::min(low, place - reach), high = glm::max(high, place + reach);
        weights += weight;
    }
};

/// Collects the vertices of a deformation's primitives by their bones.
std::map<int, Hanging> hanging_of(const WorldBuild& build, int node, const std::set<std::uint32_t>& primitives, int targets)
{
    const World& world = build.world;
    std::map<int, Hanging> all;
    for (const std::uint32_t index : primitives) {
        const Primitive& primitive = world.primitives[index];
        const std::size_t vertices
            = (std::size_t(primitive.displacements) - std::size_t(primitive.deforming)) / DEFORMING_VERTEX_ROWS;
        for (std::size_t own = 0; own < vertices; ++own) {
            const glm::vec4* row = &world.deforming[std::size_t(primitive.deforming) + DEFORMING_VERTEX_ROWS * own];
            double reach = 0;
            for (std::size_t t = 0; t < std::size_t(targets); ++t)
                reach += build.node_tracks.at(node).greatest_weights[t]
                    * double(glm::length(glm::dvec3(world.deforming[std::size_t(primitive.displacements)
                        + DISPLACEMENT_ROWS * (own * std::size_t(targets) + t)])));
            for (int k = 0; k < BONES_PER_VERTEX; ++k)
                if (const float weight = row[WEIGHTS_ROW + k / 4][k % 4]; weight > 0)
                    all[int(row[BONES_ROW + k / 4][k % 4])].add(glm::dvec3(row[0]), reach, double(weight));
        }
    }
    return all;
}

/// The motion of a node, also of one outside the scene.
Motion motion_of(const WorldBuild& build, int node)
{
    const auto known = build.node_motions.find(node);
    return known != build.node_motions.end() ? known->second : Motion{-1, build.world_from_node[std::size_t(node)]};
}

/// Gives a skin's deformation its joints that have vertices, and its vertices the bones' new indices.
void put_joints(WorldBuild& build, Deformation& deformation, const tinygltf::Skin& skin,
    const std::set<std::uint32_t>& primitives, const std::map<int, Hanging>& hanging)
{
    World& world = build.world;
    const std::vector<glm::dmat4> joint_from_mesh = inverse_bind_matrices(build, skin);
    std::map<int, int> bone_of;
    for (const auto& [joint, _] : hanging) {
        bone_of.emplace(joint, int(deformation.bones.size()));
        Motion motion = motion_of(build, skin.joints[std::size_t(joint)]);
        motion.joint_from_local = motion.joint_from_local * joint_from_mesh[std::size_t(joint)];
        const double scale = motion.joint < 0 ? 1 : build.bounds[std::size_t(motion.joint)].scale;
        for (int column = 0; column < 4; ++column)
            if (!(scale * glm::length(motion.joint_from_local[column]) < too_far))
                build.fail("/nodes/" + std::to_string(skin.joints[std::size_t(joint)]),
                    "leads beyond 1e30 as a joint of a skin; should stay below");
        deformation.bones.push_back({motion});
    }
    for (const std::uint32_t index : primitives) {
        const Primitive& primitive = world.primitives[index];
        const auto end = std::size_t(primitive.displacements);
        for (auto at = std::size_t(primitive.deforming); at < end; at += DEFORMING_VERTEX_ROWS) {
            for (int k = 0; k < BONES_PER_VERTEX; ++k) {
                float& bone = world.deforming[at + BONES_ROW + std::size_t(k / 4)][k % 4];
                bone = world.deforming[at + WEIGHTS_ROW + std::size_t(k / 4)][k % 4] > 0 ? float(bone_of.at(int(bone))) : 0;
            }
        }
    }
}

} // namespace

void finish_deformations(WorldBuild& build)
{
    World& world = build.world;
    std::vector<std::set<std::uint32_t>> primitives(world.deformations.size());
    std::vector<const Instance*> first(world.deformations.size());
    for (const Instance& instance : world.instances)
        if (instance.deformation >= 0) {
            primitives[std::size_t(instance.deformation)].insert(instance.primitive);
            first[std::size_t(instance.deformation)] = &instance;
        }
    std::size_t bones = 0;
    for (std::size_t i = 0; i < world.deformations.size(); ++i) {
        Deformation& deformation = world.deformations[i];
        const std::map<int, Hanging> hanging = hanging_of(build, first[i]->node, primitives[i], deformation.targets);
        if (const auto skin = build.skins.find(i); skin != build.skins.end())
            put_joints(build, deformation, build.model.skins[std::size_t(skin->second)], primitives[i], hanging);
        std::set<int> joints;
        double most = -1;
        std::size_t bone = 0;
        for (const auto& [_, own] : hanging) {
            Bone& to = deformation.bones[bone];
            to.centre = 0.5 * (own.low + own.high), to.radius = 0.5 * glm::length(own.high - own.low);
            if (own.weights > most)
                most = own.weights, deformation.middle = int(bone);
            for (int joint = to.motion.joint; joint >= 0; joint = world.joints[std::size_t(joint)].above)
                joints.insert(joint);
            ++bone;
        }
        deformation.joints.assign(joints.begin(), joints.end());
        world.motions[std::size_t(first[i]->motion)] = deformation.bones[std::size_t(deformation.middle)].motion;
        bones += deformation.bones.size();
        if (bones > GltfLimits::bones)
            build.fail("/nodes/" + std::to_string(first[i]->node),
                "brings the skins that move above " + std::to_string(GltfLimits::bones) + " joints; use fewer");
    }
}

} // namespace starbow
