// docs/lab.md is worked through: every number in its tables is measured on the real scenes with the instruments, aimed to
// 0.1 degrees as by hand. The theoretical values come from formulas of this file, not from shaders/physics.
#include "config/model/angles.h"
#include "runtime/exhibit/still_measurement.h"
#include "runtime/flight/flight.h"
#include "runtime/reference/reference.h"
#include "tests/support/gpu_environment.h"
#include "tests/support/lab_theory.h"
#include "tests/support/quad.h"
#include <functional>
#include <map>

namespace starbow::gpu_test::lab_gpu_test {
namespace {

using Read = std::function<std::optional<double>(const StillMeasurement&)>;
const std::map<std::string, Read> readings = {
    {"○–◇ / deg", [](const StillMeasurement& s) { return s.points[0].pair->angle_rad / degree; }},
    {"θ′ / deg", [](const StillMeasurement& s) { return *s.points[1].aim.from_motion_rad / degree; }},
    {"θ / deg", [](const StillMeasurement& s) { return *s.points[1].aim.from_motion_world_rad / degree; }},
    {"D", [](const StillMeasurement& s) { return s.points[1].aim.ray.D; }},
    {"D = 1 / deg", [](const StillMeasurement& s) { return *unshifted_angle(s.points[1].observer) / degree; }},
    {"550 nm → / nm", [](const StillMeasurement& s) { return s.points[1].aim.seen_nm; }},
    {"◇ minus ○ / s", [](const StillMeasurement& s) { return s.points[0].pair->clocks_s; }},
    {"clock / s", [](const StillMeasurement& s) { return s.points[1].aim.clock_s; }},
    {"distance / light-s", [](const StillMeasurement& s) { return s.points[1].aim.distance_s; }},
    {"distance in the ship / light-s", [](const StillMeasurement& s) { return s.points[1].aim.ship_distance_s; }},
    {"light left / s", [](const StillMeasurement& s) { return s.points[1].aim.emitted_s; }},
    {"length / light-s", [](const StillMeasurement& s) { return s.points[0].pair->apparent_s; }},
    {"contracted / light-s", [](const StillMeasurement& s) { return s.points[0].pair->contracted_s; }},
    {"light / light without the key", [](const StillMeasurement& s) { return s.points[1].aim.light; }},
};

/// Moves each point as an unsteady hand does.
std::vector<Point> unsteady(std::vector<Point> points, double right_deg, double up_deg)
{
    for (Point& point : points) {
        glm::dvec3& n = std::get<dvec3>(point);
        n = glm::normalize(
            n + right_deg * degree * glm::normalize(glm::cross(n, dvec3(0, 1, 0))) + dvec3(0, up_deg * degree, 0));
    }
    return points;
}

TEST(Lab, EveryMeasurementGivesTheTheorysValue)
{
    const std::map<std::string, double> expected = testing::lab_theory();
    std::map<std::string, std::unique_ptr<RenderContext>> contexts;
    const Layout desk = one_view(Planar{60}, {400, 300});
    std::map<std::string, std::unique_ptr<OffscreenRenderer>> renderers;
    int measured = 0;
    for (const testing::DocumentRow& row : testing::lab_rows_of_the_document()) {
        if (row.no()[0] == 'S')
            continue;
        SCOPED_TRACE(row.no());
        ASSERT_EQ(row.cells.size(), 7u);
        ASSERT_TRUE(expected.contains(row.no()));
        ASSERT_TRUE(readings.contains(row.cells[4])) << row.cells[4];
        const double documented = std::stod(row.cells[5]), error = std::stod(row.cells[6]);
        // The document's rounding is within its error.
        EXPECT_NEAR(documented, expected.at(row.no()), 0.1 * error + 5e-4 * std::abs(documented));
        const std::filesystem::path file = testing::source_dir() / "config/shots" / (row.cells[1] + ".json");
        const Shot shot = load_shot(file);
        if (!renderers[shot.scene]) {
            const SceneFile scene = load_scene_file(testing::source_dir() / "config/scenes" / (shot.scene + ".json"));
            contexts[shot.scene]
                = std::make_unique<RenderContext>(testing::source_dir() / "config/scenes" / (shot.scene + ".json"),
                    Device::Options{.validation = true, .name = device_options(false).name});
            RenderContext& context = *contexts[shot.scene];
            renderers[shot.scene] = std::make_unique<OffscreenRenderer>(
                context.device, context.pipelines, context.world, desk, default_quality(context.device, false), false);
        }
        OffscreenRenderer& renderer = *renderers[shot.scene];
        const GpuWorld& world = contexts[shot.scene]->world;
        Shot pressed = shot;
        for (char key : row.cells[2]) {
            pressed.effects.on.set(Effect::aberration, pressed.effects[Effect::aberration] != (key == '1'));
            pressed.effects.on.set(Effect::doppler, pressed.effects[Effect::doppler] != (key == '2'));
            pressed.effects.on.set(Effect::headlight, pressed.effects[Effect::headlight] != (key == '3'));
        }
        const std::vector<Point> points = parse_points(row.cells[3], desk);
        for (const auto& [right, up] : {std::pair(0.0, 0.0), std::pair(0.1, 0.06), std::pair(-0.08, -0.1)}) {
            const std::vector<Point> aimed = unsteady(points, right, up);
            const StillMeasurement measurement
                = measure_still(renderer, world, pressed, aimed, "off", "none", testing::words());
            const std::optional<double> read = readings.at(row.cells[4])(measurement);
            ASSERT_TRUE(read);
            double value = *read;
            if (row.no()[0] == 'H')
                value /= *readings.at(row.cells[4])(
                    measure_still(renderer, world, shot, aimed, "off", "none", testing::words()));
            EXPECT_NEAR(value, documented, error) << "aimed off by " << right << ", " << up;
        }
        ++measured;
    }
    EXPECT_EQ(measured, int(expected.size()) - 3);
    for (const auto& [name, context] : contexts)
        if (context)
            GpuEnvironment::expect_no_complaints(context->device);
    renderers.clear();
}

// A picture that compares, or leaves aberration out, past a moving train: what is read at a pixel is the D and the distance
// of the ray there, which is traced without the instruments and the cube map.
TEST(Lab, AComparisonIsReadAsTheRaysShowIt)
{
    const std::filesystem::path folder = testing::source_dir() / "config", scene = folder / "scenes/train.json";
    const ReferenceWorld rays = open_reference_world(scene);
    RenderContext context(scene, Device::Options{.validation = true, .name = device_options(false).name});
    const ivec2 size(96, 72);
    const Layout desk = one_view(Planar{60}, size);
    OffscreenRenderer renderer(
        context.device, context.pipelines, context.world, desk, default_quality(context.device, false), false);
    std::vector<Point> points;
    for (int y = 4; y < size.y - 1; y += 5)
        for (int x = 5; x < size.x - 1; x += 6)
            points.emplace_back(glm::dvec2(x + 0.5, y + 0.5));
    const std::size_t moving = 1;
    for (const auto& [comparison, aberration] :
        {std::pair(Comparison::galilean, true), {Comparison::no_light_delay, true}, {Comparison::none, false}}) {
        if (comparison == Comparison::none && !testing::all_cases())
            continue;
        SCOPED_TRACE(comparison_names[std::size_t(comparison)]);
        Shot shot = load_shot(folder / "shots/train-tunnel.json");
        shot.u = {0.2, 0.05, -0.3};
        shot.effects.comparison = comparison, shot.effects.on.set(Effect::aberration, aberration);
        const Reference truth = reference(rays.input(), desk, shot, 0, {.samples = 1});
        const StillMeasurement measurement
            = measure_still(renderer, context.world, shot, points, "off", "none", testing::words());
        EXPECT_EQ(measurement.lines.front().starts_with("comparison: "), comparison != Comparison::none);
        std::array<int, 2> read{}; // of things at rest, and of moving ones
        int off = 0, off_D = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const ivec2 at(std::get<glm::dvec2>(points[i]));
            const auto numbers = [&](ivec2 p) { return truth.numbers[std::size_t(p.y * size.x + p.x)]; };
            const Reference::Numbers ray = numbers(at);
            // The instruments read the nearest texel, which may be a neighbour's across an edge.
            double nearest = ray.distance, farthest = ray.distance;
            std::array<double, 3> least_D{ray.D, ray.D, ray.D}, most_D = least_D; // of pixels so far away
            for (int k = 0; k < 25; ++k) {
                const ivec2 off_by(k % 5 - 2, k / 5 - 2);
                const Reference::Numbers beside = numbers(at + off_by);
                const int reach = std::max(std::abs(off_by.x), std::abs(off_by.y));
                if (reach <= 1)
                    nearest = std::min(nearest, beside.distance), farthest = std::max(farthest, beside.distance);
                for (std::size_t within = std::size_t(reach); within < 3; ++within)
                    least_D[within] = std::min(least_D[within], beside.D),
                    most_D[within] = std::max(most_D[within], beside.D);
            }
            const SpotReading& aim = measurement.points[i + 1].aim;
            if (!aim.distance_s)
                continue;
            EXPECT_GT(aim.ray.D, least_D[2] * (1 - 1e-4)) << at.x << " " << at.y;
            EXPECT_LT(aim.ray.D, most_D[2] * (1 + 1e-4)) << at.x << " " << at.y;
            off_D += !(aim.ray.D > least_D[1] * (1 - 1e-4) && aim.ray.D < most_D[1] * (1 + 1e-4));
            EXPECT_LT(between(aim.ray.ship, ray.camera), 1e-6);
            // A thing at rest: what is read in the world's own frame has the world's D, the same as its pixel's sky.
            const MeasuringObserver& who = measurement.points[i + 1].observer;
            const bool rests = std::abs(ray_from_ship(who, aim.ray.ship).D / aim.ray.D - 1) < 1e-6;
            ++read[rests && comparison != Comparison::no_light_delay ? 0 : moving];
            // With velocities that simply add, the depth of a moving thing is its order among the others, and no distance.
            if (comparison != Comparison::galilean || rests) {
                off += !(*aim.distance_s > nearest * (1 - 5e-3) && *aim.distance_s < farthest * (1 + 5e-3));
            }
        }
        EXPECT_GT(read[moving], 5);
        EXPECT_LE(off_D, 1); // of two hundred: the train's edge, two pixels away
        EXPECT_LE(off, 4); // of a hundred: things that are narrower than a pixel
        if (comparison != Comparison::no_light_delay) {
            EXPECT_GT(read[0], 5);
        }
    }
    GpuEnvironment::expect_no_complaints(context.device);
}

// With the engine on: the real flight with its controls held, and the document's marks.
TEST(Lab, UnderThrustTheClocksFirstSeemToMoveBackwards)
{
    const std::filesystem::path folder = testing::source_dir() / "config";
    const Shot start = load_shot(folder / "shots/clocks-rest.json");
    const SceneFile scene = load_scene_file(folder / "scenes/clocks.json");
    RenderContext context(
        folder / "scenes/clocks.json", Device::Options{.validation = true, .name = device_options(false).name});
    const Layout desk = one_view(Planar{60}, {400, 300});
    OffscreenRenderer renderer(
        context.device, context.pipelines, context.world, desk, default_quality(context.device, false), false);
    const StillMeasurement first = measure_still(
        renderer, context.world, start, parse_points("0deg,0deg; 9.2deg,0deg", desk), "off", "none", testing::words());
    ASSERT_TRUE(first.points[0].pair);
    const World& world = context.world.world;
    Flying rules;
    rules.mode = FlightMode::newtonian;
    Flight flight = flight_at(start, rules);
    const double at_first = first.points[0].pair->angle_rad;
    double smallest = 1, smallest_at = 0, nearest_to_4 = 1, angle_at_4 = 0;
    Spot middle{.at = {0, 0, 0}}, right{.at = {5, 0, 0}};
    Controls faster;
    faster.throttle_rate = 1;
    for (int i = 0; i < 80; ++i) {
        flight = step(flight, faster, 100'000'000, rules, scene.seconds_per_time_unit(), start);
        const MeasuringObserver observer = measuring_observer_of(shot_of(flight, "clocks"));
        if (observer.place.z < 0.5)
            break;
        const double part = read_pair(observer, middle, right, world, 1).angle_rad / at_first;
        const double e = std::exp(std::asinh(glm::length(observer.u)));
        if (part < smallest)
            smallest = part, smallest_at = e;
        if (std::abs(std::log(e / 4)) < std::abs(std::log(nearest_to_4 / 4)))
            nearest_to_4 = e, angle_at_4 = part * at_first / degree;
    }
    std::printf("  smallest %.4f at %.3f, at %.3f %.4f degrees\n", smallest, smallest_at, nearest_to_4, angle_at_4);
    const std::map<std::string, double> measured = {{"S1", smallest_at}, {"S2", smallest}, {"S3", angle_at_4}};
    const std::map<std::string, double> expected = testing::lab_theory();
    for (const testing::DocumentRow& row : testing::lab_rows_of_the_document())
        if (row.no()[0] == 'S') {
            const double documented = std::stod(row.cells[3]), error = std::stod(row.cells[4]);
            EXPECT_NEAR(documented, expected.at(row.no()), 0.1 * error + 5e-4 * documented) << row.no();
            EXPECT_NEAR(measured.at(row.no()), documented, error) << row.no();
        }
    GpuEnvironment::expect_no_complaints(context.device);
}

} // namespace
} // namespace starbow::gpu_test::lab_gpu_test
