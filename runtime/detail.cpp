#include "detail.h"
#include <algorithm>
#include <meshoptimizer.h>

namespace starbow {
namespace {

/// Pieces that hang together by their vertices.
std::size_t pieces(const std::vector<std::uint32_t>& indices, std::size_t vertex_count)
{
    std::vector<std::uint32_t> parent(vertex_count);
    for (std::uint32_t i = 0; i < vertex_count; ++i)
        parent[i] = i;
    auto root = [&](std::uint32_t i) {
        while (parent[i] != i)
            i = parent[i] = parent[parent[i]];
        return i;
    };
    for (std::size_t i = 0; i < indices.size(); i += 3)
        for (int k : {1, 2})
            parent[root(indices[i + k])] = root(indices[i]);
    std::size_t count = 0;
    for (std::uint32_t i : indices)
        if (parent[i] == i)
            ++count, parent[i] = UINT32_MAX; // so that each root counts once
    return count;
}

} // namespace

void add_detail_levels(World& world)
{
    constexpr std::size_t worth = 3 * 64; // indices
    constexpr float most_error = 0.25f; // of the primitive's extent; beyond it hardly anything is left
    std::vector<std::uint32_t> level;
    for (Primitive& primitive : world.primitives) {
        if (primitive.index_count < worth)
            continue;
        const Vertex* vertices = world.vertices.data() + primitive.vertex_offset;
        std::vector<std::uint32_t> from(world.indices.begin() + primitive.first_index,
            world.indices.begin() + primitive.first_index + primitive.index_count);
        std::size_t vertex_count = *std::max_element(from.begin(), from.end()) + 1;
        // A cloud of small things (stars, leaves) has no surface to simplify: each of them would shrink or vanish.
        if (from.size() / 3 < 12 * pieces(from, vertex_count))
            continue;
        const float* positions = &vertices->position.x;
        double extent = meshopt_simplifyScale(positions, vertex_count, sizeof(Vertex));
        double error = 0;
        while (from.size() > 3 * 16) {
            level.resize(from.size());
            float added = 0;
            std::size_t count = meshopt_simplify(level.data(), from.data(), from.size(), positions, vertex_count,
                sizeof(Vertex), from.size() / 6 * 3, most_error, 0, &added);
            if (count == 0 || count > from.size() * 4 / 5)
                break;
            level.resize(count);
            meshopt_optimizeVertexCache(level.data(), level.data(), count, vertex_count);
            // Each step is measured against the one before it, so the errors add up at worst.
            error += added * extent;
            primitive.coarser.push_back({std::uint32_t(world.indices.size()), std::uint32_t(count), error});
            world.indices.insert(world.indices.end(), level.begin(), level.end());
            from = level;
        }
    }
}

} // namespace starbow
