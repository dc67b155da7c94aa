// The globes in the live picture against rays in double, which share no code with it but the ephemeris: light, distances and
// shown pictures at rest and in flight, on several displays. Then the light of whole discs against published magnitudes, the
// Sun's limb and the Moon's shadow.
#include "config/model/angles.h"
#include "runtime/images/picture_errors.h"
#include "runtime/light/colour.h"
#include "runtime/light/spectrum.h"
#include "runtime/reference/globes.h"
#include "runtime/reference/reference.h"
#include "tests/support/effects.h"
#include "tests/support/gpu_environment.h"
#include <functional>
#include <map>

namespace starbow::gpu_test::globes_gpu_test {
namespace {

std::filesystem::path scene_file() { return testing::source_dir() / "config/scenes/solar-system.json"; }

/// The time of most pictures, in the scene's seconds: after the eclipse, midnight over Europe and Africa.
constexpr double later = 6 * 3600;

constexpr double southern_midnight = -5500; ///< over the south of Australia

/// The solar system without stars, on the device and for rays.
struct Solar {
    ReferenceWorld rays = open_reference_world(scene_file());
    GpuWorld gpu;
    WorldOrigin origin;
    dmat3 world_from_equatorial;

    Solar()
    {
        rays.stars.clear();
        LoadedScene loaded = load_scene(scene_file());
        gpu = upload(device(), pipelines(), std::move(loaded.world), loaded.scene, {});
        origin = world_origin(system(), *rays.scene.globes);
        world_from_equatorial = starbow::world_from_equatorial(rays.scene.stars->ahead_deg);
    }
    const SolarSystem& system() const { return rays.world.globes->system; }
    std::size_t index_of(const std::string& name) const
    {
        for (std::size_t i = 0; i < system().globes.size(); ++i)
            if (system().globes[i].name == name)
                return i;
        throw std::runtime_error("no globe " + name);
    }
    const Globe& globe(const std::string& name) const { return system().globes[index_of(name)]; }
    double unit_m() const { return rays.scene.unit_m; }
    double radius(const std::string& name) const { return globe(name).radius_m / unit_m(); }
    /// A globe's place in the world at a time, as an eye beside it sees it.
    dvec3 place(const std::string& name, double time = later) const
    {
        return world_from_equatorial
            * ((globe_places_m(system(), origin.days + time / 86400)[index_of(name)] - origin.at(time)) / unit_m());
    }
    dvec3 to_sun(const std::string& name, double time = later) const
    {
        return glm::normalize(place("Sun", time) - place(name, time));
    }
    dvec3 pole(const std::string& name) const
    {
        return world_from_equatorial * (glm::transpose(globe_turn(globe(name), origin.days)) * dvec3(0, 0, 1));
    }
    /// A place on the Earth's ground, from its middle, in equatorial radii. Geographic latitude.
    dvec3 on_earth(double latitude_deg, double longitude_deg, double time = later) const
    {
        const double a = latitude_deg * degree, b = longitude_deg * degree;
        const double polar = std::pow(1 - globe("Earth").flattening, 2);
        const dvec3 own = dvec3(std::cos(a) * std::cos(b), std::cos(a) * std::sin(b), polar * std::sin(a))
            / std::sqrt(std::pow(std::cos(a), 2) + polar * std::pow(std::sin(a), 2));
        return world_from_equatorial * (glm::transpose(globe_turn(globe("Earth"), origin.days + time / 86400)) * own);
    }
};

Solar* kept = nullptr;
const Solar& solar()
{
    if (!kept)
        kept = new Solar;
    return *kept;
}

/// The device's objects must go before the device.
class Closing : public ::testing::Environment {
    void TearDown() override { delete std::exchange(kept, nullptr); }
};
::testing::Environment* const closing = ::testing::AddGlobalTestEnvironment(new Closing);

/// A unit direction at an angle from another one, towards a third.
dvec3 tilted(const dvec3& from, const dvec3& towards, double degrees)
{
    const dvec3 aside = glm::normalize(towards - from * glm::dot(towards, from));
    return glm::normalize(from * std::cos(degrees * degree) + aside * std::sin(degrees * degree));
}

/// A place from which something is looked at.
struct Subject {
    const char* name;
    dvec3 eye, look; ///< look: unit, world
    double fov_deg, time = later;
    int samples = 4;
    bool air = false; ///< a great part of the picture is air
    double rough = 0.06, median = 0.03, mean = 0.02,
           psnr_dB
        = 24; ///< bounds of errors: at smooth places, the worst and the median; of the mean light; of the shown picture
};

std::vector<Subject> subjects()
{
    const Solar& s = solar();
    const dvec3 sun = s.to_sun("Earth"), north = s.pole("Earth");
    const double earth = s.radius("Earth");
    std::vector<Subject> all;
    /// From a direction and a distance in radii.
    const auto before = [&](const char* name, const char* globe, const dvec3& from, double radii, double fov_deg) {
        all.push_back({name, s.place(globe) + from * (radii * s.radius(globe)), -from, fov_deg});
    };
    before("the Earth from 3 radii", "Earth", tilted(sun, north, 40), 3, 46);
    const dvec3 morning = tilted(sun, glm::cross(north, sun), 55);
    for (const double height_km : {400.0, 10.0}) {
        const double up = 1 + height_km * 1000 / s.globe("Earth").radius_m;
        const double dip = std::acos(1 / up) / degree;
        all.push_back({height_km > 100 ? "the limb from 400 km" : "the limb from 10 km",
            s.place("Earth") + morning * earth * (up + 0.0005),
            tilted(glm::normalize(glm::cross(morning, north)), -morning, dip), height_km > 100 ? 30.0 : 20.0});
    }
    // The Sun stands behind the Earth.
    before("cities at night", "Earth", glm::normalize(s.on_earth(15, 5)), 1.5, 60);
    before("the Moon", "Moon", tilted(s.to_sun("Moon"), north, 50), 8, 18);
    const dvec3 pole = s.pole("Saturn"), saturn_sun = s.to_sun("Saturn");
    const double side = glm::dot(pole, saturn_sun) > 0 ? 1 : -1;
    const dvec3 level = glm::normalize(saturn_sun - pole * glm::dot(pole, saturn_sun));
    const dvec3 saturn_aside = glm::normalize(level + 0.7 * glm::cross(pole, level));
    before("Saturn's sunlit rings", "Saturn", tilted(saturn_aside, pole * side, 25), 8, 36);
    before("Saturn's dark rings", "Saturn", tilted(saturn_aside, -pole * side, 25), 8, 36);
    before("Saturn's sunlit rings from near", "Saturn", tilted(saturn_aside, pole * side, 25), 3.2, 12);
    all.back().look = glm::normalize(all.back().look + 0.55 * glm::normalize(glm::cross(pole, all.back().look)));
    before("Saturn's dark rings from near", "Saturn", tilted(saturn_aside, -pole * side, 25), 3.2, 12);
    all.back().look = glm::normalize(all.back().look + 0.55 * glm::normalize(glm::cross(pole, all.back().look)));
    before("Saturn's sunlit rings, each ringlet", "Saturn", tilted(saturn_aside, pole * side, 25), 3.2, 0.4);
    all.back().look = all[all.size() - 3].look;
    before("Saturn's dark rings, each ringlet", "Saturn", tilted(saturn_aside, -pole * side, 25), 3.2, 0.4);
    all.back().look = all[all.size() - 3].look;
    before("Jupiter", "Jupiter", tilted(s.to_sun("Jupiter"), s.pole("Jupiter"), 35), 6, 26);
    before("the Sun", "Sun", north, 30, 5);
    for (const double pixels : {0.5, 1.2, 3.0}) {
        // 72 pixels of 0.5 degrees each are 36 degrees; radians of a radius at the middle.
        const double pixel = 2 * std::tan(5 * degree) / 72;
        before(pixels < 1    ? "a small Mars of 0.5 pixels"
                : pixels < 2 ? "a small Mars of 1.2 pixels"
                             : "a small Mars of 3 pixels",
            "Mars", tilted(s.to_sun("Mars"), north, 30), 1 / (pixels * pixel), 10);
        all.back().samples = 64;
    }
    const dvec3 shadow = s.on_earth(65.2, -25.2, 0);
    all.push_back({"the Moon's shadow",
        s.place("Earth", 0) + tilted(glm::normalize(shadow), s.to_sun("Earth", 0), 30) * 2.5 * earth, dvec3(0), 30, 0});
    all.back().look = glm::normalize(s.place("Earth", 0) + shadow * earth - all.back().eye);
    before("the Sun's surface from near", "Sun", -sun, 1.6, 60);
    // Midnight south of Australia.
    const dvec3 south = glm::normalize(s.on_earth(-60, 118, southern_midnight));
    all.push_back({"aurora from 420 km", s.place("Earth", southern_midnight) + south * earth * (1 + 420e3 / 6378e3),
        tilted(tilted(south, -north, 90), -south, 26), 50, southern_midnight});
    all.push_back({"aurora above the sea", s.place("Earth", southern_midnight) + south * earth * (1 + 2e3 / 6378e3),
        tilted(tilted(south, -north, 90), south, 35), 80, southern_midnight});
    for (Subject& one : all) {
        const std::string name = one.name;
        const auto has = [&](const char* word) { return name.find(word) != std::string::npos; };
        one.air = has("limb") || has("Earth") || has("shadow");
        if (has("limb")) // towards the horizon a pixel's ground is longer than wide, and its one ray meets a cloud's edge or
                         // not
            one.rough = 0.25, one.mean = 0.03, one.samples = 16;
        if (has("aurora")) // a layer's arcs are taken between its two ends at once: their folds on a long way are missing
            one.mean = 0.04, one.rough = 0.5, one.median = 0.05, one.samples = 16;
        // Each is finer than a pixel: the map's levels place its light elsewhere in the pixel, or in the next one, which
        // airglow makes smooth. A few cities have most of the light.
        if (has("cities"))
            one.mean = 0.08, one.rough = INFINITY, one.psnr_dB = 18, one.samples = 64;
        if (has("rings")) // ringlets and gaps are finer than a pixel, and the live picture takes eight places of each
            one.mean = 0.03, one.rough = 0.08, one.samples = 64;
        if (has("Mars")) // a small disc is its edge; in a dome, where pixels are no squares, 3.1 % are seen
            one.mean = 0.04;
        // A spot has the mean of all sides, not that of the side that is seen: 9 % in the ultraviolet.
        if (has("0.5 pixels") || has("1.2 pixels"))
            one.mean = 0.12;
        if (has("the Sun")) // its glare as that of one point or of its disc
            one.psnr_dB = 20, one.samples = 32;
    }
    return all;
}

struct Speed {
    const char* name;
    double gamma;
    double aside_deg; ///< of the motion from the look in the world
    bool doppler = true; ///< astern at gamma 4 the eye sees the extreme ultraviolet, of which the Sun sends nothing
};
constexpr Speed speeds[] = {{"at rest", 1, 0}, {"at 0.5 c", 1.1547005383792517, 35},
    {"at 0.5 c astern", 1.1547005383792517, 180}, {"at gamma 4 ahead", 4, 0}, {"at gamma 4 astern", 4, 180, false}};

/// D: of the middle, by which the picture shrinks.
struct Taken {
    Shot shot;
    double D;
};
Taken shot_of(const Subject& subject, const Speed& speed)
{
    const dvec3 up = std::abs(subject.look.y) > 0.9 ? dvec3(0, 0, 1) : dvec3(0, 1, 0);
    const double beta_gamma = u_of_gamma(speed.gamma);
    const dvec3 u = beta_gamma
        * (speed.aside_deg == 180      ? -subject.look
                : speed.aside_deg == 0 ? subject.look
                                       : tilted(subject.look, up, speed.aside_deg));
    const double D = speed.gamma + glm::dot(u, subject.look);
    const dvec3 seen = glm::normalize(subject.look + u + u * (glm::dot(u, subject.look) / (speed.gamma + 1)));
    Shot shot = shot_at(subject.eye, u, seen, up);
    shot.time = subject.time;
    shot.effects = effects_of(true, speed.doppler, true);
    return {shot, D};
}

double shrunk(double fov_deg, double D)
{
    return std::min(4 * std::atan(std::tan(fov_deg / 4 * degree) / D) / degree, 100.0);
}

/// How two pictures' light differs, as parts of the reference's.
struct Errors {
    double mean = 0; ///< of the whole picture's light
    double median = 0, most = 0; ///< over pixels in smooth places
    int smooth = 0;
    ivec2 where{0};
    dvec3 live{0}, rays{0}; ///< there
    double distances = 0; ///< part of the pixels whose distance is off
    double D = 0;
    double psnr = 0;
};

double bright(const dvec3& light) { return 0.2126 * light.r + 0.7152 * light.g + 0.0722 * light.b; }

Errors compare(const Layout& layout, Shot shot, int samples, const std::string& name, double rough = 0.04)
{
    OffscreenRenderer live(device(), pipelines(), solar().gpu, layout, test_quality(), true);
    const Numbers numbers(live, shot);
    // So exposed that one pixel in fifty is white or more.
    std::vector<double> lights;
    for (int i = 0; i < numbers.count(); ++i)
        if (numbers.shown(i))
            lights.push_back(bright(numbers.light(i)));
    const double top = std::max(quantile(lights, 0.98), 0.02 * *std::max_element(lights.begin(), lights.end()));
    shot.exposure_ev = std::clamp(-std::log2(std::max(top, 1e-12)), -30.0, 30.0);
    const Reference truth = reference(solar().rays.input(), layout, shot, 0, {.samples = samples});
    Errors out;
    const auto rays
        = [&](int i) { return (truth.light[0][std::size_t(i)] - truth.numbers[std::size_t(i)].glare) / truth.exposure; };
    dvec3 all_live(0), all_rays(0);
    std::vector<double> off;
    int wrong = 0, only_live = 0, only_rays = 0, shown_count = 0;
    for (int i = 0; i < numbers.count(); ++i) {
        if (!numbers.shown(i) || !truth.numbers[std::size_t(i)].shown)
            continue;
        ++shown_count;
        const Reference::Numbers& n = truth.numbers[std::size_t(i)];
        const bool finite = std::isfinite(numbers.depth(i)), right = std::isfinite(n.distance);
        only_live += finite && !right, only_rays += right && !finite;
        wrong += finite != right || (right && !(std::abs(numbers.depth(i) / n.distance - 1) < 1e-3));
        out.D = std::max(out.D, std::abs(numbers.D(i) / n.D - 1));
        all_live += numbers.light(i), all_rays += rays(i);
        const int x = i % numbers.size.x, y = i / numbers.size.x;
        if (x < 1 || y < 1 || x + 1 >= numbers.size.x || y + 1 >= numbers.size.y)
            continue;
        const double here = glm::length(rays(i));
        double spread = 0;
        for (const int j : {i - 1, i + 1, i - numbers.size.x, i + numbers.size.x})
            spread = std::max(spread, glm::length(rays(j) - rays(i)));
        if (here == 0 || here < 3e-3 * top || spread > rough * here)
            continue;
        const double error = glm::length(numbers.light(i) - rays(i)) / here;
        off.push_back(error);
        if (error > out.most)
            out.most = error, out.where = {x, y}, out.live = numbers.light(i), out.rays = rays(i);
    }
    out.smooth = int(off.size());
    out.mean = all_rays == dvec3(0) ? 0 : bright(all_live) / bright(all_rays) - 1; // a night may be all dark
    out.median = quantile(off, 0.5);
    out.distances = double(wrong) / shown_count;
    const auto picture = live.picture(shot)[0];
    const auto right = shown(truth);
    out.psnr = psnr_dB({truth.size, picture}, {truth.size, right});
    std::printf(
        "%-52s light %+.2f %%; smooth %5d: median %.2f %%, worst %.2f %% at %d, %d: (%.4g %.4g %.4g) for (%.4g %.4g %.4g); "
        "distances off %.2f %% (%d only live, %d only by rays), D %.1e, %.1f dB, EV %.1f\n",
        name.c_str(), 100 * out.mean, out.smooth, 100 * out.median, 100 * out.most, out.where.x, out.where.y, out.live.r,
        out.live.g, out.live.b, out.rays.r, out.rays.g, out.rays.b, 100 * out.distances, only_live, only_rays, out.D,
        out.psnr, shot.exposure_ev);
    if (const char* probe = std::getenv("STARBOW_GLOBES_PROBE")) {
        int x = 0, y = 0, used = 0;
        while (std::sscanf(probe, "%d,%d%n", &x, &y, &used) == 2) {
            probe += used;
            const int i = y * numbers.size.x + x;
            const dvec3 a = numbers.light(i), b = rays(i);
            std::printf("    %d, %d: (%.4g %.4g %.4g) for (%.4g %.4g %.4g), depth %.7g for %.7g\n", x, y, a.r, a.g, a.b, b.r,
                b.g, b.b, numbers.depth(i), truth.numbers[std::size_t(i)].distance);
        }
    }
    if (const char* folder = std::getenv("STARBOW_GLOBES_OUT")) {
        std::string file = name;
        std::replace(file.begin(), file.end(), ' ', '_');
        write_png(std::filesystem::path(folder) / (file + "-live.png"), truth.size, picture);
        write_png(std::filesystem::path(folder) / (file + "-rays.png"), truth.size, right);
        write_exr(std::filesystem::path(folder) / (file + "-live.exr"), truth.size, numbers.channels);
        write_exr(std::filesystem::path(folder) / (file + "-rays.exr"), truth.size, channels(truth));
    }
    return out;
}

/// A picture of each subject, at another speed each; with all cases, at every speed. STARBOW_GLOBES_ONLY names a part of
/// them.
bool chosen(const std::string& name, std::size_t subject, std::size_t speed, std::size_t every = 1)
{
    if (const char* only = std::getenv("STARBOW_GLOBES_ONLY"))
        return name.find(only) != std::string::npos;
    return testing::all_cases() || (subject % every == 0 && (subject / every + 2) % std::size(speeds) == speed);
}

} // namespace

/// The bounds of a picture's errors.
void expect_close(const Errors& errors, const Subject& subject, const Speed& speed, const std::string& name)
{
    // The live picture filters its maps by levels, and has one ray in a pixel and smooth edges: its texture differs by a few
    // percent of a place, less in the mean. Its air is a sum of twelve steps. They are too few where the air is thick: near
    // a horizon in blue light, and astern, where the eye sees the ultraviolet at 0.577 of its wavelength, whose optical
    // depth is 1 to 6: there the worst place is 57 % off, with twice as many steps 23 %.
    const bool thick = subject.air && speed.doppler && speed.aside_deg == 180;
    if (errors.smooth >= 20) { // of fewer there is no median
        EXPECT_LT(errors.median, thick ? 0.06 : subject.median) << name;
    }
    EXPECT_LT(errors.most, thick ? 0.6 : subject.rough) << name << " at " << errors.where.x << ", " << errors.where.y;
    EXPECT_LT(std::abs(errors.mean), thick ? 0.1 : subject.mean) << name;
    EXPECT_LT(errors.distances, 0.01) << name;
    EXPECT_LT(errors.D, 1e-6) << name;
    EXPECT_GT(errors.psnr, subject.psnr_dB - (thick ? 1 : 0)) << name;
}

/// Each chosen subject at each chosen speed on a display, by its name in front of theirs. layout_of: from a subject's field
/// of view, degrees, as it is in flight.
/// changed: what is different there.
template <class LayoutOf>
void expect_all_close(
    const std::string& display, std::size_t every, LayoutOf&& layout_of,
    const std::function<void(Subject&, const std::string& name)>& changed = [](Subject&, const std::string&) {})
{
    const std::vector<Subject> all = subjects();
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t k = 0; k < std::size(speeds); ++k) {
            const std::string name = display + all[i].name + ", " + speeds[k].name;
            if (!chosen(name, i, k, every))
                continue;
            Subject one = all[i];
            changed(one, name);
            const Taken taken = shot_of(one, speeds[k]);
            const Layout layout = layout_of(shrunk(one.fov_deg, taken.D));
            expect_close(compare(layout, taken.shot, one.samples, name), one, speeds[k], name);
        }
}

