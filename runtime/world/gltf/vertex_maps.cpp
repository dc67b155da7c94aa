#include "parts.h"
#include <cmath>

namespace starbow {
namespace {

/// A set of texture coordinates of the file's vertex; 0 without one.
glm::vec2 uv_at(WorldBuild& build, const Elements& from, bool there, std::uint32_t i, const std::string& place)
{
    if (!there)
        return glm::vec2(0);
    const glm::dvec2 at(from.component(i, 0), from.component(i, 1));
    if (!(glm::length(at) < 1e18))
        build.fail(place + "/attributes", "has a texture coordinate that is not finite or above 1e18; should be smaller");
    return at;
}

/// Takes the tangents of the file.
void read_tangents(WorldBuild& build, const std::string& place, const tinygltf::Primitive& primitive, const StillPose& pose,
    const std::vector<std::uint32_t>& source, std::size_t first)
{
    const Elements tangents = open(build, primitive.attributes.at("TANGENT"));
    const SkinSource skin = open_skin(build, primitive, pose);
    for (std::size_t i = 0; i < source.size(); ++i) {
        const auto part = [&](int k) { return tangents.component(source[i], k); };
        glm::dvec3 along(part(0), part(1), part(2));
        if (!skin.empty())
            along = glm::dmat3(skin_at(build, pose, skin, source[i], place)) * along;
        const double length = glm::length(along);
        if (length > 0 && length < 1e300)
            build.world.vertex_maps[first + i].tangent = glm::vec4(along / length, part(3) < 0 ? -1 : 1);
    }
}

/// A triangle's tangent, as long as its area in the map is small, and its sense: 1 where the map is seen from its front,
/// -1 mirrored, 0 where it has no area.
glm::dvec4 tangent_of(const Vertex* const (&corner)[3], const glm::dvec2 (&uv)[3])
{
    const glm::dvec3 a = glm::dvec3(corner[1]->position) - glm::dvec3(corner[0]->position),
                     b = glm::dvec3(corner[2]->position) - glm::dvec3(corner[0]->position);
    const glm::dvec2 s = uv[1] - uv[0], t = uv[2] - uv[0];
    // The v axis points down in the map, so its area is negative where the map is seen from its front.
    const double area = s.x * t.y - t.x * s.y;
    if (area == 0 || !std::isfinite(area))
        return glm::dvec4(0);
    return glm::dvec4((a * t.y - b * s.y) / area, area < 0 ? 1 : -1);
}

/// Means of the triangles' tangents at each vertex, by their angles there, as MikkTSpace has them (glTF 2.0,
/// section 3.7.2.1). A vertex between both senses is doubled.
void compute_tangents(WorldBuild& build, const std::string& place, const Map& map, std::vector<std::uint32_t>& source)
{
    World& world = build.world;
    const Primitive& primitive = world.primitives.back();
    const std::size_t first = std::size_t(primitive.vertex_offset), count = world.vertices.size() - first;
    std::vector<glm::dvec3> sum(count, glm::dvec3(0));
    std::vector<int> sense(count, 0); ///< of a vertex's first triangle
    std::vector<std::uint32_t> other(count, 0xffffffff); ///< its double
    const auto uv_of = [&](std::uint32_t vertex) {
        const glm::vec4& uvs = world.vertex_maps[first + vertex].uvs;
        return glm::dmat2(map.rotate_scale) * glm::dvec2(map.second ? uvs.z : uvs.x, map.second ? uvs.w : uvs.y);
    };
    for (std::uint32_t at = primitive.first_index; at < primitive.first_index + primitive.index_count; at += 3) {
        glm::dvec2 uv[3];
        const Vertex* corner[3];
        for (std::uint32_t k = 0; k < 3; ++k) {
            uv[k] = uv_of(world.indices[at + k]);
            corner[k] = &world.vertices[first + world.indices[at + k]];
        }
        const glm::dvec4 tangent = tangent_of(corner, uv);
        const int mirrored = int(tangent.w);
        if (mirrored == 0)
            continue;
        glm::dvec3 places[3];
        for (int k = 0; k < 3; ++k)
            places[k] = corner[k]->position;
        for (std::uint32_t k = 0; k < 3; ++k) {
            std::uint32_t vertex = world.indices[at + k];
            if (sense[vertex] == -mirrored) {
                if (other[vertex] == 0xffffffff) {
                    if (world.vertices.size() >= build.file.limits.vertices)
                        build.fail(place,
                            "brings the world above " + std::to_string(build.file.limits.vertices) + " vertices; use fewer");
                    other[vertex] = std::uint32_t(sum.size());
                    world.vertices.push_back(Vertex(world.vertices[first + vertex]));
                    world.vertex_maps.push_back(VertexMaps(world.vertex_maps[first + vertex]));
                    source.push_back(std::uint32_t(source[vertex]));
                    sum.emplace_back(0), sense.push_back(mirrored), other.push_back(0xffffffff);
                }
                vertex = world.indices[at + k] = other[vertex];
            }
            sense[vertex] = mirrored;
            const glm::dvec3 n(world.vertices[first + vertex].normal);
            const glm::dvec3 along = glm::dvec3(tangent) - n * glm::dot(n, glm::dvec3(tangent));
            const glm::dvec3 a = places[(k + 1) % 3] - places[k], b = places[(k + 2) % 3] - places[k];
            const double angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)), length = glm::length(along);
            if (length > 0 && std::isfinite(length))
                sum[vertex] += angle / length * along;
        }
    }
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const glm::dvec3 n(world.vertices[first + i].normal);
        // A map without area has no direction of its own: any one along the surface is right.
        glm::dvec3 along = glm::length(sum[i]) > 0
            ? sum[i]
            : glm::cross(n, std::abs(n.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0));
        world.vertex_maps[first + i].tangent = glm::vec4(glm::normalize(along), sense[i] < 0 ? -1 : 1);
    }
}

} // namespace

void add_vertex_maps(WorldBuild& build, const std::string& place, const tinygltf::Primitive& primitive,
    const StillPose& pose, std::vector<std::uint32_t>& source)
{
    World& world = build.world;
    const Primitive made = world.primitives.back();
    const Material& material = world.materials[std::size_t(made.material)];
    const std::size_t first = std::size_t(made.vertex_offset);
    world.vertex_maps.resize(world.vertices.size());
    const std::array<int, 2>& sets = build.map_sets[std::size_t(made.material)];
    for (int k = 0; k < 2; ++k) {
        if (sets[std::size_t(k)] < 0)
            continue;
        const auto found = primitive.attributes.find("TEXCOORD_" + std::to_string(sets[std::size_t(k)]));
        const bool there = found != primitive.attributes.end();
        const Elements from = there ? open(build, found->second) : Elements{};
        if (!there)
            note_once(world.notes, "maps without texture coordinates: their surfaces take one texel");
        for (std::size_t i = 0; i < source.size(); ++i) {
            const glm::vec2 uv = uv_at(build, from, there, source[i], place);
            glm::vec4& uvs = world.vertex_maps[first + i].uvs;
            uvs[2 * k] = uv.x, uvs[2 * k + 1] = uv.y;
        }
    }
    if (!material.gloss || material.gloss->normal.texture < 0)
        return;
    // Tangents beside computed normals would not fit them (glTF 2.0, section 3.7.2.1).
    if (primitive.attributes.contains("TANGENT") && primitive.attributes.contains("NORMAL"))
        read_tangents(build, place, primitive, pose, source, first);
    else
        compute_tangents(build, place, material.gloss->normal, source);
}

} // namespace starbow
