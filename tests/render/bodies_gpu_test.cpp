// Moving bodies in the picture. They are compared with rays transformed into each body's frame with 33 digits, with the same
// objects at rest before a moving ship, and with textbook results for passing spheres.
#include "config/model/angles.h"
#include "runtime/world/worldline.h"
#include "tests/support/quad.h"
#include "tests/support/small_world.h"
#include <random>

namespace starbow::gpu_test::bodies_gpu_test {
namespace {

dvec3 random_way(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    return glm::normalize(dvec3(normal(random), normal(random), normal(random)));
}

/// A rectangle that belongs to one body.
struct Plate {
    dvec3 centre, right, up, colour;
    std::size_t body;
};

dvec3 vec(const quad::V3& v) { return {double(v.x), double(v.y), double(v.z)}; }

/// With the usual limit of texels, a plan with many images draws all of them coarser.
Quality unlimited_texels()
{
    Quality quality = test_quality();
    quality.max_texels_per_pixel = 1000;
    return quality;
}

/// Transforms from the world to the frame that moves with u.
quad::V4 into(const dvec3& u, const quad::V4& e) { return quad::boosted(quad::of(u) * -1, e); }

} // namespace

TEST(BodiesGpuTest, EveryRayMeetsWhatIsNearest)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> part(0, 1);
    for (int round = 0; round < (starbow::testing::all_cases() ? 6 : 3); ++round) {
        // The bodies: one at rest, three with constant velocities, and one that turns round and so has two more velocities.
        std::vector<dvec3> velocities = {{0, 0, 0}};
        for (int i = 0; i < 3; ++i)
            velocities.push_back(random_way(random) * std::pow(10, 1.5 * part(random) - 0.7));
        const dvec3 turn_place = random_way(random) * 3.0;
        Json bodies = Json::array();
        for (std::size_t i = 1; i < velocities.size(); ++i) {
            const std::string number = std::to_string(i);
            bodies.push_back(
                {{"name", "body " + number}, {"nodes", {"b" + number}}, {"velocity", velocity_of(velocities[i])}});
        }
        bodies.push_back({{"name", "turns"}, {"nodes", {"b4"}},
            {"worldline",
                {{{"time", -14}, {"position", {0, 0, 0}}}, {{"time", -7}, {"position", numbers_of(turn_place)}},
                    {{"time", 3}, {"position", {0, 0, 0}}}}}});
        Doc doc;
        std::vector<Plate> plates;
        for (std::size_t body = 0; body < 5; ++body)
            for (int i = 0; i < 7; ++i) {
                const dvec3 right = random_way(random), other = random_way(random);
                const dvec3 colour(0.1 + 0.9 * part(random), 0.1 + 0.9 * part(random), 0.1 + 0.9 * part(random));
                plates.push_back({random_way(random) * (2 + 6 * part(random)), right * (0.6 + 2 * part(random)),
                    glm::normalize(glm::cross(right, other)) * (0.6 + 2 * part(random)), colour, body});
                const Plate& p = plates.back();
                const int material = unlit(doc, colour);
                doc.json["materials"][std::size_t(material)]["doubleSided"] = true;
                quad(doc, p.centre, p.right, p.up, material, {{"name", std::string(1, 'b') + std::to_string(body)}});
            }
        const GpuWorld world = open_world("rays", doc, {{"bodies", bodies}});
        Shot shot = shot_at(random_way(random) * 0.5, random_way(random) * (round == 0 ? 0.0 : 3 * part(random)),
            random_way(random), random_way(random));
        shot.time = 2 * part(random) - 1;
        const ivec2 size(320, 240);
        OffscreenRenderer offscreen(device(), pipelines(), world,
            one_view(round % 2 ? Projection(Fisheye{}) : Projection(Planar{100}), size), unlimited_texels(), true);
        const Numbers numbers(offscreen, shot);

        // One frame for each worldline segment: its proper velocity, the event of its origin, and its existence interval.
        struct Segment {
            std::size_t body;
            dvec3 u;
            Event at;
            double begin, end; // in the segment's own time since `at`
        };
        std::vector<Segment> segments;
        for (std::size_t i = 0; i < 4; ++i)
            segments.push_back({i, velocities[i], {}, -1e300, 1e300});
        const double out = std::sqrt(49.0 - 9), back = std::sqrt(100.0 - 9);
        segments.push_back({4, turn_place / out, {-14, {0, 0, 0}}, 0, out});
        segments.push_back({4, -turn_place / back, {-7, turn_place}, 0, back});

        struct Hit {
            double way = 1e300, D = 0, distance = 0;
            dvec3 colour{0};
            const Plate* plate = nullptr;
            const Segment* segment = nullptr;
        };
        auto truth = [&](const dvec3& n) {
            Hit nearest;
            for (const Segment& segment : segments) {
                // Transforms the eye's event and the light's 4-momentum from the ship to the world, then to the body.
                const quad::V4 p = into(segment.u, quad::boosted(quad::of(shot.u), {1, quad::of(n) * -1}));
                const quad::V4 e = into(
                    segment.u, {shot.time - segment.at.time, quad::of(shot.position) + quad::of(-segment.at.position)});
                const dvec3 from = vec(e.x), way = vec(p.x * (-1 / p.t));
                for (const Plate& plate : plates) {
                    if (plate.body != segment.body)
                        continue;
                    const dvec3 front = glm::cross(plate.right, plate.up);
                    const double r = glm::dot(front, plate.centre - from) / glm::dot(front, way);
                    const dvec3 on = from + r * way - plate.centre;
                    const double left = double(e.t) - r;
                    if (r > 1e-6 && std::abs(glm::dot(on, plate.right)) < glm::dot(plate.right, plate.right)
                        && std::abs(glm::dot(on, plate.up)) < glm::dot(plate.up, plate.up) && left > segment.begin
                        && left < segment.end && r / double(p.t) < nearest.way) {
                        // The length of the light's path scales as its frequency: in the body's frame it is multiplied by D.
                        nearest = {r / double(p.t), 1 / double(p.t), 0, plate.colour, &plate, &segment};
                        nearest.distance = nearest.way * double(quad::boosted(quad::of(shot.u), {1, quad::of(n) * -1}).t);
                    }
                }
            }
            return nearest;
        };
        long compared = 0, hits = 0, wrong = 0;
        std::array<long, 6> of_body{};
        for (int i = 0; i < numbers.count(); i += 13) {
            const int x = i % size.x, y = i / size.x;
            if (!numbers.shown(i) || x < 2 || y < 2 || x + 2 >= size.x || y + 2 >= size.y)
                continue;
            const Hit hit = truth(numbers.camera(i));
            bool edge = false;
            double nearest = hit.distance,
                   farthest = hit.distance; // the range within a pixel, because a plate may be seen nearly edge-on
            // Filtered texels are one or two pixels wide, so that no edge may be within two pixels.
            for (int k = 0; k < 25 && !edge; ++k) {
                const int beside = i + (k / 5 - 2) * size.x + k % 5 - 2;
                if ((edge = !numbers.shown(beside)))
                    break;
                const Hit other = truth(numbers.camera(beside));
                edge = other.plate != hit.plate || other.segment != hit.segment;
                nearest = std::min(nearest, other.distance), farthest = std::max(farthest, other.distance);
            }
            if (edge)
                continue;
            ++compared;
            if (!hit.plate) {
                wrong += glm::length(numbers.light(i))
                    > 0.02; // coarser texels from beyond these pixels have a weight near zero
                continue;
            }
            ++hits;
            ++of_body[hit.plate->body];
            const bool same = glm::length(numbers.light(i) - hit.colour) < 0.01 * glm::length(hit.colour)
                && std::abs(numbers.D(i) / hit.D - 1) < 2e-5 && numbers.depth(i) > 0.999 * nearest
                && numbers.depth(i) < 1.001 * farthest;
            wrong += !same;
            if (!same && wrong < 4)
                ADD_FAILURE() << "round " << round << " pixel " << x << ", " << y << " body " << hit.plate->body
                              << ": light " << numbers.light(i).x << " not " << hit.colour.x << ", D " << numbers.D(i)
                              << " not " << hit.D << ", distance " << numbers.depth(i) << " not " << hit.distance;
        }
        EXPECT_EQ(wrong, 0) << "round " << round << " of " << compared;
        EXPECT_GT(hits, compared / 10);
        EXPECT_GT(compared, 1000);
    }
}

