#include "stars.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include "config/model/angles.h"
#include "runtime/light/spectrum.h"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

namespace starbow {
namespace {

constexpr double sun_b_v = 0.65; // for stars whose B-V is not known
constexpr std::size_t most_stars = 4'000'000; // 128 MB on the device

/// One whole number of a line; messages about a wrong one name `what` and the range.
struct Column {
    const char* what;
    int low, high;
};
constexpr Column columns[] = {{"right ascension in 1e-4 degrees", 0, 3599999},
    {"declination in 1e-4 degrees", -900000, 900000}, {"magnitude in 0.01", -3000, 3000}, {"B-V in 0.01", -50, 600}};

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
            refuse(quoted(word) + " is no " + column.what + "; a whole number from " + std::to_string(column.low) + " to "
                + std::to_string(column.high) + " is right");
        return value;
    }

    Star star(std::string_view text) const
    {
        std::vector<std::string_view> words;
        for (std::size_t at = 0; (at = text.find_first_not_of(" \t\r", at)) < text.size() && words.size() < 5;) {
            const std::size_t end = std::min(text.find_first_of(" \t\r", at), text.size());
            words.push_back(text.substr(at, end - at));
            at = end;
        }
        if (words.size() != 4)
            refuse(quoted(text) + " is no star; four columns (right ascension, declination, magnitude, B-V) is right");
        const double ra = value(words[0], columns[0]), dec = value(words[1], columns[1]);
        const double magnitude = value(words[2], columns[2]);
        const double b_v = words[3] == "-" ? sun_b_v : 0.01 * value(words[3], columns[3]);
        return {equatorial(1e-4 * ra, 1e-4 * dec), 0.01 * magnitude, temperature_of(b_v)};
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
            Line{file, number}.refuse("is one star too many; at most " + std::to_string(most_stars) + " stars is right");
        stars.push_back(Line{file, number}.star(text));
    }
    if (stars.empty())
        throw InputError(file, "", "holds no star; a catalogue of stars, like scenes/stars/stars.txt, is right");
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

std::vector<shared::StarEntry> star_entries(const std::vector<Star>& stars, const StarSky& sky)
{
    const glm::dmat3 turn = world_from_equatorial(sky.ahead_deg);
    const double arcmin2 = std::pow(degree / 60, 2);
    std::vector<shared::StarEntry> entries;
    entries.reserve(stars.size());
    std::map<double, double> luminances; // a catalogue has few temperatures, because B-V is rounded
    for (const Star& star : stars) {
        const double light = sky.brightness_arcmin2 * arcmin2 * std::pow(10, -0.4 * star.magnitude);
        const auto [luminance, added] = luminances.try_emplace(star.temperature_K);
        if (added)
            luminance->second = black_body_xyz(star.temperature_K).y;
        entries.push_back(
            {glm::vec4(turn * star.direction, star.temperature_K), glm::vec4(light / luminance->second, light, 0, 0)});
    }
    // Sorted by patches of the sky: a GPU draws neighbours together, and neighbours are in or out of view together.
    auto patch = [](const shared::StarEntry& star) {
        const double azimuth = std::atan2(star.direction.z, star.direction.x) / (360 * degree) + 0.5;
        return int(16 * (star.direction.y + 1)) * 64 + int(64 * azimuth);
    };
    std::stable_sort(entries.begin(), entries.end(),
        [&](const shared::StarEntry& a, const shared::StarEntry& b) { return patch(a) < patch(b); });
    return entries;
}

} // namespace starbow
