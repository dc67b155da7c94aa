#include "accessor.h"
#include "parts.h"
#include <algorithm>
#include <array>

namespace starbow {
namespace {

constexpr std::uint32_t none = 0xffffffff;

/// A morph target with its weight, which is not 0.
struct Target {
    double weight = 0;
    Elements position, normal;
    bool has_position = false, has_normal = false;
};

struct Attributes {
    Elements position, normal, uv, colour;
    SkinSource skin;
    bool has_normal = false, has_uv = false, has_colour = false;
    std::vector<Target> targets;
    const StillPose& pose;
};

std::uint32_t pack_colour(const Elements& from, std::uint32_t i)
{
    std::uint32_t packed = 0;
    for (int c = 0; c < 4; ++c) {
        double value = c < from.components ? from.component(i, c) : 1;
        double unit = value > 0 ? std::min(value, 1.0) : 0; // NaN becomes 0 too
        packed |= std::uint32_t(std::lround(unit * 255)) << 8 * c;
    }
    return packed;
}

Vertex read_vertex(WorldBuild& build, const Attributes& from, std::uint32_t i, const UvSource& uv, const std::string& place)
{
    Vertex out{};
    glm::dvec3 position = element3(build, from.position, i, place + "/attributes/POSITION"), normal(0);
    if (from.has_normal)
        normal = element3(build, from.normal, i, place + "/attributes/NORMAL");
    for (const Target& target : from.targets) {
        if (target.has_position)
            position += target.weight * element3(build, target.position, i, place + "/attributes/POSITION");
        if (target.has_normal && from.has_normal)
            normal += target.weight * element3(build, target.normal, i, place + "/attributes/NORMAL");
    }
    if (!from.skin.empty()) {
        const glm::dmat4 skin = skin_at(build, from.pose, from.skin, i, place);
        position = glm::dvec3(skin * glm::dvec4(position, 1));
        // A joint scaled to nothing leaves no direction.
        const glm::dmat3 turned(skin);
        normal = glm::determinant(turned) != 0 ? glm::transpose(glm::inverse(turned)) * normal : glm::dvec3(0);
    }
    if (!(glm::length(position) < 1e18))
        build.fail(place + "/attributes/POSITION",
            "element " + std::to_string(i) + " is beyond 1e18 in its pose; should be nearer");
    out.position = position;
    if (from.has_normal) {
        const double length = glm::length(normal);
        out.normal = length > 0 && length < 1e300 ? normal / length : glm::dvec3(0, 1, 0);
    }
    if (from.has_uv) {
        glm::dvec2 at = uv.rotate_scale * glm::dvec2(from.uv.component(i, 0), from.uv.component(i, 1)) + uv.offset;
        if (!(glm::length(at) < 1e18))
            build.fail(place + "/attributes/TEXCOORD_" + std::to_string(uv.set),
                "element " + std::to_string(i) + " is not finite or above 1e18; should be smaller");
        out.uv = at;
    }
    out.colour = from.has_colour ? pack_colour(from.colour, i) : 0xffffffff;
    return out;
}

/// The positions of triangle `t`'s corners in the list of indices (glTF 2.0, section 3.7.2.1).
std::array<std::size_t, 3> corners(int mode, std::size_t t)
{
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
        return t % 2 == 0 ? std::array{t, t + 1, t + 2} : std::array{t, t + 2, t + 1};
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
        return {t + 1, t + 2, std::size_t(0)};
    return {3 * t, 3 * t + 1, 3 * t + 2};
}

Topology topology_of(int mode)
{
    return mode == TINYGLTF_MODE_POINTS  ? Topology::points
        : mode < TINYGLTF_MODE_TRIANGLES ? Topology::lines
                                         : Topology::triangles;
}

/// The number of points, lines or triangles that a list of so many vertices makes.
std::size_t count_of_parts(int mode, std::size_t run)
{
    switch (mode) {
    case TINYGLTF_MODE_POINTS:
    case TINYGLTF_MODE_LINE_LOOP:
        return run;
    case TINYGLTF_MODE_LINE:
        return run / 2;
    case TINYGLTF_MODE_LINE_STRIP:
        return run - 1;
    case TINYGLTF_MODE_TRIANGLES:
        return run / 3;
    default:
        return run - 2;
    }
}

/// The positions of line `i`'s ends in the list of indices (glTF 2.0, section 3.7.2.1).
std::array<std::size_t, 2> ends(int mode, std::size_t i, std::size_t lines)
{
    if (mode == TINYGLTF_MODE_LINE)
        return {2 * i, 2 * i + 1};
    return {i, mode == TINYGLTF_MODE_LINE_LOOP && i + 1 == lines ? 0 : i + 1};
}

glm::vec3 flat_normal(const Vertex& a, const Vertex& b, const Vertex& c)
{
    glm::dvec3 across
        = glm::cross(glm::dvec3(b.position) - glm::dvec3(a.position), glm::dvec3(c.position) - glm::dvec3(a.position));
    double length = glm::length(across);
    return length > 0 ? glm::vec3(across / length) : glm::vec3(0, 1, 0);
}

void set_bounds(const World& world, Primitive& primitive)
{
    auto begin = world.vertices.begin() + primitive.vertex_offset;
    glm::dvec3 low(begin->position), high(begin->position);
    for (auto v = begin; v != world.vertices.end(); ++v) {
        low = glm::min(low, glm::dvec3(v->position));
        high = glm::max(high, glm::dvec3(v->position));
    }
    primitive.low = low, primitive.high = high;
    primitive.centre = (low + high) / 2.0;
    primitive.radius = 0;
    for (auto v = begin; v != world.vertices.end(); ++v)
        primitive.radius = std::max(primitive.radius, glm::distance(primitive.centre, glm::dvec3(v->position)));
}

Attributes open_attributes(
    WorldBuild& build, const tinygltf::Primitive& primitive, const UvSource& uv, bool textured, const StillPose& pose)
{
    Attributes out{.pose = pose};
    auto read_attribute = [&](const std::string& name, Elements& into) {
        auto found = primitive.attributes.find(name);
        if (found == primitive.attributes.end())
            return false;
        into = open(build, found->second);
        return true;
    };
    read_attribute("POSITION", out.position);
    out.has_normal = read_attribute("NORMAL", out.normal);
    out.has_uv = read_attribute("TEXCOORD_" + std::to_string(uv.set), out.uv);
    out.has_colour = read_attribute("COLOR_0", out.colour);
    out.skin = open_skin(build, primitive, pose);
    for (std::size_t i = 0; i < primitive.targets.size() && i < pose.weights.size(); ++i) {
        if (pose.weights[i] == 0)
            continue;
        Target& target = out.targets.emplace_back();
        target.weight = pose.weights[i];
        for (const auto& [name, accessor] : primitive.targets[i]) {
            const bool position = name == "POSITION";
            (position ? target.position : target.normal) = open(build, accessor);
            (position ? target.has_position : target.has_normal) = true;
        }
    }
    if (textured && !out.has_uv)
        note_once(build.world.notes, "textured surfaces without texture coordinates: they take one texel's colour");
    return out;
}

/// Grows by doubling, but never beyond the limit: the last doubling would take more than all that is allowed.
template <typename T> void grow(std::vector<T>& to, std::size_t more, std::size_t limit)
{
    if (to.capacity() < to.size() + more)
        to.reserve(std::max(to.size() + more, std::min(2 * to.capacity(), limit)));
}

void make_room(WorldBuild& build, const std::string& place, std::size_t vertices, std::size_t indices)
{
    if (build.world.vertices.size() + vertices > build.file.limits.vertices)
        build.fail(place, "brings the world above " + std::to_string(build.file.limits.vertices) + " vertices; use fewer");
    if (build.world.indices.size() + indices > build.file.limits.indices)
        build.fail(
            place, "brings the world above " + std::to_string(build.file.limits.indices / 3) + " triangles; use fewer");
    grow(build.world.vertices, vertices, build.file.limits.vertices);
    grow(build.world.indices, indices, build.file.limits.indices);
}

/// A glTF primitive under construction.
struct Source {
    const tinygltf::Primitive& primitive;
    const std::string& place; ///< for messages
    const UvSource& uv;
    Attributes attributes;
    Elements indices; ///< unset for a primitive without indices
    std::size_t parts = 0; ///< triangles, lines or points
    std::uint32_t vertex_offset = 0; ///< of its first vertex in the world
    bool mapped = false; ///< its material needs VertexMaps
    bool deforms = false;
    /// The file's vertices in the order in which the world has them: of smooth triangles, with an entry in build.placed; of
    /// flat ones only where VertexMaps are needed, or where they deform.
    std::vector<std::uint32_t> vertices;
};

/// Opens a primitive's attributes and indices, and makes room for its triangles.
Source open_source(
    WorldBuild& build, const std::string& place, const tinygltf::Primitive& from, int material, const StillPose& pose)
{
    const Material& look = build.world.materials[std::size_t(material)];
    const UvSource& uv = build.uv[std::size_t(material)];
    const Topology topology = topology_of(from.mode);
    Source source{
        from, place, uv, open_attributes(build, from, uv, look.base_texture >= 0 || look.emissive_texture >= 0, pose)};
    const Attributes& attributes = source.attributes;
    if (look.clock && !attributes.has_uv)
        build.fail(place + "/attributes",
            "has no TEXCOORD_" + std::to_string(uv.set)
                + " for a clock's dial; should have one that goes from 0 to 1 across it");
    if (from.indices >= 0)
        source.indices = open(build, from.indices);
    const std::size_t run = from.indices >= 0 ? source.indices.count : attributes.position.count;
    source.parts = count_of_parts(from.mode, run);
    const std::size_t corners = corners_of(topology) * source.parts;
    if (corners > build.corners_left)
        build.fail(
            place, "brings the world above " + std::to_string(build.file.limits.indices / 3) + " triangles; use fewer");
    build.corners_left -= corners;
    // Flat triangles never share corners.
    make_room(build, place, attributes.has_normal || topology != Topology::triangles ? 0 : corners, corners);
    // In exported files many primitives may share one long list of vertices; only those that this primitive uses are
    // copied.
    if (build.placed.size() < attributes.position.count)
        build.placed.resize(attributes.position.count, none);
    source.vertex_offset = std::uint32_t(build.world.vertices.size());
    source.mapped = look.mapped(), source.deforms = pose.deforms;
    return source;
}

/// The vertex at a position of the list of indices. Throws for one beyond the vertices.
std::uint32_t read_index(const WorldBuild& build, const Source& source, std::size_t at)
{
    const std::uint32_t vertex = source.primitive.indices >= 0 ? source.indices.index(at) : std::uint32_t(at);
    if (const std::size_t vertices = source.attributes.position.count; vertex >= vertices)
        build.fail(source.place + "/indices",
            "index " + std::to_string(at) + " is " + std::to_string(vertex) + "; the vertices are 0 to "
                + std::to_string(vertices - 1));
    return vertex;
}

std::array<std::uint32_t, 3> read_triangle(const WorldBuild& build, const Source& source, std::size_t t)
{
    std::array<std::uint32_t, 3> corner;
    const auto which = corners(source.primitive.mode, t);
    for (std::size_t i = 0; i < 3; ++i)
        corner[i] = read_index(build, source, which[i]);
    return corner;
}

/// Adds a triangle with the file's normals, a line or a point. It shares its vertices with those before it.
void add_shared(WorldBuild& build, Source& source, std::span<const std::uint32_t> corner)
{
    World& world = build.world;
    for (std::uint32_t vertex : corner) {
        std::uint32_t& placed = build.placed[vertex];
        if (placed == none) {
            make_room(build, source.place, 1, 0);
            placed = std::uint32_t(world.vertices.size()) - source.vertex_offset;
            source.vertices.push_back(vertex);
            world.vertices.push_back(read_vertex(build, source.attributes, vertex, source.uv, source.place));
        }
        world.indices.push_back(placed);
    }
}

/// Adds a triangle with vertices and a normal of its own.
void add_flat(WorldBuild& build, Source& source, const std::array<std::uint32_t, 3>& corner)
{
    World& world = build.world;
    for (std::uint32_t vertex : corner) {
        world.indices.push_back(std::uint32_t(world.vertices.size()) - source.vertex_offset);
        if (source.mapped || source.deforms)
            source.vertices.push_back(vertex);
        world.vertices.push_back(read_vertex(build, source.attributes, vertex, source.uv, source.place));
    }
    const auto end = world.vertices.end();
    end[-3].normal = end[-2].normal = end[-1].normal = flat_normal(end[-3], end[-2], end[-1]);
}

} // namespace

glm::dvec3 element3(WorldBuild& build, const Elements& from, std::uint32_t i, const std::string& place)
{
    glm::dvec3 value(from.component(i, 0), from.component(i, 1), from.component(i, 2));
    // Beyond 1e18 a squared length does not fit a float; no visible thing is so far away.
    if (!(glm::length(value) < 1e18))
        build.fail(place, "element " + std::to_string(i) + " is not finite or above 1e18; should be smaller");
    return value;
}

Elements open(WorldBuild& build, int accessor)
{
    Elements out;
    const char* problem = nullptr;
    if (!open_accessor(build.model, accessor, build.sparse_bytes_left, out, problem))
        build.fail("/accessors/" + std::to_string(accessor), problem);
    return out;
}

bool add_primitive(WorldBuild& build, const std::string& place, const tinygltf::Primitive& from, const StillPose& pose)
{
    World& world = build.world;
    if (!from.attributes.contains("POSITION")) {
        note_once(world.notes, "meshes without positions are not drawn");
        return false;
    }
    const Topology topology = topology_of(from.mode);
    const int material = topology == Topology::triangles
        ? material_of(build, from.material)
        : stroke_material_of(build, from.material, from.attributes.contains("NORMAL"));
    Source source = open_source(build, place, from, material, pose);
    Primitive made{};
    made.first_index = std::uint32_t(world.indices.size());
    made.vertex_offset = std::int32_t(source.vertex_offset);
    made.material = material;
    made.topology = topology;
    for (std::size_t i = 0; i < source.parts && topology == Topology::points; ++i)
        add_shared(build, source, std::array{read_index(build, source, i)});
    for (std::size_t i = 0; i < source.parts && topology == Topology::lines; ++i) {
        const auto [begin, end] = ends(from.mode, i, source.parts);
        add_shared(build, source, std::array{read_index(build, source, begin), read_index(build, source, end)});
    }
    for (std::size_t t = 0; t < source.parts && topology == Topology::triangles; ++t) {
        const std::array<std::uint32_t, 3> corner = read_triangle(build, source, t);
        if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0])
            continue; // strips use such triangles to turn; they cover no area
        if (source.attributes.has_normal)
            add_shared(build, source, corner);
        else
            add_flat(build, source, corner);
    }
    for (std::uint32_t vertex : source.vertices)
        build.placed[vertex] = none;
    made.index_count = std::uint32_t(world.indices.size()) - made.first_index;
    if (made.index_count == 0)
        return false;
    set_bounds(world, made);
    world.primitives.push_back(made);
    if (source.mapped)
        add_vertex_maps(build, place, from, pose, source.vertices);
    if (pose.deforms)
        add_deforming(build, place, from, pose, source.vertices);
    return true;
}

std::uint32_t turned_primitive(WorldBuild& build, std::uint32_t primitive)
{
    if (build.world.primitives[primitive].topology != Topology::triangles)
        return primitive; // no side of it is its back
    auto [known, is_new] = build.turned.try_emplace(primitive, std::uint32_t(build.world.primitives.size()));
    if (!is_new)
        return known->second;
    World& world = build.world;
    Primitive turned = world.primitives[primitive];
    make_room(build, "/meshes", 0, turned.index_count);
    std::uint32_t from = turned.first_index;
    turned.first_index = std::uint32_t(world.indices.size());
    for (std::uint32_t i = 0; i < turned.index_count; i += 3)
        for (std::uint32_t corner : {0u, 2u, 1u}) {
            std::uint32_t index = world.indices[from + i + corner];
            world.indices.push_back(index);
        }
    world.primitives.push_back(turned);
    return known->second;
}

} // namespace starbow