TEST(Globes, LightIsThatOfTheRaysOnADesk)
{
    expect_all_close("", 1, [](double fov_deg) { return one_view(Planar{.fov_y_deg = fov_deg}, {96, 72}); });
}

TEST(Globes, LightIsThatOfTheRaysInADome)
{
    expect_all_close("dome: ", 3, [](double fov_deg) {
        return one_view(Fisheye{.aperture_deg = std::min(1.2 * fov_deg, 180.0), .tilt_deg = 90}, {72, 72});
    });
}

/// The eyes of this layout are 9,750 km apart: each has its own view of a globe.
TEST(Globes, LightIsThatOfTheRaysForBothEyes)
{
    Layout layout = load_layout(testing::source_dir() / "config/layouts/stereo.json");
    layout.outputs[0].size = {144, 54};
    // Its field of view stays, so that globes are a few pixels wide ahead, and a small Mars is one spot.
    expect_all_close(
        "stereo: ", 4, [&](double) { return layout; },
        [](Subject& one, const std::string& name) {
            const auto has = [&](const char* word) { return name.find(word) != std::string::npos; };
            if (has("gamma 4 ahead"))
                one.mean = 0.1, one.samples = 64;
            if (has("Mars"))
                one.mean = 0.12, one.rough = 0.08;
            // The air's sunlit rim is a third of a pixel wide, and it has most of the light.
            if (has("cities") && has("0.5 c") && !has("astern"))
                one.mean = 0.08, one.rough = 0.15, one.samples = 400;
        });
}

