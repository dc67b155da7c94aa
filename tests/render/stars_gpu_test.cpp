// The stars in the picture on every kind of display: their places, a point's brightness and size at any speed, and objects
// that hide them.
#include "config/model/angles.h"
#include "runtime/light/colour.h"
#include "runtime/light/spectrum.h"
#include "runtime/reference/reference.h"
#include "tests/support/effects.h"
#include "tests/support/planck.h"
#include "tests/support/small_world.h"
#include <glm/gtx/quaternion.hpp>
#include <map>
#include <random>

namespace starbow::gpu_test::stars_gpu_test {
namespace {

constexpr double arcmin2_sr = degree * degree / 3600;
constexpr double brightness_arcmin2 = 1e4;

/// A world with a black sky, stars, and one small square at `square`, whose front faces +z; it is red by default.
GpuWorld sky_world(const std::string& name, const dvec3& square = {0, -50, 0}, double half = 0.1,
    const std::string& catalogue = "", const dvec2& ahead_deg = {0, 0}, const dvec3& colour = {1, 0, 0})
{
    Doc doc;
    quad(doc, square, {half, 0, 0}, {0, half, 0}, unlit(doc, colour));
    const auto one = testing::write_text("one_star.txt", "0 0 0 65 -\n");
    return open_world(name, doc,
        {{"stars",
            {{"catalogue", catalogue.empty() ? one.string() : catalogue}, {"brightness_arcmin2", brightness_arcmin2},
                {"ahead_deg", {ahead_deg.x, ahead_deg.y}}}}});
}

/// A star of magnitude 0 in the world's direction n, if ahead_deg is 0, 0.
Star star_at(const dvec3& n, double temperature_K = 5772)
{
    return {glm::transpose(world_from_equatorial({0, 0})) * glm::normalize(n), 0, temperature_K};
}

/// Each pixel's solid angle in steradians, from the directions of its neighbours; 0 at the picture's edges.
std::vector<double> solid_angles(const Numbers& numbers)
{
    std::vector<double> all(numbers.count(), 0);
    const ivec2 size = numbers.size;
    for (int y = 1; y + 1 < size.y; ++y)
        for (int x = 1; x + 1 < size.x; ++x) {
            const int i = y * size.x + x;
            if (!numbers.shown(i) || !numbers.shown(i - 1) || !numbers.shown(i + 1) || !numbers.shown(i - size.x)
                || !numbers.shown(i + size.x))
                continue;
            const dvec3 right = numbers.camera(i + 1) - numbers.camera(i - 1),
                        down = numbers.camera(i + size.x) - numbers.camera(i - size.x);
            if (glm::length(right) < 0.1) // larger steps are seams in the picture
                all[i] = 0.25 * glm::length(glm::cross(right, down));
        }
    return all;
}

/// All light of a picture by channel, and its mean direction from the ship.
struct Sum {
    dvec3 light{0}, middle{0};
    int pixels = 0;
};
Sum sum_of(const Numbers& numbers)
{
    Sum sum;
    const std::vector<double> solid = solid_angles(numbers);
    for (int i = 0; i < numbers.count(); ++i)
        if (const dvec3 light = numbers.light(i); numbers.shown(i) && light != dvec3(0)) {
            sum.light += light * solid[i];
            sum.middle += light.g * solid[i] * numbers.camera(i);
            ++sum.pixels;
        }
    sum.middle = glm::normalize(sum.middle);
    return sum;
}

/// Converts the picture's light, which is for an eye adapted to the Sun, back to XYZ.
dvec3 xyz_of(const dvec3& rgb)
{
    static const dmat3 xyz_from_rec709 = glm::inverse(rec709_from_sunlit_xyz());
    return xyz_from_rec709 * rgb;
}

double luminance(const dvec3& rgb) { return xyz_of(rgb).y; }

dvec2 chromaticity_of(const dvec3& rgb)
{
    const dvec3 xyz = xyz_of(rgb);
    return dvec2(xyz) / (xyz.x + xyz.y + xyz.z);
}

/// The direction in which an observer with the proper velocity u sees the world's direction n: a boost of the light's
/// 4-vector, whose time component is the frequency.
dvec3 seen(const dvec3& n, const dvec3& u)
{
    const double gamma = std::sqrt(1 + glm::dot(u, u)), D = gamma + glm::dot(u, n);
    return glm::normalize((n + u + u * (glm::dot(u, n) / (gamma + 1))) / D);
}

const std::map<std::string, Projection> displays
    = {{"planar", Planar{80}}, {"fisheye", Fisheye{180, 30}}, {"cylinder", Cylinder{}},
        {"equirectangular", Equirectangular{}}, {"cube", CubeFaces{}}, {"lens", [] {
                                                                            Lens lens;
                                                                            lens.colours[0].k = {0.10, 0.02, 0, 0};
                                                                            lens.colours[1].k = {0.12, 0.02, 0, 0};
                                                                            lens.colours[2].k = {0.14, 0.02, 0, 0};
                                                                            return lens;
                                                                        }()}};

/// The size at which a display's pixels are about square.
ivec2 size_for(const std::string& display)
{
    return display == "equirectangular" ? ivec2(480, 240)
        : display == "cylinder"         ? ivec2(480, 153)
        : display == "cube"             ? ivec2(1200, 200)
                                        : ivec2(300, 300);
}

// ---------------------------------------------------------------- constellations

struct Place {
    double hours, minutes, seconds;
    double degrees, arcmin, arcsec; ///< of declination, with its sign on all three
    dvec3 direction() const
    {
        return equatorial(15 * (hours + minutes / 60 + seconds / 3600), degrees + arcmin / 60 + arcsec / 3600);
    }
};

// The two brightest spots, by their mean directions. The expected angles come from the Hipparcos J2000 places.
TEST(Stars, KnownPairsHaveTheirSeparation)
{
    struct Pair {
        const char* name;
        Place a, b;
        double apart_deg; ///< the textbook's separation
    };
    for (const Pair& pair : {Pair{"Betelgeuse, Rigel", {5, 55, 10.31, 7, 24, 25.4}, {5, 14, 32.27, -8, -12, -5.9}, 18.6},
             Pair{"Dubhe, Merak", {11, 3, 43.67, 61, 45, 3.7}, {11, 1, 50.48, 56, 22, 56.7}, 5.4},
             Pair{"Castor, Pollux", {7, 34, 35.87, 31, 53, 17.8}, {7, 45, 18.95, 28, 1, 34.3}, 4.5}}) {
        const dvec3 a = pair.a.direction(), b = pair.b.direction(), middle = glm::normalize(a + b);
        const dvec2 ahead(std::fmod(std::atan2(middle.y, middle.x) / degree + 360, 360), std::asin(middle.z) / degree);
        GpuWorld world = sky_world(
            "constellation", {0, -50, 0}, 0.1, absolute(testing::source_dir() / "scenes/stars/stars.txt").string(), ahead);
        const double fov = pair.apart_deg * 1.3;
        OffscreenRenderer offscreen = renderer(world, one_view(Planar{fov}, {300, 300}));
        const Numbers numbers(offscreen, shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1}));
        std::vector<dvec3> found;
        std::vector<bool> taken(numbers.count());
        for (int star = 0; star < 2; ++star) {
            int best = 0;
            for (int i = 0; i < numbers.count(); ++i)
                if (!taken[i] && numbers.light(i).g > numbers.light(best).g * !taken[best])
                    best = i;
            dvec3 sum(0);
            for (int i = 0; i < numbers.count(); ++i)
                if (glm::length(numbers.centre(i) - numbers.centre(best)) < 6) {
                    taken[i] = true;
                    sum += numbers.light(i).g * numbers.camera(i);
                }
            found.push_back(glm::normalize(sum));
        }
        const double pixel = fov / 300, measured = between(found[0], found[1]) / degree, expected = between(a, b) / degree;
        std::printf("  %s: %.3f degrees, known %.3f, a pixel is %.3f\n", pair.name, measured, expected, pixel);
        EXPECT_NEAR(expected, pair.apart_deg, 0.06);
        EXPECT_NEAR(measured, expected, pixel);
        // The picture is not mirrored: east (greater right ascension) is on the left.
        const double east = pair.a.hours * 60 + pair.a.minutes - pair.b.hours * 60 - pair.b.minutes;
        const dvec3 at_a = world_from_equatorial(ahead) * a;
        const dvec3& found_a = glm::distance(found[0], at_a) < glm::distance(found[1], at_a) ? found[0] : found[1];
        const dvec3& found_b = &found_a == &found[0] ? found[1] : found[0];
        EXPECT_LT(between(found_a, at_a) / degree, pixel);
        EXPECT_LT((found_a.x - found_b.x) * east, 0);
    }
}

