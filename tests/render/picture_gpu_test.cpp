// Properties of every picture: the same bytes each time, no seams, no mirror images, the nearest object in front. Most tests
// use small worlds of their own.
#include "config/model/angles.h"
#include "config/model/shipped.h"
#include "displays/compile/direction_map.h"
#include "runtime/light/srgb.h"
#include "shaders/physics/physics.h"
#include "tests/support/effects.h"
#include "tests/support/small_world.h"
#include <functional>

namespace starbow::gpu_test::picture_gpu_test {
namespace {

Shot shipped_shot(const std::string& name) { return load_shot(testing::source_dir() / "config/shots" / (name + ".json")); }

// ---------------------------------------------------------------- the same picture

TEST(Picture, StillsAreTheSameBytesEachTime)
{
    Layout layout = load_layout(testing::source_dir() / "config/layouts/stereo.json");
    layout.outputs[0].size = {320, 120};
    Layout dome = load_layout(testing::source_dir() / "config/layouts/dome.json");
    dome.outputs[0].size = {128, 128};
    layout.outputs.push_back(dome.outputs[0]);
    const Shot shot = shipped_shot("starbow");
    const Panel panel
        = Typesetter().draw(readings(ship_at(shot), avenue().world.scene, shot.effects), starbow::testing::words(), 320);

    OffscreenRenderer offscreen = renderer(avenue().world, layout, false);
    const auto first = offscreen.picture(shot, &panel);
    ASSERT_EQ(first.size(), 2u);
    offscreen.picture(shipped_shot("rainbow")); // no frame depends on an earlier one
    EXPECT_EQ(offscreen.picture(shot, &panel), first);

    RenderContext again(testing::source_dir() / "config/scenes/avenue.json",
        Device::Options{.validation = true, .name = device_options(false).name});
    {
        OffscreenRenderer afresh(again.device, again.pipelines, again.world, layout, test_quality(), false);
        EXPECT_EQ(afresh.picture(shot, &panel), first);
    }
    GpuEnvironment::expect_no_complaints(again.device);
}

TEST(Picture, AtRestEveryEffectIsTheIdentity)
{
    OffscreenRenderer offscreen = renderer(avenue().world, one_view(Planar{60}, {200, 150}), false);
    Shot shot = shipped_shot("start");
    std::vector<std::vector<std::uint8_t>> first;
    for (int bits = 0; bits < 8; ++bits) {
        shot.effects = testing::effects_of(bool(bits & 1), bool(bits & 2), bool(bits & 4));
        const auto picture = offscreen.picture(shot);
        if (bits == 0)
            first = picture;
        EXPECT_EQ(picture, first) << bits;
    }
}

TEST(Picture, WithoutAberrationDirectionsAreThoseAtRest)
{
    for (const Projection& projection : {Projection(Planar{60}), Projection(Fisheye{180, 30})}) {
        OffscreenRenderer offscreen = renderer(avenue().world, one_view(projection, {160, 160}));
        Shot shot = shot_at({0.1, 0.2, -7}, u_of_gamma(4) * glm::normalize(dvec3(1, 0.5, -2)), {0, 0, -1});
        shot.effects.on.set(Effect::aberration, false);
        const Numbers moving(offscreen, shot);
        shot.u = {0, 0, 0};
        const Numbers rest(offscreen, shot);
        int edges = 0, seen = 0;
        for (int i = 0; i < rest.count(); ++i) {
            ASSERT_EQ(rest.shown(i), moving.shown(i));
            if (!rest.shown(i))
                continue;
            // Both transform the same pixel into other axes in float: twice the camera's 4.2e-7 (see paper_gpu_test).
            ASSERT_LT(between(moving.world(i), rest.world(i)), 8.4e-7);
            // One is in the motion's axes, the other in the cube map's: a rotation by a matrix of floats.
            ASSERT_LT(between(moving.world(i), moving.camera(i)), 4.2e-7);
            ++seen;
            // The two cube maps have different orientations, so that depths may differ at edges alone.
            edges += std::isinf(moving.depth(i)) != std::isinf(rest.depth(i)) || moving.depth(i) > 1.02 * rest.depth(i)
                || rest.depth(i) > 1.02 * moving.depth(i);
        }
        EXPECT_LT(edges, 0.05 * seen);
    }
}

TEST(Picture, HeadlightAloneMultipliesByTheCubeOfD)
{
    const WithoutStars only_surfaces; // the stars' points take another power of D
    for (double gamma : {1.5, 4.0, 100.0}) {
        OffscreenRenderer offscreen = renderer(avenue().world, one_view(Fisheye{180, 30}, {200, 200}));
        Shot shot = shot_at({0, 0, -8}, {0, 0, -u_of_gamma(gamma)}, {0, 0, -1});
        const Numbers off(offscreen, shot);
        shot.effects.on.set(Effect::headlight);
        const Numbers on(offscreen, shot);
        double worst = 0;
        int compared = 0;
        for (int i = 0; i < off.count(); ++i) {
            if (!off.shown(i))
                continue;
            const double cube = std::pow(off.D(i), 3);
            for (int k = 0; k < 3; ++k) {
                ASSERT_TRUE(std::isfinite(on.light(i)[k]));
                if (off.light(i)[k] < 1e-6) // the product may underflow a normal float
                    continue;
                worst = std::max(worst, std::abs(on.light(i)[k] / (off.light(i)[k] * cube) - 1));
                ++compared;
            }
        }
        std::printf("  gamma %g: worst %.1e of %d\n", gamma, worst, compared);
        EXPECT_GT(compared, 50000);
        // Two products for D^3, one for the light. The light itself is the same number in both, with the same fp16 rounding.
        EXPECT_LE(worst, 4 * 0x1p-24);
    }
}

// The PNG must be the EXR's light, exposed and encoded. The tone curve is linear below its knee at 0.76.
TEST(Picture, PixelsAreTheNumbersEncoded)
{
    const WithoutStars without; // whose glare is in the picture alone
    OffscreenRenderer offscreen = renderer(avenue().world, one_view(Planar{60}, {240, 180}));
    for (const char* name : {"start", "avenue-gamma4", "starbow", "rainbow"}) {
        const Shot shot = shipped_shot(name);
        const auto picture = offscreen.picture(shot).front();
        const Numbers numbers(offscreen, shot);
        const double gain = std::exp2(shot.exposure_ev);
        int linear = 0;
        for (int i = 0; i < numbers.count(); ++i) {
            const dvec3 light = glm::max(numbers.light(i) * gain, 0.0); // no screen shows colours outside its range
            const double peak = std::max({light.r, light.g, light.b});
            for (int k = 0; k < 3; ++k) {
                const int byte = picture[4 * i + k];
                if (peak < 0.75)
                    // Half a byte each of rounding, of dither, and for a device's own sRGB table.
                    ASSERT_NEAR(byte, 255 * srgb(light[k]), 1.5) << name << " pixel " << i;
                else
                    ASSERT_GE(byte, int(255 * srgb(0.7 * light[k] / peak))) << name << " pixel " << i;
            }
            linear += peak < 0.75;
        }
        EXPECT_GT(linear, 1000) << name;
    }
}

// ---------------------------------------------------------------- seams

TEST(Picture, ASmoothSkyHasNoSeams)
{
    Doc doc;
    quad(doc, {0, 0, 900}, {0.01, 0, 0}, {0, 0.01, 0}, unlit(doc, {1, 1, 1})); // far behind, small, and turned away
    const GpuWorld world = open_world("sky", doc, {{"sky", smooth_sky}});
    const std::map<std::string, Layout> layouts = {{"window", one_view(Planar{60}, {160, 120})},
        {"180", one_view(Fisheye{180, 30}, {160, 160})}, {"360", one_view(Fisheye{360, 90}, {200, 200})}};
    const dvec3 way = glm::normalize(dvec3(0.3, 0.45, -0.84)); // the sky's bands cross the cube's faces at a slant
    const dvec3 aside = glm::normalize(glm::cross(way, dvec3(0, 1, 0)));
    // The picture shows the sky filtered over a pixel's angle f in the world. Texels of about f average over themselves
    // (variance f^2/12 along a line), and linear interpolation between them adds at most f^2/4. In a face's corner texels
    // are 1.3 times as long one way. Half the variance times the sky's greatest curvature, 6 x 0.45 at the horizon, is 0.8
    // f^2; with the two levels that are mixed it is 0.9 f^2. fp16 steps by 2^-11 below 1, a device may truncate instead of
    // rounding, and light is stored five times up to the coarsest level: 0.6/255.
    auto filtered = [](double f) { return 0.9 * f * f + 5 * 0x1p-11; };
    constexpr double fine = 0.04; // up to this footprint the filter's error is below 1/255
    for (const auto& [name, layout] : layouts) {
        OffscreenRenderer offscreen = renderer(world, layout);
        const Projection& projection = layout.outputs[0].viewports[0].projection;
        // A fisheye's pixel has this length along the radius, however narrow it is near the rim.
        const auto* fisheye = std::get_if<Fisheye>(&projection);
        const double length = fisheye ? fisheye->aperture_deg * degree / layout.outputs[0].size.x : 0;
        for (double gamma : {1.0, 1.5, 4.0, 10.0, 100.0}) {
            double worst = 0, step = 0, coarse = 0;
            for (const dvec3& look : {way, aside, -way}) {
                const Shot shot = shot_at({0, 0, 0}, way * (gamma > 1 ? u_of_gamma(gamma) : 0), look);
                const Numbers numbers(offscreen, shot);
                std::vector<dvec3> error(numbers.count());
                std::vector<double> footprint(numbers.count(), 10);
                for (int i = 0; i < numbers.count(); ++i) {
                    if (!numbers.shown(i))
                        continue;
                    footprint[i]
                        = numbers.D(i) * std::max(length, pixel_angle(Picture{projection, numbers.size}, numbers.centre(i)));
                    error[i] = numbers.light(i) - sky_colour(numbers.world(i));
                    ASSERT_TRUE(std::isinf(numbers.depth(i)));
                    const double off = std::max({std::abs(error[i].r), std::abs(error[i].g), std::abs(error[i].b)});
                    worst = std::max(worst, footprint[i] <= fine ? off : 0);
                    if (footprint[i] <= 0.3)
                        coarse = std::max(coarse, off / filtered(footprint[i]));
                    ASSERT_LE(off, 0.55); // even a pixel that covers much of the sky has one of its colours
                }
                auto pair = [&](int i, int j) {
                    if (std::max(footprint[i], footprint[j]) <= fine)
                        for (int k = 0; k < 3; ++k)
                            step = std::max(step, std::abs(error[i][k] - error[j][k]));
                };
                for (int y = 1; y < numbers.size.y; ++y)
                    for (int x = 1; x < numbers.size.x; ++x) {
                        const int i = y * numbers.size.x + x;
                        pair(i, i - 1);
                        pair(i, i - numbers.size.x);
                    }
            }
            std::printf("  %-6s gamma %5g: off the sky's formula by %.2f/255 at most, from a pixel to the next %.2f/255; "
                        "coarse pixels "
                        "%.2f of what filtering may\n",
                name.c_str(), gamma, 255 * worst, 255 * step, coarse);
            EXPECT_LT(worst, 1.0 / 255) << name << ' ' << gamma;
            EXPECT_LT(step, 1.0 / 255) << name << ' ' << gamma;
            EXPECT_LT(coarse, 1) << name << ' ' << gamma;
        }
    }
}

// ---------------------------------------------------------------- the places of objects

struct Marker {
    dvec3 centre, right, up; ///< half sides
    dvec3 colour;
};

/// The centre of a marker's area in the picture, and the area in pixels; 0 if the marker is not wholly inside. Computed by
/// the exact boost of the marker's parts.
std::pair<dvec2, double> expected(const Marker& marker, const Shot& shot, const Projection& projection, ivec2 size)
{
    constexpr int n = 12;
    std::vector<dvec2> at;
    const double E = physics::exp_rapidity(glm::length(shot.u));
    const dmat3 to_motion = motion_from_world(shot.u, shot.ship_from_cockpit);
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const dvec3 place
                = marker.centre + marker.right * (2.0 * i / n - 1) + marker.up * (2.0 * j / n - 1) - shot.position;
            const dvec3 seen
                = glm::transpose(to_motion) * physics::camera_from_world(to_motion * glm::normalize(place), E, 1 / E).n;
            const dvec3 cockpit = glm::inverse(shot.ship_from_cockpit) * seen;
            const auto p = pixel(Picture{projection, size}, cockpit);
            if (!p || glm::any(glm::lessThan(*p, dvec2(3))) || glm::any(glm::greaterThan(*p, dvec2(size) - 3.0)))
                return {{}, 0};
            // A fisheye of the whole sphere stretches the direction right behind into a ring.
            if (const auto* fisheye = std::get_if<Fisheye>(&projection);
                fisheye && glm::length(*p - dvec2(size) * 0.5) > 0.42 * size.x)
                return {{}, 0};
            at.push_back(*p);
        }
    dvec2 middle(0);
    double area = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const dvec2 &a = at[j * (n + 1) + i], &b = at[j * (n + 1) + i + 1], &c = at[(j + 1) * (n + 1) + i],
                        &d = at[(j + 1) * (n + 1) + i + 1];
            auto cross = [](dvec2 p, dvec2 q) { return p.x * q.y - p.y * q.x; };
            const double part = 0.5 * std::abs(cross(d - a, b - c));
            middle += 0.25 * (a + b + c + d) * part;
            area += part;
        }
    return {middle / area, area};
}

