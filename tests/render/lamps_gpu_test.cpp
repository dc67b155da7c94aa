// Every kind of light on a surface, alone and together, in worlds where nothing moves and where a body does, at every
// spectral level, compared with rays, which know neither the shader nor its coefficients.
#include "runtime/reference/reference.h"
#include "tests/support/effects.h"
#include "tests/support/small_world.h"
#include <cstdio>

namespace starbow::gpu_test::lamps_gpu_test {
namespace {

struct Case {
    std::string name;
    Json lights;
};

Json point(const Json& spectrum)
{
    Json light = {{"type", "point"}, {"position", {0.3, 0.5, 0}}, {"distance", 2.5}, {"radiance", {1, 1, 1}}};
    light.update(spectrum);
    return light;
}
Json directional(const Json& spectrum)
{
    Json light = {{"type", "directional"}, {"towards", {-0.36, 0.48, 0.8}}, {"radiance", {0.8, 0.8, 0.8}}};
    light.update(spectrum);
    return light;
}

const Json sunlight = Json::object(), warm = {{"temperature_K", 2856}}, sun_like = {{"temperature_K", 5772}},
           line = {{"line_nm", 589}};
/// It is given over all wavelengths that the shots below shift into the visible.
const Json table = {{"spectrum", {{250, 0.1}, {380, 0.3}, {450, 1}, {550, 0.4}, {650, 1.2}, {1000, 0.8}, {3000, 0.1}}}};

std::vector<Case> all_lights()
{
    std::vector<Case> cases = {{"no light", Json::array()}};
    for (const auto& [name, spectrum] :
        {std::pair{"sunlight", sunlight}, {"2856 K", warm}, {"5772 K", sun_like}, {"line", line}, {"table", table}}) {
        cases.push_back({std::string("point, ") + name, Json::array({point(spectrum)})});
        cases.push_back({std::string("directional, ") + name, Json::array({directional(spectrum)})});
    }
    cases.push_back({"two lamps of two kinds", Json::array({point(warm), directional(table)})});
    cases.push_back({"a lamp and sunlight", Json::array({directional(sunlight), point(warm)})});
    cases.push_back(
        {"all", Json::array({point(warm), directional(sunlight), point(table), directional(line), point(sunlight)})});
    return cases;
}

/// Three plates in three greys and colours, ahead of the eye; a body, if any, moves far behind it.
Doc plates(bool body)
{
    Doc doc;
    const dvec3 colours[] = {{0.5, 0.5, 0.5}, {0.6, 0.25, 0.1}, {0.1, 0.3, 0.55}};
    for (int i = 0; i < 3; ++i)
        quad(doc, {1.1 * (i - 1), 0, -3}, {0.5, 0, 0}, {0, 0.5, 0},
            doc.put("materials",
                {{"pbrMetallicRoughness",
                    {{"metallicFactor", 0}, {"baseColorFactor", {colours[i].r, colours[i].g, colours[i].b, 1}}}}}));
    if (body)
        quad(doc, {0, 0, 100}, {1, 0, 0}, {0, 1, 0}, unlit(doc, {1, 1, 1}), {{"name", "body"}});
    return doc;
}

/// The sums of light over the pixels well inside a plate, live and by rays.
struct PlateLight {
    dvec3 live{0}, rays{0};
    int pixels = 0;
};
PlateLight light_of_plate(const Numbers& numbers, const Reference& truth, int plate)
{
    PlateLight light;
    for (int i = 0; i < numbers.count(); ++i) {
        const Reference::Numbers& at = truth.numbers[std::size_t(i)];
        const dvec3 place = at.world * at.distance;
        if (!std::isfinite(at.distance) || std::abs(place.x - 1.1 * (plate - 1)) > 0.4 || std::abs(place.y) > 0.4)
            continue;
        light.live += numbers.light(i), light.rays += truth.light[0][std::size_t(i)] / truth.exposure;
        ++light.pixels;
    }
    return light;
}

} // namespace

TEST(Lamps, EveryKindOfLightEqualsRays)
{
    constexpr double dark = 1e-6; // rays may find no light at all
    const Layout layout = one_view(Planar{.fov_y_deg = 40}, {96, 32});
    const std::vector<SpectralLevel> levels = {SpectralLevel::fine, SpectralLevel::middle, SpectralLevel::colours};
    double worst = 0;
    int compared = 0;
    struct Flight {
        double gamma, ambient;
        bool body, doppler = true;
    };
    // Without the Doppler effect light is stored as its colour.
    for (const auto& [gamma, ambient, body, doppler] :
        {Flight{1, 0, false}, {1.5, 0.02, false}, {1.5, 0.02, true}, {1.5, 0.02, false, false}, {1.5, 0.02, true, false}})
        for (const Case& one : all_lights()) {
            if (body && one.name == "point, line")
                continue; // refused: it passes a body at wavelengths that change
            Json scene = {{"ambient", {ambient, ambient, ambient}}, {"lights", one.lights}};
            if (body)
                scene["bodies"]
                    = {{{"name", "body"}, {"nodes", {"body"}}, {"velocity", {{"direction", {1, 0, 0}}, {"gamma", 1.5}}}}};
            GpuWorld world = open_world("lamps", plates(body), scene);
            const ReferenceWorld rays = open_reference_world(starbow::testing::scratch("lamps.json"));
            const SpectralLevel needed = world.spectra.level;
            Shot shot = shot_at({0, 0, 0}, {0, 0, -u_of_gamma(gamma)});
            shot.effects = effects_of(true, doppler, false);
            const Reference truth = reference(rays.input(), layout, shot, 0, {.samples = 4});
            // Every level at rest; elsewhere the one that the scene chooses.
            for (SpectralLevel level : gamma == 1 ? levels : std::vector{needed}) {
                if (level != world.spectra.level)
                    put_spectra(device(), world, level);
                OffscreenRenderer live = renderer(world, layout);
                const Numbers numbers(live, shot);
                for (int plate = 0; plate < 3; ++plate) {
                    // Coloured plates need the level that the scene chooses; coarser ones are held to the grey at rest.
                    if (plate > 0 && level < needed)
                        continue;
                    const PlateLight light = light_of_plate(numbers, truth, plate);
                    compared += light.pixels;
                    const double off = glm::length(light.live - light.rays) / std::max(glm::length(light.rays), dark);
                    worst = std::max(worst, off);
                    EXPECT_LT(off, 0.02) << one.name << (body ? ", with a body" : "") << (doppler ? "" : ", without Doppler")
                                         << ", ambient " << ambient << ", gamma " << gamma << ", level " << int(level)
                                         << ", plate " << plate << ": live " << glm::length(light.live) << ", rays "
                                         << glm::length(light.rays);
                }
            }
        }
    std::printf("  %d pixels, at most %.2f %% off\n", compared, 100 * worst);
    EXPECT_GT(compared, 10000);
}

TEST(Lamps, ALampThatPassesEqualsRays)
{
    // A lamp passes three plates at 0.6 c; the eye is at rest beside them. Its light arrives at D from 2 to 1/2.
    const Layout layout = one_view(Planar{.fov_y_deg = 40}, {96, 32});
    double worst = 0;
    int compared = 0;
    for (double kelvin : {2856.0, 5772.0})
        for (double along : {-4.0, -0.5, 0.4, 3.0}) {
            if (!starbow::testing::all_cases() && (along == -0.5 || along == 3.0))
                continue;
            const Json scene = {{"ambient", {0, 0, 0}},
                {"lights",
                    {{{"type", "point"}, {"body", "body"}, {"position", {along, 0.4, -1.5}}, {"distance", 2.5},
                        {"radiance", {1, 1, 1}}, {"temperature_K", kelvin}}}},
                {"bodies",
                    {{{"name", "body"}, {"nodes", {"body"}}, {"velocity", {{"direction", {1, 0, 0}}, {"gamma", 1.25}}}}}}};
            GpuWorld world = open_world("passing", plates(true), scene);
            const ReferenceWorld rays = open_reference_world(starbow::testing::scratch("passing.json"));
            Shot shot = shot_at({0, 0, 0}, {0, 0, 0});
            shot.effects = effects_of(true, true, false);
            const Reference truth = reference(rays.input(), layout, shot, 0, {.samples = 4});
            OffscreenRenderer live = renderer(world, layout);
            const Numbers numbers(live, shot);
            for (int plate = 0; plate < 3; ++plate) {
                const PlateLight light = light_of_plate(numbers, truth, plate);
                compared += light.pixels;
                const double off = glm::length(light.live - light.rays) / glm::length(light.rays);
                worst = std::max(worst, off);
                EXPECT_LT(off, 0.03) << kelvin << " K at " << along << ", plate " << plate << ": live "
                                     << glm::length(light.live) << ", rays " << glm::length(light.rays);
            }
        }
    std::printf("  %d pixels, at most %.2f %% off\n", compared, 100 * worst);
    EXPECT_GT(compared, starbow::testing::all_cases() ? 3000 : 1500);
}

namespace {

/// A lamp 2 above a floor, straight down: dark beyond 40 degrees, whole within 15.
Json lamp_with_cone(double aside)
{
    return {{"type", "point"}, {"position", {aside, 2, 0}}, {"distance", 2}, {"radiance", {1, 1, 1}},
        {"cone", {{"axis", {0, -2, 0}}, {"inner_deg", 15}, {"outer_deg", 40}}}};
}

Doc floor_alone(bool body, bool glossy = false)
{
    Doc doc;
    quad(doc, {0, 0, 0}, {6, 0, 0}, {0, 0, -6},
        doc.put("materials",
            {{"pbrMetallicRoughness",
                {{"metallicFactor", 0}, {"roughnessFactor", glossy ? 0.4 : 1.0}, {"baseColorFactor", {1, 1, 1, 1}}}}}));
    if (body)
        quad(doc, {0, -50, 0}, {1, 0, 0}, {0, 0, -1}, unlit(doc, {1, 1, 1}), {{"name", "body"}});
    return doc;
}

} // namespace

TEST(Cones, FallFromTheInnerToTheOuterCone)
{
    // From above, so that a pixel's direction is a place on the floor.
    const GpuWorld world = open_world("cone", floor_alone(false), {{"lights", {lamp_with_cone(0)}}});
    const Shot shot = shot_at({0, 5, 0}, {0, 0, 0}, {0, -1, 0}, {0, 0, -1});
    OffscreenRenderer live = renderer(world, one_view(Planar{.fov_y_deg = 60}, {301, 301}));
    const Numbers numbers(live, shot);
    const double outer = std::cos(40 * degree), inner = std::cos(15 * degree);
    int edge = 0;
    for (int x = 0; x < 301; ++x) {
        const int pixel = 150 * 301 + x;
        const dvec3 n = numbers.camera(pixel);
        const double aside = 5 * std::tan(std::acos(std::min(-n.y, 1.0))), cosine = 2 / std::hypot(2, aside);
        const double part = std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
        const double right = part * part * std::pow(cosine, 3); // at distance 2 over the cosine, aslant
        EXPECT_NEAR(double(numbers.light(pixel).g), right, 0.01 * right + 0.004) << aside;
        edge += part > 0.1 && part < 0.9;
    }
    EXPECT_GT(edge, 40);
}

TEST(Cones, EqualRaysAtRestAndPassing)
{
    // The lamp rests, or passes at 0.8 c with its cone, whose light leans forward; the eye rests above, or flies.
    const Layout layout = one_view(Planar{.fov_y_deg = 70}, {120, 120});
    for (const bool glossy : {false, true})
        for (const bool passes : {false, true})
            for (const double flies : {0.0, 0.3}) {
                Json lamp = lamp_with_cone(-1);
                Json scene = {{"ambient", {0.01, 0.01, 0.01}}, {"shadows", false}};
                if (passes) {
                    lamp["body"] = "body", lamp["position"] = {6, 2, 0};
                    scene["bodies"] = {
                        {{"name", "body"}, {"nodes", {"body"}}, {"velocity", {{"direction", {1, 0, 0.2}}, {"beta", 0.8}}}}};
                }
                scene["lights"] = {lamp};
                GpuWorld world = open_world("cones", floor_alone(passes, glossy), scene);
                const ReferenceWorld rays = open_reference_world(starbow::testing::scratch("cones.json"));
                Shot shot = shot_at({0, 5, 0}, flies * dvec3(0, 0, -1), {0, -1, 0}, {0, 0, -1});
                shot.effects = effects_of(true, true, false);
                const Reference truth = reference(rays.input(), layout, shot, 0, {.samples = 4});
                OffscreenRenderer live = renderer(world, layout);
                const Numbers numbers(live, shot);
                double brightest = 0, off = 0;
                int lit = 0;
                for (int i = 0; i < numbers.count(); ++i) {
                    const dvec3 right = truth.light[0][std::size_t(i)] / truth.exposure;
                    brightest = std::max(brightest, glm::length(right));
                }
                for (int i = 0; i < numbers.count(); ++i) {
                    const dvec3 right = truth.light[0][std::size_t(i)] / truth.exposure;
                    lit += glm::length(right) > 0.1 * brightest;
                    off = std::max(off, glm::length(numbers.light(i) - right) / brightest);
                }
                std::printf("  glossy %d, passes %d, flies %.1f: %d pixels lit, at most %.4f of the brightest off\n", glossy,
                    passes, flies, lit, off);
                EXPECT_LT(off, 0.03) << glossy << passes << flies;
                EXPECT_GT(lit, 200) << glossy << passes << flies;
                EXPECT_LT(lit, numbers.count() / 2) << "the cone has an edge in the picture";
            }
}

} // namespace starbow::gpu_test::lamps_gpu_test