/// On a GPU the shaders take each globe in turn, in software those alone that a pixel meets.
TEST(Globes, AreTheSameTakenInTurn)
{
    const Solar& s = solar();
    LoadedScene loaded = load_scene(scene_file());
    device().draws_as_gpu = true;
    const GpuWorld gpu = upload(device(), pipelines(), std::move(loaded.world), loaded.scene, {});
    device().draws_as_gpu = false;
    std::vector<Subject> all;
    for (const Subject& one : subjects())
        if (std::string_view(one.name) == "the limb from 400 km" || std::string_view(one.name) == "Saturn's dark rings"
            || std::string_view(one.name) == "a small Mars of 3 pixels")
            all.push_back(one);
    EXPECT_EQ(all.size(), 3U);
    const dvec3 beyond = tilted(glm::normalize(s.place("Moon") - s.place("Earth")), s.pole("Earth"), 10);
    all.push_back({"the Moon before a part of the Earth", s.place("Moon") + beyond * (6 * s.radius("Moon")), -beyond, 30});
    for (const Subject& one : all)
        for (const Speed& speed : {speeds[0], speeds[3]}) {
            const auto [shot, D] = shot_of(one, speed);
            const Layout layout = one_view(Planar{.fov_y_deg = shrunk(one.fov_deg, D)}, {96, 72});
            OffscreenRenderer met(device(), pipelines(), s.gpu, layout, test_quality(), true);
            OffscreenRenderer in_turn(device(), pipelines(), gpu, layout, test_quality(), true);
            const Numbers a(met, shot), b(in_turn, shot);
            int lit = 0, differ = 0;
            for (int i = 0; i < a.count(); ++i) {
                const bool same_depth = a.depth(i) == b.depth(i) || (std::isinf(a.depth(i)) && std::isinf(b.depth(i)));
                lit += a.light(i) != dvec3(0), differ += a.light(i) != b.light(i) || !same_depth;
            }
            EXPECT_GT(lit, 20) << one.name << ", " << speed.name;
            EXPECT_EQ(differ, 0) << one.name << ", " << speed.name;
            EXPECT_EQ(met.picture(shot)[0], in_turn.picture(shot)[0]) << one.name << ", " << speed.name;
        }
    const auto made = pipelines().made();
    EXPECT_TRUE(std::ranges::any_of(
        made, [](const auto& one) { return describe(one.first).find("each_globe") != std::string::npos; }));
}

