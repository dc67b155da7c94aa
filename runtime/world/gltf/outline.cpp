#include "runtime/world/outline.h"
#include "config/model/angles.h"
#include "parts.h"
#include "runtime/world/boxes.h"
#include <algorithm>

namespace starbow {
namespace {

/// The bounds that an accessor of positions states; nullopt without any. Quantized ones are stated as they are stored
/// (KHR_mesh_quantization).
std::optional<AlignedBox> stated_bounds(const JsonSpot& root, std::size_t accessor)
{
    const JsonSpot spot = root["accessors"][accessor];
    if (!object(spot).has("min") || !spot.has("max"))
        return {};
    const auto low = numbers(spot["min"], 3, -too_far, too_far), high = numbers(spot["max"], 3, -too_far, too_far);
    const bool normalized = spot.has("normalized") && boolean(spot["normalized"]);
    const double scale = normalized ? full_scale(int(integer(spot["componentType"], 5120, 5126))) : 1;
    return AlignedBox{glm::dvec3(low[0], low[1], low[2]) / scale, glm::dvec3(high[0], high[1], high[2]) / scale};
}

std::optional<AlignedBox> bounds_of_mesh(const JsonSpot& root, std::size_t mesh)
{
    std::optional<AlignedBox> all;
    const JsonSpot primitives = root["meshes"][mesh]["primitives"];
    for (std::size_t i = 0; i < list(primitives).size(); ++i) {
        const JsonSpot attributes = primitives[i]["attributes"];
        if (!object(attributes).has("POSITION"))
            continue;
        const auto at = index_into(attributes["POSITION"], "accessor", count_of(root, "accessors"));
        if (const std::optional<AlignedBox> box = stated_bounds(root, std::size_t(at)))
            all = all ? around(*all, *box) : *box;
    }
    return all;
}

bool has_triangles(const JsonSpot& root, std::size_t mesh)
{
    const JsonSpot primitives = root["meshes"][mesh]["primitives"];
    for (std::size_t i = 0; i < list(primitives).size(); ++i)
        if (integer_or(object(primitives[i]), "mode", TINYGLTF_MODE_TRIANGLES, 0, 6) >= TINYGLTF_MODE_TRIANGLES)
            return true;
    return false;
}

/// The file's lamps by their index, before they have a place.
std::vector<OutlineLamp> lamps_of(const JsonSpot& root)
{
    std::vector<OutlineLamp> lamps;
    if (!root.has("extensions") || !object(root["extensions"]).has("KHR_lights_punctual"))
        return lamps;
    const JsonSpot all = object(root["extensions"]["KHR_lights_punctual"])["lights"];
    for (std::size_t i = 0; i < list(all).size(); ++i) {
        const JsonSpot lamp = object(all[i]);
        OutlineLamp& to = lamps.emplace_back();
        const std::string type = text(lamp["type"]);
        to.directional = type == "directional";
        if (type == "spot") {
            to.cone = LightCone{{0, 0, -1}, 0, 0.25 * pi};
            if (lamp.has("spot") && object(lamp["spot"]).has("outerConeAngle"))
                to.cone->outer_rad = number(lamp["spot"]["outerConeAngle"], 1e-6, 0.5 * pi + 1e-6);
            if (lamp.has("spot") && lamp["spot"].has("innerConeAngle"))
                to.cone->inner_rad = number(lamp["spot"]["innerConeAngle"], 0, 0.5 * pi);
            to.cone->outer_rad = std::min(to.cone->outer_rad, 0.5 * pi);
            if (!(to.cone->inner_rad < to.cone->outer_rad))
                lamp["spot"].fail("has an innerConeAngle that is not below its outerConeAngle; should be smaller");
        }
        if (!to.directional && type != "point" && type != "spot")
            lamp["type"].fail("is " + in_quotes(type) + "; should be directional, point or spot");
        if (lamp.has("color")) {
            const auto colour = numbers(lamp["color"], 3, 0, 1e6);
            to.colour = {colour[0], colour[1], colour[2]};
        }
        if (lamp.has("intensity"))
            to.intensity = number(lamp["intensity"], 0, 1e12);
    }
    return lamps;
}

/// The lamp that a node carries; -1: none.
int lamp_of(const JsonSpot& root, std::size_t node, std::size_t lamps)
{
    const JsonSpot spot = root["nodes"][node];
    if (!spot.has("extensions") || !object(spot["extensions"]).has("KHR_lights_punctual"))
        return -1;
    return int(index_into(object(spot["extensions"]["KHR_lights_punctual"])["light"], "light", lamps));
}

double across(const AlignedBox& box) { return glm::distance(box.low, box.high); }

/// So many times as far across as all smaller things together.
constexpr double backdrop = 3;

} // namespace

Middle middle_of(std::vector<AlignedBox> things)
{
    if (things.empty())
        return {};
    std::ranges::sort(things, {}, across);
    std::vector<AlignedBox> inner{things[0]}; // around each thing and all smaller ones
    for (std::size_t i = 1; i < things.size(); ++i)
        inner.push_back(around(inner.back(), things[i]));
    std::size_t last = things.size() - 1;
    while (last > 0 && across(inner[last - 1]) > 0 && across(things[last]) > backdrop * across(inner[last - 1]))
        --last;
    Middle middle{inner[last], inner[last].low.y};
    for (std::size_t i = last + 1; i < things.size(); ++i) {
        if (is_flat(things[i]) && things[i].high.y < 0.5 * (middle.box.low.y + middle.box.high.y))
            middle.floor = std::max(middle.floor, things[i].high.y);
    }
    return middle;
}

Outline read_outline(const std::filesystem::path& path)
{
    const GltfFile file = read_gltf_json(path);
    const JsonSpot root{file.json, "", file.name};
    object(root);
    GuardedGltf guarded;
    guard_nodes(root, guarded);
    const tinygltf::Model& model = guarded.model;
    std::vector<std::optional<AlignedBox>> meshes;
    for (std::size_t mesh = 0; mesh < count_of(root, "meshes"); ++mesh)
        meshes.push_back(bounds_of_mesh(root, mesh));
    Outline outline;
    const std::vector<OutlineLamp> lamps = lamps_of(root);
    // The stated bounds are those of a mesh alone, before its skin or its many places.
    const bool placed_by_data = count_of(root, "skins") > 0
        || std::ranges::any_of(guarded.instancing, [](const auto& each) { return each.has_value(); });
    outline.moves = count_of(root, "animations") > 0
        || std::ranges::any_of(guarded.spins, [](const std::optional<Spin>& spin) { return spin.has_value(); });
    struct Open {
        int node;
        glm::dmat4 world_from_parent;
    };
    std::vector<Open> open;
    const auto push = [&](const std::vector<int>& nodes, const glm::dmat4& world_from_parent) {
        for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) // the first one is visited first
            open.push_back({*node, world_from_parent});
    };
    push(root_nodes(model), glm::dmat4(1));
    while (!open.empty()) {
        const Open at = open.back();
        open.pop_back();
        if (guarded.hidden[std::size_t(at.node)])
            continue;
        const tinygltf::Node& node = model.nodes[std::size_t(at.node)];
        const glm::dmat4 world_from_local = at.world_from_parent * local_transform(node);
        const bool finite = glm::length(world_from_local[0]) < too_far && glm::length(world_from_local[1]) < too_far
            && glm::length(world_from_local[2]) < too_far && glm::length(world_from_local[3]) < too_far;
        if (!finite)
            continue; // loading refuses it
        push(node.children, world_from_local);
        if (node.camera >= 0 && !outline.camera)
            outline.camera = world_from_local;
        if (const int lamp = lamp_of(root, std::size_t(at.node), lamps.size()); lamp >= 0) {
            outline.lamps.push_back(lamps[std::size_t(lamp)]);
            outline.lamps.back().world_from_lamp = world_from_local;
        }
        outline.surfaces = outline.surfaces || (node.mesh >= 0 && has_triangles(root, std::size_t(node.mesh)));
        if (!placed_by_data && node.mesh >= 0 && meshes[std::size_t(node.mesh)])
            outline.things.push_back(transformed(*meshes[std::size_t(node.mesh)], world_from_local));
    }
    if (placed_by_data) {
        outline.world = std::make_shared<const World>(load_world(path));
        for (const Instance& instance : outline.world->instances) {
            const Primitive& primitive = outline.world->primitives[instance.primitive];
            outline.things.push_back(transformed({primitive.low, primitive.high}, instance.frame_from_local));
        }
    }
    return outline;
}

} // namespace starbow
