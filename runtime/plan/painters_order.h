#pragma once
#include "cull.h"

namespace starbow {

/// Sorts draws of one instance each, so that each comes after those behind it, as the eye at the origin sees their boxes:
/// where a side of one box parts it from the other box, by the eye's side of it; else by their middles. boxes: DrawList's.
void sort_from_behind(std::span<Draw> draws, const DrawList& list);

/// Adds the triangles of an instance of a blended surface to the list's sorted_indices, those with the farthest middles
/// first, unless they are there. Returns the first index. instance: of the list. level: 0: the full surface. triangles:
/// World::blended_triangles of that level; corners: of each.
std::uint32_t sorted_from_behind(DrawList& list, std::uint32_t instance, std::size_t level,
    std::span<const BlendedTriangle> triangles, std::uint32_t corners);

} // namespace starbow
