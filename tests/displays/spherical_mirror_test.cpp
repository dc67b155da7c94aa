#include "displays/projections/picture.h"
#include "tests/support/sphere.h"

namespace spherical_mirror_test {

using namespace starbow;
using namespace sphere;

namespace {

/// The point at which a ray leaves a sphere: the larger root of |from + s way - centre|² = radius².
glm::dvec3 leaves(const glm::dvec3& from, const glm::dvec3& way, const glm::dvec3& centre, double radius)
{
    const long double a = glm::dot(way, way), b = 2 * glm::dot(way, from - centre);
    const long double c = glm::dot(from - centre, from - centre) - radius * radius;
    return from + double((-b + std::sqrt(b * b - 4 * a * c)) / (2 * a)) * way;
}

/// The point of reflection on the way from p to q: Fermat's shortest way over the sphere, by a finer and finer search.
glm::dvec3 shortest_way(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& centre, double radius)
{
    glm::dvec3 normal = glm::normalize(glm::normalize(p - centre) + glm::normalize(q - centre));
    const auto length = [&](const glm::dvec3& n) {
        const glm::dvec3 at = centre + radius * glm::normalize(n);
        return glm::distance(p, at) + glm::distance(at, q);
    };
    for (double step = 0.5; step > 1e-10; step /= 2)
        for (bool better = true; better;) {
            better = false;
            const glm::dvec3 x = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.5, 0.8))), y = glm::cross(normal, x);
            for (const glm::dvec3& way : {x, -x, y, -y})
                if (length(normal + step * way) < length(normal)) {
                    normal = glm::normalize(normal + step * way);
                    better = true;
                    break;
                }
        }
    return centre + radius * normal;
}

} // namespace

TEST(SphericalMirrorTest, FollowsTheClosedFormAboutOneCentre)
{
    // Mirror, dome and eye share the origin, and the lens looks at it from (0, 0, p). A ray at the angle a to the axis
    // passes the centre at b = p sin(a). It meets the mirror at asin(b/R) - a from the axis with the angle asin(b/R) to the
    // normal, and the dome with the angle asin(b/D). So it lands at 2 asin(b/R) - a - asin(b/D) from the axis, on its own
    // side.
    SphericalMirror mirror;
    mirror.projector_m = {0, 0, 2};
    mirror.projector = Planar{30};
    mirror.mirror_radius_m = 0.5;
    mirror.dome_radius_m = 3;
    mirror.dome_aperture_deg = 360;
    const PictureRays rays(Picture{mirror, {1000, 1000}});
    const double step = std::tan(15 * pi / 180) / 500;
    expect_near(rays.direction({500, 500}), {0, 0, 1});
    for (double way = 0; way < 6.3; way += 0.7)
        for (double pixels : {0.001, 1., 100., 300., 400., 470.}) {
            const double a = std::atan(pixels * step), b = 2 * std::sin(a);
            const double place = 2 * std::asin(b / 0.5) - a - std::asin(b / 3);
            const glm::dvec3 seen(std::sin(place) * std::cos(way), -std::sin(place) * std::sin(way), std::cos(place));
            const glm::dvec2 point(500 + pixels * std::cos(way), 500 + pixels * std::sin(way));
            expect_near(rays.direction(point), seen, 1e-12);
            expect_at(rays.pixel(seen), point);
        }
    // The limb is at b = R.
    const double limb = std::tan(std::asin(0.25)) / step;
    EXPECT_TRUE(rays.direction({500 + limb - 1e-6, 500}));
    EXPECT_FALSE(rays.direction({500 + limb + 1e-6, 500}));
    EXPECT_EQ(rays.pixel_angle({500 + limb + 1e-6, 500}), 0);
    EXPECT_LE(rays.pixel_angle({500 + limb - 1e-9, 500}), std::sqrt(2 * pi));
    // The mirror's shadow lies beyond: light that grazes it, with asin(b/R) = 90 degrees, lands at 180 - a - asin(b/D)
    // degrees.
    const double last = pi - std::asin(0.25) - std::asin(0.5 / 3);
    EXPECT_TRUE(rays.pixel({std::sin(last - 1e-6), 0, std::cos(last - 1e-6)}));
    EXPECT_FALSE(rays.pixel({std::sin(last + 1e-6), 0, std::cos(last + 1e-6)}));
    EXPECT_FALSE(rays.pixel({0, 0, -1}));
}

TEST(SphericalMirrorTest, TheDomesRimIsLitAndNothingBelowIt)
{
    SphericalMirror mirror;
    mirror.projector_m = {0, 0, 2};
    mirror.projector = Planar{30};
    mirror.mirror_radius_m = 0.5;
    mirror.dome_m = {0, 0, 0};
    mirror.dome_radius_m = 3;
    int lit = 0, rounded_below = 0;
    for (const double aperture_deg : {120.0, 165.0, 180.0, 200.0})
        for (const double tilt_deg : {0.0, 17.0})
            for (const glm::dvec3& eye : {glm::dvec3(0), glm::dvec3(0.3, -0.2, 0.5)}) {
                mirror.dome_aperture_deg = aperture_deg, mirror.dome_tilt_deg = tilt_deg;
                const PictureRays rays(Picture{mirror, {1000, 1000}, eye});
                // The zenith is tilted forward, to -z.
                const double tilt = tilt_deg * pi / 180, half = aperture_deg / 2 * pi / 180;
                const glm::dvec3 zenith(0, std::cos(tilt), -std::sin(tilt)), right(1, 0, 0),
                    back = glm::cross(right, zenith);
                for (double way = 0; way < 6.28; way += 0.01) {
                    const auto at = [&](double from_zenith) {
                        return 3.
                            * (std::cos(from_zenith) * zenith
                                + std::sin(from_zenith) * (std::cos(way) * right + std::sin(way) * back))
                            - eye;
                    };
                    // Above the rim the mirror alone decides; the rim itself is no darker.
                    if (!rays.pixel(at(half - 1e-9)))
                        continue;
                    ++lit;
                    rounded_below += glm::dot(at(half) + eye, zenith) < 3 * std::cos(half);
                    EXPECT_TRUE(rays.pixel(at(half))) << aperture_deg << ' ' << tilt_deg << ' ' << way;
                    EXPECT_FALSE(rays.pixel(at(half + 1e-6))) << aperture_deg << ' ' << tilt_deg << ' ' << way;
                }
            }
    EXPECT_GT(lit, 1000);
    EXPECT_GT(rounded_below, 100) << "rounding leads below the rim in about every second direction";
}