TEST(Picture, EveryFaceShowsFrontsInTheirPlaceUnmirrored)
{
    Doc doc;
    std::vector<Marker> markers;
    const dvec3 hidden(0.9, 0.9, 0.9);
    auto next_colour = [&, k = 0]() mutable {
        // The greatest channel is always 0.9, so that no two colours have the same hue at any brightness.
        const double steps[] = {0, 0.15, 0.3, 0.45, 0.6, 0.75};
        dvec3 colour(0.9, steps[k / 3 % 6], steps[k / 18 % 6]);
        colour = k % 3 == 0 ? colour : k % 3 == 1 ? dvec3(colour.y, 0.9, colour.z) : dvec3(colour.y, colour.z, 0.9);
        ++k;
        return colour;
    };
    const int of_hidden = unlit(doc, hidden);
    const Json mirror = {{"scale", {-1, 1, 1}}};
    auto mirrored = [](const dvec3& v) { return dvec3(-v.x, v.y, v.z); };
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                if (std::abs(x) + std::abs(y) + std::abs(z) == 0)
                    continue;
                const dvec3 d = glm::normalize(dvec3(x, y, z));
                const dvec3 right = glm::normalize(glm::cross(d, std::abs(d.y) > 0.9 ? dvec3(0, 0, 1) : dvec3(0, 1, 0)));
                const dvec3 up = glm::cross(right, d);
                auto marker = [&](double aside, double above, double half) {
                    markers.push_back({5.0 * d + aside * right + above * up, half * right, half * up, next_colour()});
                    return markers.back();
                };
                const Marker m = marker(0, 0, 0.4), r = marker(1.1, 0, 0.3), u = marker(0, 1.1, 0.3),
                             l = marker(-1.1, 0, 0.3);
                for (const Marker& front : {m, r, u})
                    quad(doc, front.centre, front.right, front.up, unlit(doc, front.colour));
                // The node mirrors, so that its front is that of vertices in the other order.
                quad(doc, mirrored(l.centre), -mirrored(l.right), mirrored(l.up), unlit(doc, l.colour), mirror);
                // Backs must not show: neither of a turned quad nor of a mirrored one.
                const dvec3 below = 5.0 * d - 1.1 * up;
                quad(doc, below, -0.3 * right, 0.3 * up, of_hidden);
                const dvec3 corner = 5.0 * d - 1.1 * up + 0.9 * right;
                quad(doc, mirrored(corner), mirrored(0.3 * right), mirrored(0.3 * up), of_hidden, mirror);
            }
    const GpuWorld world = open_world("markers", doc);
    const Projection window = Planar{90}, whole = Fisheye{360, 90};
    double worst = 0;
    for (const dvec3& u : {dvec3(0), u_of_gamma(2) * glm::normalize(dvec3(1, 2, -0.5)), dvec3(0, 0, u_of_gamma(2)),
             dvec3(-u_of_gamma(2), 0, 0)}) {
        std::vector<int> found(markers.size());
        auto look_around = [&](const Projection& projection, ivec2 size, const dvec3& look, const dvec3& up) {
            OffscreenRenderer offscreen = renderer(world, one_view(projection, size));
            const Shot shot = shot_at({0, 0, 0}, u, look, up);
            const Numbers numbers(offscreen, shot);
            std::vector<dvec2> sums(markers.size(), dvec2(0));
            std::vector<double> covered(markers.size());
            for (int i = 0; i < numbers.count(); ++i) {
                if (!numbers.shown(i))
                    continue;
                const dvec3 light = numbers.light(i);
                EXPECT_FALSE(near_colour(light, hidden, 0.1)) << "a back at pixel " << i;
                // At its edge a marker fades to black and keeps its hue.
                const double part = std::max({light.r, light.g, light.b}) / 0.9;
                if (part < 0.01)
                    continue;
                for (std::size_t k = 0; k < markers.size(); ++k)
                    if (near_colour(light / part, markers[k].colour, 0.02))
                        sums[k] += part * numbers.centre(i), covered[k] += part;
            }
            for (std::size_t k = 0; k < markers.size(); ++k) {
                const auto [middle, area] = expected(markers[k], shot, projection, size);
                if (area < 9) // outside the picture, or too small to measure
                    continue;
                ++found[k];
                // The filter spreads light. It keeps the sum where neighbouring pixels have nearly the same angle.
                EXPECT_NEAR(covered[k], area, 0.1 * area + 2) << k;
                if (covered[k] > 0) {
                    const double off = glm::length(sums[k] / covered[k] - middle);
                    worst = std::max(worst, off);
                    EXPECT_LT(off, 0.5) << "marker " << k << " of area " << area;
                }
            }
        };
        for (const dvec3& look :
            {dvec3(1, 0, 0), dvec3(-1, 0, 0), dvec3(0, 0, 1), dvec3(0, 0, -1), dvec3(0, 1, 0.1), dvec3(0.1, -1, 0)})
            look_around(window, {500, 500}, look, {0, 1, 0});
        look_around(whole, {500, 500}, {0, 0, -1}, {0, 1, 0});
        look_around(whole, {500, 500}, {0.2, 0.3, 0.9}, {0.5, 1, 0});
        for (std::size_t k = 0; k < markers.size(); ++k)
            EXPECT_GT(found[k], 0) << "marker " << k << " was in no picture";
    }
    std::printf("  worst middle of %zu markers %.2f pixels off\n", markers.size(), worst);
}

