#include "displays/projections/picture.h"
#include "tests/support/sphere.h"

namespace fisheye_test {

using namespace starbow;
using namespace sphere;

TEST(FisheyeTest, ALevelDomeLooksUpWithTheFrontBelow)
{
    // For a visitor who faces the front and looks up, right is on the right, and the front is below the zenith.
    const Picture dome{Fisheye{180, 0}, {1000, 1000}};
    expect_near(direction(dome, {500, 500}), {0, 1, 0});
    expect_near(direction(dome, {500, 1000}), {0, 0, -1}); // bottom: straight ahead
    expect_near(direction(dome, {1000, 500}), {1, 0, 0}); // right
    expect_near(direction(dome, {500, 0}), {0, 0, 1}); // top: behind
    expect_near(direction(dome, {0, 500}), {-1, 0, 0});
    expect_near(direction(dome, {500, 750}), {0, 1, -1}); // half the radius is half the angle
    EXPECT_FALSE(direction(dome, {0, 0}));
    EXPECT_FALSE(direction(dome, {500, 1000.001}));
    EXPECT_EQ(pixel_angle(dome, {0, 0}), 0);
    EXPECT_FALSE(pixel(dome, {0, -1e-6, -1})); // just under the spring line
}

TEST(FisheyeTest, TiltLeansTheDomeForward)
{
    const glm::ivec2 size(1000, 1000);
    // At 90 degrees the centre is straight ahead, and up is at the top, as in a window.
    const Picture ahead{Fisheye{180, 90}, size};
    expect_near(direction(ahead, {500, 500}), {0, 0, -1});
    expect_near(direction(ahead, {500, 0}), {0, 1, 0});
    expect_near(direction(ahead, {1000, 500}), {1, 0, 0});
    expect_near(direction(ahead, {500, 1000}), {0, -1, 0});
    // At 30 degrees the front rim sinks 30 degrees below straight ahead, the back rim rises, and the sides stay.
    const Picture leaning{Fisheye{180, 30}, size};
    const double c = std::sqrt(0.75);
    expect_near(direction(leaning, {500, 500}), {0, c, -0.5});
    expect_near(direction(leaning, {500, 1000}), {0, -0.5, -c});
    expect_near(direction(leaning, {500, 0}), {0, 0.5, c});
    expect_near(direction(leaning, {0, 500}), {-1, 0, 0});
    // A negative tilt looks straight behind.
    expect_near(direction(Picture{Fisheye{180, -90}, size}, {500, 500}), {0, 0, 1});
}

TEST(FisheyeTest, RotationTurnsThePictureCounterclockwise)
{
    const auto dome = [](double rotation) { return Picture{Fisheye{180, 0, rotation}, {1000, 1000}}; };
    // The front is at the bottom without rotation; it goes to the right, the top, and the left.
    expect_at(pixel(dome(90), {0, 0, -1}), {1000, 500});
    expect_at(pixel(dome(180), {0, 0, -1}), {500, 0});
    expect_at(pixel(dome(-90), {0, 0, -1}), {0, 500});
    expect_at(pixel(dome(45), {0, 0, -1}), glm::dvec2(500) + 500 * std::sqrt(0.5));
    expect_at(pixel(dome(30), {1, 0, 0}), {500 + 500 * std::sqrt(0.75), 250});
    expect_near(direction(dome(90), {500, 0}), {1, 0, 0}); // the right-hand side is at the top now
    expect_near(direction(dome(123), {500, 500}), {0, 1, 0});
}

TEST(FisheyeTest, CentreAndDiameterPlaceTheCircle)
{
    // A truncated dome: the circle is as wide as the picture, and its lower part is cut off.
    const Picture cut{Fisheye{180, 0, 0, FisheyeMapping::equidistant, {0.5, 2.0 / 3}, 4.0 / 3}, {1600, 1200}};
    expect_near(direction(cut, {800, 800}), {0, 1, 0});
    expect_near(direction(cut, {800, 0}), {0, 0, 1}); // behind, at the upper edge
    expect_near(direction(cut, {1600, 800}), {1, 0, 0});
    expect_near(direction(cut, {800, 1200}), {0, 1, -1}); // the picture ends 45 degrees up in front
    expect_at(pixel(cut, {0, 0, -1}), {800, 1600}); // the projection goes on beyond the edge
    EXPECT_FALSE(direction(cut, {1590, 1190}));
    const Picture small{Fisheye{180, 0, 0, FisheyeMapping::equidistant, {0.25, 0.5}, 0.5}, {1000, 400}};
    expect_near(direction(small, {350, 200}), {1, 0, 0});
    EXPECT_FALSE(direction(small, {350.001, 200}));
}

TEST(FisheyeTest, MappingsPutAnglesAtTheirRadii)
{
    // The radii are 2 sin(a/2), 2 tan(a/2) and sin(a) over their values at the rim, from the exact values at 30 and 45
    // degrees.
    const double s45 = std::sqrt(0.5), s30 = 0.5, t15 = 2 - std::sqrt(3.), t30 = 1 / std::sqrt(3.), t45 = 1;
    const struct {
        FisheyeMapping mapping;
        double aperture, angle, radius; // of 1000 pixels
    } known[]{
        {FisheyeMapping::equidistant, 180, 60, 2. / 3},
        {FisheyeMapping::equisolid, 180, 60, s30 / s45},
        {FisheyeMapping::equisolid, 360, 60, s30},
        {FisheyeMapping::equisolid, 360, 90, s45},
        {FisheyeMapping::equisolid, 360, 180, 1},
        {FisheyeMapping::equisolid, 120, 60, 1},
        {FisheyeMapping::stereographic, 180, 60, t30 / t45},
        {FisheyeMapping::stereographic, 120, 30, t15 / t30},
        {FisheyeMapping::stereographic, 240, 90, t45 / std::sqrt(3.)},
        {FisheyeMapping::orthographic, 180, 30, s30},
        {FisheyeMapping::orthographic, 180, 45, s45},
        {FisheyeMapping::orthographic, 180, 60, std::sqrt(0.75)},
        {FisheyeMapping::orthographic, 60, 30, 1},
    };
    for (const auto& k : known) {
        const Picture dome{Fisheye{k.aperture, 0, 0, k.mapping}, {2000, 2000}};
        const glm::dvec3 ahead = towards(0, 90 - k.angle), right = towards(90, 90 - k.angle);
        expect_near(direction(dome, {1000, 1000 + 1000 * k.radius}), ahead, 1e-13);
        expect_near(direction(dome, {1000 + 1000 * k.radius, 1000}), right, 1e-13);
        expect_at(pixel(dome, right), {1000 + 1000 * k.radius, 1000});
    }
}

TEST(FisheyeTest, TheRimIsHalfTheAperture)
{
    const struct {
        FisheyeMapping mapping;
        double widest;
    } kinds[]{{FisheyeMapping::equidistant, 360}, {FisheyeMapping::equisolid, 360}, {FisheyeMapping::stereographic, 359},
        {FisheyeMapping::orthographic, 180}};
    for (const auto& [mapping, widest] : kinds)
        for (double aperture : {1., 90., 180., 220., 300., 359.})
            for (double tilt : {0., 30., 90., -120.})
                for (int i = 0; i < 12 && aperture <= widest; ++i) {
                    const Picture dome{Fisheye{aperture, tilt, 10, mapping}, {640, 480}}; // the circle fits the shorter side
                    const glm::dvec2 way(std::cos(i * pi / 6), std::sin(i * pi / 6));
                    const glm::dvec3 zenith = direction(dome, {320, 240}).value();
                    const glm::dvec3 rim = direction(dome, glm::dvec2(320, 240) + 240 * (1 - 1e-13) * way).value();
                    // Near 90 degrees an orthographic radius determines the angle only to the root of twice 1e-13.
                    EXPECT_NEAR(angle(zenith, rim) * 360 / pi, aperture, 1e-4);
                    EXPECT_FALSE(direction(dome, glm::dvec2(320, 240) + 240.000001 * way));
                }
    EXPECT_FALSE(direction(Picture{Fisheye{180, 0}, {640, 480}}, {79, 240})); // left of the circle
}

TEST(FisheyeTest, AnOrthographicRimKeepsItsPixels)
{
    const Picture dome{Fisheye{180, 0, 0, FisheyeMapping::orthographic}, {512, 512}};
    for (double r : {200., 250., 255., 255.9, 255.9999, 256.}) {
        const glm::dvec2 point(256 + r * 0.6, 256 - r * 0.8);
        expect_at(pixel(dome, direction(dome, point).value()), point);
        // The angle lies between that of a pixel a little further in, and the last pixel's whole width: acos(1 - 1/256) of
        // 90 degrees.
        EXPECT_GT(pixel_angle(dome, point), 1. / 256);
        EXPECT_LT(pixel_angle(dome, point), 0.09);
    }
}

TEST(FisheyeTest, AWholeSphereShowsEveryDirection)
{
    for (FisheyeMapping mapping : {FisheyeMapping::equidistant, FisheyeMapping::equisolid})
        for (const glm::dvec3& d : {glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1), glm::dvec3(0, -1, 0), glm::dvec3(0, 1, 0)})
            for (double tilt : {0., 90., -90., 180.}) {
                const Picture dome{Fisheye{360, tilt, 0, mapping}, {100, 100}};
                const auto point = pixel(dome, d);
                ASSERT_TRUE(point);
                // At the equisolid sphere's closing point the error is the root of a rounding.
                expect_near(direction(dome, *point), d, mapping == FisheyeMapping::equisolid ? 1e-7 : 1e-14);
            }
}

