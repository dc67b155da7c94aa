// The globes in the live picture against rays in double, which share no code with it but the ephemeris: light, distances and
// shown pictures at rest and in flight, on several displays. Then the light of whole discs against published magnitudes, the
// Sun's limb and the Moon's shadow.
#include "config/model/angles.h"
#include "runtime/images/picture_errors.h"
#include "runtime/light/colour.h"
#include "runtime/light/spectrum.h"
#include "runtime/reference/globes.h"
#include "runtime/reference/reference.h"
#include "tests/support/gpu_environment.h"
#include <map>

namespace starbow::gpu_test::globes_gpu_test {
namespace {

std::filesystem::path scene_file()
{
    const auto at = testing::source_dir() / "config/scenes/solar-system.json";
    return std::filesystem::exists(at) ? at : testing::source_dir() / "scenes/solar-system/solar-system.json";
}

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
    dvec3 place(const std::string& name, double time = 0) const
    {
        return world_from_equatorial
            * ((globe_places_m(system(), origin.days + time / 86400)[index_of(name)] - origin.at(time)) / unit_m());
    }
    dvec3 to_sun(const std::string& name) const { return glm::normalize(-place(name) + place("Sun")); }
    dvec3 pole(const std::string& name) const
    {
        return world_from_equatorial * (glm::transpose(globe_turn(globe(name), origin.days)) * dvec3(0, 0, 1));
    }
    /// A unit direction of the Earth's ground.
    dvec3 on_earth(double latitude_deg, double longitude_deg) const
    {
        const double a = latitude_deg * degree, b = longitude_deg * degree;
        return world_from_equatorial
            * (glm::transpose(globe_turn(globe("Earth"), origin.days))
                * dvec3(std::cos(a) * std::cos(b), std::cos(a) * std::sin(b), std::sin(a)));
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
    double fov_deg;
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
        all.push_back({height_km > 100 ? "the limb from 400 km" : "the limb from 10 km", morning * earth * (up + 0.0005),
            tilted(glm::normalize(glm::cross(morning, north)), -morning, dip), height_km > 100 ? 30.0 : 20.0});
    }
    const dvec3 asia = s.on_earth(25, 95);
    before("cities at night", "Earth", asia, 1.6, 60);
    before("the Moon", "Moon", tilted(s.to_sun("Moon"), north, 50), 8, 18);
    const dvec3 pole = s.pole("Saturn"), saturn_sun = s.to_sun("Saturn");
    const double side = glm::dot(pole, saturn_sun) > 0 ? 1 : -1;
    const dvec3 level = glm::normalize(saturn_sun - pole * glm::dot(pole, saturn_sun));
    const dvec3 saturn_aside = glm::normalize(level + 0.7 * glm::cross(pole, level));
    before("Saturn's sunlit rings", "Saturn", tilted(saturn_aside, pole * side, 25), 8, 36);
    before("Saturn's dark rings", "Saturn", tilted(saturn_aside, -pole * side, 25), 8, 36);
    before("Jupiter", "Jupiter", tilted(s.to_sun("Jupiter"), s.pole("Jupiter"), 35), 6, 26);
    before("the Sun", "Sun", north, 30, 5);
    for (const double pixels : {0.5, 1.2, 3.0}) {
        // 72 pixels of 0.5 degrees each are 36 degrees; radians of a radius at the middle.
        const double pixel = 2 * std::tan(5 * degree) / 72;
        before(pixels < 1    ? "a small Mars of 0.5 pixels"
                : pixels < 2 ? "a small Mars of 1.2 pixels"
                             : "a small Mars of 3 pixels",
            "Mars", tilted(s.to_sun("Mars"), north, 30), 1 / (pixels * pixel), 10);
    }
    const dvec3 shadow = s.on_earth(65.2, -25.2);
    all.push_back({"the Moon's shadow", tilted(shadow, sun, 30) * 2.5 * earth, glm::dvec3(0), 30});
    all.back().look = glm::normalize(shadow * earth - all.back().eye);
    return all;
}

struct Speed {
    const char* name;
    double gamma;
    double aside_deg; ///< of the motion from the look in the world
};
constexpr Speed speeds[]
    = {{"at rest", 1, 0}, {"at 0.5 c", 1.1547005383792517, 35}, {"at gamma 4 ahead", 4, 0}, {"at gamma 4 astern", 4, 180}};

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
    shot.effects = {true, true, true};
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
    int wrong = 0, shown_count = 0;
    for (int i = 0; i < numbers.count(); ++i) {
        if (!numbers.shown(i) || !truth.numbers[std::size_t(i)].shown)
            continue;
        ++shown_count;
        const Reference::Numbers& n = truth.numbers[std::size_t(i)];
        wrong += std::isinf(n.distance) ? !std::isinf(numbers.depth(i))
                                        : !(std::abs(numbers.depth(i) / n.distance - 1) < 1e-3);
        out.D = std::max(out.D, std::abs(numbers.D(i) / n.D - 1));
        all_live += numbers.light(i), all_rays += rays(i);
        const int x = i % numbers.size.x, y = i / numbers.size.x;
        if (x < 1 || y < 1 || x + 1 >= numbers.size.x || y + 1 >= numbers.size.y)
            continue;
        const double here = glm::length(rays(i));
        double spread = 0;
        for (const int j : {i - 1, i + 1, i - numbers.size.x, i + numbers.size.x})
            spread = std::max(spread, glm::length(rays(j) - rays(i)));
        if (here < 3e-3 * top || spread > rough * here)
            continue;
        const double error = glm::length(numbers.light(i) - rays(i)) / here;
        off.push_back(error);
        if (error > out.most)
            out.most = error, out.where = {x, y}, out.live = numbers.light(i), out.rays = rays(i);
    }
    out.smooth = int(off.size());
    out.mean = bright(all_live) / bright(all_rays) - 1;
    out.median = quantile(off, 0.5);
    out.distances = double(wrong) / shown_count;
    const auto picture = live.picture(shot)[0];
    const auto right = shown(truth);
    out.psnr = psnr_dB({truth.size, picture}, {truth.size, right});
    std::printf(
        "%-52s light %+.2f %%; smooth %5d: median %.2f %%, worst %.2f %% at %d, %d: (%.4g %.4g %.4g) for (%.4g %.4g %.4g); "
        "distances off %.2f %%, D %.1e, %.1f dB, EV %.1f\n",
        name.c_str(), 100 * out.mean, out.smooth, 100 * out.median, 100 * out.most, out.where.x, out.where.y, out.live.r,
        out.live.g, out.live.b, out.rays.r, out.rays.g, out.rays.b, 100 * out.distances, out.D, out.psnr, shot.exposure_ev);
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

bool chosen(const std::string& name)
{
    const char* only = std::getenv("STARBOW_GLOBES_ONLY");
    return !only || name.find(only) != std::string::npos;
}

} // namespace

TEST(Globes, LightIsThatOfTheRaysOnADesk)
{
    for (const Subject& subject : subjects())
        for (const Speed& speed : speeds) {
            const std::string name = std::string(subject.name) + ", " + speed.name;
            if (!chosen(name))
                continue;
            const Taken taken = shot_of(subject, speed);
            const Layout layout = one_view(Planar{.fov_y_deg = shrunk(subject.fov_deg, taken.D)}, {96, 72});
            compare(layout, taken.shot, 4, name);
        }
}

} // namespace starbow::gpu_test::globes_gpu_test