TEST(Picture, DepthOrdersATenthToABillionUnitsInOneView)
{
    // Squares one behind the other. Each looks larger than those in front of it; the file lists them in mixed order.
    struct Square {
        double distance, half; // half: the tangent of half its angular size
        dvec3 colour;
    };
    const std::vector<Square> squares = {{0.1, 0.05, {0.9, 0, 0}}, {0.1001, 0.1, {0, 0.9, 0}}, {1, 0.15, {0, 0, 0.9}},
        {100, 0.2, {0.9, 0.9, 0}}, {1e5, 0.25, {0, 0.9, 0.9}}, {1e7, 0.3, {0.9, 0, 0.9}}, {1e9, 0.35, {0.5, 0.5, 0.5}}};
    Doc doc;
    for (int i : {4, 0, 6, 2, 5, 1, 3}) {
        const Square& s = squares[i];
        const double half = s.half * s.distance;
        quad(doc, {0, 0, -s.distance}, {half, 0, 0}, {0, half, 0}, unlit(doc, s.colour));
    }
    const GpuWorld world = open_world("distances", doc);
    for (double gamma : {1.0, 4.0}) {
        // At gamma 4 everything straight ahead looks 7.9 times smaller.
        const double E = physics::exp_rapidity(u_of_gamma(gamma)), fov = 2 * std::atan(std::tan(0.4) / E) / degree;
        OffscreenRenderer offscreen = renderer(world, one_view(Planar{fov}, {300, 300}));
        const Shot shot = shot_at({0, 0, 0}, {0, 0, -u_of_gamma(gamma)}, {0, 0, -1});
        const Numbers numbers(offscreen, shot);
        const double pixel = 2 * std::tan(0.4) / 300;
        std::vector<int> counts(squares.size() + 1);
        for (int i = 0; i < numbers.count(); ++i) {
            const dvec3 n = numbers.world(i);
            const double at = std::max(std::abs(n.x), std::abs(n.y)) / -n.z;
            std::size_t k = 0;
            bool edge = false;
            for (const Square& s : squares) {
                edge |= std::abs(at - s.half) < 3 * pixel;
                k += at > s.half;
            }
            if (edge)
                continue;
            ++counts[k];
            if (k == squares.size()) {
                ASSERT_TRUE(std::isinf(numbers.depth(i)));
                ASSERT_EQ(numbers.light(i), dvec3(0));
            } else {
                ASSERT_TRUE(near_colour(numbers.light(i), squares[k].colour, 0.001)) << at; // fp16 holds 0.9 to 2e-4
                // The plane is parallel to the cube's face: its distance is the same everywhere, to a dozen roundings of
                // float.
                ASSERT_NEAR(numbers.depth(i) * -n.z / squares[k].distance, 1, 12 * 0x1p-24) << at;
            }
        }
        for (int count : counts)
            EXPECT_GT(count, 500);
    }
}

