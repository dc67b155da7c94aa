// Two eyes: each packing puts each eye's pixels where such a display expects them, and each method shows objects where the
// eye sees them. The expected places are computed here in double from the objects' places alone.
#include "config/model/angles.h"
#include "config/model/scene_file.h"
#include "runtime/render/disparity.h"
#include "tests/support/files.h"
#include "tests/support/small_world.h"
#include <functional>

namespace starbow::gpu_test::stereo_gpu_test {
namespace {

// ---------------------------------------------------------------- packings

/// Each eye is in a box of its own whose walls have tiles, so that its view in a direction is known without a renderer. The
/// eyes are 2 m apart, the walls 0.9 m from the eye.
constexpr double apart = 2, wall = 0.9;
constexpr int tiles = 6;

dvec3 tile_colour(Eye eye, int face, int i, int j)
{
    const dvec3 c(0.1 + 0.1 * i, 0.1 + 0.1 * j, 0.1 + 0.1 * face);
    return eye == Eye::left ? c : dvec3(0.75 - c.y, c.z, 0.7 - 0.9 * c.x);
}

/// The face and the tile in the direction d: the axis gives the face, the other two coordinates the tile.
glm::ivec3 tile_of(const dvec3& d)
{
    int axis = 0;
    for (int k = 1; k < 3; ++k)
        if (std::abs(d[k]) > std::abs(d[axis]))
            axis = k;
    const dvec3 at = d / std::abs(d[axis]);
    auto index = [&](double v) { return std::clamp(int((v + 1) / 2 * tiles), 0, tiles - 1); };
    return {2 * axis + (d[axis] < 0), index(at[(axis + 1) % 3]), index(at[(axis + 2) % 3])};
}

Doc boxes()
{
    Doc doc;
    for (Eye eye : {Eye::left, Eye::right}) {
        const dvec3 middle((eye == Eye::left ? -0.5 : 0.5) * apart, 0, 0);
        for (int face = 0; face < 6; ++face)
            for (int i = 0; i < tiles; ++i)
                for (int j = 0; j < tiles; ++j) {
                    dvec3 out(0), a(0), b(0);
                    out[face / 2] = face % 2 ? -1 : 1;
                    a[(face / 2 + 1) % 3] = 1;
                    b[(face / 2 + 2) % 3] = 1;
                    const dvec3 centre
                        = middle + wall * (out + a * ((2 * i + 1.0) / tiles - 1) + b * ((2 * j + 1.0) / tiles - 1));
                    // The front faces the eye: right x up points against `out`.
                    const dvec3 right = glm::dot(glm::cross(a, b), out) < 0 ? a : b, up = right == a ? b : a;
                    quad(doc, centre, right * (wall / tiles), up * (wall / tiles), unlit(doc, tile_colour(eye, face, i, j)));
                }
    }
    return doc;
}

class Packings : public ::testing::Test {
protected:
    static void SetUpTestSuite() { world = std::make_unique<GpuWorld>(open_world("boxes", boxes())); }
    static void TearDownTestSuite()
    {
        device().device.waitIdle();
        world.reset();
    }

    static constexpr double fov_y = 100;

    static Layout layout(Packing packing, ivec2 size)
    {
        Layout layout = one_view(Planar{fov_y}, size);
        layout.outputs[0].packing = packing;
        layout.stereo.separation_m = apart;
        return layout;
    }
    static std::vector<std::uint8_t> bytes(const Layout& layout, std::size_t output = 0)
    {
        OffscreenRenderer offscreen = renderer(*world, layout, false);
        return offscreen.picture(shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1})).at(output);
    }

    /// The colour at a point of an eye's picture, from (0, 0) at the top left to (1, 1); aspect is its true width / height.
    /// Nothing if a tile's edge is nearer than `room`, in the same fractions.
    static std::optional<dvec3> colour_at(Eye eye, dvec2 at, double aspect, dvec2 room)
    {
        std::optional<glm::ivec3> tile;
        for (dvec2 way : {dvec2(0), dvec2(-1, -1), dvec2(1, -1), dvec2(-1, 1), dvec2(1, 1)}) {
            const dvec2 p = 2.0 * (at + way * room) - 1.0;
            const double half = std::tan(fov_y / 2 * degree);
            const glm::ivec3 seen = tile_of({p.x * half * aspect, -p.y * half, -1});
            if (tile && seen != *tile)
                return {};
            tile = seen;
        }
        return tile_colour(eye, tile->x, tile->y, tile->z);
    }

