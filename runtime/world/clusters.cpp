#include "clusters.h"
#include <algorithm>
#include <meshoptimizer.h>
#include <span>

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
    const Vertex* vertices = world.vertices.data() + primitive.vertex_offset;
    const float* positions = &vertices->position.x;
    const std::span<std::uint32_t> indices(world.indices.data() + first_index, index_count);
    const std::size_t vertex_count = *std::max_element(indices.begin(), indices.end()) + std::size_t(1);
    const std::size_t most = meshopt_buildMeshletsBound(index_count, most_vertices, most_triangles);
    std::vector<meshopt_Meshlet> meshlets(most);
    std::vector<unsigned int> corners(most * most_vertices);
    std::vector<unsigned char> triangles(most * most_triangles * 3);
    // Normals that agree count as much as a small sphere.
    constexpr float normals = 0.5f;
    meshlets.resize(meshopt_buildMeshlets(meshlets.data(), corners.data(), triangles.data(), indices.data(), index_count,
        positions, vertex_count, sizeof(Vertex), most_vertices, most_triangles, normals));
    std::uint32_t at = first_index;
    for (const meshopt_Meshlet& meshlet : meshlets) {
        const unsigned int* own = corners.data() + meshlet.vertex_offset;
        const unsigned char* of = triangles.data() + meshlet.triangle_offset;
        const meshopt_Bounds bounds
            = meshopt_computeMeshletBounds(own, of, meshlet.triangle_count, positions, vertex_count, sizeof(Vertex));
        world.clusters.push_back({vector_of(bounds.center), bounds.radius, vector_of(bounds.cone_axis), bounds.cone_cutoff,
            at, std::uint32_t(3 * meshlet.triangle_count)});
        for (std::size_t i = 0; i < 3 * std::size_t(meshlet.triangle_count); ++i)
            world.indices[at++] = own[of[i]];
    }
    range.count = std::uint32_t(meshlets.size());
    return range;
}

} // namespace

void add_clusters(World& world)
{
    for (Primitive& primitive : world.primitives) {
        primitive.clusters = clusters_of(world, primitive, primitive.first_index, primitive.index_count);
        for (DetailLevel& level : primitive.coarser)
            level.clusters = clusters_of(world, primitive, level.first_index, level.index_count);
    }
}

} // namespace starbow
