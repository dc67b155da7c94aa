#include "displays/direction_map.h"
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

using namespace starbow;

namespace {

constexpr double pi = glm::pi<double>();

void expect_near(const std::optional<glm::dvec3>& seen, const glm::dvec3& expected, double tolerance = 1e-14)
{
    ASSERT_TRUE(seen);
    EXPECT_NEAR(glm::distance(*seen, glm::normalize(expected)), 0, tolerance) << seen->x << " " << seen->y << " " << seen->z;
}

struct Case {
    Projection projection;
    glm::ivec2 size;
};

const std::vector<Case> cases{
    {Planar{60}, {800, 600}},
    {Planar{60}, {600, 800}},
    {Planar{0.1}, {33, 17}},
    {Planar{170}, {1920, 1080}},
    {Planar{179}, {101, 100}},
    {Fisheye{180, 0}, {512, 512}},
    {Fisheye{180, 30}, {640, 480}},
    {Fisheye{220, -75}, {480, 640}},
    {Fisheye{360, 90}, {255, 256}},
    {Fisheye{1, 180}, {64, 65}},
};

/// Angle between unit vectors, exact for small ones too.
double angle(const glm::dvec3& a, const glm::dvec3& b) { return 2 * std::asin(glm::distance(a, b) / 2); }

/// Area of a spherical triangle from its sides (L'Huilier).
double triangle_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
    const double x = angle(b, c), y = angle(c, a), z = angle(a, b), s = (x + y + z) / 2;
    const double t = std::tan(s / 2) * std::tan((s - x) / 2) * std::tan((s - y) / 2) * std::tan((s - z) / 2);
    return 4 * std::atan(std::sqrt(std::max(t, 0.0)));
}

/// Solid angle of a pixel as a fan of triangles to points along its edges.
double pixel_area(const Case& c, glm::dvec2 centre)
{
    constexpr int n = 24;
    const glm::dvec2 corners[]{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
    const glm::dvec3 middle = direction(c.projection, c.size, centre).value();
    double sum = 0;
    for (int side = 0; side < 4; ++side)
        for (int i = 0; i < n; ++i) {
            const auto at = [&](int k) {
                return direction(
                    c.projection, c.size, centre + glm::mix(corners[side], corners[(side + 1) % 4], k / double(n)));
            };
            sum += triangle_area(middle, at(i).value(), at(i + 1).value());
        }
    return sum;
}

bool whole_pixel_shown(const Case& c, glm::dvec2 centre)
{
    for (double x : {-0.5, 0.5})
        for (double y : {-0.5, 0.5})
            if (!direction(c.projection, c.size, centre + glm::dvec2(x, y)))
                return false;
    return true;
}

} // namespace

TEST(DirectionMapTest, CornersOfAWindow)
{
    const double t = std::tan(pi / 6);
    const Projection window = Planar{60};
    const glm::ivec2 size(800, 600);
    expect_near(direction(window, size, {400, 300}), {0, 0, -1});
    expect_near(direction(window, size, {0, 0}), {-t * 4 / 3, t, -1});
    expect_near(direction(window, size, {800, 0}), {t * 4 / 3, t, -1});
    expect_near(direction(window, size, {800, 600}), {t * 4 / 3, -t, -1});
    expect_near(direction(window, size, {400, 0}), {0, 0.5, -std::sqrt(0.75)}); // half of 60 degrees up
    EXPECT_NEAR(pixel(window, size, {1, 0, -1})->x, 400 + 300 / t, 1e-9); // beyond the edge, still on the plane
    EXPECT_FALSE(pixel(window, size, {0, 0, 1}));
    EXPECT_FALSE(pixel(window, size, {1, 0, 0}));
    EXPECT_FALSE(pixel(window, size, {1, 0, -1e-310}));
}

TEST(DirectionMapTest, LevelDome)
{
    // Facing the front and looking up, the right hand stays on the right and the front is below the zenith.
    const Projection dome = Fisheye{180, 0};
    const glm::ivec2 size(1000, 1000);
    expect_near(direction(dome, size, {500, 500}), {0, 1, 0});
    expect_near(direction(dome, size, {500, 1000}), {0, 0, -1}); // bottom: straight ahead
    expect_near(direction(dome, size, {1000, 500}), {1, 0, 0}); // right
    expect_near(direction(dome, size, {500, 0}), {0, 0, 1}); // top: behind
    expect_near(direction(dome, size, {0, 500}), {-1, 0, 0});
    expect_near(direction(dome, size, {500, 750}), {0, 1, -1}); // half the radius is half the angle
    EXPECT_FALSE(direction(dome, size, {0, 0}));
    EXPECT_FALSE(direction(dome, size, {500, 1000.001}));
    EXPECT_EQ(pixel_angle(dome, size, {0, 0}), 0);
    EXPECT_FALSE(pixel(dome, size, {0, -1e-6, -1})); // just under the spring line
}

