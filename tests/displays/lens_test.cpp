#include "displays/projections/picture.h"
#include "tests/support/sphere.h"

namespace lens_test {

using namespace starbow;
using namespace sphere;

namespace {

/// A lens with the same distortion for all three colours.
Picture lens(Lens::Form form, std::array<double, 4> k, double fov_y_deg = 90)
{
    Lens lens{form};
    for (Lens::Colour& colour : lens.colours)
        colour.k = k;
    lens.fov_y_deg = fov_y_deg;
    return {lens, {1000, 1000}};
}

} // namespace

TEST(LensTest, WithoutDistortionALensIsAWindow)
{
    const double widened = 2 * std::atan(1.5 * std::tan(30 * pi / 180)) * 180 / pi;
    const struct {
        Picture warped;
        double fov_y_deg;
    } same[]{
        {lens(Lens::Form::vive, {0, 0, 0, 0}, 60), 60},
        {lens(Lens::Form::panotools, {0, 0, 0, 1}, 60), 60},
        {lens(Lens::Form::vive, {0, 0, 0, 0.5}, 60), widened},
        {lens(Lens::Form::panotools, {0, 0, 0, 1.5}, 60), widened},
    };
    for (const auto& s : same) {
        const Picture window{Planar{s.fov_y_deg}, {1000, 1000}};
        for (const glm::dvec2& p : {glm::dvec2(0, 0), glm::dvec2(500, 500), glm::dvec2(123, 456), glm::dvec2(1000, 900)}) {
            expect_near(direction(s.warped, p), direction(window, p).value());
            expect_at(pixel(s.warped, direction(window, p).value()), p);
            EXPECT_NEAR(pixel_angle(s.warped, p) / pixel_angle(window, p), 1, 1e-5); // a pixel's square
        }
    }
}

TEST(LensTest, DistortionFollowsThePublishedPolynomials)
{
    // 90 degrees put the point p at the tangent p f; r is its distance from the centre in halves of the height.
    const Picture panotools = lens(Lens::Form::panotools, {0.1, 0.2, -0.05, 0.9}); // f = 0.0125 + 0.05 - 0.025 + 0.9
    expect_near(direction(panotools, {750, 500}), {0.5 * 0.9375, 0, -1});
    expect_near(direction(panotools, {500, 250}), {0, 0.5 * 0.9375, -1});
    expect_near(direction(panotools, {350, 700}), {-0.3 * 0.9375, -0.4 * 0.9375, -1}); // 3, 4, 5
    const Picture vive = lens(Lens::Form::vive, {-0.2, -0.1, -0.05, 0.1}); // D = 1 - 0.05 - 0.00625 - 0.00078125
    const double f = 1 / 0.94296875 + 0.1;
    expect_near(direction(vive, {750, 500}), {0.5 * f, 0, -1});
    expect_near(direction(vive, {650, 300}), {0.3 * f, 0.4 * f, -1});
    expect_at(pixel(vive, {0.3 * f, 0.4 * f, -1}), {650, 300});
}

TEST(LensTest, EachColourHasItsCentreAndDistortion)
{
    Lens lens{Lens::Form::panotools};
    lens.colours = {{{{0.5, 0.5}, {0, 0, 0, 1}}, {{0.6, 0.5}, {0, 0, 0, 2}}, {{0.5, 0.25}, {0, 0, 1, 1}}}};
    lens.turn.yaw_deg = 90;
    const Picture picture{lens, {2000, 1000}}; // r counts halves of the height
    expect_near(direction(picture, {1000, 500}, Channel::red), {1, 0, 0});
    expect_near(direction(picture, {1500, 500}, Channel::red), {1, 0, 1});
    expect_near(direction(picture, {1200, 500}, Channel::green), {1, 0, 0});
    expect_near(direction(picture, {1700, 500}, Channel::green), {1, 0, 2});
    expect_near(direction(picture, {1000, 250}, Channel::blue), {1, 0, 0});
    expect_near(direction(picture, {1000, 0}, Channel::blue), {1, 0.75, 0}); // r = 1/2: f = 3/2
    for (Channel channel : {Channel::red, Channel::green, Channel::blue}) {
        const glm::dvec2 point(1234, 321);
        expect_at(pixel(picture, direction(picture, point, channel).value(), channel), point);
    }
    EXPECT_EQ(direction(picture, {7, 8}), direction(picture, {7, 8}, Channel::green));
}

TEST(LensTest, NothingIsShownBeyondAFold)
{
    // r - r³/3 grows up to r = 1, where it is 2/3.
    const Picture folded = lens(Lens::Form::panotools, {0, -1. / 3, 0, 1});
    EXPECT_TRUE(direction(folded, {500 + 499.999999, 500}));
    EXPECT_FALSE(direction(folded, {500 + 500.000001, 500}));
    EXPECT_FALSE(direction(folded, {900, 900}));
    EXPECT_EQ(pixel_angle(folded, {900, 900}), 0);
    EXPECT_FALSE(pixel(folded, {2. / 3 + 1e-9, 0, -1}));
    expect_at(pixel(folded, {2. / 3 - 1e-9, 0, -1}), {1000, 500}, 0.02); // 500 times the root of 1e-9
    EXPECT_FALSE(pixel(folded, {0, 0, 1}));
    // It grows again beyond r = 2, and shows nothing there either.
    const Picture again = lens(Lens::Form::panotools, {0, 1. / 6, -0.75, 1}); // r - 3/4 r² + r³/6: slope (r-1)(r-2)/2
    EXPECT_TRUE(direction(again, {999.9999, 500}));
    EXPECT_FALSE(direction(again, {1000.0001, 500}));
    EXPECT_FALSE(direction(again, {2600, 500}));
    // A slope that only touches 0 does not fold: r - r² + r³/3 has the slope (1 - r)².
    const Picture touching = lens(Lens::Form::panotools, {0, 1. / 3 + 1e-12, -1, 1});
    EXPECT_TRUE(direction(touching, {1400, 500}));
    expect_at(pixel(touching, direction(touching, {1400, 500}).value()), {1400, 500}, 1e-9);
    // Vive: r / (1 + r²) grows up to r = 1. 1 / (1 - r²) has a pole there, towards which the picture widens without limit.
    const Picture falling = lens(Lens::Form::vive, {1, 0, 0, 0}), pole = lens(Lens::Form::vive, {-1, 0, 0, 0});
    for (const Picture& picture : {falling, pole}) {
        EXPECT_TRUE(direction(picture, {999.9999, 500}));
        EXPECT_FALSE(direction(picture, {1000.0001, 500}));
    }
    EXPECT_FALSE(pixel(falling, {0.5 + 1e-9, 0, -1}));
    expect_at(pixel(pole, {1e9, 0, -1}), {1000, 500}, 1e-5);
    // The inverse of r / (1 - r²) = w is r = (sqrt(1 + 4 w²) - 1) / (2 w).
    for (double w : {0.01, 1., 30.})
        expect_at(pixel(pole, {0, w, -1}), {500, 500 - 500 * (std::sqrt(1 + 4 * w * w) - 1) / (2 * w)});
    // A polynomial that falls from the start shows nothing.
    EXPECT_FALSE(direction(lens(Lens::Form::panotools, {0, 0, 1, 0}), {600, 500}));
    EXPECT_FALSE(direction(lens(Lens::Form::vive, {0, 0, 0, -1.5}), {600, 500}));
    EXPECT_FALSE(pixel(lens(Lens::Form::vive, {0, 0, 0, -1.5}), {0, 0, -1}));
}

} // namespace lens_test
