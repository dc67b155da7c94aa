#pragma once
#include "runtime/world/world.h"
#include <array>

namespace starbow {

/// A world's textures, decoded, without mip levels.
class Pictures {
public:
    explicit Pictures(const World& world); ///< which must outlive it

    /// Linear light or numbers, and alpha, at a texture coordinate; texture -1: white. The sampler decides between an
    /// interpolation of the four texels around and the nearest one.
    glm::dvec4 at(int texture, const glm::dvec2& uv) const;

private:
    const World& world_;
    std::array<double, 256> linear_; ///< of sRGB's bytes
};

} // namespace starbow