// ---------------------------------------------------------------- one star in any direction

// In every display and at every speed a star lies where the boost of a 4-vector puts it, with the same light on the same few
// pixels.
TEST(Stars, AStarKeepsItsLightAndSizeAtEverySpeedOnEveryDisplay)
{
    const dvec3 n(0, 0, -1);
    GpuWorld world = sky_world("single");
    put_stars(world, {star_at(n)});
    std::mt19937 random(3);
    std::uniform_real_distribution<double> one(-1, 1);
    const int tries = starbow::testing::all_cases() ? 6 : 3;
    for (const auto& [name, projection] : displays) {
        OffscreenRenderer offscreen = renderer(world, one_view(projection, size_for(name)));
        int drawn = 0, most = 0;
        double off = 0, low = 1e9, high = 0;
        for (double gamma : {1.0, 1.5, 4.0, 100.0})
            for (int i = 0; i < tries; ++i) {
                // The cockpit is turned so that the star may be anywhere in the picture.
                const dvec3 u = u_of_gamma(gamma) * glm::normalize(dvec3(one(random), one(random), one(random)));
                const dvec3 expected = seen(n, u), way(0.5 * one(random), 0.4 * one(random) + 0.1, -1);
                Shot shot = shot_at({0, 0, 0}, u, {0, 0, -1});
                shot.ship_from_cockpit = glm::rotation(glm::normalize(way), expected);
                const Numbers numbers(offscreen, shot);
                const Sum sum = sum_of(numbers);
                if (sum.pixels == 0)
                    continue; // the star is where the test knows no solid angle
                ++drawn;
                double pixel = 1; // the least angle between neighbours near the star
                for (int k = 1; k < numbers.count(); ++k)
                    if (numbers.shown(k) && numbers.shown(k - 1) && between(numbers.camera(k), expected) < 3 * degree)
                        pixel = std::min(pixel, between(numbers.camera(k), numbers.camera(k - 1)));
                // Without the headlight effect a radiance stays; the solid angle shrinks by D^2.
                const double D = gamma + glm::dot(u, n),
                             light = luminance(sum.light) / (brightness_arcmin2 * arcmin2_sr) * (D * D);
                off = std::max(off, between(sum.middle, expected) / pixel);
                low = std::min(low, light), high = std::max(high, light);
                most = std::max(most, sum.pixels);
            }
        std::printf("  %-16s %d drawn, off by %.3f pixels at most, light %.4f to %.4f, at most %d pixels\n", name.c_str(),
            drawn, off, low, high, most);
        EXPECT_GE(drawn, 4 * tries - 2);
        EXPECT_LT(off, 0.1);
        // 1 % is required; the spot's own error is half of it. For the lens, solid angles of green serve for all three
        // channels.
        const double tolerance = name == "lens" ? 0.02 : 0.01;
        EXPECT_GT(low, 1 - tolerance);
        EXPECT_LT(high, 1 + tolerance);
        EXPECT_LE(most, name == "lens" ? 40 : 16); // a disc 4 pixels wide
    }
}

