#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tinygltf {
class Model;
}

namespace starbow {

/// Elements of one accessor, whatever their type, read one at a time as numbers.
struct Elements {
    const std::uint8_t* first = nullptr;
    std::size_t stride = 0; ///< 0 for the zeros of an accessor without a buffer view
    std::size_t count = 0;
    int component_type = 0, components = 0;
    bool normalized = false;
    std::vector<std::uint8_t> dense; ///< what `first` points into when the accessor is sparse

    double component(std::size_t element, int which) const;
    std::uint32_t index(std::size_t element) const; ///< for accessors of indices
};

/// `sparse_bytes_left` bounds the copies that sparse accessors need. Returns false when it is used up, or when a sparse
/// index is out of range or order; `problem` then says which. The model must have passed the guard.
bool open_accessor(
    const tinygltf::Model& model, int accessor, std::size_t& sparse_bytes_left, Elements& out, const char*& problem);

} // namespace starbow