TEST(DirectionMapTest, TheDomePictureIsNotMirrored)
{
    const Projection dome = Fisheye{180, 20};
    const auto at = [&](double x, double y) { return direction(dome, {100, 100}, {x, y}).value(); };
    const glm::dvec3 right = at(51, 50) - at(49, 50), up = at(50, 49) - at(50, 51);
    EXPECT_LT(glm::dot(glm::cross(right, up), at(50, 50)), 0); // as for any picture: right x up comes towards the eye
}

TEST(DirectionMapTest, TiltLeansTheDomeForward)
{
    const glm::ivec2 size(1000, 1000);
    // 90 degrees: the centre straight ahead, up at the top, as in a window.
    const Projection ahead = Fisheye{180, 90};
    expect_near(direction(ahead, size, {500, 500}), {0, 0, -1});
    expect_near(direction(ahead, size, {500, 0}), {0, 1, 0});
    expect_near(direction(ahead, size, {1000, 500}), {1, 0, 0});
    expect_near(direction(ahead, size, {500, 1000}), {0, -1, 0});
    // 30 degrees: the front rim sinks 30 degrees under straight ahead, the back rim rises, the sides stay.
    const Projection leaning = Fisheye{180, 30};
    const double c = std::sqrt(0.75);
    expect_near(direction(leaning, size, {500, 500}), {0, c, -0.5});
    expect_near(direction(leaning, size, {500, 1000}), {0, -0.5, -c});
    expect_near(direction(leaning, size, {500, 0}), {0, 0.5, c});
    expect_near(direction(leaning, size, {0, 500}), {-1, 0, 0});
    // Backwards: straight behind.
    expect_near(direction(Fisheye{180, -90}, size, {500, 500}), {0, 0, 1});
}

TEST(DirectionMapTest, TheRimIsHalfTheAperture)
{
    for (double aperture : {1., 90., 180., 220., 300., 359.})
        for (double tilt : {0., 30., 90., -120.})
            for (int i = 0; i < 12; ++i) {
                const Projection dome = Fisheye{aperture, tilt};
                const glm::ivec2 size(640, 480); // the circle fits the shorter side, in the middle
                const double way = i * pi / 6;
                const glm::dvec2 rim = glm::dvec2(320, 240) + 239.999999 * glm::dvec2(std::cos(way), std::sin(way));
                const glm::dvec3 zenith = direction(dome, size, {320, 240}).value();
                const double seen = std::acos(glm::dot(zenith, direction(dome, size, rim).value()));
                EXPECT_NEAR(glm::degrees(seen), aperture / 2, 1e-5);
            }
    EXPECT_FALSE(direction(Fisheye{180, 0}, {640, 480}, {79, 240})); // left of the circle
}

TEST(DirectionMapTest, PixelAndDirectionAreInverse)
{
    for (const Case& c : cases)
        for (int j = 0; j <= 24; ++j)
            for (int i = 0; i <= 24; ++i) {
                const glm::dvec2 point(c.size.x * i / 24., c.size.y * j / 24.);
                const auto seen = direction(c.projection, c.size, point);
                if (!seen)
                    continue;
                EXPECT_NEAR(glm::length(*seen), 1, 1e-15);
                // A whole sphere's rim is one point, the way to which no direction tells.
                if (c.size == glm::ivec2(255, 256) && glm::distance(point, glm::dvec2(127.5, 128)) > 127.4)
                    continue;
                const auto back = pixel(c.projection, c.size, *seen);
                ASSERT_TRUE(back) << point.x << " " << point.y;
                EXPECT_NEAR(glm::distance(*back, point), 0, 1e-9) << c.size.x << ": " << point.x << " " << point.y;
                const auto of_longer = pixel(c.projection, c.size, *seen * 1e6);
                EXPECT_NEAR(glm::distance(*of_longer, point), 0, 1e-9);
            }
}

TEST(DirectionMapTest, DirectionAndPixelAreInverse)
{
    for (const Case& c : cases)
        for (int i = 0; i < 2000; ++i) { // a spiral of directions over the sphere
            const double z = 1 - (2 * i + 1) / 2000., r = std::sqrt(1 - z * z), way = i * 2.399963229728653;
            const glm::dvec3 d(r * std::cos(way), r * std::sin(way), z);
            const auto point = pixel(c.projection, c.size, d);
            if (!point || std::abs(point->x) > 1e5 || std::abs(point->y) > 1e5)
                continue;
            expect_near(direction(c.projection, c.size, *point), d, 1e-12);
        }
}

TEST(DirectionMapTest, WholeSphereShowsEveryDirection)
{
    for (const glm::dvec3& d : {glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1), glm::dvec3(0, -1, 0), glm::dvec3(0, 1, 0)})
        for (double tilt : {0., 90., -90., 180.}) {
            const Projection dome = Fisheye{360, tilt};
            const auto point = pixel(dome, {100, 100}, d);
            ASSERT_TRUE(point);
            expect_near(direction(dome, {100, 100}, *point), d);
        }
}