TEST(Picture, TexturesBeginAtTheTopLeft)
{
    Doc doc;
    const auto file = gltf_test::png(2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255});
    const int image = doc.put("images", {{"uri", "data:image/png;base64," + gltf_test::base64(file)}});
    const int sampler = doc.put("samplers", {{"magFilter", 9728}, {"minFilter", 9728}});
    const int texture = doc.put("textures", {{"source", image}, {"sampler", sampler}});
    const int material = unlit(doc, {1, 1, 1});
    doc.json["materials"][material]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}};
    quad(doc, {0, 0, -2}, {1, 0, 0}, {0, 1, 0}, material);
    const GpuWorld world = open_world("texture", doc);
    OffscreenRenderer offscreen = renderer(world, one_view(Planar{60}, {100, 100}));
    for (double gamma : {1.0, 2.0}) {
        const Shot shot = shot_at({0, 0, 0}, {0, 0, -u_of_gamma(gamma)}, {0, 0, -1});
        const Numbers numbers(offscreen, shot);
        const int off = gamma > 1 ? 6 : 20; // inside the square, which looks smaller from the moving ship
        EXPECT_TRUE(near_colour(numbers.light((50 - off) * 100 + 50 - off), {1, 0, 0}, 0.001)) << "top left";
        EXPECT_TRUE(near_colour(numbers.light((50 - off) * 100 + 50 + off), {0, 1, 0}, 0.001)) << "top right";
        EXPECT_TRUE(near_colour(numbers.light((50 + off) * 100 + 50 - off), {0, 0, 1}, 0.001)) << "bottom left";
        EXPECT_TRUE(near_colour(numbers.light((50 + off) * 100 + 50 + off), {1, 1, 1}, 0.001)) << "bottom right";
    }
}

