#include "clusters.h"
#include "simplifier.h"
#include <algorithm>
#include <meshoptimizer.h>

namespace starbow {
namespace {

/// A cluster costs a test and up to one more draw; without any, whole surfaces are drawn. Columns and trees then still have
/// some twenty.
constexpr std::size_t most_vertices = 255, most_triangles = 256, worth = 3 * 2 * most_triangles;

glm::vec3 vector_of(const float* v) { return {v[0], v[1], v[2]}; }

ClusterRange clusters_of(World& world, const Primitive& primitive, std::uint32_t first_index, std::uint32_t index_count)
{
    ClusterRange range{std::uint32_t(world.clusters.size()), 0};
    if (index_count < worth)
        return range;
    const CompactSurface surface = compact(world, primitive, {world.indices.data() + first_index, index_count});
    const float* positions = &surface.vertices[0].position.x;
    const std::size_t vertex_count = surface.vertices.size();
    const std::size_t most = meshopt_buildMeshletsBound(index_count, most_vertices, most_triangles);
    std::vector<meshopt_Meshlet> meshlets(most);
    std::vector<unsigned int> corners(most * most_vertices);
    std::vector<unsigned char> triangles(most * most_triangles * 3);
    // Normals that agree count as much as a small sphere.
    constexpr float normals = 0.5f;
    meshlets.resize(meshopt_buildMeshlets(meshlets.data(), corners.data(), triangles.data(), surface.indices.data(),
        index_count, positions, vertex_count, sizeof(Vertex), most_vertices, most_triangles, normals));
    std::uint32_t at = first_index;
    for (const meshopt_Meshlet& meshlet : meshlets) {
        const unsigned int* own = corners.data() + meshlet.vertex_offset;
        const unsigned char* of = triangles.data() + meshlet.triangle_offset;
        const meshopt_Bounds bounds
            = meshopt_computeMeshletBounds(own, of, meshlet.triangle_count, positions, vertex_count, sizeof(Vertex));
        world.clusters.push_back({vector_of(bounds.center), bounds.radius, vector_of(bounds.cone_axis), bounds.cone_cutoff,
            at, std::uint32_t(3 * meshlet.triangle_count)});
        for (std::size_t i = 0; i < 3 * std::size_t(meshlet.triangle_count); ++i)
            world.indices[at++] = surface.from[own[of[i]]];
    }
    range.count = std::uint32_t(meshlets.size());
    return range;
}

} // namespace

void add_clusters(World& world)
{
    for (Primitive& primitive : world.primitives) {
        const auto set_clusters = [&](DetailLevel& level) {
            level.clusters = clusters_of(world, primitive, level.first_index, level.index_count);
        };
        if (primitive.topology != Topology::triangles)
            continue;
        if (primitive.pieces.count == 0)
            primitive.clusters = clusters_of(world, primitive, primitive.first_index, primitive.index_count);
        for (std::uint32_t i = 0; i < primitive.pieces.count; ++i)
            set_clusters(world.pieces[primitive.pieces.first + i].triangles);
        std::ranges::for_each(primitive.coarser, set_clusters);
    }
}

} // namespace starbow
