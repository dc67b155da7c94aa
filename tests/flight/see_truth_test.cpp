// The descriptions that are read aloud to people who do not see: each statement that can be computed is a predicate of the
// flight's state while the description's step lasts, by formulas that share no code with the program. A description that is
// not listed here fails, and one whose words have changed fails until it is looked at again.
#include "config/model/scene_file.h"
#include "config/model/shipped.h"
#include "config/model/tour_file.h"
#include "runtime/shadow/occluders.h"
#include "runtime/world/world.h"
#include "runtime/world/worldline.h"
#include "tests/support/files.h"
#include "tests/support/tour_frame.h"
#include "tests/support/words_files.h"
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

namespace see_truth_test {

using namespace starbow;
using namespace starbow::testing;
using glm::dvec2, glm::dvec3;

namespace {

/// The steps in a row that have one description, and the tour's first frame.
struct Spoken {
    Frame first; ///< of the tour
    std::vector<Frame> frames; ///< every tenth of a second, from the first step's beginning to the last one's end
    const Frame& begin() const { return frames.front(); }
    const Frame& end() const { return frames.back(); }
    bool always(const std::function<bool(const Frame&)>& holds) const { return std::ranges::all_of(frames, holds); }
    bool once(const std::function<bool(const Frame&)>& holds) const { return std::ranges::any_of(frames, holds); }
    /// Grows from each frame to the next; `slack` allows for what stands still.
    bool grows(const std::function<double(const Frame&)>& value, double slack = 1e-9) const
    {
        for (std::size_t i = 1; i < frames.size(); ++i)
            if (value(frames[i]) < value(frames[i - 1]) - slack)
                return false;
        return value(end()) > value(begin());
    }
};
struct Statement {
    const char* words; ///< words of the English text, in their order
    std::function<bool(const Spoken&)> holds;
};
struct Description {
    const char* german; ///< the beginning of the German text, or more where it has a number
    std::vector<Statement> statements;
};

constexpr double half_wide = 16. / 9; ///< a picture of 16 to 9, in half heights

/// In a picture of 16 to 9 with 60 degrees from top to bottom.
bool in_wide(const Frame& f, const dvec3& at)
{
    const dvec2 p = f.in_picture(at);
    const bool in_view = std::abs(p.x) < half_wide && std::abs(p.y) < 1;
    if (in_view && Frame::when_seen)
        Frame::when_seen(f, at);
    return in_view;
}

// The avenue.
const dvec3 column(0, 0, -46), high(0, 3, 0), thick(0.3, 0, 0);
double height(const Frame& f) { return f.size_deg(column, high); }
std::vector<dvec3> avenue()
{
    std::vector<dvec3> all;
    for (int k = 0; k < 20; ++k)
        for (const double x : {-0.8, 0.8})
            all.emplace_back(x, 0, -3 - 2 * k);
    return all;
}
long columns(const Frame& f)
{
    return std::ranges::count_if(avenue(), [&](const dvec3& one) { return f.sees(one); });
}

// The street's tower.
const dvec3 tower(0, 9, -54), tall(0, 10, 0);

// The rainbow: light of 450 nm along y = 0 of the picture.
double nm_at(const Frame& f, double x)
{
    const dvec3 n = glm::normalize(f.cockpit * dvec3(x * std::tan(30 * degree), 0, -1));
    const double g = f.gamma(), u = glm::length(f.u);
    return 450 * (g - (u > 0 ? glm::dot(f.u, n) : 0)); // D = 1 / (gamma (1 - beta cos))
}
/// Names by common bounds. Below 400 and above 700 nm the eye has less than a two-hundredth of its best response (CIE 1924).
std::string colour_of(double nm)
{
    return nm < 400 ? "dark"
        : nm < 435  ? "violet"
        : nm < 490  ? "blue"
        : nm < 565  ? "green"
        : nm < 590  ? "yellow"
        : nm < 620  ? "orange"
        : nm < 700  ? "red"
                    : "dark";
}
std::vector<std::string> colours(const Frame& f)
{
    std::vector<std::string> all;
    for (double x = -half_wide; x <= half_wide; x += 0.01)
        if (const std::string one = colour_of(nm_at(f, x)); all.empty() || all.back() != one)
            all.push_back(one);
    return all;
}
bool shows(const Frame& f, const std::string& colour)
{
    const auto all = colours(f);
    return std::ranges::find(all, colour) != all.end();
}

// The clocks.
dvec3 clock_at(int k) { return {5. * k, 0, 0}; }
double shown_by(const Frame& f, int k) { return f.left(clock_at(k)); }
double row_deg(const Frame& f) { return f.size_deg({0, 0, 0}, {20, 0, 0}); }
double wide_deg(const Frame& f, int k) { return f.size_deg(clock_at(k), {3.8, 0, 0}); }

// The twins.
constexpr double g = 5. / 3, v = 0.8, astern = 0.08 * 0.62;
const dvec3 home(-1.3, 0, 0), dial(1.24, 0, 0), golden(1.3, -0.35, -8);
double traveller_deg(const Frame& f) { return f.size_deg(travellers_dial(f), dial); }
double home_deg(const Frame& f) { return f.size_deg(home, dial); }
/// The clock of the ship beside which the eye flies out, which rests beside the eye; the light's way is that on board.
dvec3 beside(const Frame& f)
{
    // On board: x aside, and so far astern. The dial's world line out is z = -0.8 t in the world.
    const double ahead = g * (f.at.z + v * f.time), across_x = 1.3 - f.at.x; // the eye's place along z on board
    const double way = std::hypot(across_x, f.at.y, ahead), then = g * (f.time + v * f.at.z) - way;
    return {1.3, 0, -g * v * then};
}

// The sky: right ascension and declination to the world's axes. Proxima lies straight ahead, and the tour says where the
// Pleiades are.
dvec3 equatorial(double ra_deg, double dec_deg)
{
    const double a = ra_deg * degree, d = dec_deg * degree;
    return {std::cos(d) * std::cos(a), std::cos(d) * std::sin(a), std::sin(d)};
}
const dvec3 pleiades(0.30382802304345763, -0.5772852186744786, 0.7579118080050367);
/// Axes from two directions.
glm::dmat3 axes(const dvec3& one, const dvec3& other)
{
    const dvec3 across = glm::normalize(glm::cross(one, other));
    return {one, across, glm::cross(one, across)};
}
dvec3 star(double ra_deg, double dec_deg)
{
    static const glm::dmat3 turn
        = axes({0, 0, -1}, pleiades) * glm::transpose(axes(equatorial(217.429, -62.6795), equatorial(56.8712, 24.1051)));
    return turn * equatorial(ra_deg, dec_deg);
}
/// Alpha Centauri: SIMBAD's place, 742.12 milliseconds of arc (Hipparcos), magnitudes -0.01 and 1.33 of its two stars.
dvec3 alpha_centauri() { return 1000 / 742.12 * 3.261564 * star(219.9020, -60.8340); }
/// The catalogue's stars with their magnitudes, to magnitude 5.
const std::vector<std::pair<dvec3, double>>& bright_stars()
{
    static std::vector<std::pair<dvec3, double>> all;
    if (!all.empty())
        return all;
    std::ifstream file(source_dir() / "scenes/stars/stars.txt");
    for (std::string line; std::getline(file, line);) {
        std::istringstream parts(line);
        double ra = 0, dec = 0, magnitude = 0;
        if (line[0] != '#' && parts >> ra >> dec >> magnitude && magnitude < 500)
            all.emplace_back(star(1e-5 * ra, 1e-5 * dec), 0.01 * magnitude);
    }
    return all;
}
double corner_D(const Frame& f, double way)
{
    // The largest (1) or least (-1) shift of light in the picture's corners and middle.
    double most = -1e300;
    for (const double x : {-half_wide, 0., half_wide})
        for (const double y : {-1., 0., 1.}) {
            const dvec3 n = glm::normalize(f.cockpit * dvec3(x * std::tan(30 * degree), y * std::tan(30 * degree), -1));
            most = std::max(most, way / (f.gamma() - glm::dot(f.u, n)));
        }
    return way * most;
}
/// The width of the circle in which a part of an even sky is seen.
double sky_deg(const Frame& f, double part)
{
    const double to = std::acos(1 - 2 * part);
    return 4 * std::atan(std::tan(to / 2) * std::exp(-std::asinh(glm::length(f.u)))) / degree;
}
double off_deg(const Frame& f, const dvec3& direction) { return f.off_middle_deg(f.at + 1e12 * direction); }

// The solar system; the Earth at the origin. Axes: -z is the first point of Aries, y north.
constexpr double earth_s = 6371 / 299792.458, sun_s = 695700 / 299792.458, saturn_s = 58232 / 299792.458;
/// The Sun on 12 August 2026 at 17:46 UT by the Astronomical Almanac's short formula, to 0.01 degrees of its own date;
/// 26.6 years of precession are 0.37 degrees.
dvec3 sun()
{
    const double n = 9720.24, L = 280.460 + 0.9856474 * n, anomaly = (357.528 + 0.9856003 * n) * degree;
    const double longitude = (L + 1.915 * std::sin(anomaly) + 0.020 * std::sin(2 * anomaly)) * degree,
                 tilt = 23.436 * degree;
    const double far_s = 499.005 * (1.00014 - 0.01671 * std::cos(anomaly));
    const dvec3 e(std::cos(longitude), std::cos(tilt) * std::sin(longitude), std::sin(tilt) * std::sin(longitude));
    return far_s * dvec3(-e.y, e.z, -e.x);
}
const dvec3 saturn(-1065.36964085 + 0.582790378366, 245.286484011 + 0.338137762192, -4265.03607586 - 0.738930462672);

/// The southern lights' curtain where the tour of them begins to fly at it, 120 km above the sea.
const dvec3 curtain(0.0064587, -0.0195263, -0.0067516);
/// The colour of its light that has a wavelength where it shines.
std::string seen_nm(const Frame& f, double nm) { return colour_of(nm / f.D(curtain)); }
constexpr double oxygen_green = 557.7, oxygen_red = 630.0, nitrogen = 391.4; ///< lines in air

/// A glide's last thousandth of a second is not rest to the bit.
bool rests(const Frame& f) { return glm::length(f.u) < 1e-3; }
bool stands(const Spoken& s)
{
    return s.begin().time == s.end().time && s.begin().at == s.end().at && s.begin().u == s.end().u;
}

const std::map<std::string, Description>& descriptions()
{
    const auto ahead = [](const Frame& f) { return f.off_middle_deg(column) < 3; };
    static const std::map<std::string, Description> all{
        {"first-minute.see-0",
            {"Wir schweben im All vor einer Allee",
                {{"before an avenue",
                     [](const Spoken& s) { return s.always([](const Frame& f) { return columns(f) >= 6; }); }},
                    {"straight ahead, a single column stands",
                        [=](const Spoken& s) {
                            return s.always([=](const Frame& f) {
                                return ahead(f) && std::ranges::all_of(avenue(), [&](const dvec3& one) {
                                    return !f.sees(one) || (f.off_middle_deg(one) > 3 && f.away(one) < f.away(column));
                                });
                            });
                        }}}}},
        {"first-minute.see-1",
            {"Noch bewegt sich nichts. Die Säule vor uns sieht so hoch aus wie eine Hand",
                {{"Nothing moves yet", [](const Spoken& s) { return s.always(rests); }},
                    // A hand of 17 to 21 cm (DIN 33402) at 65 to 75 cm is seen at 13 to 18 degrees.
                    {"as high as a hand at arm’s length",
                        [](const Spoken& s) {
                            return s.always([](const Frame& f) { return height(f) > 13 && height(f) < 18; });
                        }}}}},
        {"first-minute.see-2",
            {"Während wir schneller werden, schrumpft alles vor uns zur Mitte hin. Später sind sogar Säulen im Bild, die "
             "genau neben uns",
                {{"we speed up", [](const Spoken& s) { return s.grows([](const Frame& f) { return glm::length(f.u); }); }},
                    {"everything ahead shrinks",
                        [](const Spoken& s) { return s.grows([](const Frame& f) { return -height(f); }, 1e-3); }},
                    {"columns right beside us are in view",
                        [](const Spoken& s) {
                            return s.once([](const Frame& f) {
                                return std::ranges::any_of(avenue(),
                                    [&](const dvec3& one) { return f.sees(one) && std::abs(one.z - f.at.z) < 0.1; });
                            }) && rests(s.begin());
                        }}}}},
        {"first-minute.see-3",
            {"Das Bild steht still. Die Säule vor uns ist nicht halb so hoch",
                {{"The picture stands still", stands},
                    {"less than half as high as at first",
                        [](const Spoken& s) { return height(s.begin()) < 0.5 * height(s.first); }}}}},
        {"first-minute.see-4",
            {"Die Säule vor uns wächst wieder, erst langsam, dann schnell",
                {{"grows again", [](const Spoken& s) { return s.grows(height, 1e-3); }},
                    {"slowly at first, then fast",
                        [](const Spoken& s) {
                            const double middle = height(s.frames[s.frames.size() / 2]);
                            return middle - height(s.begin()) < 0.25 * (height(s.end()) - height(s.begin()));
                        }}}}},
        {"first-minute.see-5",
            {"Die Säule ist so breit wie am Anfang und fast so hoch",
                {{"as wide as at the beginning",
                     [](const Spoken& s) {
                         return std::abs(s.end().size_deg(column, thick) / s.first.size_deg(column, thick) - 1) < 0.01;
                     }},
                    {"nearly as high",
                        [](const Spoken& s) {
                            const double part = height(s.end()) / height(s.first);
                            return part > 0.85 && part < 1;
                        }}}}},
        {"first-minute.see-6",
            {"Als das Schiff hält, schwillt das ganze Bild an: Die Säule ragt",
                {{"the ship stops", [](const Spoken& s) { return !rests(s.begin()) && rests(s.end()); }},
                    {"swells", [](const Spoken& s) { return s.grows(height); }},
                    {"towers", [](const Spoken& s) { return height(s.end()) > 60; }}}}},
        {"first-minute.see-7",
            {"Wieder die Allee, in Ruhe, von weiter hinten",
                {{"The avenue again",
                     [](const Spoken& s) { return s.always([](const Frame& f) { return columns(f) > 6; }); }},
                    {"at rest", [](const Spoken& s) { return s.always(rests); }},
                    {"from farther back", [](const Spoken& s) { return s.end().away(column) > s.first.away(column); }}}}},
        {"first-minute.see-8", {"Ihr eigener Flug", {}}},

        {"street.see-0",
            {"Wir fahren langsam durch eine Straße",
                {{"slowly",
                     [](const Spoken& s) {
                         return s.always([](const Frame& f) { return f.beta() > 0 && f.beta() < 0.31; });
                     }},
                    {"towards a tower",
                        [=](const Spoken& s) {
                            return s.always([=](const Frame& f) { return f.off_middle_deg(tower) < 8; });
                        }}}}},
        {"street.see-1",
            {"Die Straße weicht zurück und wird vorn enger; Häuser, an denen wir vorbei sind",
                {{"draws away",
                     [=](const Spoken& s) { return s.end().size_deg(tower, tall) < s.begin().size_deg(tower, tall); }},
                    {"houses that we have passed come into view",
                        [](const Spoken& s) {
                            return s.once([](const Frame& f) {
                                return in_wide(f, {5, 2, f.at.z + 1});
                            }) && !in_wide(s.begin(), {5, 2, s.begin().at.z + 1});
                        }}}}},
        {"street.see-2",
            {"Rechts die Häuser neben uns",
                {{"houses beside us",
                    [](const Spoken& s) {
                        return s.always([](const Frame& f) { return f.off_middle_deg(f.at + dvec3(5, 0, 0)) < 1; });
                    }}}}},
        {"street.see-3",
            {"Wir sehen wieder die Straße entlang",
                {{"along the street", [](const Spoken& s) { return (s.end().cockpit * dvec3(0, 0, -1)).z < -0.9999; }}}}},
        {"street.see-4",
            {"Die ganze Straße wird blau, am meisten vorn",
                {{"whole street turns blue",
                     [](const Spoken& s) { return s.always([](const Frame& f) { return corner_D(f, -1) > 1; }); }},
                    {"most of all ahead",
                        [=](const Spoken& s) {
                            return s.always(
                                [=](const Frame& f) { return std::abs(f.D(tower) / corner_D(f, 1) - 1) < 0.05; });
                        }}}}},
        {"street.see-5",
            {"Die Straße steht wieder gerade, in ihren eigenen Farben",
                {{"upright again, in its own colours", [](const Spoken& s) { return s.always(rests); }}}}},
        {"street.see-6", {"Die Straße in Ruhe", {{"at rest", [](const Spoken& s) { return s.always(rests); }}}}},
        {"street.see-7", {"Ihre eigene Fahrt", {}}},

        {"voyage.see-0",
            {"Ein Himmel voller Sterne. Genau geradeaus leuchtet keiner; dicht daneben steht der hellste im Bild, Alpha "
             "Centauri",
                {{"Straight ahead none shines",
                     [](const Spoken& s) {
                         return std::ranges::none_of(
                             bright_stars(), [&](const auto& one) { return off_deg(s.end(), one.first) < 1; });
                     }},
                    {"close beside it", [](const Spoken& s) { return s.end().off_middle_deg(alpha_centauri()) < 3; }},
                    {"the brightest in view",
                        [](const Spoken& s) {
                            return std::ranges::none_of(bright_stars(), [&](const auto& one) {
                                return one.second < 0 && in_wide(s.end(), s.end().at + 1e12 * one.first)
                                    && off_deg(s.end(), one.first) > 3;
                            });
                        }}}}},
        {"voyage.see-1",
            {"Die Sterne sammeln sich vorn, heller und bläulicher",
                {{"gather ahead",
                     [](const Spoken& s) { return s.grows([](const Frame& f) { return -sky_deg(f, 0.5); }, 1e-3); }},
                    {"brighter and bluer", [](const Spoken& s) { return corner_D(s.end(), 1) > 2; }}}}},
        {"voyage.see-2",
            {"Der Blick dreht sich um: Hinten ist alles dunkel",
                {{"turns round",
                     [](const Spoken& s) {
                         return s.begin().off_middle_deg({0, 0, -1e9}) < 3 && s.end().sees({0, 0, 1e9});
                     }},
                    // The hottest stars have 30,000 K; at a fifth of that and D^3 of the light they are 5 magnitudes
                    // fainter.
                    {"all is dark", [](const Spoken& s) { return corner_D(s.end(), 1) < 0.22; }}}}},
        {"voyage.see-3",
            {"Der Blick dreht sich wieder nach vorn, wo die Sterne sich drängen",
                {{"turns ahead again",
                     [](const Spoken& s) {
                         return off_deg(s.end(), {0, 0, -1}) < 1;
                     }},
                    {"where the stars crowd", [](const Spoken& s) { return sky_deg(s.end(), 0.5) < 45; }}}}},
        {"voyage.see-4",
            {"Die Sterne verteilen sich wieder über das ganze Bild",
                {{"spread out",
                    [](const Spoken& s) {
                        return s.grows([](const Frame& f) { return sky_deg(f, 0.5); }, 1e-3)
                            && glm::length(s.end().u) < 0.01;
                    }}}}},
        {"voyage.see-5",
            {"Vor uns leuchtet ein roter Stern; daneben zwei, die viel heller sind als alle anderen",
                {{"A red star shines before us",
                     [](const Spoken& s) {
                         return s.always([](const Frame& f) { return f.sees({0, 0, -4.244064771850923}); });
                     }},
                    {"to one side are two stars", [](const Spoken& s) { return in_wide(s.end(), alpha_centauri()); }},
                    // The fainter one of the two, beside the brightest of all stars seen from home.
                    {"far brighter than all others",
                        [](const Spoken& s) {
                            const double nearer = s.end().away(alpha_centauri()) / glm::length(alpha_centauri());
                            return 1.33 + 5 * std::log10(nearer) < -1.46 - 2.5;
                        }}}}},
        {"voyage.see-6",
            {"Geradeaus steht das Siebengestirn",
                {{"stand straight ahead",
                     [](const Spoken& s) {
                         return s.always([](const Frame& f) { return off_deg(f, star(56.8712, 24.1051)) < 1; });
                     }},
                    // The seven, from Atlas to Celaeno and Sterope.
                    {"a little group",
                        [](const Spoken& s) {
                            return std::ranges::count_if(bright_stars(), [&](const auto& one) {
                                return off_deg(s.end(), one.first) < 1.5;
                            }) >= 6;
                        }}}}},
        {"voyage.see-7",
            {"Alle Sterne ziehen sich zu einer hellen Wolke zusammen, dann zu einem Fleck von wenigen Grad",
                {{"a spot a few degrees wide",
                     [](const Spoken& s) { return sky_deg(s.end(), 0.95) > 1 && sky_deg(s.end(), 0.95) < 5; }},
                    {"draw together",
                        [](const Spoken& s) { return s.grows([](const Frame& f) { return -sky_deg(f, 0.95); }, 1e-3); }}}}},
        {"voyage.see-8",
            {"Der Fleck öffnet sich wieder",
                {{"The spot opens again",
                    [](const Spoken& s) { return sky_deg(s.begin(), 0.95) < 5 && glm::length(s.end().u) < 0.1; }}}}},
        {"voyage.see-9", {"Ringsum helle blaue Sterne", {}}},
        {"voyage.see-10",
            {"Die dichtesten Wolken der Milchstraße, zu ihrer Mitte hin",
                {{"towards its middle", // Sagittarius A*
                    [](const Spoken& s) { return off_deg(s.end(), star(266.4168, -29.0078)) < 1; }}}}},
        {"voyage.see-11",
            {"Der ganze Himmel schrumpft zu einem Fleck und wird zum Punkt",
                {{"shrinks",
                     [](const Spoken& s) { return s.grows([](const Frame& f) { return -sky_deg(f, 0.95); }, 1e-3); }},
                    {"becomes a point", // a pixel of 720 over 60 degrees
                        [](const Spoken& s) { return sky_deg(s.end(), 0.95) < 1. / 12; }}}}},
        {"voyage.see-12",
            {"Ein einziger Lichtpunkt im Dunkel",
                {{"A single point of light", [](const Spoken& s) { return sky_deg(s.begin(), 0.95) < 1. / 12; }}}}},
        {"voyage.see-13", {"Ihr eigener Flug", {}}},

        {"solar-system.see-0",
            {"Die ganze Erde, größtenteils im Tageslicht",
                {{"The whole Earth",
                     [](const Spoken& s) {
                         const double radius = s.end().ball_deg(dvec3(0), earth_s) / 2;
                         return s.end().off_middle_deg(dvec3(0)) + radius < s.end().half_view_deg && radius > 10;
                     }},
                    {"most of it in daylight",
                        [](const Spoken& s) {
                            const double lit = 0.5 * (1 + glm::dot(glm::normalize(s.end().at), glm::normalize(sun())));
                            return lit > 0.7 && lit < 0.95;
                        }}}}},
        {"solar-system.see-1",
            {"Der Horizont mit einer dünnen blauen Linie aus Luft darüber",
                {{"The horizon, with air above it.",
                     [](const Spoken& s) {
                         // At the end of the way down: from straight down the horizon is asin(R / r) away.
                         const Frame& f = s.end();
                         const double off = f.off_middle_deg(dvec3(0)),
                                      edge = std::asin(earth_s / glm::length(f.at)) / degree;
                         return std::abs(edge - off) < 15 && f.seen(dvec3(0)).y < 0;
                     }},
                    {"a thin line", // three scale heights of 8 km, on the horizon
                        [](const Spoken& s) {
                            const double far
                                = std::sqrt(std::pow(glm::length(s.end().at), 2) - earth_s * earth_s) * 299792.458;
                            const double deg = 24 / far / degree;
                            return deg > 0.3 && deg < 2;
                        }}}}},
        {"solar-system.see-2",
            {"Die Erde von fern, nahe ihrem Rand ein dunkler runder Fleck",
                {{"The Earth from afar",
                     [](const Spoken& s) { return s.end().sees(dvec3(0)) && glm::length(s.end().at) > 2 * earth_s; }},
                    // The shadow's axis passes the Earth's middle at 0.8977 of its radius (NASA's Five Millennium Catalog):
                    // from the Sun's side the spot is as far from the middle, and round.
                    {"round spot near its edge",
                        [](const Spoken& s) {
                            return glm::dot(glm::normalize(s.end().at), glm::normalize(sun())) > std::cos(5 * degree);
                        }}}}},
        {"solar-system.see-3",
            {"Links die Erde, sonst schwarzer Weltraum",
                {{"The Earth to the left",
                    [](const Spoken& s) { return s.end().in_picture(dvec3(0)).x < -0.3 && s.end().sees(dvec3(0)); }}}}},
        {"solar-system.see-4",
            {"Die Sonne wandert von hinten nach vorn, erst gleißend, dann klein und rot",
                {{"comes round from behind",
                     [](const Spoken& s) {
                         return s.begin().off_middle_deg(sun()) > 90 && in_wide(s.end(), sun())
                             && s.grows([](const Frame& f) { return -f.off_middle_deg(sun()); }, 0.5);
                     }},
                    {"dazzling at first", // bluer and brighter than at rest when it comes into view, or as bright
                        [](const Spoken& s) {
                            for (const Frame& f : s.frames)
                                if (in_wide(f, sun()))
                                    return f.D(sun()) > 0.6;
                            return false;
                        }},
                    {"then small and red", // below 3500 K of 5772 K; half as wide as from the Earth
                        [](const Spoken& s) {
                            return s.end().D(sun()) * 5772 < 3500 && s.end().ball_deg(sun(), sun_s) < 0.3;
                        }},
                    {"the stars gather ahead", [](const Spoken& s) { return sky_deg(s.end(), 0.5) < 10; }}}}},
        {"solar-system.see-5",
            {"Die Sterne verteilen sich wieder, und ein Punkt voraus wächst zum Saturn",
                {{"spread out again", [](const Spoken& s) { return glm::length(s.end().u) < 0.1; }},
                    {"a point ahead",
                        [](const Spoken& s) {
                            return s.begin().off_middle_deg(saturn) < 3 && s.begin().ball_deg(saturn, saturn_s) < 1. / 12;
                        }},
                    {"grows into Saturn",
                        [](const Spoken& s) {
                            return s.once([](const Frame& f) { return f.sees(saturn) && f.ball_deg(saturn, saturn_s) > 2; });
                        }}}}},
        {"solar-system.see-6",
            {"Saturn mit seinen Ringen",
                {{"Saturn with its rings", // 136,780 km, to the A ring's edge; all of it in view
                    [](const Spoken& s) {
                        return s.end().off_middle_deg(saturn) < 5
                            && s.end().ball_deg(saturn, 136780 / 299792.458) < 2 * s.end().half_view_deg + 4
                            && s.end().ball_deg(saturn, saturn_s) > 10;
                    }}}}},
        {"solar-system.see-7",
            {"Die Sonne, klein und gleißend, am schwarzen Himmel",
                {{"The Sun, small",
                    [](const Spoken& s) { return s.end().sees(sun()) && s.end().ball_deg(sun(), sun_s) < 0.1; }}}}},
        {"solar-system.see-8", {"Ihr eigener Flug", {}}},

        {"rainbow.see-0",
            {"Ein Balken aus blauem Licht zieht sich von ganz links nach ganz rechts",
                {{"A bar of blue light from far left to far right,",
                    [](const Spoken& s) {
                        return s.always([](const Frame& f) { return colours(f) == std::vector<std::string>{"blue"}; })
                            && std::atan2(2000., 3.) / degree - 90 > -1;
                    }}}}},
        {"rainbow.see-1",
            {"Noch bewegt sich nichts", {{"Nothing moves yet", [](const Spoken& s) { return s.always(rests); }}}}},
        {"rainbow.see-2",
            {"Das linke Ende des Balkens wird violett und dunkel, das rechte grün, gelb und rot",
                {{"The left end turns violet and dark",
                     [](const Spoken& s) {
                         return s.once([](const Frame& f) { return colour_of(nm_at(f, -half_wide)) == "violet"; })
                             && colour_of(nm_at(s.end(), -half_wide)) == "dark";
                     }},
                    {"the right end green, yellow and red",
                        [](const Spoken& s) {
                            for (const char* colour : {"green", "yellow", "red"})
                                if (!s.once([&](const Frame& f) { return colour_of(nm_at(f, half_wide)) == colour; }))
                                    return false;
                            return true;
                        }},
                    {"the colours spread",
                        [](const Spoken& s) {
                            return s.grows([](const Frame& f) { return nm_at(f, half_wide) - nm_at(f, -half_wide); }, 1);
                        }}}}},
        {"rainbow.see-3",
            {"Von links nach rechts: dunkel, violett, blau, grün, gelb, rot, dunkel",
                {{"dark, violet, blue, green, yellow, red, dark",
                    [](const Spoken& s) {
                        return s.always([](const Frame& f) {
                            auto all = colours(f);
                            std::erase(all, "orange");
                            return all
                                == std::vector<std::string>{"dark", "violet", "blue", "green", "yellow", "red", "dark"};
                        });
                    }}}}},
        {"rainbow.see-4", {"Der Regenbogen steht still", {{"stands still", stands}}}},
        {"rainbow.see-5",
            {"Der Blick dreht sich nach rechts am Balken entlang: Grün, Gelb, Orange und Rot",
                {{"turns to the right",
                     [](const Spoken& s) {
                         return s.grows([](const Frame& f) { return (f.cockpit * dvec3(0, 0, -1)).x; });
                     }},
                    {"green, yellow, orange and red",
                        [](const Spoken& s) {
                            for (const char* colour : {"green", "yellow", "orange", "red"})
                                if (!s.once([&](const Frame& f) { return shows(f, colour); }))
                                    return false;
                            return true;
                        }}}}},
        {"rainbow.see-6",
            {"Der Balken endet in Rot; dahinter ist es schwarz",
                {{"ends in red; beyond, black",
                    [](const Spoken& s) {
                        const auto all = colours(s.end());
                        return all.back() == "dark" && all[all.size() - 2] == "red"
                            && colour_of(nm_at(s.end(), half_wide / 2)) == "dark";
                    }}}}},
        {"rainbow.see-7",
            {"Der Blick dreht sich nach links durch alle Farben, bis zum Violett",
                {{"turns left",
                     [](const Spoken& s) {
                         return s.grows([](const Frame& f) { return -(f.cockpit * dvec3(0, 0, -1)).x; });
                     }},
                    {"through all colours, up to violet",
                        [](const Spoken& s) {
                            for (const char* colour : {"red", "orange", "yellow", "green", "blue"})
                                if (!s.once([&](const Frame& f) { return shows(f, colour); }))
                                    return false;
                            return shows(s.end(), "violet");
                        }}}}},
        {"rainbow.see-8",
            {"Der Balken endet in Violett; dahinter ist es schwarz",
                {{"ends in violet; beyond, black",
                    [](const Spoken& s) {
                        const auto all = colours(s.end());
                        return all[0] == "dark" && all[1] == "violet" && colour_of(nm_at(s.end(), -half_wide / 2)) == "dark";
                    }}}}},
        {"rainbow.see-9",
            {"Während wir langsamer werden, laufen die Farben zusammen, bis der ganze Balken blau ist",
                {{"the whole bar is blue",
                    [](const Spoken& s) {
                        return colours(s.begin()).size() >= 3 && colours(s.end()) == std::vector<std::string>{"blue"};
                    }}}}},
        {"rainbow.see-10", {"Ihr eigener Flug", {}}},

        {"aurora.see-0",
            {"Unter uns die Nachtseite der Erde: Ein heller grüner Vorhang",
                {{"night side below", [](const Spoken& s) { return glm::dot(glm::normalize(s.begin().at), sun()) < 0; }},
                    {"green curtain", [](const Spoken& s) { return seen_nm(s.begin(), oxygen_green) == "green"; }},
                    {"red veil", [](const Spoken& s) { return seen_nm(s.begin(), oxygen_red) == "red"; }}}}},
        {"aurora.see-1",
            {"Während wir darauf zu schneller werden, wird der rote Schleier grün",
                {{"speed up towards it",
                     [](const Spoken& s) { return s.grows([](const Frame& f) { return f.D(curtain); }); }},
                    {"the red veil turns green",
                        [](const Spoken& s) {
                            return seen_nm(s.begin(), oxygen_red) == "red" && seen_nm(s.end(), oxygen_red) == "green";
                        }}}}},
        // Hydroxyl's bands: the tour's first ones are from 700 nm on, the bright ones beyond 1000.
        {"aurora.see-2",
            {"Die dunkle Erde unter dem Vorhang beginnt tiefrot zu leuchten",
                {{"begins to shine, deep red",
                    [](const Spoken& s) { return seen_nm(s.begin(), 850) == "dark" && seen_nm(s.end(), 850) == "red"; }}}}},
        {"aurora.see-3",
            {"Die ganze Nachtseite leuchtet orange",
                {{"shines, orange",
                    [](const Spoken& s) {
                        return seen_nm(s.begin(), 1050) == "dark" && seen_nm(s.end(), 1050) == "orange";
                    }}}}},
        {"aurora.see-4",
            {"Während wir bremsen, wird die Erde dunkel und der Vorhang grün",
                {{"grows dark",
                     [](const Spoken& s) { return seen_nm(s.begin(), 850) != "dark" && seen_nm(s.end(), 750) == "dark"; }},
                    {"green",
                        [](const Spoken& s) { return rests(s.end()) && seen_nm(s.end(), oxygen_green) == "green"; }}}}},
        {"aurora.see-5",
            {"Während wir davonfliegen, wird der Vorhang purpurn",
                {{"fly away", [](const Spoken& s) { return glm::dot(s.end().u, curtain - s.end().at) < 0; }},
                    {"turns purple",
                        [](const Spoken& s) {
                            return seen_nm(s.end(), oxygen_green) == "red" && seen_nm(s.end(), nitrogen) == "blue";
                        }}}}},
        {"aurora.see-6",
            {"Der purpurne Vorhang steht still",
                {{"purple", [](const Spoken& s) { return seen_nm(s.begin(), oxygen_green) == "red"; }},
                    {"stands still", stands}}}},
        {"aurora.see-7",
            {"Der Vorhang ist wieder grün, der Schleier darüber rot, die Erde dunkel",
                {{"green again", [](const Spoken& s) { return seen_nm(s.end(), oxygen_green) == "green"; }},
                    {"above it red", [](const Spoken& s) { return seen_nm(s.end(), oxygen_red) == "red"; }},
                    {"dark", [](const Spoken& s) { return rests(s.end()) && seen_nm(s.end(), 750) == "dark"; }}}}},
        {"simultaneity.see-0",
            {"Fünf große Uhren stehen in einer Reihe",
                {{"Five great clocks in a row",
                    [](const Spoken& s) {
                        return s.always([](const Frame& f) {
                            for (int k = -2; k <= 2; ++k)
                                if (!f.sees(clock_at(k)) || wide_deg(f, k) < 5)
                                    return false;
                            return true;
                        });
                    }}}}},
        {"simultaneity.see-1",
            {"Die Zeiger sind angehalten: Die äußeren liegen etwas hinter dem mittleren",
                {{"have stopped", stands},
                    {"the outer ones a little earlier than the middle one",
                        [](const Spoken& s) {
                            for (const int k : {-2, 2})
                                if (const double late = shown_by(s.end(), 0) - shown_by(s.end(), k); late < 1 || late > 3)
                                    return false;
                            return true;
                        }}}}},
        {"simultaneity.see-2",
            {"Die Reihe gleitet nach links vorbei; rechts laufen die Zeiger schneller als links",
                {{"slides past to the left",
                     [](const Spoken& s) {
                         return s.grows([](const Frame& f) { return -f.in_picture(clock_at(0)).x; }, 1e-6);
                     }},
                    {"the hands on the right run faster",
                        [](const Spoken& s) {
                            return s.always([](const Frame& f) {
                                for (int k = -2; k < 2; ++k)
                                    if (f.D(clock_at(k + 1)) < f.D(clock_at(k)) + 0.03)
                                        return false;
                                return true;
                            });
                        }}}}},
        {"simultaneity.see-3",
            {"Das Bild steht still, die mittlere Uhr vor uns",
                {{"stands still", stands},
                    {"the middle clock before us",
                        [](const Spoken& s) { return s.end().off_middle_deg(clock_at(0)) < 1; }}}}},
        {"simultaneity.see-4",
            {"Die fünf Zeiger zeigen fünf verschiedene Zeiten",
                {{"five different times",
                    [](const Spoken& s) {
                        for (int k = -2; k < 2; ++k)
                            if (std::abs(shown_by(s.end(), k + 1) - shown_by(s.end(), k)) < 1)
                                return false;
                        return true;
                    }}}}},
        {"simultaneity.see-5",
            {"Als wir halten, drehen wir uns mit der Reihe nach links, und sie rückt etwas zusammen. Die Zeiger bleiben",
                {{"we turn to the left",
                     [](const Spoken& s) {
                         return rests(s.end()) && s.grows([](const Frame& f) { return -(f.cockpit * dvec3(0, 0, -1)).x; });
                     }},
                    {"with the row",
                        [](const Spoken& s) {
                            return s.always([](const Frame& f) { return f.off_middle_deg(clock_at(0)) < 8; });
                        }},
                    {"draws together a little",
                        [](const Spoken& s) {
                            return row_deg(s.end()) < 0.95 * row_deg(s.begin())
                                && row_deg(s.end()) > 0.8 * row_deg(s.begin());
                        }},
                    {"The hands stay",
                        [](const Spoken& s) {
                            for (int k = -2; k <= 2; ++k)
                                if (std::abs(shown_by(s.end(), k) - shown_by(s.begin(), k)) > 0.01)
                                    return false;
                            return true;
                        }}}}},
        {"simultaneity.see-6",
            {"Die Reihe zieht sich nach links in die Ferne; die fernste Uhr sieht am kleinsten aus",
                {{"away to the left",
                     [](const Spoken& s) {
                         for (int k = -2; k < 2; ++k)
                             if (s.end().in_picture(clock_at(k)).x > s.end().in_picture(clock_at(k + 1)).x
                                 || s.end().away(clock_at(k)) < s.end().away(clock_at(k + 1)))
                                 return false;
                         return true;
                     }},
                    {"the farthest looks smallest",
                        [](const Spoken& s) {
                            for (int k = -1; k <= 2; ++k)
                                if (wide_deg(s.end(), k) <= wide_deg(s.end(), -2))
                                    return false;
                            return true;
                        }}}}},
        {"simultaneity.see-7", {"Ihr eigener Flug", {}}},

        {"twins.see-0",
            {"Zwei kleine Schiffe nebeneinander, jedes mit einer Uhr. Vorn hängen Ringe in einer Reihe, der letzte golden; "
             "links steht ein Riesenplanet",
                {{"Two small ships side by side",
                     [](const Spoken& s) {
                         return s.always([](const Frame& f) {
                             return f.sees(home) && f.sees({1.3, 0, 0}) && f.in_picture(home).x < 0
                                 && f.in_picture({1.3, 0, 0}).x > 0 && home_deg(f) > 3;
                         });
                     }},
                    {"rings in a line, the last one golden",
                        [](const Spoken& s) { return s.end().sees(golden) && s.end().away(golden) > 8; }},
                    {"to the left a giant planet",
                        [](const Spoken& s) {
                            const dvec3 giant(-46, 17, -100);
                            return s.end().sees(giant) && s.end().in_picture(giant).x < 0
                                && s.end().ball_deg(giant, 26) > 20;
                        }}}}},
        {"twins.see-1",
            {"Das rechte Schiff schießt durch die Ringe davon und schrumpft auf wenig mehr als seine halbe Größe",
                {{"The right ship",
                     [](const Spoken& s) {
                         return s.always([](const Frame& f) { return f.in_picture(travellers_dial(f)).x > 0; });
                     }},
                    {"to little more than half its size",
                        [](const Spoken& s) {
                            const double part = traveller_deg(s.end()) / traveller_deg(s.begin());
                            return part > 0.5 && part < 0.65;
                        }}}}},
        {"twins.see-2",
            {"Das rechte Schiff kriecht weiter auf den goldenen Ring zu und wird immer kleiner",
                {{"ever smaller",
                     [](const Spoken& s) { return s.grows([](const Frame& f) { return -traveller_deg(f); }, 0.05); }},
                    {"towards the golden ring",
                        [](const Spoken& s) {
                            return glm::distance(travellers_dial(s.end()), golden)
                                < glm::distance(travellers_dial(s.begin()), golden);
                        }}}}},
        {"twins.see-3",
            {"Das Bild steht still: Das andere Schiff ist im goldenen Ring",
                {{"stands still", stands},
                    {"in the golden ring",
                        [](const Spoken& s) {
                            const dvec3 off = travellers_dial(s.end()) - golden; // its clock; the hull is 0.98 below
                            return std::abs(off.z) < 0.3 && std::hypot(off.x, off.y) < 1.2
                                && std::hypot(off.x, off.y - 0.98) < 1.2;
                        }}}}},
        {"twins.see-4",
            {"Das Schiff kommt zurück und wächst schnell",
                {{"growing fast",
                    [](const Spoken& s) { return traveller_deg(s.end()) > 1.7 * traveller_deg(s.begin()); }}}}},
        {"twins.see-5",
            {"Es liegt wieder neben dem anderen Schiff, so groß wie am Anfang",
                {{"beside the other ship again, as large as at first",
                    [](const Spoken& s) {
                        return std::abs(traveller_deg(s.end()) / home_deg(s.end()) - 1) < 0.05
                            && std::abs(traveller_deg(s.end()) / traveller_deg(s.first) - 1) < 0.05;
                    }}}}},
        {"twins.see-6",
            {"Die Schiffe liegen nebeneinander: Eine Uhr zeigt 20,5, die andere 12,5.",
                {{"one clock shows 20.5", [](const Spoken& s) { return std::abs(home_clock(s.end()) - 20.5) < 0.05; }},
                    {"the other 12.5", [](const Spoken& s) { return std::abs(travellers_clock(s.end()) - 12.5) < 0.05; }}}}},
        {"twins.see-7",
            {"Wir blicken vom fliegenden Schiff zurück: Links ist seine eigene Uhr, rechts sind das Zuhause und dessen Uhr",
                {{"We look back",
                     [](const Spoken& s) {
                         return s.always([](const Frame& f) { return f.cosine(home) < -0.9 && f.sees(home); });
                     }},
                    {"its own clock is on the left",
                        [](const Spoken& s) {
                            return s.always([](const Frame& f) {
                                return f.sees(beside(f)) && f.in_picture(beside(f)).x < 0 && f.size_deg(beside(f), dial) > 3;
                            });
                        }},
                    {"home and its clock on the right",
                        [](const Spoken& s) {
                            return s.always([](const Frame& f) { return f.in_picture(home).x > 0 && home_deg(f) > 3; });
                        }}}}},
        {"twins.see-8",
            {"Das Zuhause liegt groß hinter uns, in altem Licht",
                {{"behind us",
                     [](const Spoken& s) {
                         return s.always([](const Frame& f) { return f.cosine(home) < -0.9 && f.sees(home); });
                     }},
                    {"large", [](const Spoken& s) { return s.always([](const Frame& f) { return home_deg(f) > 20; }); }},
                    {"in old light",
                        [](const Spoken& s) {
                            return s.always([](const Frame& f) { return f.time - f.left(home) > 5; });
                        }}}}},
        {"twins.see-9",
            {"Wir kehren im Flug um, und das Bild des Zuhauses schrumpft sofort",
                {{"We turn round",
                     [](const Spoken& s) { return s.begin().u.z < 0 && s.end().u.z > 0 && s.begin().time == s.end().time; }},
                    {"shrinks at once",
                        [](const Spoken& s) {
                            return s.grows([](const Frame& f) { return -home_deg(f); })
                                && home_deg(s.end()) < 0.2 * home_deg(s.begin());
                        }}}}},
        {"twins.see-10",
            {"Das kleine Bild des Zuhauses bleibt vor uns",
                {{"small before us",
                    [](const Spoken& s) {
                        return s.always([](const Frame& f) {
                            return f.off_middle_deg(home) < 10 && home_deg(f) > 1 && home_deg(f) < 5;
                        });
                    }}}}},
        {"twins.see-11",
            {"Das Zuhause kommt näher; der Zeiger seiner Uhr läuft schnell",
                {{"Home comes nearer",
                     [](const Spoken& s) { return s.grows([](const Frame& f) { return -f.away(home); }); }},
                    {"runs fast", [](const Spoken& s) { return s.always([](const Frame& f) { return f.D(home) > 2; }); }}}}},
        {"twins.see-12",
            {"Beide Schiffe stehen wieder nebeneinander",
                {{"side by side",
                    [](const Spoken& s) {
                        return s.end().sees(home) && s.end().sees({1.3, 0, 0}) && s.end().time > 20;
                    }}}}},
        {"twins.see-13",
            {"Die zwei Schiffe vor dem nächsten Start",
                {{"before the next start",
                    [](const Spoken& s) { return s.always([](const Frame& f) {
                                              return f.left({1.3, 0, 0}) < 0;
                                          }); }}}}},
        {"twins.see-14", {"Ihr eigener Flug", {}}},
    };
    return all;
}

/// The description's steps of a tour, one after the other; those that visitors fly are left out.
std::vector<std::pair<std::string, Spoken>> spoken_of(const ShownTour& shown, const nlohmann::json& english)
{
    const auto& [file, tour, half_view_deg] = shown;
    const Show show{tour, {}, unit_s_of(file), false};
    std::vector<std::pair<std::string, Spoken>> all;
    const Frame first = frame_of(touring_at(show), half_view_deg);
    for (Touring touring = touring_at(show); !touring.over;) {
        const std::string text = tour.steps[touring.step()].description;
        std::string key = "?";
        for (const auto& [name, value] : english.items())
            if (name.starts_with("tour." + file.stem().string() + ".see-") && value == text)
                key = name.substr(5);
        if (all.empty() || all.back().first != key)
            all.emplace_back(key, Spoken{first, {}});
        all.back().second.frames.push_back(frame_of(touring, half_view_deg));
        Touring next = advance(touring, show, {}, 100'000'000);
        if (next.step() != touring.step() || next.over)
            for (std::int64_t ms = 99; ms > 0; --ms)
                if (const Touring last = advance(touring, show, {}, ms * 1'000'000);
                    last.step() == touring.step() && !last.over) {
                    all.back().second.frames.push_back(frame_of(last, half_view_deg));
                    break;
                }
        touring = next;
    }
    return all;
}

} // namespace

TEST(SeeTruth, EveryDescriptionIsListed)
{
    const nlohmann::json english = words_file("en"), german = words_file("de");
    std::size_t texts = 0;
    for (const auto& [key, value] : english.items()) {
        if (!key.starts_with("tour.") || key.find(".see-") == key.npos)
            continue;
        ++texts;
        const auto found = descriptions().find(key.substr(5));
        ASSERT_NE(found, descriptions().end()) << key << ": what does it say?";
        EXPECT_TRUE(german.at(key).get<std::string>().starts_with(found->second.german)) << german.at(key);
        for (const Statement& statement : found->second.statements) {
            std::istringstream words(statement.words);
            const std::string text = value;
            std::size_t at = 0;
            for (std::string word; words >> word && at != text.npos; at = at == text.npos ? at : at + word.size())
                at = text.find(word, at);
            EXPECT_NE(at, text.npos) << key << " no longer says " << statement.words;
        }
    }
    EXPECT_EQ(texts, descriptions().size());
}

TEST(SeeTruth, EveryStatementIsThatOfTheStep)
{
    const nlohmann::json english = words_file("en");
    std::set<std::string> met;
    for (const ShownTour& shown : shown_tours())
        for (const auto& [key, spoken] : spoken_of(shown, english)) {
            ASSERT_TRUE(descriptions().contains(key)) << shown.file << " " << key;
            met.insert(key);
            for (const Statement& statement : descriptions().at(key).statements)
                EXPECT_TRUE(statement.holds(spoken)) << key << ": " << statement.words;
        }
    for (const auto& [key, one] : descriptions())
        EXPECT_TRUE(met.contains(key) || one.statements.empty()) << key << " is never said";
}

/// Light comes straight from what rests in the world: no still thing stands in its way. Of many like things, as the columns
/// of an avenue, some stand behind others.
TEST(SeeTruth, NoStillThingHidesWhatADescriptionNames)
{
    const nlohmann::json english = words_file("en");
    std::size_t worlds = 0, looks = 0;
    for (const ShownTour& shown : shown_tours()) {
        const SceneFile scene = load_scene_file(scene_of(shown.tour));
        World world = load_world(scene);
        place_bodies(world, scene);
        const Occluders things(world, world.instances);
        if (things.triangles() == 0)
            continue;
        ++worlds;
        std::map<std::string, std::pair<int, int>> places; // hidden, and all, by the place's text
        Frame::when_seen = [&](const Frame& f, const dvec3& place) {
            const auto hit = things.first(f.at, glm::normalize(place - f.at), 1e37);
            // A place is inside its thing, of which the twins' planet is the largest: 26 of 114 away. Stars are no things
            // here.
            const bool hidden
                = hit && f.away(place) < 1e6 && hit->distance < f.away(place) - std::max(0.25 * f.away(place), 0.7);
            auto& [misses, all]
                = places[std::to_string(place.x) + " " + std::to_string(place.y) + " " + std::to_string(place.z)];
            ++all, ++looks, misses += hidden;
        };
        for (const auto& [key, spoken] : spoken_of(shown, english))
            for (const Statement& statement : descriptions().at(key).statements) {
                places.clear();
                statement.holds(spoken);
                std::size_t hidden = 0;
                for (const auto& [place, count] : places)
                    if (count.first > 0)
                        ++hidden;
                EXPECT_LE(hidden, places.size() > 3 ? places.size() / 2 : 0)
                    << key << ": " << statement.words << ": hidden are " << hidden << " of " << places.size();
            }
        Frame::when_seen = {};
    }
    EXPECT_GE(worlds, 5u);
    EXPECT_GT(looks, 1000u);
    std::printf("  %zu looks in %zu worlds\n", looks, worlds);
}

} // namespace see_truth_test
