// The cube-map plan: every texel that a pixel reads is drawn, at the requested density.
#include "config/model/angles.h"
#include "runtime/plan/cube_map_plan.h"
#include "runtime/world/eye_event.h"
#include "shaders/physics/physics.h"
#include "tests/support/files.h"
#include "tests/support/speeds.h"
#include "tests/support/view.h"
#include <gtest/gtest.h>
#include <random>

namespace plan_test {

using namespace starbow;
using starbow::testing::all_cases, starbow::testing::view_of, starbow::testing::u_of_gamma;

namespace {

struct Case {
    const char* name;
    Projection projection;
    glm::ivec2 size;
};

const Case cases[] = {
    {"window", Planar{60}, {800, 600}},
    {"narrow window", Planar{5}, {301, 97}},
    {"wide window", Planar{150}, {640, 200}},
    {"dome", Fisheye{180, 30}, {256, 256}},
    {"whole sky", Fisheye{360, 0}, {255, 255}},
    {"pixel", Planar{60}, {1, 1}},
};
const double gammas[] = {1, 1 + 1e-7, 1.5, 4, 10, 100, 1e4, 1e6};
const double slow_gammas[] = {1 + 1e-7, 1.02, 1.1607}; // to 0.51 c: cube maps may have the cockpit's axes

glm::dquat turn(int i)
{
    if (i == 0)
        return {1, 0, 0, 0};
    if (i == 1)
        return glm::angleAxis(pi, glm::dvec3(0, 1, 0)); // straight back
    std::mt19937 random(unsigned(i) * 77);
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random)));
}

/// Calls check(plan, place in a tile, angle of the pixel in the world, image or null) for every ray of every pixel.
/// cockpit_axes: the cube map has the cockpit's axes, not the motion's.
template <class Check>
void each_pixel(const Case& c, double gamma, int turned, const Quality& quality, Check&& check, bool cockpit_axes = false)
{
    glm::dvec3 u(0, 0, -u_of_gamma(gamma));
    double E = physics::exp_rapidity(glm::length(u));
    glm::dquat ship_from_cockpit = turn(turned);
    glm::dmat3 motion_from_cockpit = motion_from_world(u, ship_from_cockpit) * glm::dmat3(glm::mat3_cast(ship_from_cockpit));
    const CompiledView view = view_of(c.projection, c.size);
    const glm::dmat3 cube_from_cockpit
        = cockpit_axes ? glm::dmat3(glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1)) : motion_from_cockpit;
    const glm::dmat3 cube_from_motion
        = cockpit_axes ? cube_from_cockpit * glm::transpose(motion_from_cockpit) : glm::dmat3(1);
    RestFrameRequest request{{{view.cones.get(), motion_from_cockpit}}, E};
    request.cube_from_motion = cube_from_motion;
    CubeMapPlan plan = plan_cube_map({request}, quality);
    std::vector<const PlannedImage*> by_sub_tile(TILE_COUNT * SUB_TILE_COUNT, nullptr);
    for (const PlannedImage& image : plan.images)
        for (int y = 0; y < image.sub_tiles.count.y; ++y)
            for (int x = 0; x < image.sub_tiles.count.x; ++x) {
                const glm::ivec2 sub_tile = image.sub_tiles.first + glm::ivec2(x, y);
                by_sub_tile[std::size_t(image.tile * SUB_TILE_COUNT + sub_tile.y * TILE_SUB_TILES + sub_tile.x)] = &image;
            }
    auto image = [&](const TilePlace& place) {
        const glm::ivec2 sub_tile = sub_tiles_in(place.tile, {place.at, place.at}).first;
        return by_sub_tile[std::size_t(place.tile * SUB_TILE_COUNT + sub_tile.y * TILE_SUB_TILES + sub_tile.x)];
    };
    for (int y = 0; y < c.size.y; ++y)
        for (int x = 0; x < c.size.x; ++x) {
            const glm::dvec2 pixel(x + 0.5, y + 0.5);
            const int rays = quality.pixel_rays;
            for (int i = 0; i < rays * rays; ++i) {
                auto n
                    = direction(view.view.picture, glm::dvec2(x, y) + (glm::dvec2(i % rays, i / rays) + 0.5) / double(rays));
                if (!n)
                    continue;
                auto ray = physics::world_from_camera(motion_from_cockpit * *n, E, 1 / E);
                TilePlace place = tile_of(cube_from_motion * ray.n, plan.finest_clip_level[0]);
                check(plan, place, ray.D * pixel_angle(view.view.picture, pixel), image(place));
            }
        }
}

} // namespace