// A star that drifts over the pixels in small steps must not flicker.
TEST(Stars, LightIsTheSameAnywhereBetweenPixels)
{
    GpuWorld world = sky_world("drifting");
    put_stars(world, {star_at({0, 0, -1})});
    OffscreenRenderer offscreen = renderer(world, one_view(Planar{20}, {64, 64}));
    double low = 1e9, high = 0;
    for (int step = 0; step < 64; ++step) {
        const double pixel = 2 * std::tan(10 * degree) / 64;
        const dvec3 look(pixel * 0.131 * step, pixel * 0.0713 * step, -1);
        const Sum sum = sum_of(Numbers(offscreen, shot_at({0, 0, 0}, {0, 0, 0}, look)));
        const double light = luminance(sum.light) / (brightness_arcmin2 * arcmin2_sr);
        low = std::min(low, light), high = std::max(high, light);
    }
    std::printf("  light %.4f to %.4f\n", low, high);
    EXPECT_GT(low, 0.99); // required; the spot's sum is right to 0.5 %
    EXPECT_LT(high, 1.01);
}

// ---------------------------------------------------------------- published stars

// Places, magnitudes and B-V of the Bright Star Catalogue (Hoffleit and Warren 1991), which the shipped catalogue was not
// made from. What a picture shows of each: all light about its place, and the colour index of the black body of its colour.
TEST(Stars, BrightStarsHaveTheirPublishedMagnitudesAndColoursInThePicture)
{
    struct Known {
        const char* name;
        double ra_deg, dec_deg, V, b_v;
        bool varies = false;
    };
    const Known known[] = {{"Sirius", 101.287, -16.716, -1.46, 0.00}, {"Canopus", 95.988, -52.696, -0.72, 0.15},
        {"Arcturus", 213.915, 19.182, -0.04, 1.23}, {"Vega", 279.235, 38.784, 0.03, 0.00},
        {"Rigel", 78.634, -8.202, 0.12, -0.03}, {"Procyon", 114.825, 5.225, 0.38, 0.42},
        {"Betelgeuse", 88.793, 7.407, 0.50, 1.85, true}, {"Altair", 297.696, 8.868, 0.77, 0.22},
        {"Aldebaran", 68.980, 16.509, 0.85, 1.54}, {"Spica", 201.298, -11.161, 0.98, -0.23}};
    const auto index_of = [](const dvec2& xy) { // by trying
        double best = 0, least = 1e9;
        for (double b_v = -0.4; b_v < 2.2; b_v += 0.005) {
            const dvec3 xyz = black_body_xyz(temperature_of(b_v));
            const double off = glm::distance(dvec2(xyz) / (xyz.x + xyz.y + xyz.z), xy);
            if (off < least)
                least = off, best = b_v;
        }
        return best;
    };
    for (const Known& star : known) {
        const GpuWorld world = sky_world("published", {0, -50, 0}, 0.1,
            absolute(testing::source_dir() / "scenes/stars/stars.txt").string(), {star.ra_deg, star.dec_deg});
        OffscreenRenderer offscreen = renderer(world, one_view(Planar{2}, {80, 80}));
        const Numbers numbers(offscreen, shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1}));
        const std::vector<double> solid = solid_angles(numbers);
        dvec3 light(0);
        for (int i = 0; i < numbers.count(); ++i)
            if (between(numbers.camera(i), {0, 0, -1}) < 0.1 * degree)
                light += numbers.light(i) * solid[i];
        const double V = -2.5 * std::log10(luminance(light) / (brightness_arcmin2 * arcmin2_sr)),
                     b_v = index_of(chromaticity_of(light));
        std::printf("  %-12s V %5.2f, published %5.2f; B-V %5.2f, published %5.2f\n", star.name, V, star.V, b_v, star.b_v);
        EXPECT_NEAR(V, star.V, star.varies ? 0.2 : 0.11) << star.name; // catalogues differ by as much
        EXPECT_NEAR(b_v, star.b_v, star.varies ? 0.4 : 0.05) << star.name;
    }
}

// ---------------------------------------------------------------- effects of speed

