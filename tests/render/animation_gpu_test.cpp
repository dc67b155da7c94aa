// Blinking, spinning and animated objects in the picture.
#include "config/model/angles.h"
#include "runtime/plan/cull.h"
#include "tests/support/quad.h"
#include "tests/support/small_world.h"

namespace starbow::gpu_test::animation_gpu_test {
namespace {

dvec3 vec(const quad::V3& v) { return {double(v.x), double(v.y), double(v.z)}; }

/// Transforms from the world to the frame that moves with u.
quad::V4 into(const dvec3& u, const quad::V4& e) { return quad::boosted(quad::of(u) * -1, e); }

/// Adds a material that blinks and reflects nothing.
int blinking(Doc& doc, const dvec3& colour, const Json& blink)
{
    return doc.put("materials",
        {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"baseColorFactor", {0, 0, 0, 1}}}},
            {"emissiveFactor", numbers_of(colour)}, {"extras", {{"starbow", {{"blink", blink}}}}}});
}

Json slow() { return {{"light_speed_m_s", 1}}; } // one unit is a metre, and light flies one metre a second

} // namespace

TEST(Blinking, SweepsOverAWallAsItsLightArrives)
{
    // The wall is 3 away. Its rings of light are as large as their light's travel time allows.
    const double period = 2, on = 0.3, zero = 0.7;
    Doc doc;
    quad(doc, {0, 0, -3}, {20, 0, 0}, {0, 20, 0},
        blinking(doc, {0.5, 0.25, 0.125}, {{"period_s", period}, {"on", on}, {"zero_s", zero}}), {{"name", "wall"}});
    for (const dvec3& u : {dvec3(0), dvec3(0.7, 0.2, 0.4)}) {
        // The ship is at rest or moves, and so is the wall. A start after months covers large times.
        for (bool on_body : {false, true}) {
            Json scene = slow();
            if (on_body)
                scene["bodies"] = {{{"name", "wall"}, {"nodes", {"wall"}}, {"velocity", velocity_of({0.3, -0.6, 0.5})}}};
            const dvec3 wall_u = on_body ? dvec3(0.3, -0.6, 0.5) : dvec3(0);
            const GpuWorld world = open_world("rings", doc, scene);
            for (double time : {0.4, 1.1, on_body ? 0.0 : 1e7}) {
                Shot shot = shot_at({0.3, -0.2, 0}, u, {0, 0, -1});
                shot.time = time;
                Quality quality = test_quality();
                quality.max_texels_per_pixel = 1000; // not limited below the finest texel that the pixels need
                OffscreenRenderer offscreen(device(), pipelines(), world, one_view(Planar{100}, {320, 240}), quality, true);
                const Numbers numbers(offscreen, shot);
                long lit = 0, dark = 0, wrong = 0;
                for (int i = 0; i < numbers.count(); i += 7) {
                    if (!numbers.shown(i))
                        continue;
                    auto state = [&](int pixel) { // periods since the first flash, at the retarded time
                        const quad::V4 p
                            = into(wall_u, quad::boosted(quad::of(shot.u), {1, quad::of(numbers.camera(pixel)) * -1}));
                        const quad::V4 e = into(wall_u, {shot.time, quad::of(shot.position)});
                        const dvec3 way = vec(p.x * (-1 / p.t)), from = vec(e.x);
                        const double r = (-3 - from.z) / way.z;
                        const dvec3 at = from + r * way;
                        return r > 0 && std::max(std::abs(at.x), std::abs(at.y)) < 19.5 ? double((e.t - r - zero) / period)
                                                                                        : std::nan("");
                    };
                    // Pixels within four pixels of an edge are left out, because texels are filtered.
                    const ivec2 size = numbers.size, at(i % size.x, i / size.x);
                    if (at.x < 4 || at.y < 4 || at.x + 4 >= size.x || at.y + 4 >= size.y)
                        continue;
                    const double here = state(i), whole = std::floor(here);
                    bool plain = !std::isnan(here);
                    for (int beside : {-4, 4, -4 * size.x, 4 * size.x})
                        plain = plain && std::floor(state(i + beside)) == whole
                            && (state(i + beside) - whole < on) == (here - whole < on);
                    if (!plain)
                        continue;
                    const bool is_on = here - whole < on;
                    ++(is_on ? lit : dark);
                    const dvec3 light = numbers.light(i);
                    const bool right
                        = is_on ? glm::length(light - dvec3(0.5, 0.25, 0.125)) < 0.01 : glm::length(light) < 0.01;
                    wrong += !right;
                    if (!right && wrong < 4)
                        ADD_FAILURE() << "pixel " << at.x << ", " << at.y << ": " << light.r << " at phase " << here;
                }
                EXPECT_EQ(wrong, 0) << time << " on the body: " << on_body;
                EXPECT_GT(lit, 150) << time << " on the body: " << on_body;
                EXPECT_GT(dark, 500) << time << " on the body: " << on_body;
            }
        }
    }
}