TEST(FisheyeTest, ADomesPixelsAddUpToItsSolidAngle)
{
    for (FisheyeMapping mapping : {FisheyeMapping::equidistant, FisheyeMapping::equisolid, FisheyeMapping::stereographic,
             FisheyeMapping::orthographic})
        for (double aperture : {90., 180., 270., 360.})
            for (int across : {256, 511, 1024}) {
                if ((mapping == FisheyeMapping::stereographic && aperture > 180)
                    || (mapping == FisheyeMapping::orthographic && aperture > 90))
                    continue; // the pixels at the rim are too large to be counted whole
                const PictureRays dome(Picture{Fisheye{aperture, 25, 0, mapping}, {across, across}});
                double sum = 0;
                for (int y = 0; y < across; ++y)
                    for (int x = 0; x < across; ++x)
                        sum += std::pow(dome.pixel_angle({x + 0.5, y + 0.5}), 2);
                // Whole pixels approximate a round rim: about the root of the pi * across rim pixels is miscounted, each
                // worth 4 / pi / across^2 of the circle.
                const double bound = std::sqrt(pi * across) * 4 / pi / across / across;
                EXPECT_NEAR(sum / (2 * pi * (1 - std::cos(aperture * pi / 360))), 1, bound) << aperture << " " << across;
            }
}

TEST(FisheyeTest, TheWholeSpheresRimPixelsHaveAnAngle)
{
    const Picture sphere{Fisheye{360, 0}, {512, 512}};
    for (double x : {0.0, 0.25, 0.5, 1.0})
        EXPECT_GT(pixel_angle(sphere, {x, 256}), 1e-5);
}

} // namespace fisheye_test
