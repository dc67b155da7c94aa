// The reference picture in simple worlds that need no renderer: closed formulas, retarded positions by bisection in 33
// digits, and published colours.
#include "config/model/angles.h"
#include "config/model/one_view.h"
#include "runtime/light/colour.h"
#include "runtime/reference/clock_face.h"
#include "runtime/reference/reference.h"
#include "runtime/world/moving.h"
#include "runtime/world/worldline.h"
#include "shaders/physics/physics.h"
#include "tests/support/files.h"
#include "tests/support/quad.h"
#include "tests/support/shots.h"
#include "tests/support/speeds.h"
#include <gtest/gtest.h>

namespace reference_test {

using namespace starbow;
using glm::dvec2;
using glm::dvec3;

namespace {

using starbow::testing::shot_at, starbow::testing::u_of_beta, starbow::testing::u_of_gamma;

/// A world of rectangles with one material each.
struct Plates {
    World world;
    SceneFile scene;
    std::vector<Star> stars;

    /// Adds a rectangle. Seen from its front, `right` points right and `up` upwards; texture coordinates 0, 0 are at its top
    /// left.
    Material& add(const dvec3& centre, const dvec3& right, const dvec3& up, const std::string& node = "still")
    {
        const auto first = std::uint32_t(world.vertices.size());
        const dvec3 normal = glm::normalize(glm::cross(right, up));
        for (const dvec2& side : {dvec2(-1, -1), dvec2(1, -1), dvec2(1, 1), dvec2(-1, 1)})
            world.vertices.push_back({glm::vec3(right * side.x + up * side.y), glm::vec3(normal),
                glm::vec2(0.5 + 0.5 * side.x, 0.5 - 0.5 * side.y), 0xffffffff});
        const auto index = std::uint32_t(world.indices.size());
        world.indices.insert(world.indices.end(), {0, 1, 2, 0, 2, 3});
        const double radius = glm::length(right) + glm::length(up);
        world.primitives.push_back({index, 6, std::int32_t(first), int(world.materials.size()),
            -glm::abs(right) - glm::abs(up), glm::abs(right) + glm::abs(up), dvec3(0), radius, {}});
        world.nodes.push_back({node, -1});
        glm::dmat4 place(1);
        place[3] = glm::dvec4(centre, 1);
        world.instances.push_back({place, std::uint32_t(world.primitives.size() - 1), int(world.nodes.size() - 1)});
        world.materials.emplace_back();
        return world.materials.back();
    }
    Material& shining(const dvec3& centre, const dvec3& right, const dvec3& up, const std::string& node = "still")
    {
        Material& material = add(centre, right, up, node);
        material.unlit = true;
        return material;
    }
    void place()
    {
        if (!std::exchange(placed_, true))
            place_bodies(world, scene);
    }
    Reference seen(const Shot& shot, const Layout& layout, ReferenceOptions options = {})
    {
        place();
        return reference({world, scene, stars}, layout, shot, 0, options);
    }

private:
    bool placed_ = false;
};

/// The light's mean place in pixels, and its sum.
dvec3 middle(const Reference& picture)
{
    dvec3 sum(0);
    for (int y = 0; y < picture.size.y; ++y)
        for (int x = 0; x < picture.size.x; ++x)
            sum += picture.light[0][std::size_t(y * picture.size.x + x)].g * dvec3(x + 0.5, y + 0.5, 1);
    return {sum.x / sum.z, sum.y / sum.z, sum.z};
}

std::size_t central(const Reference& picture)
{
    return std::size_t(picture.size.y / 2 * picture.size.x + picture.size.x / 2);
}

} // namespace

// A point is a disc of a pixel's area, a line a strip as wide as a pixel, however far away and however fast one passes: so
// the sums of their light are known, and so is the middle's place, by the aberration's formula.
TEST(Reference, PointsAndLinesAreAsWideAsAPixelAndAberrated)
{
    const auto strokes = [](Topology topology, const std::vector<dvec3>& places, std::vector<std::uint32_t> indices) {
        Plates plates;
        for (const dvec3& at : places)
            plates.world.vertices.push_back({glm::vec3(at), glm::vec3(0), glm::vec2(0), 0xffffffff});
        plates.world.indices = std::move(indices);
        plates.world.primitives.push_back(
            {0, std::uint32_t(plates.world.indices.size()), 0, 0, dvec3(-100), dvec3(100), dvec3(0), 200, {}});
        plates.world.primitives[0].topology = topology;
        plates.world.nodes.push_back({"strokes", -1});
        plates.world.instances.push_back({glm::dmat4(1), 0, 0});
        plates.world.materials = {{}};
        plates.world.materials[0].unlit = true;
        return plates;
    };
    constexpr int side = 60;
    const Layout layout = one_view(Planar{.fov_y_deg = 30}, {side, side});
    const double per_tangent = side / 2 / std::tan(15 * degree); // pixels
    for (const double beta : {0.0, 0.5, -0.5})
        for (const double far : {3.0, 300.0}) {
            const dvec3 way = glm::normalize(dvec3(0.1, 0.05, -1));
            Shot shot = shot_at(dvec3(0), dvec3(0, 0, -u_of_beta(beta)));
            shot.effects.on.set(Effect::doppler, false), shot.effects.on.set(Effect::headlight, false);
            Plates plates = strokes(Topology::points, {way * far}, {0});
            const dvec3 seen = middle(plates.seen(shot, layout, {.samples = 256}));
            // Straight ahead is -z: tan(half the angle) shrinks by sqrt((1 - beta) / (1 + beta)).
            const double angle = std::acos(-way.z);
            const double shown = 2 * std::atan(std::tan(angle / 2) * std::sqrt((1 - beta) / (1 + beta)));
            const dvec2 across = glm::normalize(dvec2(way.x, -way.y)) * std::tan(shown) * per_tangent + side / 2.0;
            // 256 rays of a pixel stand a sixteenth of it apart.
            EXPECT_NEAR(seen.x, across.x, 1.0 / 16) << beta << ' ' << far;
            EXPECT_NEAR(seen.y, across.y, 1.0 / 16) << beta << ' ' << far;
            // Off the middle a flat picture's pixels look smaller, by the cube of the angle's cosine.
            EXPECT_NEAR(seen.z, std::pow(std::cos(shown), -3), 1.0 / 16) << beta << ' ' << far;
        }
    const double half = std::tan(10 * degree) * 5;
    Plates plates = strokes(Topology::lines, {{-half, 0, -5}, {half, 0, -5}, {half, 0, 5}}, {0, 1, 1, 2});
    const dvec3 seen = middle(plates.seen(shot_at(dvec3(0), dvec3(0)), layout, {.samples = 64}));
    // The second line leads past the eye: it shows from the first one's end to the picture's edge.
    const double ends = per_tangent * std::tan(10 * degree);
    EXPECT_NEAR(seen.z, ends + side / 2.0, 0.06 * side);
    EXPECT_NEAR(seen.y, side / 2.0, 1.0 / 16);
}

TEST(Reference, LampsLightASurfaceByTheirRadiance)
{
    Plates plates;
    const dvec3 base(0.5, 0.25, 0.125);
    plates.add({0, 0, -5}, {1, 0, 0}, {0, 1, 0}).base_colour = glm::vec4(base, 1);
    plates.scene.ambient = {0.1, 0.2, 0.3};
    const dvec3 sun(1, 0.5, 0.25), lamp(0.3, 0.6, 0.9);
    plates.scene.lights = {
        DirectionalLight{{0, std::sin(60 * degree), std::cos(60 * degree)}, sun, {}}, PointLight{{3, 0, -1}, 2, lamp, {}}};
    const Reference picture = plates.seen(shot_at(dvec3(0), dvec3(0)), one_view(Planar{.fov_y_deg = 0.01}, {1, 1}));
    // The lamp is 5 away, and its light arrives at an angle whose cosine is 4/5.
    const dvec3 light = base * (plates.scene.ambient + sun * 0.5 + lamp * (0.8 * 4.0 / 25));
    const dvec3 seen = picture.light[0][0];
    // The primaries' reflectances are tables with five digits, and the pixel is 1e-4 rad wide.
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(seen[c], light[c], 1e-3 * light[c]);
    EXPECT_NEAR(picture.numbers[0].distance, 5, 1e-12);
}

TEST(Reference, DirectionsAreAberratedAsTheTextbookSays)
{
    // The cosine in the ship is (cos + beta) / (1 + beta cos) of the world's. The reference uses another form.
    for (double beta : {0.5, 0.9, 0.99}) {
        Plates plates;
        const double small = 1e-4;
        // At right angles to a motion along -z.
        plates.shining({1, 0, 0}, {0, 0, small}, {0, small, 0});
        const double expected
            = std::acos(beta) / degree; // angle from the motion of a direction at right angles to it in the world
        const Layout layout = one_view(Planar{.fov_y_deg = 0.067}, {101, 101});
        const dvec3 look(std::sin(expected * degree), 0, -std::cos(expected * degree));
        const dvec3 at = middle(plates.seen(shot_at(dvec3(0), {0, 0, -u_of_beta(beta)}, look), layout, {.samples = 16}));
        // Its width changes the direction by its square, 1e-8. A pixel is 1e-5 rad; an edge is off by 1/16 of one.
        EXPECT_GT(at.z, 4) << beta;
        EXPECT_NEAR(at.x, 50.5, 0.1) << "beta " << beta;
        EXPECT_NEAR(at.y, 50.5, 0.1);
    }
}

TEST(Reference, StraightBehindAtGamma1000ALineIsSharpToAThousandthOfAPixel)
{
    // The tangent of half the angle from straight behind is E times as large in the ship. A pixel is 0.7e-6 rad of the
    // world.
    const double gamma = 1000, u = u_of_gamma(gamma), E = u + gamma;
    Plates plates;
    const double from = 4.1234567e-5, to = 8.7654321e-5; // from the axis; -x is to the right when looking back
    plates.shining({-0.5 * (from + to) * 7, 0, 7}, {-3.5 * (to - from), 0, 0}, {0, 1, 0});
    const Layout layout = one_view(Planar{.fov_y_deg = 2.0 / 3}, {400, 1});
    const Reference picture = plates.seen(shot_at(dvec3(0), {0, 0, -u}, {0, 0, 1}), layout, {.samples = 4096});
    const double focal = 0.5 / std::tan(1.0 / 3 * degree);
    auto pixel_of
        = [&](double tangent) { return 200 + focal * std::tan(2 * std::atan(E * std::tan(0.5 * std::atan(tangent)))); };
    // Vertices are floats, so that the plate's ends are rounded.
    const float half = float(3.5 * (to - from));
    const double centre = 0.5 * (from + to) * 7;
    const double left = pixel_of((centre - double(half)) / 7), right = pixel_of((centre + double(half)) / 7);
    ASSERT_GT(left, 200);
    ASSERT_LT(right, 400);
    // The light's sum and its first lit place, with 4096 columns of samples in a pixel.
    double sum = 0, at = 0;
    for (std::size_t x = 0; x < 400; ++x)
        sum += picture.light[0][x].g, at += picture.light[0][x].g * (double(x) + 0.5);
    // The row's height shifts the line by 1e-4 pixels, each end falls between two columns, and white is right to 1e-4.
    EXPECT_NEAR(sum, right - left, 1e-3 + 1e-4 * (right - left));
    double first = 0;
    for (std::size_t x = 0; x < 400; ++x) {
        const double here = picture.light[0][x].g;
        if (here > 0) {
            first = double(x) + 1 - here; // the first lit pixel is lit from here on
            break;
        }
    }
    EXPECT_NEAR(first, left, 1e-3);
}

/// Every second ring of radii that double, seen from the distance `far`: regular polygons of so many corners, across the
/// unit direction `axis`.
struct Rings {
    static constexpr int corners = 24;
    dvec3 axis, right, up;
    double least, far;
    int count;
    double radius(int ring) const { return least * std::exp2(ring); }