// With evenly spread stars, (1 + beta) / 2 of them appear in the front half of the sky.
TEST(Stars, TheSkyCrowdsAhead)
{
    GpuWorld world = sky_world("even");
    constexpr int count = 4000;
    std::vector<Star> stars;
    for (int i = 0; i < count; ++i) { // a spiral with even steps in height, turning by the golden angle
        const double z = 1 - (2 * i + 1.0) / count, across = std::sqrt(1 - z * z), a = i * pi * (3 - std::sqrt(5.0));
        stars.push_back(star_at({across * std::cos(a), across * std::sin(a), z}));
    }
    put_stars(world, stars);
    OffscreenRenderer offscreen = renderer(world, one_view(Fisheye{180, 90}, {400, 400}));
    for (double gamma : {1.0, 2.0, 4.0, 10.0}) {
        const Numbers numbers(offscreen, shot_at({0, 0, 0}, {0, 0, -u_of_gamma(gamma)}, {0, 0, -1}));
        // Sums light times solid angle; a pixel of an equidistant circle has (90 degrees / 200)^2 sin(a) / a.
        double sum = 0;
        for (int i = 0; i < numbers.count(); ++i)
            if (numbers.shown(i)) {
                const double a = between(numbers.camera(i), {0, 0, -1});
                // A star's solid angle, and with it its light, shrinks by D^2.
                const double D = 1 / (gamma - u_of_gamma(gamma) * -numbers.camera(i).z);
                sum += luminance(numbers.light(i)) * (D * D) * std::pow(pi / 2 / 200, 2) * (a > 0 ? std::sin(a) / a : 1);
            }
        const double beta = u_of_gamma(gamma) / gamma;
        const double share = sum / (count * brightness_arcmin2 * arcmin2_sr);
        std::printf("  gamma %g: %.5f of the sky in the front half, (1 + beta) / 2 = %.5f\n", gamma, share, (1 + beta) / 2);
        EXPECT_NEAR(share, (1 + beta) / 2, 0.004); // the packed pixel angles are off by 0.4 %
    }
}

// A star appears as a black body of temperature D T, with a point's flux.
TEST(Stars, AStarIsABlackBodyAtDT)
{
    GpuWorld world = sky_world("black");
    auto integral = [](double kelvin) {
        dvec3 xyz(0);
        for (double nm = 360.5; nm < 830; ++nm)
            xyz += xyz_response(nm) * planck(nm, kelvin);
        return xyz;
    };
    struct Case {
        double T, D;
    };
    for (const Case& c : {Case{5772, 2.90}, {5772, 10000 / 5772.0}, {2856, 5772 / 2856.0}, {10000, 0.2856}, {5772, 7.872983},
             {3500, 1.001}, {30000, 0.5}, {2300, 1e3}}) {
        put_stars(world, {star_at({0, 0, -1}, c.T)});
        OffscreenRenderer offscreen = renderer(world, one_view(Planar{20}, {64, 64}));
        Shot shot = shot_at({0, 0, 0}, {0, 0, -0.5 * (c.D - 1 / c.D)}, {0, 0, -1});
        shot.effects = {};
        const dvec3 light = sum_of(Numbers(offscreen, shot)).light / (brightness_arcmin2 * arcmin2_sr);
        const dvec2 xy = chromaticity_of(light);
        const dvec3 at_DT = integral(c.D * c.T), at_rest = integral(c.T);
        const dvec2 expected = dvec2(at_DT) / (at_DT.x + at_DT.y + at_DT.z);
        const double growth = at_DT.y / at_rest.y / (c.D * c.D);
        std::printf("  %g K, D %.4g: x %.4f y %.4f (%.4f %.4f), light x %.4g (%.4g)\n", c.T, c.D, xy.x, xy.y, expected.x,
            expected.y, luminance(light), growth);
        EXPECT_LT(glm::length(xy - expected), 0.002); // required accuracy
        EXPECT_NEAR(luminance(light) / growth, 1, 0.01); // the spot's error
        if (c.D == 2.90) {
            EXPECT_NEAR(luminance(light), 2.88, 0.03);
        }
        shot.effects = effects_of(true, true, false); // without the D^3 of a surface's radiance
        EXPECT_NEAR(luminance(sum_of(Numbers(offscreen, shot)).light) / luminance(light * brightness_arcmin2 * arcmin2_sr)
                * (c.D * c.D * c.D),
            1, 1e-5);
        shot.effects = effects_of(true, false, true); // D^3 of the radiance, D^-2 of the solid angle
        EXPECT_NEAR(luminance(sum_of(Numbers(offscreen, shot)).light) / (brightness_arcmin2 * arcmin2_sr) / c.D, 1, 0.01);
    }
}

TEST(Stars, WithoutAberrationStarsStayAndUseTheirPixelsD)
{
    GpuWorld world = sky_world("still");
    const dvec3 n = glm::normalize(dvec3(0.1, 0.05, -1));
    put_stars(world, {star_at(n)});
    OffscreenRenderer offscreen = renderer(world, one_view(Planar{20}, {64, 64}));
    Shot shot = shot_at({0, 0, 0}, {0, u_of_gamma(3), 0}, {0, 0, -1});
    shot.effects = effects_of(false, false, true);
    const Sum sum = sum_of(Numbers(offscreen, shot));
    EXPECT_LT(between(sum.middle, n), 0.1 * 20 * degree / 64);
    // D of a direction in the ship is 1 / (gamma - u.n); a surface there keeps its size and has D^3 of its radiance.
    const double D = 1 / (3 - u_of_gamma(3) * n.y);
    EXPECT_NEAR(luminance(sum.light) / (brightness_arcmin2 * arcmin2_sr) / (D * D * D), 1, 0.01);
}

