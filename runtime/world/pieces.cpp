#include "pieces.h"
#include "parallel.h"
#include "simplifier.h"
#include <algorithm>
#include <array>
#include <limits>

namespace starbow {
namespace {

constexpr std::size_t piece_triangles = 6'000; ///< at most
constexpr std::size_t group_pieces = 4; ///< at most, that are made into half as many

using Triangle = std::array<std::uint32_t, 3>;

/// A thing with its place along the axis of a division.
template <class Thing> struct Sorted {
    float at = 0;
    Thing thing;
};

/// Divides things along the longest side of the box of their places again and again, until at most `most` are together.
/// part: of the things on one side. Calls done(things) for each part.
template <class Thing, class PlaceOf, class Done>
void divide(std::span<Sorted<Thing>> things, std::size_t most, double part, const PlaceOf& place_of, const Done& done)
{
    if (things.size() <= most) {
        done(things);
        return;
    }
    glm::vec3 low(1e38f), high(-1e38f);
    for (const auto& each : things) {
        const glm::vec3 place = place_of(each.thing);
        low = glm::min(low, place), high = glm::max(high, place);
    }
    const glm::vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    for (auto& each : things)
        each.at = place_of(each.thing)[axis];
    const std::size_t middle = std::clamp<std::size_t>(std::size_t(double(things.size()) * part), 1, things.size() - 1);
    std::nth_element(things.begin(), things.begin() + std::ptrdiff_t(middle), things.end(),
        [](const auto& a, const auto& b) { return a.at < b.at; });
    divide(things.first(middle), most, part, place_of, done);
    divide(things.subspan(middle), most, part, place_of, done);
}

/// Some triangles of a surface, and their box.
struct Part {
    std::vector<std::uint32_t> corners;
    glm::dvec3 low, high;
};

/// Divides triangles into parts of neighbours.
std::vector<Part> parts_of(
    const World& world, const Primitive& primitive, std::span<const std::uint32_t> corners, std::size_t most)
{
    const Vertex* vertices = world.vertices.data() + primitive.vertex_offset;
    std::vector<Sorted<Triangle>> triangles(corners.size() / 3);
    for (std::size_t i = 0; i < triangles.size(); ++i)
        triangles[i].thing = {corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
    const auto middle
        = [&](const Triangle& t) { return vertices[t[0]].position + vertices[t[1]].position + vertices[t[2]].position; };
    std::vector<Part> parts;
    divide(std::span(triangles), most, 0.5, middle, [&](std::span<const Sorted<Triangle>> own) {
        Part& part = parts.emplace_back();
        glm::vec3 low(1e38f), high(-1e38f);
        for (const auto& triangle : own)
            for (const std::uint32_t corner : triangle.thing) {
                part.corners.push_back(corner);
                low = glm::min(low, vertices[corner].position), high = glm::max(high, vertices[corner].position);
            }
        part.low = low, part.high = high;
    });
    return parts;
}

/// A group of pieces, and the coarser pieces that are made of it.
struct Group {
    std::vector<std::uint32_t> members; ///< indices into World::pieces
    PieceGroup made;
    std::vector<Part> parts; ///< empty: nothing could be left out
};

/// Groups neighbouring pieces. Each round has its borders elsewhere, for the borders are what no round can simplify.
std::vector<Group> groups_of(const World& world, const std::vector<std::uint32_t>& pieces, int round)
{
    std::vector<Sorted<std::uint32_t>> all;
    for (const std::uint32_t piece : pieces)
        all.push_back({0, piece});
    const auto middle = [&](std::uint32_t piece) { return glm::vec3(world.pieces[piece].low + world.pieces[piece].high); };
    constexpr std::array fractions{0.5, 0.38, 0.44};
    std::vector<Group> groups;
    divide(std::span(all), group_pieces, fractions[std::size_t(round) % fractions.size()], middle,
        [&](std::span<const Sorted<std::uint32_t>> own) {
            Group& group = groups.emplace_back();
            for (const auto& each : own)
                group.members.push_back(each.thing);
        });
    return groups;
}

/// Makes a group's coarser pieces. whole: it is the whole surface, whose border may change.
void simplify(const World& world, const Primitive& primitive, bool whole, Group& group)
{
    std::vector<std::uint32_t> corners;
    group.made.low = glm::dvec3(1e300), group.made.high = glm::dvec3(-1e300);
    for (const std::uint32_t index : group.members) {
        const DetailPiece& piece = world.pieces[index];
        const auto first = world.indices.begin() + piece.triangles.first_index;
        corners.insert(corners.end(), first, first + piece.triangles.index_count);
        group.made.low = glm::min(group.made.low, piece.own.low),
        group.made.high = glm::max(group.made.high, piece.own.high);
        group.made.error = std::max(group.made.error, piece.own.error);
        group.made.shading = std::max(group.made.shading, piece.own.shading);
        group.made.apart = std::max(group.made.apart, piece.own.apart);
    }
    Simplifier simplifier(world, primitive, corners, !whole, group.made);
    if (!simplifier.coherent() || !simplifier.halve())
        return;
    const DetailLevel& level = simplifier.level();
    group.made.error = level.error, group.made.shading = level.shading, group.made.apart = level.apart;
    group.parts = parts_of(world, primitive, simplifier.corners(), piece_triangles);
}

/// Adds a piece, whose triangles are in the world's indices from first_index on.
void add_piece(World& world, const Part& part, std::uint32_t first_index, const PieceGroup& own)
{
    constexpr double never = std::numeric_limits<double>::infinity();
    world.pieces.push_back(
        {part.low, part.high, {first_index, std::uint32_t(part.corners.size()), own.error, own.shading, own.apart}, own,
            {own.low, own.high, never, never, never}});
}

} // namespace

bool is_divided(const World& world, const Primitive& primitive)
{
    return primitive.topology == Topology::triangles && primitive.index_count / 3 > most_triangles_of_a_surface
        && primitive.deforming < 0 && !world.materials[std::size_t(primitive.material)].blended;
}

void add_pieces(World& world, Primitive& primitive, const std::function<void(double)>& progress, double from, double to)
{
    const auto first = std::uint32_t(world.pieces.size());
    std::vector<std::uint32_t> pieces;
    {
        std::uint32_t at = primitive.first_index;
        const std::span<const std::uint32_t> corners(world.indices.data() + at, primitive.index_count);
        for (const Part& part : parts_of(world, primitive, corners, piece_triangles)) {
            pieces.push_back(std::uint32_t(world.pieces.size()));
            add_piece(world, part, at, {part.low, part.high});
            std::ranges::copy(part.corners, world.indices.begin() + at);
            at += std::uint32_t(part.corners.size());
        }
    }
    double done = from;
    bool all = true; // the pieces are the whole surface
    for (int round = 0; !pieces.empty(); ++round) {
        std::vector<Group> groups = groups_of(world, pieces, round);
        const double next = 0.5 * (done + to); // each round has half the triangles of the one before
        in_parallel(
            groups.size(), [&](std::size_t i) { simplify(world, primitive, all && groups.size() == 1, groups[i]); },
            progress, done, next);
        done = next;
        std::vector<std::uint32_t> made;
        for (const Group& group : groups) {
            if (group.parts.empty()) {
                all = false;
                continue;
            }
            for (const std::uint32_t member : group.members)
                world.pieces[member].coarser = group.made;
            for (const Part& part : group.parts) {
                made.push_back(std::uint32_t(world.pieces.size()));
                add_piece(world, part, std::uint32_t(world.indices.size()), group.made);
                world.indices.insert(world.indices.end(), part.corners.begin(), part.corners.end());
            }
        }
        pieces = std::move(made);
    }
    primitive.pieces = {first, std::uint32_t(world.pieces.size()) - first};
}

} // namespace starbow
