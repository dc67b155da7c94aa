// Culling and levels of detail: nothing that a pixel could see is left out, and coarser surfaces stay close to the full one.
#include "config/model/angles.h"
#include "runtime/plan/cull.h"
#include "runtime/plan/painters_order.h"
#include "runtime/world/blended.h"
#include "runtime/world/detail.h"
#include "runtime/world/eye_event.h"
#include "runtime/world/instances.h"
#include "tests/support/boxes.h"
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>
#include <random>
#include <set>

namespace cull_test {

using namespace starbow;
using starbow::testing::boxes;

namespace {

bool ray_hits(const Instance& instance, const Primitive& primitive, const glm::dvec3& eye, const glm::dvec3& way)
{
    glm::dmat4 local = glm::inverse(instance.frame_from_local);
    glm::dvec3 from = local * glm::dvec4(eye, 1), along = local * glm::dvec4(way, 0);
    double first = 0, last = 1e300;
    for (int i = 0; i < 3; ++i) {
        double a = (primitive.low[i] - from[i]) / along[i], b = (primitive.high[i] - from[i]) / along[i];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first < last;
}

} // namespace

TEST(Cull, KeepsEveryInstanceThatAnImagesDirectionHits)
{
    World world = boxes(60, 5);
    glm::dvec3 eye(0.3, -0.2, 0.5);
    glm::dmat3 turn = glm::mat3_cast(glm::normalize(glm::dquat(0.3, -0.5, 0.2, 0.9)));
    std::vector<PlannedImage> images;
    for (int face = 0; face < 6; ++face)
        images.push_back({0, face, {-0.6, -0.3}, {0.5, 1}, {64, 64}, {0, 0}, 64, 1});
    images.push_back({TILE_REAR, 1, {-1, -1}, {1, 1}, {64, 64}, {0, 0}, 32, 1, 0.6});
    DrawList list = cull(world, {{EyeEvent{0, eye, 0, turn}}}, images);
    ASSERT_EQ(list.instances.size(), world.instances.size());
    std::mt19937 random(2);
    std::uniform_real_distribution<double> part(0, 1);
    long hits = 0, drawn = 0;
    for (std::uint32_t i = 0; i < images.size(); ++i) {
        std::vector<bool> kept(world.instances.size());
        for (const Draw& draw : list.draws)
            if (draw.image == i)
                for (std::uint32_t k = 0; k < draw.count; ++k)
                    kept[list.visible[draw.first + k]] = true, ++drawn;
        for (int ray = 0; ray < 2000; ++ray) {
            glm::dvec2 at = images[i].low + glm::dvec2(part(random), part(random)) * (images[i].high - images[i].low);
            if (std::max(std::abs(at.x), std::abs(at.y)) < images[i].clip_hole)
                continue;
            glm::dvec3 way = glm::transpose(turn) * face_direction(images[i].face, at);
            for (std::size_t k = 0; k < world.instances.size(); ++k)
                if (ray_hits(world.instances[k], world.primitives[0], eye, way)) {
                    ++hits;
                    ASSERT_TRUE(kept[k]) << "image " << i << " instance " << k;
                }
        }
    }
    EXPECT_GT(hits, 1000);
    EXPECT_LT(drawn, long(images.size() * world.instances.size() * 2 / 3)) << "hardly anything was culled";
}

TEST(Cull, CapsHoldTheirBoxes)
{
    const World world = boxes(60, 5);
    const glm::dvec3 eye(0.3, -0.2, 0.5);
    const glm::dmat3 turn = glm::mat3_cast(glm::normalize(glm::dquat(0.3, -0.5, 0.2, 0.9)));
    std::vector<BoundingCap> caps;
    find_caps(cull(world, {{EyeEvent{0, eye, 0, turn}}}, {}), 0, caps);
    ASSERT_EQ(caps.size(), world.instances.size());
    std::mt19937 random(2);
    std::uniform_real_distribution<double> part(0, 1);
    int narrow = 0;
    for (std::size_t k = 0; k < caps.size(); ++k) {
        const Primitive& primitive = world.primitives[0];
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 local
                = primitive.low + glm::dvec3(part(random), part(random), part(random)) * (primitive.high - primitive.low);
            const glm::dvec3 to = turn * (glm::dvec3(world.instances[k].frame_from_local * glm::dvec4(local, 1)) - eye);
            EXPECT_LE(
                std::acos(glm::clamp(glm::dot(glm::normalize(to), caps[k].axis), -1.0, 1.0)), caps[k].radius_rad + 1e-7);
        }
        narrow += caps[k].radius_rad < 1;
    }
    EXPECT_GT(narrow, 30);
}

TEST(Cull, InstancesAreRelativeToTheEyeInDouble)
{
    World world = boxes(1, 1);
    world.instances[0].frame_from_local[3] = glm::dvec4(1e9, 2, -3, 1);
    DrawList list = cull(world, {{EyeEvent{0, {1e9 - 0.001, 2, -3}}}}, {});
    EXPECT_NEAR(list.instances[0].row0.w, 0.001, 1.2e-7); // a double at 1e9 resolves 1.2e-7
    EXPECT_EQ(list.instances[0].row1.w, 0);
}

namespace {

/// A ball of 96 x 48 faces with its levels of detail.
World ball_world()
{
    World world;
    world.materials.push_back({});
    constexpr int n = 48;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= 2 * n; ++i) {
            double t = pi * j / n, f = pi * i / n;
            glm::vec3 d(std::sin(t) * std::cos(f), std::cos(t), std::sin(t) * std::sin(f));
            world.vertices.push_back({d, d, {float(i) / (2 * n), float(j) / n}, 0xffffffff});
        }
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < 2 * n; ++i) {
            std::uint32_t a = j * (2 * n + 1) + i, b = a + 1, c = a + 2 * n + 1, d = c + 1;
            for (std::uint32_t k : {a, b, c, b, d, c})
                world.indices.push_back(k);
        }
    world.primitives.push_back({.first_index = 0,
        .index_count = std::uint32_t(world.indices.size()),
        .vertex_offset = 0,
        .material = 0,
        .low = glm::dvec3(-1),
        .high = glm::dvec3(1),
        .centre = {0, 0, 0},
        .radius = 1,
        .coarser = {}});
    add_detail_levels(world);
    return world;
}

} // namespace

