#include "displays/projections/picture.h"
#include "tests/support/sphere.h"
#include <functional>

namespace picture_test {

using namespace starbow;
using namespace sphere;

namespace {

/// The properties that every projection must have, for one of them.
struct Case {
    std::string name;
    Picture picture;
    double angle_tolerance
        = 1e-6; ///< relative tolerance of a pixel's solid angle: rounding of the numeric one, and the header's own bound
    double direction_tolerance = 1e-12; ///< from pixel to direction and back, radians
    bool around = false; ///< its left edge shows the same as its right edge
    using Some = std::function<bool(const glm::dvec3&)>; ///< a property of directions
    Some lost = [](const glm::dvec3&) { return false; }; ///< directions without a single pixel
    Some steep = lost; ///< directions where the angle changes too fast for its tolerance
};

Lens headset(Lens::Form form)
{
    Lens lens{form};
    // Like an HTC Vive's and a DK2's; the three colours differ in centre and distortion.
    if (form == Lens::Form::vive)
        lens.colours = {{{{0.55, 0.49}, {-0.187, 0.0215, -0.047, 0}}, {{0.552, 0.491}, {-0.214, 0.03, -0.056, -0.01}},
            {{0.554, 0.492}, {-0.24, 0.04, -0.064, 0.02}}}};
    else
        lens.colours = {{{{0.5, 0.5}, {0.1, 0.05, 0.2, 0.6}}, {{0.48, 0.51}, {-0.02, 0.26, 0.02, 0.7}},
            {{0.46, 0.52}, {0, 0, 0.3, 0.8}}}};
    lens.fov_y_deg = 110;
    lens.turn = {5, -3, 1};
    return lens;
}

/// A projector on the floor of a dome beside the visitors, with its mirror at the rim in front of them.
SphericalMirror mirror()
{
    SphericalMirror mirror;
    mirror.projector_m = {0.1, -0.4, -1.4};
    mirror.projector = Planar{40, Sides{-22, 22, -3, 26}, {1, 10, -2}};
    mirror.mirror_m = {0, -0.1, -2.5};
    mirror.mirror_radius_m = 0.32;
    mirror.dome_m = {0, 0.2, 0};
    mirror.dome_radius_m = 3;
    mirror.dome_tilt_deg = 15;
    mirror.dome_aperture_deg = 175;
    return mirror;
}

std::vector<Case> make_cases()
{
    const auto far_from_axis = [](double tilt_deg, double most_deg) {
        const glm::dvec3 zenith = towards(0, 90 - tilt_deg);
        return [=](const glm::dvec3& d) { return angle(d, zenith) > most_deg * pi / 180; };
    };
    const auto dome = [](double aperture, double tilt, FisheyeMapping mapping) {
        return Fisheye{aperture, tilt, 40, mapping, {0.45, 0.6}, 1.3};
    };
    // A dome's and a lens's angle is computed at the pixel's middle. The bounds are step² plus the header's.
    const auto step2 = [](double deg, double pixels) { return std::pow(deg * pi / 180 / pixels, 2); };
    std::vector<Case> cases{
        {"window", {Planar{60}, {800, 600}}}, {"upright window", {Planar{60}, {600, 800}}},
        {"narrow window", {Planar{0.1}, {33, 17}}}, {"wide window", {Planar{170}, {1920, 1080}}},
        {"widest window", {Planar{179}, {101, 100}}}, {"turned window", {Planar{75, {}, {120, -50, 33}}, {640, 480}}},
        {"window with sides", {Planar{60, Sides{-50, 20, -10, 35}, {-30, 15, 5}}, {640, 400}}},
        {"window beside its axis", {Planar{60, Sides{20, 60, -70, -40}}, {300, 400}}},
        {"wall in front", {Wall{{-2, -1, -1.5}, {2, -1, -1.5}, {-2, 1.5, -1.5}}, {1600, 1000}, {0.3, 0.2, -0.1}}},
        {"floor", {Wall{{-1.5, -1.2, 1}, {1.5, -1.2, 1}, {-1.5, -1.2, -1.5}}, {900, 700}}},
        {"slanted wall", {Wall{{-1, -1, -2}, {1.4, -0.6, -1.2}, {-1.1, 1, -2.2}}, {512, 512}, {0, 0.1, 0.5}}},
        {"wall askew",
            {Wall{{-1, -1, -2}, {1.4, -0.6, -1.2}, {-0.9, 1, -2}, {{1.1, 1.5, -1.3}}}, {512, 400}, {0, 0.1, 0.5}}},
        {"dome", {Fisheye{180, 0}, {512, 512}}, 1e-6 + step2(180, 512) / 10},
        {"tilted dome", {Fisheye{180, 30}, {640, 480}}, 1e-6 + step2(180, 480) / 10},
        {"deep dome", {Fisheye{220, -75}, {480, 640}}, 1e-6 + step2(220, 480) / 10},
        {"whole sphere", {Fisheye{360, 90}, {255, 256}}, 1e-6 + step2(360, 255) / 10, 1e-12, false,
            // The rim is one direction, whose azimuth is lost.
            far_from_axis(90, 179.5), far_from_axis(90, 170)},
        {"narrow dome", {Fisheye{1, 180}, {64, 65}}},
        {"cropped dome", {dome(200, 30, FisheyeMapping::equidistant), {700, 512}}, 1e-6 + step2(200, 665) / 10},
        {"equisolid", {dome(200, 30, FisheyeMapping::equisolid), {700, 512}}, 1e-6 + step2(200, 665)},
        {"equisolid sphere", {Fisheye{360, 0, 0, FisheyeMapping::equisolid}, {512, 512}}, 1e-6 + step2(360, 512), 1e-12,
            false, far_from_axis(0, 170)},
        {"stereographic", {dome(300, -10, FisheyeMapping::stereographic), {700, 512}}, 1e-6 + step2(850, 665)},
        {"orthographic", {dome(180, 60, FisheyeMapping::orthographic), {700, 512}}, 1e-6 + step2(180, 665), 1e-12, false,
            far_from_axis(60, 75)},
        {"cylinder", {Cylinder{}, {1024, 326}}, 1e-6 + step2(360, 1024), 1e-12, true},
        {"part of a cylinder", {Cylinder{{-30, 200, -20, 60}, {50, -20, 10}}, {1000, 500}}, 1e-6 + step2(230, 800)},
        {"equirectangular", {Equirectangular{}, {512, 256}}, 1e-6, 1e-12, true,
            [](const glm::dvec3& d) { return std::abs(d.y) > 1 - 1e-15; }}, // a pole is a whole row
        {"part of the sphere", {Equirectangular{{-100, 40, -70, 80}, {-170, 40, 90}}, {300, 200}}},
        {"faces in a row", {CubeFaces{CubeFaces::Arrangement::row, {10, 20, 30}}, {600, 100}}},
        {"faces in a cross", {CubeFaces{CubeFaces::Arrangement::cross, {-45, 0, 0}}, {400, 300}}},
        {"mirror", {mirror(), {1920, 1080}, {0.1, 0.15, 0.2}}, 1e-6, 1e-11},
        {"vive", {headset(Lens::Form::vive), {1080, 1200}}, 1e-5},
        {"panotools", {headset(Lens::Form::panotools), {960, 1080}}, 2e-4}, // its term k2 r has a kink in the central pixel
    };
    return cases;
}

const std::vector<Case> cases = make_cases();
constexpr Channel channels[]{Channel::red, Channel::green, Channel::blue};

/// A pixel's solid angle as a fan of triangles to points along its edges; nothing if some of them are not shown.
std::optional<double> pixel_area(const PictureRays& rays, glm::dvec2 centre, Channel channel)
{
    constexpr int n = 24;
    const glm::dvec2 corners[]{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
    const auto middle = rays.direction(centre, channel);
    double sum = 0;
    for (int side = 0; side < 4; ++side)
        for (int i = 0; i < n; ++i) {
            const auto at = [&](int k) {
                return rays.direction(centre + glm::mix(corners[side], corners[(side + 1) % 4], k / double(n)), channel);
            };
            const auto a = at(i), b = at(i + 1);
            if (!middle || !a || !b)
                return {};
            sum += triangle_area(*middle, *a, *b);
        }
    return sum;
}

} // namespace

TEST(PictureTest, PixelAndDirectionAreInverse)
{
    for (const Case& c : cases)
        for (Channel channel : channels) {
            const PictureRays rays(c.picture);
            const glm::dvec2 size(c.picture.size);
            int shown = 0;
            for (int j = 0; j <= 48; ++j)
                for (int i = 0; i <= 48; ++i) {
                    // On the edge between two faces a point belongs to either.
                    if (std::holds_alternative<CubeFaces>(c.picture.projection) && (i % 2 == 0 || j % 2 == 0))
                        continue;
                    const glm::dvec2 point = size * glm::dvec2(i, j) / 48.;
                    const auto seen = rays.direction(point, channel);
                    ASSERT_EQ(seen.has_value(), rays.pixel_angle(point, channel) > 0)
                        << c.name << " " << point.x << " " << point.y;
                    if (!seen)
                        continue;
                    EXPECT_NEAR(glm::length(*seen), 1, 1e-15);
                    if (c.lost(*seen))
                        continue;
                    ++shown;
                    for (double length : {1., 1e6}) {
                        auto back = rays.pixel(*seen * length, channel);
                        ASSERT_TRUE(back) << c.name << " " << point.x << " " << point.y;
                        if (c.around)
                            back->x += size.x * std::round((point.x - back->x) / size.x);
                        EXPECT_NEAR(glm::distance(*back, point), 0, 1e-9) << c.name << " " << point.x << " " << point.y;
                    }
                }
            EXPECT_GT(shown, 280) << c.name; // an eighth of the points, in the picture with the smallest part shown
        }
}

TEST(PictureTest, DirectionAndPixelAreInverse)
{
    for (const Case& c : cases)
        for (Channel channel : channels) {
            const PictureRays rays(c.picture);
            const glm::dvec2 size(c.picture.size);
            int found = 0;
            for (int i = 0; i < 20000; ++i) { // a spiral of directions over the sphere
                const double z = 1 - (2 * i + 1) / 20000., r = std::sqrt(1 - z * z), way = i * 2.399963229728653;
                const glm::dvec3 d(r * std::cos(way), r * std::sin(way), z);
                const auto point = rays.pixel(d, channel);
                if (!point || std::abs(point->x) > 1e5 || std::abs(point->y) > 1e5 || c.lost(d))
                    continue;
                ++found;
                expect_near(rays.direction(*point, channel), d, c.direction_tolerance);
                if (HasFailure()) {
                    ADD_FAILURE() << c.name << " " << point->x << " " << point->y;
                    return;
                }
            }
            EXPECT_GT(found, c.name == "narrow dome" ? 0 : 100)
                << c.name; // a view of one degree has a few of the spiral's points
        }
}

TEST(PictureTest, PixelAngleIsTheRootOfTheSolidAngle)
{
    for (const Case& c : cases)
        for (Channel channel : channels) {
            const PictureRays rays(c.picture);
            int compared = 0;
            for (int j = 0; j < 24; ++j)
                for (int i = 0; i < 24; ++i) {
                    const glm::dvec2 centre = glm::floor(glm::dvec2(c.picture.size) * glm::dvec2(i, j) / 23.99) + 0.5;
                    const auto seen = rays.direction(centre, channel);
                    const auto area = pixel_area(rays, centre, channel);
                    if (!area || c.steep(*seen))
                        continue;
                    ++compared;
                    const auto density = [&](glm::dvec2 at) { return std::pow(rays.pixel_angle(at, channel), 2); };
                    double mean = density(centre), tolerance = c.angle_tolerance;
                    // At a mirror's limb the pixels widen without bound. Simpson's mean over the pixel is compared there.
                    // Its error is a fraction of the fourth power of the change across the pixel, and less than this
                    // fraction of its square.
                    if (std::holds_alternative<SphericalMirror>(c.picture.projection)) {
                        mean *= 16;
                        for (const glm::dvec2& half : {glm::dvec2(0.5, 0), glm::dvec2(0, 0.5)}) {
                            const glm::dvec2 corner(half.x - half.y, half.x + half.y);
                            const double before = density(centre - half), after = density(centre + half);
                            mean += 4 * (before + after) + density(centre - corner) + density(centre + corner);
                            tolerance += std::pow(1 - before / after, 2) / 30;
                        }
                        mean /= 36;
                    }
                    EXPECT_NEAR(mean / *area, 1, tolerance) << c.name << " " << centre.x << " " << centre.y;
                }
            EXPECT_GT(compared, 60) << c.name;
        }
}

TEST(PictureTest, PlanarMatrixGivesTheDirection)
{
    for (const Case& c : cases) {
        const auto matrix = planar_matrix(c.picture);
        const Projection& projection = c.picture.projection;
        ASSERT_EQ(
            matrix.has_value(), std::holds_alternative<Planar>(projection) || std::holds_alternative<Wall>(projection));
        if (matrix)
            for (const glm::dvec2& p : {glm::dvec2(0, 0), glm::dvec2(c.picture.size), glm::dvec2(3.5, 7.25)})
                expect_near(direction(c.picture, p), *matrix * glm::dvec3(p, 1));
    }
}

TEST(PictureTest, TheFunctionsEqualThePreparedRays)
{
    for (const Case& c : cases)
        for (Channel channel : channels) {
            const PictureRays rays(c.picture);
            const glm::dvec2 point = glm::dvec2(c.picture.size) * glm::dvec2(0.55, 0.4);
            const auto seen = direction(c.picture, point, channel);
            EXPECT_EQ(seen, rays.direction(point, channel));
            EXPECT_EQ(pixel_angle(c.picture, point, channel), rays.pixel_angle(point, channel));
            if (seen) {
                EXPECT_EQ(pixel(c.picture, *seen, channel), rays.pixel(*seen, channel));
            }
        }
}

TEST(PictureTest, OnlyAMirrorsPictureIsAMirrorImage)
{
    // On any picture right x up points towards the eye. A mirror's light is seen from the other side.
    for (const Case& c : cases) {
        const PictureRays rays(c.picture);
        int compared = 0;
        for (int i = 0; i < 24 * 24; ++i) {
            const glm::dvec2 at = glm::dvec2(c.picture.size) * (glm::dvec2(i % 24, i / 24) + 0.5) / 24.;
            const auto middle = rays.direction(at), left = rays.direction(at - glm::dvec2(0.01, 0)),
                       right = rays.direction(at + glm::dvec2(0.01, 0)), above = rays.direction(at - glm::dvec2(0, 0.01)),
                       below = rays.direction(at + glm::dvec2(0, 0.01));
            if (!left || !right || !above || !below)
                continue;
            ++compared;
            const bool mirrored = glm::dot(glm::cross(*right - *left, *above - *below), *middle) > 0;
            EXPECT_EQ(mirrored, std::holds_alternative<SphericalMirror>(c.picture.projection)) << c.name;
        }
        EXPECT_GT(compared, 60) << c.name;
    }
}

TEST(PictureTest, OnlyLensesSplitColours)
{
    for (const Case& c : cases)
        EXPECT_EQ(splits_colours(c.picture.projection), std::holds_alternative<Lens>(c.picture.projection)) << c.name;
    EXPECT_FALSE(splits_colours(Lens{})); // three equal colours
    Lens lens;
    lens.colours[2].k[1] = 0.1;
    EXPECT_TRUE(splits_colours(lens));
    lens = {};
    lens.colours[0].centre.x = 0.4;
    EXPECT_TRUE(splits_colours(lens));
}

TEST(PictureTest, AWindowsPixelsAddUpToItsSolidAngle)
{
    for (const Case& c : cases) {
        const Planar* planar = std::get_if<Planar>(&c.picture.projection);
        if (!planar || planar->sides)
            continue;
        const PictureRays rays(c.picture);
        double sum = 0;
        for (int y = 0; y < c.picture.size.y; ++y)
            for (int x = 0; x < c.picture.size.x; ++x)
                sum += std::pow(rays.pixel_angle({x + 0.5, y + 0.5}), 2);
        // The solid angle of a pyramid with the half extents w and h at distance 1.
        const double h = std::tan(planar->fov_y_deg * pi / 360), w = h * c.picture.size.x / c.picture.size.y;
        const double whole = 4 * std::asin(w * h / std::sqrt((1 + w * w) * (1 + h * h)));
        EXPECT_NEAR(sum / whole, 1, 1e-11);
    }
}

TEST(PictureTest, WholeSpheresAddUpToTheSky)
{
    // Their pixels are exact, so that only the sum rounds.
    const std::pair<Picture, double> spheres[]{
        {{Equirectangular{}, {128, 64}}, 1e-12},
        {{CubeFaces{}, {96, 16}}, 1e-11},
        {{CubeFaces{CubeFaces::Arrangement::cross}, {64, 48}}, 1e-11},
    };
    for (const auto& [picture, tolerance] : spheres) {
        const PictureRays rays(picture);
        double sum = 0;
        for (int y = 0; y < picture.size.y; ++y)
            for (int x = 0; x < picture.size.x; ++x)
                sum += std::pow(rays.pixel_angle({x + 0.5, y + 0.5}), 2);
        EXPECT_NEAR(sum / (4 * pi), 1, tolerance);
    }
}

} // namespace picture_test
