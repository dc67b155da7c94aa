// Large surfaces in pieces: any choice of fine and coarse ones makes up the whole surface, without holes and seams.
#include "runtime/plan/cull.h"
#include "runtime/world/detail.h"
#include "runtime/world/pieces.h"
#include <gtest/gtest.h>
#include <set>
#include <unordered_map>

namespace starbow::pieces_test {
namespace {

using glm::dvec3;

/// A closed bumpy ball of radius 1 with more triangles than an undivided surface has.
World ball(int rows = 320)
{
    World world;
    Material material;
    material.double_sided = true; // so that no triangle is left out for its back
    world.materials = {material};
    const int columns = 2 * rows;
    for (int i = 0; i <= rows; ++i)
        for (int k = 0; k < columns; ++k) {
            const double v = 3.14159265358979 * i / rows, u = 2 * 3.14159265358979 * k / columns;
            const double r = 1 + 0.05 * std::sin(9 * u) * std::sin(7 * v) * std::sin(v)
                + 0.004 * std::sin(91 * u) * std::pow(std::sin(v), 3);
            world.vertices.push_back(
                {glm::vec3(r * std::sin(v) * std::cos(u), r * std::cos(v), r * std::sin(v) * std::sin(u)),
                    glm::vec3(std::sin(v) * std::cos(u), std::cos(v), std::sin(v) * std::sin(u)), {0, 0}, 0xffffffff});
        }
    const auto at = [&](int i, int k) { // each pole is one vertex
        return std::uint32_t(i == 0 ? 0 : i == rows ? rows * columns : i * columns + k % columns);
    };
    for (int i = 0; i < rows; ++i)
        for (int k = 0; k < columns; ++k)
            for (const auto& triangle :
                {std::array{at(i, k), at(i, k + 1), at(i + 1, k)}, std::array{at(i + 1, k), at(i, k + 1), at(i + 1, k + 1)}})
                if (std::set(triangle.begin(), triangle.end()).size() == 3)
                    world.indices.insert(world.indices.end(), triangle.begin(), triangle.end());
    world.primitives.push_back({.first_index = 0,
        .index_count = std::uint32_t(world.indices.size()),
        .vertex_offset = 0,
        .material = 0,
        .low = dvec3(-1.06),
        .high = dvec3(1.06),
        .centre = dvec3(0),
        .radius = 1.06,
        .coarser = {}});
    world.instances.push_back({glm::dmat4(1), 0});
    world.nodes.push_back({"ball", -1});
    return world;
}

const World& divided()
{
    static const World world = [] {
        World made = ball();
        add_detail_levels(made);
        return made;
    }();
    return world;
}

/// The pieces that an eye needs at an error of `most` times the distance: chosen here by the rule's own words.
std::vector<const DetailPiece*> chosen(const World& world, const dvec3& eye, double most)
{
    const auto fine = [&](const PieceGroup& group) {
        return group.error <= most * glm::distance(eye, glm::clamp(eye, group.low, group.high));
    };
    std::vector<const DetailPiece*> all;
    for (const DetailPiece& piece : world.pieces)
        if (fine(piece.own) && !fine(piece.coarser))
            all.push_back(&piece);
    return all;
}

TEST(Pieces, AnyChoiceIsClosed)
{
    const World& world = divided();
    ASSERT_GT(world.primitives[0].index_count / 3, most_triangles_of_a_surface);
    ASSERT_EQ(world.primitives[0].pieces.count, world.pieces.size());
    EXPECT_TRUE(world.primitives[0].coarser.empty());
    std::size_t least = world.indices.size();
    std::set<std::size_t> mixed;
    for (const dvec3& eye : {dvec3(0, 0, 1.2), dvec3(3, 1, 0), dvec3(0, -20, 0), dvec3(0)})
        for (const double most : {0.0, 1e-4, 1e-3, 4e-3, 0.02, 0.3}) {
            // Each edge of a closed surface is that of two triangles, which run along it in opposite directions.
            std::unordered_map<std::uint64_t, int> edges;
            const auto edge = [](std::uint32_t from, std::uint32_t to) { return std::uint64_t(from) << 32 | to; };
            std::size_t triangles = 0;
            std::set<double> errors;
            for (const DetailPiece* piece : chosen(world, eye, most)) {
                errors.insert(piece->own.error);
                const std::uint32_t first = piece->triangles.first_index;
                for (std::uint32_t i = first; i < first + piece->triangles.index_count; i += 3, ++triangles)
                    for (std::uint32_t k = 0; k < 3; ++k)
                        ++edges[edge(world.indices[i + k], world.indices[i + (k + 1) % 3])];
            }
            mixed.insert(errors.size());
            least = std::min(least, triangles);
            long open = 0;
            for (const auto& [one, count] : edges) {
                const auto other = edges.find(edge(std::uint32_t(one), std::uint32_t(one >> 32)));
                open += other == edges.end() || other->second != count;
            }
            EXPECT_EQ(open, 0) << "eye " << eye.x << ' ' << eye.y << ' ' << eye.z << ", error " << most << ", " << triangles
                               << " triangles of " << errors.size() << " groups";
            if (most == 0) {
                EXPECT_EQ(triangles, world.primitives[0].index_count / 3);
            }
        }
    EXPECT_LT(least, 2000u) << "from afar few are left";
    EXPECT_GT(*mixed.rbegin(), 20u) << "some choices mix many levels";
}

TEST(Pieces, StayWithinTheirError)
{
    // The ball is a graph over directions: a coarse vertex is one of the full surface, and a triangle's middle is as high
    // over its direction as the surface is, to the error.
    const World& world = divided();
    for (std::size_t n = 0; n < world.pieces.size(); n += 7) {
        const DetailPiece& piece = world.pieces[n];
        for (std::uint32_t i = 0; i < piece.triangles.index_count; i += 3 * 50) {
            const std::uint32_t* corner = &world.indices[piece.triangles.first_index + i];
            const dvec3 middle = (dvec3(world.vertices[corner[0]].position) + dvec3(world.vertices[corner[1]].position)
                                     + dvec3(world.vertices[corner[2]].position))
                / 3.0;
            // The full surface's own triangles are up to 4.2e-4 off.
            const dvec3 way = glm::normalize(middle);
            const double v = std::acos(way.y), u = std::atan2(way.z, way.x);
            const double r = 1 + 0.05 * std::sin(9 * u) * std::sin(7 * v) * std::sin(v)
                + 0.004 * std::sin(91 * u) * std::pow(std::sin(v), 3);
            EXPECT_LT(std::abs(glm::length(middle) - r), 2 * piece.own.error + 5e-4) << n;
        }
    }
}

TEST(Pieces, AnImageDrawsThemByTheirDistance)
{
    World world = divided();
    // The whole ball in one image, from near and from far.
    std::size_t before = 0;
    for (const double distance : {1.25, 4.0, 30.0, 400.0}) {
        const double side = 1;
        const int texels = 400;
        const std::vector<PlannedImage> images
            = {{0, 0, {-side, -side}, {side, side}, {texels, texels}, {0, 0}, texels / (2 * side), 1}};
        const dvec3 ahead = face_direction(0, {0, 0});
        const EyeEvent eye{0, -distance * ahead, 0};
        const DrawList list = cull(world, {{eye}}, images, {.lod_error_texels = 1, .lod_shading_texels = 1000});
        std::size_t triangles = 0;
        for (const Draw& draw : list.draws) {
            triangles += draw.index_count / 3;
            EXPECT_EQ(draw.count, 1u);
        }
        if (before > 0 && distance > 2) {
            EXPECT_LT(triangles, before);
        }
        before = triangles;
        EXPECT_GT(triangles, 8u);
        // With no error allowed, it is the surface itself, or its near part.
        const DrawList full = cull(world, {{eye}}, images, {.lod_error_texels = 0, .lod_shading_texels = 0});
        std::size_t all = 0;
        for (const Draw& draw : full.draws)
            all += draw.index_count / 3;
        if (distance > 2) {
            EXPECT_EQ(all, world.primitives[0].index_count / 3);
        } else {
            EXPECT_LT(all, world.primitives[0].index_count / 3);
        }
    }
    EXPECT_LT(before, 1000u) << "400 texels from afar";
}

} // namespace
} // namespace starbow::pieces_test