    void add_to(World& world) const
    {
        const auto first = std::uint32_t(world.vertices.size()), index = std::uint32_t(world.indices.size());
        for (int ring = 0; ring < count; ring += 2)
            for (int k = 0; k < corners; ++k) {
                const auto at = std::uint32_t(world.vertices.size() - first);
                for (const auto& [r, a] :
                    {std::pair(radius(ring), k), {radius(ring + 1), k}, {radius(ring + 1), k + 1}, {radius(ring), k + 1}})
                    world.vertices.push_back(
                        {glm::vec3(r * std::cos(2 * pi * a / corners), r * std::sin(2 * pi * a / corners), 0),
                            glm::vec3(0, 0, 1), glm::vec2(0), 0xffffffff});
                world.indices.insert(world.indices.end(), {at, at + 1, at + 2, at, at + 2, at + 3});
            }
        const double widest = radius(count);
        world.primitives.push_back({index, std::uint32_t(world.indices.size()) - index, std::int32_t(first), 0,
            dvec3(-widest, -widest, 0), dvec3(widest, widest, 0), dvec3(0), widest, {}});
        world.materials.emplace_back();
        world.materials.back().unlit = world.materials.back().double_sided = true;
        world.nodes.push_back({"rings", -1});
        glm::dmat4 place(1);
        place[0] = glm::dvec4(right, 0), place[1] = glm::dvec4(up, 0), place[2] = glm::dvec4(axis, 0);
        place[3] = glm::dvec4(far * axis, 1);
        world.instances.push_back({place, 0, 0});
    }