namespace {

/// The light left and right of the middle: of a disc, and of a star.
struct Halves {
    double disc = 0, star = 0;
};

} // namespace

TEST(Stars, AStarAndASmallDiscLoseAndGainTheSameLight)
{
    // A star is a surface too small to have an extent: with any switches, at any speed, it stays as bright as a disc beside
    // it that has the same light at rest. Both lie one degree from the motion, on either side.
    constexpr double half_deg = 0.4, away = 100;
    const double half = away * std::tan(half_deg * degree);
    const dvec3 disc = away * glm::normalize(dvec3(-std::tan(degree), 0, -1));
    GpuWorld world = sky_world("disc", disc, half, "", {0, 0}, {1, 1, 1});
    put_stars(world, {star_at({std::tan(degree), 0, -1})});
    const ReferenceWorld rays = open_reference_world(testing::scratch("disc.json"));
    auto add = [](Halves& halves, const dvec3& way, double light) { (way.x < 0 ? halves.disc : halves.star) += light; };
    auto live = [&](const Layout& layout, const Shot& shot) {
        Halves halves;
        OffscreenRenderer offscreen = renderer(world, layout);
        const Numbers numbers(offscreen, shot);
        for (int i = 0; i < numbers.count(); ++i)
            add(halves, numbers.camera(i), numbers.light(i).g);
        return halves;
    };
    auto by_rays = [&](const Layout& layout, const Shot& shot) {
        Halves halves;
        const std::vector<Star> star = {star_at({std::tan(degree), 0, -1})};
        const ReferenceInput input{rays.world, rays.scene, star};
        const Reference truth = reference(input, layout, shot, 0, {.samples = 1});
        for (std::size_t i = 0; i < truth.numbers.size(); ++i)
            add(halves, truth.numbers[i].camera, truth.light[0][i].g);
        return halves;
    };
    const Halves rest = live(one_view(Planar{4}, {256, 256}), shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1}));
    double worst = 0;
    for (double gamma : {1.25, 4.0})
        for (int switches = 0; switches < 16; ++switches) {
            Shot shot = shot_at({0, 0, 0}, {0, 0, -u_of_gamma(gamma)}, {0, 0, -1});
            shot.effects = effects_of(bool(switches & 1), bool(switches & 2), bool(switches & 4));
            if (switches & 8)
                shot.effects.comparison = Comparison::galilean;
            if ((switches & 8) && !(switches & 1))
                continue;
            // The disc has as many pixels as at rest: its outline is worth 2 % of it.
            const double beta = u_of_gamma(gamma) / gamma,
                         shrinks = !(switches & 1) ? 1
                : switches & 8                     ? 1 + beta
                                                   : gamma * (1 + beta);
            const Layout layout = one_view(Planar{4 / shrinks}, {256, 256});
            for (const Halves& now : {live(layout, shot), by_rays(layout, shot)}) {
                const double off = (now.star / now.disc) / (rest.star / rest.disc) - 1;
                worst = std::max(worst, std::abs(off));
                EXPECT_LT(std::abs(off), 0.05)
                    << "gamma " << gamma << ", switches " << switches << ": " << now.star << " " << now.disc;
            }
        }
    std::printf("  star over disc: at most %.1f %% off that at rest\n", 100 * worst);
}

// The shipped sky's total light, with all stars at one temperature, must equal a sum over the catalogue. A point's flux is
// D^-2 of a black body at D T, and does not depend on its direction.
TEST(Stars, TheWholeSkysLightIsTheCataloguesSum)
{
    GpuWorld world = sky_world("whole_sky");
    const double T = 5000;
    std::vector<Star> stars = load_stars(testing::source_dir() / "scenes/stars/stars.txt");
    for (Star& star : stars)
        star.temperature_K = T;
    put_stars(world, stars);
    const dvec2 size(720, 360);
    OffscreenRenderer offscreen = renderer(world, one_view(Equirectangular{}, ivec2(size)));
    auto luminance_of = [](double kelvin) {
        double sum = 0;
        for (double nm = 360.5; nm < 830; ++nm)
            sum += xyz_response(nm).y * planck(nm, kelvin);
        return sum;
    };
    for (double gamma : {1.0, 1.5, 4.0, 10.0, 100.0}) {
        const dvec3 u = u_of_gamma(gamma) * glm::normalize(dvec3(0.3, 0.5, -0.8));
        Shot shot = shot_at({0, 0, 0}, u, {0, 0, -1});
        shot.effects = {};
        const auto folder = testing::scratch("whole_sky");
        render_still(folder, offscreen, shot, true);
        const auto [read_size, channels] = read_exr(folder / "view.exr");
        ASSERT_EQ(read_size, ivec2(size));
        auto channel = [&](const std::string& name) {
            for (const auto& [own, values] : channels)
                if (own == name)
                    return values;
            throw std::runtime_error("no channel " + name);
        };
        const auto red = channel("R"), green = channel("G"), blue = channel("B"), depth = channel("depth");
        double measured = 0, expected = 0;
        for (int y = 0; y < int(size.y); ++y) {
            const double across = 2 * pi / size.x * std::cos(pi * ((y + 0.5) / size.y - 0.5)), down = pi / size.y;
            const double solid = across * down;
            for (int x = 0; x < int(size.x); ++x) {
                const std::size_t i = std::size_t(y) * std::size_t(size.x) + x;
                if (std::isinf(depth[i])) // a finite depth is the red square
                    measured += solid * luminance({red[i], green[i], blue[i]});
            }
        }
        for (const Star& star : stars) {
            const double D = gamma + glm::dot(u, world_from_equatorial({0, 0}) * star.direction);
            expected += brightness_arcmin2 * arcmin2_sr * std::pow(10, -0.4 * star.magnitude) * luminance_of(D * T)
                / luminance_of(T) / (D * D);
        }
        std::printf("  gamma %g: %.5g, the sum %.5g, ratio %.4f\n", gamma, measured, expected, measured / expected);
        EXPECT_NEAR(measured / expected, 1, 0.01); // required; the spots are off by half a percent
    }
}

