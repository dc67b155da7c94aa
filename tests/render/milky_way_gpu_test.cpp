// The Milky Way's panorama behind everything: its places and its light, at rest and in flight, on several kinds of display,
// in worlds with one rest frame and with several, against a formula and against rays.
#include "config/model/angles.h"
#include "runtime/images/capture.h"
#include "runtime/reference/reference.h"
#include "tests/support/effects.h"
#include "tests/support/small_world.h"

namespace starbow::gpu_test::milky_way_gpu_test {
namespace {

constexpr double brightness_arcmin2 = 1000, peak_arcmin2 = 5e-4, white = brightness_arcmin2 * peak_arcmin2;
const dvec2 ahead_deg{84, -19};

/// Writes a panorama of the colours that `colour` has in each unit direction, equatorial axes; 0 to 1.
std::string panorama(const std::string& name, int height, const std::function<dvec3(const dvec3&)>& colour)
{
    std::vector<std::uint8_t> rgba;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < 2 * height; ++x) {
            const dvec3 light = colour(equatorial((x + 0.5) * 180 / height, 90 - (y + 0.5) * 180 / height));
            for (int c = 0; c < 3; ++c)
                rgba.push_back(std::uint8_t(std::lround(255 * srgb(light[c]))));
            rgba.push_back(255);
        }
    const auto file = testing::scratch(name);
    write_png(file, {2 * height, height}, rgba);
    return file.string();
}

/// The scene file of a world of one small square beneath the eye, and where `moves`, of another one that flies past behind.
std::filesystem::path sky_scene(const std::string& name, const std::string& picture, bool moves)
{
    Doc doc;
    quad(doc, {0, -50, 0}, {1e-4, 0, 0}, {0, 0, -1e-4}, unlit(doc, {0, 0, 0})); // a world has triangles
    quad(doc, {0, 3, -8}, {0.5, 0, 0}, {0, 0.5, 0}, unlit(doc, {0, 0, 0}), {{"name", "mover"}});
    testing::write_text(name + ".gltf", doc.text());
    Json scene{{"gltf", name + ".gltf"}, {"unit_m", 299792458},
        {"stars",
            {{"catalogue", testing::write_text("dark_star.txt", "0 0 3000 65 -\n").string()},
                {"brightness_arcmin2", brightness_arcmin2}, {"ahead_deg", {ahead_deg.x, ahead_deg.y}},
                {"milky_way", {{"panorama", picture}, {"peak_arcmin2", peak_arcmin2}}}}}};
    if (moves)
        scene["bodies"]
            = {{{"name", "mover"}, {"nodes", {"mover"}}, {"velocity", {{"direction", {1, 0, 0}}, {"beta", 0.5}}}}};
    return testing::write_text(name + ".json", scene.dump());
}

GpuWorld open(const std::filesystem::path& scene, std::optional<SpectralLevel> level = {})
{
    LoadedScene loaded = load_scene(scene);
    return upload(device(), pipelines(), std::move(loaded.world), loaded.scene, loaded.stars, level);
}

/// True where the pixel and those around it show nothing but the sky.
bool is_sky(const Numbers& numbers, int i)
{
    const int x = i % numbers.size.x, y = i / numbers.size.x;
    for (int j = std::max(y - 2, 0); j <= std::min(y + 2, numbers.size.y - 1); ++j)
        for (int k = std::max(x - 2, 0); k <= std::min(x + 2, numbers.size.x - 1); ++k)
            if (const int at = j * numbers.size.x + k; !numbers.shown(at) || !std::isinf(numbers.depth(at)))
                return false;
    return true;
}

/// A spot's light is where its right ascension and declination say, also across the panorama's edge and beside a pole.
TEST(MilkyWay, ASpotIsInItsPlaceOnEveryDisplay)
{
    const std::vector<Projection> displays{Planar{100}, Fisheye{180, 0}, Equirectangular{}};
    for (const dvec2 place : {dvec2(83, -20), dvec2(0.2, 5), dvec2(250, 88)}) {
        const dvec3 middle = equatorial(place.x, place.y);
        constexpr double width = 12 * degree;
        const auto strength = [&](const dvec3& n) { return std::exp(-0.5 * std::pow(between(n, middle) / width, 2)); };
        const std::string picture
            = panorama("spot.png", 256, [&](const dvec3& n) { return strength(n) * dvec3(1, 0.5, 0.2); });
        const dmat3 equatorial_from_world = glm::transpose(world_from_equatorial(ahead_deg));
        for (const bool moves : {false, true}) {
            const GpuWorld world = open(sky_scene("spot", picture, moves));
            for (const Projection& display : displays)
                for (const double beta : {0.0, 0.8}) {
                    const ivec2 size = std::holds_alternative<Equirectangular>(display) ? ivec2(480, 240) : ivec2(240, 240);
                    OffscreenRenderer live = renderer(world, one_view(display, size));
                    Shot shot = shot_at({0, 0, 0}, dvec3(0, 0, -u_of_beta(beta)));
                    shot.effects = effects_of(true, false, false);
                    // The spot stands in the middle of the picture.
                    const dvec3 there = glm::transpose(equatorial_from_world) * middle;
                    const dvec3 aside = std::abs(there.y) > 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
                    const dvec3 right = glm::normalize(glm::cross(there, aside));
                    shot.ship_from_cockpit = dmat3(right, glm::cross(right, there), -there);
                    const Numbers numbers(live, shot);
                    double worst = 0, most = 0;
                    for (int i = 0; i < numbers.count(); ++i)
                        if (is_sky(numbers, i)) {
                            const double expected = white * strength(equatorial_from_world * numbers.world(i));
                            worst = std::max(worst, glm::length(numbers.light(i) - expected * dvec3(1, 0.5, 0.2)));
                            most = std::max(most, expected);
                        }
                    // Bytes have steps of 0.9 % at white. In flight a pixel ahead is spread over 2.3 degrees, which
                    // takes 1 % of the spot's top; the greatest slope is 0.05 of white per degree.
                    EXPECT_LT(worst, 0.02 * white)
                        << "display " << display.index() << ", " << place.x << ", moves " << moves << ", beta " << beta;
                    if (beta == 0) {
                        EXPECT_GT(most, 0.95 * white);
                    }
                }
        }
    }
}

/// Colours that change smoothly over the whole sphere.
dvec3 waves(const dvec3& n)
{
    return {0.5 + 0.4 * std::sin(9 * n.x + 2 * n.y), 0.5 + 0.4 * std::sin(7 * n.y - 5 * n.z + 1),
        0.5 + 0.4 * std::sin(8 * n.z + 3 * n.x + 2)};
}

TEST(MilkyWay, LiveLightIsTheRaysAtAnySpeedAndLevel)
{
    const std::string picture = panorama("waves.png", 256, waves);
    const Layout layout = one_view(Planar{.fov_y_deg = 80}, {160, 120});
    for (const bool moves : {false, true}) {
        const auto file = sky_scene("waves", picture, moves);
        const ReferenceWorld rays = open_reference_world(file);
        for (const SpectralLevel level : {SpectralLevel::colours, SpectralLevel::fine}) {
            const GpuWorld world = open(file, level);
            for (const double beta : {0.0, 0.5, 0.97}) {
                Shot shot = shot_at({0, 0, 0}, dvec3(0, 0, -u_of_beta(beta)));
                shot.effects = {};
                OffscreenRenderer live = renderer(world, layout);
                const Numbers numbers(live, shot);
                const Reference truth = reference(rays.input(), layout, shot, 0, {.samples = 4});
                std::vector<double> errors;
                for (int i = 0; i < numbers.count(); ++i)
                    if (is_sky(numbers, i)) {
                        const dvec3 ray = truth.light[0][std::size_t(i)] / truth.exposure;
                        errors.push_back(glm::length(numbers.light(i) - ray) / std::max(glm::length(ray), 1e-6));
                    }
                ASSERT_GT(errors.size(), 15000u);
                std::sort(errors.begin(), errors.end());
                std::printf("moves %d, %zu coefficients, beta %.2f: median %.5f, 99 %% %.5f\n", moves,
                    std::size_t(world.spectra.basis.reflected), beta, errors[errors.size() / 2],
                    errors[errors.size() * 99 / 100]);
                // fp16 and the response's steps are 0.1 %; the waves change by 2 % over the widest pixel's four rays.
                EXPECT_LT(errors[errors.size() / 2], 0.004) << moves << ", " << beta;
                EXPECT_LT(errors[errors.size() * 99 / 100], 0.02) << moves << ", " << beta;
            }
        }
    }
}

} // namespace
} // namespace starbow::gpu_test::milky_way_gpu_test
