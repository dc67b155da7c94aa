#include "detail.h"
#include "clusters.h"
#include "parallel.h"
#include "pieces.h"
#include "simplifier.h"
#include <algorithm>

namespace starbow {
namespace {

constexpr std::size_t worth_levels = 3 * 64; // indices

} // namespace

void add_detail_levels(World& world, const std::function<void(double)>& progress)
{
    const std::size_t count = world.primitives.size();
    double corners = 0, whole = 0;
    for (const Primitive& primitive : world.primitives)
        (is_divided(world, primitive) ? corners : whole) += primitive.index_count;
    double done = whole / std::max(corners + whole, 1.0);
    std::vector<std::vector<std::uint32_t>> added(count);
    const auto add_levels = [&](std::size_t i) {
        Primitive& primitive = world.primitives[i];
        // A level's error holds in one pose alone.
        if (primitive.topology != Topology::triangles || primitive.index_count < worth_levels || primitive.deforming >= 0
            || is_divided(world, primitive))
            return;
        Simplifier simplifier(world, primitive, {world.indices.data() + primitive.first_index, primitive.index_count});
        if (!simplifier.coherent())
            return;
        while (simplifier.halve()) {
            const std::vector<std::uint32_t> own = simplifier.corners();
            DetailLevel level = simplifier.level();
            level.first_index = std::uint32_t(added[i].size()), level.index_count = std::uint32_t(own.size());
            added[i].insert(added[i].end(), own.begin(), own.end());
            primitive.coarser.push_back(level);
        }
    };
    in_parallel(count, add_levels, progress, 0, done);
    for (std::size_t i = 0; i < count; ++i) {
        for (DetailLevel& level : world.primitives[i].coarser)
            level.first_index += std::uint32_t(world.indices.size());
        world.indices.insert(world.indices.end(), added[i].begin(), added[i].end());
        added[i] = {};
    }
    for (Primitive& primitive : world.primitives)
        if (is_divided(world, primitive)) {
            const double next = done + primitive.index_count / (corners + whole);
            add_pieces(world, primitive, progress, done, next);
            done = next;
        }
    add_clusters(world);
}

} // namespace starbow
