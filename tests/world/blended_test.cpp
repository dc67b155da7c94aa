// What of a blended surface is opaque, and its triangles, which are divided where they are large.
#include "runtime/world/blended.h"
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace starbow::blended_test {
namespace {

std::uint32_t white_of(int alpha) { return 0xffffff | std::uint32_t(alpha) << 24; }

/// A world of one blended triangle, with a texture of two texels unless the alphas are none.
World triangle(float factor, int vertex_alpha, std::vector<int> texel_alphas)
{
    World world;
    Material material;
    material.blended = true, material.base_colour.a = factor;
    if (!texel_alphas.empty()) {
        material.base_texture = 0;
        Texture texture;
        texture.size = {int(texel_alphas.size()), 1};
        for (const int alpha : texel_alphas)
            texture.rgba.insert(texture.rgba.end(), {9, 9, 9, std::uint8_t(alpha)});
        world.textures.push_back(texture);
    }
    world.materials = {material};
    for (int i = 0; i < 3; ++i)
        world.vertices.push_back(
            {{float(i == 1), float(i == 2), 0}, {0, 0, 1}, {0, 0}, white_of(i == 2 ? vertex_alpha : 255)});
    world.indices = {0, 1, 2};
    Primitive primitive{};
    primitive.index_count = 3;
    world.primitives = {primitive};
    find_opaque_places(world);
    return world;
}

TEST(BlendedSurface, WithoutATransparentPlaceItIsNotBlended)
{
    for (const World& world : {triangle(1, 255, {}), triangle(1, 255, {255, 255})})
        EXPECT_TRUE(!world.materials[0].blended && world.materials[0].alpha_cutoff == 0);
}

TEST(BlendedSurface, OpaquePlacesAreFound)
{
    for (const World& world : {triangle(1, 100, {}), triangle(1, 255, {0, 255}), triangle(1, 100, {255, 255})})
        EXPECT_TRUE(world.materials[0].blended && world.materials[0].alpha_cutoff > 0.99f);
    for (const World& world : {triangle(0.5f, 255, {}), triangle(1, 255, {0, 254}), triangle(0.5f, 255, {0, 255})})
        EXPECT_TRUE(world.materials[0].blended && world.materials[0].alpha_cutoff == 0);
}

/// A surface of triangles of very different sizes around one edge, with all attributes linear in the place.
World fan(bool maps)
{
    World world;
    world.materials.emplace_back().blended = true;
    const auto add = [&](glm::vec3 at) {
        const glm::vec2 uv(0.1f * at.x + 0.2f * at.y, 0.3f * at.z - 0.1f * at.x);
        world.vertices.push_back({at, {0, 0, 1}, uv, white_of(128)});
        if (maps)
            world.vertex_maps.push_back({{1, 0, 0, -1}, {uv, 2.0f * uv}});
    };
    add({7, 7, 7}); // belongs to another surface
    for (const glm::vec3 at : {glm::vec3(0, 0, 0), {0, 10, 0}, {90, 3, 1}, {0.5f, 4, 0.5f}, {-1, 5, -3}})
        add(at);
    world.indices = {0, 1, 2, 1, 0, 3, 0, 1, 4};
    Primitive primitive{};
    primitive.index_count = 9, primitive.vertex_offset = 1;
    world.primitives = {primitive};
    return world;
}

TEST(BlendedSurface, LargeTrianglesAreDividedWithoutChangingTheSurface)
{
    for (const bool maps : {false, true}) {
        World world = fan(maps);
        const auto place = [&](std::uint32_t corner) { return glm::dvec3(world.vertices[corner + 1].position); };
        const auto area = [&](const std::array<std::uint32_t, 3>& c) {
            return 0.5 * glm::cross(place(c[1]) - place(c[0]), place(c[2]) - place(c[0]));
        };
        glm::dvec3 whole(0), divided(0);
        double area_before = 0, area_after = 0, longest = 0;
        for (std::uint32_t i = 0; i < 9; i += 3) {
            const glm::dvec3 own = area({world.indices[i], world.indices[i + 1], world.indices[i + 2]});
            whole += own, area_before += glm::length(own);
        }
        const std::size_t before = world.vertices.size();
        add_blended_triangles(world);
        const auto triangles = blended_triangles(world, world.primitives[0], 0);
        EXPECT_GT(triangles.size(), 12u);
        EXPECT_LT(triangles.size(), 400u);
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
        for (const BlendedTriangle& triangle : triangles) {
            divided += area(triangle.corners), area_after += glm::length(area(triangle.corners));
            glm::dvec3 middle(0);
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = triangle.corners[k], b = triangle.corners[(k + 1) % 3];
                ++edges[std::minmax(a, b)];
                longest = std::max(longest, glm::distance(place(a), place(b)));
                middle += place(a) / 3.0;
            }
            EXPECT_LT(glm::distance(middle, glm::dvec3(triangle.middle)), 1e-5);
        }
        EXPECT_LT(glm::distance(whole, divided), 1e-4) << "they turn the same way";
        EXPECT_NEAR(area_before, area_after, 1e-3) << "and do not overlap";
        EXPECT_LT(longest, 20);
        // The edge from 0 to 1 belongs to three triangles, all of which are divided at the same places.
        for (const auto& [edge, count] : edges) {
            const glm::dvec3 a = place(edge.first), b = place(edge.second);
            const bool on_the_edge = a.x == 0 && b.x == 0 && a.z == 0 && b.z == 0;
            EXPECT_TRUE(!on_the_edge || count == 3) << count;
        }
        ASSERT_EQ(world.vertex_maps.size(), maps ? world.vertices.size() : 0u);
        for (std::size_t i = before; i < world.vertices.size(); ++i) {
            const Vertex& made = world.vertices[i];
            const glm::vec3 at = made.position;
            EXPECT_NEAR(made.uv.x, 0.1f * at.x + 0.2f * at.y, 1e-5);
            EXPECT_NEAR(made.uv.y, 0.3f * at.z - 0.1f * at.x, 1e-5);
            EXPECT_EQ(made.colour, white_of(128));
            if (maps) {
                EXPECT_NEAR(world.vertex_maps[i].uvs.z, 2 * made.uv.x, 1e-5);
                EXPECT_EQ(world.vertex_maps[i].tangent.w, -1);
            }
        }
    }
}

TEST(BlendedSurface, AFlatSurfaceStaysAsItIs)
{
    World world = fan(false);
    for (Vertex& vertex : world.vertices)
        vertex.position.z = 0;
    add_blended_triangles(world);
    EXPECT_EQ(blended_triangles(world, world.primitives[0], 0).size(), 3u) << "no part of it is before another";
}

TEST(BlendedSurface, SurfacesInEachOthersBoxesAreCounted)
{
    World world = fan(false);
    world.primitives[0].low = {-1, 0, -3}, world.primitives[0].high = {90, 10, 1};
    std::vector<std::string> notes;
    const auto place = [&](double x) {
        glm::dmat4 at(1);
        at[3].x = x;
        world.instances.push_back({at, 0});
        notes.clear();
        note_crossing_blended(world, notes);
    };
    place(0);
    place(91.5);
    EXPECT_TRUE(notes.empty());
    place(50);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_TRUE(notes[0].starts_with("3 of 3 blended surfaces")) << notes[0];
}

} // namespace
} // namespace starbow::blended_test
