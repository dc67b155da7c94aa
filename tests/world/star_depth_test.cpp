// Stars in depth, and stars painted onto the panorama of the sky: places, light and colours against formulas of their own.
#include "config/model/angles.h"
#include "runtime/light/srgb.h"
#include "runtime/world/painted_sky.h"
#include "runtime/world/stars.h"
#include "tests/support/files.h"
#include <fstream>
#include <random>
#include <sstream>

namespace starbow::star_depth_test {
namespace {

using namespace starbow::testing;

const std::filesystem::path catalogue = source_dir() / "scenes/stars/stars.txt";
constexpr long double turn = 6.283185307179586476925286766559L, light_year_m = 9460730472580800.0L;

using Vector = std::array<long double, 3>;

long double length(const Vector& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// A line of the shipped file, read by itself: place in metres from the Sun, equatorial axes, and light as a multiple of a
/// star of magnitude 0.
struct Line {
    Vector place_m;
    long double light;
};

std::vector<Line> lines_of_the_file()
{
    std::ifstream in(catalogue);
    std::vector<Line> lines;
    for (std::string text; std::getline(in, text);) {
        if (text.starts_with("#"))
            continue;
        std::istringstream words(text);
        long double ra, dec, magnitude;
        std::string b_v, parallax;
        words >> ra >> dec >> magnitude >> b_v >> parallax;
        const long double a = ra * 1e-5L * turn / 360, d = dec * 1e-5L * turn / 360;
        // An astronomical unit at the parallax' angle, or 1000 parsecs.
        const long double angle = (parallax == "-" ? 1e-3L : std::stold(parallax) * 1e-5L) / 3600 * turn / 360;
        const long double distance = 149597870700.0L / angle;
        lines.push_back(
            {{distance * std::cos(d) * std::cos(a), distance * std::cos(d) * std::sin(a), distance * std::sin(d)},
                std::pow(10.0L, -0.004L * magnitude)});
    }
    return lines;
}

/// The angle between two directions of any length, seconds of arc.
double apart_arcsec(const Vector& a, const Vector& b)
{
    const Vector cross{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    return double(std::atan2(length(cross), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / turn * 360 * 3600);
}

Texture plain(glm::ivec2 size, std::uint8_t grey)
{
    return {size, std::vector<std::uint8_t>(std::size_t(size.x) * std::size_t(size.y) * 4, grey), {}};
}

/// All light of a panorama over the sky, each colour, white times steradians.
glm::dvec3 light_of(const Texture& picture, const std::function<bool(const glm::dvec3&)>& counts = {})
{
    glm::dvec3 sum(0);
    for (int y = 0; y < picture.size.y; ++y) {
        const double dec = 90 - (y + 0.5) / picture.size.y * 180;
        const double solid = 2 * pi / picture.size.x * pi / picture.size.y * std::cos(dec * degree);
        for (int x = 0; x < picture.size.x; ++x) {
            if (counts && !counts(equatorial((x + 0.5) / picture.size.x * 360, dec)))
                continue;
            const std::uint8_t* texel = &picture.rgba[4 * (std::size_t(y) * std::size_t(picture.size.x) + std::size_t(x))];
            for (int c = 0; c < 3; ++c)
                sum[c] += solid * light_of_srgb(texel[c] / 255.0);
        }
    }
    return sum;
}

} // namespace

// The bound is the issue of a float: 0.02 seconds of arc, and twice as much for the turn of the axes.
TEST(StarDepth, DirectionsAreExactForAnyObserverWithin10000LightYears)
{
    const std::vector<Star> stars = load_stars(catalogue);
    const std::vector<Line> lines = lines_of_the_file();
    ASSERT_EQ(stars.size(), lines.size());
    ASSERT_GT(stars.size(), 118'000u);
    constexpr double unit_m = 299792458;
    const StarSky sky{.catalogue = catalogue, .brightness_arcmin2 = 500, .ahead_deg = {84, -19}};
    const StarField field = star_field(stars, sky, unit_m);
    ASSERT_EQ(field.stars.size(), stars.size());
    // The field is in an order of its own: the lines by their places.
    std::map<std::tuple<double, double, double>, std::size_t> at;
    const glm::dmat3 turned = world_from_equatorial(sky.ahead_deg);
    for (std::size_t i = 0; i < stars.size(); ++i) {
        const glm::dvec3 p = turned * stars[i].direction * (stars[i].distance_m / unit_m);
        at[{p.x, p.y, p.z}] = i;
    }
    const long double a = 84.0L * turn / 360, d = -19.0L * turn / 360;
    const auto to_world = [&](const Vector& e) -> Vector { // east is on the left where north is up
        return {std::sin(a) * e[0] - std::cos(a) * e[1],
            -std::sin(d) * std::cos(a) * e[0] - std::sin(d) * std::sin(a) * e[1] + std::cos(d) * e[2],
            -(std::cos(d) * std::cos(a) * e[0] + std::cos(d) * std::sin(a) * e[1] + std::sin(d) * e[2])};
    };
    std::vector<shared::StarEntry> entries(stars.size());
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> one(0, 1);
    double worst = 0, dimmest = 1, brightest = 1;
    for (int observer = 0; observer < 24; ++observer) {
        glm::dvec3 eye(0);
        const double light_years = 1e4 * std::pow(one(random), 3);
        if (observer > 0)
            eye = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)))
                * (light_years * double(light_year_m) / unit_m);
        if (observer % 4 == 3) // a thousandth of a light-year beside a star
            eye = field.stars[std::size_t(one(random) * 5000)].place
                + glm::dvec3(0.001 * double(light_year_m) / unit_m, 0, 0);
        stars_from(field, eye, entries);
        for (std::size_t k = 0; k < entries.size(); ++k) {
            const glm::dvec3 p = field.stars[k].place;
            const Line& line = lines[at.at({p.x, p.y, p.z})];
            const Vector there = to_world(line.place_m);
            const Vector way{there[0] - (long double)eye.x * unit_m, there[1] - (long double)eye.y * unit_m,
                there[2] - (long double)eye.z * unit_m};
            const glm::dvec3 shown(entries[k].direction);
            worst = std::max(worst, apart_arcsec({shown.x, shown.y, shown.z}, way));
            const long double nearer = length(line.place_m) / std::max(length(way), 149597870700.0L);
            const double expected = double(line.light * nearer * nearer) * sky.brightness_arcmin2 * std::pow(degree / 60, 2);
            dimmest = std::min(dimmest, entries[k].light.y / expected);
            brightest = std::max(brightest, entries[k].light.y / expected);
        }
    }
    std::printf(
        "worst direction %.4f seconds of arc; light from %.7f to %.7f of the inverse square\n", worst, dimmest, brightest);
    EXPECT_LT(worst, 0.04);
    EXPECT_NEAR(dimmest, 1, 1e-6);
    EXPECT_NEAR(brightest, 1, 1e-6);
}

// From alpha Centauri the Sun's neighbour looks back: known separations of a triangle of two stars and the Sun.
TEST(StarDepth, FromProximaAlphaCentauriIsBright)
{
    const std::vector<Star> stars = load_stars(catalogue);
    const auto nearest_to = [&](double ra, double dec) {
        return *std::max_element(stars.begin(), stars.end(), [&](const Star& a, const Star& b) {
            return glm::dot(a.direction, equatorial(ra, dec)) < glm::dot(b.direction, equatorial(ra, dec));
        });
    };
    const Star proxima = nearest_to(217.4489, -62.6795), alpha = nearest_to(219.9009, -60.8356); // J2000
    EXPECT_NEAR(proxima.distance_m / parsec_m, 1.301, 0.01); // parallax 768.5 milliseconds of arc (Gaia)
    EXPECT_NEAR(alpha.distance_m / parsec_m, 1.34, 0.02); // 747 milliseconds of arc
    const StarField field = star_field({alpha}, {.catalogue = "", .brightness_arcmin2 = 1}, 1);
    std::vector<shared::StarEntry> entries(1);
    stars_from(field, world_from_equatorial({0, 0}) * proxima.direction * proxima.distance_m, entries);
    // 13,000 astronomical units away, it is as bright as Venus.
    const double magnitude = -2.5 * std::log10(double(entries[0].light.y) / std::pow(degree / 60, 2));
    EXPECT_NEAR(magnitude, -6.4, 0.6);
}

TEST(StarDepth, TheFieldBeginsWithTheBrightestAndLosesNone)
{
    const std::vector<Star> stars = load_stars(catalogue);
    const StarField field = star_field(stars, {.catalogue = "", .brightness_arcmin2 = 1}, 1e9);
    std::vector<shared::StarEntry> entries(stars.size());
    EXPECT_NEAR(stars_from(field, {0, 0, 0}, entries) * 1e9 / parsec_m, 1.3012, 1e-3); // Proxima is the nearest
    ASSERT_EQ(field.brightest, 5000u);
    float dimmest = 1e30f, brightest_other = 0;
    for (std::size_t i = 0; i < entries.size(); ++i)
        if (i < field.brightest)
            dimmest = std::min(dimmest, entries[i].light.y);
        else
            brightest_other = std::max(brightest_other, entries[i].light.y);
    EXPECT_GE(dimmest, brightest_other * (1 - 1e-6f));
    double sum = 0, expected = 0;
    for (std::size_t i = 0; i < entries.size(); ++i)
        sum += entries[i].light.y, expected += std::pow(degree / 60, 2) * std::pow(10, -0.4 * stars[i].magnitude);
    EXPECT_NEAR(sum / expected, 1, 1e-6);
}

/// sun_light: the radiance of a white surface that faces the Sun, one astronomical unit away. It sends its light over pi
/// steradians.
TEST(StarDepth, TheSunHasTheLightOfTheScene)
{
    StarSky sky{.catalogue = catalogue,
        .brightness_arcmin2 = 500,
        .sun_deg = glm::dvec2(64, -4.6),
        .sun_light = 0.01,
        .in_depth = 3};
    for (const double unit_m : {1.0, 299792458.0}) {
        const std::vector<Star> stars = stars_in_depth(sky);
        ASSERT_EQ(stars.size(), 4u);
        const StarField field = star_field(stars, sky, unit_m);
        std::vector<shared::StarEntry> entries(4);
        stars_from(field, {0, 0, 0}, entries);
        const auto sun = std::find_if(entries.begin(), entries.end(), [](const auto& one) { return one.light.z > 0; });
        ASSERT_NE(sun, entries.end());
        EXPECT_NEAR(sun->light.y, 0.01 * pi, 1e-6);
        EXPECT_NEAR(sun->light.z / degree, 0.2666, 1e-3); // half of 31 minutes and 59 seconds, the mean of the year
        EXPECT_NEAR(sun->light.w * unit_m, 1.495979e11, 1e5);
    }
}

TEST(StarDepth, AnEyeInAStarSeesNoInfiniteLight)
{
    const Star star{{1, 0, 0}, 0, 5772, parsec_m};
    const StarField field = star_field({star}, {.catalogue = "", .brightness_arcmin2 = 500}, 1);
    std::vector<shared::StarEntry> entries(1);
    stars_from(field, field.stars[0].place, entries);
    EXPECT_TRUE(std::isfinite(entries[0].light.x));
    EXPECT_NEAR(glm::length(glm::dvec3(entries[0].direction)), 1, 1e-6);
    EXPECT_NEAR(entries[0].light.y / (500 * std::pow(degree / 60, 2)) / std::pow(206264.806, 2), 1, 1e-5); // at 1 au
}

TEST(PaintedSky, AStarHasItsPlaceItsLightAndItsColour)
{
    for (const glm::dvec2& place : {glm::dvec2(10.123, 20.456), {359.99, -5}, {200, 89.3}, {77, -80.001}, {0.001, 0}})
        for (const double kelvin : {3500.0, 5772.0, 12000.0}) {
            if (!all_cases() && (kelvin == 5772) == (place.x == 77))
                continue; // every place, and both other colours at one
            const Star star{equatorial(place.x, place.y), 7, kelvin};
            const double peak = 3e-5; // about the Milky Way's
            const Texture result = painted(plain({256, 128}, 0), {star}, peak);
            ASSERT_EQ(result.size, glm::ivec2(4096, 2048));
            // Dither makes black texels shine: only those within a degree count.
            const auto near = [&](const glm::dvec3& n) { return glm::dot(n, star.direction) > std::cos(0.6 * degree); };
            const glm::dvec3 light = light_of(result, near);
            const double expected = std::pow(10, -0.4 * 7) / peak * std::pow(degree / 60, 2);
            const glm::dvec3 colour = rec709_from_sunlit_xyz() * black_body_xyz(kelvin) / black_body_xyz(kelvin).y;
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(light[c] / expected / colour[c], 1, 0.02) << place.x << ' ' << place.y << ' ' << kelvin;
            glm::dvec3 middle(0);
            for (int y = 0; y < result.size.y; ++y)
                for (int x = 0; x < result.size.x; ++x) {
                    const glm::dvec3 n = equatorial((x + 0.5) * 360 / 4096, 90 - (y + 0.5) * 180 / 2048);
                    if (near(n))
                        middle += n * std::cos(std::asin(n.z))
                            * light_of_srgb(result.rgba[4 * (std::size_t(y) * 4096 + std::size_t(x)) + 1] / 255.0);
                }
            EXPECT_LT(std::acos(std::min(1.0, glm::dot(glm::normalize(middle), star.direction))) / degree, 0.004)
                << place.x << ' ' << place.y;
        }
}

TEST(PaintedSky, ThePanoramaItselfKeepsItsLight)
{
    Texture picture = plain({128, 64}, 0);
    std::mt19937 random(3);
    for (std::size_t i = 0; i < picture.rgba.size(); ++i)
        picture.rgba[i] = std::uint8_t(40 + random() % 60);
    const glm::dvec3 before = light_of(picture), after = light_of(painted(picture, {}, 1));
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(after[c] / before[c], 1, 0.003);
    const Texture large = plain({8192, 4096}, 77);
    EXPECT_EQ(painted(large, {}, 1).size, large.size);
}

TEST(PaintedSky, TheShippedSkysStarsAreAllThereOnce)
{
    const StarSky sky{.catalogue = catalogue, .in_depth = 5000};
    const std::vector<Star> in_depth = stars_in_depth(sky), others = painted_stars(sky);
    EXPECT_EQ(in_depth.size(), 5000u);
    EXPECT_EQ(in_depth.size() + others.size(), load_stars(catalogue).size());
    EXPECT_LE(in_depth.back().magnitude, others.front().magnitude);
    const double peak = 3.2414e-5;
    const Texture result = painted(plain({2048, 1024}, 0), others, peak);
    const Texture empty = painted(plain({2048, 1024}, 0), {}, peak);
    double expected = 0;
    for (const Star& star : others)
        expected += std::pow(10, -0.4 * star.magnitude) / peak * std::pow(degree / 60, 2);
    const glm::dvec3 light = light_of(result) - light_of(empty);
    EXPECT_NEAR(glm::dot(light, glm::dvec3(0.2126, 0.7152, 0.0722)) / expected, 1, 0.02);
    EXPECT_EQ(*std::max_element(result.rgba.begin(), result.rgba.end() - 1), 255); // alpha
    std::size_t white = 0;
    for (std::size_t i = 0; i < result.rgba.size(); i += 4)
        white += result.rgba[i] == 255 || result.rgba[i + 1] == 255 || result.rgba[i + 2] == 255;
    EXPECT_LT(white, 400u); // of 8 million: crowds of the brightest
}

} // namespace starbow::star_depth_test