namespace {

void expect_every_texel_drawn(const Case& c, std::span<const double> speeds, bool cockpit_axes, int rays = 1)
{
    for (double gamma : speeds)
        for (int turned = 0; turned < (all_cases() ? 5 : 3); ++turned) {
            long missing = 0, outside = 0, pixels = 0;
            each_pixel(
                c, gamma, turned, {.texels_per_pixel = 1, .max_texels_per_pixel = 6, .pixel_rays = rays},
                [&](const CubeMapPlan&, const TilePlace& place, double world_angle, const PlannedImage* image) {
                    ++pixels;
                    if (!image)
                        return void(++missing);
                    // The level that is read, and its two by two texels around the point. Half a texel covers the
                    // shader's float arithmetic.
                    double texels = world_angle * image->texels_per_unit * std::pow(1 + glm::dot(place.at, place.at), 0.75);
                    int level = std::clamp(int(std::ceil(std::log2(std::max(texels, 1e-9)))), 0, image->levels - 1);
                    double texel = std::exp2(level);
                    glm::dvec2 at = (place.at - image->low) * image->texels_per_unit / texel;
                    glm::dvec2 last = glm::dvec2(image->size) / texel;
                    if (std::min(at.x, at.y) < 0.5 || at.x > last.x - 0.5 || at.y > last.y - 0.5)
                        ++outside;
                },
                cockpit_axes);
            EXPECT_EQ(missing, 0) << c.name << ", gamma " << gamma << ", turn " << turned << " of " << pixels;
            EXPECT_EQ(outside, 0) << c.name << ", gamma " << gamma << ", turn " << turned << " of " << pixels;
        }
}

} // namespace

TEST(CubeMapPlan, EveryTexelThatAnyPixelReadsWasDrawn)
{
    for (const Case& c : cases) {
        expect_every_texel_drawn(c, gammas, false);
        expect_every_texel_drawn(c, std::span(slow_gammas).last(all_cases() ? 3 : 1), true);
    }
    // One pixel's rays may be spread over the whole sky.
    for (const Case& c : {cases[1], cases[4], cases[5]})
        expect_every_texel_drawn(c, std::span(gammas).last(3), false, 3);
}

TEST(CubeMapPlan, ImagesLieApartInTheAtlas)
{
    for (const Case& c : cases)
        for (double gamma : gammas)
            for (int turned = 0; turned < 3; ++turned)
                each_pixel({c.name, c.projection, glm::min(c.size, glm::ivec2(64))}, gamma, turned, {},
                    [&, once = false](const CubeMapPlan& plan, auto&&...) mutable {
                        if (std::exchange(once, true))
                            return;
                        int overlaps = 0;
                        for (const PlannedImage& a : plan.images) {
                            EXPECT_GE(std::min(a.atlas.x, a.atlas.y), 0);
                            EXPECT_LE(a.atlas.x + a.size.x, plan.atlas_size.x);
                            EXPECT_LE(a.atlas.y + a.size.y, plan.atlas_size.y);
                            EXPECT_NEAR(a.size.x, (a.high.x - a.low.x) * a.texels_per_unit, 1e-6);
                            EXPECT_EQ((a.atlas.x | a.atlas.y | a.size.x | a.size.y) & ((1 << a.levels) - 1), 0);
                            for (const PlannedImage& b : plan.images)
                                overlaps += &a != &b && a.atlas.x < b.atlas.x + b.size.x && b.atlas.x < a.atlas.x + a.size.x
                                    && a.atlas.y < b.atlas.y + b.size.y && b.atlas.y < a.atlas.y + a.size.y;
                        }
                        EXPECT_EQ(overlaps, 0) << c.name << " " << gamma;
                    });
}