/// The two wrong pictures, and the right one without each effect.
TEST(Globes, LightIsThatOfTheRaysWithOtherEffects)
{
    const std::vector<Subject> all = subjects();
    const auto subject
        = std::find_if(all.begin(), all.end(), [](const Subject& one) { return one.name == std::string("Jupiter"); });
    struct Case {
        const char* name;
        Effects effects;
    };
    Effects galilean, now, false_colours;
    galilean.comparison = Comparison::galilean, now.comparison = Comparison::no_light_delay,
    false_colours.on.set(Effect::false_colours);
    for (const Case& one : {Case{"galilean", galilean}, {"without light delay", now}, {"in false colours", false_colours},
             {"without aberration", Effects().without(Effect::aberration)},
             {"without headlight effect", Effects().without(Effect::headlight)}}) {
        const std::string name = std::string("Jupiter at 0.5 c ") + one.name;
        Taken taken = shot_of(*subject, speeds[1]);
        taken.shot.effects = one.effects;
        if (!one.effects[Effect::aberration])
            taken.shot.ship_from_cockpit = orientation(subject->look, {0, 1, 0});
        expect_close(compare(one_view(Planar{.fov_y_deg = 50}, {96, 72}), taken.shot, 4, name), *subject, speeds[1], name);
    }
}