TEST(Cull, KeepsEveryTriangleWhoseFrontAnImagesDirectionMeets)
{
    // Balls of many clusters; those of each third transform are mirrored, and their triangles turned, as a loaded world's.
    for (bool mirrored : {false, true}) {
        World world = ball_world();
        if (mirrored)
            for (std::size_t i = 0; i < world.indices.size(); i += 3)
                std::swap(world.indices[i], world.indices[i + 1]);
        const Primitive& ball = world.primitives[0];
        ASSERT_GE(ball.clusters.count, 20u);
        const World placed = boxes(12, 9);
        for (Instance instance : placed.instances) {
            instance.frame_from_local
                = instance.frame_from_local * glm::dmat4(glm::dmat3(mirrored ? -1 : 1, 0, 0, 0, 1, 0, 0, 0, 1));
            world.instances.push_back(instance);
        }
        const glm::dvec3 eye(0.3, -0.2, 0.5);
        const glm::dmat3 turn = glm::mat3_cast(glm::normalize(glm::dquat(0.3, -0.5, 0.2, 0.9)));
        std::vector<PlannedImage> images;
        for (int face = 0; face < 6; ++face)
            images.push_back({0, face, {-0.6, -0.3}, {0.5, 1}, {64, 64}, {0, 0}, 64, 1});
        images.push_back({TILE_REAR, 1, {-1, -1}, {1, 1}, {64, 64}, {0, 0}, 32, 1, 0.6});
        const DrawList list = cull(world, {{EyeEvent{0, eye, 0, turn}}}, images, {.lod_error_texels = 0});
        std::mt19937 random(2);
        std::uniform_real_distribution<double> part(0, 1);
        long fronts = 0, drawn = 0;
        for (std::uint32_t i = 0; i < images.size(); ++i) {
            std::vector<std::vector<bool>> kept(world.instances.size(), std::vector<bool>(ball.index_count / 3));
            for (const Draw& draw : list.draws)
                for (std::uint32_t k = 0; draw.image == i && k < draw.count; ++k)
                    for (std::uint32_t index = 0; index < draw.index_count; index += 3, ++drawn)
                        kept[list.visible[draw.first + k]][(draw.first_index - ball.first_index + index) / 3] = true;
            for (int ray = 0; ray < 300; ++ray) {
                const glm::dvec2 at
                    = images[i].low + glm::dvec2(part(random), part(random)) * (images[i].high - images[i].low);
                if (std::max(std::abs(at.x), std::abs(at.y)) < images[i].clip_hole)
                    continue;
                const glm::dvec3 way = glm::transpose(turn) * face_direction(images[i].face, at);
                for (std::size_t k = 0; k < world.instances.size(); ++k) {
                    const glm::dmat4 local = glm::inverse(world.instances[k].frame_from_local);
                    const glm::dvec3 from = local * glm::dvec4(eye, 1), along = local * glm::dvec4(way, 0);
                    if (glm::length(glm::cross(along, from)) > 1.01 * glm::length(along))
                        continue;
                    for (std::uint32_t t = 0; t < ball.index_count / 3; ++t) {
                        const auto corner = [&](int c) {
                            return glm::dvec3(world.vertices[world.indices[ball.first_index + 3 * t + c]].position) - from;
                        };
                        const glm::dvec3 a = corner(0), b = corner(1), c = corner(2);
                        const double ab = glm::dot(along, glm::cross(a, b)), bc = glm::dot(along, glm::cross(b, c)),
                                     ca = glm::dot(along, glm::cross(c, a)), least = std::min({ab, bc, ca});
                        const double height = glm::dot(a, glm::cross(b - a, c - a)) * (mirrored ? -1 : 1);
                        if ((least > 0 || std::max({ab, bc, ca}) < 0) && glm::dot(along, a) > 0 && height < 0) {
                            ++fronts;
                            ASSERT_TRUE(kept[k][t]) << "image " << i << " instance " << k << " triangle " << t;
                        }
                    }
                }
            }
        }
        EXPECT_GT(fronts, 200);
        // Backs are left out, unless the instance is mirrored, and so are the parts beside the image.
        EXPECT_LT(
            double(drawn), (mirrored ? 0.5 : 0.3) * double(images.size() * world.instances.size() * ball.index_count / 3));
    }
}

