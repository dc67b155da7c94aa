// The numbers of a still (docs/files.md) against closed formulas and rays in 33 digits: distances on a floor at any speed,
// the outlines of a moving body, and small triangles straight behind.
#include "config/model/angles.h"
#include "tests/support/quad.h"
#include "tests/support/small_world.h"

namespace starbow::gpu_test::numbers_gpu_test {
namespace {

constexpr double fov_y_deg = 60;

/// The numbers as `starbow render --exr` writes them.
Numbers numbers_of_still(const GpuWorld& world, ivec2 size, const Shot& shot)
{
    OffscreenRenderer offscreen(device(), pipelines(), world, one_view(Planar{fov_y_deg}, size),
        measured_quality(default_quality(device(), true)), true);
    return {offscreen, shot};
}

/// The ship's direction that a point of the picture shows, by a pinhole.
quad::V3 ship_direction(const Shot& shot, ivec2 size, const dvec2& pixel)
{
    const double tangent = std::tan(0.5 * fov_y_deg * degree) * 2 / size.y;
    const dvec2 at = tangent * (pixel - 0.5 * dvec2(size));
    const glm::dquat& q = shot.ship_from_cockpit;
    return quad::turned({q.x, q.y, q.z, q.w}, quad::unit({at.x, -at.y, -1}));
}

quad::V3 world_direction(const Shot& shot, ivec2 size, const dvec2& pixel)
{
    return quad::world_from_camera(ship_direction(shot, size, pixel), quad::of(shot.u)).n;
}

int material_of_two_sides(Doc& doc)
{
    const int material = unlit(doc, {0.5, 0.5, 0.5});
    doc.json["materials"][std::size_t(material)]["doubleSided"] = true;
    return material;
}

} // namespace

/// A floor below the eye that ends at `half` along either axis.
GpuWorld floor_world(double half)
{
    Doc doc;
    quad(doc, {0, -1, 0}, {half, 0, 0}, {0, 0, -half}, material_of_two_sides(doc));
    return open_world("floor", doc);
}

TEST(NumbersGpuTest, DistancesToAFloorAreRightAtEverySpeed)
{
    // At high speed nearly every pixel looks back and down, where the floor is 5 away.
    const GpuWorld wide = floor_world(1000), narrow = floor_world(30);
    const ivec2 size(96, 72);
    const dvec3 oblique = glm::normalize(dvec3(0.3, 0.2, -1));
    for (double gamma : {1.0, 1.1, 4.0, 100.0, 1e4, 1e6}) // at 1.1 the cube map has the cockpit's axes
        for (const dvec3& look : {dvec3(0.1, -0.3, -1), dvec3(-0.3, -0.2, 1)}) {
            const Shot shot = shot_at({0, 0, 0}, u_of_gamma(gamma) * oblique, look);
            const double half = gamma > 100 ? 30 : 1000;
            const Numbers numbers = numbers_of_still(gamma > 100 ? narrow : wide, size, shot);
            // Up to 500 away and not beside the floor's end.
            std::vector<double> height; // of each pixel's direction; 0 beyond the floor
            for (int i = 0; i < numbers.count(); ++i) {
                const quad::V3 n = world_direction(shot, size, numbers.centre(i));
                const bool on = -n.y > 1.0 / 500 && fabsq(n.x) < -n.y * half && fabsq(n.z) < -n.y * half;
                height.push_back(on ? double(n.y) : 0);
            }
            int floor = 0, off = 0;
            double worst = 0;
            for (int i = size.x + 1; i < numbers.count() - size.x - 1; ++i) {
                const auto at = std::size_t(i), row = std::size_t(size.x);
                if (std::max({height[at], height[at - 1], height[at + 1], height[at - row], height[at + row]}) == 0)
                    continue;
                ++floor;
                const double wrong = std::abs(numbers.depth(i) * -height[at] - 1);
                off += !(wrong < 1e-3);
                worst = std::max(worst, wrong);
            }
            std::printf("  gamma %g: %d of %d pixels off by more than 1e-3, the worst by %.2g\n", gamma, off, floor, worst);
            EXPECT_GT(floor, 3000) << gamma;
            // Ahead at high speed a pixel beside the axis spans much of the world.
            EXPECT_LE(off, gamma > 4 ? floor / 100 : 0) << gamma;
        }
}

// Two triangles that are millions of texels wide fill images of a few hundred texels to their edges.
TEST(NumbersGpuTest, AWideFloorHasNoGapsAtHighSpeed)
{
    const GpuWorld world = floor_world(2000);
    const dvec3 oblique = glm::normalize(dvec3(0.3, 0.2, -1));
    for (double gamma : {1e4, 3e4}) {
        const Numbers numbers
            = numbers_of_still(world, {200, 150}, shot_at({0, 0, 0}, u_of_gamma(gamma) * oblique, {0.1, -0.3, -1}));
        int gaps = 0;
        for (int i = 0; i < numbers.count(); ++i)
            gaps += !std::isfinite(numbers.depth(i));
        EXPECT_EQ(gaps, 0) << gamma; // the whole view looks back, but for the axis, where no pixel's middle lies
    }
}

// The part across the motion tells neighbouring pixels apart straight behind, where 32-bit directions in the world are
// alike.
TEST(NumbersGpuTest, ThePartAcrossTheMotionIsExactStraightBehind)
{
    const GpuWorld world = floor_world(1000);
    const ivec2 size(80, 60);
    const dvec3 way = glm::normalize(dvec3(0.3, 0.2, -1));
    for (double gamma : {1.0, 1.1, 4.0, 500.0, 1e4, 1e6}) { // at 1.1 the cube map has the cockpit's axes
        const Shot shot = shot_at({0, 0, 0}, u_of_gamma(gamma) * way, -way);
        const Numbers numbers = numbers_of_still(world, size, shot);
        const auto &x = numbers.channel("worldAcross.X"), &y = numbers.channel("worldAcross.Y"),
                   &z = numbers.channel("worldAcross.Z");
        double worst_px = 0;
        for (int i = 0; i < numbers.count(); ++i) {
            const quad::V3 n = world_direction(shot, size, numbers.centre(i));
            const quad::V3 next = world_direction(shot, size, numbers.centre(i) + dvec2(1, 0));
            const quad::V3 ahead = gamma > 1 ? quad::unit(quad::of(shot.u)) : quad::V3{0, 0, 0};
            const quad::V3 across = n - ahead * quad::dot(n, ahead);
            const dvec3 found(x[std::size_t(i)], y[std::size_t(i)], z[std::size_t(i)]);
            worst_px = std::max(worst_px, double(quad::length(quad::of(found) - across) / quad::length(next - n)));
        }
        // A direction on board is right to 1.5e-7 rad, of which a pixel has 0.02.
        EXPECT_LT(worst_px, 5e-5) << gamma;
    }
}

// A pixel belongs to the body if its middle does; where it says otherwise, the outline passes within half a pixel.
TEST(NumbersGpuTest, OutlinesOfAMovingBodyLieWithinHalfAPixel)
{
    Doc doc;
    const dvec3 right = dvec3(2, 0.5, 0.3), up = dvec3(-0.2, 1.5, 0.4);
    quad(doc, {0, 0, 0}, right, up, material_of_two_sides(doc), {{"name", "plate"}});
    const dvec3 u = u_of_beta(0.5) * glm::normalize(dvec3(1, 0.2, 0.1)), place(-3, 0, -6);
    const Json bodies = {{{"name", "plate"}, {"nodes", {"plate"}},
        {"velocity", {{"direction", {u.x, u.y, u.z}}, {"beta", 0.5}}}, {"at", {{"time", 0}, {"position", {-3, 0, -6}}}}}};
    const GpuWorld world = open_world("plate", doc, {{"bodies", bodies}});
    const ivec2 size(240, 180);
    Shot shot = shot_at({0, 0, 0}, {0, 0.1, -u_of_beta(0.4)}, {-0.4, 0, -1});
    shot.time = 1;
    const Numbers numbers = numbers_of_still(world, size, shot);
    // The eye's place in the body's frame, and whether a ray from there meets the plate.
    const quad::V3 eye = quad::boosted(quad::of(u) * -1, {shot.time, quad::of(shot.position - place)}).x;
    const quad::V3 front = quad::cross(quad::of(right), quad::of(up));
    const auto meets = [&](const dvec2& pixel) {
        const quad::V3 n = quad::camera_from_world(world_direction(shot, size, pixel), quad::of(u)).n;
        const quad::Q far = -quad::dot(front, eye) / quad::dot(front, n);
        const quad::V3 at = eye + n * far;
        // In units of the sides, which are oblique.
        const quad::Q a = quad::dot(quad::cross(at, quad::of(up)), front) / quad::dot(front, front),
                      b = quad::dot(quad::cross(quad::of(right), at), front) / quad::dot(front, front);
        return far > 0 && a > -1 && a < 1 && b > -1 && b < 1;
    };
    int inside = 0, off = 0;
    for (int i = 0; i < numbers.count(); ++i) {
        const bool body = std::isfinite(numbers.depth(i));
        inside += body;
        if (body == meets(numbers.centre(i)))
            continue;
        bool near = false;
        for (int k = 0; k < 16; ++k)
            near = near || body == meets(numbers.centre(i) + 0.5 * dvec2(std::cos(k * pi / 8), std::sin(k * pi / 8)));
        off += !near;
    }
    EXPECT_GT(inside, 1000);
    EXPECT_EQ(off, 0);
}

} // namespace starbow::gpu_test::numbers_gpu_test