/// More than the 8 MiB that are uploaded at a time, also with four bytes a texel.
TEST(Picture, ALargeTextureKeepsItsRowsAndMips)
{
    constexpr int width = 300, height = 8192, bands = 8;
    std::vector<std::uint8_t> rgba;
    rgba.reserve(std::size_t(width) * height * 4);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto grey = std::uint8_t(30 + 28 * (y * bands / height));
            rgba.insert(rgba.end(), {grey, grey, grey, 255});
        }
    Doc doc;
    const std::string uri = "data:image/png;base64," + gltf_test::base64(gltf_test::png(width, height, rgba));
    for (const int filter : {9728, 9987}) { // the nearest texel, and mips
        doc = {};
        const int sampler = doc.put("samplers", {{"magFilter", 9728}, {"minFilter", filter}});
        const int texture = doc.put("textures", {{"source", doc.put("images", {{"uri", uri}})}, {"sampler", sampler}});
        const int material = unlit(doc, {1, 1, 1});
        doc.json["materials"][material]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}};
        quad(doc, {0, 0, -2}, {1, 0, 0}, {0, 1, 0}, material);
        const GpuWorld world = open_world("texture", doc);
        OffscreenRenderer offscreen = renderer(world, one_view(Planar{60}, {100, 100}));
        const Numbers numbers(offscreen, shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1}));
        for (int band = 0; band < bands; ++band) {
            const double grey = 30 + 28 * band, light = light_of_srgb(grey / 255);
            // A device may decode a byte as if it were half a step more or less: so allow Direct3D's rules, which GPUs are
            // built by. In software textures hold half floats.
            const double decoding
                = device().on_processor() ? 0 : light_of_srgb((grey + 0.5) / 255) - light_of_srgb(grey / 255);
            const double edge = 50 / std::tan(glm::radians(30.0)) / 2; // of the square, in pixels from the middle
            const int row = int(50 - edge + (band + 0.5) * 2 * edge / bands);
            EXPECT_TRUE(near_colour(numbers.light(row * 100 + 50), dvec3(light), 0.002 + std::sqrt(3) * decoding))
                << "band " << band << ", " << filter << ": " << numbers.light(row * 100 + 50).y << " for " << light;
        }
    }
}