TEST(CubeMapPlan, HoldsTheRequestedDensity)
{
    // Without a limit on texels each pixel gets at least one texel, minus the variation over a block's cone (blocks of 24
    // pixels: 15 %). With mip levels it gets at most about two across.
    for (auto [gamma, cockpit_axes] : {std::pair(1.0, false), {4.0, false}, {100.0, false}, {1.02, true}, {1.1607, true}}) {
        double least = 1e9, most = 0;
        each_pixel(
            cases[0], gamma, 0, {.texels_per_pixel = 1, .max_texels_per_pixel = 1e9},
            [&](const CubeMapPlan&, const TilePlace& place, double world_angle, const PlannedImage* image) {
                double texels = world_angle * image->texels_per_unit * std::pow(1 + glm::dot(place.at, place.at), 0.75);
                least = std::min(least, texels);
                most = std::max(most, texels / std::exp2(image->levels - 1));
            },
            cockpit_axes);
        EXPECT_GT(least, 0.85) << gamma;
        EXPECT_LT(most, 2.6) << gamma;
    }
}

// Each pixel gets at least one texel at any speed and in any direction of view. (A window of 150 degrees takes up to 9,
// because its pixels are stretched four times at its edges, and texels are not.)
TEST(CubeMapPlan, SpendsAtMostThreeTexelsOnAPixel)
{
    const Case displays[] = {{"window, 60 degrees", Planar{60}, {800, 600}}, {"window, 20 degrees", Planar{20}, {800, 600}},
        {"wall, 90 degrees", Planar{90}, {1920, 1080}}, {"headset, 110 degrees", Planar{110}, {1600, 1600}},
        {"dome", Fisheye{180, 0}, {1024, 1024}}, {"whole sky", Equirectangular{}, {2048, 1024}}};
    const double speeds[] = {1, 1.5, 2, 4, 10, 100, 1000, 1e6};
    std::printf("  texels a pixel and images, for the most expensive direction\n  %-22s", "gamma");
    for (double gamma : speeds)
        std::printf("%12g", gamma);
    for (const Case& c : displays) {
        const CompiledView view = view_of(c.projection, c.size);
        std::printf("\n  %-22s", c.name);
        for (double gamma : speeds) {
            double most = 0;
            std::size_t images = 0;
            for (int degrees = 0; degrees <= 180; degrees += 15) {
                const glm::dvec3 u(0, 0, -u_of_gamma(gamma));
                const glm::dquat turned
                    = glm::angleAxis(glm::radians(double(degrees)), glm::normalize(glm::dvec3(0.3, 1, 0)));
                const CubeMapPlan plan
                    = plan_cube_map({{view.cones.get(), motion_from_world(u, turned) * glm::dmat3(glm::mat3_cast(turned))}},
                        physics::exp_rapidity(glm::length(u)),
                        {.texels_per_pixel = 1, .max_texels_per_pixel = 1e9, .max_texels = 1e12, .max_atlas_side = 1 << 30});
                if (plan.texels > most * plan.pixels)
                    most = plan.texels / plan.pixels, images = plan.images.size();
            }
            std::printf("%6.2f, %3zu ", most, images);
            EXPECT_LE(most, 3) << c.name << ", gamma " << gamma;
        }
    }
    std::printf("\n");
}