TEST(Blinking, RingsMoveOutwards)
{
    // The ring of one flash has the radius sqrt(t^2 - 9) on the wall in every direction.
    Doc doc;
    quad(doc, {0, 0, -3}, {20, 0, 0}, {0, 20, 0}, blinking(doc, {1, 1, 1}, {{"period_s", 1000}, {"on", 0.0005}}));
    const GpuWorld world = open_world("flash", doc, slow());
    OffscreenRenderer offscreen = renderer(world, one_view(Planar{90}, {401, 401}));
    double before = 0;
    for (double t : {3.6, 3.8, 4.0, 4.2}) {
        Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
        shot.time = t;
        const Numbers numbers(offscreen, shot);
        double outer = 0; // from the outermost lit pixel to the right
        for (int x = 200; x < 401; ++x)
            if (numbers.light(200 * 401 + x).g > 0.5)
                outer = 3 * (x + 0.5 - 200) / 200.5;
        EXPECT_NEAR(outer, std::sqrt(t * t - 9), 3 * 0.75 / 200.5) << t; // half a pixel, and a quarter for the filter
        EXPECT_GT(outer, before);
        before = outer;
    }
}

namespace {

/// The direction in which an eye at rest in the world sees a point of a body that moves with u. `place` gives the point's
/// place in the body's rest frame at any time. Bisection solves the light cone's equation.
template <class Place> dvec3 seen_from(const dvec3& u, double time, const dvec3& eye, Place place)
{
    const quad::V4 e = into(u, {time, quad::of(eye)});
    quad::Q low = e.t - 1000, high = e.t;
    for (int i = 0; i < 150; ++i) {
        const quad::Q middle = (low + high) / 2;
        (middle + quad::length(place(middle) - e.x) > e.t ? high : low) = middle;
    }
    return vec(quad::camera_from_world(place(low) - e.x, quad::of(u) * -1).n);
}

} // namespace