    /// True if a ring lies along n; the distance in radii to the nearest edge.
    std::pair<bool, double> along(const quad::V3& n) const
    {
        const quad::Q deep = quad::dot(n, quad::of(axis));
        const quad::Q x = quad::dot(n, quad::of(right)) / deep * far, y = quad::dot(n, quad::of(up)) / deep * far;
        const double r = double(sqrtq(x * x + y * y)), sector = 2 * pi / corners;
        const double from_middle = std::remainder(double(atan2q(y, x)) - 0.5 * sector, sector);
        // A polygon's side is at its corners' radius times the cosine of half a sector.
        const double rings = std::log2(r * std::cos(from_middle) / std::cos(0.5 * sector) / least);
        const int ring = int(std::floor(rings));
        const double edge = std::abs(rings - std::round(rings)) * std::log(2);
        return {deep > 0 && ring >= 0 && ring < count && ring % 2 == 0, edge};
    }
};

// Straight behind, a pixel is a billionth of a radian of the world, and so are triangles there. Directions in 33 digits tell
// which pixels show a ring; only those whose centre is on an edge, but for the rounding of vertices and directions, may
// differ.
TEST(Reference, StraightBehindTrianglesMuchSmallerThanTheirDistanceAreMet)
{
    const dvec3 ahead = glm::normalize(dvec3(0.3, -0.55, 0.78));
    const dvec3 right = glm::normalize(glm::cross(dvec3(0.1, 1, 0.2), ahead));
    for (double gamma : {1e4, 1e5, 1e6}) {
        World world;
        world.materials.clear();
        // The picture is 60 degrees wide, and angles behind are smaller by 2 gamma.
        const Rings rings{-ahead, right, glm::cross(-ahead, right), 7 * 0.01 / (2 * gamma), 7, 7};
        rings.add_to(world);
        SceneFile scene;
        place_bodies(world, scene);
        const std::vector<Star> no_stars;
        const Shot shot = shot_at(dvec3(0), u_of_gamma(gamma) * ahead, -ahead, right);
        const Layout layout = one_view(Planar{.fov_y_deg = 60}, {60, 45});
        const Reference picture = reference({world, scene, no_stars}, layout, shot, 0, {.samples = 1});
        int shown = 0, wrong = 0;
        for (std::size_t i = 0; i < picture.numbers.size(); ++i) {
            const quad::Light light
                = quad::world_from_camera(quad::of(glm::normalize(picture.numbers[i].camera)), quad::of(shot.u));
            const auto [ring, edge] = rings.along(light.n);
            shown += ring;
            if (std::isfinite(picture.numbers[i].distance) != ring && edge > 1e-4)
                ++wrong;
        }
        EXPECT_GT(shown, 600) << gamma;
        EXPECT_EQ(wrong, 0) << "gamma " << gamma;
    }
}

TEST(Reference, ShiftedBlackBodiesHaveTheColoursOfTheirNewTemperature)
{
    // Published CIE 1931 chromaticities of the temperature that D makes of another one.
    struct Known {
        double kelvin, x, y;
    };
    for (const Known& known : {Known{2856, 0.4475, 0.4074}, {5772, 0.3266, 0.3358}, {10000, 0.2806, 0.2883}})
        for (double beta : {-0.6, 0.6, 0.8}) {
            const double D = std::sqrt((1 + beta) / (1 - beta));
            Plates plates;
            Material& material = plates.add({0, 0, -5}, {1, 0, 0}, {0, 1, 0});
            material.temperature_K = known.kelvin / D, material.emissivity = 1;
            material.base_colour = glm::vec4(0, 0, 0, 1);
            Shot shot = shot_at(dvec3(0), {0, 0, -u_of_beta(beta)});
            shot.effects = {};
            const dvec3 rgb = plates.seen(shot, one_view(Planar{.fov_y_deg = 0.001}, {1, 1})).light[0][0];
            const dvec3 xyz = glm::inverse(rec709_from_sunlit_xyz()) * rgb;
            const double sum = xyz.x + xyz.y + xyz.z;
            // Four digits are published.
            EXPECT_NEAR(xyz.x / sum, known.x, 1e-4) << known.kelvin << " K at D " << D;
            EXPECT_NEAR(xyz.y / sum, known.y, 1e-4) << known.kelvin << " K at D " << D;
            // It must equal a resting plate of the new temperature: with the headlight effect only T changes.
            Plates rest;
            rest.add({0, 0, -5}, {1, 0, 0}, {0, 1, 0}).temperature_K = known.kelvin;
            rest.world.materials[0].emissivity = 1, rest.world.materials[0].base_colour = glm::vec4(0, 0, 0, 1);
            const dvec3 still
                = rest.seen(shot_at(dvec3(0), dvec3(0)), one_view(Planar{.fov_y_deg = 0.001}, {1, 1})).light[0][0];
            EXPECT_NEAR(rgb.g / still.g, 1, 2e-4);
        }
}

TEST(Reference, AStarGivesAllItsLight)
{
    // At D = 2.90 the Sun's 5772 K is 2.88 times as bright as at rest. Its light over a solid angle follows from its
    // magnitude.
    const double D = 2.90, beta = (D * D - 1) / (D * D + 1);
    double illuminance[2];
    for (int flying = 0; flying < 2; ++flying) {
        Plates plates;
        StarSky sky;
        sky.ahead_deg = {30, 20};
        plates.scene.stars = sky;
        plates.stars = {{equatorial(30, 20), 1.5, 5772}};
        Shot shot = shot_at(dvec3(0), {0, 0, flying ? -u_of_beta(beta) : 0.0});
        shot.effects = {};
        const glm::ivec2 size(21, 16); // the picture's middle is a pixel's middle across, and a pixel's edge down
        const Reference picture = plates.seen(shot, one_view(Planar{.fov_y_deg = 1}, size));
        const double pixel = 2 * std::tan(0.5 * degree) / size.y;
        dvec3 light(0); // the whole picture is near the axis
        for (std::size_t i = 0; i < picture.numbers.size(); ++i) // glare beyond the picture's edges would be missing
            light += (picture.light[0][i] - picture.numbers[i].glare) * (pixel * pixel);
        illuminance[flying] = (glm::inverse(rec709_from_sunlit_xyz()) * light).y;
        EXPECT_NEAR(middle(picture).x, 10.5, 1e-3);
        EXPECT_NEAR(middle(picture).y, 8, 1e-3);
    }
    // A spot's sum over pixels is 1 within 0.5 %.
    const double expected = 200 * std::pow(degree / 60, 2) * std::pow(10, -0.4 * 1.5);
    EXPECT_NEAR(illuminance[0] / expected, 1, 0.006);
    EXPECT_NEAR(illuminance[1] / illuminance[0], 2.88, 0.006); // three digits are known
}

TEST(Reference, AStarBehindAPlateIsHidden)
{
    for (bool hidden : {false, true}) {
        Plates plates;
        plates.scene.stars = StarSky{};
        plates.stars = {{equatorial(0, 0), 0, 5772}};
        Material& plate = plates.shining({hidden ? 0.0 : 0.1, 0, -9}, {0.05, 0, 0}, {0, 0.05, 0});
        plate.base_colour = glm::vec4(0, 0, 0, 1);
        const double sum = middle(plates.seen(shot_at(dvec3(0), dvec3(0)), one_view(Planar{.fov_y_deg = 1}, {15, 15}))).z;
        EXPECT_EQ(sum > 0, !hidden);
    }
}

TEST(ClockFace, TheHandPointsToTheTime)
{
    for (double seconds : {0.0, 3.8, 29.5, 44.25, 3599.9, -5.9, 1e7 + 0.3}) {
        const double angle = 2 * pi * std::fmod(seconds, 60) / 60;
        for (double r : {0.65, 0.75}) {
            const dvec2 way(std::sin(angle), std::cos(angle)), aside(way.y, -way.x);
            EXPECT_EQ(mark(way * r, seconds, "0.0"), 1) << seconds;
            EXPECT_EQ(mark(way * r + aside * 0.03, seconds, "0.0"), 0) << seconds; // the hand's margin
        }
        EXPECT_EQ(mark(dvec2(std::sin(angle), std::cos(angle)) * 0.835, seconds, "0.0"), 0) << seconds;
    }
    // The figures' ink grows with their segments: a 1 has two, a 7 three, an 8 seven.
    auto ink = [](const std::string& figures) {
        int count = 0;
        for (int y = 0; y < 400; ++y)
            for (int x = 0; x < 400; ++x)
                count += mark({(x - 200) / 500.0, -0.43 + (y - 200) / 1200.0}, 0, figures) == 1;
        return count;
    };
    EXPECT_LT(ink("1.1"), ink("7.1"));
    EXPECT_LT(ink("7.1"), ink("8.1"));
}

TEST(Reference, AClockShowsItsRetardedTime)
{
    Plates plates;
    Material& dial = plates.add({0, 0, -31}, {1, 0, 0}, {0, 1, 0});
    dial.unlit = true;
    dial.clock = WorldClock{2.5};
    Shot shot = shot_at(dvec3(0), dvec3(0));
    shot.time = 100;
    const glm::ivec2 size(201, 201);
    const Reference picture = plates.seen(shot, one_view(Planar{.fov_y_deg = 2 * std::atan(1.0 / 31) / degree}, size));
    // The hand's mean direction between the small dials and the strokes.
    dvec2 sum(0);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const dvec2 at((x + 0.5) / 100.5 - 1, 1 - (y + 0.5) / 100.5);
            const double r = glm::length(at);
            if (r > 0.72 && r < 0.8)
                sum += at / r * std::max(0.0, 1 - picture.light[0][std::size_t(y * size.x + x)].g);
        }
    const double shown_s = std::fmod(std::atan2(sum.x, sum.y) / (2 * pi) * 60 + 60, 60);
    EXPECT_NEAR(shown_s, std::fmod(100 - 31 - 2.5, 60), 0.02); // a pixel at the hand's end is 0.12 s
}