// ---------------------------------------------------------------- displays all round: ends, poles and seams

/// A panorama's formulas, written independently.
struct AllRound {
    const char* name;
    Projection projection;
    ivec2 size;
    dvec2 (*steps)(const dvec3& n, dvec2 size); ///< radians from the pixel at n to the pixels beside and below it
    double (*solid_angle)(const dvec3& n, dvec2 size); ///< the solid angle of the pixel at n
    double (*pixels_to_pole)(
        const dvec3& n, dvec2 size); ///< pixels from n to the direction that the picture stretches into a line
};

double elevation(const dvec3& n) { return std::atan2(n.y, std::hypot(n.x, n.z)); }

const AllRound all_round[]
    = {{"equirectangular", Equirectangular{}, {480, 240},
           [](const dvec3& n, dvec2 size) { return dvec2(2 * pi / size.x * std::cos(elevation(n)), pi / size.y); },
           [](const dvec3& n, dvec2 size) { return 2 * pi / size.x * std::cos(elevation(n)) * pi / size.y; },
           [](const dvec3& n, dvec2 size) { return std::atan2(std::hypot(n.x, n.z), std::abs(n.y)) / pi * size.y; }},
        {"cylinder", Cylinder{{-180, 180, -60, 60}}, {480, 264},
            [](const dvec3& n, dvec2 size) {
                const double across = std::cos(elevation(n));
                return dvec2(2 * pi / size.x * across, 2 * std::sqrt(3.0) / size.y * across * across);
            },
            [](const dvec3& n, dvec2 size) {
                return 2 * pi / size.x * 2 * std::sqrt(3.0) / size.y * std::pow(std::cos(elevation(n)), 3);
            },
            [](const dvec3&, dvec2) { return 1e9; }},
        {"fisheye 360", Fisheye{360, 90}, {400, 400},
            [](const dvec3& n, dvec2 size) {
                const double angle = between(n, {0, 0, -1}), out = 2 * pi / size.x, along = out * std::sin(angle) / angle;
                const dvec2 way = glm::normalize(dvec2(n));
                return dvec2(glm::length(dvec2(out, along) * way), glm::length(dvec2(along, out) * way));
            },
            [](const dvec3& n, dvec2 size) {
                const double angle = between(n, {0, 0, -1}), out = 2 * pi / size.x;
                return out * out * std::sin(angle) / angle;
            },
            [](const dvec3& n, dvec2 size) {
                return between(n, {0, 0, 1}) / (2 * pi) * size.x;
            }}};

