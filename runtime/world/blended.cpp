#include "blended.h"
#include <algorithm>
#include <cmath>
#include <map>

namespace starbow {
namespace {

/// The least and the greatest of some alphas, 0 to 255.
struct Alphas {
    int least = 255, most = 0;
    void add(int alpha) { least = std::min(least, alpha), most = std::max(most, alpha); }
};

Alphas alphas_of(const Texture& texture)
{
    Alphas alphas;
    for (std::size_t i = 3; i < texture.rgba.size(); i += 4)
        alphas.add(texture.rgba[i]);
    return alphas;
}

/// Of all vertices of a material's surfaces.
Alphas vertex_alphas(const World& world, int material)
{
    Alphas alphas;
    for (const Primitive& primitive : world.primitives)
        for (std::uint32_t i = 0; i < primitive.index_count && primitive.material == material; ++i) {
            const std::uint32_t corner = world.indices[primitive.first_index + i];
            alphas.add(int(world.vertices[corner + std::size_t(primitive.vertex_offset)].colour >> 24));
        }
    return alphas;
}

/// About the number of triangles that the large ones of a blended surface are divided into, for the order of their
/// distances.
constexpr std::size_t most_pieces = 2000, pieces_per_triangle = 32;

/// Divides the large triangles of a blended surface. A large pane has its middle far from most of its places: its distance
/// would say little about whether it is before or behind a small one.
class Divider {
public:
    Divider(World& world, const Primitive& primitive, std::uint32_t first_index, std::uint32_t index_count)
        : world_(world)
        , offset_(std::size_t(primitive.vertex_offset))
    {
        double area = 0, length = 0;
        for (std::uint32_t at = first_index; at < first_index + index_count; at += 3) {
            const std::array<std::uint32_t, 3> corners{world.indices[at], world.indices[at + 1], world.indices[at + 2]};
            area += 0.5 * glm::length(glm::cross(edge(corners, 0), edge(corners, 1)));
            length += glm::length(edge(corners, longest(corners)));
        }
        // A deforming surface's vertices have rows of their own.
        if (primitive.deforming >= 0 || in_one_plane(first_index, index_count))
            return;
        const double pieces = double(std::min(pieces_per_triangle * index_count / 3, most_pieces));
        // Triangles that are halved at their longest edges until none is longer have a fifth of its square as their area.
        most_ = std::max(std::sqrt(5 * area / pieces), length / pieces);
    }

    void add(const std::array<std::uint32_t, 3>& corners)
    {
        const std::size_t k = longest(corners);
        if (glm::length(edge(corners, k)) > most_) {
            const std::uint32_t a = corners[k], b = corners[(k + 1) % 3], c = corners[(k + 2) % 3], between = middle(a, b);
            add({a, between, c});
            add({between, b, c});
            return;
        }
        world_.blended_triangles.push_back({(place(corners[0]) + place(corners[1]) + place(corners[2])) / 3.0f, corners});
    }

private:
    glm::vec3 place(std::uint32_t corner) const { return world_.vertices[corner + offset_].position; }
    glm::dvec3 edge(const std::array<std::uint32_t, 3>& corners, std::size_t k) const
    {
        return glm::dvec3(place(corners[(k + 1) % 3])) - glm::dvec3(place(corners[k]));
    }
    std::size_t longest(const std::array<std::uint32_t, 3>& corners) const
    {
        std::size_t at = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (glm::length(edge(corners, k)) > glm::length(edge(corners, at)))
                at = k;
        return at;
    }
    bool in_one_plane(std::uint32_t first_index, std::uint32_t index_count) const
    {
        const glm::dvec3 origin(place(world_.indices[first_index]));
        glm::dvec3 normal(0);
        double extent = 0;
        for (std::uint32_t at = first_index; at < first_index + index_count; at += 3) {
            const std::array<std::uint32_t, 3> corners{world_.indices[at], world_.indices[at + 1], world_.indices[at + 2]};
            const glm::dvec3 own = glm::cross(edge(corners, 0), edge(corners, 1));
            if (glm::length(own) > glm::length(normal))
                normal = own;
            extent = std::max(extent, glm::distance(origin, glm::dvec3(place(corners[0]))));
        }
        const double length = glm::length(normal);
        for (std::uint32_t at = first_index; at < first_index + index_count; ++at)
            if (std::abs(glm::dot(normal, glm::dvec3(place(world_.indices[at])) - origin)) > 1e-5 * extent * length)
                return false;
        return true;
    }
    /// The vertex in the middle of an edge, the same for both triangles beside it.
    std::uint32_t middle(std::uint32_t a, std::uint32_t b)
    {
        const auto [known, is_new]
            = middles_.try_emplace(std::minmax(a, b), std::uint32_t(world_.vertices.size() - offset_));
        if (!is_new)
            return known->second;
        const Vertex &from = world_.vertices[a + offset_], &to = world_.vertices[b + offset_];
        Vertex made{0.5f * (from.position + to.position), 0.5f * (from.normal + to.normal), 0.5f * (from.uv + to.uv), 0};
        for (int shift = 0; shift < 32; shift += 8)
            made.colour |= ((from.colour >> shift & 255) + (to.colour >> shift & 255) + 1) / 2 << shift;
        if (!world_.vertex_maps.empty()) {
            const VertexMaps &own = world_.vertex_maps[a + offset_], &other = world_.vertex_maps[b + offset_];
            const VertexMaps maps{
                {0.5f * glm::vec3(own.tangent + other.tangent), own.tangent.w}, 0.5f * (own.uvs + other.uvs)};
            world_.vertex_maps.push_back(maps);
        }
        world_.vertices.push_back(made);
        return known->second;
    }

