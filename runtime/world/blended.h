#pragma once
#include "world.h"
#include <span>

namespace starbow {

/// Finds what of blended surfaces is opaque. A material without any transparent place is not blended any more; one with
/// opaque places gets an alpha_cutoff, because those hide what is behind them in any order of triangles.
void find_opaque_places(World& world);

/// Lists the triangles of blended surfaces, at each level of detail; large ones are divided, which adds vertices.
void add_blended_triangles(World& world);

/// The triangles of a blended surface at a level of detail; 0: the full surface.
std::span<const BlendedTriangle> blended_triangles(const World& world, const Primitive& primitive, std::size_t level);

/// Says what of blended surfaces may be drawn in a wrong order: transparent parts that cross each other.
void note_crossing_blended(const World& world, std::vector<std::string>& notes);

} // namespace starbow