/// A device guarantees 4,096 allocations and 4,000 samplers; a world may have more textures than that.
TEST(Picture, ManyTexturesShareFewAllocationsAndSamplers)
{
    constexpr int side = 24; // textures along each side of a square of them
    const auto colour_of = [](int i) { return glm::ivec3(i % 7 * 40, i / 7 % 7 * 40, i / 49 * 20); };
    Doc doc;
    const int samplers[2] = {doc.put("samplers", {{"magFilter", 9728}, {"minFilter", 9728}}),
        doc.put("samplers", {{"magFilter", 9729}, {"minFilter", 9987}})};
    for (int i = 0; i < side * side; ++i) {
        // Sizes of their own keep textures from having the places of their neighbours by chance.
        const int width = 1 + i % 5 * 16, height = 1 + i % 3 * 20;
        const glm::ivec3 colour = colour_of(i);
        std::vector<std::uint8_t> rgba;
        for (int texel = 0; texel < width * height; ++texel)
            rgba.insert(
                rgba.end(), {std::uint8_t(colour.r), std::uint8_t(colour.g), std::uint8_t(colour.b), std::uint8_t(255)});
        const std::string uri = "data:image/png;base64," + gltf_test::base64(gltf_test::png(width, height, rgba));
        const int texture
            = doc.put("textures", {{"source", doc.put("images", {{"uri", uri}})}, {"sampler", samplers[i % 2]}});
        const int material = unlit(doc, {1, 1, 1});
        doc.json["materials"][material]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}};
        quad(doc, {i % side - 11.5, 11.5 - i / side, -12}, {0.5, 0, 0}, {0, 0.5, 0}, material);
    }
    const GpuWorld world = open_world("textures", doc);
    EXPECT_EQ(world.textures.size(), std::size_t(side * side));
    EXPECT_LE(world.samplers.size(), 3u) << "the two above, and the one of materials without a texture";
    EXPECT_LE(world.texture_memory.blocks(), 10u);
    OffscreenRenderer offscreen = renderer(world, one_view(Planar{90}, {480, 480})); // 20 pixels a texture
    const Numbers numbers(offscreen, shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1}));
    for (int i = 0; i < side * side; ++i) {
        const glm::ivec3 colour = colour_of(i);
        dvec3 light;
        for (int c = 0; c < 3; ++c) {
            const double srgb = colour[c] / 255.0; // IEC 61966-2-1
            light[c] = srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
        }
        const int at = (i / side * 20 + 10) * 480 + i % side * 20 + 10;
        EXPECT_TRUE(near_colour(numbers.light(at), light, 0.002)) << i; // fp16 and eight bits
    }
}