TEST(Reference, AMovingPlateIsSeenAtItsRetardedPosition)
{
    // A small plate on a body passes at half the speed of light; the ship flies at 0.8 c in another direction. Its place on
    // the past light cone comes from bisection, its direction on board from a textbook's boost, in 33 digits.
    const dvec3 u(u_of_beta(0.5), 0, 0), ship_u(0, u_of_beta(0.8), 0);
    const dvec3 at_zero(1, 2, -9); // the plate's middle in the world at time 0
    Plates plates;
    plates.shining(dvec3(0), {0.005, 0, 0}, {0, 0.005, 0}, "barge").double_sided = true;
    plates.scene.bodies = {{"barge", {"barge"}, u, {0, at_zero}, {}}};
    const double now = 3;
    quad::Q low = -100, high = now;
    for (int i = 0; i < 200; ++i) {
        const quad::Q t = (low + high) / 2;
        const quad::V3 place = quad::of(at_zero) + quad::of(dvec3(0.5, 0, 0)) * t;
        (quad::length(place) < quad::Q(now) - t ? low : high) = t;
    }
    const quad::V3 place = quad::of(at_zero) + quad::of(dvec3(0.5, 0, 0)) * low;
    // The event of emission relative to the eye's, boosted into the ship.
    const quad::V4 way = quad::boosted(quad::of(-ship_u), {low - quad::Q(now), place});
    const dvec3 look(double(way.x.x), double(way.x.y), double(way.x.z));
    Shot shot = shot_at(dvec3(0), ship_u, look, {0, 0, 1});
    shot.time = now;
    const Reference picture = plates.seen(shot, one_view(Planar{.fov_y_deg = 1}, {201, 201}), {.samples = 16});
    const dvec3 seen = middle(picture);
    ASSERT_GT(seen.z, 4);
    // A pixel is 9e-5 rad. The plate is a few pixels wide; its width changes the direction by its square.
    EXPECT_NEAR(seen.x, 100.5, 0.1);
    EXPECT_NEAR(seen.y, 100.5, 0.1);
    const Reference::Numbers& numbers = picture.numbers[central(picture)];
    EXPECT_NEAR(numbers.distance, double(quad::length(place)),
        2e-3); // the light's travel distance; the tolerance is the plate's size
    // D = k.U(ship) / k.U(plate), k = (1, -n).
    const quad::V3 n = quad::unit(place);
    auto shift = [&](const dvec3& v) { return quad::gamma(quad::of(v)) + quad::dot(n, quad::of(v)); };
    EXPECT_NEAR(numbers.D, double(shift(ship_u) / shift(u)), 2e-4);
}