TEST(SphericalMirrorTest, ReflectsLevelLightStraightUp)
{
    // Level light at 1 / sqrt(2) of the radius above the mirror's middle goes straight up to the dome. Two eyes see that
    // place in different directions.
    SphericalMirror mirror;
    const double r = 0.4, up = r * std::sqrt(0.5);
    mirror.mirror_m = {0.5, -1, -1 - up}; // light meets it at z = -1
    mirror.mirror_radius_m = r;
    mirror.projector_m = {0.5, -1 + up, 1};
    mirror.projector = Planar{20};
    mirror.dome_m = {0, 0, 0};
    mirror.dome_radius_m = 5;
    mirror.dome_aperture_deg = 180;
    const glm::dvec3 place(0.5, std::sqrt(25 - 0.25 - 1), -1);
    for (const glm::dvec3& eye : {glm::dvec3(0, 0, 0), glm::dvec3(1, 0.4, 2)}) {
        const Picture picture{mirror, {640, 480}, eye};
        expect_near(direction(picture, {320, 240}), place - eye, 1e-13);
        expect_at(pixel(picture, place - eye), {320, 240});
    }
}

TEST(SphericalMirrorTest, LightTakesTheShortestWayAndReflectsAtEqualAngles)
{
    SphericalMirror mirror;
    mirror.projector_m = {0.1, -0.4, -1.4};
    mirror.projector = Planar{40, Sides{-20, 25, 0, 25}, {3, 8, -2}};
    mirror.mirror_m = {0, -0.1, -2.5};
    mirror.mirror_radius_m = 0.32;
    mirror.dome_m = {0, 0.2, 0};
    mirror.dome_radius_m = 3;
    mirror.dome_tilt_deg = 15;
    const glm::dvec3 eye(0.1, 0.15, 0.2);
    const PictureRays rays(Picture{mirror, {1920, 1080}, eye}), projector(Picture{mirror.projector, {1920, 1080}});
    int compared = 0;
    for (int y = 20; y < 1080; y += 80)
        for (int x = 20; x < 1920; x += 80) {
            const auto seen = rays.direction({x, y});
            if (!seen)
                continue;
            ++compared;
            const glm::dvec3 place = leaves(eye, *seen, mirror.dome_m, mirror.dome_radius_m);
            const glm::dvec3 at = shortest_way(mirror.projector_m, place, mirror.mirror_m, mirror.mirror_radius_m);
            const glm::dvec3 out = glm::normalize(at - mirror.projector_m);
            // A length is flat near its minimum: the tolerance is the root of a rounding.
            expect_near(projector.direction({x, y}), out, 3e-7);
            const glm::dvec3 normal = glm::normalize(at - mirror.mirror_m), on = glm::normalize(place - at);
            EXPECT_NEAR(glm::dot(-out, normal), glm::dot(on, normal), 1e-6);
            EXPECT_NEAR(glm::dot(glm::cross(out, normal), on), 0, 1e-6); // in one plane
        }
    EXPECT_GT(compared, 50);
}

TEST(SphericalMirrorTest, NothingIsShownBeyondTheDome)
{
    SphericalMirror mirror;
    mirror.projector_m = {0, 0, 2};
    mirror.projector = Planar{30};
    mirror.mirror_radius_m = 0.5;
    const auto rim = [&](double aperture, double tilt) {
        mirror.dome_aperture_deg = aperture;
        mirror.dome_tilt_deg = tilt;
        return PictureRays(Picture{mirror, {1000, 1000}});
    };
    const PictureRays level = rim(180, 0);
    EXPECT_TRUE(level.direction({500, 499})); // above the spring line
    EXPECT_FALSE(level.direction({500, 501}));
    EXPECT_TRUE(level.pixel({0, 1e-9, 1}));
    EXPECT_FALSE(level.pixel({0, -1e-9, 1}));
    const PictureRays backward = rim(90, -90); // 45 degrees about straight behind, where the lens is
    EXPECT_TRUE(backward.pixel(towards(180 - 44.9, 0)));
    EXPECT_FALSE(backward.pixel(towards(180 - 45.1, 0)));
    EXPECT_TRUE(backward.direction(backward.pixel(towards(180 - 44.9, 0)).value()));
    // A lens inside the mirror, and one that looks away from it, light nothing.
    mirror.projector_m = {0, 0, 0.4};
    EXPECT_FALSE(rim(360, 0).direction({500, 500}));
    EXPECT_FALSE(rim(360, 0).pixel({0, 0, 1}));
    mirror.projector_m = {0, 0, 2};
    mirror.projector.turn.yaw_deg = 180;
    EXPECT_FALSE(rim(360, 0).direction({500, 500}));
    EXPECT_FALSE(rim(360, 0).pixel({0, 0, 1}));
}

} // namespace spherical_mirror_test