// ---------------------------------------------------------------- against published numbers

namespace {

/// The solar system with other globes, on the device and for rays.
struct Changed {
    ReferenceWorld rays;
    GpuWorld gpu;
    explicit Changed(const std::function<void(SolarSystem&)>& change)
        : rays(open_reference_world(scene_file()))
    {
        auto globes = std::make_shared<Globes>(*rays.world.globes);
        change(globes->system);
        rays.world.globes = globes;
        rays.stars.clear();
        LoadedScene loaded = load_scene(scene_file());
        loaded.world.globes = globes;
        gpu = upload(device(), pipelines(), std::move(loaded.world), loaded.scene, {});
    }
};

double luminance(const dvec3& rgb)
{
    static const dmat3 xyz_from_rec709 = glm::inverse(rec709_from_sunlit_xyz());
    return (xyz_from_rec709 * rgb).y;
}

dvec3 light_of(const Reference& truth, int i)
{
    return (truth.light[0][std::size_t(i)] - truth.numbers[std::size_t(i)].glare) / truth.exposure;
}

} // namespace

/// V(1, 0), the magnitude at one astronomical unit from the Sun and from the eye at full phase, from the light of the disc.
TEST(Globes, WholeDiscsHaveThePublishedMagnitudes)
{
    // The eye's luminance has its middle nearer to red than V: Mars seems 0.06 brighter by it, Neptune 0.07 fainter. The
    // data's geometric albedos alone give Mercury -0.684 and Neptune -6.95. Mallama and Hilton 2018; the Moon: Allen's
    // Astrophysical Quantities; the Sun: Willmer 2018.
    struct Body {
        const char* name;
        double published, tolerance;
        double time = later;
        int turns = 1; ///< sides that its mean is taken over
    };
    constexpr double sun = -26.74, far = 100; // radii
    constexpr double full_moon = 44.96 * 86400; // 26 September 2026: the near side is sunlit
    const Changed bare([](SolarSystem& system) {
        for (Globe& globe : system.globes)
            globe.ring.reset();
    });
    for (const Body& body : {Body{"Sun", sun, 0.01}, {"Mercury", -0.613, 0.1, later, 4}, {"Venus", -4.384, 0.1},
             {"Moon", 0.21, 0.1, full_moon}, {"Mars", -1.601, 0.15, later, 4}, {"Jupiter", -9.395, 0.1},
             {"Saturn", -8.95, 0.1}, {"Uranus", -7.110, 0.1}, {"Neptune", -7.00, 0.15}}) {
        const Solar& s = solar();
        const bool is_sun = std::string(body.name) == "Sun";
        const double distance = far * s.radius(body.name), fov = 2 * std::atan(1.25 / far) / degree;
        const Layout layout = one_view(Planar{.fov_y_deg = fov}, {96, 96});
        OffscreenRenderer live(device(), pipelines(), bare.gpu, layout, test_quality(), true);
        const double pixel_sr = std::pow(2 * std::tan(0.5 * fov * degree) / 96, 2), au = astronomical_unit_m / s.unit_m();
        double live_flux = 0, rays_flux = 0;
        for (int turn = 0; turn < body.turns; ++turn) {
            const double day = std::abs(360 / s.globe(body.name).rotation.meridian_deg_per_day) * 86400;
            const double time = body.time + day * turn / body.turns;
            const dvec3 from = is_sun ? s.pole("Sun") : s.to_sun(body.name, time);
            Shot shot = shot_at(s.place(body.name, time) + from * distance, dvec3(0), -from,
                std::abs(from.y) > 0.9 ? dvec3(0, 0, 1) : dvec3(0, 1, 0));
            shot.effects = {};
            shot.time = time;
            const double sun_au = is_sun ? 1 : glm::length(s.place(body.name, time) - s.place("Sun", time)) / au;
            const Numbers numbers(live, shot);
            const Reference truth = reference(bare.rays.input(), layout, shot, 0, {.samples = 16});
            const double weight = pixel_sr * sun_au * sun_au / body.turns;
            for (int i = 0; i < numbers.count(); ++i)
                live_flux += luminance(numbers.light(i)) * weight, rays_flux += luminance(light_of(truth, i)) * weight;
        }
        const auto magnitude = [&](double flux) { return sun - 2.5 * std::log10(flux * std::pow(distance / au, 2) / pi); };
        std::printf("%-8s V(1, 0) %.3f live, %.3f by rays, %.3f published: %+.3f\n", body.name, magnitude(live_flux),
            magnitude(rays_flux), body.published, magnitude(rays_flux) - body.published);
        EXPECT_NEAR(magnitude(rays_flux), body.published, body.tolerance) << body.name;
        EXPECT_NEAR(magnitude(live_flux), magnitude(rays_flux), 0.02) << body.name;
    }
}