TEST(Reference, ASpinningBarIsSeenAtItsRetardedAngle)
{
    // A bar turns about the line of sight, 6 long to each side, with 0.15 c at its ends. Light from the ends left earlier
    // than from the middle, because they are farther away. The expected angle follows from the retarded time.
    Plates plates;
    plates.shining(dvec3(0), {6, 0, 0}, {0, 0.05, 0}).double_sided = true;
    const double turns = 0.15 / (2 * pi * 6), far = 8;
    plates.world.joints.push_back({.node = 0, .translation = {0, 0, -far}, .spin = Spin{{0, 0, 1}, turns}});
    plates.world.motions.push_back({.joint = 0});
    plates.world.instances[0].motion = 0;
    plates.place();
    Shot shot = shot_at(dvec3(0), dvec3(0));
    shot.time = 20;
    const Reference picture = plates.seen(shot, one_view(Planar{.fov_y_deg = 100}, {251, 251}), {.samples = 4});
    const double focal = 125.5 / std::tan(50 * degree);
    for (double r : {2.0, 4.0, 5.5}) {
        const double angle = 2 * pi * turns * (20 - std::hypot(r, far)); // a circle around the line of sight: r is constant
        // The light's mean angle on that circle near the expected one.
        double sum = 0, off = 0;
        for (int i = -2000; i <= 2000; ++i) {
            const double a = angle + i * 1e-4;
            const dvec2 at = dvec2(125.5) + focal * r / far * dvec2(std::cos(a), -std::sin(a)); // y down
            const double light = picture.light[0][std::size_t(int(at.y) * 251 + int(at.x))].g;
            sum += light, off += light * (a - angle);
        }
        ASSERT_GT(sum, 0) << r;
        // 0.3 pixels are about a hundredth of the angle
        EXPECT_NEAR(off / sum * focal * r / far, 0, 0.3) << "pixels, at r " << r;
    }
}

