#include "guard.h"
#include <tuple>

namespace starbow {
namespace {

void guard_transform(const JsonSpot& node, tinygltf::Node& written)
{
    bool parts = node.has("translation") || node.has("rotation") || node.has("scale");
    if (node.has("matrix")) {
        if (parts)
            node.fail("has a matrix and also translation, rotation or scale; should have one or the other");
        auto matrix = numbers(node["matrix"], 16, -too_far, too_far);
        if (matrix[3] != 0 || matrix[7] != 0 || matrix[11] != 0 || matrix[15] != 1)
            node["matrix"].fail("has a last row other than 0 0 0 1; glTF requires that row");
        written.matrix = matrix;
        return;
    }
    if (node.has("translation"))
        written.translation = numbers(node["translation"], 3, -too_far, too_far);
    if (node.has("scale"))
        written.scale = numbers(node["scale"], 3, -too_far, too_far);
    if (node.has("rotation")) {
        auto q = numbers(node["rotation"], 4, -1.01, 1.01);
        double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        if (std::abs(length - 1) > 0.01)
            node["rotation"].fail("has the length " + Json(length).dump() + "; should be a unit quaternion");
        for (double& part : q)
            part /= length;
        written.rotation = q;
    }
}

std::optional<Spin> guard_spin(const JsonSpot& node)
{
    std::optional<Spin> out;
    read_extras(node, [&](const JsonSpot& extras) {
        reject_unknown_members(extras, {"spin"});
        if (!extras.has("spin"))
            return;
        const JsonSpot spin = extras["spin"];
        reject_unknown_members(spin, {"axis", "turns_per_s"});
        for (const char* key : {"axis", "turns_per_s"})
            if (!spin.has(key))
                spin.fail("has no \"" + std::string(key) + "\"; should say about which axis it turns, and how often");
        const auto axis = numbers(spin["axis"], 3, -1e6, 1e6);
        const glm::dvec3 way(axis[0], axis[1], axis[2]);
        if (!(glm::length(way) > 1e-6))
            spin["axis"].fail("has the length 0; should be a direction");
        out = Spin{glm::normalize(way), number(spin["turns_per_s"], -1e9, 1e9)};
    });
    return out;
}

std::optional<Instancing> guard_instancing(const JsonSpot& node, const JsonSpot& root)
{
    if (!node.has("extensions") || !object(node["extensions"]).has("EXT_mesh_gpu_instancing"))
        return {};
    const JsonSpot attributes = object(node["extensions"]["EXT_mesh_gpu_instancing"])["attributes"];
    Instancing instancing;
    for (const auto& [name, to, type] : {std::tuple{"TRANSLATION", &instancing.translations, "VEC3"},
             {"ROTATION", &instancing.rotations, "VEC4"}, {"SCALE", &instancing.scales, "VEC3"}}) {
        if (!object(attributes).has(name))
            continue;
        const JsonSpot spot = attributes[name];
        *to = int(index_into(spot, "accessor", count_of(root, "accessors")));
        const JsonSpot accessor = object(root["accessors"][std::size_t(*to)]);
        if (text(accessor["type"]) != type)
            spot.fail("names accessor " + spot.json.dump() + " of type " + in_quotes(text(accessor["type"])) + "; " + name
                + " has " + type);
        const auto count = std::size_t(integer(accessor["count"], 1, 0xffffffff));
        if (instancing.count != 0 && count != instancing.count)
            spot.fail(
                "has " + std::to_string(count) + " elements; the other attributes have " + std::to_string(instancing.count));
        instancing.count = count;
    }
    if (instancing.count > GltfLimits::instances)
        attributes.fail("have " + std::to_string(instancing.count) + " instances; at most "
            + std::to_string(GltfLimits::instances) + " are allowed");
    return instancing.count > 0 ? std::optional(instancing) : std::nullopt;
}

bool guard_hidden(const JsonSpot& node)
{
    if (!node.has("extensions") || !object(node["extensions"]).has("KHR_node_visibility"))
        return false;
    const JsonSpot visibility = object(node["extensions"]["KHR_node_visibility"]);
    return visibility.has("visible") && !boolean(visibility["visible"]);
}

/// Checks the specification's strict trees: each node has at most one parent, and the children form no cycle.
void check_trees(const JsonSpot& nodes, const std::vector<std::int64_t>& parent)
{
    std::vector<char> known(parent.size(), 0); // 1: on the way being followed, 2: leads to a root
    for (std::size_t i = 0; i < parent.size(); ++i) {
        auto walk = [&](auto visit) {
            for (auto n = std::int64_t(i); n >= 0 && visit(n); n = parent[std::size_t(n)]) { }
        };
        walk([&](std::int64_t n) {
            char& state = known[std::size_t(n)];
            if (state == 1)
                nodes[std::size_t(n)].fail("is among its own descendants; nodes should form trees");
            return state == 2 ? false : (state = 1, true);
        });
        walk([&](std::int64_t n) {
            char& state = known[std::size_t(n)];
            return state == 2 ? false : (state = 2, true);
        });
    }
}

} // namespace

void guard_nodes(const JsonSpot& root, GuardedGltf& out)
{
    std::size_t count = count_of(root, "nodes");
    std::vector<std::int64_t> parent(count, -1);
    auto& written_nodes = out.model.nodes;
    guard_list(root, "nodes", written_nodes, [&](const JsonSpot& node, tinygltf::Node& written) {
        guard_transform(node, written);
        out.spins.push_back(guard_spin(node));
        out.instancing.push_back(guard_instancing(node, root));
        out.hidden.push_back(guard_hidden(node));
        if (node.has("name"))
            written.name = text(node["name"]);
        if (node.has("mesh"))
            written.mesh = int(index_into(node["mesh"], "mesh", count_of(root, "meshes")));
        if (node.has("camera"))
            written.camera = int(index_into(node["camera"], "camera", count_of(root, "cameras")));
        if (node.has("skin"))
            written.skin = int(index_into(node["skin"], "skin", count_of(root, "skins")));
        written.weights = weights_of(node);
        if (node.has("children")) {
            JsonSpot children = node["children"];
            list(children);
            for (std::size_t i = 0; i < children.size(); ++i) {
                auto child = index_into(children[i], "node", count);
                if (parent[std::size_t(child)] >= 0)
                    children[i].fail("names node " + std::to_string(child) + ", which is already a child of node "
                        + std::to_string(parent[std::size_t(child)]) + "; each has one parent");
                parent[std::size_t(child)] = std::int64_t(written_nodes.size());
                written.children.push_back(int(child));
            }
        }
    });
    if (count > 0)
        check_trees(root["nodes"], parent);

    guard_list(root, "scenes", out.model.scenes, [&](const JsonSpot& scene, tinygltf::Scene& written) {
        if (!scene.has("nodes"))
            return;
        JsonSpot nodes = scene["nodes"];
        list(nodes);
        std::vector<bool> named(count, false);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            auto node = std::size_t(index_into(nodes[i], "node", count));
            if (parent[node] >= 0 || named[node])
                nodes[i].fail("names node " + std::to_string(node) + (named[node] ? " twice" : ", which has a parent")
                    + "; a scene names roots, each once");
            named[node] = true;
            written.nodes.push_back(int(node));
        }
    });
    if (root.has("scene"))
        out.model.defaultScene = int(index_into(root["scene"], "scene", count_of(root, "scenes")));
}

} // namespace starbow