namespace {

/// Plates all around for comparing two pictures.
Doc still_life()
{
    Doc doc;
    std::mt19937 random(2);
    std::uniform_real_distribution<double> part(0, 1);
    for (int i = 0; i < 12; ++i) {
        const double angle = 2 * pi * i / 12;
        const int material = doc.put("materials",
            {{"doubleSided", true},
                {"pbrMetallicRoughness",
                    {{"metallicFactor", 0},
                        {"baseColorFactor", {0.2 + 0.8 * part(random), 0.2 + 0.8 * part(random), 0.5, 1}}}}});
        quad(doc, {4 * std::cos(angle), 4 * std::sin(angle), -9 + 5 * part(random)}, random_way(random),
            random_way(random) * 0.8, material, {{"name", "things"}});
    }
    return doc;
}
/// Light under a filter three pixels wide. The sharpness of texels depends on how much of the world shares their images.
std::vector<dvec3> softened(const Numbers& numbers)
{
    const ivec2 size = numbers.size;
    std::vector<dvec3> out;
    for (int i = 0; i < numbers.count(); ++i)
        out.push_back(numbers.light(i));
    for (int round = 0; round < 2; ++round) {
        const std::vector<dvec3> from = std::exchange(out, std::vector<dvec3>(out.size()));
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                for (int dy : {-1, 0, 1})
                    for (int dx : {-1, 0, 1}) {
                        const ivec2 at = glm::clamp(ivec2(x + dx, y + dy), ivec2(0), size - 1);
                        out[std::size_t(y * size.x + x)]
                            += from[std::size_t(at.y * size.x + at.x)] * ((2 - std::abs(dx)) * (2 - std::abs(dy)) / 16.0);
                    }
    }
    return out;
}

const Json lamp = {{"type", "point"}, {"position", {0, 0, -3}}, {"distance", 5}, {"radiance", {1, 0.9, 0.8}}};

} // namespace

