#include "displays/projections/picture.h"
#include "tests/support/sphere.h"

namespace panorama_test {

using namespace starbow;
using namespace sphere;

TEST(PanoramaTest, AnEquirectangularPictureIsLinearInDegrees)
{
    const Picture all{Equirectangular{}, {360, 180}}; // one pixel for each degree
    for (int azimuth = -179; azimuth < 180; azimuth += 7)
        for (int elevation = -89; elevation < 90; elevation += 7) {
            const glm::dvec2 point(180 + azimuth, 90 - elevation);
            expect_near(direction(all, point), towards(azimuth, elevation));
            expect_at(pixel(all, towards(azimuth, elevation)), point);
        }
    for (double x : {0., 100., 360.}) {
        expect_near(direction(all, {x, 0}), {0, 1, 0});
        expect_near(direction(all, {x, 180}), {0, -1, 0});
    }
    EXPECT_FALSE(direction(all, {10, -0.001}));
    EXPECT_FALSE(direction(all, {10, 180.001}));
    EXPECT_EQ(pixel_angle(all, {10, -0.001}), 0);
    EXPECT_GT(pixel_angle(all, {10, 0}), 0);
    const Picture part{Equirectangular{{-30, 60, -10, 50}, {45, 0, 0}}, {90, 60}};
    expect_near(direction(part, {30, 50}), towards(45, 0));
    expect_near(direction(part, {90, 0}), towards(105, 50));
    expect_at(pixel(part, towards(10, 0)), {-5, 50}); // beside the left edge, not around the sphere
    expect_at(pixel(part, towards(115, 0)), {100, 50});
}

TEST(PanoramaTest, APolesRowHasTheCapsSolidAngleAndIsFoundInItsMiddle)
{
    // On a pole itself the angle is that of the last half pixel: a cap, which the columns share.
    for (const glm::ivec2& size : {glm::ivec2(360, 180), {64, 32}, {1000, 50}}) {
        const Picture all{Equirectangular{}, size};
        const double half_row = pi / size.y / 2;
        for (const double y : {0.0, double(size.y)}) {
            const double share = 2 * pi * (1 - std::cos(half_row)) / size.x / 0.5;
            // The code multiplies the mean width by the height; the cap's curvature is left out.
            EXPECT_NEAR(pixel_angle(all, {10, y}) / std::sqrt(share), 1, half_row * half_row) << size.y << " at " << y;
        }
        // The row of whole pixels is a cap of twice the angle.
        const double cap = 2 * pi * (1 - std::cos(2 * half_row)) / size.x;
        EXPECT_NEAR(pixel_angle(all, {10, 0.5}) / std::sqrt(cap), 1, 1e-9) << size.y;
        expect_at(pixel(all, {0, 1, 0}), {size.x / 2.0, 0});
        expect_at(pixel(all, {0, -1, 0}), {size.x / 2.0, size.y});
    }
}

TEST(PanoramaTest, ACylinderKeepsPlumbLines)
{
    const Picture all{Cylinder{{-180, 180, -45, 45}}, {720, 200}};
    expect_near(direction(all, {360, 100}), {0, 0, -1});
    expect_near(direction(all, {540, 100}), {1, 0, 0});
    expect_near(direction(all, {360, 0}), {0, 1, -1}); // 45 degrees up is as high as the wall is far
    expect_near(direction(all, {360, 50}), {0, 0.5, -1}); // half as high, not half the angle
    expect_near(direction(all, {180, 150}), {-1, -0.5, 0});
    expect_near(direction(all, {0, 100}), {0, 0, 1});
    expect_at(pixel(all, {0, 3, -1}), {360, -200});
    EXPECT_FALSE(pixel(all, {0, 1, 0}));
    EXPECT_FALSE(pixel(all, {0, -1, 0}));
    const Picture part{Cylinder{{-60, 60, -30, 60}, {0, 90, 0}}, {120, 100}};
    const double up = std::sqrt(3.), down = 1 / std::sqrt(3.);
    expect_at(pixel(part, {0, 1, 0}), {60, 100 * up / (up + down)}); // its front looks up
    expect_near(direction(part, {60, 100}), glm::dvec3(0, 1, 0) + down * glm::dvec3(0, 0, -1));
}

TEST(PanoramaTest, CubeFacesFollowTheCubeMapConvention)
{
    // Vulkan's table: for each face the coordinates s, t (from 0 at the left and at the first row) of a direction r are (sc
    // / |ma| + 1) / 2 and (tc / |ma| + 1) / 2. Its axes are left-handed, with +z straight ahead.
    struct Selected {
        int face;
        double sc, tc, ma;
    };
    const auto select = [](const glm::dvec3& r) -> Selected {
        const glm::dvec3 a = glm::abs(r);
        if (a.x >= a.y && a.x >= a.z)
            return r.x > 0 ? Selected{0, -r.z, -r.y, r.x} : Selected{1, r.z, -r.y, r.x};
        if (a.y >= a.z)
            return r.y > 0 ? Selected{2, r.x, r.z, r.y} : Selected{3, r.x, -r.z, r.y};
        return r.z > 0 ? Selected{4, r.x, -r.y, r.z} : Selected{5, -r.x, -r.y, r.z};
    };
    const Picture row{CubeFaces{}, {600, 100}}, cross{CubeFaces{CubeFaces::Arrangement::cross}, {400, 300}};
    const glm::dvec2 in_cross[]{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}};
    for (int i = 0; i < 5000; ++i) {
        const double z = 1 - (2 * i + 1) / 5000., r = std::sqrt(1 - z * z), way = i * 2.399963229728653;
        const glm::dvec3 d(r * std::cos(way), r * std::sin(way), z);
        const Selected at = select({d.x, d.y, -d.z});
        const glm::dvec2 st = (glm::dvec2(at.sc, at.tc) / std::abs(at.ma) + 1.) / 2.;
        expect_at(pixel(row, d), (glm::dvec2(at.face, 0) + st) * 100.);
        expect_at(pixel(cross, d), (in_cross[at.face] + st) * 100.);
    }
    // From left to right the faces are right, left, above, below, front and back.
    const glm::dvec3 middles[]{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 1}};
    for (int i = 0; i < 6; ++i)
        expect_near(direction(row, {i * 100 + 50, 50}), middles[i]);
}