// A ray from the eye that meets two boxes meets the one that is drawn first behind the other one.
TEST(Cull, BlendedBoxesAreDrawnFromBehind)
{
    std::mt19937 random(4);
    const auto any = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
    const auto any_way = [&] { return glm::normalize(glm::dvec3(any(-1, 1), any(-1, 1), any(-1, 1)) + 1e-9); };
    using Box = DrawList::OrientedBox;
    // The distances at which a ray from the origin enters and leaves a box.
    const auto met = [](const Box& box, const glm::dvec3& way) {
        glm::dvec2 range(0, 1e300);
        for (const glm::dvec3& half : box.half) {
            const double size = glm::length(half), at = glm::dot(box.centre, half) / size, rate = glm::dot(way, half) / size;
            const double one = (at - size) / rate, other = (at + size) / rate;
            range = {std::max(range.x, std::min(one, other)), std::min(range.y, std::max(one, other))};
        }
        return range;
    };
    long pairs = 0, wrong = 0, nearer_middle = 0;
    for (int turn = 0; turn < 400; ++turn) {
        // Panes and blocks in the cells of a grid, which are long and short. The eye is among them, in one, or outside.
        const glm::dmat3 axes(glm::mat3_cast(glm::angleAxis(any(0, 6), any_way())));
        const glm::dvec3 origin = any_way() * any(0, 3);
        double middles[3][3], halves[3][3]; // by axis
        for (int k = 0; k < 3; ++k) {
            double at = -4;
            for (int i = 0; i < 3; ++i) {
                halves[k][i] = std::exp2(any(-4, 2));
                middles[k][i] = at + halves[k][i];
                at += 2 * halves[k][i];
            }
        }
        DrawList list;
        for (int cell = 0; cell < 27; ++cell) {
            const int at[] = {cell % 3, cell / 3 % 3, cell / 9};
            Box box{};
            box.centre = origin;
            const int flat = int(any(0, 4)); // 3: none is
            // A third of them stand askew in their cells.
            const bool askew = cell % 3 == turn % 3;
            const glm::dmat3 own = askew ? glm::dmat3(glm::mat3_cast(glm::angleAxis(any(0, 6), any_way()))) : axes;
            const double least = std::min({halves[0][at[0]], halves[1][at[1]], halves[2][at[2]]}) / std::sqrt(3);
            for (int k = 0; k < 3; ++k) {
                box.centre += axes[k] * middles[k][at[k]];
                box.half[k] = own[k] * ((askew ? least : halves[k][at[k]]) * (k == flat ? 0.001 : any(0.3, 1)));
            }
            list.boxes.push_back(box);
        }
        std::vector<Draw> draws;
        for (std::uint32_t i = 0; i < list.boxes.size(); ++i) {
            list.visible.push_back(i);
            Draw draw{};
            draw.first = i, draw.count = 1, draw.blended = true;
            draws.push_back(draw);
        }
        std::shuffle(draws.begin(), draws.end(), random);
        sort_from_behind(draws, list);
        for (int ray = 0; ray < 1500; ++ray) {
            const glm::dvec3 way = any_way();
            double last = 1e300, last_middle = 1e300;
            for (const Draw& draw : draws) {
                const Box& box = list.boxes[draw.first];
                const glm::dvec2 range = met(box, way);
                if (range.x >= range.y)
                    continue;
                pairs += last < 1e300;
                wrong += range.x > last + 1e-9;
                nearer_middle += glm::length(box.centre) > last_middle;
                last = range.x, last_middle = glm::length(box.centre);
            }
        }
    }
    EXPECT_GT(pairs, 10000);
    EXPECT_GT(nearer_middle, 100) << "the order of the middles alone is not the right one";
    // Neighbours are compared alone, and two boxes that no ray meets both have an order, too: that order can keep a third
    // box from its place. Measured: 1 of 29,899.
    EXPECT_LE(wrong, pairs / 10000) << "of " << pairs;
}