TEST(BodiesGpuTest, OnlyTheRelativeMotionMatters)
{
    // The objects rest before a moving ship, or the objects and their lamp move past a resting ship.
    for (auto [beta, way] : {std::pair(0.5, dvec3(0, 0, -1)), {0.9, dvec3(1, 0, -1)}, {0.8, dvec3(0, 1, 1)}}) {
        const dvec3 u = glm::normalize(way) * u_of_beta(beta);
        const GpuWorld still = open_world("still", still_life(), {{"lights", {lamp}}});
        Json riding = lamp;
        riding["body"] = "all";
        const GpuWorld moving = open_world("moving", still_life(),
            {{"lights", {riding}}, {"bodies", {{{"name", "all"}, {"nodes", {"things"}}, {"velocity", velocity_of(-u)}}}}});
        const Layout layout = one_view(Planar{80}, {400, 300});
        Shot passing = shot_at({0, 0, 0}, u, {0, 0, -1});
        passing.effects = {};
        Shot resting = passing;
        resting.u = dvec3(0);
        Quality fine = unlimited_texels();
        fine.texels_per_pixel = 3;
        OffscreenRenderer a(device(), pipelines(), still, layout, fine, true),
            b(device(), pipelines(), moving, layout, fine, true);
        const Numbers first(a, passing), second(b, resting);
        const std::vector<dvec3> one = softened(first), other = softened(second);
        auto at = [&](double x, double y) {
            const int width = first.size.x;
            x = std::clamp(x, 0.0, width - 1.001), y = std::clamp(y, 0.0, first.size.y - 1.001);
            const std::size_t i = std::size_t(int(y) * width + int(x)), below = i + std::size_t(width);
            const double fx = x - int(x), fy = y - int(y);
            return glm::mix(glm::mix(one[i], one[i + 1], fx), glm::mix(one[below], one[below + 1], fx), fy);
        };
        long lit = 0, off = 0;
        double brightest = 0;
        for (int i = 0; i < first.count(); ++i)
            brightest = std::max(brightest, glm::length(first.light(i)));
        for (int i = 0; i < first.count(); ++i) {
            lit += glm::length(first.light(i)) > 0.01 * brightest;
            // Edges may differ by half a texel in either picture, a third of a pixel together. Colours may differ by 1 % of
            // the light near them.
            dvec3 low(1e300), high(-1e300), near(0);
            for (double dy : {-0.5, 0.0, 0.5})
                for (double dx : {-0.5, 0.0, 0.5}) {
                    const dvec3 light = at(i % first.size.x + dx, i / first.size.x + dy);
                    low = glm::min(low, light), high = glm::max(high, light);
                }
            for (double dy : {-2, 0, 2})
                for (double dx : {-2, 0, 2})
                    near = glm::max(near, glm::abs(at(i % first.size.x + dx, i / first.size.x + dy)));
            const dvec3 room = 0.01 * near + 1e-5 * brightest;
            const dvec3 light = other[std::size_t(i)];
            off += glm::any(glm::lessThan(light, low - room)) || glm::any(glm::greaterThan(light, high + room));
        }
        EXPECT_EQ(off, 0) << "beta " << beta;
        EXPECT_GT(lit, 2000);
    }
}