    /// The eye and the place in its picture that a pixel of the screen belongs to.
    struct Source {
        Eye eye;
        dvec2 at, room; ///< room: two of the screen's pixels
        double aspect;
    };
    static void expect_each(const Layout& layout, const std::function<Source(int, int)>& source, std::size_t output = 0)
    {
        const std::vector<std::uint8_t> picture = bytes(layout, output);
        const ivec2 size = layout.outputs[output].size;
        int compared[2] = {};
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const Source from = source(x, y);
                const auto expected = colour_at(from.eye, from.at, from.aspect, from.room);
                if (!expected)
                    continue;
                ++compared[from.eye == Eye::right];
                for (int k = 0; k < 3; ++k)
                    // fp16 and rounding make up to one byte. Tiles differ by 10 and more.
                    ASSERT_NEAR(picture[4 * (y * size.x + x) + k], 255 * srgb((*expected)[k]), 1.2)
                        << x << " " << y << " channel " << k << (from.eye == Eye::left ? " left" : " right");
            }
        EXPECT_GT(compared[0] + compared[1], 0.4 * size.x * size.y);
        for (int of_eye : compared)
            EXPECT_TRUE(of_eye == 0 || of_eye > 0.15 * size.x * size.y) << of_eye;
    }

    static inline std::unique_ptr<GpuWorld> world;
};

TEST_F(Packings, SideBySideGivesEachEyeAHalfInItsTrueShape)
{
    const ivec2 size(400, 160);
    expect_each(layout(Packing::side_by_side, size), [&](int x, int y) {
        return Source{x < 200 ? Eye::left : Eye::right, dvec2(x % 200 + 0.5, y + 0.5) / dvec2(200, 160),
            2.0 / dvec2(200, 160), 200.0 / 160};
    });
}

TEST_F(Packings, SideBySideHalfSqueezesEachEyesPicture)
{
    const ivec2 size(400, 225);
    expect_each(layout(Packing::side_by_side_half, size), [&](int x, int y) {
        return Source{x < 200 ? Eye::left : Eye::right, dvec2(x % 200 + 0.5, y + 0.5) / dvec2(200, 225),
            2.0 / dvec2(200, 225), 400.0 / 225};
    });
}

TEST_F(Packings, TopAndBottomGivesTheLeftEyeTheUpperHalf)
{
    const ivec2 size(240, 320);
    for (Packing packing : {Packing::top_and_bottom, Packing::top_and_bottom_half})
        expect_each(layout(packing, size), [&](int x, int y) {
            return Source{y < 160 ? Eye::left : Eye::right, dvec2(x + 0.5, y % 160 + 0.5) / dvec2(240, 160),
                2.0 / dvec2(240, 160), packing == Packing::top_and_bottom ? 240.0 / 160 : 240.0 / 320};
        });
}

TEST_F(Packings, InterlacedPackingsAlternateTheEyes)
{
    const ivec2 size(240, 180);
    for (Packing packing : {Packing::rows, Packing::columns, Packing::checkerboard})
        expect_each(layout(packing, size), [&](int x, int y) {
            const int second = packing == Packing::rows ? y % 2 : packing == Packing::columns ? x % 2 : (x + y) % 2;
            return Source{
                second ? Eye::right : Eye::left, (dvec2(x, y) + 0.5) / dvec2(size), 2.0 / dvec2(size), 240.0 / 180};
        });
}

TEST_F(Packings, AViewportShowsTheEyeItNames)
{
    Layout pair = layout(Packing::mono, {300, 120});
    // The order and the widths are crossed on purpose: the layout decides which eye a viewport belongs to.
    pair.outputs[0].viewports = {{.rect = {0, 0, 0.4, 1}, .projection = Planar{fov_y}, .eye = Eye::right},
        {.rect = {0.4, 0, 0.6, 1}, .projection = Planar{fov_y}, .eye = Eye::left}};
    expect_each(pair, [&](int x, int y) {
        const bool second = x >= 120;
        const dvec2 own(second ? 180 : 120, 120);
        return Source{
            second ? Eye::left : Eye::right, dvec2(x - (second ? 120 : 0) + 0.5, y + 0.5) / own, 2.0 / own, own.x / own.y};
    });
}

TEST_F(Packings, AnOutputShowsTheEyeItNames)
{
    Layout pair = layout(Packing::mono, {160, 120});
    pair.outputs.push_back(pair.outputs[0]);
    pair.outputs[0].name = "for the right eye";
    pair.outputs[0].viewports[0].eye = Eye::right;
    pair.outputs[1].viewports[0].eye = Eye::left;
    for (std::size_t output = 0; output < 2; ++output)
        expect_each(
            pair,
            [&](int x, int y) {
                return Source{output == 0 ? Eye::right : Eye::left, dvec2(x + 0.5, y + 0.5) / dvec2(160, 120),
                    2.0 / dvec2(160, 120), 160.0 / 120};
            },
            output);
}