// A blended ball that the eye sees from outside shows its far half first, at every level of detail; opaque places are drawn
// once more, before all that is blended.
TEST(Cull, ABlendedSurfacesTrianglesAreDrawnFromBehind)
{
    World world = ball_world();
    world.materials[0].blended = true;
    world.primitives.push_back(world.primitives[0]); // the same once more, with opaque places
    world.materials.push_back(world.materials[0]);
    world.materials[1].alpha_cutoff = 0.998f;
    world.primitives[1].material = 1;
    add_blended_triangles(world);
    std::vector<glm::dvec3> places = {{0, 0, -3}, {1, 2, -9}, {60, -40, 200}, {-0.5, 0.2, 0.1}};
    for (std::size_t i = 0; i < places.size(); ++i) {
        const glm::dmat4 turned = glm::translate(glm::dmat4(1), places[i])
            * glm::mat4_cast(glm::angleAxis(0.7 * double(i), glm::normalize(glm::dvec3(1, 2, 3))));
        world.instances.push_back({turned, std::uint32_t(i % 2)});
    }
    sort_instances(world);
    std::vector<PlannedImage> images;
    for (int face = 0; face < 6; ++face)
        images.push_back({0, face, {-1, -1}, {1, 1}, {512, 512}, {0, 0}, 256, 1});
    const EyeEvent eye{};
    const DrawList list = cull(world, {&eye, 1}, images, {});
    std::set<std::uint32_t> counts;
    long blended = 0, solid = 0;
    for (const Draw& draw : list.draws) {
        if (!draw.blended) {
            EXPECT_EQ(draw.primitive, 1u) << "of the other nothing is opaque";
            ++solid;
            continue;
        }
        ++blended;
        counts.insert(draw.index_count);
        ASSERT_LE(draw.first_index + draw.index_count, list.sorted_indices.size());
        const Instance& instance = world.instances[list.visible[draw.first]];
        double last = 1e300;
        for (std::uint32_t i = draw.first_index; i < draw.first_index + draw.index_count; i += 3) {
            glm::dvec3 middle(0);
            for (std::uint32_t k = 0; k < 3; ++k) {
                const Vertex& vertex = world.vertices[list.sorted_indices[i + k]];
                middle += glm::dvec3(instance.frame_from_local * glm::dvec4(vertex.position, 1)) / 3.0;
            }
            EXPECT_LE(glm::length(middle), last * (1 + 1e-6));
            last = glm::length(middle);
        }
    }
    EXPECT_GE(counts.size(), 3u) << "levels of detail";
    EXPECT_GE(blended, 4);
    EXPECT_GE(solid, 2);
}