TEST(BodiesGpuTest, ASphereKeepsACircularOutline)
{
    // docs/physics/relativity.md: a circle of radius 20 degrees, 90 degrees from the motion, at 0.9 c: centre 27.26680,
    // radius 9.01490.
    Doc doc;
    const int material = unlit(doc, {1, 1, 1});
    std::vector<float> positions;
    std::vector<std::uint16_t> indices;
    constexpr int rings = 90, sides = 180;
    for (int j = 0; j <= rings; ++j)
        for (int i = 0; i < sides; ++i) {
            const double theta = pi * j / rings, phi = 2 * pi * i / sides;
            for (double x : {std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi)})
                positions.push_back(float(x));
        }
    for (int j = 0; j < rings; ++j)
        for (int i = 0; i < sides; ++i)
            for (int k : {0, sides, sides + 1, 0, sides + 1, 1})
                indices.push_back(std::uint16_t(j * sides + (k >= sides ? sides : 0) + (i + k % sides) % sides));
    Json primitive = {{"attributes", {{"POSITION", doc.accessor(positions, "VEC3")}}},
        {"indices", doc.accessor(indices, "SCALAR")}, {"material", material}};
    doc.json["scenes"][0]["nodes"].push_back(
        doc.put("nodes", {{"name", "ball"}, {"mesh", doc.put("meshes", {{"primitives", {primitive}}})}}));
    // In the ball's frame the light reaches the eye at right angles to the motion.
    const double beta = 0.9, distance = 1 / std::sin(20 * degree);
    const dvec3 u(0, 0, u_of_beta(beta)); // the ball comes from ahead and moves backwards
    const dvec3 in_ball(0, distance, 0); // the eye
    const GpuWorld world = open_world("ball", doc,
        {{"bodies",
            {{{"name", "ball"}, {"nodes", {"ball"}}, {"velocity", velocity_of(u)},
                {"at", {{"time", 0}, {"position", numbers_of(-in_ball)}}}}}}});
    // 90 degrees from the ship's motion (-z in the ball's frame), below.
    const dvec3 look = glm::normalize(dvec3(0, -std::sin(27.26680 * degree), -std::cos(27.26680 * degree)));
    OffscreenRenderer offscreen = renderer(world, one_view(Planar{30}, {600, 600}));
    const Numbers numbers(offscreen, shot_at({0, 0, 0}, {0, 0, 0}, look));
    // Pixels between light and dark give directions on the outline.
    const double pixel = 30 * degree / 600;
    double radius_low = 10, radius_high = 0, area = 0;
    for (int i = 0; i < numbers.count(); ++i) {
        const double light = numbers.light(i).g;
        const double r = between(numbers.camera(i), look);
        if (i + 1 < numbers.count() && light > 0.35 && light < 0.65) {
            radius_low = std::min(radius_low, r), radius_high = std::max(radius_high, r);
        }
        const dvec3 c = numbers.camera(i);
        area += light
            * std::pow(glm::dot(c, look), 3); // the solid angle of a flat view's pixel, in units of the middle pixel's
    }
    const double step = 2 * std::tan(15 * degree) / 600;
    const double radius = std::acos(1 - area * step * step / (2 * pi));
    EXPECT_NEAR(radius / degree, 9.01490, 0.5 * pixel / degree);
    EXPECT_GT(radius_low, 9.01490 * degree - pixel);
    EXPECT_LT(radius_high, 9.01490 * degree + pixel);
    std::printf("outline: radius %.4f, from %.4f to %.4f degrees; a pixel has %.4f\n", radius / degree, radius_low / degree,
        radius_high / degree, pixel / degree);
}