    World& world_;
    std::size_t offset_;
    double most_ = 1e300; ///< length of an edge
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
};

} // namespace

void find_opaque_places(World& world)
{
    constexpr float opaque = 254.5f / 255;
    for (std::size_t i = 0; i < world.materials.size(); ++i) {
        Material& material = world.materials[i];
        if (!material.blended || material.base_colour.a < opaque)
            continue;
        const Alphas vertices = vertex_alphas(world, int(i));
        const Alphas texels
            = material.base_texture < 0 ? Alphas{255, 255} : alphas_of(world.textures[std::size_t(material.base_texture)]);
        if (std::min(vertices.least, texels.least) == 255)
            material.blended = false;
        else if (std::min(vertices.most, texels.most) == 255)
            material.alpha_cutoff = opaque;
    }
}

void add_blended_triangles(World& world)
{
    world.blended_triangles.clear();
    for (Primitive& primitive : world.primitives) {
        if (!world.materials[std::size_t(primitive.material)].blended)
            continue;
        const auto add = [&](std::uint32_t first_index, std::uint32_t index_count) {
            BlendedRange range{std::uint32_t(world.blended_triangles.size())};
            if (const std::uint32_t corners = corners_of(primitive.topology); corners == 3) {
                Divider divider(world, primitive, first_index, index_count);
                for (std::uint32_t at = first_index; at < first_index + index_count; at += 3)
                    divider.add({world.indices[at], world.indices[at + 1], world.indices[at + 2]});
            } else {
                for (std::uint32_t at = first_index; at < first_index + index_count; at += corners) {
                    const std::uint32_t a = world.indices[at], b = world.indices[at + corners - 1];
                    const auto place = [&](std::uint32_t corner) {
                        return world.vertices[corner + std::size_t(primitive.vertex_offset)].position;
                    };
                    world.blended_triangles.push_back({0.5f * (place(a) + place(b)), {a, b, b}});
                }
            }
            range.count = std::uint32_t(world.blended_triangles.size()) - range.first;
            return range;
        };
        primitive.blended = add(primitive.first_index, primitive.index_count);
        for (DetailLevel& level : primitive.coarser)
            level.blended = add(level.first_index, level.index_count);
    }
}

std::span<const BlendedTriangle> blended_triangles(const World& world, const Primitive& primitive, std::size_t level)
{
    const BlendedRange& range = level == 0 ? primitive.blended : primitive.coarser[level - 1].blended;
    return std::span(world.blended_triangles).subspan(range.first, range.count);
}

void note_crossing_blended(const World& world, std::vector<std::string>& notes)
{
    struct Box {
        glm::dvec3 low{1e300}, high{-1e300};
    };
    std::vector<Box> boxes; // of blended surfaces, the world's axes
    constexpr std::size_t most = 2000; // pairs of more would take seconds
    for (const Instance& instance : world.instances) {
        const Primitive& primitive = world.primitives[instance.primitive];
        if (!world.materials[std::size_t(primitive.material)].blended || boxes.size() == most)
            continue;
        Box& box = boxes.emplace_back();
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 corner(i & 1 ? primitive.high.x : primitive.low.x, i & 2 ? primitive.high.y : primitive.low.y,
                i & 4 ? primitive.high.z : primitive.low.z);
            const glm::dvec3 place = instance.frame_from_local * glm::dvec4(corner, 1);
            box.low = glm::min(box.low, place), box.high = glm::max(box.high, place);
        }
    }
    const auto meets = [&](const Box& a) {
        return std::ranges::count_if(boxes, [&](const Box& b) {
            return glm::all(glm::lessThan(a.low, b.high)) && glm::all(glm::lessThan(b.low, a.high));
        }) > 1; // more than itself
    };
    const auto crossing = std::ranges::count_if(boxes, meets);
    if (crossing > 0)
        notes.push_back(std::to_string(crossing) + " of " + std::to_string(boxes.size())
            + " blended surfaces stand in each other's boxes: where transparent parts cross, the one with the nearer middle "
              "is "
              "drawn over the other; opaque parts hide what is behind them");
}

} // namespace starbow