TEST(Spinning, TipsAreSeenWhereTheirLightLeft)
{
    // A bar turns about a slanted axis with 0.2 c at its tips, so that it looks bent. It is at rest, or on a body at 0.8 c.
    const dvec3 axis = glm::normalize(dvec3(0.2, 1, 0.4)), middle(0.3, 0.1, -9);
    const double reach = 3, turns = 0.19 / (2 * pi * reach);
    Doc doc;
    const int mesh = blobs(doc, {{{reach, 0, 0}, {1, 0, 0}}, {{-reach, 0, 0}, {0, 1, 0}}, {{0, 0, 0}, {0, 0, 1}}}, 0.07);
    Json node = {{"name", "bar"}, {"mesh", mesh}, {"translation", numbers_of(middle)}};
    node["extras"]["starbow"]["spin"] = {{"axis", numbers_of(axis)}, {"turns_per_s", turns}};
    doc.json["scenes"][0]["nodes"] = {doc.put("nodes", node)};
    double worst = 0, largest_offset = 0;
    for (double beta : {0.0, 0.8}) {
        const dvec3 u = glm::normalize(dvec3(1, 0.1, 0.2)) * u_of_beta(beta);
        Json scene = slow();
        if (beta > 0)
            scene["bodies"] = {{{"name", "bar"}, {"nodes", {"bar"}}, {"velocity", velocity_of(u)}}};
        const GpuWorld world = open_world("bar", doc, scene);
        for (double time : {-7.0, 0.0, 4.0, 13.0, beta > 0 ? 21.0 : 1e7}) {
            auto tip = [&](double sign) {
                return [&, sign](quad::Q t) {
                    const quad::Q part = quad::Q(turns) * t, half = quad::pi * (part - floorq(part));
                    const dvec3 rest(sign * reach, 0, 0);
                    // Rodrigues' formula.
                    const quad::V3 r = quad::of(rest), k = quad::unit(quad::of(axis));
                    const quad::Q c = cosq(2 * half), s = sinq(2 * half);
                    return quad::of(middle) + r * c + quad::cross(k, r) * s + k * (quad::dot(k, r) * (1 - c));
                };
            };
            const dvec3 eye(0, 0, 0);
            const dvec3 look = seen_from(u, time, eye, [&](quad::Q) { return quad::of(middle); });
            Shot shot = shot_at(eye, {0, 0, 0}, look, std::abs(look.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(0, 0, 1));
            shot.time = time;
            constexpr int across = 900;
            OffscreenRenderer offscreen = renderer(world, one_view(Planar{75}, {across, across}));
            const Numbers numbers(offscreen, shot);
            const double pixel = 2 * std::tan(37.5 * degree) / across;
            for (double sign : {1.0, -1.0, 0.0}) {
                const dvec3 expected = seen_from(u, time, eye, tip(sign));
                const dvec3 found = direction_of(numbers, sign > 0 ? 0 : sign < 0 ? 1 : 2);
                EXPECT_LT(between(expected, found), 0.5 * pixel) << "beta " << beta << " time " << time << " tip " << sign
                                                                 << ", pixels " << between(expected, found) / pixel;
                worst = std::max(worst, between(expected, found) / pixel);
                // The direction in which the tip would be seen with the retarded time of the bar's middle.
                const dvec3 without_offset = seen_from(u, time, eye, [&](quad::Q) {
                    const quad::V4 e = into(u, {time, quad::of(eye)});
                    return tip(sign)(e.t - quad::length(quad::of(middle) - e.x));
                });
                largest_offset = std::max(largest_offset, between(without_offset, expected) / pixel);
            }
        }
    }
    std::printf("  tips: at most %.2f px off, light-travel offset up to %.1f px\n", worst, largest_offset);
    EXPECT_GT(largest_offset, 5);
}

TEST(Animated, AShuttleIsSeenWhereItsLightLeft)
{
    const dvec3 a(-0.8, 0.2, -8), b(0.9, 0.6, -7);
    Doc doc;
    const int mesh = blobs(doc, {{{0, 0, 2}, {1, 0, 0}}, {{0, 0, -2}, {0, 1, 0}}, {{1, 1, 0}, {0, 0, 1}}}, 0.05);
    const int node = doc.put("nodes", {{"name", "shuttle"}, {"mesh", mesh}});
    doc.json["scenes"][0]["nodes"] = {node};
    std::vector<float> places;
    for (const dvec3& place : {a, b, a})
        for (int c = 0; c < 3; ++c)
            places.push_back(float(place[c]));
    doc.json["animations"] = {
        {{"samplers", {{{"input", doc.accessor<float>({0, 12, 24}, "SCALAR")}, {"output", doc.accessor(places, "VEC3")}}}},
            {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}}}}}};
    double worst = 0;
    for (double beta : {0.0, 0.8}) {
        const dvec3 u = glm::normalize(dvec3(0.3, -0.2, 1)) * u_of_beta(beta);
        Json scene = slow();
        if (beta > 0)
            scene["bodies"] = {{{"name", "shuttle"}, {"nodes", {"shuttle"}}, {"velocity", velocity_of(u)}}};
        const GpuWorld world = open_world("shuttle", doc, scene);
        for (double time : {-3.0, 1.0, 6.0, beta > 0 ? 9.0 : 14.0}) {
            auto point = [&](const dvec3& rest) {
                return [&, rest](quad::Q t) {
                    const quad::Q round = t / 24 - floorq(t / 24), part = round < 0.5 ? 2 * round : 2 - 2 * round;
                    const glm::vec3 af(a), bf(b);
                    return quad::of(rest) + quad::of(af) + (quad::of(bf) - quad::of(af)) * part;
                };
            };
            const dvec3 look = seen_from(u, time, {0, 0, 0}, point({0, 0, 0}));
            Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, look);
            shot.time = time;
            constexpr int across = 1400;
            OffscreenRenderer offscreen = renderer(world, one_view(Planar{110}, {across, across}));
            const Numbers numbers(offscreen, shot);
            const double pixel = 2 * std::tan(55 * degree) / across;
            int colour = 0;
            for (const dvec3& rest : {dvec3(0, 0, 2), dvec3(0, 0, -2), dvec3(1, 1, 0)}) {
                const dvec3 expected = seen_from(u, time, {0, 0, 0}, point(rest)), found = direction_of(numbers, colour++);
                EXPECT_LT(between(expected, found), 0.5 * pixel)
                    << "beta " << beta << " time " << time << " point " << colour << ", pixels "
                    << between(expected, found) / pixel;
                worst = std::max(worst, between(expected, found) / pixel);
            }
        }
    }
    std::printf("  shuttle: at most %.2f px off\n", worst);
}