// ---------------------------------------------------------------- edges

/// A texel of several samples must be lit at places on its surfaces. Columns ahead at gamma 4 are a few texels wide, and a
/// texel's centre beyond their edge lies inside the fluted neighbour, in its shadow: light taken there is 1.9 % too little
/// in the mean.
TEST(Picture, SamplesOfATexelKeepTheLightAtEdges)
{
    const Layout ahead = one_view(Planar{20}, {128, 72});
    const auto light = [&](const Shot& shot, const Quality& quality) {
        OffscreenRenderer offscreen(device(), pipelines(), avenue().world, ahead, within(device(), quality), true);
        const Numbers numbers(offscreen, shot);
        double sum = 0;
        for (int i = 0; i < numbers.count(); ++i)
            sum += numbers.light(i).y;
        return sum;
    };
    double samples = 0, centres = 0;
    for (const double aside : {-0.5, -0.3, -0.1, 0.1, 0.2, 0.3}) {
        Shot shot = shipped_shot("avenue-gamma4");
        shot.position += aside * dvec3(1, 0.7, 2.3);
        samples += light(shot,
            {.texels_per_pixel = 2, .max_texels_per_pixel = 200, .cube_samples = 4, .lod_error_texels = 0, .pixel_rays = 2});
        centres += light(shot,
            {.texels_per_pixel = 4, .max_texels_per_pixel = 200, .cube_samples = 1, .lod_error_texels = 0, .pixel_rays = 4});
    }
    std::printf("  light of 4 samples over that of centres: %.4f\n", samples / centres);
    EXPECT_NEAR(samples / centres, 1, 0.006);
}

// ---------------------------------------------------------------- two eyes

