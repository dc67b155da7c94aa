#pragma once
#include "guard.h"

namespace starbow {

/// The bytes of a buffer view that EXT_meshopt_compression packs: `packed` is the view's extension, `from` its bytes. Throws
/// InputError.
Bytes unpack_meshopt(const JsonSpot& packed, std::span<const std::uint8_t> from);

/// Unpacks a primitive of KHR_draco_mesh_compression: accessors of its own for its indices and the packed attributes take
/// the place of the stated ones. `packed`: the primitive's extension. Throws InputError.
void unpack_draco(const JsonSpot& packed, tinygltf::Primitive& written, GuardedGltf& out);

} // namespace starbow