TEST_F(Packings, AnaglyphsMixTheEyesByTheirMatrices)
{
    // Rows give the screen's linear light from that of the left and of the right eye's picture.
    struct Glasses {
        Packing packing;
        double left[3][3], right[3][3];
    };
    const Glasses all[]
        = {{Packing::anaglyph_red_cyan, {{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
            // E. Dubois, conversion of a stereo pair to anaglyph with the least-squares projection method: red/cyan and
            // amber/blue glasses.
            {Packing::anaglyph_dubois,
                {{0.4561, 0.500484, 0.176381}, {-0.0400822, -0.0378246, -0.0157589}, {-0.0152161, -0.0205971, -0.00546856}},
                {{-0.0434706, -0.0879388, -0.00155529}, {0.378476, 0.73364, -0.0184503}, {-0.0721527, -0.112961, 1.2264}}},
            {Packing::anaglyph_amber_blue, {{1.062, -0.205, 0.299}, {-0.026, 0.908, 0.068}, {-0.038, -0.173, 0.022}},
                {{-0.016, -0.123, -0.017}, {0.006, 0.062, -0.017}, {0.094, 0.185, 0.911}}}};
    const ivec2 size(240, 180);
    for (const Glasses& glasses : all) {
        for (int i = 0; i < 3; ++i) {
            double white = 0;
            for (int j = 0; j < 3; ++j)
                white += glasses.left[i][j] + glasses.right[i][j];
            EXPECT_NEAR(white, 1, 0.02) << "white for both eyes must be white on the screen";
        }
        const std::vector<std::uint8_t> picture = bytes(layout(glasses.packing, size));
        int compared = 0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const dvec2 at = (dvec2(x, y) + 0.5) / dvec2(size), room = 2.0 / dvec2(size);
                const auto left = colour_at(Eye::left, at, 240.0 / 180, room),
                           right = colour_at(Eye::right, at, 240.0 / 180, room);
                if (!left || !right)
                    continue;
                ++compared;
                for (int i = 0; i < 3; ++i) {
                    double light = 0;
                    for (int j = 0; j < 3; ++j)
                        light += glasses.left[i][j] * (*left)[j] + glasses.right[i][j] * (*right)[j];
                    ASSERT_NEAR(picture[4 * (y * size.x + x) + i], 255 * srgb(std::clamp(light, 0.0, 1.0)), 1.6)
                        << x << " " << y << " channel " << i << " of packing " << int(glasses.packing);
                }
            }
        EXPECT_GT(compared, 10000);
    }
}

// ---------------------------------------------------------------- places of objects

/// A rectangle; each has a colour of its own within a world.
struct Object {
    dvec3 centre, right, up, colour;
    dvec3 point(double a, double b) const { return centre + a * right + b * up; }
};

/// The rectangle faces the point between the eyes.
Object facing(double azimuth_deg, double elevation_deg, double distance, double half_deg, const dvec3& colour)
{
    const double a = azimuth_deg * degree, e = elevation_deg * degree, half = distance * std::tan(half_deg * degree);
    const dvec3 d(std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a));
    const dvec3 right(std::cos(a), 0, std::sin(a));
    return {distance * d, half * right, half * glm::cross(right, d), colour};
}

GpuWorld world_of(const std::string& name, const std::vector<Object>& objects)
{
    Doc doc;
    for (const Object& object : objects)
        quad(doc, object.centre, object.right, object.up, unlit(doc, object.colour));
    return open_world(name, doc);
}

/// The left and the right eye's pictures side by side, each of `size`.
Layout pair_of(const Projection& projection, ivec2 size, StereoMethod method)
{
    Layout layout = one_view(projection, {2 * size.x, size.y});
    layout.outputs[0].packing = Packing::side_by_side;
    layout.stereo.method = method;
    return layout;
}

/// The light of one object's hue in one eye's half of the picture: its mean place in pixels from the half's corner, and its
/// area, both within `reach` of the expected place. `astray` is the light farther away.
struct Found {
    dvec2 middle{0};
    double area = 0, astray = 0;
};
Found find_object(const Numbers& numbers, Eye eye, const dvec3& colour, const dvec2& expected, double reach)
{
    const int half = numbers.size.x / 2;
    Found found;
    for (int i = 0; i < numbers.count(); ++i) {
        if (!numbers.shown(i) || (i % numbers.size.x >= half) != (eye == Eye::right))
            continue;
        const dvec3 light = numbers.light(i);
        const double part = std::max({light.r, light.g, light.b}) / std::max({colour.r, colour.g, colour.b});
        if (part < 0.01 || !near_colour(light / part, colour, 0.02))
            continue;
        const dvec2 at = numbers.centre(i) - dvec2(eye == Eye::right ? half : 0, 0);
        if (std::max(std::abs(at.x - expected.x), std::abs(at.y - expected.y)) > reach) {
            found.astray += part;
            continue;
        }
        found.middle += part * at;
        found.area += part;
    }
    found.middle /= found.area;
    return found;
}

/// The expected centre. see: the direction in which the eye sees a point; pixel: the place of a direction in the picture.
dvec2 expected_centre(
    const Object& object, const std::function<dvec3(const dvec3&)>& see, const std::function<dvec2(const dvec3&)>& pixel)
{
    constexpr int n = 16;
    std::vector<dvec2> at;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            at.push_back(pixel(see(object.point(2.0 * i / n - 1, 2.0 * j / n - 1))));
    dvec2 sum(0);
    double area = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const dvec2 &a = at[j * (n + 1) + i], &b = at[j * (n + 1) + i + 1], &c = at[(j + 1) * (n + 1) + i],
                        &d = at[(j + 1) * (n + 1) + i + 1];
            const dvec2 p = d - a, q = b - c;
            const double part = 0.5 * std::abs(p.x * q.y - p.y * q.x);
            sum += 0.25 * (a + b + c + d) * part;
            area += part;
        }
    return sum / area;
}