// In a slow motion texels move slowly: an image's density changes as D does, and not whenever some image gains or loses a
// row of texels. Each change of a density moves all edges of the picture by parts of a texel.
TEST(CubeMapPlan, ASlowMotionChangesDensitiesSlowly)
{
    const CompiledView view = view_of(Planar{60}, {320, 240});
    constexpr int frames = 60;
    int jumps = 0, all = 0;
    for (double texels_per_pixel : {0.5, 0.8})
        for (double beta : {0.3, 0.9})
            for (bool turns : {false, true}) {
                // d ln D / d eta is at most 1, so 0.05 % by a gain in speed; d ln D / d theta is at most gamma beta, so
                // 0.18 % by a turn.
                const double most = turns ? 0.0022 : 0.0008;
                CubeMapPlan before;
                for (int i = 0; i < frames; ++i) {
                    const double eta = std::atanh(beta) + (turns ? 0 : 5e-4 * i);
                    const glm::dvec3 u = std::sinh(eta) * glm::normalize(glm::dvec3(0.47, 0.34, -0.81));
                    const glm::dquat turned = glm::angleAxis(turns ? 0.05 * i * degree : 0, glm::dvec3(0, 1, 0));
                    CubeMapPlan plan = plan_cube_map(
                        {{view.cones.get(), motion_from_world(u, turned) * glm::dmat3(glm::mat3_cast(turned))}},
                        std::exp(eta),
                        {.texels_per_pixel = texels_per_pixel,
                            .max_texels_per_pixel = texels_per_pixel < 0.6 ? 0.5 : 0.9,
                            .image_cost_texels = 32768});
                    const auto steady = [&](const PlannedImage& a, const PlannedImage& b) {
                        return a.tile == b.tile && a.sub_tiles == b.sub_tiles
                            && std::abs(std::log(a.texels_per_unit / b.texels_per_unit)) < most;
                    };
                    jumps += i > 0
                        && !std::equal(
                            plan.images.begin(), plan.images.end(), before.images.begin(), before.images.end(), steady);
                    all += i > 0;
                    before = std::move(plan);
                }
            }
    // Densities jump in 63 of these frames: there the division changes, or a block of pixels enters another sub-tile. They
    // jump in 196 if the limit counts the images' own texels.
    std::printf("  densities jump in %d of %d frames\n", jumps, all);
    EXPECT_LT(jumps, 100);
}

TEST(CubeMapPlan, TradesTexelsForImagesByTheirCost)
{
    const CompiledView view = view_of(Planar{60}, {800, 600});
    const glm::dvec3 u(0, 0, -u_of_gamma(4));
    std::size_t images = 1000;
    double texels = 0;
    for (double cost : {0.0, 4096.0, 32768.0, 1e6, 1e12}) {
        const CubeMapPlan plan = plan_cube_map({{view.cones.get(), motion_from_world(u, glm::dquat(1, 0, 0, 0))}},
            physics::exp_rapidity(glm::length(u)),
            {.texels_per_pixel = 1, .max_texels_per_pixel = 1e9, .image_cost_texels = cost, .max_texels = 1e12});
        EXPECT_LT(plan.images.size(), images) << cost;
        EXPECT_GT(plan.texels, texels) << cost;
        EXPECT_EQ(plan.cut, cost < 1e12);
        images = plan.images.size(), texels = plan.texels;
    }
}

// The table leads the warp shader to the image that holds a direction, in float. Within half a texel of a cell's edge it may
// be the next image, which is drawn beyond its edge.
TEST(CubeMapPlan, TableLeadsToTheImageOfADirection)
{
    const auto table = std::make_unique<shared::TileTable>();
    for (double gamma : gammas) {
        const CompiledView view = view_of(Planar{100}, {800, 600});
        const glm::dvec3 u(0, 0, -u_of_gamma(gamma));
        const double E = physics::exp_rapidity(glm::length(u));
        const glm::dmat3 turned = motion_from_world(u, turn(3)) * glm::dmat3(glm::mat3_cast(turn(3)));
        const CubeMapPlan plan
            = plan_cube_map({{view.cones.get(), turned}}, E, {.texels_per_pixel = 1, .max_texels_per_pixel = 1e9});
        write_tiles(plan, *table);
        for (int y = 0; y < 600; y += 7)
            for (int x = 0; x < 800; x += 7) {
                const glm::dvec3 n = turned * *direction(view.view.picture, glm::dvec2(x, y) + 0.5);
                const TilePlace place = tile_of(physics::world_from_camera(n, E, 1 / E).n, plan.finest_clip_level[0]);
                const glm::vec2 at(place.at), spread = place.face == 1 ? at * glm::abs(at) : at;
                const glm::vec4 sub_tiles = table->sub_tiles_from_face[place.tile];
                const glm::ivec2 sub_tile
                    = glm::min(glm::ivec2(spread * glm::vec2(sub_tiles) + glm::vec2(sub_tiles.z, sub_tiles.w)),
                        glm::ivec2(TILE_SUB_TILES - 1));
                const shared::TileEntry& entry
                    = table->entries[place.tile * SUB_TILE_COUNT + sub_tile.y * TILE_SUB_TILES + sub_tile.x];
                const glm::vec2 texel
                    = at * entry.texel_from_face.x + glm::vec2(entry.texel_from_face.y, entry.texel_from_face.z);
                ASSERT_GE(texel.x, entry.texels.x + 0.5f) << gamma << " " << x << " " << y;
                ASSERT_GE(texel.y, entry.texels.y + 0.5f) << gamma << " " << x << " " << y;
                ASSERT_LE(texel.x, entry.texels.z + 0.5f) << gamma << " " << x << " " << y;
                ASSERT_LE(texel.y, entry.texels.w + 0.5f) << gamma << " " << x << " " << y;
            }
    }
}