// Airglow by night, against van Rhijn's law of an even layer and Kasten and Young's formula for the air below it, and from
// space against the length of a chord.
TEST(Globes, AirglowGrowsTowardsTheHorizon)
{
    const Solar& s = solar();
    const Globe& globe = s.globe("Earth");
    const Glow& glow = globe.air->glows.front();
    ASSERT_FALSE(glow.aurora);
    const dvec3 up = glm::normalize(s.on_earth(5, 20)), middle = s.place("Earth");
    ASSERT_LT(glm::dot(up, s.to_sun("Earth")), -0.8) << "it should be night";
    const dvec3 side = glm::normalize(glm::cross(up, s.pole("Earth")));
    const Changed bare([](SolarSystem& system) {
        for (Globe& one : system.globes)
            if (one.air)
                one.air->glows.clear();
    });
    // Less the light of the sky behind.
    const auto luminance_towards = [&](const dvec3& eye, const dvec3& look, double fov_deg) {
        Shot shot = shot_at(eye, dvec3(0), look, std::abs(look.y) > 0.9 ? dvec3(0, 0, 1) : dvec3(0, 1, 0));
        shot.effects = {}, shot.time = later, shot.exposure_ev = 25;
        const Layout layout = one_view(Planar{.fov_y_deg = fov_deg}, {16, 16});
        double sum = 0;
        for (const auto& [world, sign] : {std::pair(&solar().gpu, 1.0), {&bare.gpu, -1.0}}) {
            OffscreenRenderer live(device(), pipelines(), *world, layout, test_quality(), true);
            const Numbers numbers(live, shot);
            for (int i = 0; i < numbers.count(); ++i)
                sum += sign * luminance(numbers.light(i)) / numbers.count();
        }
        return sum;
    };
    // The Earth's ball at this latitude, near the equator: its place here and the globe's radius differ by 0.2 km.
    const dvec3 ground = middle + s.on_earth(5, 20) * s.radius("Earth") * (1 + 1 / 6378e3);
    for (const double zenith_deg : {0.0, 40.0, 60.0, 75.0, 85.0}) {
        const double sine = std::sin(zenith_deg * degree) / (1 + 0.5 * (glow.from_m + glow.to_m) / globe.radius_m);
        const double van_rhijn = 1 / std::sqrt(1 - sine * sine);
        const double mass = 1 / (std::cos(zenith_deg * degree) + 0.50572 * std::pow(96.07995 - zenith_deg, -1.6364));
        const double right = glow.zenith * van_rhijn * std::exp(-0.0973 * mass);
        const double seen = luminance_towards(ground, tilted(up, side, zenith_deg), 0.05);
        std::printf("airglow at %2.0f degrees from the zenith: %.4g, %.4g by van Rhijn: %+.2f %%\n", zenith_deg, seen, right,
            100 * (seen / right - 1));
        EXPECT_NEAR(seen / right, 1, zenith_deg < 80 ? 0.01 : 0.03);
    }
    // From two radii, past the ground at the layer's lower side, where nearly no air is in the way.
    const double a = globe.radius_m + glow.from_m, b = globe.radius_m + glow.to_m, lowest = a - 0.1 * (b - a);
    const double chord = 2 * (std::sqrt(b * b - lowest * lowest) - std::sqrt(a * a - lowest * lowest));
    const double right = glow.zenith * chord / (b - a), off = std::asin(lowest / (2 * globe.radius_m)) / degree;
    const double seen = luminance_towards(middle + up * 2.0 * s.radius("Earth"), tilted(-up, side, off), 0.0005);
    std::printf("airglow past the limb: %.4g, %.4g by its chord: %+.2f %%\n", seen, right, 100 * (seen / right - 1));
    EXPECT_NEAR(seen / right, 1, 0.02);
}

