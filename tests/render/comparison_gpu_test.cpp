// The views for comparison: Galilean aberration, and the present of the ship's frame without light delay.
#include "config/model/angles.h"
#include "runtime/world/clock.h"
#include "runtime/world/instances.h"
#include "runtime/world/observer.h"
#include "shaders/physics/physics.h"
#include "tests/support/quad.h"
#include "tests/support/small_world.h"

namespace starbow::gpu_test::comparison_gpu_test {
namespace {

/// The mean direction of one colour's light.
dvec3 seen_at(const Numbers& numbers, int channel)
{
    dvec3 sum(0);
    for (int i = 0; i < numbers.count(); ++i)
        sum += numbers.camera(i) * std::max(0.0, numbers.light(i)[channel]);
    EXPECT_GT(glm::length(sum), 1);
    return glm::normalize(sum);
}

const std::array<dvec3, 3> places = {dvec3(2, 1, -10), dvec3(-6, 0, -7), dvec3(1, -2, -7)};

/// A world with a small quad of its own colour at each place.
GpuWorld three(const Json& scene)
{
    Doc doc;
    for (int i = 0; i < 3; ++i) {
        dvec3 colour(0);
        colour[i] = 1;
        const int material = unlit(doc, colour);
        doc.json["materials"][std::size_t(material)]["doubleSided"] = true;
        const dvec3 to = glm::normalize(places[std::size_t(i)]), right = glm::normalize(glm::cross(to, dvec3(0, 1, 0)));
        quad(doc, places[std::size_t(i)], right * 0.08, glm::cross(right, to) * 0.08, material, {{"name", "quads"}});
    }
    return open_world("three", doc, scene);
}

Shot compared(const dvec3& u, Comparison comparison)
{
    Shot shot = shot_at({0, 0, 0}, u, {0, 0, -1});
    shot.effects.comparison = comparison;
    return shot;
}

} // namespace

TEST(ComparisonTest, GalileanFormulasAddVelocities)
{
    for (double beta : {1e-6, 0.3, 0.9, 0.9999})
        for (double theta = 0; theta <= 180; theta += 7.5) {
            const double u = beta / std::sqrt((1 - beta) * (1 + beta)), E = physics::exp_rapidity(u);
            const dvec3 world(std::sin(theta * degree), 0, std::cos(theta * degree));
            // The light's velocity is -world. On board the ship's velocity is subtracted, and the light comes from the
            // opposite direction.
            const dvec3 on_board = -(-world - dvec3(0, 0, beta));
            const auto camera = physics::galilean_camera_from_world(world, E, 1 / E);
            EXPECT_LT(between(camera.n, on_board), 1e-14);
            const auto back = physics::galilean_world_from_camera(camera.n, E, 1 / E);
            // Near the speed of light, the angles behind are small for the camera and large in the world.
            EXPECT_LT(between(back.n, world), 2e-15 / (1 - beta));
            EXPECT_NEAR(back.D, 1 + beta * world.z, 2e-15 / (1 - beta));
            if (theta == 0 || theta == 180)
                continue;
            const double step = 1e-6;
            const auto turned
                = physics::galilean_world_from_camera({camera.n.x * std::cos(step) + camera.n.z * std::sin(step), 0,
                                                          camera.n.z * std::cos(step) - camera.n.x * std::sin(step)},
                    E, 1 / E);
            const dvec2 stretch = physics::galilean_stretch(camera.n, E, 1 / E);
            EXPECT_NEAR(between(turned.n, back.n) / step / stretch.x, 1, 1e-4 / (1 - beta)) << beta << " " << theta;
            EXPECT_NEAR(world.x / camera.n.x / stretch.y, 1, 1e-9 / (1 - beta));
        }
}

TEST(ComparisonTest, GalileanPictureAddsVelocities)
{
    const dvec3 u = glm::normalize(dvec3(0.3, 0.1, -1)) * u_of_beta(0.8);
    const GpuWorld world = three({});
    OffscreenRenderer offscreen = renderer(world, one_view(Planar{100}, {900, 600}));
    const Numbers numbers(offscreen, compared(u, Comparison::galilean));
    for (int i = 0; i < 3; ++i) {
        const dvec3 expected = glm::normalize(places[std::size_t(i)]) + 0.8 * glm::normalize(u);
        EXPECT_LT(between(seen_at(numbers, i), expected), 0.5 * 100 * degree / 600) << i;
    }
}

TEST(ComparisonTest, WithoutLightDelayBodiesAreContractedAlongTheMotion)
{
    // Objects at rest before a moving ship are contracted along the motion. A body that moves with the ship is not. A body
    // that moves past a resting ship is contracted too.
    const dvec3 way = glm::normalize(dvec3(0.4, 0.2, -1)), u = way * u_of_beta(0.9);
    const double gamma = std::sqrt(1 + glm::dot(u, u));
    auto contracted = [&](const dvec3& x) { return x - way * glm::dot(way, x) * (1 - 1 / gamma); };
    const Json riding
        = {{{"name", "all"}, {"nodes", {"quads"}}, {"velocity", {{"direction", {way.x, way.y, way.z}}, {"beta", 0.9}}}}};
    for (int kind = 0; kind < 3; ++kind) {
        const GpuWorld world = three(kind == 0 ? Json::object() : Json{{"bodies", riding}});
        OffscreenRenderer offscreen = renderer(world, one_view(Planar{100}, {900, 600}));
        const Numbers numbers(offscreen, compared(kind == 2 ? dvec3(0) : u, Comparison::no_light_delay));
        for (int i = 0; i < 3; ++i) {
            const dvec3& place = places[std::size_t(i)];
            EXPECT_LT(between(seen_at(numbers, i), kind == 1 ? place : contracted(place)), 0.5 * 100 * degree / 600)
                << "kind " << kind << " quad " << i;
        }
    }
}

TEST(ComparisonTest, WithoutLightDelayClocksShowTheShipsPresent)
{
    World world = load_world(testing::source_dir() / "scenes/clocks/clocks.glb");
    sort_instances(world);
    Shot shot = compared({u_of_beta(0.5), 0, 0}, Comparison::no_light_delay);
    shot.time = 100, shot.position = {1, 0, 31};
    const Observer who = observer_of(world, shot, {});
    const RestFrameView& rest_frame = who.rest_frames[0];
    EXPECT_EQ(who.E, 1);
    EXPECT_NEAR(rest_frame.contraction, std::sqrt(0.75), 1e-15);
    const auto entries = time_entries(world,
        {0, shot.position, shot.time, rest_frame.motion_from_frame, rest_frame.now, rest_frame.contraction, rest_frame.beta},
        1);
    ASSERT_EQ(entries.size(), 5u);
    // The times are simultaneous on board: each clock is five light-seconds further ahead, and so 2.5 s later in the world.
    for (int i = 0; i < 5; ++i)
        EXPECT_NEAR(entries[std::size_t(i)].turns.y * 10, std::fmod(100 + 0.5 * (5 * i - 10 - 1), 10), 1e-5) << i;
}

} // namespace starbow::gpu_test::comparison_gpu_test