// Every star appears once, within half a pixel of its place, no larger than elsewhere, with all its light. This holds near
// the poles with their narrow pixels, where the picture's edges join, and everywhere else.
TEST(Stars, EachStarAppearsOnceAndWholeOnPanoramas)
{
    GpuWorld world = sky_world("all_round");
    put_stars(world, {star_at({0, 0, -1})});
    std::mt19937 random(11);
    std::uniform_real_distribution<double> one(-1, 1);
    std::vector<std::pair<const char*, dvec3>> ways;
    for (int i = 0; i < 16; ++i) {
        const double a = pi * one(random), away = 0.1 * std::pow(10, 1.5 * (one(random) - 1));
        const double side = i % 2 == 0 ? 1 : -1;
        ways.emplace_back("pole", dvec3(away * std::cos(a), side, away * std::sin(a)));
        ways.emplace_back("behind", dvec3(away * std::cos(a), away * std::sin(a), 1));
        ways.emplace_back("seam", dvec3(side * 0.2 * away, one(random), 1));
        ways.emplace_back("all over", dvec3(one(random), one(random), one(random)));
    }
    for (const AllRound& display : all_round) {
        OffscreenRenderer offscreen = renderer(world, one_view(display.projection, display.size));
        std::map<std::string, int> tried;
        double off = 0, low = 1e9, high = 0, farthest = 0, near_low = 1, near_high = 1;
        int most = 0;
        for (const auto& [where, way] : ways) {
            const dvec3 n = glm::normalize(way);
            if (std::holds_alternative<Cylinder>(display.projection) && std::abs(elevation(n)) > 59 * degree)
                continue; // outside the cylinder's range
            Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
            shot.ship_from_cockpit = glm::rotation(n, dvec3(0, 0, -1));
            const Numbers numbers(offscreen, shot);
            const dvec2 steps = display.steps(n, dvec2(display.size));
            const double pixel = std::max(steps.x, steps.y), pole = display.pixels_to_pole(n, dvec2(display.size));
            dvec3 middle(0);
            double light = 0, apart = 0;
            int pixels = 0;
            for (int i = 0; i < numbers.count(); ++i) {
                if (!numbers.shown(i) || numbers.light(i).g == 0)
                    continue;
                const dvec3 seen = glm::transpose(glm::mat3_cast(shot.ship_from_cockpit)) * numbers.camera(i);
                ++pixels;
                light += luminance(numbers.light(i)) * display.solid_angle(seen, dvec2(display.size))
                    / (brightness_arcmin2 * arcmin2_sr);
                middle += luminance(numbers.light(i)) * seen;
                apart = std::max(apart, between(seen, n) / pixel);
            }
            ++tried[where];
            farthest = std::max(farthest, apart), most = std::max(most, pixels);
            EXPECT_LT(between(middle, n) / pixel, 1.1) << where; // everywhere
            if (pole < 4) { // the spot covers a whole parallel, and a solid angle of 0 has a floor (STAR_BEYOND_POLE)
                near_low = std::min(near_low, light), near_high = std::max(near_high, light);
                continue;
            }
            off = std::max(off, between(middle, n) / pixel);
            low = std::min(low, light), high = std::max(high, light);
        }
        std::printf("  %-16s off by %.3f pixels at most, light %.4f to %.4f, at most %d pixels, none farther than %.2f\n",
            display.name, off, low, high, most, farthest);
        std::printf("  %-16s within 4 pixels of a pole: light %.4f to %.4f\n", display.name, near_low, near_high);
        EXPECT_GT(near_low, 0.15); // over the spot, a pixel's solid angle falls to 0; a rim cuts it
        EXPECT_LT(near_high, 2.6);
        EXPECT_LT(off, 0.5); // required accuracy
        // The spot's half a percent, and narrow pixels' solid angles from the differences of their neighbours: 3.4 % at
        // worst.
        EXPECT_GT(low, 0.96);
        EXPECT_LT(high, 1.04);
        EXPECT_LE(most, 16); // a disc 4 pixels wide, in two parts at a seam
        EXPECT_LT(farthest, 3); // no streaks: the radius is 2 pixels, and the pixels beyond a rim are narrow
        EXPECT_GE(tried["all over"], 9);
        EXPECT_GE(tried["seam"], 9);
    }
}

// ---------------------------------------------------------------- the exposure under stars

// The expected exposure uses every star's place, pixel and light. A black square hides a quarter of the view.
TEST(Stars, TheExposureFollowsTheVisibleStars)
{
    GpuWorld world = sky_world("metered_stars", {-10, 0, -20}, 10, "", {0, 0}, {0, 0, 0});
    std::mt19937 random(8);
    std::uniform_real_distribution<double> one(-1, 1);
    std::vector<Star> stars;
    for (int i = 0; i < 2500; ++i) {
        stars.push_back(star_at({one(random), one(random), one(random)}));
        stars.back().magnitude = 3 + 4 * one(random);
    }
    put_stars(world, stars);
    const dmat3 turn = world_from_equatorial({0, 0});
    for (const auto& [name, projection] : displays)
        for (double gamma : {2.0}) {
            OffscreenRenderer offscreen = renderer(world, one_view(projection, size_for(name)));
            const dvec3 u(0, 0, -u_of_gamma(gamma));
            const Shot shot = shot_at({0, 0, 0}, u, {0, 0, -1});
            const Numbers numbers(offscreen, shot);
            const std::vector<double> solid = solid_angles(numbers);
            std::vector<std::pair<double, double>>
                spots; // log2 of the luminance in the spot's middle, and the spot's solid angle
            double all = 0;
            for (const Star& star : stars) {
                const dvec3 expected = seen(turn * star.direction, u);
                int nearest = -1;
                double best = 0;
                for (int i = 0; i < numbers.count(); ++i)
                    if (const double along = numbers.shown(i) ? glm::dot(numbers.camera(i), expected) : -1; along > best)
                        best = along, nearest = i;
                if (nearest < 0 || solid[nearest] == 0 || best < std::cos(1.5 * std::sqrt(solid[nearest]))
                    || std::isfinite(numbers.depth(nearest)))
                    continue;
                // The spot's profile (1 - r^2 / 4)^4 integrates to 4 pi / 5 pixels.
                const double area = 0.8 * pi * solid[nearest];
                const double D = gamma + glm::dot(u, turn * star.direction); // D^2: its solid angle's shrinking
                const double light = brightness_arcmin2 * arcmin2_sr * std::pow(10, -0.4 * star.magnitude) / (D * D);
                spots.emplace_back(std::log2(light / area), area);
                all += area;
            }
            std::sort(spots.begin(), spots.end());
            double below = 0, weight = 0, mean = 0;
            for (const auto& [log, area] : spots) {
                if (below > 0.5 * all && below < 0.98 * all)
                    weight += area, mean += area * log;
                below += area;
            }
            const double expected = std::log2(0.18) - mean / weight, measured = *offscreen.metered(shot);
            std::printf("  %-16s gamma %g: %zu stars seen, EV %.3f, by hand %.3f\n", name.c_str(), gamma, spots.size(),
                measured, expected);
            EXPECT_GT(spots.size(), 50u);
            EXPECT_NEAR(measured, expected, 0.05) << name; // a few stars lie at edges, where the test has no solid angle
        }
}