TEST(Reference, ContinuesAnInterruptedPicture)
{
    Plates plates;
    plates.add({0, 0, -5}, {1, 0.3, 0}, {0, 1, 0}).unlit = true;
    plates.scene.sky.zenith = {0.2, 0.4, 0.8};
    const Layout layout = one_view(Planar{.fov_y_deg = 60}, {40, 32});
    const Shot shot = shot_at(dvec3(0), {0.3, 0, -1});
    const Reference whole = plates.seen(shot, layout);
    const auto kept = starbow::testing::scratch("picture.rows");
    struct Interrupted { };
    int rows = 0;
    EXPECT_THROW(plates.seen(shot, layout,
                     {.progress =
                             [&](int done, int) {
                                 if (done == 10)
                                     throw Interrupted();
                             },
                         .kept = kept}),
        Interrupted);
    ASSERT_TRUE(std::filesystem::exists(kept));
    std::filesystem::resize_file(kept, std::filesystem::file_size(kept) - 7); // the last row cut off
    const Reference again = plates.seen(shot, layout, {.progress = [&](int, int) { ++rows; }, .kept = kept});
    EXPECT_LT(rows, 24);
    EXPECT_GT(rows, 0);
    EXPECT_EQ(shown(again), shown(whole));
    EXPECT_EQ(again.light, whole.light);
    // Rows of another picture are not reused.
    Shot other = shot;
    other.position.x += 1e-9;
    rows = 0;
    plates.seen(other, layout, {.progress = [&](int, int) { ++rows; }, .kept = kept});
    EXPECT_EQ(rows, 32);
}

} // namespace reference_test
