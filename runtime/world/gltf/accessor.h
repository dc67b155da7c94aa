#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tinygltf {
class Model;
}

namespace starbow {

/// The value that stands for 1 in normalized numbers of a component type (glTF 2.0, section 3.11); 1 for floats.
double full_scale(int component_type);

/// The elements of one accessor, of any type, read one at a time as numbers.
struct Elements {
    const std::uint8_t* first = nullptr;
    std::size_t stride = 0; ///< 0 for an accessor without a buffer view, whose elements are zeros
    std::size_t count = 0;
    int component_type = 0, components = 0;
    bool normalized = false;
    std::vector<std::uint8_t> dense; ///< the data behind `first` when the accessor is sparse

    double component(std::size_t element, int which) const;
    std::uint32_t index(std::size_t element) const; ///< for accessors of indices
};

/// Opens an accessor. `sparse_bytes_left` bounds the copies that sparse accessors need. Returns false when it is used up,
/// or when a sparse index is out of range or order; `problem` then names the reason. The guard must have checked the
/// model.
bool open_accessor(
    const tinygltf::Model& model, int accessor, std::size_t& sparse_bytes_left, Elements& out, const char*& problem);

} // namespace starbow
