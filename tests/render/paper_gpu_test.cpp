// The paper's figures through the whole path. The numbers of `starbow render --exr`, for the shipped shots and others, are
// compared with relativity by 4-vectors (quad.h) and with geometry by hand.
#include "config/model/angles.h"
#include "config/model/shipped.h"
#include "displays/compile/direction_map.h"
#include "runtime/light/spectrum.h"
#include "tests/support/gpu_environment.h"
#include "tests/support/quad.h"
#include <algorithm>
#include <map>

namespace starbow::gpu_test::paper_gpu_test {
namespace {

// ---------------------------------------------------------------- the avenue as scenes/avenue/make.py describes it

const dvec3 earth_place{0.16, 0.10, -0.55};
constexpr double earth_radius = 0.0425 / 2;
const dvec3 cylinder_place{-14, 0, 8};
constexpr double cylinder_radius = 0.35, cylinder_half = 8;

std::vector<dvec2> column_axes() // x, z
{
    std::vector<dvec2> axes = {{0, -46}};
    for (double x : {-0.8, 0.8}) {
        for (int k = 0; k < 20; ++k)
            axes.push_back({x, -3 - 2 * k});
        for (int z = 1; z < 12; z += 2)
            axes.push_back({x, z});
    }
    return axes;
}
const std::vector<dvec2> columns = column_axes();

/// The shaft's radius without its flutes, which are at most 0.012 deep.
double shaft_radius(double y)
{
    double v = (y + 1.235) / 2.495;
    return 0.150 - 0.024 * v + 0.004 * std::sin(pi * v);
}
constexpr double flute = 0.012;

double outside(double value, double low, double high) { return std::max({0.0, low - value, value - high}); }

/// The nearest object to a place in the world: its name, and the distance of the place from its surface. A triangle mesh
/// lies inside the round shape by up to its sagitta, which counts as the surface.
struct Nearest {
    std::string name;
    double off = 1e300;
};
Nearest nearest_at(const dvec3& p)
{
    Nearest best{"nothing", 1e300};
    auto offer = [&](const char* name, double off) {
        if (off < best.off)
            best = {name, off};
    };
    double earth = glm::length(p - earth_place);
    offer("Earth", outside(earth, earth_radius * 0.9985, earth_radius)); // 96 x 48 faces: two sagittas of 5.4e-4
    dvec3 along = p - cylinder_place;
    double rim = std::hypot(along.y, along.z);
    double wall = std::hypot(
        outside(rim, cylinder_radius * 0.9985, cylinder_radius), outside(along.x, -cylinder_half, cylinder_half));
    double end = std::hypot(outside(rim, 0, cylinder_radius), std::abs(along.x) - cylinder_half);
    offer("stippled cylinder", std::min(wall, end));
    for (const dvec2& axis : columns) {
        double x = p.x - axis.x, z = p.z - axis.y, r = std::hypot(x, z);
        if (r > 1)
            continue;
        if (std::abs(p.y) < 1.2)
            offer("column", outside(r, shaft_radius(p.y) - flute - 1e-4, shaft_radius(p.y)));
        else // base and capital: only their bounding box is known
            offer("column", glm::length(dvec3(outside(x, -.231, .231), outside(p.y, -1.5, 1.5), outside(z, -.231, .231))));
    }
    for (double z : {4, 7, 10, -15, -27, -39}) // 96 x 16 faces: sagittas of 8.6e-4 and 1.2e-3
        offer("hoop", outside(std::hypot(std::hypot(p.x, p.y) - 1.6, p.z - z), 0.06 - 0.0021, 0.06));
    for (int i = 0; i < 21; ++i)
        for (double x : {i % 2 ? -3.4 : -2.4, i % 2 ? 2.4 : 3.4}) {
            dvec2 middle(p.x - x, p.z - (12 - 2.6 * i)); // their rotation and height are random
            offer("cube", std::hypot(outside(glm::length(middle), 0, 0.3 * std::sqrt(3.0)), outside(p.y, -1.42, 1.42)));
        }
    double azimuth = 20.4 * degree, elevation = 13.2 * degree;
    dvec3 sun(499 * std::cos(elevation) * std::sin(azimuth), 499 * std::sin(elevation),
        -499 * std::cos(elevation) * std::cos(azimuth));
    offer("Sun", outside(glm::length(p - sun), 2.32 * 0.996, 2.32)); // 64 x 32 faces
    return best;
}

/// The distance at which a ray surely meets the Earth, a shaft or the cylinder, each reduced by `margin`; 1e300 if it meets
/// none.
double surely_met(const dvec3& eye, const dvec3& n, double margin)
{
    double nearest = 1e300;
    dvec3 from = eye - earth_place;
    double b = glm::dot(from, n), c = glm::dot(from, from) - std::pow(earth_radius * 0.9985 - margin, 2);
    if (margin < earth_radius / 2 && b * b > c && b < 0)
        nearest = -b - std::sqrt(b * b - c);
    auto cylinder = [&](dvec2 o, dvec2 d, double along, double step, double radius, double half) {
        double a = glm::dot(d, d), h = glm::dot(o, d), k = glm::dot(o, o) - radius * radius;
        if (radius <= 0 || h * h <= a * k || h >= 0 || a == 0)
            return;
        double t = (-h - std::sqrt(h * h - a * k)) / a;
        if (std::abs(along + t * step) < half)
            nearest = std::min(nearest, t);
    };
    from = eye - cylinder_place;
    cylinder({from.y, from.z}, {n.y, n.z}, from.x, n.x, cylinder_radius * 0.9985 - margin, cylinder_half - margin);
    for (const dvec2& axis : columns)
        cylinder({eye.x - axis.x, eye.z - axis.y}, {n.x, n.z}, eye.y, n.y, 0.126 - flute - margin, 1.2);
    return nearest;
}

// ---------------------------------------------------------------- every shipped shot

struct Worst {
    double camera = 0, world = 0, D = 0;
};

/// Checks directions and D of every third pixel, and that every channel is NaN outside the projection.
Worst check_directions(const Numbers& numbers, const Layout& layout, const Shot& shot)
{
    const quad::V3 u = quad::of(shot.u);
    const double speed = glm::length(shot.u);
    Worst worst;
    std::vector<bool> covered(numbers.count());
    for (const View& view : views_of(layout, 0, numbers.size)) {
        for (int y = 0; y < view.size.y; ++y)
            for (int x = 0; x < view.size.x; ++x) {
                const int i = (view.corner.y + y) * numbers.size.x + view.corner.x + x;
                covered[i] = true;
                const auto cockpit = direction(view.picture, view.picture_from_pixel * dvec2(x + 0.5, y + 0.5));
                if (numbers.shown(i) != cockpit.has_value()) {
                    ADD_FAILURE() << "pixel " << x << ' ' << y << (cockpit ? " shows nothing" : " shows something");
                    return worst;
                }
                if (!cockpit) {
                    for (const auto& [name, values] : numbers.channels)
                        if (!std::isnan(values[i]))
                            ADD_FAILURE() << name << " outside the picture is " << values[i];
                    continue;
                }
                if ((x + y) % 3)
                    continue;
                const dvec3 exact = shot.ship_from_cockpit * *cockpit;
                const double camera = between(exact, numbers.camera(i));
                const quad::Light light = quad::world_from_camera(quad::of(exact), u);
                const double D = double(light.D);
                // A world direction's error appears in the camera 1/D times as large; so does its rounding to float, 5e-8.
                const double world = quad::angle(quad::of(numbers.world(i)), light.n) / D;
                const double world_rounding = 5.2e-8 / D;
                // The relative error of D that an error of `camera` in the direction makes.
                const double steep
                    = speed * double(quad::length(quad::cross(quad::of(exact), speed > 0 ? quad::unit(u) : u))) * D;
                const double D_error = std::abs(numbers.D(i) / D - 1);
                worst.camera = std::max(worst.camera, camera);
                worst.world = std::max(worst.world, world - world_rounding);
                worst.D = std::max(worst.D, D_error - steep * camera);
                // Depth is a distance: positive, and not NaN where the projection shows something.
                if (!(numbers.depth(i) > 0))
                    ADD_FAILURE() << "depth " << numbers.depth(i);
            }
    }
    for (int i = 0; i < numbers.count(); ++i)
        if (!covered[i] && numbers.shown(i))
            ADD_FAILURE() << "outside the viewports something is shown";
    return worst;
}

/// The depths of the pixels around one.
std::vector<double> neighbours(const Numbers& numbers, int i)
{
    const int width = numbers.size.x, x = i % width, y = i / width;
    std::vector<double> depths;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            if (x + dx >= 0 && x + dx < width && y + dy >= 0 && y + dy < numbers.size.y && (dx != 0 || dy != 0))
                depths.push_back(numbers.depth(i + dx + dy * width));
    return depths;
}

/// The faces of a row of columns lie in one plane. Seen along it, one texel shows a column, the next one another column, and
/// the plane through both has a distance between theirs, where the gap is.
bool between_neighbours(const Numbers& numbers, int i)
{
    bool nearer = false, farther = false;
    for (const double depth : neighbours(numbers, i)) {
        nearer |= depth < numbers.depth(i);
        farther |= depth > numbers.depth(i) && !std::isinf(depth);
    }
    return nearer && farther;
}

/// A surface that ends before the sky is seen edge-on there, and its texel's plane goes on beyond it.
bool beside_sky(const Numbers& numbers, int i)
{
    return std::ranges::any_of(neighbours(numbers, i), [](double depth) { return std::isinf(depth); });
}

class ShippedShots : public ::testing::TestWithParam<std::filesystem::path> { };

TEST_P(ShippedShots, DirectionsAndDopplerAreTheTextbooks)
{
    const Shot shot = load_shot(GetParam());
    for (const auto& [name, size] :
        std::map<std::string, ivec2>{{"desk", {200, 150}}, {"dome", {180, 180}}, {"stereo", {240, 90}}}) {
        SCOPED_TRACE(name);
        Layout layout = load_layout(testing::source_dir() / "config/layouts" / (name + ".json"));
        layout.outputs[0].size = size;
        OffscreenRenderer offscreen = renderer(avenue().world, layout);
        const Worst worst = check_directions(Numbers(offscreen, shot), layout, shot);
        std::printf("  %-7s camera %.1e  world %.1e  D %.1e\n", name.c_str(), worst.camera, worst.world, worst.D);
        // The shader's direction from a pixel: four products and sums, a root, a quotient, a matrix rounded to float, and
        // the channel's own rounding, 5.2e-8: seven roundings of 6e-8. A map's direction has 2.6e-7 for its packing, and
        // three roundings.
        EXPECT_LE(worst.camera, 4.2e-7);
        EXPECT_LE(worst.world, 4.2e-7 + 1e-6); // plus the transformation's own 1e-6
        EXPECT_LE(worst.D, 1e-6);
    }
}

TEST_P(ShippedShots, DepthIsTheDistanceInTheWorldFromTheEyesEvent)
{
    const Shot shot = load_shot(GetParam());
    std::map<std::string, int> seen;
    for (const auto& [name, size] : std::map<std::string, ivec2>{{"desk", {400, 300}}, {"dome", {256, 256}}}) {
        SCOPED_TRACE(name);
        Layout layout = load_layout(testing::source_dir() / "config/layouts" / (name + ".json"));
        layout.outputs[0].size = size;
        const Projection& projection = layout.outputs[0].viewports[0].projection;
        OffscreenRenderer offscreen = renderer(avenue().world, layout);
        const Numbers numbers(offscreen, shot);
        double worst = 0;
        int failures = 0, between = 0;
        for (int i = 0; i < numbers.count() && failures < 5; ++i) {
            if (!numbers.shown(i))
                continue;
            const double D = shot.effects[Effect::aberration] ? numbers.D(i) : 1, depth = numbers.depth(i);
            const double footprint
                = D * pixel_angle(Picture{projection, size}, numbers.centre(i)); // the pixel's size in the world, radians
            // The cube map's depth belongs to a sample up to 0.7 + 0.53 texels away. A texel is at most footprint / 1.5
            // wide, and up to 1.3 times that in a face's corner. A coarser level of detail may be off by one more texel.
            const double slack = (0.7 + 0.53 + 1) * 1.3 / 1.5;
            const dvec3 n = numbers.world(i), place = shot.position + depth * n;
            const double met = surely_met(shot.position, n, 0);
            if (met < 1e300 && slack * footprint * met < 0.004) {
                const double core = surely_met(shot.position, n, slack * footprint * met);
                if (core < 1e300 && depth > core + slack * footprint * core) {
                    ++failures;
                    ADD_FAILURE() << "pixel " << i << ": " << depth << " looks through what stands at " << core;
                }
            }
            if (std::isinf(depth)) {
                ++seen["sky"];
                continue;
            }
            const Nearest nearest = nearest_at(place);
            ++seen[nearest.name];
            const double error = nearest.off / (footprint * depth);
            // 3e-6 covers float depths and directions at any distance.
            if (nearest.off > (slack * footprint + 3e-6) * depth) {
                if (between_neighbours(numbers, i) || (error < 2 * slack && beside_sky(numbers, i))) {
                    ++between;
                    continue;
                }
                ++failures;
                ADD_FAILURE() << "pixel " << i << ": at " << place.x << ' ' << place.y << ' ' << place.z << ", distance "
                              << depth << ", the nearest is a " << nearest.name << " but " << nearest.off << " off, "
                              << error << " pixels";
            }
            worst = std::max(worst, error);
        }
        EXPECT_LT(between, numbers.count() / 500);
        std::printf("  %-5s worst %.2f pixels off the analytic surface\n", name.c_str(), worst);
    }
    for (const auto& [name, count] : seen)
        std::printf("  %s %d", name.c_str(), count);
    std::printf("\n");
    EXPECT_GT(seen["sky"], 100);
    EXPECT_GT(seen["column"] + seen["stippled cylinder"], 100);
}

std::string shot_name(const ::testing::TestParamInfo<std::filesystem::path>& info)
{
    std::string name = info.param.stem().string();
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}
/// Only the avenue's objects are known here.
std::vector<std::filesystem::path> avenue_shots()
{
    std::vector<std::filesystem::path> files = testing::shipped("config/shots");
    std::erase_if(files, [](const std::filesystem::path& file) { return load_shot(file).scene != "avenue"; });
    return files;
}
INSTANTIATE_TEST_SUITE_P(Paper, ShippedShots, ::testing::ValuesIn(avenue_shots()), shot_name);

TEST(Paper, ExrHoldsTheSameNumbersToTheBit)
{
    Layout layout = load_layout(testing::source_dir() / "config/layouts/dome.json");
    layout.outputs[0].size = {64, 64};
    OffscreenRenderer offscreen = renderer(avenue().world, layout);
    const Shot shot = load_shot(testing::source_dir() / "config/shots/starbow.json");
    render_still(testing::scratch("exr"), offscreen, shot, true);
    auto [size, read] = read_exr(testing::scratch("exr") / "domemaster.exr");
    EXPECT_EQ(size, ivec2(64, 64));
    offscreen.frame().adopt(measured_quality(offscreen.frame().quality()));
    const Numbers numbers(offscreen, shot);
    ASSERT_EQ(read.size(), 14u);
    for (const auto& [name, values] : read)
        EXPECT_EQ(std::memcmp(values.data(), numbers.channel(name).data(), 4 * values.size()), 0) << name;
}

// ---------------------------------------------------------------- the sections' own figures

TEST(Paper, AtHalfTheSpeedOfLightDIsOneAt74Degrees)
{
    Layout layout = one_view(Planar{60}, {800, 600});
    OffscreenRenderer offscreen = renderer(avenue().world, layout);
    const Shot shot = load_shot(testing::source_dir() / "config/shots/rainbow.json");
    const Numbers numbers(offscreen, shot);
    const dvec3 motion = glm::normalize(shot.u);
    int crossings = 0;
    for (int i = 1; i < numbers.count(); ++i) {
        if (i % numbers.size.x == 0 || (numbers.D(i - 1) < 1) == (numbers.D(i) < 1))
            continue;
        ++crossings;
        const double part = (1 - numbers.D(i - 1)) / (numbers.D(i) - numbers.D(i - 1));
        const double angle = between(motion, glm::mix(numbers.camera(i - 1), numbers.camera(i), part)) / degree;
        // D is smooth: over a pixel of 0.1 degrees, linear interpolation is off by 1e-3^2 radians, and D's rounding adds
        // 1e-5 degrees.
        EXPECT_NEAR(angle, 74.45773, 1e-4);
    }
    EXPECT_EQ(crossings, 600); // every row
}

TEST(Paper, ColumnsBehindTheCameraAreSeenAheadAtGammaFour)
{
    OffscreenRenderer offscreen = renderer(avenue().world, one_view(Planar{60}, {400, 300}));
    const Shot shot = load_shot(testing::source_dir() / "config/shots/avenue-gamma4.json");
    const Numbers numbers(offscreen, shot);
    std::map<double, int> behind; // pixels by the z of their column
    for (int i = 0; i < numbers.count(); ++i) {
        const dvec3 place = shot.position + numbers.depth(i) * numbers.world(i);
        if (std::isinf(numbers.depth(i)) || glm::dot(numbers.world(i), shot.u) >= 0 || nearest_at(place).name != "column")
            continue;
        EXPECT_GT(place.z, shot.position.z);
        EXPECT_GT(glm::dot(numbers.camera(i), glm::normalize(shot.u)), std::cos(50 * degree)); // the whole view lies ahead
        for (const dvec2& axis : columns)
            if (std::hypot(place.x - axis.x, place.z - axis.y) < 0.4)
                ++behind[axis.y];
    }
    // Both columns at -7, one unit behind the camera at -8, stand at the picture's edges.
    EXPECT_GT(behind[-7], 1000);
    for (const auto& [z, count] : behind)
        EXPECT_GT(z, -8) << count;
}

/// Camera directions of a column's two edges at eye height, from a picture `across` radians wide towards `look`.
struct Edges {
    dvec3 left, right;
    double width() const { return between(left, right); }
    double pixel;
};
Edges edges(const Shot& aimed, const dvec3& look, double across, const dvec2& axis)
{
    constexpr ivec2 size(400, 20);
    Shot shot = aimed;
    shot.ship_from_cockpit = orientation(look, {0, 1, 0});
    const double fov_y = 2 * std::atan(std::tan(across / 2) * size.y / size.x);
    OffscreenRenderer offscreen = renderer(avenue().world, one_view(Planar{fov_y / degree}, size));
    const Numbers numbers(offscreen, shot);
    int first = -1, last = -1;
    const int row = size.y / 2 * size.x;
    for (int i = row; i < row + size.x; ++i) {
        const dvec3 place = shot.position + numbers.depth(i) * numbers.world(i);
        if (std::isfinite(numbers.depth(i)) && std::hypot(place.x - axis.x, place.z - axis.y) < 0.2)
            first = first < 0 ? i : first, last = i;
    }
    EXPECT_GT(first, row);
    EXPECT_LT(last, row + size.x - 1);
    EXPECT_GT(last - first, 40);
    auto half = [&](int a, int b) { return glm::normalize(numbers.camera(a) + numbers.camera(b)); };
    return {half(first - 1, first), half(last, last + 1), across / size.x};
}

// Eq. 5: small angles shrink by 1/D. Each edge must also lie where the boost puts the edge at rest.
TEST(Paper, ColumnsAheadAreNarrowerByD)
{
    const dvec3 eye(0, 0, -8);
    struct Case {
        dvec2 axis;
        double small_angle; // the relative difference between a column this wide and a very narrow one
    };
    // The nearest columns are so wide that D varies over them.
    for (const Case& c : {Case{{0.8, -9}, 0.02}, {{-0.8, -11}, 0.005}, {{0.8, -13}, 0.003}, {{0, -46}, 0.001}}) {
        const dvec3 to(c.axis.x - eye.x, 0, c.axis.y - eye.z), n = glm::normalize(to);
        const double wide = 4 * 0.14 / glm::length(to);
        const Edges rest = edges(shot_at(eye, {0, 0, 0}, n), n, wide, c.axis);
        for (double gamma : {2.0, 4.0}) {
            const dvec3 u(0, 0, -u_of_gamma(gamma));
            const auto seen = quad::camera_from_world(quad::of(n), quad::of(u));
            const double D = double(seen.D);
            const dvec3 look(double(seen.n.x), double(seen.n.y), double(seen.n.z));
            const Edges moving = edges(shot_at(eye, u, look), look, wide / D, c.axis);
            for (auto [at_rest, now] : {std::pair(rest.left, moving.left), std::pair(rest.right, moving.right)}) {
                const auto expected = quad::camera_from_world(quad::of(at_rest), quad::of(u));
                // Half a pixel and 0.4 of a texel for each picture.
                EXPECT_LT(quad::angle(quad::of(now), expected.n), 2 * 0.9 * moving.pixel) << c.axis.y;
            }
            const double ratio = moving.width() / rest.width() * D;
            std::printf("  column at %5.1f, gamma %g: width %.5f of that at rest, times D %.4f\n", c.axis.y, gamma,
                moving.width() / rest.width(), ratio);
            // Four edges, each known to 0.9 pixels of about 1/200 of the width.
            EXPECT_NEAR(ratio, 1, 4 * 0.9 * moving.pixel / moving.width() + c.small_angle);
        }
    }
}

// "At first it seems that they are moving backwards": under thrust the column at the end first shrinks, then grows, by
// L/(L-x) e^-eta with x = (cosh eta - 1)/a.
TEST(Paper, UnderThrustTheColumnFirstShrinks)
{
    const dvec2 axis(0, -46);
    const double L = 46, a = 0.05, wide = 4 * 0.14 / L;
    auto width = [&](double eta) {
        const double x = (std::cosh(eta) - 1) / a;
        return edges(shot_at({0, 0, -x}, {0, 0, -std::sinh(eta)}, {0, 0, -1}), {0, 0, -1}, wide, axis);
    };
    const Edges start = width(0);
    const double smallest = std::log(1 + a * L), again = std::log(1 + 2 * a * L);
    for (double eta : {0.02, 0.1, 0.5, smallest, again}) {
        const double expected = L / (L - (std::cosh(eta) - 1) / a) * std::exp(-eta);
        const double found = width(eta).width() / start.width();
        std::printf("  e^eta %.3f: size %.4f, by the formula %.4f\n", std::exp(eta), found, expected);
        // Four edges of at most half a pixel and 0.4 of a texel. From nearer by, the tangents touch other ridges of the 20
        // flutes, which changes the silhouette by a hundredth.
        EXPECT_NEAR(found, expected, 4 * 0.9 * start.pixel / start.width() + 0.01 * expected) << eta;
    }
    EXPECT_NEAR(L / (L - (std::cosh(smallest) - 1) / a) * std::exp(-smallest), 2 / (2 + a * L), 1e-12);
    // Directly after a boost to 0.1 c, while nothing has come nearer.
    const double b = 0.1;
    const double jump
        = edges(shot_at({0, 0, 0}, {0, 0, -u_of_beta(b)}, {0, 0, -1}), {0, 0, -1}, wide, axis).width() / start.width();
    EXPECT_NEAR(jump, 0.9045340, 4 * 0.9 * start.pixel / start.width());
}

// ---------------------------------------------------------------- spheres

struct Outline {
    dvec3 pole;
    double radius;
    double rms; ///< distance of the edge's points from the circle in pixels; a point lies between a pixel inside and one
                ///< outside
    double stray; ///< the farthest pixel of the Earth outside the circle, or of the sky inside it, in pixels
    double pixel;
    int points;
};

/// Fits a circle on the sphere of directions to the Earth's outline in the camera.
Outline earth_outline(const Shot& shot, const Projection& projection, bool over_a_half_sphere = false)
{
    constexpr ivec2 size(256, 256);
    OffscreenRenderer offscreen(device(), pipelines(), avenue().world, one_view(projection, size),
        {.texels_per_pixel = 3, .max_texels_per_pixel = 40, .cube_samples = 1}, true);
    const Numbers numbers(offscreen, shot);
    auto earth = [&](int i) {
        return numbers.shown(i) && std::isfinite(numbers.depth(i))
            && glm::length(shot.position + numbers.depth(i) * numbers.world(i) - earth_place) < 1.02 * earth_radius;
    };
    std::vector<dvec3> points;
    std::vector<std::pair<int, bool>> rim; // pixels at the edge, with true for those that show the Earth
    auto edge = [&](int i, int j) {
        if (numbers.shown(i) && numbers.shown(j) && earth(i) != earth(j)) {
            points.push_back(glm::normalize(numbers.camera(i) + numbers.camera(j)));
            rim.insert(rim.end(), {{i, earth(i)}, {j, earth(j)}});
        }
    };
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            if (x > 0)
                edge(y * size.x + x - 1, y * size.x + x);
            if (y > 0)
                edge((y - 1) * size.x + x, y * size.x + x);
        }
    // A circle on the sphere is a plane cut: a least-squares fit of dot(p, n) = h about the mean, with p of unit length.
    dvec3 middle(0);
    for (const dvec3& n : points)
        middle += n / double(points.size());
    dmat3 spread(0);
    for (const dvec3& n : points)
        spread += glm::outerProduct(n - middle, n - middle);
    // Inverse iteration finds the direction of least variance.
    dvec3 pole = glm::normalize(middle);
    const dmat3 inverse = glm::inverse(spread + dmat3(1e-12 * (spread[0][0] + spread[1][1] + spread[2][2])));
    for (int k = 0; k < 50; ++k)
        pole = glm::normalize(inverse * pole);
    if ((glm::dot(pole, middle) < 0) != over_a_half_sphere)
        pole = -pole;
    Outline outline{pole, 0, 0, 0, 0, int(points.size())};
    for (const dvec3& n : points)
        outline.radius += between(pole, n) / double(points.size());
    auto off = [&](const dvec3& n) { // distance outside the circle, in pixels
        const dvec2 at = *pixel(Picture{projection, size}, glm::inverse(shot.ship_from_cockpit) * n);
        return (between(pole, n) - outline.radius) / pixel_angle(Picture{projection, size}, at);
    };
    for (const dvec3& n : points)
        outline.rms += off(n) * off(n) / double(points.size());
    outline.rms = std::sqrt(outline.rms);
    for (auto [i, inside] : rim)
        outline.stray = std::max(outline.stray, (inside ? 1 : -1) * off(numbers.camera(i)));
    outline.pixel = pixel_angle(Picture{projection, size}, dvec2(size) * 0.5);
    return outline;
}

/// The closed form: the circle in the camera for a circle of angular `radius` about `axis` in the world, seen with u. It
/// follows from the ends of the diameter in the plane of motion.
struct Circle {
    dvec3 pole;
    double radius;
};
Circle seen_circle(const dvec3& axis, double radius, const dvec3& u)
{
    const double speed = glm::length(u);
    if (speed == 0)
        return {axis, radius};
    const dvec3 z = u / speed;
    const double theta = between(z, axis), E = speed + std::sqrt(1 + speed * speed);
    auto camera = [&](double world) { return 2 * std::atan(std::tan(world / 2) / E); };
    double low = camera(theta - radius), high = camera(theta + radius);
    if (theta + radius > pi)
        high += 2 * pi;
    const dvec3 side = axis - glm::dot(axis, z) * z;
    const double middle = (low + high) / 2;
    const dvec3 across = glm::length(side) > 1e-12 ? glm::normalize(side) : dvec3(0);
    return {z * std::cos(middle) + across * std::sin(middle), (high - low) / 2};
}

void expect_circle(const char* what, const Outline& found, const Circle& expected)
{
    std::printf("  %s: %d edge points, residual rms %.3f, stray %.3f pixels; centre off %.3f, radius %.5f of %.5f degrees "
                "(%.3f pixels)\n",
        what, found.points, found.rms, found.stray, between(found.pole, expected.pole) / found.pixel, found.radius / degree,
        expected.radius / degree, (found.radius - expected.radius) / found.pixel);
    EXPECT_GT(found.points, 100) << what;
    // An edge lies between two pixels' centres: half a pixel each way, evenly spread, is 0.29. The next line's errors add to
    // it.
    EXPECT_LT(found.rms, 0.4) << what;
    // A texel of a third of a pixel is up to 0.24 off; facets of 1e-3 of the radius add 0.1, and the fit another 0.1.
    EXPECT_LT(found.stray, 0.45) << what;
    // Hundreds of such points average out. The facets' sagitta, 1e-3 of 100 pixels, remains.
    EXPECT_LT(between(found.pole, expected.pole), 0.2 * found.pixel) << what;
    EXPECT_NEAR(found.radius, expected.radius, 0.25 * found.pixel) << what;
}

TEST(Paper, TheEarthsOutlineIsACircleAtAnySpeed)
{
    const double away = 3 * earth_radius;
    for (double gamma : {1.0, 1.1, 2.0, 4.0, 10.0, 100.0})
        for (double aside : {40.0, 90.0, 150.0}) { // of the Earth from the motion, in the world
            const dvec3 way = glm::normalize(dvec3(0.2, -0.1, -1)), side = glm::normalize(glm::cross(way, dvec3(0.3, 1, 0)));
            const dvec3 axis = way * std::cos(aside * degree) + side * std::sin(aside * degree);
            const dvec3 u = way * u_of_gamma(gamma);
            const Circle expected = seen_circle(axis, std::asin(earth_radius / away), u);
            if (expected.radius > 50 * degree)
                continue;
            const Shot shot = shot_at(earth_place - away * axis, u, expected.pole);
            char what[80];
            std::snprintf(what, sizeof what, "gamma %g, %g degrees aside", gamma, aside);
            // The planar picture holds the circle with a margin of a quarter.
            const Projection view = Planar{2 * std::atan(1.25 * std::tan(expected.radius)) / degree};
            expect_circle(what, earth_outline(shot, view), expected);
        }
}

TEST(Paper, ASphereSeenHeadOnHasTheClosedFormsRadius)
{
    const struct {
        double radius, beta, seen; // degrees
    } table[] = {{30, .5, 17.58795}, {30, .9, 7.03529}, {30, -.5, 49.79218}, {30, -.9, 98.86031},
        {10, std::sqrt(15.0) / 4, 1.27335}, {10, -std::sqrt(15.0) / 4, 69.11789}};
    for (const auto& row : table) {
        // The motion is along the line of sight; -x leads away from the columns.
        const dvec3 axis(-1, 0, 0), u = axis * (row.beta > 0 ? 1.0 : -1.0) * u_of_beta(std::abs(row.beta));
        const Shot shot = shot_at(earth_place - axis * (earth_radius / std::sin(row.radius * degree)), u, axis);
        // A fisheye that looks straight ahead; the circle reaches up to 98.9 degrees from its middle.
        const Projection view = Fisheye{2.4 * row.seen, 90};
        const Outline found = earth_outline(shot, view, row.seen > 90);
        char what[80];
        std::snprintf(what, sizeof what, "radius %g, beta %.3f", row.radius, row.beta);
        expect_circle(what, found, {axis, row.seen * degree});
    }
}

// ---------------------------------------------------------------- colours

double peak(const dvec3& c) { return std::max({c.r, c.g, c.b}); }

/// In degrees: red 0, green 120, blue 240. A red with a trace of blue is a little below 0.
double hue_of(const dvec3& c)
{
    const double hue = std::atan2(std::sqrt(3.0) * (c.g - c.b), 2 * c.r - c.g - c.b) / degree;
    return hue < -60 ? hue + 360 : hue;
}

TEST(Paper, TheStippledCylinderHasTheColoursOfItsReflectance)
{
    // The expected colour: the material's blue, 0.02, 0.06, 1, as a smooth reflectance under the Sun, summed over every
    // nanometre.
    auto colour_at = [](double D) {
        const Spectrum sun = sunlit_white();
        const double mean = (0.02 + 0.06 + 1) / 3;
        return rec709_from_sunlit_xyz()
            * seen_xyz(
                [&](double nm) {
                    return sun(nm) * base_reflectance({0.02, 0.06, 1}, mean, mean, nm);
                },
                D);
    };
    OffscreenRenderer offscreen = renderer(avenue().world, one_view(Planar{60}, {400, 300}));
    const Shot shot = load_shot(testing::source_dir() / "config/shots/rainbow.json");
    const Numbers numbers(offscreen, shot);
    std::vector<double> hues;
    for (int x = 0; x < numbers.size.x; ++x) {
        // The stipple's dots are dark, so the brightest pixel of each column shows the blue between them.
        dvec3 brightest(0);
        double D = 0;
        for (int y = 0; y < numbers.size.y; ++y) {
            const int i = y * numbers.size.x + x;
            const dvec3 light = numbers.light(i);
            const dvec3 place = shot.position + numbers.depth(i) * numbers.world(i);
            if (std::isfinite(numbers.depth(i)) && nearest_at(place).name == "stippled cylinder"
                && peak(light) > peak(brightest))
                brightest = light, D = numbers.D(i);
        }
        ASSERT_GT(peak(brightest), 0) << x; // the cylinder spans the picture
        hues.push_back(hue_of(brightest));
        // The lamps are not quite white: channels differ by up to 35 %, which changes the hue by some degrees.
        const double off = std::remainder(hues.back() - hue_of(colour_at(D)), 360);
        EXPECT_LT(std::abs(off), 10) << x << " D " << D;
        // At D = 1 the colour is the material's own.
        if (std::abs(D - 1) < 0.004) {
            EXPECT_NEAR(brightest.g / brightest.b, 0.06, 0.03) << x; // D 0.4 % off moves green by 0.02 of blue
        }
    }
    std::printf("  hues %.0f (left), %.0f, %.0f, %.0f, %.0f (right)\n", hues[0], hues[100], hues[200], hues[300], hues[399]);
}

} // namespace
} // namespace starbow::gpu_test::paper_gpu_test
