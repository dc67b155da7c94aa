// Light as coefficients through the cube map and the warp pass, compared with sums over every nanometre: black bodies,
// pigments, lines, infrared and ultraviolet.
#include "runtime/light/colour_difference.h"
#include "runtime/light/spectrum.h"
#include "tests/support/effects.h"
#include "tests/support/small_world.h"
#include <cstdio>

namespace starbow::gpu_test::spectra_gpu_test {
namespace {

/// A world needs at least one object; this one is never seen.
void speck(Doc& doc) { quad(doc, {0, 0, 1e6}, {1e-3, 0, 0}, {0, 1e-3, 0}, unlit(doc, {0, 0, 0})); }

const Json matt = {{"metallicFactor", 0}, {"roughnessFactor", 1}};

/// A matt material with these members in its extras.
Json starbow_extras(const Json& members) { return {{"extras", {{"starbow", members}}}, {"pbrMetallicRoughness", matt}}; }

dvec3 xyz_of(const dvec3& light) { return glm::inverse(rec709_from_sunlit_xyz()) * light; }
dvec2 chromaticity(const dvec3& xyz) { return dvec2(xyz) / (xyz.x + xyz.y + xyz.z); }

/// A shot that looks ahead from a ship that flies along -z with the Doppler factor E.
Shot ahead(double E, bool headlight = true)
{
    Shot shot = shot_at({0, 0, 0}, {0, 0, -0.5 * (E - 1 / E)}, {0, 0, -1});
    shot.effects = effects_of(true, true, headlight);
    return shot;
}

/// One pixel's light and D.
struct PixelLight {
    dvec3 xyz;
    double D;
    int pixel;
};
std::vector<PixelLight> all_around(const GpuWorld& world, const Shot& shot, ivec2 size = {96, 48})
{
    OffscreenRenderer offscreen = renderer(world, one_view(Equirectangular{}, size));
    const Numbers numbers(offscreen, shot);
    std::vector<PixelLight> seen;
    for (int i = 0; i < numbers.count(); ++i)
        seen.push_back({xyz_of(numbers.light(i)), numbers.D(i), i});
    return seen;
}

constexpr double faintest
    = 1e-34; // below it a float's digits are too few: D^3 and the exposure may come before a float's limit of 1.2e-38

/// A reflectance like a pigment's: steps and bumps, with its own values in the ultraviolet and the infrared.
struct Pigment {
    double level, step, step_nm, bump, bump_nm, ultraviolet, infrared;
    double operator()(double nm) const
    {
        auto logistic = [](double x) { return 1 / (1 + std::exp(-x)); };
        const double uv = logistic(-std::log(nm / 360) / 0.035), ir = logistic(std::log(nm / 820) / 0.05);
        const double at = std::clamp(nm, 330.0, 900.0), across = (at - bump_nm) / 40;
        const double visible = level + step * logistic((at - step_nm) / 18) + bump * std::exp(-0.5 * across * across);
        return uv * ultraviolet + ir * infrared + (1 - uv - ir) * std::clamp(visible, 0.0, 1.0);
    }
    Json table() const
    {
        Json points = Json::array();
        for (double nm = 250; nm <= 1400; nm *= 1.008)
            points.push_back({nm, (*this)(nm)});
        return points;
    }
};
const std::vector<Pigment> pigments
    = {{0.05, 0.6, 600, 0, 500, 0.04, 0.7}, {0.08, 0.1, 700, 0.35, 530, 0.06, 0.5}, {0.06, 0.2, 710, 0.4, 450, 0.3, 0.2},
        {0.1, 0.65, 515, 0, 450, 0.05, 0.6}, {0.5, 0.3, 560, -0.2, 470, 0.2, 0.9}, {0.4, 0, 600, 0, 600, 0.4, 0.4}};

} // namespace

TEST(Spectra, ABlackBodySkyIsABlackBodyAtEveryD)
{
    double worst = 0;
    int compared = 0;
    for (double kelvin : {1000.0, 2856.0, 5772.0, 40000.0}) {
        Doc doc;
        speck(doc);
        const GpuWorld world = open_world("black-body", doc, {{"sky", {{"temperature_K", kelvin}}}});
        EXPECT_EQ(world.spectra.level, SpectralLevel::colours); // a glow is exact at every level
        for (double E : {1.0, 3.0, 20.0})
            for (const PixelLight& seen : all_around(world, ahead(E))) {
                const dvec3 truth = seen_xyz(black_body(kelvin * seen.D), 1);
                if (truth.y < faintest)
                    continue;
                ++compared;
                worst = std::max(worst, glm::distance(chromaticity(seen.xyz), chromaticity(truth)));
                ASSERT_LT(glm::distance(chromaticity(seen.xyz), chromaticity(truth)), 0.002) << kelvin << " K at " << seen.D;
                // The light may fall by half with each percent of D. There the rounding of D to float and the fp16 row make
                // a percent.
                ASSERT_NEAR(seen.xyz.y / truth.y, 1, 0.01) << kelvin << " K at " << seen.D;
            }
    }
    std::printf("  %d pixels, chromaticity off by %.5f at most\n", compared, worst);
    EXPECT_GT(compared, 30000);
}

TEST(Spectra, PigmentsUnderTheSunEqualTheSumOverEveryNanometre)
{
    // Tiles stand all around at rest. Flights along several directions show each tile at D from 1/8 to 8.
    Doc doc;
    std::vector<dvec3> places;
    const int count = int(pigments.size());
    for (int row = -2; row <= 2; ++row)
        for (int i = 0; i < count; ++i) {
            const double a = 6.2831853 * (i + 0.3 * row) / count, up = 0.45 * row;
            const dvec3 place = glm::normalize(dvec3(std::sin(a), up, std::cos(a)));
            const dvec3 right = glm::normalize(glm::cross(dvec3(0, 1, 0), -place)), top = glm::cross(-place, right);
            places.push_back(place);
            Json material = starbow_extras({{"reflectance", pigments[std::size_t(i)].table()}});
            quad(doc, 10.0 * place, 1.2 * right, 1.2 * top, doc.put("materials", material));
        }
    const GpuWorld world = open_world("pigments", doc, {{"ambient", {0.5, 0.5, 0.5}}});
    EXPECT_EQ(world.spectra.level, SpectralLevel::fine);
    const Spectrum sun = sunlit_white();
    const dvec3 white = seen_xyz(sun, 1);
    std::vector<double> differences;
    double luminance = 0;
    OffscreenRenderer offscreen = renderer(world, one_view(Equirectangular{}, {768, 384}));
    for (double E : {1.0, 2.0, 8.0})
        for (const dvec3& way : {dvec3(0, 0, -1), dvec3(1, 0, 0), dvec3(0.3, -0.8, 0.5)}) {
            Shot shot = ahead(E, false);
            shot.u = glm::normalize(way) * (0.5 * (E - 1 / E));
            const Numbers numbers(offscreen, shot);
            for (int i = 0; i < numbers.count(); ++i)
                for (std::size_t tile = 0; tile < places.size(); ++tile) {
                    // The pixel's whole footprint, 0.065 wide at D = 8, lies inside the tile.
                    if (glm::dot(numbers.world(i), places[tile]) < std::cos(0.03))
                        continue;
                    const Pigment& pigment = pigments[tile % pigments.size()];
                    const dvec3 truth = 0.5 * seen_xyz([&](double nm) { return sun(nm) * pigment(nm); }, numbers.D(i));
                    const dvec3 shown = xyz_of(numbers.light(i));
                    differences.push_back(
                        ciede2000(cielab(truth * (0.5 / truth.y), white), cielab(shown * (0.5 / shown.y), white)));
                    luminance = std::max(luminance, std::abs(shown.y / truth.y - 1));
                }
        }
    ASSERT_GT(differences.size(), 100u);
    std::sort(differences.begin(), differences.end());
    std::printf("  %zu pixels: CIEDE2000 median %.2f, worst %.2f, luminance %.2f %%\n", differences.size(),
        differences[differences.size() / 2], differences.back(), 100 * luminance);
    EXPECT_LT(differences[differences.size() / 2], 1);
    EXPECT_LT(differences.back(), 3);
    EXPECT_LT(luminance, 0.02);
}

TEST(Spectra, EveryLevelShowsBaseColoursAlike)
{
    Doc doc;
    for (int i = 0; i < 6; ++i) {
        const double a = 6.2831853 * i / 6;
        const dvec3 place(std::sin(a), 0, std::cos(a)), right = glm::cross(dvec3(0, 1, 0), -place);
        const dvec3 colours[]
            = {{0.8, 0.1, 0.1}, {0.1, 0.6, 0.2}, {0.1, 0.2, 0.7}, {0.7, 0.6, 0.1}, {0.5, 0.5, 0.5}, {0.6, 0.3, 0.5}};
        quad(doc, 10.0 * place, 4.0 * right, {0, 4, 0}, unlit(doc, colours[i]));
    }
    Json scene = {{"sky", smooth_sky}};
    GpuWorld world = open_world("levels", doc, scene);
    ASSERT_EQ(world.spectra.level, SpectralLevel::colours);
    const dvec3 white = seen_xyz(sunlit_white(), 1);
    std::array<std::vector<PixelLight>, 3> seen;
    for (SpectralLevel level : {SpectralLevel::colours, SpectralLevel::middle, SpectralLevel::fine}) {
        put_spectra(device(), world, level);
        seen[std::size_t(level)] = all_around(world, ahead(2), {128, 64});
    }
    double middle = 0, fine = 0;
    for (std::size_t i = 0; i < seen[0].size(); ++i) {
        auto lab = [&](const PixelLight& s) { return cielab(s.xyz * (0.5 / s.xyz.y), white); };
        middle = std::max(middle, ciede2000(lab(seen[0][i]), lab(seen[1][i])));
        fine = std::max(fine, ciede2000(lab(seen[0][i]), lab(seen[2][i])));
    }
    std::printf("  CIEDE2000 to the colours': middle %.3f, fine %.2f\n", middle, fine);
    EXPECT_LT(middle, 0.3); // exact apart from fp16's rounding
    EXPECT_LT(fine, 3);
}

TEST(Spectra, ALineShiftsAlongTheSpectrum)
{
    // At 0.5 c, a line of 450 nm all around has the chromaticity of the spectrum at 450 nm / D.
    Doc doc;
    const int line = [&] {
        Json material = starbow_extras({{"emission", {{"line_nm", 450}}}});
        material["emissiveFactor"] = {1, 1, 1};
        return doc.put("materials", material);
    }();
    for (const dvec3& way : {dvec3(0, 0, -1), dvec3(1, 0, 0), dvec3(0, 0, 1), dvec3(-1, 0, 0)})
        quad(doc, 5.0 * way, 5.0 * glm::cross(dvec3(0, 1, 0), -way), {0, 5, 0}, line);
    const GpuWorld world = open_world("line", doc);
    const double E = std::sqrt(3.0);
    OffscreenRenderer offscreen = renderer(world, one_view(Equirectangular{}, {720, 90}));
    const Numbers numbers(offscreen, ahead(E, false));
    const double wavelengths[][2]
        = {{90, 520}, {105.5, 589}, {120, 650}}; // camera angle from the motion, and the wavelength seen there
    int found = 0, compared = 0;
    for (int i = 0; i < numbers.count(); ++i) {
        if (std::abs(numbers.camera(i).y) > 0.3)
            continue;
        const double nm = 450 / numbers.D(i), angle = between(numbers.camera(i), {0, 0, -1}) * 57.29577951308232;
        const dvec3 seen = xyz_of(numbers.light(i)), truth = eye().response(nm);
        if (truth.y < 1e-4 * eye().response(555).y)
            continue;
        ++compared;
        // The table's rows are 2.5 nm apart.
        ASSERT_LT(glm::distance(chromaticity(seen), chromaticity(truth)), 0.003) << nm << " nm";
        for (const auto& known : wavelengths)
            if (std::abs(angle - known[0]) < 0.1) {
                ++found;
                EXPECT_NEAR(nm, known[1], 1) << angle;
            }
    }
    EXPECT_GT(compared, 5000);
    EXPECT_GT(found, 5);
}

namespace {

/// Walls all around in every kind of spectrum that a surface sends or reflects, under a lamp of no sunlight, below a sky
/// that glows; a body, if any, passes ahead of them.
Doc spectral_walls(bool body)
{
    Doc doc;
    const auto wall = [&](const Json& extras, const Json& emissive) {
        Json material = extras.empty() ? Json{{"pbrMetallicRoughness", matt}} : starbow_extras(extras);
        material["pbrMetallicRoughness"]["baseColorFactor"] = {0.4, 0.3, 0.2, 1};
        if (!emissive.empty())
            material["emissiveFactor"] = emissive;
        return doc.put("materials", material);
    };
    const int materials[] = {wall({}, {}), wall({}, {0.3, 0.2, 0.5}), wall({{"ultraviolet", 0.9}, {"infrared", 0.1}}, {}),
        wall({{"reflectance", pigments[0].table()}}, {}), wall({{"emission", {{"line_nm", 520}}}}, {0.5, 0.5, 0.5}),
        wall({{"emission", {{"black_body_K", 3200}}}}, {0.8, 0.6, 0.2}),
        wall({{"temperature_K", 2400}, {"emissivity", 0.7}}, {})};
    const int count = int(std::size(materials));
    for (int i = 0; i < count; ++i) {
        const double a = 6.2831853 * i / count;
        const dvec3 place(std::sin(a), 0, std::cos(a)), right = glm::cross(dvec3(0, 1, 0), -place);
        quad(doc, 10.0 * place, 3.0 * right, {0, 3, 0}, materials[i]);
    }
    if (body)
        quad(doc, {0, 0, -4}, {1, 0, 0}, {0, 1, 0}, materials[3], {{"name", "body"}});
    return doc;
}

GpuWorld spectral_room(bool body)
{
    Json scene = {{"ambient", {0.2, 0.2, 0.2}}, {"sky", {{"temperature_K", 1800}}},
        {"lights",
            {{{"type", "point"}, {"position", {0, 2, 0}}, {"distance", 8}, {"radiance", {1, 1, 1}},
                {"temperature_K", 2856}}}}};
    if (body)
        scene["bodies"]
            = {{{"name", "body"}, {"nodes", {"body"}}, {"velocity", {{"direction", {1, 0, 0}}, {"gamma", 1.2}}}}};
    return open_world(body ? "room-body" : "room", spectral_walls(body), scene);
}

} // namespace

TEST(Spectra, WithoutDopplerLightHasTheColoursOfRest)
{
    // At rest D is 1 and the coefficients' colours are those of rest; without the Doppler effect no coefficient is stored.
    const GpuWorld world = spectral_room(false);
    ASSERT_EQ(world.spectra.level, SpectralLevel::fine);
    ASSERT_EQ(world.spectra.basis.own.size(), 4u);
    ASSERT_TRUE(world.unshifted);
    const Layout layout = one_view(Equirectangular{}, {192, 96});
    Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
    shot.effects = {};
    OffscreenRenderer with = renderer(world, layout), without = renderer(world, layout);
    const Numbers coefficients(with, shot);
    shot.effects.on.set(Effect::doppler, false);
    const Numbers colours(without, shot);
    double worst = 0;
    for (int i = 0; i < colours.count(); ++i) {
        const dvec3 a = coefficients.light(i), b = colours.light(i);
        ASSERT_GT(glm::length(a), 0) << i;
        worst = std::max(worst, glm::length(a - b) / glm::length(a));
    }
    std::printf("  %.4f %% off\n", 100 * worst);
    EXPECT_GT(worst, 0) << "the same numbers are compared with themselves";
    // Halves have eleven bits, in the cube map and in the table of responses; the coefficients' sums add some.
    EXPECT_LT(worst, 0.005);
}

TEST(Spectra, TheDopplerSwitchLeavesNothingBehind)
{
    for (bool body : {false, true}) {
        const GpuWorld world = spectral_room(body);
        Quality quality = default_quality(device(), false);
        quality.frames_per_cube = 3;
        const Layout layout = one_view(Planar{.fov_y_deg = 90}, {96, 64});
        OffscreenRenderer flown(device(), pipelines(), world, layout, quality, false);
        Shot shot = shot_at({0, 0, 0}, {0.2, 0, -0.5}, {0, 0, -1});
        shot.effects = {};
        for (const auto& [doppler, false_colours] :
            {std::pair{true, false}, {false, false}, {false, true}, {false, false}, {true, false}, {true, true}}) {
            shot.effects.on.set(Effect::doppler, doppler), shot.effects.on.set(Effect::false_colours, false_colours);
            OffscreenRenderer fresh(device(), pipelines(), world, layout, quality, false);
            EXPECT_EQ(flown.picture(shot), fresh.picture(shot))
                << "Doppler " << doppler << ", false colours " << false_colours << ", body " << body;
        }
    }
}

TEST(Spectra, ARoomTemperatureWallGlowsDullRedFromGammaOneAndAHalf)
{
    Doc doc;
    Json material = starbow_extras({{"temperature_K", 288}, {"emissivity", 0.9}});
    material["pbrMetallicRoughness"]["baseColorFactor"] = {0.1, 0.1, 0.1, 1};
    quad(doc, {0, 0, -5}, {50, 0, 0}, {0, 50, 0}, doc.put("materials", material));
    const GpuWorld world = open_world("wall", doc);
    OffscreenRenderer offscreen = renderer(world, one_view(Planar{20}, {64, 48}));
    double before = 0;
    for (double gamma : {1.0, 1.2, 1.5, 2.0, 4.0}) {
        const double E = gamma + u_of_gamma(gamma);
        const Shot shot = ahead(E);
        const Numbers numbers(offscreen, shot);
        const int middle = 24 * 64 + 32;
        const dvec3 light = numbers.light(middle), xyz = xyz_of(light);
        const dvec3 truth = 0.9 * seen_xyz(black_body(288 * numbers.D(middle)), 1);
        if (truth.y > faintest) {
            EXPECT_NEAR(xyz.y / truth.y, 1, 0.01) << gamma;
        }
        EXPECT_GE(xyz.y, before);
        before = xyz.y;
        const double nits = xyz.y * 39870; // a sunlit white's luminance, cd/m2
        if (gamma == 1.2) {
            EXPECT_LT(nits, 1e-6); // less than a dark-adapted eye sees
        }
        if (gamma == 1.5) {
            EXPECT_GT(nits, 1e-4); // like the ground in a moonless night
            EXPECT_LT(nits, 1e-1);
            EXPECT_GT(light.r, 0);
            EXPECT_LT(std::max(light.g, light.b), 0.05 * light.r);
        }
        // The meter exposes the picture for a dark-adapted eye.
        if (gamma == 1.5) {
            Shot dark = shot;
            dark.exposure_ev = offscreen.metered(shot).value_or(0);
            EXPECT_NEAR(dark.exposure_ev, 24, 3);
            const auto picture = offscreen.picture(dark).front();
            EXPECT_GT(picture[4 * middle], 60);
            EXPECT_GT(picture[4 * middle], 2 * picture[4 * middle + 2]); // bright light tends to white
        }
    }
}

TEST(Spectra, TheMicrowaveBackgroundAppearsNearGamma150)
{
    Doc doc;
    speck(doc);
    const GpuWorld world = open_world("microwaves", doc, {{"sky", {{"temperature_K", 2.725}}}});
    OffscreenRenderer offscreen = renderer(world, one_view(Planar{0.5}, {65, 49}));
    for (double gamma : {50.0, 146.0, 1000.0, 1e6}) {
        const Numbers numbers(offscreen, ahead(gamma + u_of_gamma(gamma)));
        const int middle = 24 * 65 + 32;
        const dvec3 xyz = xyz_of(numbers.light(middle));
        const dvec3 truth = seen_xyz(black_body(2.725 * numbers.D(middle)), 1);
        EXPECT_NEAR(numbers.D(middle) / (2 * gamma), 1, 0.06) << gamma;
        if (truth.y > faintest) {
            EXPECT_NEAR(xyz.y / truth.y, 1, 0.01) << gamma;
            EXPECT_LT(glm::distance(chromaticity(xyz), chromaticity(truth)), 0.002) << gamma;
        }
        // The sky is as bright as the wall at gamma 1.5: both are near 800 K.
        if (gamma == 50) {
            EXPECT_LT(xyz.y * 39870, 1e-6);
        }
        if (gamma == 146) {
            EXPECT_GT(xyz.y * 39870, 1e-3);
        }
    }
}

TEST(Spectra, FalseColoursShowTheInfraredRedAndTheUltravioletBlue)
{
    Doc doc;
    auto material = [&](const Json& beyond) {
        Json material = starbow_extras(beyond);
        material["pbrMetallicRoughness"]["baseColorFactor"] = {0.2, 0.2, 0.2, 1};
        return doc.put("materials", material);
    };
    quad(doc, {-1, 0, -4}, {0.9, 0, 0}, {0, 2, 0}, material({{"infrared", 0.9}, {"ultraviolet", 0.05}}));
    quad(doc, {1, 0, -4}, {0.9, 0, 0}, {0, 2, 0}, material({{"infrared", 0.05}, {"ultraviolet", 0.9}}));
    GpuWorld world = open_world("false", doc, {{"ambient", {1, 1, 1}}});
    ASSERT_EQ(world.spectra.level, SpectralLevel::middle); // five coefficients represent all of these materials
    for (SpectralLevel level : {SpectralLevel::middle, SpectralLevel::fine}) {
        put_spectra(device(), world, level);
        OffscreenRenderer offscreen = renderer(world, one_view(Planar{40}, {64, 48}));
        Shot shot = ahead(1);
        const Numbers plain(offscreen, shot);
        shot.effects.on.set(Effect::false_colours);
        const Numbers shown(offscreen, shot);
        const int left = 24 * 64 + 16, right = 24 * 64 + 48;
        for (int i : {left, right}) // the visible light of both is the same grey
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(plain.light(i)[c], 0.2, 0.01);
        EXPECT_NEAR(shown.light(left).r, 0.9, 0.06); // the bands overlap the reflectance's rise
        EXPECT_NEAR(shown.light(left).b, 0.05, 0.03);
        EXPECT_NEAR(shown.light(right).r, 0.05, 0.04);
        EXPECT_NEAR(shown.light(right).b, 0.9, 0.08);
        for (int i : {left, right})
            EXPECT_NEAR(shown.light(i).g, 0.2, 0.04);
    }
}

// On a GPU the sampler interpolates the response's rows, whose light is therefore rounded to halves, and the place between
// two rows to a 256th. Both together are less than one step of a picture's bytes, whatever D is. There, too, a few rest
// frames are entries of an array, as many are.
TEST(SampledResponse, ShowsTheSamePicture)
{
    const Layout layout = one_view(Equirectangular{}, {240, 120});
    for (const auto& [name, level] : {std::pair("avenue", SpectralLevel::colours), {"train", SpectralLevel::colours},
             {"chart", SpectralLevel::middle}, {"chart", SpectralLevel::fine}}) {
        const SceneFile scene
            = load_scene_file(starbow::testing::source_dir() / "config/scenes" / (std::string(name) + ".json"));
        std::vector<std::vector<std::uint8_t>> pictures[2];
        std::vector<dvec3> numbers[2]; // these are the same to the bit: the sampler does not touch them
        for (const bool sampled : {false, true}) {
            device().draws_as_gpu = sampled;
            const GpuWorld world = upload(device(), pipelines(), load_world(scene), scene, {}, level);
            device().draws_as_gpu = false;
            OffscreenRenderer live = renderer(world, layout, true);
            for (const double gamma : {1.3, 4.0, 100.0})
                for (const double ev : {-4.0, 0.0, 6.0}) {
                    Shot shot = scene.start;
                    shot.u = {0, 0, -std::sqrt(gamma * gamma - 1)}, shot.exposure_ev = ev;
                    pictures[sampled].push_back(live.picture(shot)[0]);
                    const Numbers seen(live, shot);
                    for (int i = 0; i < seen.count(); ++i)
                        numbers[sampled].push_back(seen.light(i));
                }
        }
        const auto made = pipelines().made();
        EXPECT_TRUE(std::ranges::any_of(
            made, [](const auto& one) { return describe(one.first).find("sampled_response") != std::string::npos; }));
        EXPECT_TRUE(numbers[0] == numbers[1]) << name;
        int most = 0;
        std::size_t differ = 0, all = 0, lit = 0;
        for (std::size_t i = 0; i < pictures[0].size(); ++i)
            for (std::size_t k = 0; k < pictures[0][i].size(); ++k) {
                if (k % 4 == 3) // alpha
                    continue;
                const int off = std::abs(int(pictures[0][i][k]) - int(pictures[1][i][k]));
                most = std::max(most, off), differ += off > 0, ++all, lit += pictures[0][i][k] > 0;
            }
        std::printf("  %s, level %d: %zu of %zu bytes differ, by %d at most\n", name, int(level), differ, all, most);
        EXPECT_LE(most, 1);
        EXPECT_LT(differ, all / 20);
        EXPECT_GT(lit, all / 4);
    }
}

} // namespace starbow::gpu_test::spectra_gpu_test