TEST(Globes, TheSunIsDarkerAtItsLimb)
{
    // At one wavelength, from the reference's spectra. Allen's Astrophysical Quantities, 4th ed., 550 nm:
    // 1 - u - v + u mu + v mu^2 with u = 0.93, v = -0.23, rounded to two digits.
    StandardObserver at_550 = eye();
    at_550.samples = {{550, 1, dvec3(1)}};
    const GlobeColours colours(*solar().rays.world.globes, at_550);
    const auto one = [&](double mu) {
        std::vector<GlobeColours::Term> terms;
        for (int k = 0; k < 6; ++k)
            terms.push_back({GlobeColours::sun + k, std::pow(mu, k), 0});
        return glm::length(colours.seen(terms, 1));
    };
    // The picture's luminance has its middle near 560 nm, and its width.
    const Solar& s = solar();
    const dvec3 north = s.pole("Sun");
    const double distance = 200 * s.radius("Sun");
    Shot shot
        = shot_at(s.place("Sun") + north * distance, dvec3(0), -north, glm::normalize(glm::cross(north, dvec3(1, 0, 0))));
    shot.effects = {};
    shot.time = later;
    const double fov = 2 * std::atan(1.1 / 200) / degree;
    const Layout layout = one_view(Planar{.fov_y_deg = fov}, {201, 201});
    OffscreenRenderer live(device(), pipelines(), s.gpu, layout, test_quality(), true);
    const Numbers numbers(live, shot);
    const Reference truth = reference(s.rays.input(), layout, shot, 0, {.samples = 4});
    const dvec3 middle = glm::normalize(s.place("Sun") - shot.position);
    std::map<double, dvec3> sums; ///< by radius: live, rays, count
    for (int i = 0; i < numbers.count(); ++i) {
        const double r = std::sin(between(truth.numbers[std::size_t(i)].world, middle)) * 200;
        for (const double at : {0.0, 0.5, 0.9})
            if (std::abs(r - at) < 0.012)
                sums[at] += dvec3(luminance(numbers.light(i)), luminance(light_of(truth, i)), 1);
    }
    for (const double r : {0.5, 0.9}) {
        const double mu = std::sqrt(1 - r * r), published = 1 - 0.93 + 0.23 + 0.93 * mu - 0.23 * mu * mu;
        const double by_live = sums[r].x / sums[r].z / (sums[0].x / sums[0].z),
                     by_rays = sums[r].y / sums[r].z / (sums[0].y / sums[0].z);
        std::printf("%.1f radii: 550 nm %.4f (Allen %.4f); luminance live %.4f, by rays %.4f\n", r, one(mu) / one(1),
            published, by_live, by_rays);
        EXPECT_NEAR(one(mu) / one(1), published, 0.01) << r;
        EXPECT_NEAR(by_live, by_rays, 0.002) << r;
        EXPECT_NEAR(by_live, one(mu) / one(1), 0.02) << r;
    }
}

