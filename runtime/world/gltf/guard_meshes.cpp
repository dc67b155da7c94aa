#include "compressed.h"
#include "guard.h"
#include <algorithm>
#include <array>

namespace starbow {
namespace {

constexpr std::int64_t most_offset = 0xffffffff;

/// A type of accessors (glTF 2.0, section 3.6.2.2).
struct AccessorShape {
    const char* name;
    int type, columns, rows;
};
constexpr std::array<AccessorShape, 7> shapes{{{"SCALAR", TINYGLTF_TYPE_SCALAR, 1, 1}, {"VEC2", TINYGLTF_TYPE_VEC2, 1, 2},
    {"VEC3", TINYGLTF_TYPE_VEC3, 1, 3}, {"VEC4", TINYGLTF_TYPE_VEC4, 1, 4}, {"MAT2", TINYGLTF_TYPE_MAT2, 2, 2},
    {"MAT3", TINYGLTF_TYPE_MAT3, 3, 3}, {"MAT4", TINYGLTF_TYPE_MAT4, 4, 4}}};

std::int64_t component_bytes(const JsonSpot& spot)
{
    switch (integer(spot, 0, 65535)) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    }
    spot.fail("is " + spot.json.dump() + "; should be 5120, 5121, 5122, 5123, 5125 or 5126");
}

const AccessorShape& shape_of(const JsonSpot& type)
{
    const std::string name = text(type);
    const auto shape = std::ranges::find(shapes, name, &AccessorShape::name);
    if (shape == shapes.end())
        type.fail("is " + in_quotes(name) + "; should be SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4");
    return *shape;
}

/// Bytes of one element; a matrix's columns start at multiples of 4.
std::int64_t element_bytes(const AccessorShape& shape, std::int64_t component)
{
    const std::int64_t column = shape.rows * component;
    return shape.columns == 1 ? column : shape.columns * ((column + 3) / 4 * 4);
}

using Views = std::vector<tinygltf::BufferView>;

/// Checks that `count` elements of `element` bytes lie inside the buffer view that `spot` names; returns the view's index.
int view_holding(const JsonSpot& spot, const Views& views, std::int64_t count, std::int64_t element, bool strided)
{
    auto index = index_into(spot["bufferView"], "buffer view", views.size());
    const tinygltf::BufferView& view = views[std::size_t(index)];
    std::int64_t offset = integer_or(spot, "byteOffset", 0, 0, std::int64_t(GltfLimits::file_bytes));
    std::int64_t stride = element;
    if (strided && view.byteStride != 0) {
        stride = std::int64_t(view.byteStride);
        if (stride < element)
            spot.fail("has elements of " + std::to_string(element) + " bytes in a buffer view with a byteStride of "
                + std::to_string(stride));
    }
    auto held = std::int64_t(view.byteLength);
    if (offset + (count - 1) * stride + element > held)
        spot.fail("ends at byte " + std::to_string(offset + (count - 1) * stride + element) + " of a buffer view of "
            + std::to_string(held));
    return int(index);
}

void guard_sparse(
    const JsonSpot& sparse, std::int64_t count, std::int64_t element, const Views& views, tinygltf::Accessor& written)
{
    auto replaced = integer(object(sparse)["count"], 1, std::min<std::int64_t>(count, 0x7fffffff));
    JsonSpot indices = sparse["indices"], values = sparse["values"];
    auto type = integer(object(indices)["componentType"], 0, 65535);
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT
        && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        indices["componentType"].fail("is " + std::to_string(type) + "; should be 5121, 5123 or 5125");
    auto& to = written.sparse;
    to.isSparse = true;
    to.count = int(replaced);
    to.indices.componentType = int(type);
    to.indices.bufferView = view_holding(indices, views, replaced, component_bytes(indices["componentType"]), false);
    to.values.bufferView = view_holding(object(values), views, replaced, element, false);
    to.indices.byteOffset = int(integer_or(indices, "byteOffset", 0, 0, most_offset));
    to.values.byteOffset = int(integer_or(values, "byteOffset", 0, 0, most_offset));
}

/// packed: the file has meshes in other forms, whose accessors only state their counts.
void guard_accessor(const JsonSpot& accessor, tinygltf::Accessor& written, const Views& views, bool packed)
{
    auto component = component_bytes(accessor["componentType"]);
    const AccessorShape& shape = shape_of(accessor["type"]);
    auto element = element_bytes(shape, component);
    auto count = integer(accessor["count"], 1, 0xffffffff);
    written.componentType = int(integer(accessor["componentType"], 0, 65535));
    written.type = shape.type;
    written.count = std::size_t(count);
    if (accessor.has("normalized"))
        written.normalized = boolean(accessor["normalized"]);
    if (accessor.has("bufferView")) {
        written.bufferView = view_holding(accessor, views, count, element, true);
        written.byteOffset = std::size_t(integer_or(accessor, "byteOffset", 0, 0, most_offset));
    } else if (!packed && count > std::int64_t(GltfLimits::zeros))
        accessor["count"].fail("is " + std::to_string(count) + "; without a bufferView at most "
            + std::to_string(GltfLimits::zeros) + " are allowed");
    if (accessor.has("sparse"))
        guard_sparse(accessor["sparse"], count, element, views, written);
}

struct Legal {
    std::vector<int> types, components;
};

/// The legal types of an attribute: the specification's table, widened by KHR_mesh_quantization.
const Legal* legal_for(const std::string& attribute)
{
    static const std::vector<int> quantized = {TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_COMPONENT_TYPE_BYTE,
        TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_COMPONENT_TYPE_SHORT, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT};
    static const Legal vectors = {{TINYGLTF_TYPE_VEC3}, quantized}, uv = {{TINYGLTF_TYPE_VEC2}, quantized},
                       colour
        = {{TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4},
            {TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT}};
    if (attribute == "POSITION" || attribute == "NORMAL")
        return &vectors;
    static const Legal joints
        = {{TINYGLTF_TYPE_VEC4}, {TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT}},
        weights = {{TINYGLTF_TYPE_VEC4},
            {TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT}};
    static const Legal tangents = {
        {TINYGLTF_TYPE_VEC4}, {TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_COMPONENT_TYPE_BYTE, TINYGLTF_COMPONENT_TYPE_SHORT}};
    if (attribute == "TANGENT")
        return &tangents;
    if (attribute.starts_with("JOINTS_"))
        return &joints;
    if (attribute.starts_with("WEIGHTS_"))
        return &weights;
    if (attribute == "COLOR_0")
        return &colour;
    return attribute.starts_with("TEXCOORD_") ? &uv : nullptr;
}

const tinygltf::Accessor& checked_accessor(const JsonSpot& spot, const GuardedGltf& out, const Legal& legal)
{
    const tinygltf::Accessor& accessor
        = out.model.accessors[std::size_t(index_into(spot, "accessor", out.stated_accessors))];
    if (std::ranges::find(legal.types, accessor.type) == legal.types.end()
        || std::ranges::find(legal.components, accessor.componentType) == legal.components.end())
        spot.fail("names accessor " + spot.json.dump() + " of type " + type_name(accessor) + " and component type "
            + std::to_string(accessor.componentType) + "; glTF does not allow that here");
    return accessor;
}

/// Checks the number of indices, or of vertices where there are none, for a mode.
void check_count(const JsonSpot& spot, int mode, std::size_t count, std::size_t most)
{
    if (mode == TINYGLTF_MODE_TRIANGLES && count % 3 != 0)
        spot.fail("has " + std::to_string(count) + " corners; triangles take a multiple of 3");
    if (mode > TINYGLTF_MODE_TRIANGLES && count < 3)
        spot.fail("has " + std::to_string(count) + " corners; a strip or fan takes 3 or more");
    if (mode == TINYGLTF_MODE_LINE && count % 2 != 0)
        spot.fail("has " + std::to_string(count) + " ends; lines take an even number");
    if ((mode == TINYGLTF_MODE_LINE_LOOP || mode == TINYGLTF_MODE_LINE_STRIP) && count < 2)
        spot.fail("has " + std::to_string(count) + " ends; a strip or loop of lines takes 2 or more");
    if (count > most)
        spot.fail("has " + std::to_string(count) + " corners; at most " + std::to_string(most) + " are allowed here");
}

/// Morph targets: displacements of positions and normals, which are read; of tangents, which are not.
void guard_targets(const JsonSpot& targets, std::size_t vertices, tinygltf::Primitive& written, const GuardedGltf& out)
{
    for (std::size_t i = 0; i < list(targets, 0).size(); ++i) {
        std::map<std::string, int>& target = written.targets.emplace_back();
        const JsonSpot spot = targets[i];
        for (const char* name : {"POSITION", "NORMAL"})
            if (object(spot).has(name)) {
                const auto count = checked_accessor(spot[name], out, *legal_for(name)).count;
                if (count != vertices)
                    spot[name].fail(
                        "has " + std::to_string(count) + " elements; the attributes have " + std::to_string(vertices));
                target[name] = spot[name].json.get<int>();
            }
    }
}

void guard_primitive(const JsonSpot& primitive, tinygltf::Primitive& written, GuardedGltf& out)
{
    static const Legal indices{{TINYGLTF_TYPE_SCALAR},
        {TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
            TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT}};
    written.mode = int(integer_or(primitive, "mode", TINYGLTF_MODE_TRIANGLES, 0, 6));
    JsonSpot attributes = primitive["attributes"];
    std::size_t vertices = 0;
    for (const auto& [name, _] : object(attributes).json.items()) {
        const Legal* legal = legal_for(name);
        JsonSpot spot = attributes[name];
        if (!legal) {
            // Starbow does not read further colours, or application-specific attributes.
            index_into(spot, "accessor", out.stated_accessors);
            continue;
        }
        auto count = checked_accessor(spot, out, *legal).count;
        if (vertices != 0 && count != vertices)
            spot.fail("has " + std::to_string(count) + " elements; the other attributes have " + std::to_string(vertices));
        vertices = count;
        written.attributes[name] = spot.json.get<int>();
    }
    if (vertices > out.limits.vertices)
        attributes.fail("have " + std::to_string(vertices) + " vertices; at most " + std::to_string(out.limits.vertices)
            + " are allowed here");
    if (primitive.has("material"))
        written.material = int(index_into(primitive["material"], "material", out.model.materials.size()));
    if (primitive.has("targets"))
        guard_targets(primitive["targets"], vertices, written, out);
    if (primitive.has("extensions") && object(primitive["extensions"]).has("KHR_draco_mesh_compression")) {
        if (written.mode != TINYGLTF_MODE_TRIANGLES)
            primitive["mode"].fail("is packed; packed meshes are lists of triangles here");
        unpack_draco(primitive["extensions"]["KHR_draco_mesh_compression"], written, out);
    } else if (primitive.has("indices")) {
        JsonSpot spot = primitive["indices"];
        const tinygltf::Accessor& accessor = checked_accessor(spot, out, indices);
        if (accessor.bufferView < 0)
            spot.fail("names accessor " + spot.json.dump() + ", which has no bufferView; indices need one");
        check_count(spot, written.mode, accessor.count, out.limits.indices);
        written.indices = spot.json.get<int>();
    } else if (written.attributes.contains("POSITION"))
        check_count(primitive, written.mode, vertices, out.limits.indices);
}

} // namespace