// The ship turns under the shipped stars.
TEST(Stars, TheExposureStaysWhileTheShipTurns)
{
    GpuWorld world
        = sky_world("turning", {0, -50, 0}, 0.1, absolute(testing::source_dir() / "scenes/stars/stars.txt").string());
    OffscreenRenderer offscreen = renderer(world, one_view(Planar{60}, {400, 300}), false);
    double low = 1e9, high = -1e9, step = 0, before = 0;
    for (int deg = 0; deg <= 360; deg += 5) {
        const double ev
            = *offscreen.metered(shot_at({0, 0, 0}, {0, 0, 0}, {std::sin(deg * degree), 0.2, -std::cos(deg * degree)}));
        if (deg > 0)
            step = std::max(step, std::abs(ev - before));
        before = ev, low = std::min(low, ev), high = std::max(high, ev);
    }
    std::printf("  from %.2f to %.2f EV, at most %.2f in a step of five degrees\n", low, high, step);
    EXPECT_LT(high - low, 0.7); // a change of half a stop either way is hardly visible
    EXPECT_LT(step, 0.35);
}

// ---------------------------------------------------------------- occlusion

TEST(Stars, ObjectsHideTheStarsBehindThem)
{
    // A square twenty degrees wide is seen at rest, and from a ship that flies away from it, where it looks larger.
    GpuWorld world = sky_world("hidden", {0, 0, -10}, 10 * std::tan(10 * degree));
    struct Case {
        double right_deg, up_deg;
        bool hidden;
    };
    const std::vector<Case> cases = {{0, 0, true}, {7, 0, true}, {0, -7, true}, {13, 0, false}, {0, -13, false}};
    auto direction = [](const Case& c) { return dvec3(std::tan(c.right_deg * degree), std::tan(c.up_deg * degree), -1); };
    std::vector<Star> stars;
    for (const Case& c : cases)
        stars.push_back(star_at(direction(c)));
    put_stars(world, stars);
    for (const auto& [name, projection] : displays)
        for (double gamma : {1.0, 1.5}) {
            OffscreenRenderer offscreen = renderer(world, one_view(projection, size_for(name)));
            const dvec3 u = u_of_gamma(gamma) * glm::normalize(dvec3(0.05, 0.1, 1));
            const Numbers numbers(offscreen, shot_at({0, 0, 0}, u, {0, 0, -1}));
            for (const Case& c : cases) {
                const dvec3 expected = seen(glm::normalize(direction(c)), u);
                int nearest = 0;
                for (int i = 0; i < numbers.count(); ++i)
                    if (numbers.shown(i)
                        && (!numbers.shown(nearest)
                            || between(numbers.camera(i), expected) < between(numbers.camera(nearest), expected)))
                        nearest = i;
                ASSERT_LT(between(numbers.camera(nearest), expected), 2 * degree);
                EXPECT_EQ(numbers.light(nearest).g == 0, c.hidden)
                    << name << " gamma " << gamma << " " << c.right_deg << " " << c.up_deg;
            }
        }
}

// Two eyes that share one cube map see a near object hide different stars.
TEST(Stars, ObjectsHideOtherStarsFromEachEye)
{
    GpuWorld world = sky_world("eyes", {0, 0, -1}, 0.01);
    for (StereoMethod method : {StereoMethod::exact, StereoMethod::reprojected})
        for (double x : {-0.03, 0.0, 0.03}) {
            // From an eye at x, the square covers the star at (-x, 0, -1).
            put_stars(world, {star_at({-x, 0, -1})});
            Layout layout = one_view(Planar{20}, {400, 200});
            layout.outputs[0].packing = Packing::side_by_side;
            layout.stereo = {.method = method, .separation_m = 0.06};
            OffscreenRenderer offscreen = renderer(world, layout);
            const Numbers numbers(offscreen, shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1}));
            double green[2] = {0, 0};
            for (int i = 0; i < numbers.count(); ++i)
                green[i % 400 / 200] += numbers.light(i).g;
            EXPECT_EQ(green[0] == 0, x == -0.03) << int(method) << " " << x;
            EXPECT_EQ(green[1] == 0, x == 0.03) << int(method) << " " << x;
        }
}

TEST(Stars, ASpotIsWholeAcrossTheSeamOfTwoViewports)
{
    GpuWorld world = sky_world("seam");
    // The viewports are the two halves of one wide picture.
    Layout layout = one_view(Planar{20}, {128, 64});
    layout.outputs[0].viewports = {{.rect = {0, 0, 0.5, 1}, .projection = Planar{20, Sides{-20, 0, -10, 10}}},
        {.rect = {0.5, 0, 0.5, 1}, .projection = Planar{20, Sides{0, 20, -10, 10}}}};
    for (double offset : {-0.7, -0.2, 0.3, 1.1}) {
        const double pixel = std::tan(20 * degree) / 64;
        put_stars(world, {star_at({offset * pixel, 0, -1})});
        OffscreenRenderer offscreen = renderer(world, layout);
        const Numbers numbers(offscreen, shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1}));
        const double light = luminance(sum_of(numbers).light) / (brightness_arcmin2 * arcmin2_sr);
        EXPECT_NEAR(light, 1, 0.015) << offset; // at the seam the test's own solid angles are less accurate
    }
}

} // namespace
} // namespace starbow::gpu_test::stars_gpu_test