TEST(Detail, CoarserSurfacesStayWithinTheirError)
{
    // A level's vertices lie on the ball, and the middles of its triangles within the level's error.
    const World world = ball_world();
    const Primitive& ball = world.primitives[0];
    ASSERT_GE(ball.coarser.size(), 3u);
    double last_error = 0;
    std::uint32_t last_count = ball.index_count;
    for (const DetailLevel& level : ball.coarser) {
        EXPECT_LT(level.index_count, last_count);
        EXPECT_GE(level.error, last_error);
        last_count = level.index_count, last_error = level.error;
        double worst = 0;
        for (std::uint32_t i = 0; i < level.index_count; i += 3) {
            glm::dvec3 middle(0);
            for (int k = 0; k < 3; ++k)
                middle += glm::dvec3(world.vertices[world.indices[level.first_index + i + k]].position) / 3.0;
            worst = std::max(worst, 1 - glm::length(middle));
        }
        // The simplifier's error is a mean over planes, not a bound; for balls a factor of four holds.
        EXPECT_LT(worst, 4 * level.error + 0.002) << level.index_count;
        // Shadows need a bound: how deep any part of the level lies below the ball.
        EXPECT_LE(worst, level.apart) << level.index_count;
        EXPECT_LT(level.apart, 2 * worst + 0.002) << level.index_count;
    }
}

TEST(Detail, ReportsADifferenceInShading)
{
    // Two pipes of nearly the same depth. One has ripples of a thousandth, whose normals turn by 30 degrees either way.
    auto pipe = [](double tilt) {
        World world;
        world.materials.push_back({});
        constexpr int around = 192, along = 8;
        for (int j = 0; j <= along; ++j)
            for (int i = 0; i <= around; ++i) {
                const double f = 2 * pi * i / around, lean = tilt * std::sin(24 * f);
                const double r = 1 - 0.001 * (tilt > 0) * std::cos(24 * f);
                world.vertices.push_back({glm::vec3(r * std::cos(f), 0.05 * j, r * std::sin(f)),
                    glm::vec3(std::cos(f + lean), 0, std::sin(f + lean)), {0, 0}, 0xffffffff});
            }
        for (std::uint32_t j = 0; j < along; ++j)
            for (std::uint32_t i = 0; i < around; ++i) {
                const std::uint32_t a = j * (around + 1) + i, b = a + 1, c = a + around + 1, d = c + 1;
                for (std::uint32_t k : {a, c, b, b, c, d})
                    world.indices.push_back(k);
            }
        world.primitives.push_back({.first_index = 0,
            .index_count = std::uint32_t(world.indices.size()),
            .vertex_offset = 0,
            .material = 0,
            .low = glm::dvec3(-1, 0, -1),
            .high = glm::dvec3(1, 0.4, 1),
            .centre = {0, 0.2, 0},
            .radius = 1.1,
            .coarser = {}});
        add_detail_levels(world);
        return world.primitives[0].coarser;
    };
    const auto smooth = pipe(0), rippled = pipe(30 * pi / 180);
    ASSERT_GE(smooth.size(), 3u);
    ASSERT_GE(rippled.size(), 3u);
    // An eighth of the triangles can't show ripples 0.26 apart; a round pipe keeps its shading.
    EXPECT_LT(smooth[2].shading, 0.004);
    EXPECT_GT(rippled[2].shading, 0.02);
    EXPECT_LT(rippled[0].error, 0.01);
}

TEST(Detail, KeepsManySmallTrianglesAsTheyAre)
{
    World world;
    world.materials.push_back({});
    for (int i = 0; i < 500; ++i)
        for (int k = 0; k < 3; ++k) {
            world.indices.push_back(std::uint32_t(world.vertices.size()));
            world.vertices.push_back(
                {{i % 25 + 0.1f * (k == 1), i / 25 + 0.1f * (k == 2), 0}, {0, 0, 1}, {0, 0}, 0xffffffff});
        }
    world.primitives.push_back({.first_index = 0,
        .index_count = 1500,
        .vertex_offset = 0,
        .material = 0,
        .low = {0, 0, 0},
        .high = {25, 20, 0},
        .centre = {12, 10, 0},
        .radius = 16,
        .coarser = {}});
    add_detail_levels(world);
    EXPECT_TRUE(world.primitives[0].coarser.empty());
}

} // namespace cull_test