std::vector<double> weights_of(const JsonSpot& owner)
{
    if (!owner.has("weights"))
        return {};
    const JsonSpot weights = owner["weights"];
    return numbers(weights, list(weights).size(), -1e6, 1e6);
}

void guard_skins(const JsonSpot& root, GuardedGltf& out)
{
    guard_list(root, "skins", out.model.skins, [&](const JsonSpot& skin, tinygltf::Skin& written) {
        const JsonSpot joints = skin["joints"];
        for (std::size_t i = 0; i < list(joints).size(); ++i)
            written.joints.push_back(int(index_into(joints[i], "node", count_of(root, "nodes"))));
        if (!skin.has("inverseBindMatrices"))
            return;
        static const Legal matrices{{TINYGLTF_TYPE_MAT4}, {TINYGLTF_COMPONENT_TYPE_FLOAT}};
        const JsonSpot spot = skin["inverseBindMatrices"];
        if (const auto count = checked_accessor(spot, out, matrices).count; count < written.joints.size())
            spot.fail("has " + std::to_string(count) + " matrices; the skin has " + std::to_string(written.joints.size())
                + " joints");
        written.inverseBindMatrices = spot.json.get<int>();
    });
}

std::string type_name(const tinygltf::Accessor& accessor)
{
    return std::ranges::find(shapes, accessor.type, &AccessorShape::type)->name;
}

void guard_accessors(const JsonSpot& root, GuardedGltf& out)
{
    bool packed = false;
    if (root.has("extensionsUsed"))
        for (std::size_t i = 0; i < list(root["extensionsUsed"], 0).size(); ++i)
            packed |= text(root["extensionsUsed"][i]) == "KHR_draco_mesh_compression";
    guard_list(root, "accessors", out.model.accessors, [&](const JsonSpot& accessor, tinygltf::Accessor& written) {
        guard_accessor(accessor, written, out.model.bufferViews, packed);
    });
    out.stated_accessors = out.model.accessors.size();
}

void guard_meshes(const JsonSpot& root, GuardedGltf& out)
{
    guard_list(root, "meshes", out.model.meshes, [&](const JsonSpot& mesh, tinygltf::Mesh& written) {
        JsonSpot primitives = mesh["primitives"];
        list(primitives);
        written.weights = weights_of(mesh);
        for (std::size_t i = 0; i < primitives.size(); ++i)
            guard_primitive(object(primitives[i]), written.primitives.emplace_back(), out);
    });
}

} // namespace starbow
