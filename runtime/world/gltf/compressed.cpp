#include "compressed.h"
#include "accessor.h"
#include <algorithm>
#include <array>
#include <cstring>
#include <draco/compression/decode.h>
#include <meshoptimizer.h>

namespace starbow {

Bytes unpack_meshopt(const JsonSpot& packed, std::span<const std::uint8_t> from)
{
    const std::string mode = text(packed["mode"]);
    const std::string filter = packed.has("filter") ? text(packed["filter"]) : "NONE";
    const bool attributes = mode == "ATTRIBUTES";
    if (!attributes && mode != "TRIANGLES" && mode != "INDICES")
        packed["mode"].fail("is " + in_quotes(mode) + "; should be ATTRIBUTES, TRIANGLES or INDICES");
    const auto stride = std::size_t(integer(packed["byteStride"], 1, 256));
    if (attributes ? stride % 4 != 0 : stride != 2 && stride != 4)
        packed["byteStride"].fail("is " + std::to_string(stride) + "; "
            + (attributes ? "a multiple of 4, at most 256," : "2 or 4") + " is right for " + mode);
    const auto count = std::size_t(integer(packed["count"], 1, 0x7fffffff));
    if (mode == "TRIANGLES" && count % 3 != 0)
        packed["count"].fail("is " + std::to_string(count) + "; triangles take a multiple of 3");
    // Its packer makes at most a thousandth of it, and then of zeros.
    if (count * stride / 4096 > from.size())
        packed["count"].fail(
            "is " + std::to_string(count) + "; " + std::to_string(from.size()) + " packed bytes cannot hold so many");
    Bytes out(count * stride);
    const int failed = attributes ? meshopt_decodeVertexBuffer(out.data(), count, stride, from.data(), from.size())
        : mode == "TRIANGLES"     ? meshopt_decodeIndexBuffer(out.data(), count, stride, from.data(), from.size())
                                  : meshopt_decodeIndexSequence(out.data(), count, stride, from.data(), from.size());
    if (failed != 0)
        packed.fail("cannot be decoded (" + std::to_string(failed) + "); the exporter's own bytes are right");
    const auto wants = [&](bool right, const char* strides) {
        if (!attributes || !right)
            packed["filter"].fail("is " + filter + "; it is for ATTRIBUTES with a byteStride of " + strides);
    };
    if (filter == "OCTAHEDRAL") {
        wants(stride == 4 || stride == 8, "4 or 8");
        meshopt_decodeFilterOct(out.data(), count, stride);
    } else if (filter == "QUATERNION") {
        wants(stride == 8, "8");
        meshopt_decodeFilterQuat(out.data(), count, stride);
    } else if (filter == "EXPONENTIAL") {
        wants(true, "any multiple of 4");
        meshopt_decodeFilterExp(out.data(), count, stride);
    } else if (filter != "NONE")
        packed["filter"].fail("is " + in_quotes(filter) + "; should be NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL");
    return out;
}

namespace {

/// Adds an accessor of values of its own, and returns its index.
template <typename T>
int add_accessor(GuardedGltf& out, const std::vector<T>& values, std::size_t count, int type, int component)
{
    tinygltf::Model& model = out.model;
    tinygltf::Buffer& buffer = model.buffers.emplace_back();
    buffer.data.resize(values.size() * sizeof(T));
    std::memcpy(buffer.data.data(), values.data(), buffer.data.size());
    tinygltf::BufferView& view = model.bufferViews.emplace_back();
    view.buffer = int(model.buffers.size()) - 1;
    view.byteLength = buffer.data.size();
    tinygltf::Accessor& accessor = model.accessors.emplace_back();
    accessor.bufferView = int(model.bufferViews.size()) - 1;
    accessor.count = count;
    accessor.type = type;
    accessor.componentType = component;
    return int(model.accessors.size()) - 1;
}

} // namespace

void unpack_draco(const JsonSpot& packed, tinygltf::Primitive& written, GuardedGltf& out)
{
    const auto& view
        = out.model.bufferViews[std::size_t(index_into(object(packed)["bufferView"], "buffer view", out.stated_views))];
    const auto& bytes = out.model.buffers[std::size_t(view.buffer)].data;
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()) + view.byteOffset, view.byteLength);
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        packed.fail("cannot be decoded (" + std::string(decoded.status().error_msg())
            + "); a mesh as Draco's encoder leaves it is right");
    const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
    const std::size_t points = mesh->num_points(), corners = 3 * std::size_t(mesh->num_faces());
    if (points == 0 || corners == 0 || points > out.limits.vertices || corners > out.limits.indices)
        packed.fail("holds " + std::to_string(points) + " vertices and " + std::to_string(corners)
            + " corners; some are right, and at most " + std::to_string(out.limits.vertices) + " and "
            + std::to_string(out.limits.indices));
    std::vector<std::uint32_t> indices;
    indices.reserve(corners);
    for (draco::FaceIndex face(0); face < mesh->num_faces(); ++face)
        for (const draco::PointIndex& point : mesh->face(face)) {
            if (point.value() >= points)
                packed.fail("names vertex " + std::to_string(point.value()) + " of " + std::to_string(points));
            indices.push_back(point.value());
        }
    written.indices = add_accessor(out, indices, corners, TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
    const JsonSpot ids = packed["attributes"];
    for (const auto& [name, id] : object(ids).json.items()) {
        if (!written.attributes.contains(name))
            continue; // an attribute that no world of ours uses
        const draco::PointAttribute* attribute
            = mesh->GetAttributeByUniqueId(std::uint32_t(integer(ids[name], 0, 0xffffffff)));
        if (!attribute)
            ids[name].fail("names attribute " + id.dump() + ", which the packed mesh lacks");
        const tinygltf::Accessor as = out.model.accessors[std::size_t(written.attributes.at(name))];
        const int components = tinygltf::GetNumComponentsInType(std::uint32_t(as.type));
        if (attribute->num_components() != components)
            ids[name].fail("has " + std::to_string(attribute->num_components()) + " components; " + name + " has "
                + std::to_string(components));
        const double scale = as.normalized && !attribute->normalized() ? 1 / full_scale(as.componentType) : 1;
        std::vector<float> values;
        values.reserve(points * std::size_t(components));
        for (draco::PointIndex point(0); point < points; ++point) {
            std::array<float, 4> value{};
            const draco::AttributeValueIndex at = attribute->mapped_index(point);
            if (at.value() >= attribute->size()
                || !attribute->ConvertValue<float>(at, std::int8_t(components), value.data()))
                ids[name].fail("cannot be read at vertex " + std::to_string(point.value()));
            for (int k = 0; k < components; ++k)
                values.push_back(float(value[std::size_t(k)] * scale));
        }
        written.attributes[name] = add_accessor(out, values, points, as.type, TINYGLTF_COMPONENT_TYPE_FLOAT);
    }
    // A stated attribute beside the packed ones has as many values as the packed mesh has vertices, or is left out.
    std::erase_if(written.attributes,
        [&](const auto& attribute) { return out.model.accessors[std::size_t(attribute.second)].count != points; });
}

} // namespace starbow