dvec2 planar_pixel(const dvec3& d, double fov_y_deg, ivec2 size)
{
    return 0.5 * dvec2(size) + dvec2(d.x, -d.y) / -d.z * (0.5 * size.y / std::tan(fov_y_deg / 2 * degree));
}

/// A dome's picture looks straight up and is 180 degrees wide.
dvec2 dome_pixel(const dvec3& d, int size)
{
    const double angle = std::atan2(std::hypot(d.x, d.z), d.y), flat = std::hypot(d.x, d.z);
    return dvec2(0.5 * size) + (flat > 0 ? dvec2(d.x, -d.z) / flat * (angle / (pi / 2) * 0.5 * size) : dvec2(0));
}

constexpr double eyes_m = 0.065;
dvec3 eye_at(Eye eye, double separation) { return {(eye == Eye::left ? -0.5 : 0.5) * separation, 0, 0}; }

const std::vector<Object> objects = {facing(0, 0, 0.5, 2, {0.7, 0, 0}), facing(-18, 8, 1, 2, {0, 0.7, 0}),
    facing(15, -10, 2, 2, {0, 0, 0.7}), facing(-12, -12, 10, 2, {0.7, 0.7, 0}), facing(14, 12, 1e4, 2, {0, 0.7, 0.7})};

/// The deviation of all objects from their expected places.
struct Off {
    double worst = 0; ///< of a centre, pixels
    double astray = 0; ///< fraction of all light that is elsewhere
};
Off off_of(const GpuWorld& world, const Layout& layout, const std::vector<Object>& all,
    const std::function<dvec2(const Object&, Eye)>& expected)
{
    OffscreenRenderer offscreen = renderer(world, layout);
    const Numbers numbers(offscreen, shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1}));
    Off off;
    double area = 0;
    for (const Object& object : all)
        for (Eye eye : {Eye::left, Eye::right}) {
            const dvec2 right = expected(object, eye);
            const Found found = find_object(numbers, eye, object.colour, right, 18); // objects reach 12 pixels to each side
            EXPECT_GT(found.area, 50) << "the object is not in the picture";
            off.worst = std::max(off.worst, glm::length(found.middle - right));
            off.astray += found.astray;
            area += found.area + found.astray;
        }
    off.astray /= area;
    std::printf("  middles at most %.3f pixels off, %.2f %% of the light astray\n", off.worst, 100 * off.astray);
    return off;
}

/// A texel has 0.8 pixels and the cube map four samples in it: an edge is known to half of a quarter.
constexpr double sharp = 0.2;
/// Reprojected edges follow the depth's texels, 0.8 pixels wide. One row too few along two sides shifts the centre by 0.6,
/// and slanted edges have steps.
constexpr double blunt = 0.8;
/// InsetView an edge, a texel of the sky has some of the object's light. This dim outline remains where the eye sees the sky
/// behind. For an object of 24 pixels it has a sixth of the area, less than half as bright.
constexpr double outlines = 0.03;

TEST(Stereo, ExactHasTheParallaxOfTheDistance)
{
    const GpuWorld world = world_of("parallax", objects);
    const ivec2 size(360, 300);
    for (double hyper : {1.0, 3.0}) {
        Layout layout = pair_of(Planar{50}, size, StereoMethod::exact);
        layout.stereo.hyper_stereo = hyper;
        const Off off = off_of(world, layout, objects, [&](const Object& object, Eye eye) {
            return expected_centre(
                object, [&](const dvec3& p) { return p - eye_at(eye, eyes_m * hyper); },
                [&](const dvec3& d) { return planar_pixel(d, 50, size); });
        });
        // The nearest object has a parallax of 42 or 126 pixels.
        EXPECT_LT(off.worst, sharp);
        EXPECT_EQ(off.astray, 0);
    }
}

