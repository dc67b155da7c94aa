#include "guard.h"
#include <algorithm>
#include <map>

namespace starbow {
namespace {

std::int64_t component_bytes(const Spot& spot)
{
    switch (integer(spot, 0, 65535)) {
    case byte_type:
    case ubyte_type:
        return 1;
    case short_type:
    case ushort_type:
        return 2;
    case uint_type:
    case float_type:
        return 4;
    }
    spot.fail("is " + spot.json.dump() + "; should be 5120, 5121, 5122, 5123, 5125 or 5126");
}

/// Bytes of one element; a matrix's columns start at multiples of 4.
std::int64_t element_bytes(const Spot& type, std::int64_t component)
{
    static const std::map<std::string, std::pair<int, int>> shapes = {{"SCALAR", {1, 1}}, {"VEC2", {1, 2}}, {"VEC3", {1, 3}},
        {"VEC4", {1, 4}}, {"MAT2", {2, 2}}, {"MAT3", {3, 3}}, {"MAT4", {4, 4}}};
    auto shape = shapes.find(text(type));
    if (shape == shapes.end())
        type.fail("is " + in_quotes(text(type)) + "; should be SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4");
    auto [columns, rows] = shape->second;
    std::int64_t column = rows * component;
    return columns == 1 ? column : columns * ((column + 3) / 4 * 4);
}

/// Checks that `count` elements, `stride` apart, lie inside the buffer view that `spot` names.
std::int64_t view_holding(const Spot& spot, const Json& views, std::int64_t count, std::int64_t element, bool strided)
{
    auto index = index_into(spot["bufferView"], "buffer view", views.is_array() ? views.size() : 0);
    const Json& view = views[std::size_t(index)];
    std::int64_t offset = integer_or(spot, "byteOffset", 0, 0, std::int64_t(GltfLimits::file_bytes));
    std::int64_t stride = element;
    if (strided && view.contains("byteStride")) {
        stride = view["byteStride"].get<std::int64_t>();
        if (stride < element)
            spot.fail("has elements of " + std::to_string(element) + " bytes in a buffer view with a byteStride of "
                + std::to_string(stride));
    }
    auto held = view["byteLength"].get<std::int64_t>();
    if (offset + (count - 1) * stride + element > held)
        spot.fail("ends at byte " + std::to_string(offset + (count - 1) * stride + element) + " of a buffer view of "
            + std::to_string(held));
    return index;
}

void guard_accessor(const Spot& accessor, Json& written, const Json& views)
{
    constexpr std::int64_t most = 0xffffffff;
    auto component = component_bytes(accessor["componentType"]);
    auto element = element_bytes(accessor["type"], component);
    auto count = integer(accessor["count"], 1, most);
    written = {
        {"componentType", integer(accessor["componentType"], 0, 65535)}, {"type", text(accessor["type"])}, {"count", count}};
    if (accessor.has("normalized"))
        written["normalized"] = boolean(accessor["normalized"]);
    if (accessor.has("bufferView")) {
        written["bufferView"] = view_holding(accessor, views, count, element, true);
        written["byteOffset"] = integer_or(accessor, "byteOffset", 0, 0, most);
    } else if (count > std::int64_t(GltfLimits::zeros))
        accessor["count"].fail("is " + std::to_string(count) + "; without a bufferView at most "
            + std::to_string(GltfLimits::zeros) + " are allowed");
    if (!accessor.has("sparse"))
        return;
    Spot sparse = accessor["sparse"];
    auto replaced = integer(object(sparse)["count"], 1, std::min<std::int64_t>(count, 0x7fffffff));
    Spot indices = sparse["indices"], values = sparse["values"];
    auto type = integer(object(indices)["componentType"], 0, 65535);
    if (type != ubyte_type && type != ushort_type && type != uint_type)
        indices["componentType"].fail("is " + std::to_string(type) + "; should be 5121, 5123 or 5125");
    auto index_view = view_holding(indices, views, replaced, component_bytes(indices["componentType"]), false);
    auto value_view = view_holding(object(values), views, replaced, element, false);
    written["sparse"] = {{"count", replaced},
        {"indices",
            {{"bufferView", index_view}, {"componentType", type},
                {"byteOffset", integer_or(indices, "byteOffset", 0, 0, most)}}},
        {"values", {{"bufferView", value_view}, {"byteOffset", integer_or(values, "byteOffset", 0, 0, most)}}}};
}

struct Legal {
    std::vector<std::string> types;
    std::vector<int> components;
};

/// The legal types of an attribute: the specification's table, widened by KHR_mesh_quantization.
const Legal* legal_for(const std::string& attribute)
{
    static const std::vector<int> quantized = {float_type, byte_type, ubyte_type, short_type, ushort_type};
    static const Legal vectors = {{"VEC3"}, quantized}, uv = {{"VEC2"}, quantized},
                       colour = {{"VEC3", "VEC4"}, {float_type, ubyte_type, ushort_type}};
    if (attribute == "POSITION" || attribute == "NORMAL")
        return &vectors;
    if (attribute == "COLOR_0")
        return &colour;
    return attribute.starts_with("TEXCOORD_") ? &uv : nullptr;
}

const Json& checked_accessor(const Spot& spot, const Json& accessors, const Legal& legal)
{
    const Json& accessor = accessors[std::size_t(index_into(spot, "accessor", accessors.is_array() ? accessors.size() : 0))];
    if (std::ranges::find(legal.types, accessor["type"].get<std::string>()) == legal.types.end()
        || std::ranges::find(legal.components, accessor["componentType"].get<int>()) == legal.components.end())
        spot.fail("names accessor " + spot.json.dump() + " of type " + accessor["type"].get<std::string>()
            + " and component type " + accessor["componentType"].dump() + "; glTF does not allow that here");
    return accessor;
}

/// Checks the number of indices, or of vertices where there are none, for a mode.
void check_count(const Spot& spot, std::int64_t mode, std::size_t count)
{
    if (mode == 4 && count % 3 != 0)
        spot.fail("has " + std::to_string(count) + " corners; triangles take a multiple of 3");
    if (mode > 4 && count < 3)
        spot.fail("has " + std::to_string(count) + " corners; a strip or fan takes 3 or more");
    if (count > GltfLimits::indices)
        spot.fail(
            "has " + std::to_string(count) + " corners; at most " + std::to_string(GltfLimits::indices) + " are allowed");
}

void guard_primitive(const Spot& primitive, Json& written, GuardedGltf& out)
{
    static const Legal indices{{"SCALAR"}, {ubyte_type, ushort_type, uint_type}};
    const Json& accessors = out.json.contains("accessors") ? out.json["accessors"] : Json::array();
    auto mode = integer_or(primitive, "mode", 4, 0, 6);
    written = {{"mode", mode}, {"attributes", Json::object()}};
    Spot attributes = primitive["attributes"];
    std::size_t vertices = 0;
    for (const auto& [name, _] : object(attributes).json.items()) {
        const Legal* legal = legal_for(name);
        Spot spot = attributes[name];
        if (!legal) {
            // Starbow does not read tangents, joints, further colours or application-specific attributes.
            index_into(spot, "accessor", accessors.size());
            continue;
        }
        auto count = checked_accessor(spot, accessors, *legal)["count"].get<std::size_t>();
        if (vertices != 0 && count != vertices)
            spot.fail("has " + std::to_string(count) + " elements; the other attributes have " + std::to_string(vertices));
        vertices = count;
        written["attributes"][name] = spot.json.get<std::int64_t>();
    }
    if (vertices > GltfLimits::vertices)
        attributes.fail("have " + std::to_string(vertices) + " vertices; at most " + std::to_string(GltfLimits::vertices)
            + " are allowed");
    if (primitive.has("material"))
        written["material"] = index_into(
            primitive["material"], "material", out.json.contains("materials") ? out.json["materials"].size() : 0);
    if (primitive.has("targets"))
        note_once(out.notes, "morph targets: meshes are drawn as they are stored");
    if (primitive.has("indices")) {
        Spot spot = primitive["indices"];
        if (!checked_accessor(spot, accessors, indices).contains("bufferView"))
            spot.fail("names accessor " + spot.json.dump() + ", which has no bufferView; indices need one");
        check_count(spot, mode, checked_accessor(spot, accessors, indices)["count"].get<std::size_t>());
        written["indices"] = spot.json.get<std::int64_t>();
    } else if (written["attributes"].contains("POSITION"))
        check_count(primitive, mode, vertices);
}

} // namespace

void guard_accessors(const Spot& root, GuardedGltf& out)
{
    guard_list(root, "accessors", out.json,
        [&](const Spot& accessor, Json& written) { guard_accessor(accessor, written, out.json["bufferViews"]); });
}

void guard_meshes(const Spot& root, GuardedGltf& out)
{
    guard_list(root, "meshes", out.json, [&](const Spot& mesh, Json& written) {
        Spot primitives = mesh["primitives"];
        list(primitives);
        written["primitives"] = Json::array();
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            Json one;
            guard_primitive(object(primitives[i]), one, out);
            written["primitives"].push_back(std::move(one));
        }
    });
}

} // namespace starbow
