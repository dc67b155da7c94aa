#include "displays/projections/picture.h"
#include "tests/support/sphere.h"

namespace flat_picture_test {

using namespace starbow;
using namespace sphere;

TEST(FlatPictureTest, AWindowsCornersHaveTheirDirections)
{
    const double t = std::tan(pi / 6);
    const Picture window{Planar{60}, {800, 600}};
    expect_near(direction(window, {400, 300}), {0, 0, -1});
    expect_near(direction(window, {0, 0}), {-t * 4 / 3, t, -1});
    expect_near(direction(window, {800, 0}), {t * 4 / 3, t, -1});
    expect_near(direction(window, {800, 600}), {t * 4 / 3, -t, -1});
    expect_near(direction(window, {400, 0}), {0, 0.5, -std::sqrt(0.75)}); // half of 60 degrees up
    EXPECT_NEAR(pixel(window, {1, 0, -1})->x, 400 + 300 / t, 1e-9); // beyond the edge, still on the plane
    EXPECT_FALSE(pixel(window, {0, 0, 1}));
    EXPECT_FALSE(pixel(window, {1, 0, 0}));
    EXPECT_FALSE(pixel(window, {1, 0, -1e-310}));
}

TEST(FlatPictureTest, SidesAreAngles)
{
    const Picture window{Planar{60, Sides{-45, 30, -60, 0}}, {500, 300}};
    const double t30 = 1 / std::sqrt(3.), t60 = std::sqrt(3.);
    expect_near(direction(window, {0, 0}), {-1, 0, -1});
    expect_near(direction(window, {500, 0}), {t30, 0, -1});
    expect_near(direction(window, {0, 300}), {-1, -t60, -1});
    expect_near(direction(window, {500, 300}), {t30, -t60, -1});
    expect_near(direction(window, {250, 150}), {(t30 - 1) / 2, -t60 / 2, -1});
    const Picture beside{Planar{60, Sides{30, 60, -60, -30}}, {200, 200}}; // the view does not contain straight ahead
    expect_near(direction(beside, {0, 0}), {t30, -t30, -1});
    expect_near(direction(beside, {200, 200}), {t60, -t60, -1});
}

TEST(FlatPictureTest, TurnsAreYawThenPitchThenRoll)
{
    const auto window = [](Turn turn) { return Picture{Planar{90, {}, turn}, {200, 200}}; };
    const glm::dvec2 middle(100, 100), top(100, 0), right(200, 100);
    expect_near(direction(window({90, 0, 0}), middle), {1, 0, 0}); // to the right
    expect_near(direction(window({90, 0, 0}), right), {1, 0, 1});
    expect_near(direction(window({0, 90, 0}), middle), {0, 1, 0}); // up
    expect_near(direction(window({0, 90, 0}), top), {0, 1, 1}); // and the direction behind is above it
    expect_near(direction(window({0, 0, 90}), top), {1, 0, -1}); // the upper edge leans to the right
    expect_near(direction(window({0, 0, 90}), right), {0, -1, -1});
    expect_near(direction(window({30, 20, 0}), middle), towards(30, 20)); // yaw, then pitch
    expect_near(
        direction(window({90, 45, 90}), right), glm::dvec3(1, 1, 0) / std::sqrt(2.) - glm::dvec3(-1, 1, 0) / std::sqrt(2.));
}

TEST(FlatPictureTest, ACaveClosesAtItsCorners)
{
    // The front wall, the right wall and the floor of a cube of 2 m about the origin, for eyes anywhere inside.
    const glm::ivec2 size(1000, 1000);
    const Wall front{{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}}, right{{1, -1, -1}, {1, -1, 1}, {1, 1, -1}},
        floor{{-1, -1, 1}, {1, -1, 1}, {-1, -1, -1}};
    for (const glm::dvec3& eye : {glm::dvec3(0), glm::dvec3(0.3, -0.4, 0.5), glm::dvec3(-0.9, 0.9, 0.99)}) {
        const Picture a{front, size, eye}, b{right, size, eye}, c{floor, size, eye};
        expect_near(direction(a, {0, 0}), glm::dvec3(-1, 1, -1) - eye);
        expect_near(direction(a, {1000, 0}), glm::dvec3(1, 1, -1) - eye);
        expect_near(direction(a, {0, 1000}), glm::dvec3(-1, -1, -1) - eye);
        expect_near(direction(a, {1000, 1000}), glm::dvec3(1, -1, -1) - eye);
        expect_near(direction(a, {500, 250}), glm::dvec3(0, 0.5, -1) - eye);
        expect_near(direction(b, {0, 1000}), glm::dvec3(1, -1, -1) - eye); // the same corner
        expect_near(direction(b, {1000, 0}), glm::dvec3(1, 1, 1) - eye);
        expect_near(direction(c, {1000, 0}), glm::dvec3(1, -1, -1) - eye);
        expect_near(direction(c, {0, 1000}), glm::dvec3(-1, -1, 1) - eye);
        expect_at(pixel(b, glm::dvec3(1, 0, 0) - eye), {500, 500});
        // Both walls show a point of their common edge at the same height; beyond it, it lies in one picture only.
        const glm::dvec3 on_edge = glm::dvec3(1, 0.37, -1) - eye;
        expect_at(pixel(a, on_edge), {1000, 315});
        expect_at(pixel(b, on_edge), {0, 315});
    }
}

TEST(FlatPictureTest, AWallIsAWindowWithSides)
{
    // 3 m wide and 2 m high, 2 m away. The eye is 0.5 m right of and 0.3 m below its middle.
    const Picture wall{Wall{{-1.5, 0, -2}, {1.5, 0, -2}, {-1.5, 2, -2}}, {600, 400}, {0.5, 0.7, 0}};
    const auto deg = [](double tangent) { return std::atan(tangent) * 180 / pi; };
    const Picture window{Planar{0, Sides{deg(-2 / 2.), deg(1 / 2.), deg(-0.7 / 2), deg(1.3 / 2)}}, {600, 400}};
    for (const glm::dvec2& p : {glm::dvec2(0, 0), glm::dvec2(600, 0), glm::dvec2(123, 321), glm::dvec2(600, 400)}) {
        expect_near(direction(wall, p), direction(window, p).value());
        EXPECT_NEAR(pixel_angle(wall, p) / pixel_angle(window, p), 1, 1e-12);
    }
}

TEST(FlatPictureTest, AWallShowsNothingFromBehind)
{
    const Wall wall{{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}};
    for (const glm::dvec3& eye : {glm::dvec3(0, 0, -1), glm::dvec3(0, 0, -1.001), glm::dvec3(0.3, 0.2, -5),
             glm::dvec3(5, 0, -1), glm::dvec3(0, 0, -1 + 1e-12)}) {
        const Picture picture{wall, {100, 100}, eye};
        EXPECT_FALSE(direction(picture, {50, 50}));
        EXPECT_FALSE(pixel(picture, {0, 0, -1}));
        EXPECT_FALSE(pixel(picture, {0, 0, 1}));
        EXPECT_FALSE(planar_matrix(picture));
        EXPECT_EQ(pixel_angle(picture, {50, 50}), 0);
    }
    // A millimetre in front of the wall, it covers almost half of the sphere.
    const Picture close{wall, {100, 100}, {0, 0, -0.999}};
    double sum = 0;
    for (int i = 0; i < 10000; ++i)
        sum += std::pow(pixel_angle(close, {i % 100 + 0.5, i / 100 + 0.5}), 2);
    // The rest is beyond a square's edge 1000 distances away: 4 sqrt(2) / 1000.
    EXPECT_NEAR(sum, 2 * pi - 4 * std::sqrt(2.) / 1000, 1e-5);
    EXPECT_FALSE(direction(Picture{Wall{{0, 0, -1}, {1, 0, -1}, {2, 0, -1}}, {100, 100}}, {1, 1})); // a line is no wall
}

} // namespace flat_picture_test