TEST(PanoramaTest, ACrossIsContinuousAcrossSharedEdges)
{
    // Across every edge that two faces share in the cross, directions are continuous.
    const PictureRays cross(Picture{CubeFaces{CubeFaces::Arrangement::cross, {20, 10, 5}}, {400, 300}});
    const glm::dvec2 down(0, 1e-9), right(1e-9, 0);
    for (double along : {0.01, 0.3, 0.99}) {
        for (double y : {100., 200.}) {
            const glm::dvec2 edge(100 + along * 100, y);
            expect_near(cross.direction(edge + down), cross.direction(edge - down).value(), 1e-9);
        }
        for (double x : {100., 200., 300.}) {
            const glm::dvec2 edge(x, 100 + along * 100);
            expect_near(cross.direction(edge + right), cross.direction(edge - right).value(), 1e-9);
        }
        expect_near(cross.direction({0, 100 + along * 100}), cross.direction({400, 100 + along * 100}).value());
    }
    for (double x : {1., 99., 201., 399.})
        for (double y : {1., 99., 201., 299.}) { // the empty cells
            EXPECT_FALSE(cross.direction({x, y}));
            EXPECT_EQ(cross.pixel_angle({x, y}), 0);
        }
    // Points on the faces' outline belong to the picture, points beyond it do not.
    for (const glm::dvec2& p :
        {glm::dvec2(150, 0), glm::dvec2(200, 50), glm::dvec2(200, 0), glm::dvec2(150, 300), glm::dvec2(200, 250),
            glm::dvec2(200, 300), glm::dvec2(400, 200), glm::dvec2(50, 200), glm::dvec2(300, 200), glm::dvec2(0, 100)})
        EXPECT_TRUE(cross.direction(p)) << p.x << " " << p.y;
    for (const glm::dvec2& p :
        {glm::dvec2(150, -0.01), glm::dvec2(150, 300.01), glm::dvec2(-0.01, 150), glm::dvec2(400.01, 150)})
        EXPECT_FALSE(cross.direction(p)) << p.x << " " << p.y;
}

} // namespace panorama_test