TEST(Stereo, ReprojectedHasTheParallaxOfTheDistance)
{
    const GpuWorld world = world_of("parallax", objects);
    const ivec2 size(360, 300);
    for (double hyper : {1.0, 3.0}) {
        Layout layout = pair_of(Planar{50}, size, StereoMethod::reprojected);
        layout.stereo.hyper_stereo = hyper;
        const Off off = off_of(world, layout, objects, [&](const Object& object, Eye eye) {
            return expected_centre(
                object, [&](const dvec3& p) { return p - eye_at(eye, eyes_m * hyper); },
                [&](const dvec3& d) { return planar_pixel(d, 50, size); });
        });
        EXPECT_LT(off.worst, blunt);
        EXPECT_LT(off.astray, outlines);
    }
}

// On a wall, objects without parallax in the world are as far apart as the eyes: at infinity.
TEST(Stereo, SharedShowsEverythingAtInfinity)
{
    const GpuWorld world = world_of("parallax", objects);
    const ivec2 size(360, 300);
    Layout layout = pair_of(Planar{50}, size, StereoMethod::shared);
    auto unchanged = [](const dvec3& p) { return p; };
    const Off flat = off_of(world, layout, objects, [&](const Object& object, Eye) {
        return expected_centre(object, unchanged, [&](const dvec3& d) { return planar_pixel(d, 50, size); });
    });
    EXPECT_LT(flat.worst, sharp);

    const Wall wall{{-0.9, -0.75, -1.5}, {0.9, -0.75, -1.5}, {-0.9, 0.75, -1.5}};
    layout = pair_of(wall, size, StereoMethod::shared);
    layout.stereo.hyper_stereo = 100; // applies to the world alone
    const Off on_wall = off_of(world, layout, objects, [&](const Object& object, Eye eye) {
        return expected_centre(object, unchanged, [&](const dvec3& d) {
            const dvec3 at = eye_at(eye, eyes_m) + d * (1.5 / -d.z);
            return dvec2((at.x + 0.9) / 1.8 * size.x, (0.75 - at.y) / 1.5 * size.y);
        });
    });
    EXPECT_LT(on_wall.worst, sharp);
}

// The wall gives each eye its own picture, and the world adds its parallax: an object in the wall's plane is at one place
// for both eyes.
TEST(Stereo, AnObjectInTheWallsPlaneHasNoParallaxOnIt)
{
    const Wall wall{{-0.9, -0.75, -1.5}, {0.9, -0.75, -1.5}, {-0.9, 0.75, -1.5}};
    const ivec2 size(360, 300);
    const std::vector<Object> on_it = {{{0, 0, -1.5}, {0.05, 0, 0}, {0, 0.05, 0}, {0.7, 0, 0}},
        {{0.6, 0.5, -1.5}, {0.05, 0, 0}, {0, 0.05, 0}, {0, 0.7, 0}},
        {{-0.6, -0.4, -1.5}, {0.05, 0, 0}, {0, 0.05, 0}, {0, 0, 0.7}}};
    const GpuWorld world = world_of("on_wall", on_it);
    for (StereoMethod method : {StereoMethod::exact, StereoMethod::reprojected}) {
        const Off off = off_of(world, pair_of(wall, size, method), on_it, [&](const Object& object, Eye) {
            return dvec2((object.centre.x + 0.9) / 1.8 * size.x, (0.75 - object.centre.y) / 1.5 * size.y);
        });
        EXPECT_LT(off.worst, method == StereoMethod::exact ? sharp : blunt);
    }
}

// ---------------------------------------------------------------- reprojection, pixel by pixel

/// The first object that a ray from `eye` along d meets, and the point where it does.
std::pair<int, dvec3> meet(const std::vector<Object>& all, const dvec3& eye, const dvec3& d)
{
    int first = -1;
    double nearest = 1e300;
    for (int i = 0; i < int(all.size()); ++i) {
        const dvec3 normal = glm::cross(all[i].right, all[i].up);
        const double along = glm::dot(all[i].centre - eye, normal) / glm::dot(d, normal);
        const dvec3 off = eye + along * d - all[i].centre;
        const double a = glm::dot(off, all[i].right) / glm::dot(all[i].right, all[i].right),
                     b = glm::dot(off, all[i].up) / glm::dot(all[i].up, all[i].up);
        if (along > 0 && along < nearest && std::abs(a) <= 1 && std::abs(b) <= 1)
            nearest = along, first = i;
    }
    return {first, eye + nearest * d};
}