TEST(BodiesGpuTest, ABodySeenAbeamSeemsTurned)
{
    // Terrell: a small passing body, seen at right angles to its motion, appears rotated by asin(beta). One mark lies ahead
    // of the middle by a, another nearer by a. They appear further on by a cos and a sin of that angle.
    constexpr double a = 0.1, L = 20;
    for (auto [beta, turn_deg] : {std::pair(0.5, 30.0), {0.8, 53.1301}, {0.99, 81.8904}}) {
        Doc doc;
        const dvec3 right(0.01, 0, 0), up(0, 0.01, 0);
        quad(doc, {0, 0, 0}, right, up, unlit(doc, {1, 0, 0}), {{"name", "body"}});
        quad(doc, {a, 0, 0}, right, up, unlit(doc, {0, 1, 0}), {{"name", "body"}});
        quad(doc, {0, 0.03, a}, right, up, unlit(doc, {0, 0, 1}), {{"name", "body"}});
        for (auto& material : doc.json["materials"])
            material["doubleSided"] = true; // a body that appears far rotated shows its back
        const double u = u_of_beta(beta), gamma = std::sqrt(1 + u * u);
        // The body is seen abeam at time 0: its middle was straight ahead at the emission, L earlier.
        const GpuWorld world = open_world("terrell", doc,
            {{"bodies",
                {{{"name", "body"}, {"nodes", {"body"}}, {"velocity", velocity_of({u, 0, 0})},
                    {"at", {{"time", -L}, {"position", {0, 0, -L}}}}}}}});
        OffscreenRenderer offscreen = renderer(world, one_view(Planar{2.0}, {600, 600}));
        const Numbers numbers(offscreen, shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1}));
        std::array<dvec2, 3> middle{};
        std::array<double, 3> sum{};
        double D = 0;
        for (int i = 0; i < numbers.count(); ++i)
            for (int c = 0; c < 3; ++c) {
                middle[std::size_t(c)] += numbers.light(i)[c] * numbers.centre(i);
                sum[std::size_t(c)] += numbers.light(i)[c];
                if (c == 0 && numbers.light(i)[c] > 0.9)
                    D = numbers.D(i);
            }
        const double pixel = 2 * std::tan(degree) / 600 * L; // scene units
        for (std::size_t c = 0; c < 3; ++c) {
            ASSERT_GT(sum[c], 1) << "beta " << beta << " mark " << c;
            middle[c] /= sum[c];
        }
        // This holds to first order in a / L. The second order is 3e-5 units, a hundredth of a pixel's 1.2e-3.
        EXPECT_NEAR((middle[1].x - middle[0].x) * pixel, a * std::cos(turn_deg * degree), 0.5 * pixel) << beta;
        EXPECT_NEAR((middle[2].x - middle[0].x) * pixel, a * std::sin(turn_deg * degree), 0.5 * pixel) << beta;
        EXPECT_NEAR(D, 1 / gamma, 2e-3 / gamma) << beta; // parts of the mark are not exactly at right angles
    }
}