TEST(CubeMapPlan, StaysUnderTheLimitOfTexels)
{
    for (double gamma : {1.0, 4.0, 10.0, 100.0, 1e4})
        for (int turned = 0; turned < 5; ++turned)
            each_pixel(cases[0], gamma, turned, {.texels_per_pixel = 1, .max_texels_per_pixel = 2},
                [&, once = false](const CubeMapPlan& plan, auto&&...) mutable {
                    if (std::exchange(once, true))
                        return;
                    EXPECT_LT(plan.texels / plan.pixels, 2.3) << gamma << " " << turned;
                });
}

TEST(CubeMapPlan, FitsTheDeviceHoweverLargeTheOutput)
{
    const ConeHierarchy cones(*planar_matrix({Planar{120}, {16384, 16384}}), {16384, 16384});
    for (double gamma : {1.0, 4.0, 1000.0}) {
        glm::dvec3 u(0, 0, -u_of_gamma(gamma));
        // A flat display; a dome of 16384 pixels would need a map that fills the test's memory.
        CubeMapPlan plan
            = plan_cube_map({{&cones, motion_from_world(u, glm::dquat(1, 0, 0, 0))}}, physics::exp_rapidity(glm::length(u)),
                {.texels_per_pixel = 1.25, .max_texels_per_pixel = 8, .max_texels = 48e6, .max_atlas_side = 4096});
        EXPECT_LE(std::max(plan.atlas_size.x, plan.atlas_size.y), 4096) << gamma;
        EXPECT_GT(plan.texels, 4096.0 * 4096 / 4) << gamma;
    }
}

TEST(CubeMapPlan, AtRestAViewAheadNeedsOneImage)
{
    const CompiledView view = view_of(Planar{60}, {800, 600});
    CubeMapPlan plan = plan_cube_map({{view.cones.get(), motion_from_world({}, glm::dquat(1, 0, 0, 0))}}, 1, {});
    ASSERT_EQ(plan.images.size(), 1u);
    EXPECT_EQ(plan.images[0].tile, TILE_FRONT);
    EXPECT_EQ(plan.levels, 1);
    // Texels in the corners cover half the middle's solid angle, and 4 texels of gutter surround the image.
    EXPECT_LT(plan.texels / plan.pixels, 1.3);
}

TEST(CubeMapPlan, ASmallPictureOfTheSameDirectionsCostsNothing)
{
    // Its pixels are four times as wide. Without rays of its own it would need mips; a limit of texels stays as it is.
    const CompiledView large = view_of(Planar{60}, {800, 600}), small = view_of(Planar{60}, {200, 150});
    const glm::dmat3 ahead = motion_from_world({}, {1, 0, 0, 0});
    for (const double most : {3.0, 0.5}) {
        const Quality quality{.texels_per_pixel = 0.9, .max_texels_per_pixel = most};
        const ViewRequest own{large.cones.get(), ahead};
        const CubeMapPlan alone = plan_cube_map({own}, 1, quality);
        const auto with = [&](int rays, bool beside) {
            return plan_cube_map(
                {own, {.cones = small.cones.get(), .motion_from_cockpit = ahead, .rays = rays, .beside = beside}}, 1,
                quality);
        };
        const CubeMapPlan both = with(2, true);
        ASSERT_EQ(both.images.size(), 1u);
        EXPECT_EQ(both.levels, 1);
        EXPECT_EQ(both.pixels, alone.pixels);
        // Its rays reach a part of its own pixels beyond the edge: some texels.
        EXPECT_NEAR(both.images[0].texels_per_unit, alone.images[0].texels_per_unit, 0.01 * alone.images[0].texels_per_unit);
        EXPECT_LT(both.texels, 1.01 * alone.texels);
        EXPECT_GT(with(1, true).levels, most > 1 ? 1 : 0);
        EXPECT_GT(with(2, false).pixels, alone.pixels);
    }
}