/// A room with walls, a floor and objects, the nearest at 0.8 m.
std::vector<Object> room()
{
    std::vector<Object> all = {{{0, 0, -4}, {4, 0, 0}, {0, 2, 0}, {0.2, 0.2, 0.4}},
        {{0, -1.2, -2}, {4, 0, 0}, {0, 0, -2}, {0.4, 0.3, 0.2}}, {{-1.5, 0, -2}, {0, 0, -2}, {0, 2, 0}, {0.2, 0.5, 0.2}}};
    for (int i = 0; i < 12; ++i)
        all.push_back(facing(-35 + 7 * i, -20 + 11 * (i * 5 % 7) * 0.6, 0.8 + 0.21 * (i * 7 % 12), 2.5,
            {0.1 + 0.05 * i, 0.7 - 0.05 * i, i % 2 ? 0.6 : 0.1}));
    return all;
}

struct Errors {
    double median = 0, high = 0, hidden = 0;
};

/// Over all pixels: the angle in pixels between a pixel's direction and the direction in which the eye sees its point, and
/// the fraction of pixels that show another object than the ray meets. eye_for: the eye's place for a direction.
Errors errors_of(
    OffscreenRenderer& offscreen, const std::vector<Object>& all, const std::function<dvec3(Eye, const dvec3&)>& eye_for)
{
    const Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
    const Numbers numbers(offscreen, shot);
    const Layout& layout = offscreen.layout();
    const int half = numbers.size.x / 2;
    const bool own = layout.stereo.method == StereoMethod::exact;
    std::vector<double> off;
    int hidden = 0;
    for (int i = 0; i < numbers.count(); ++i) {
        if (!numbers.shown(i))
            continue;
        const Eye side = i % numbers.size.x < half ? Eye::left : Eye::right;
        const dvec3 n = numbers.camera(i), eye = eye_for(side, n);
        const auto [object, point] = meet(all, eye, n);
        const double depth = numbers.depth(i);
        if (object < 0 && std::isinf(depth))
            continue;
        // The shown point, seen from the eye; its depth starts at the place the pixel was drawn from.
        const dvec3 shown = (own ? eye : dvec3(0)) + depth * numbers.world(i) - eye;
        const int next = i % half + 1 < half ? i + 1 : i - 1;
        const double pixel = between(n, numbers.camera(next));
        hidden += object < 0 || std::isinf(depth) || std::abs(glm::length(shown) / glm::length(point - eye) - 1) > 0.02;
        if (std::isfinite(depth))
            off.push_back(between(shown, n) / pixel);
    }
    EXPECT_GT(off.size(), 20000u);
    std::sort(off.begin(), off.end());
    return {off[off.size() / 2], off[off.size() * 99 / 100], double(hidden) / double(off.size())};
}

TEST(Stereo, ReprojectedEqualsExactPixelByPixel)
{
    const std::vector<Object> all = room();
    const GpuWorld world = world_of("room", all);
    const ivec2 size(320, 240);
    auto eye_for = [](Eye eye, const dvec3&) { return eye_at(eye, eyes_m); };
    OffscreenRenderer exact = renderer(world, pair_of(Planar{60}, size, StereoMethod::exact)),
                      tested = renderer(world, pair_of(Planar{60}, size, StereoMethod::reprojected));
    const Errors of_exact = errors_of(exact, all, eye_for), of_tested = errors_of(tested, all, eye_for);
    std::printf("  exact: median %.4f, 99 %% %.4f pixels, other objects %.2f %%\n  reprojected: median %.4f, 99 %% %.4f "
                "pixels, other objects %.2f %%\n",
        of_exact.median, of_exact.high, 100 * of_exact.hidden, of_tested.median, of_tested.high, 100 * of_tested.hidden);
    EXPECT_LT(of_exact.high, 0.001); // exact by construction: each eye looks its own direction up
    EXPECT_LT(of_exact.hidden, 0.008); // along edges the depth is the nearest texel's, half a texel off
    // The search for a surface stops at a twentieth of a texel of 0.8 pixels, mostly far sooner. InsetView edges it stops
    // elsewhere, but these are less than a hundredth of the pixels.
    EXPECT_LT(of_tested.median, 0.02);
    EXPECT_LT(of_tested.high, 0.1);
    // Each eye adds its edges, and the parts beside near objects that the point between the eyes does not see.
    EXPECT_LT(of_tested.hidden, 0.012);
    // The program's own measurement must agree.
    const Disparity reported
        = disparity(tested, &exact, shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1}), 0, SceneFile{.unit_m = 1});
    EXPECT_NEAR(reported.median, of_tested.median, 0.2 * of_tested.median);
    EXPECT_NEAR(reported.high, of_tested.high, 0.2 * of_tested.high);
    EXPECT_NEAR(
        reported.hidden, of_tested.hidden, 0.006); // the program compares with the other renderer's depth, not with the ray
}