TEST(BodiesGpuTest, TwoObserversAtOneEventSeeTheirOwnPictures)
{
    // Three viewports side by side: the ship's own, an observer at rest, and one who passes the ship. Each must equal its
    // observer's own picture.
    Layout three = one_view(Planar{60}, {600, 200});
    auto& viewports = three.outputs[0].viewports;
    viewports.assign(3, viewports[0]);
    for (int i = 0; i < 3; ++i)
        viewports[std::size_t(i)].rect = {i / 3.0, 0, 1 / 3.0, 1};
    viewports[1].observer = {true};
    const dvec3 passing(0.3, -0.4, 1.1);
    viewports[2].observer = {false, passing};
    Shot ship = shot_at({0, 0, -8}, dvec3(0.2, 0.1, -1.0), {0.1, 0, -1});
    ship.effects.on.set(Effect::doppler);
    OffscreenRenderer all = renderer(avenue().world, three);
    const Numbers numbers(all, ship);

    Shot resting = ship, past = ship;
    resting.u = dvec3(0);
    // The passing observer's velocity follows from boosts with 33 digits; so does the orientation of his axes.
    const dvec3 w = ship.ship_from_cockpit * passing;
    const quad::V4 velocity = quad::boosted(quad::of(ship.u), {quad::gamma(quad::of(w)), quad::of(w)});
    past.u = vec(velocity.x);
    const std::array<Shot, 3> shots = {ship, resting, past};
    for (int k = 0; k < 3; ++k) {
        OffscreenRenderer one = renderer(avenue().world, one_view(Planar{60}, {200, 200}));
        const Numbers alone(one, shots[std::size_t(k)]);
        long off = 0, compared = 0;
        double worst = 0;
        for (int i = 0; i < alone.count(); ++i) {
            const int there = (i / 200) * 600 + k * 200 + i % 200;
            if (k < 2) {
                // The viewports share the meter and the plan, so that pictures agree to a filter's rounding.
                worst = std::max(worst, between(numbers.camera(there), alone.camera(i)));
                off += glm::length(numbers.light(there) - alone.light(i)) > 0.02 * (0.05 + glm::length(alone.light(i)));
            } else {
                // The pixel's own direction, transformed from his cockpit to the ship to the world.
                const dvec3 in_cockpit = glm::normalize(dvec3((i % 200 + 0.5 - 100) / 100 * std::tan(30 * degree),
                    (100 - (i / 200 + 0.5)) / 100 * std::tan(30 * degree), -1));
                const auto in_ship = quad::world_from_camera(quad::of(ship.ship_from_cockpit * in_cockpit), quad::of(w));
                const auto in_world = quad::world_from_camera(in_ship.n, quad::of(ship.u));
                worst = std::max(worst, between(numbers.world(there), vec(in_world.n)));
                off += std::abs(numbers.D(there) / double(in_ship.D * in_world.D) - 1) > 1e-5;
            }
            ++compared;
        }
        EXPECT_LT(worst, 2e-6) << k; // float directions
        EXPECT_LT(double(off), 0.005 * compared) << k; // edges, where texels lie elsewhere
    }
}

} // namespace starbow::gpu_test::bodies_gpu_test
