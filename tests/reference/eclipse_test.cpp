// The light that the Moon leaves on the ground in four eclipses, by rays, beside another ephemeris and a sum over the Sun's
// disc.
#include "config/model/angles.h"
#include "config/model/one_view.h"
#include "runtime/reference/reference.h"
#include "runtime/world/ephemeris.h"
#include "runtime/world/stars.h"
#include "tests/support/files.h"
#include "tests/support/shots.h"
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace starbow::eclipse_test {
namespace {

using glm::dvec3;

/// A place on a spheroid's ground from its middle, in equatorial radii, its own axes. Geographic latitude.
dvec3 on_ground(double latitude_deg, double longitude_deg, double flattening)
{
    const double a = latitude_deg * degree, b = longitude_deg * degree, polar = std::pow(1 - flattening, 2);
    return dvec3(std::cos(a) * std::cos(b), std::cos(a) * std::sin(b), polar * std::sin(a))
        / std::sqrt(std::pow(std::cos(a), 2) + polar * std::pow(std::sin(a), 2));
}

/// The solar system, with so thin air that the ground's light is the Sun's alone.
ReferenceWorld solar_system(double moon)
{
    ReferenceWorld world = open_reference_world(testing::source_dir() / "config/scenes/solar-system.json");
    world.stars.clear();
    auto globes = std::make_shared<Globes>(*world.world.globes);
    for (Globe& globe : globes->system.globes) {
        if (globe.moon)
            globe.radius_m *= moon;
        if (globe.air)
            globe.air->scale_height_m = 10;
    }
    world.world.globes = globes;
    return world;
}

TEST(Eclipse, LeavesTheLightThatAnotherEphemerisSays)
{
    ReferenceWorld with = solar_system(1), without = solar_system(1e-6);
    const SolarSystem& system = with.world.globes->system;
    const auto earth = std::ranges::find_if(system.globes, [](const Globe& globe) { return globe.name == "Earth"; });
    const double radius = earth->radius_m / with.scene.unit_m;
    const glm::dmat3 turn = world_from_equatorial(with.scene.stars->ahead_deg);
    const Layout layout = one_view(Planar{.fov_y_deg = 1}, {3, 3});
    std::ifstream file(testing::source_dir() / "tests/world/eclipse_witness.json");
    const nlohmann::json witness = nlohmann::json::parse(file);
    ASSERT_GE(witness["eclipses"].size(), 4u);
    double worst = 0;
    for (const auto& eclipse : witness["eclipses"]) {
        const double days = eclipse["days"];
        with.scene.globes->days = without.scene.globes->days = days;
        for (const auto& row : eclipse["places"]) {
            // The world's origin is the Earth's middle then.
            const dvec3 ground
                = turn * (glm::transpose(globe_turn(*earth, days)) * on_ground(row[0], row[1], earth->flattening)) * radius;
            Shot shot = testing::shot_at(1.02 * ground, dvec3(0), -ground, turn * dvec3(0, 0, 1));
            shot.effects = {};
            const auto light = [&](const ReferenceWorld& world) {
                const Reference truth = reference(world.input(), layout, shot, 0, {.samples = 1});
                return (truth.light[0][4].g - truth.numbers[4].glare.g) / truth.exposure;
            };
            const double left = light(with) / light(without), expected = row[2];
            std::printf("%s at %+.1f %+.1f: %.4f, rays %.4f\n", eclipse["utc"].get<std::string>().c_str(),
                row[0].get<double>(), row[1].get<double>(), expected, left);
            worst = std::max(worst, std::abs(left - expected));
        }
    }
    std::printf("off by at most %.4f\n", worst);
    EXPECT_LT(worst, 0.01);
}

} // namespace
} // namespace starbow::eclipse_test
