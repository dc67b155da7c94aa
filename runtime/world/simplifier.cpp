#include "simplifier.h"
#include <algorithm>
#include <cmath>
#include <glm/gtc/type_precision.hpp>
#include <meshoptimizer.h>
#include <optional>
#include <unordered_map>

namespace starbow {
namespace {

/// The number of pieces that are connected by their vertices.
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

/// The point of a triangle that is closest to p, as parts of its corners (Ericson, Real-Time Collision Detection, 5.1.5).
glm::vec3 closest(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
{
    const glm::vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0 && d2 <= 0)
        return {1, 0, 0};
    const float d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0 && d4 <= d3)
        return {0, 1, 0};
    const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0 && d5 <= d6)
        return {0, 0, 1};
    const float vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0)
        return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
    if (vb <= 0 && d2 >= 0 && d6 <= 0)
        return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const float w = (d4 - d3) / (d4 - d3 + d5 - d6);
        return {0, 1 - w, w};
    }
    const float sum = va + vb + vc;
    return {va / sum, vb / sum, vc / sum};
}

glm::vec3 colour_of(const Vertex& vertex)
{
    return glm::vec3(vertex.colour & 255, vertex.colour >> 8 & 255, vertex.colour >> 16 & 255) / 255.0f;
}

/// The differences between a level and the full surface, local units.
struct Differences {
    double shading = 0; ///< DetailLevel's
    double apart = 0; ///< greatest distance between the tested vertices and the level
};

/// The width over which a level's shading and colours differ from the full surface's, where its shape does not. A removed
/// vertex loses its normal up to the next remaining vertex; a small difference counts as a small part of that way. The
/// greatest distance is that of the full surface's vertices. Only some vertices are tested, so that it takes milliseconds.
Differences differences(const std::vector<Vertex>& full, const std::vector<Vertex>& vertices,
    const std::vector<std::uint32_t>& level, float extent)
{
    const float same = 1e-5f * extent;
    constexpr std::size_t most_tested = 8'000'000; // triangle tests; nearly all triangles are too far off
    struct Box {
        glm::vec3 low, high;
    };
    std::vector<Box> boxes;
    for (std::size_t k = 0; k < level.size(); k += 3) {
        const glm::vec3 &a = vertices[level[k]].position, &b = vertices[level[k + 1]].position,
                        &c = vertices[level[k + 2]].position;
        boxes.push_back({glm::min(glm::min(a, b), c) - same, glm::max(glm::max(a, b), c) + same});
    }
    const std::size_t step = std::max<std::size_t>(1, full.size() * boxes.size() / most_tested);
    Differences most;
    std::size_t first = 0; // the triangle nearest to the vertex before
    for (std::size_t i = 0; i < full.size(); i += step) {
        const Vertex& vertex = full[i];
        float nearest = INFINITY, other = 0, way = 0;
        auto test = [&](std::size_t triangle) {
            const Vertex *a = &vertices[level[3 * triangle]], *b = &vertices[level[3 * triangle + 1]],
                         *c = &vertices[level[3 * triangle + 2]];
            const glm::vec3 parts = closest(vertex.position, a->position, b->position, c->position);
            const float distance
                = glm::length(parts.x * a->position + parts.y * b->position + parts.z * c->position - vertex.position);
            if (!(distance <= nearest + same))
                return;
            const glm::vec3 normal = parts.x * a->normal + parts.y * b->normal + parts.z * c->normal;
            const float length = glm::length(normal);
            const glm::vec3 colour = parts.x * colour_of(*a) + parts.y * colour_of(*b) + parts.z * colour_of(*c);
            const float off = glm::length(length > 0 ? normal / length - vertex.normal : vertex.normal)
                + glm::length(colour - colour_of(vertex));
            // At a sharp edge several triangles are equally near: the one with the vertex' own normal counts.
            if (distance >= nearest - same && off >= other)
                return;
            nearest = std::min(nearest, distance), other = off, first = triangle;
            way = std::min({glm::length(a->position - vertex.position), glm::length(b->position - vertex.position),
                glm::length(c->position - vertex.position)});
        };
        test(first);
        for (std::size_t k = 0; k < boxes.size(); ++k)
            if (glm::all(glm::greaterThanEqual(vertex.position, boxes[k].low - nearest))
                && glm::all(glm::lessThanEqual(vertex.position, boxes[k].high + nearest)))
                test(k);
        most.shading = std::max(most.shading, double(std::min(other, 1.0f) * way));
        most.apart = std::max(most.apart, double(nearest));
    }
    return most;
}

/// How far a smooth surface with the vertices' normals may bulge from its triangles: over an edge by an eighth of its length
/// times the angle between the normals, as a circle does, and over an even triangle's middle by a sixth.
double bulge(const std::vector<Vertex>& vertices, const std::vector<std::uint32_t>& level)
{
    float most = 0;
    for (std::size_t k = 0; k < level.size(); k += 3)
        for (std::size_t side = 0; side < 3; ++side) {
            const Vertex &a = vertices[level[k + side]], &b = vertices[level[k + (side + 1) % 3]];
            most = std::max(most, std::abs(glm::dot(b.position - a.position, b.normal - a.normal)));
        }
    return most / 6;
}