// In flight both eyes are simultaneous in the ship: in the world their distance along the motion is gamma times as large.
// picture_gpu_test tests the same for `exact`.
TEST(Stereo, ReprojectedEqualsExactInFlight)
{
    const std::vector<Object> all = room();
    const GpuWorld world = world_of("room", all);
    const ivec2 size(320, 240);
    OffscreenRenderer exact = renderer(world, pair_of(Planar{60}, size, StereoMethod::exact)),
                      tested = renderer(world, pair_of(Planar{60}, size, StereoMethod::reprojected));
    for (double gamma : {1.1, 1.6}) { // slow, in axes of the cockpit, and fast, in axes of the motion
        const dvec3 way = glm::normalize(dvec3(0.8, 0.1, -0.6));
        const Shot shot = shot_at({0, 0, 0.5}, u_of_gamma(gamma) * way, {0.2, 0, -1});
        const Numbers of_exact(exact, shot), of_tested(tested, shot);
        std::vector<double> off;
        int other = 0, both = 0;
        for (int i = 0; i < of_exact.count(); ++i) {
            const bool left = i % of_exact.size.x < size.x;
            const dvec3 e = shot.ship_from_cockpit * eye_at(left ? Eye::left : Eye::right, eyes_m);
            const dvec3 eye = e + (gamma - 1) * glm::dot(e, way) * way;
            const double a = of_exact.depth(i), b = of_tested.depth(i);
            if (std::isinf(a) && std::isinf(b))
                continue;
            ++both;
            const dvec3 point = b * of_tested.world(i) - eye;
            if (std::isinf(a) != std::isinf(b) || std::abs(glm::length(point) / a - 1) > 0.02)
                ++other;
            else
                off.push_back(between(point, of_exact.world(i)) / (60 * degree / size.y * of_exact.D(i)));
        }
        ASSERT_GT(off.size(), 50000u);
        std::sort(off.begin(), off.end());
        std::printf("  in flight at gamma %g: median %.4f, 99 %% %.4f pixels, other objects %.2f %%\n", gamma,
            off[off.size() / 2], off[off.size() * 99 / 100], 100.0 * other / both);
        EXPECT_LT(off[off.size() / 2], 0.02); // the same limit as at rest
        EXPECT_LT(off[off.size() * 99 / 100], 0.15);
        EXPECT_LT(other, 0.03 * both); // the edges of two pictures
    }
}

// ---------------------------------------------------------------- domes

/// The place of an eye that looks along the azimuth of d: beside the middle, at right angles to the look, and closer to the
/// middle near the zenith.
dvec3 turned_eye(Eye eye, const dvec3& d, double separation, double full_from_zenith_deg)
{
    const double azimuth = std::atan2(d.x, -d.z), from_zenith = std::atan2(std::hypot(d.x, d.z), std::abs(d.y));
    const double fade = std::min(1.0, std::sin(from_zenith) / std::sin(full_from_zenith_deg * degree));
    return (eye == Eye::left ? -0.5 : 0.5) * separation * fade * dvec3(std::cos(azimuth), 0, std::sin(azimuth));
}

/// The direction in which that eye sees a point: the eye's place depends on the direction itself.
dvec3 turned_look(Eye eye, const dvec3& p, double separation, double full_from_zenith_deg)
{
    dvec3 d = glm::normalize(p);
    for (int i = 0; i < 30; ++i)
        d = glm::normalize(p - turned_eye(eye, d, separation, full_from_zenith_deg));
    return d;
}