TEST(Animated, AWorldWithoutAnyHasNoneOfItsCode)
{
    const GpuWorld& without = avenue().world;
    EXPECT_TRUE(without.world.motions.empty());
    for (std::size_t m = 0; m < without.world.materials.size(); ++m) {
        EXPECT_FALSE(without.variant(int(m), StoredLight::coefficients).blink);
        EXPECT_FALSE(without.variant(int(m), StoredLight::coefficients).moves);
    }
    const std::vector<PlannedImage> images = {{0, 0, {-1, -1}, {1, 1}, {64, 64}, {0, 0}, 64, 1}};
    const DrawList list = cull(without.world, {{EyeEvent{}}}, images);
    EXPECT_EQ(list.instances.size(), without.world.instances.size());
    for (const Draw& draw : list.draws)
        EXPECT_FALSE(draw.moves);
}

TEST(Blinking, AWorldOfOneSecondLooksTheSameAfterThirtyDays)
{
    // Everything has a period of which 2.6e6 s are a multiple: a wall that blinks each 2 s, and a bar that turns once in 100
    // s.
    Doc doc;
    quad(doc, {0, 0, -8}, {20, 0, 0}, {0, 20, 0},
        blinking(doc, {0.4, 0.3, 0.2}, {{"period_s", 2}, {"on", 0.3}, {"zero_s", 0.7}}));
    Json node = {{"name", "bar"}, {"mesh", blobs(doc, {{{2, 0, 0}, {1, 0.2, 0.2}}, {{-2, 0, 0}, {0.2, 1, 0.2}}}, 0.4)},
        {"translation", {0.2, 0.1, -5}}};
    node["extras"]["starbow"]["spin"] = {{"axis", {0.2, 0.3, 1}}, {"turns_per_s", 0.01}};
    doc.json["scenes"][0]["nodes"].push_back(doc.put("nodes", node));
    const GpuWorld world = open_world("month", doc, slow());
    OffscreenRenderer offscreen = renderer(world, one_view(Planar{80}, {200, 160}));
    for (const dvec3& u : {dvec3(0), dvec3(0.7, 0.2, -0.9)})
        for (double time : {0.0, 0.9, 33.3}) {
            Shot shot = shot_at({0.3, -0.2, 0}, u, {0, 0, -1});
            shot.time = time;
            const auto before = offscreen.picture(shot);
            shot.time = time + 2.6e6;
            const auto after = offscreen.picture(shot);
            long different = 0, bright = 0;
            for (std::size_t i = 0; i < before[0].size(); ++i) {
                different += std::abs(int(before[0][i]) - int(after[0][i])) > 1;
                bright += i % 4 < 3 && before[0][i] > 40;
            }
            EXPECT_EQ(different, 0) << "at " << time << " s, u " << u.x;
            EXPECT_GT(bright, 300) << "the picture is empty";
        }
}

} // namespace starbow::gpu_test::animation_gpu_test