/// Gives one place to vertices whose places differ by roundings alone: an exporter writes sin 0 at one end of a ball's row
/// and sin 2 pi at the other. A seam between such vertices would look like two borders, and open.
void close_seams(std::vector<Vertex>& vertices)
{
    float largest = 0;
    for (const Vertex& vertex : vertices)
        for (int i = 0; i < 3; ++i)
            largest = std::max(largest, std::abs(vertex.position[i]));
    const float apart = 0x1p-21f * largest; // eight times the last bit of the largest number
    if (!(apart > 0))
        return;
    const auto cell_of = [&](const glm::vec3& place) {
        const glm::i64vec3 cell = glm::floor(glm::dvec3(place) / (4.0 * apart)); // 20 bits and a sign
        return std::uint64_t(cell.x) << 42 ^ (std::uint64_t(cell.y) & 0x1fffff) << 21 ^ (std::uint64_t(cell.z) & 0x1fffff);
    };
    std::unordered_multimap<std::uint64_t, std::uint32_t> firsts; // by cell
    firsts.reserve(vertices.size());
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        const glm::vec3 own = vertices[i].position;
        std::optional<std::uint32_t> same;
        for (int corner = 0; corner < 8 && !same; ++corner) {
            const glm::vec3 way(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
            const auto [from, to] = firsts.equal_range(cell_of(own + apart * way));
            for (auto each = from; each != to && !same; ++each)
                if (glm::all(glm::lessThanEqual(glm::abs(vertices[each->second].position - own), glm::vec3(apart))))
                    same = each->second;
        }
        if (same)
            vertices[i].position = vertices[*same].position;
        else
            firsts.emplace(cell_of(own), i);
    }
}

} // namespace

CompactSurface compact(const World& world, const Primitive& primitive, std::span<const std::uint32_t> corners)
{
    CompactSurface out;
    out.indices.assign(corners.begin(), corners.end());
    out.from = out.indices;
    std::ranges::sort(out.from);
    out.from.erase(std::unique(out.from.begin(), out.from.end()), out.from.end());
    for (std::uint32_t& index : out.indices)
        index = std::uint32_t(std::ranges::lower_bound(out.from, index) - out.from.begin());
    out.vertices.reserve(out.from.size());
    for (const std::uint32_t index : out.from)
        out.vertices.push_back(world.vertices[std::size_t(primitive.vertex_offset) + index]);
    return out;
}

Simplifier::Simplifier(const World& world, const Primitive& primitive, std::span<const std::uint32_t> from, bool locked,
    const PieceGroup& errors)
    : surface_(compact(world, primitive, from))
    , locked_(locked)
    , level_{0, 0, errors.error, errors.shading, errors.apart}
    , first_shading_(errors.shading)
    , first_apart_(errors.apart)
{
    close_seams(surface_.vertices);
    first_ = surface_.vertices;
}

bool Simplifier::coherent() const
{
    return surface_.indices.size() / 3 >= 12 * pieces(surface_.indices, surface_.vertices.size());
}

bool Simplifier::halve()
{
    constexpr float most_error = 0.25f; // of the extent; beyond it hardly any surface is left
    std::vector<std::uint32_t>& from = surface_.indices;
    if (from.size() <= 3 * 16)
        return false;
    const std::size_t vertices = surface_.vertices.size();
    const float* positions = &surface_.vertices[0].position.x;
    const double extent = meshopt_simplifyScale(positions, vertices, sizeof(Vertex));
    std::vector<std::uint32_t> level(from.size());
    float added = 0;
    const std::size_t count = meshopt_simplify(level.data(), from.data(), from.size(), positions, vertices, sizeof(Vertex),
        from.size() / 6 * 3, most_error, locked_ ? meshopt_SimplifyLockBorder : 0, &added);
    if (count == 0 || count > from.size() * 4 / 5)
        return false;
    level.resize(count);
    const Differences most = differences(first_, surface_.vertices, level, float(extent));
    level_.shading = std::max(level_.shading, first_shading_ + most.shading);
    meshopt_optimizeVertexCache(level.data(), level.data(), count, vertices);
    // Each step is measured against the one before, so the sum of errors is an upper bound.
    level_.error += added * extent;
    // Some vertices are tested of many; between them a smooth surface may bulge more. Normals that do not belong to a smooth
    // surface, as of a box without edges, tell too much: of balls the distance is below four times the mean error.
    constexpr double untested = 1.25, most_of_errors = 4;
    level_.apart = std::max({level_.apart, first_apart_ + untested * most.apart,
        first_apart_ + std::min(bulge(surface_.vertices, level), most_of_errors * level_.error)});
    from = std::move(level);
    return true;
}

std::vector<std::uint32_t> Simplifier::corners() const
{
    std::vector<std::uint32_t> corners;
    corners.reserve(surface_.indices.size());
    for (const std::uint32_t index : surface_.indices)
        corners.push_back(surface_.from[index]);
    return corners;
}

} // namespace starbow
