#include "stars.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include "config/model/angles.h"
#include "ephemeris.h"
#include "runtime/light/spectrum.h"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>

namespace starbow {
namespace {

constexpr double sun_radius_m = 6.957e8; // IAU 2015, resolution B3
constexpr double sun_b_v = 0.65; // for stars whose B-V is not known
constexpr std::size_t most_stars = 4'000'000; // 128 MB on the device for each place of an eye

/// One whole number of a line; messages about a wrong one name `what` and the range.
struct Column {
    const char* what;
    int low, high;
};
constexpr Column columns[]
    = {{"right ascension in 1e-5 degrees", 0, 35999999}, {"declination in 1e-5 degrees", -9000000, 9000000},
        {"magnitude in 0.01", -3000, 3000}, {"B-V in 0.01", -50, 600}, {"parallax in 0.01 milliseconds of arc", 1, 1000000}};

std::string quoted(std::string_view text)
{
    std::string quoted = one_line(std::string(text), 40);
    quoted.insert(quoted.begin(), '"');
    quoted.push_back('"');
    return quoted;
}

struct Line {
    const std::string& file;
    int number;

    [[noreturn]] void refuse(const std::string& problem) const
    {
        throw InputError(file + ":" + std::to_string(number), "", problem);
    }

    int value(std::string_view word, const Column& column) const
    {
        int value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc() || end != word.data() + word.size() || value < column.low || value > column.high)
            refuse(quoted(word) + " is not a " + column.what + "; a whole number from " + std::to_string(column.low) + " to "
                + std::to_string(column.high) + " is right");
        return value;
    }

    Star star(std::string_view text) const
    {
        std::vector<std::string_view> words;
        for (std::size_t at = 0; (at = text.find_first_not_of(" \t\r", at)) < text.size() && words.size() < 6;) {
            const std::size_t end = std::min(text.find_first_of(" \t\r", at), text.size());
            words.push_back(text.substr(at, end - at));
            at = end;
        }
        if (words.size() != 5)
            refuse(quoted(text)
                + " is not a star; five columns (right ascension, declination, magnitude, B-V, parallax) are right");
        const double ra = value(words[0], columns[0]), dec = value(words[1], columns[1]);
        const double magnitude = value(words[2], columns[2]);
        const double b_v = words[3] == "-" ? sun_b_v : 0.01 * value(words[3], columns[3]);
        // The parallax in seconds of arc is 1 over the distance in parsecs.
        const double distance_m = words[4] == "-" ? unknown_distance_m : parsec_m / (1e-5 * value(words[4], columns[4]));
        return {equatorial(1e-5 * ra, 1e-5 * dec), 0.01 * magnitude, temperature_of(b_v), distance_m};
    }
};

} // namespace

std::vector<Star> load_stars(const std::filesystem::path& path)
{
    const std::string file = one_line(path.string());
    std::istringstream in(read_whole(path, std::size_t(256) << 20, "a catalogue of stars, like scenes/stars/stars.txt,"));
    std::vector<Star> stars;
    std::string text;
    for (int number = 1; std::getline(in, text); ++number) {
        if (text.starts_with('#') || text.find_first_not_of(" \t\r") == std::string::npos)
            continue;
        if (stars.size() == most_stars)
            Line{file, number}.refuse("is one star too many; at most " + std::to_string(most_stars) + " stars are right");
        stars.push_back(Line{file, number}.star(text));
    }
    if (stars.empty())
        throw InputError(file, "", "holds no star; a catalogue of stars, like scenes/stars/stars.txt, is right");
    return stars;
}

namespace {

/// All stars, the brightest first; equally bright ones in the catalogue's order.
std::vector<Star> by_brightness(const StarSky& sky)
{
    std::vector<Star> stars = load_stars(sky.catalogue);
    std::stable_sort(stars.begin(), stars.end(), [](const Star& a, const Star& b) { return a.magnitude < b.magnitude; });
    return stars;
}

/// At one astronomical unit.
double sun_magnitude(const StarSky& sky)
{
    if (!sky.sun_light)
        return -26.74; // IAU 2015, resolution B2: absolute bolometric 4.74
    const double of_magnitude_0 = sky.brightness_arcmin2 * std::pow(degree / 60, 2); // white times steradians
    return -2.5 * std::log10(*sky.sun_light * pi / of_magnitude_0); // a white surface spreads its light over pi steradians
}

} // namespace

std::vector<Star> stars_in_depth(const StarSky& sky)
{
    std::vector<Star> stars = by_brightness(sky);
    stars.resize(std::min(stars.size(), sky.in_depth));
    if (sky.sun_deg)
        stars.push_back(
            {equatorial(sky.sun_deg->x, sky.sun_deg->y), sun_magnitude(sky), sun_K, astronomical_unit_m, sun_radius_m});
    return stars;
}

std::vector<Star> painted_stars(const StarSky& sky)
{
    if (sky.in_depth >= most_stars)
        return {};
    std::vector<Star> stars = by_brightness(sky);
    stars.erase(stars.begin(), stars.begin() + std::ptrdiff_t(std::min(stars.size(), sky.in_depth)));
    return stars;
}