/// The middle of the Moon's shadow at the greatest eclipse of 12 August 2026, from the light that the Moon takes.
TEST(Globes, TheMoonsShadowFallsWhereItWasPredicted)
{
    const Solar& s = solar();
    // A Moon a little too small leaves a ring of the Sun, so that the light has a sharp least; thin air sees the ground's
    // shadow.
    const auto thin = [](SolarSystem& system, double moon) {
        for (Globe& globe : system.globes) {
            if (globe.moon)
                globe.radius_m *= moon;
            if (globe.air)
                globe.air->scale_height_m = 10;
        }
    };
    const Changed small([&](SolarSystem&system) { thin(system, 0.965); }),
        bright([&](SolarSystem&system) { thin(system, 1e-6); });
    const dvec3 ground = s.on_earth(65.2, -25.2, 0) * s.radius("Earth");
    const dvec3 eye = s.place("Earth", 0) + ground * 2.2;
    Shot shot = shot_at(eye, dvec3(0), s.place("Earth", 0) + ground - eye, dvec3(0, 1, 0));
    shot.effects = {};
    const Layout layout = one_view(Planar{.fov_y_deg = 14}, {144, 108});
    OffscreenRenderer dark(device(), pipelines(), small.gpu, layout, test_quality(), true),
        lit(device(), pipelines(), bright.gpu, layout, test_quality(), true);
    const Numbers with(dark, shot), without(lit, shot);
    const Reference rays_with = reference(small.rays.input(), layout, shot, 0, {.samples = 1});
    const Reference rays_without = reference(bright.rays.input(), layout, shot, 0, {.samples = 1});
    const dmat3 own = globe_turn(s.globe("Earth"), s.origin.days - 1.2 * s.radius("Earth") / 86400)
        * glm::transpose(s.world_from_equatorial);
    std::vector<dvec3> places;
    std::vector<double> left[2];
    for (int i = 0; i < with.count(); ++i) {
        const Reference::Numbers& n = rays_with.numbers[std::size_t(i)];
        if (std::isinf(n.distance))
            continue;
        places.push_back(own * (eye + n.world * n.distance - s.place("Earth", 0)));
        left[0].push_back(with.light(i).r / without.light(i).r); // red light, of which air scatters least
        left[1].push_back(light_of(rays_with, i).r / light_of(rays_without, i).r);
    }
    dvec3 sums[2] = {dvec3(0), dvec3(0)};
    for (int k = 0; k < 2; ++k) {
        const double limit = quantile(left[k], 0.01);
        std::printf("least light %.3f\n", *std::min_element(left[k].begin(), left[k].end()));
        for (std::size_t i = 0; i < places.size(); ++i)
            if (left[k][i] < limit)
                sums[k] += places[i] * (limit - left[k][i]);
    }
    for (int k = 0; k < 2; ++k) {
        // Geographic latitude, by the spheroid's normal.
        const double f = s.globe("Earth").flattening;
        const dvec3 normal = sums[k] * dvec3(1, 1, 1 / ((1 - f) * (1 - f)));
        const double latitude = std::atan2(normal.z, std::hypot(normal.x, normal.y)) / degree,
                     longitude = std::atan2(normal.y, normal.x) / degree;
        const double off = between(sums[k], own * (ground)) / degree;
        std::printf("%s: %.2f N %.2f W, %.2f degrees from the published middle\n", k == 0 ? "live" : "rays", latitude,
            -longitude, off);
        // A tenth of the limit is the ephemeris; low sunlight draws the shadow out along the ground.
        EXPECT_LT(off, 0.5);
    }
}

/// A planet that comes nearer grows from a spot to a disc: its light grows as the square of its size, without a jump.
TEST(Globes, ASpotBecomesADiscWithoutAChangeOfLight)
{
    const Solar& s = solar();
    const double fov = 10, pixel = 2 * std::tan(5 * degree) / 96;
    const Layout layout = one_view(Planar{.fov_y_deg = fov}, {96, 96});
    OffscreenRenderer live(device(), pipelines(), s.gpu, layout, test_quality(), true);
    for (const std::string name : {"Mars", "Venus", "Sun"}) {
        const dvec3 from = name == "Sun" ? dvec3(1, 0, 0) : tilted(s.to_sun(name), s.pole("Earth"), 30);
        for (const double pixels : {0.3, 0.8, 1.0, 1.2, 1.4, 1.6, 2.0, 3.0}) {
            double all_live = 0, all_rays = 0, least = INFINITY, most = 0;
            for (int place = 0; place < 9; ++place) {
                // Nine places between pixels.
                const dvec3 right = glm::normalize(glm::cross(from, s.pole("Earth"))), up = glm::cross(right, from);
                const dvec3 look
                    = glm::normalize(-from + (right * (place % 3 / 3.0 + 0.1) + up * (place / 3 / 3.0 + 0.1)) * pixel);
                Shot shot = shot_at(s.place(name) + from * s.radius(name) / (pixels * pixel), dvec3(0), look);
                shot.effects = {};
                shot.time = later;
                const Numbers numbers(live, shot);
                double by_live = 0;
                for (int i = 0; i < numbers.count(); ++i)
                    by_live += luminance(numbers.light(i));
                all_live += by_live / 9, least = std::min(least, by_live), most = std::max(most, by_live);
                if (place > 0)
                    continue;
                const Reference truth = reference(s.rays.input(), layout, shot, 0, {.samples = 256});
                for (int i = 0; i < numbers.count(); ++i)
                    all_rays += luminance(light_of(truth, i));
            }
            const double white = pi * pixels * pixels;
            std::printf("%s, %.1f pixels: light of a white disc times %.4f live (%.4f to %.4f between pixels), %.4f by "
                        "rays: %+.1f %%\n",
                name.c_str(), pixels, all_live / white, least / white, most / white, all_rays / white,
                100 * (all_live / all_rays - 1));
            EXPECT_NEAR(all_live / all_rays, 1, 0.03) << name << pixels;
            EXPECT_LT(most / least, 1.05) << name << pixels;
        }
    }
}

} // namespace starbow::gpu_test::globes_gpu_test
