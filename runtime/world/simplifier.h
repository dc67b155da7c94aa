#pragma once
#include "world.h"
#include <span>

namespace starbow {

/// A surface with its own vertices alone, in the world's order. Tools whose time grows with all vertices of a list then take
/// no longer for a part of a large surface.
struct CompactSurface {
    std::vector<std::uint32_t> from; ///< the index of each vertex from the primitive's vertex_offset
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices; ///< into `vertices`
};
/// corners: from the primitive's vertex_offset.
CompactSurface compact(const World& world, const Primitive& primitive, std::span<const std::uint32_t> corners);

/// Makes levels of a surface in fewer and fewer triangles.
class Simplifier {
public:
    /// from: the corners of the surface to begin with, from the primitive's vertex_offset. locked: its border stays as it
    /// is. errors: those of the beginning, which is itself a level of a finer surface.
    Simplifier(const World& world, const Primitive& primitive, std::span<const std::uint32_t> from, bool locked = false,
        const PieceGroup& errors = {});

    /// False for a cloud of small things (stars, leaves), which can't be simplified: each of them would shrink or vanish.
    bool coherent() const;
    /// Halves the number of triangles. Returns false where that would not be the same surface any more.
    bool halve();

    /// The present surface's errors, without its corners.
    const DetailLevel& level() const { return level_; }
    /// Its corners, from the primitive's vertex_offset.
    std::vector<std::uint32_t> corners() const;

private:
    CompactSurface surface_;
    std::vector<Vertex> first_; ///< the beginning's
    bool locked_;
    DetailLevel level_;
    double first_shading_, first_apart_;
};

} // namespace starbow