TEST(Picture, EachEyeSeesFromItsOwnEvent)
{
    Doc doc;
    // So near that 65 mm matter.
    for (int i = 0; i < 9; ++i) {
        const dvec3 centre(0.3 * (i % 3 - 1), 0.25 * (i / 3 - 1), -0.5 - 0.15 * (i * 5 % 7));
        quad(doc, centre, {0.08, 0, 0}, {0, 0.08, 0}, unlit(doc, {0.1 * i, 0.9 - 0.1 * i, i % 2 ? 0.8 : 0.2}));
    }
    const GpuWorld world = open_world("eyes", doc, {{"sky", smooth_sky}});
    const dvec3 eyes[2] = {{-0.0325, 0.004, 0}, {0.0325, 0, -0.01}};
    const ivec2 half(160, 120);
    Layout pair = one_view(Planar{60}, {2 * half.x, half.y});
    pair.outputs[0].viewports = {{.rect = {0, 0, 0.5, 1}, .projection = Planar{60}, .eye_m = eyes[0]},
        {.rect = {0.5, 0, 0.5, 1}, .projection = Planar{60}, .eye_m = eyes[1]}};
    pair.stereo.hyper_stereo = 1.5;
    OffscreenRenderer both = renderer(world, pair), one = renderer(world, one_view(Planar{60}, half));
    for (double gamma : {1.0, 1.5, 4.0}) {
        const Shot shot
            = shot_at({0.02, -0.01, 0.1}, u_of_gamma(gamma) * glm::normalize(dvec3(0.7, 0.2, -0.6)), {0.1, 0, -1});
        const auto picture = both.picture(shot).front();
        const Numbers numbers(both, shot);
        EXPECT_EQ(both.frame().plans().size(), 2u); // each eye has a cube map
        int apart = 0;
        for (int eye = 0; eye < 2; ++eye) {
            // The eyes are simultaneous in the ship. In the world the part across the motion is the same, the part along it
            // gamma times as long.
            const dvec3 e = shot.ship_from_cockpit * eyes[eye] * 1.5;
            const dvec3 way = shot.u == dvec3(0) ? dvec3(0) : glm::normalize(shot.u);
            Shot alone = shot;
            alone.position = shot.position + e + (gamma - 1) * glm::dot(e, way) * way;
            const auto mono = one.picture(alone).front();
            const Numbers of_one(one, alone);
            int different = 0;
            for (int y = 0; y < half.y; ++y)
                for (int x = 0; x < half.x; ++x) {
                    const int i = y * 2 * half.x + eye * half.x + x, j = y * half.x + x;
                    for (int k = 0; k < 3; ++k)
                        different += std::abs(picture[4 * i + k] - mono[4 * j + k]) > 1;
                    const double a = numbers.depth(i), b = of_one.depth(j);
                    different += std::isinf(a) != std::isinf(b) || (std::isfinite(a) && std::abs(a / b - 1) > 1e-5);
                    apart += eye == 0 && std::isinf(a) != std::isinf(numbers.depth(i + half.x));
                }
            // The two places agree but for their last bit, which may move an edge across a sample.
            EXPECT_LE(different, 4) << "eye " << eye << " at gamma " << gamma;
        }
        EXPECT_GT(apart, 100) << "the eyes see the same"; // otherwise the comparison proves nothing
    }
}

TEST(Picture, EyesInOnePlaceShareACubeMap)
{
    Layout layout = one_view(Planar{60}, {100, 50});
    layout.outputs[0].viewports
        = {{.rect = {0, 0, 0.5, 1}, .projection = Planar{60}}, {.rect = {0.5, 0, 0.5, 1}, .projection = Planar{30}}};
    OffscreenRenderer offscreen = renderer(avenue().world, layout, false);
    offscreen.picture(shipped_shot("start"));
    EXPECT_EQ(offscreen.frame().plans().size(), 1u);
}

// ---------------------------------------------------------------- errors that the user can correct

TEST(WrongDevice, AnUnknownGpuIsRefusedInOneLine)
{
    const std::string message = testing::complaint([] { Device({.name = "no such GPU"}); });
    EXPECT_NE(message.find("no such GPU"), std::string::npos) << message;
    EXPECT_NE(message.find("install"), std::string::npos) << message;
    EXPECT_NE(message.find(device().properties.deviceName.data()), std::string::npos)
        << message << ": lists the available GPUs";
}

TEST(WrongDevice, AnOutputAboveTheDevicesLimitIsRefusedInOneLine)
{
    const int limit = int(device().properties.limits.maxImageDimension2D);
    for (ivec2 size : {ivec2(limit + 1, 8), ivec2(8, limit + 1)})
        for (const Projection& projection : {Projection(Planar{60}), Projection(Fisheye{180, 0})}) {
            const std::string message
                = testing::complaint([&] { renderer(avenue().world, one_view(projection, size), false); });
            EXPECT_NE(message.find(std::to_string(limit)), std::string::npos) << message;
        }
}

} // namespace
} // namespace starbow::gpu_test::picture_gpu_test
