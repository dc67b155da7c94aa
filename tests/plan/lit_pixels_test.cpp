// The division of a view into lit and dark squares, against each pixel's own Doppler factor.
#include "config/model/angles.h"
#include "displays/compile/compiled_view.h"
#include "runtime/plan/lit_pixels.h"
#include "runtime/world/eye_event.h"
#include "shaders/physics/physics.h"
#include "tests/support/speeds.h"
#include "tests/support/view.h"
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>
#include <random>

namespace lit_pixels_test {

using namespace starbow;
using starbow::testing::u_of_gamma, starbow::testing::view_of;

namespace {

struct Case {
    Projection projection;
    glm::ivec2 size;
};
const Case cases[] = {{Planar{60}, {400, 300}}, {Planar{150}, {301, 97}}, {Planar{140}, {300, 260}},
    {Fisheye{180, 30}, {256, 256}}, {Fisheye{360, 0}, {255, 255}}, {Equirectangular{}, {320, 160}}, {Planar{60}, {7, 5}}};

glm::dquat turn(int i)
{
    std::mt19937 random{unsigned(i)};
    std::normal_distribution<double> normal;
    return i == 0 ? glm::dquat(1, 0, 0, 0)
                  : glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random)));
}

/// The number of a list's rectangles over each pixel.
std::vector<int> covered(const std::vector<PixelRect>& rects, glm::ivec2 size)
{
    std::vector<int> all(std::size_t(size.x) * size.y, 0);
    for (const PixelRect& rect : rects)
        for (int y = rect.low.y; y < rect.high.y; ++y)
            for (int x = rect.low.x; x < rect.high.x; ++x)
                ++all.at(std::size_t(y) * size.x + x);
    return all;
}

} // namespace

TEST(LitPixels, EachPixelIsInTheRectangleOfItsD)
{
    LitPixels pixels;
    for (const Case& c : cases) {
        const CompiledView view = view_of(c.projection, c.size);
        for (double gamma : {1.0, 1.1, 4.0, 1e5})
            for (double dark_D : {0.0, 0.35, 1.0, 1e9})
                for (int turned = 0; turned < 2; ++turned) {
                    const double u = u_of_gamma(gamma), E = physics::exp_rapidity(u);
                    const glm::dquat ship = turn(turned);
                    const glm::dmat3 motion_from_cockpit
                        = motion_from_world({0, 0, -u}, ship) * glm::dmat3(glm::mat3_cast(ship));
                    pixels.find(*view.cones, motion_from_cockpit, E, dark_D, 0.02);
                    const std::vector<int> lit = covered(pixels.lit, c.size), dark = covered(pixels.dark, c.size);
                    long wrong = 0, twice = 0, dim = 0, found = 0;
                    for (int y = 0; y < c.size.y; ++y)
                        for (int x = 0; x < c.size.x; ++x) {
                            const std::size_t i = std::size_t(y) * c.size.x + x;
                            twice += lit[i] + dark[i] > 1;
                            const auto n = direction(view.view.picture, {x + 0.5, y + 0.5});
                            if (!n)
                                continue;
                            const double D = physics::world_from_camera(motion_from_cockpit * *n, E, 1 / E).D;
                            // The maps' directions have 24 bits a coordinate.
                            wrong += D >= dark_D * (1 + 1e-5) ? lit[i] != 1 : lit[i] + dark[i] != 1;
                            dim += D < 0.7 * dark_D, found += D < 0.7 * dark_D && dark[i] == 1;
                        }
                    EXPECT_EQ(wrong, 0) << "gamma " << gamma << " dark " << dark_D << " turn " << turned;
                    EXPECT_EQ(twice, 0);
                    // D changes by less than that within a square, but where the lit disc itself is no larger than one.
                    if (gamma < 100 && c.size.y >= 200) {
                        EXPECT_GE(found, 0.7 * dim) << "gamma " << gamma << " dark " << dark_D << " turn " << turned;
                    }
                }
    }
}

TEST(LitPixels, APixelThatMaySeeABodyIsAmongThoseWithBodies)
{
    LitPixels pixels;
    std::mt19937 random{5};
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> part(0, 1);
    for (const Case& c : cases) {
        const CompiledView view = view_of(c.projection, c.size);
        for (int turned = 0; turned < 20; ++turned) {
            std::vector<ShipCap> bodies;
            for (int i = 0; i < 1 + turned % 4; ++i)
                bodies.push_back({glm::normalize(glm::dvec3(normal(random), normal(random), normal(random) - 1)),
                    std::cos(0.3 * part(random) * part(random))});
            pixels.find(*view.cones, glm::dmat3(1), 1, 0, 0.02, bodies);
            const std::vector<int> lit = covered(pixels.lit, c.size), with = covered(pixels.with_bodies, c.size);
            EXPECT_TRUE(pixels.dark.empty());
            long missed = 0, far = 0, spared = 0;
            for (int y = 0; y < c.size.y; ++y)
                for (int x = 0; x < c.size.x; ++x) {
                    const std::size_t i = std::size_t(y) * c.size.x + x;
                    const auto n = direction(view.view.picture, {x + 0.5, y + 0.5});
                    if (!n)
                        continue;
                    // The shader's own test, which passes a body by.
                    const double angle = pixel_angle(view.view.picture, {x + 0.5, y + 0.5});
                    bool sees = false, near = false;
                    for (const ShipCap& body : bodies) {
                        sees = sees || glm::dot(*n, body.axis) >= body.least_cos - 4 * angle - 1e-6;
                        near = near
                            || std::acos(glm::clamp(glm::dot(*n, body.axis), -1.0, 1.0)) < std::acos(body.least_cos) + 0.9;
                    }
                    missed += sees ? with[i] != 1 : lit[i] + with[i] != 1;
                    far += !near, spared += !near && lit[i] == 1;
                }
            EXPECT_EQ(missed, 0) << turned;
            EXPECT_GE(spared, c.size.y > 200 ? 0.8 * far : 0.0) << turned;
        }
    }
    const ShipCap everywhere{{0, 0, 1}, -2};
    const CompiledView view = view_of(Planar{60}, {64, 48});
    pixels.find(*view.cones, glm::dmat3(1), 1, 0, 0.02, {&everywhere, 1});
    EXPECT_TRUE(pixels.lit.empty());
}

TEST(LitPixels, ACirclesCornersAreInNeither)
{
    LitPixels pixels;
    const glm::ivec2 size(512, 512);
    const CompiledView view = view_of(Fisheye{180, 0}, size);
    pixels.find(*view.cones, glm::dmat3(1), 1, 0, 0.02);
    EXPECT_TRUE(pixels.dark.empty());
    long drawn = 0;
    for (const PixelRect& rect : pixels.lit)
        drawn += long(rect.high.x - rect.low.x) * (rect.high.y - rect.low.y);
    EXPECT_GT(drawn, 0.785 * size.x * size.y);
    EXPECT_LT(drawn, 0.84 * size.x * size.y);
    // Rows of squares, and few more where runs are equally wide.
    EXPECT_LE(pixels.lit.size(), 32u);
}

} // namespace lit_pixels_test