TEST(DirectionMapTest, PlanarMatrixIsTheDirection)
{
    for (const Case& c : cases) {
        const auto matrix = planar_matrix(c.projection, c.size);
        ASSERT_EQ(matrix.has_value(), std::holds_alternative<Planar>(c.projection));
        if (matrix)
            for (const glm::dvec2& p : {glm::dvec2(0, 0), glm::dvec2(c.size), glm::dvec2(3.5, 7.25)})
                expect_near(direction(c.projection, c.size, p), *matrix * glm::dvec3(p, 1));
    }
}

TEST(DirectionMapTest, PixelAngleIsTheRootOfTheSolidAngle)
{
    for (const Case& c : cases)
        for (int j = 0; j < 12; ++j)
            for (int i = 0; i < 12; ++i) {
                const glm::dvec2 centre = glm::floor(glm::dvec2(c.size) * glm::dvec2(i, j) / 11.99) + 0.5;
                if (!whole_pixel_shown(c, centre))
                    continue;
                double tolerance = 1e-6; // the triangles' rounding, worst for the smallest pixels
                if (const Fisheye* dome = std::get_if<Fisheye>(&c.projection)) {
                    // The dome's is taken at the centre alone; dome.h states how far.
                    const double step = glm::radians(dome->aperture_deg) / std::min(c.size.x, c.size.y);
                    if (step * glm::distance(centre, glm::dvec2(c.size) * 0.5) > glm::radians(170.))
                        continue;
                    tolerance += step * step / 10;
                }
                const double expected = pixel_area(c, centre), angle = pixel_angle(c.projection, c.size, centre);
                EXPECT_NEAR(angle * angle / expected, 1, tolerance) << c.size.x << ": " << centre.x << " " << centre.y;
            }
}

TEST(DirectionMapTest, PixelsOfAWindowFillIt)
{
    for (const Case& c : cases) {
        const Planar* planar = std::get_if<Planar>(&c.projection);
        if (!planar)
            continue;
        double sum = 0;
        for (int y = 0; y < c.size.y; ++y)
            for (int x = 0; x < c.size.x; ++x)
                sum += std::pow(pixel_angle(c.projection, c.size, {x + 0.5, y + 0.5}), 2);
        // The solid angle of a pyramid of half extents w, h at distance 1.
        const double h = std::tan(glm::radians(planar->fov_y_deg) / 2), w = h * c.size.x / c.size.y;
        const double whole = 4 * std::asin(w * h / std::sqrt((1 + w * w) * (1 + h * h)));
        EXPECT_NEAR(sum / whole, 1, 1e-11);
    }
}

TEST(DirectionMapTest, PixelsOfADomeFillIt)
{
    for (double aperture : {90., 180., 270., 360.})
        for (int across : {256, 511, 1024}) {
            const Projection dome = Fisheye{aperture, 25};
            double sum = 0;
            for (int y = 0; y < across; ++y)
                for (int x = 0; x < across; ++x)
                    sum += std::pow(pixel_angle(dome, {across, across}, {x + 0.5, y + 0.5}), 2);
            // Whole pixels stand for a round rim: of pi * across rim pixels, each in or out, about the root is wrong, each
            // worth 4 / pi / across^2 of the circle.
            const double bound = std::sqrt(pi * across) * 4 / pi / across / across;
            EXPECT_NEAR(sum / (2 * pi * (1 - std::cos(glm::radians(aperture) / 2))), 1, bound) << aperture << " " << across;
        }
}

TEST(DirectionMapTest, TheWholeSpheresRimHasASize)
{
    const Projection sphere = Fisheye{360, 0};
    for (double x : {0.0, 0.25, 0.5, 1.0})
        EXPECT_GT(pixel_angle(sphere, {512, 512}, {x, 256}), 1e-5);
}

TEST(DirectionMapTest, CompiledMapsAreTheFunctions)
{
    for (const Case& c : cases) {
        const DirectionMap map = compile(c.projection, c.size), again = compile(c.projection, c.size);
        ASSERT_EQ(map.size, c.size);
        ASSERT_EQ(map.texels.size(), std::size_t(c.size.x) * c.size.y);
        EXPECT_EQ(map.texels, again.texels);
        for (int y = 0; y < c.size.y; y += 3)
            for (int x = 0; x < c.size.x; x += 7) {
                const glm::dvec2 centre(x + 0.5, y + 0.5);
                const auto seen = direction(c.projection, c.size, centre);
                const glm::vec4 texel = map.texels[std::size_t(y) * c.size.x + x];
                ASSERT_EQ(
                    texel, seen ? glm::vec4(glm::dvec4(*seen, pixel_angle(c.projection, c.size, centre))) : glm::vec4(0));
                ASSERT_TRUE(!seen || texel.w > 0);
            }
    }
}

TEST(DirectionMapTest, SmallestMaps)
{
    EXPECT_NEAR(compile(Planar{60}, {1, 1}).texels.at(0).z, -1, 1e-7);
    EXPECT_EQ(compile(Fisheye{180, 0}, {1, 3}).texels.at(0), glm::vec4(0));
    EXPECT_NEAR(compile(Fisheye{180, 0}, {1, 3}).texels.at(1).y, 1, 1e-7);
}