glm::dvec3 equatorial(double ra_deg, double dec_deg)
{
    const double ra = ra_deg * degree, dec = dec_deg * degree;
    return {std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec)};
}

double temperature_of(double b_v) { return 4600 * (1 / (0.92 * b_v + 1.7) + 1 / (0.92 * b_v + 0.62)); }

glm::dvec3 black_body_xyz(double temperature_K)
{
    static const double sun = seen_xyz(black_body(sun_K), 1).y;
    return seen_xyz(black_body(temperature_K), 1) / sun;
}

std::vector<glm::vec4> black_body_table(const StandardObserver& observer)
{
    static const double sun = seen_xyz(black_body(sun_K), 1).y;
    std::vector<glm::vec4> table;
    for (int step = 0; step < STAR_STEPS; ++step) {
        const double kelvin = STAR_COLDEST * std::exp2(step / double(STAR_STEPS_PER_OCTAVE));
        const glm::dvec3 colour = seen(observer, black_body(kelvin), 1) / sun;
        const double most = std::max({colour.x, colour.y, colour.z});
        table.push_back(glm::vec4(observer.rec709 * (colour / most), std::log(most)));
    }
    return table;
}

glm::dmat3 world_from_equatorial(const glm::dvec2& ahead_deg)
{
    // With north up, the sky's east is on the left: right ascension grows towards -x.
    const double ra = ahead_deg.x * degree, dec = ahead_deg.y * degree;
    const glm::dvec3 right(std::sin(ra), -std::cos(ra), 0);
    const glm::dvec3 ahead = equatorial(ahead_deg.x, ahead_deg.y);
    const glm::dvec3 up(-std::sin(dec) * std::cos(ra), -std::sin(dec) * std::sin(ra), std::cos(dec));
    return glm::transpose(glm::dmat3(right, up, -ahead));
}

StarField star_field(const std::vector<Star>& stars, const StarSky& sky, double unit_m)
{
    constexpr std::size_t brightest = 5000; // about as many as a good eye sees from the Earth
    const glm::dmat3 turn = world_from_equatorial(sky.ahead_deg);
    const double arcmin2 = std::pow(degree / 60, 2);
    StarField field{{}, std::min(stars.size(), brightest), astronomical_unit_m / unit_m};
    std::vector<std::size_t> order(stars.size());
    std::iota(order.begin(), order.end(), 0);
    const auto others = order.begin() + std::ptrdiff_t(field.brightest);
    std::nth_element(order.begin(), others, order.end(),
        [&](std::size_t a, std::size_t b) { return std::pair(stars[a].magnitude, a) < std::pair(stars[b].magnitude, b); });
    std::vector<int> patches;
    for (const Star& star : stars) {
        const glm::dvec3 n = turn * star.direction;
        const double azimuth = std::atan2(n.z, n.x) / (360 * degree) + 0.5;
        patches.push_back(int(16 * (n.y + 1)) * 64 + int(64 * azimuth));
    }
    for (const auto& [first, end] : {std::pair(order.begin(), others), std::pair(others, order.end())})
        std::sort(
            first, end, [&](std::size_t a, std::size_t b) { return std::pair(patches[a], a) < std::pair(patches[b], b); });
    std::map<double, double> luminances; // a catalogue has few temperatures, because B-V is rounded
    field.stars.reserve(stars.size());
    for (std::size_t i : order) {
        const Star& star = stars[i];
        const double distance = std::max(star.distance_m / unit_m, field.least_distance);
        const double light = sky.brightness_arcmin2 * arcmin2 * std::pow(10, -0.4 * star.magnitude);
        const auto [luminance, added] = luminances.try_emplace(star.temperature_K);
        if (added)
            luminance->second = black_body_xyz(star.temperature_K).y;
        field.stars.push_back({turn * star.direction * distance, light * distance * distance, 1 / luminance->second,
            star.temperature_K, star.radius_m / unit_m});
    }
    return field;
}

double stars_from(const StarField& field, const glm::dvec3& eye, std::span<shared::StarEntry> entries)
{
    double nearest_square = std::numeric_limits<double>::infinity();
    const double least_square = field.least_distance * field.least_distance;
    for (std::size_t i = 0; i < field.stars.size(); ++i) {
        const PlacedStar& star = field.stars[i];
        const glm::dvec3 way = star.place - eye;
        const double square = glm::dot(way, way), distance = std::sqrt(square);
        const glm::dvec3 n = distance > 0 ? way / distance : glm::dvec3(0, 0, -1);
        const double light = star.light / std::max(square, least_square);
        entries[i] = {glm::vec4(n, star.temperature_K),
            glm::vec4(light * star.over_luminance, light,
                star.radius > 0 ? std::asin(std::min(star.radius / distance, 1.0)) : 0, std::min(distance, 1e30))};
        nearest_square = std::min(nearest_square, square);
    }
    return std::sqrt(nearest_square);
}

} // namespace starbow
