#include "accessor.h"
#include <algorithm>
#include <cstring>
#include <tiny_gltf.h>

namespace starbow {
namespace {

template <typename T> T load(const std::uint8_t* from)
{
    T value;
    std::memcpy(&value, from, sizeof value); // files need not keep glTF's alignment
    return value;
}

std::uint32_t load_index(const std::uint8_t* from, int type)
{
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE)
        return *from;
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? load<std::uint16_t>(from) : load<std::uint32_t>(from);
}

const std::uint8_t* bytes_of(const tinygltf::Model& model, int view, std::size_t offset)
{
    const auto& buffer_view = model.bufferViews[std::size_t(view)];
    return model.buffers[std::size_t(buffer_view.buffer)].data.data() + buffer_view.byteOffset + offset;
}

} // namespace

double full_scale(int component_type)
{
    switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return 127;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 255;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return 32767;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 65535;
    default:
        return 1;
    }
}

double Elements::component(std::size_t element, int which) const
{
    const std::uint8_t* from = first + element * stride;
    // glTF 2.0, section 3.11 for the normalized integers: a signed one's two lowest values both mean -1.
    switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
        double value = load<std::int8_t>(from + which);
        return normalized ? std::max(value / 127, -1.0) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return normalized ? from[which] / 255.0 : from[which];
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
        double value = load<std::int16_t>(from + 2 * which);
        return normalized ? std::max(value / 32767, -1.0) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
        double value = load<std::uint16_t>(from + 2 * which);
        return normalized ? value / 65535 : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return load<std::uint32_t>(from + 4 * which);
    default:
        return load<float>(from + 4 * which);
    }
}

std::uint32_t Elements::index(std::size_t element) const { return load_index(first + element * stride, component_type); }

bool open_accessor(
    const tinygltf::Model& model, int index, std::size_t& sparse_bytes_left, Elements& out, const char*& problem)
{
    static const std::uint8_t zeros[64] = {};
    const auto& accessor = model.accessors[std::size_t(index)];
    out.count = accessor.count;
    out.component_type = accessor.componentType;
    out.components = tinygltf::GetNumComponentsInType(std::uint32_t(accessor.type));
    out.normalized = accessor.normalized;
    // Matrices have padded columns, but no attribute has them.
    auto size = std::size_t(tinygltf::GetComponentSizeInBytes(std::uint32_t(accessor.componentType)) * out.components);
    if (accessor.bufferView >= 0) {
        out.first = bytes_of(model, accessor.bufferView, accessor.byteOffset);
        std::size_t stride = model.bufferViews[std::size_t(accessor.bufferView)].byteStride;
        out.stride = stride ? stride : size;
    } else
        out.first = zeros;
    if (!accessor.sparse.isSparse)
        return true;

    if (out.count > sparse_bytes_left / size) {
        problem = "sparse accessors unfold to more bytes than are allowed";
        return false;
    }
    sparse_bytes_left -= out.count * size;
    out.dense.resize(out.count * size);
    for (std::size_t i = 0; i < out.count; ++i)
        std::memcpy(out.dense.data() + i * size, out.first + i * out.stride, size);
    const auto& sparse = accessor.sparse;
    const std::uint8_t* places = bytes_of(model, sparse.indices.bufferView, std::size_t(sparse.indices.byteOffset));
    const std::uint8_t* values = bytes_of(model, sparse.values.bufferView, std::size_t(sparse.values.byteOffset));
    auto place_size = std::size_t(tinygltf::GetComponentSizeInBytes(std::uint32_t(sparse.indices.componentType)));
    std::int64_t before = -1;
    for (std::size_t i = 0; i < std::size_t(sparse.count); ++i) {
        std::int64_t place = load_index(places + i * place_size, sparse.indices.componentType);
        if (place <= before || place >= std::int64_t(out.count)) {
            problem = "has a sparse index that is out of order or beyond the count; they should rise strictly";
            return false;
        }
        before = place;
        std::memcpy(out.dense.data() + std::size_t(place) * size, values + i * size, size);
    }
    out.first = out.dense.data();
    out.stride = size;
    return true;
}

} // namespace starbow
