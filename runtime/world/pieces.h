#pragma once
#include "world.h"
#include <functional>
#include <span>

namespace starbow {

/// Surfaces of more triangles are divided into pieces, for a surface as large as a landscape is near and far at once.
constexpr std::size_t most_triangles_of_a_surface = 1 << 17;

/// True for a surface that add_pieces divides: not for one that deforms, which has no levels, nor for a blended one, which is
/// drawn in an order of its own.
bool is_divided(const World& world, const Primitive& primitive);

/// Divides a surface into pieces and makes coarser ones of them, until few are left. The order of its triangles changes;
/// those of the coarser pieces are added to World::indices. progress: from one part of the work that is done to another.
void add_pieces(World& world, Primitive& primitive, const std::function<void(double)>& progress, double from, double to);

} // namespace starbow