TEST(CubeMapPlan, ClipMapsTheRectangleToTheSquare)
{
    for (int face = 0; face < 6; ++face) {
        PlannedImage image{0, face, {-0.3, 0.1}, {0.8, 0.9}, {64, 64}, {0, 0}, 1, 1};
        glm::dmat4 clip = clip_from_cube(image, 1e-6);
        glm::dvec4 low = clip * glm::dvec4(7.0 * face_direction(face, image.low), 1);
        glm::dvec4 high = clip * glm::dvec4(7.0 * face_direction(face, image.high), 1);
        EXPECT_NEAR(low.x / low.w, -1, 1e-12);
        EXPECT_NEAR(low.y / low.w, -1, 1e-12);
        EXPECT_NEAR(high.x / high.w, 1, 1e-12);
        EXPECT_NEAR(high.y / high.w, 1, 1e-12);
        EXPECT_NEAR(low.z / low.w, 1e-6 / 7, 1e-18); // reversed z: near over distance
    }
}

TEST(CubeMapPlan, IsReusedForRequestsThatItCovers)
{
    const Quality quality{.texels_per_pixel = 1, .max_texels_per_pixel = 50};
    const CompiledView view = view_of(Planar{60}, {400, 300});
    const auto plan_at = [&](double gamma, double yaw) {
        const glm::dvec3 u(0, 0, -u_of_gamma(gamma));
        const glm::dquat turned = glm::angleAxis(yaw, glm::dvec3(0, 1, 0));
        return plan_cube_map({{view.cones.get(), motion_from_world(u, turned) * glm::dmat3(glm::mat3_cast(turned))}},
            physics::exp_rapidity(glm::length(u)), quality);
    };
    const CubeMapPlan plan = plan_at(2, 0.3);
    EXPECT_TRUE(can_reuse(plan, plan));
    // A turn leads beyond the plan's edges; at a higher speed other and finer images are requested.
    EXPECT_FALSE(can_reuse(plan, plan_at(2, 0.8)));
    EXPECT_FALSE(can_reuse(plan, plan_at(8, 0.3)));
    // An image of the same extent but coarser can't be reused.
    CubeMapPlan coarse = plan;
    coarse.images[0].texels_per_unit *= 0.5;
    EXPECT_FALSE(can_reuse(coarse, plan));
    EXPECT_TRUE(can_reuse(plan, coarse));
    // Each image must hold all that a wanted one holds: the extent on every side, the levels, what is not left out.
    const auto lesser = [&](auto&& change) {
        for (std::size_t i = 0; i < plan.images.size(); ++i) {
            CubeMapPlan less = plan;
            change(less.images[i]);
            EXPECT_FALSE(can_reuse(less, plan)) << i;
            EXPECT_TRUE(can_reuse(plan, less)) << i;
        }
    };
    lesser([](PlannedImage& image) { image.low.x += 0.01; });
    lesser([](PlannedImage& image) { image.low.y += 0.01; });
    lesser([](PlannedImage& image) { image.high.x -= 0.01; });
    lesser([](PlannedImage& image) { image.high.y -= 0.01; });
    lesser([](PlannedImage& image) { image.clip_hole += 0.01; });
    lesser([](PlannedImage& image) { --image.levels; });
    lesser([](PlannedImage& image) { image.needed = false; });
    lesser([](PlannedImage& image) { image.texels_per_unit *= 0.7; });
    CubeMapPlan fewer = plan;
    fewer.images.pop_back();
    EXPECT_FALSE(can_reuse(fewer, plan));
    EXPECT_TRUE(can_reuse(plan, fewer));
}

} // namespace plan_test