TEST(Stereo, ADomesBaselineTurnsAndFades)
{
    std::vector<Object> around;
    for (int i = 0; i < 4; ++i)
        around.push_back(facing(90 * i, 25, 2, 3, dvec3(0.7, 0.23 * i, i % 2 ? 0.7 : 0)));
    around.push_back(facing(30, 70, 2, 3, {0.1, 0.7, 0.4})); // 20 degrees from the zenith, where the baseline is reduced
    around.push_back(facing(0, 90, 2, 3, {0.1, 0.1, 0.7}));
    const GpuWorld world = world_of("around", around);
    const int size = 640;
    // A millionth of the speed of light changes no place, but the cube map then has other axes than the motion's.
    for (const auto& [hyper, u] :
        {std::pair(1.0, dvec3(0)), {2.0, dvec3(0)}, {1.0, 1e-6 * glm::normalize(dvec3(0.7, 0.4, 0.2))}}) {
        Layout layout = pair_of(Fisheye{180, 0}, ivec2(size), StereoMethod::reprojected);
        layout.stereo.turning = true;
        layout.stereo.separation_m = 0.1;
        layout.stereo.hyper_stereo = hyper;
        const double separation = 0.1 * hyper, full = layout.stereo.full_from_zenith_deg;
        OffscreenRenderer offscreen = renderer(world, layout);
        const Numbers numbers(offscreen, shot_at({0, 0, 0}, u, {0, 0, -1}));
        double worst = 0;
        std::vector<double> parallaxes;
        for (const Object& object : around) {
            dvec2 seen[2];
            for (Eye eye : {Eye::left, Eye::right}) {
                const dvec2 expected = expected_centre(
                    object, [&](const dvec3& p) { return turned_look(eye, p, separation, full); },
                    [&](const dvec3& d) { return dome_pixel(d, size); });
                const Found found = find_object(numbers, eye, object.colour, expected,
                    20); // objects reach 11 pixels to each side and are up to 16 aside
                ASSERT_GT(found.area, 50);
                worst = std::max(worst, glm::length(found.middle - expected));
                seen[eye == Eye::right] = found.middle;
            }
            // The right eye sees near objects further to the left, against the direction to the right of the look.
            const dvec3 c = object.centre;
            const dvec2 right = glm::length(dvec2(c.x, c.z)) > 0.01 ? glm::normalize(dvec2(-c.z, -c.x)) : dvec2(1, 0);
            parallaxes.push_back(glm::dot(seen[0] - seen[1], right));
        }
        // In a dome's picture, an angle across the azimuth is stretched by angle / sine of the distance from the zenith.
        const double pixels_per_radian = size / pi, parallax = 2 * std::atan(0.5 * separation / 2) * pixels_per_radian;
        const double stretch = 65 * degree / std::sin(65 * degree);
        constexpr double close = 1; // each eye is off by up to half a pixel, as on a window
        for (int i = 0; i < 4; ++i)
            EXPECT_NEAR(parallaxes[i], parallax * stretch, close) << "azimuth " << 90 * i;
        const double faded = std::sin(20 * degree) / std::sin(full * degree) * 20 * degree / std::sin(20 * degree);
        EXPECT_NEAR(parallaxes[4], parallax * faded, close);
        EXPECT_NEAR(parallaxes[5], 0, 0.3) << "at the zenith";
        std::printf("  dome, hyper-stereo %g: parallax %.2f %.2f %.2f %.2f pixels around (%.2f), %.2f faded (%.2f), %.2f at "
                    "the zenith; worst middle %.2f off\n",
            hyper, parallaxes[0], parallaxes[1], parallaxes[2], parallaxes[3], parallax * stretch, parallaxes[4],
            parallax * faded, parallaxes[5], worst);
        EXPECT_LT(worst, blunt);
    }
}

TEST(Stereo, EyesBesideADirectionFollowTheFormula)
{
    Stereo stereo;
    stereo.turning = true;
    for (int i = 0; i < 100; ++i) {
        const dvec3 d = glm::normalize(dvec3(std::sin(i * 1.3), std::cos(i * 0.7), std::sin(i * 2.9)));
        for (Eye eye : {Eye::left, Eye::right})
            EXPECT_LT(glm::distance(eye_beside(stereo, eye, d), turned_eye(eye, d, 0.065, 40)), 1e-12);
    }
}

/// In a street of metres, where light flies 5 m/s, the shipped pair's eyes are 0.0325 seconds of its light apart: each eye's
/// half is what a single eye sees from that place.
TEST(StereoByLight, ShowsAStreetOfMetresToBothEyes)
{
    const SceneFile scene = load_scene_file(starbow::testing::source_dir() / "config/scenes/gamow.json");
    const GpuWorld world = upload(device(), pipelines(), load_world(scene), scene, {});
    Layout pair = load_layout(starbow::testing::source_dir() / "config/layouts/stereo.json");
    pair.outputs[0].size = {480, 180};
    pair.hud = {};
    Shot shot = scene.start;
    shot.u = {0, 0, -0.5};
    OffscreenRenderer both = renderer(world, pair), single = renderer(world, one_view(Planar{60}, {240, 180}));
    const Numbers numbers(both, shot);
    for (const double side : {-1.0, 1.0}) {
        Shot from = shot;
        from.position += shot.ship_from_cockpit * dvec3(side * 0.5 * 0.0325 * 5, 0, 0);
        const Numbers alone(single, from);
        // Light is retarded from each eye's own place; what differs is where a texel of its cube map lies.
        double off = 0, most = 0, other = 0;
        for (int y = 0; y < 180; ++y)
            for (int x = 0; x < 240; ++x) {
                const dvec3 own = alone.light(y * 240 + x);
                off += glm::length(numbers.light(y * 480 + x + (side > 0 ? 240 : 0)) - own);
                other += glm::length(numbers.light(y * 480 + x + (side > 0 ? 0 : 240)) - own);
                most += glm::length(own);
            }
        std::printf("  off by %.2f %%, the other eye's by %.2f %%\n", 100 * off / most, 100 * other / most);
        EXPECT_LT(off, 0.01 * most);
        EXPECT_GT(other, 0.02 * most);
    }
}

} // namespace
} // namespace starbow::gpu_test::stereo_gpu_test
