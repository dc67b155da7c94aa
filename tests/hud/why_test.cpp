// The pages that explain the picture, as they are read: each number of each page is found in its text, in every language,
// and compared with boosts in 33 digits of the state that it is shown for, to the last figure. A sentence that makes a claim
// stands on the page where it is true, and only there.
#include "config/model/scene_file.h"
#include "runtime/hud/why.h"
#include "runtime/world/instances.h"
#include "runtime/world/worldline.h"
#include "tests/support/files.h"
#include "tests/support/quad.h"
#include "tests/support/words_files.h"
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>

namespace why_test {

using namespace starbow;
using namespace starbow::testing;
using glm::dvec3;

namespace {

constexpr double degree = 3.14159265358979324 / 180, light_m_s = 299792458, year_s = 365.25 * 86400;
constexpr const char* languages[] = {"en", "de"};

/// The clocks, the middle one of which rides on a body.
struct Stage {
    dvec3 u{0.9, 0.2, -0.4}, from{1, -1, 4}; ///< the body's velocity, and its place at 2 s, when its own time is 0
    World world;
    std::vector<std::size_t> dials; ///< those at rest
    std::size_t riding = 0;

    Stage()
    {
        SceneFile scene = load_scene_file(source_dir() / "config/scenes/clocks.json");
        scene.bodies = {{"clock", {"dial 3"}, u, {2, from}, {}}};
        world = load_world(scene);
        place_bodies(world, scene);
        sort_instances(world);
        riding = instances_of(world, 1).first;
        const InstanceRange still = instances_of(world, 0);
        for (std::size_t i = still.first; i < still.last; ++i)
            if (world.materials[std::size_t(world.primitives[world.instances[i].primitive].material)].clock)
                dials.push_back(i);
    }
};
const Stage& stage()
{
    static const Stage one;
    return one;
}

/// What is true of a spot, by its light's event: a null vector, boosted.
struct True {
    double D = 1, distance = NAN, left = NAN, clock = NAN; ///< scene units
    double cos_world = NAN, cos_seen = NAN, world_rad = NAN, seen_rad = NAN; ///< from the motion; NaN at rest
    double past_gamma = 1, past_beta = 0, past_cos = NAN; ///< of the ship's motion past the spot
    quad::V3 from{}; ///< in the ship's frame, from the observer to where the light left
};

True truth(const MeasuringObserver& ship, const Spot& spot)
{
    const quad::V3 u = quad::of(ship.u), body = spot.frame ? quad::of(stage().u) : quad::V3{0, 0, 0};
    True is;
    quad::V3 way; // in the world, to the source
    if (spot.sky) {
        way = quad::of(spot.at);
    } else if (spot.frame == 0) {
        way = quad::of(spot.at) - quad::of(ship.place);
        is.clock = spot.clock ? double(ship.time - quad::length(way)) : NAN;
    } else {
        quad::Q low = -1e9, high = 1e9;
        quad::V4 event{};
        for (int i = 0; i < 200; ++i) {
            const quad::Q own = (low + high) / 2;
            event = quad::boosted(body, {own, quad::of(spot.at)});
            event = {event.t + 2 - ship.time, event.x + quad::of(stage().from) - quad::of(ship.place)};
            (event.t + quad::length(event.x) > 0 ? high : low) = own;
        }
        way = event.x;
        is.clock = spot.clock ? double(low) : NAN;
    }
    if (!spot.sky)
        is.distance = double(quad::length(way)), is.left = ship.time - is.distance;
    const quad::V3 n = quad::unit(way);
    const quad::Light on_board = quad::camera_from_world(n, u);
    // Without aberration a thing is drawn where the world has it, with the colour that comes from there on board.
    const quad::V3 seen = ship.aberration ? on_board.n : n;
    is.D = double((ship.aberration ? on_board.D : quad::world_from_camera(n, u).D) / quad::camera_from_world(n, body).D);
    is.from = on_board.n * (quad::length(way) * on_board.D);
    if (quad::length(u) > 0) {
        is.world_rad = quad::angle(n, u), is.seen_rad = quad::angle(seen, u);
        is.cos_world = double(quad::dot(n, quad::unit(u))), is.cos_seen = double(quad::dot(quad::unit(seen), quad::unit(u)));
    }
    // The body's velocity on board; the ship flies past it the other way.
    const quad::V4 past = quad::boosted(u * -1, {quad::gamma(body), body});
    is.past_gamma = double(past.t);
    if (const quad::Q speed = quad::length(past.x); speed > 0) {
        is.past_beta = double(speed / past.t);
        is.past_cos = double(quad::dot(quad::unit(seen), past.x * (-1 / speed)));
    }
    return is;
}

/// A language's file.
const nlohmann::json& file_of(const std::string& language)
{
    static std::map<std::string, nlohmann::json> all;
    auto [at, is_new] = all.try_emplace(language);
    if (is_new)
        at->second = words_file(language);
    return at->second;
}

/// What stands in the places of a text; empty if the line is another text. Names that come twice must have one value.
std::map<std::string, std::string> places_of(const std::string& line, const std::string& text)
{
    std::string pattern;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '{') {
            const std::size_t end = text.find('}', i);
            names.push_back(text.substr(i + 1, end - i - 1));
            pattern += "(.+)", i = end;
        } else {
            pattern += std::string(std::strchr("()[].*+?^$|\\", text[i]) ? "\\" : "") + text[i];
        }
    std::smatch found;
    std::map<std::string, std::string> places;
    if (!std::regex_match(line, found, std::regex(pattern)))
        return places;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto [at, is_new] = places.try_emplace(names[i], found[i + 1]);
        EXPECT_EQ(at->second, found[i + 1]) << line;
    }
    return places;
}

/// A number as it is read, with its unit: SI, or degrees or nanometres.
struct Shown {
    double value = NAN, last = 0; ///< last: half of the last figure's unit
    std::string unit; ///< the unit's key; "" for none
};
Shown read(const std::string& text, const std::string& language)
{
    static const std::vector<std::pair<const char*, double>> units{{"time.s", 1}, {"time.min", 60}, {"time.h", 3600},
        {"time.days", 86400}, {"time.years", year_s}, {"length.m", 1}, {"length.km", 1000}, {"length.light_s", light_m_s},
        {"length.light_min", 60 * light_m_s}, {"length.light_h", 3600 * light_m_s},
        {"length.light_years", year_s * light_m_s}, {"angle.degrees", 1}, {"wave.ultraviolet", 1}, {"wave.visible", 1},
        {"wave.infrared", 1}, {"wave.far_infrared", 1000}};
    const std::string sign = file_of(language)["decimal_sign"];
    static const std::vector<std::string> raised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    const std::regex number(
        "((?:−)?)([0-9]+)(?:" + std::string(sign == "." ? "\\." : sign) + "([0-9]+))?(?:×10((?:⁻|⁰|¹|²|³|⁴|⁵|⁶|⁷|⁸|⁹)+))?");
    Shown shown;
    std::smatch parts;
    std::string figures = text;
    double factor = 1;
    if (!std::regex_match(figures, parts, number))
        for (const auto& [key, size] : units)
            if (const auto places = places_of(text, file_of(language)[key]); !places.empty()) {
                // "3 nm" is no number of metres.
                const std::string inner = places.at("number");
                std::smatch trial;
                if (std::regex_match(inner, trial, number))
                    figures = inner, factor = size, shown.unit = key;
            }
    if (!std::regex_match(figures, parts, number))
        return shown;
    int power = 0;
    if (std::string exponent = parts[4]; !exponent.empty()) {
        const bool negative = exponent.starts_with("⁻");
        for (std::size_t at = negative ? std::string("⁻").size() : 0; at < exponent.size();)
            for (int k = 0; k < 10; ++k)
                if (exponent.compare(at, raised[std::size_t(k)].size(), raised[std::size_t(k)]) == 0) {
                    power = 10 * power + k, at += raised[std::size_t(k)].size();
                    break;
                }
        power = negative ? -power : power;
    }
    const std::string after = parts[3];
    shown.value = factor * std::pow(10, power) * std::stod(parts[2].str() + "." + after + "0");
    shown.value = parts[1].length() ? -shown.value : shown.value;
    shown.last = factor * 0.5 * std::pow(10, power - int(after.size()));
    return shown;
}

/// The text shows this, in figures that are right to the last one. 1e-9: the state is in doubles.
void expect_shows(const std::string& text, double is, const std::string& language)
{
    if (std::isnan(is)) {
        EXPECT_EQ(text, "—");
        return;
    }
    const Shown shown = read(text, language);
    EXPECT_NEAR(shown.value, is, shown.last * (1 + 1e-6) + 1e-9 * std::abs(is) + 1e-12) << text;
}

/// The wavelength's band by its bounds: visible 380 to 780 nm (CIE 15), X-rays 0.01 to 10 nm, ultraviolet and infrared
/// between these and 10 µm; beyond it the number alone, and radio from 1 m.
void expect_wave(const std::string& text, double nm, const std::string& language)
{
    const std::string band = nm < 0.01 ? "wave.gamma_rays"
        : nm < 10                      ? "wave.x_rays"
        : nm < 380                     ? "wave.ultraviolet"
        : nm < 780                     ? "wave.visible"
        : nm < 1e4                     ? "wave.infrared"
        : nm < 1e9                     ? "wave.far_infrared"
                                       : "wave.radio";
    const std::string words = file_of(language)[band];
    const auto places = places_of(text, words);
    if (words.find('{') == words.npos) {
        EXPECT_EQ(text, words) << nm;
        return;
    }
    ASSERT_TRUE(places.contains("number")) << text << " for " << nm;
    const Shown shown = read(places.at("number"), language);
    const double unit = band == "wave.far_infrared" ? 1000 : 1;
    EXPECT_NEAR(shown.value * unit, nm, shown.last * unit * (1 + 1e-6) + 1e-9 * nm) << text;
}

/// The formula, worked out with these numbers.
double aberrated(double cosine, double beta) { return (cosine + beta) / (1 + beta * cosine); }

/// A page's lines of numbers, each taken once.
struct Lines {
    std::vector<std::string> left;
    std::string language;

    /// The values in the places of a text that must be there.
    std::map<std::string, std::string> take(const char* key)
    {
        const std::string text = file_of(language)[key];
        for (std::size_t i = 0; i < left.size(); ++i)
            if (const auto places = places_of(left[i], text); left[i] == text || !places.empty()) {
                left.erase(left.begin() + long(i));
                return places;
            }
        ADD_FAILURE() << "the page lacks " << key << (left.empty() ? "" : ": " + left[0]);
        return {};
    }
};

/// One state, with what is true of it.
struct State {
    Measured m;
    Spot aim;
    std::array<std::optional<Spot>, 2> marks;
    double gamma = 1, beta = 0;
};

void expect_true(Why why, const State& state, const char* language)
{
    const Measured& m = state.m;
    const WhyPage page = why_page(why, m, words(language));
    Lines lines{page.numbers, language};
    const nlohmann::json& all = file_of(language);
    const True aim = truth(m.observer, state.aim);
    const double second = m.seconds_per_time_unit, metres = second * m.light_speed_m_s;
    const auto shows = [&](const std::string& text, double is) { expect_shows(text, is, language); };
    EXPECT_EQ(page.title, all[std::string("why.") + why_names[std::size_t(why)]].get<std::string>());
    const bool compares = m.effects.comparison != Comparison::none;
    if (compares && why != Why::dilation) {
        lines.take("why.comparison");
        EXPECT_TRUE(lines.left.empty());
        return;
    }
    switch (why) {
    case Why::none:
        break;
    case Why::aberration:
        if (!m.effects[Effect::aberration]) { // the formula's angles are not those of the picture
            lines.take("why.aberration_off");
            break;
        }
        {
            auto shown = lines.take("why.aberration_numbers");
            const bool rests = std::isnan(aim.cos_world); // there the formula holds of any angle
            shows(shown["cos"], rests ? 1 : aim.cos_world);
            shows(shown["beta"], state.beta);
            shows(shown["result"], rests ? 1 : aim.cos_seen);
            if (!rests) {
                EXPECT_NEAR(aberrated(aim.cos_world, state.beta), aim.cos_seen, 1e-9 + 1e-15 * state.gamma * state.gamma);
            }
            shown = lines.take("why.aberration_angles");
            shows(shown["theta"], aim.world_rad / degree);
            shows(shown["seen"], aim.seen_rad / degree);
        }
        break;
    case Why::doppler: {
        // 1 - beta cos is as small as 1 / gamma^2, of doubles.
        const double formula = 1 / (aim.past_gamma * (1 - aim.past_beta * (std::isnan(aim.past_cos) ? 1 : aim.past_cos)));
        const bool holds = std::abs(formula / aim.D - 1) < 1e-3 + 1e-15 * aim.past_gamma * aim.past_gamma;
        EXPECT_TRUE(holds || !m.effects[Effect::aberration]);
        if (holds) {
            auto shown = lines.take("why.doppler_numbers");
            shows(shown["gamma"], aim.past_gamma);
            shows(shown["beta"], aim.past_beta);
            shows(shown["cos"], std::isnan(aim.past_cos) ? 1 : aim.past_cos);
            shows(shown["D"], aim.D);
        } else {
            lines.take("why.aberration_off");
        }
        if (m.effects[Effect::doppler])
            expect_wave(lines.take("why.doppler_seen")["nm"], 550 / aim.D, language);
        else
            lines.take("why.doppler_off");
        break;
    }
    case Why::headlight: {
        auto shown = lines.take("why.headlight_numbers");
        shows(shown["D"], aim.D);
        shows(shown["cube"], aim.D * aim.D * aim.D);
        if (!m.effects[Effect::headlight])
            lines.take("why.headlight_off");
        break;
    }
    case Why::delay:
        if (state.aim.sky) {
            lines.take("why.delay_none");
        } else {
            auto shown = lines.take("why.delay_numbers");
            shows(shown["now"], m.observer.time * second);
            shows(shown["way"], aim.distance * second);
            shows(shown["left"], aim.left * second);
        }
        if (state.marks[0] && state.marks[1] && state.marks[0]->clock && state.marks[1]->clock) {
            auto shown = lines.take("why.delay_marks");
            const double first = truth(m.observer, *state.marks[0]).clock, other = truth(m.observer, *state.marks[1]).clock;
            shows(shown["first"], first * second);
            shows(shown["second"], other * second);
            shows(shown["apart"], std::abs(other - first) * second);
        }
        break;
    case Why::dilation: {
        shows(lines.take("why.dilation_numbers")["gamma"], state.gamma);
        shows(lines.take("why.dilation_ship")["ship"], m.ship_s);
        break;
    }
    case Why::length:
        if (!state.marks[0] || !state.marks[1]) {
            lines.take("why.length_none");
        } else if (state.marks[0]->sky || state.marks[1]->sky) {
            lines.take("why.length_sky");
        } else if (!m.effects[Effect::aberration]) {
            lines.take("why.aberration_off");
        } else {
            const Spot &a = *state.marks[0], &b = *state.marks[1];
            const bool together = a.frame == b.frame; // else nothing of it is at rest
            double rest = NAN, contracted = NAN;
            if (together) {
                const quad::V3 apart = quad::of(b.at) - quad::of(a.at);
                // Simultaneous on board: the events (s, apart) of their frame with the ship's time 0.
                const quad::V4 past = quad::boosted(quad::of(a.frame ? stage().u : dvec3(0)) * -1,
                    {quad::gamma(quad::of(m.observer.u)), quad::of(m.observer.u)});
                const quad::Q s = quad::dot(past.x, apart) * (1 / past.t);
                rest = double(quad::length(apart));
                contracted = double(quad::length(quad::boosted(past.x * -1, {s, apart}).x));
            }
            auto shown = lines.take("why.length_numbers");
            shows(shown["rest"], rest * metres);
            shows(shown["contracted"], contracted * metres);
            const quad::V3 first = truth(m.observer, a).from, last = truth(m.observer, b).from;
            shows(lines.take("why.length_apparent")["apparent"], double(quad::length(last - first)) * metres);
        }
        break;
    }
    EXPECT_TRUE(lines.left.empty()) << "what is this: " << (lines.left.empty() ? "" : lines.left[0]);
}

} // namespace

TEST(WhyPages, EveryNumberIsTrueAndEveryRemarkStandsWhereItHolds)
{
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    const auto any = [&] { return dvec3(normal(random), normal(random), normal(random)); };
    const auto one_of = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
    const auto spot = [&](const MeasuringObserver& ship) -> Spot {
        const int kind = one_of(6);
        if (kind == 0) // a star
            return {.at = glm::normalize(any()), .sky = true};
        if (kind == 1) // whatever is before the crosshair, at night
            return {.at = aim_of(ship).world, .sky = true};
        if (kind == 2) // the ground; no clock is so high
            return {.at = dvec3(30 * normal(random), -4.5, 30 * normal(random))};
        if (kind == 3)
            return {.at = dvec3(30, 30, 30) + any(), .frame = 1};
        if (kind == 4)
            return snapped({.frame = 1, .clock = stage().riding}, stage().world);
        return snapped({.clock = stage().dials[std::size_t(one_of(int(stage().dials.size())))]}, stage().world);
    };
    std::map<std::string, int> remarks;
    for (int i = 0; i < 300; ++i) {
        SCOPED_TRACE(i);
        const double gamma = i % 10 == 0 ? 1 : std::pow(10, std::uniform_real_distribution<double>(0, 6)(random));
        State state;
        SceneFile scene;
        const int scale = one_of(4); // light-seconds; metres; light-years; and slow light
        scene.light_speed_m_s = scale == 3 ? 5 : light_m_s;
        scene.unit_m = scale == 0 ? light_m_s : scale == 2 ? year_s * light_m_s : 1;
        Effects effects;
        effects.on.set(Effect::aberration, one_of(4) > 0), effects.on.set(Effect::doppler, one_of(4) > 0),
            effects.on.set(Effect::headlight, one_of(4) > 0);
        effects.comparison = one_of(8) > 0 ? Comparison::none
            : one_of(2)                    ? Comparison::galilean
                                           : Comparison::no_light_delay;
        MeasuringObserver ship{.place = 20.0 * any(),
            .time = 100 * normal(random),
            .u = std::sqrt(gamma * gamma - 1) * glm::normalize(any()),
            .ship_from_cockpit = glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random))),
            .aberration = effects[Effect::aberration] || effects.comparison == Comparison::no_light_delay,
            .comparison = effects.comparison};
        if (i % 10 == 0)
            ship.u = dvec3(0);
        state.gamma = double(quad::gamma(quad::of(ship.u))),
        state.beta = double(quad::length(quad::of(ship.u))) / state.gamma;
        state.aim = spot(ship);
        const int marked = one_of(4);
        for (int k = 0; k < marked && k < 2; ++k)
            state.marks[std::size_t(k)] = spot(ship);
        Ship clocks;
        clocks.proper_time.add(std::pow(10, std::uniform_real_distribution<double>(-1, 4)(random)));
        state.m = measured_of(ship, clocks, scene, stage().world, effects, state.aim, 0.5, state.marks);
        EXPECT_EQ(state.m.ship_s, clocks.proper_time.total() * state.m.seconds_per_time_unit);
        for (const char* language : languages)
            for (std::size_t page = 1; page < why_names.size(); ++page) {
                SCOPED_TRACE(std::string(why_names[page]) + " " + language + " gamma " + std::to_string(gamma));
                expect_true(Why(page), state, language);
            }
        for (const char* key :
            {"why.comparison", "why.aberration_off", "why.doppler_off", "why.headlight_off", "why.delay_none",
                "why.delay_marks", "why.length_none", "why.length_sky", "why.length_apparent", "wave.gamma_rays"})
            for (std::size_t page = 1; page < why_names.size(); ++page)
                for (const std::string& line : why_page(Why(page), state.m, words("en")).numbers) {
                    const std::string text = file_of("en")[key];
                    remarks[key] += line.find(text.substr(0, text.find('{'))) != line.npos;
                }
    }
    for (const auto& [key, times] : remarks)
        EXPECT_GT(times, 5) << key << " is hardly tried";
}

/// Numbers that the texts themselves have: the instruments' wavelength, and the keys of docs/flying.md.
TEST(WhyPages, NoTextHasAnotherNumber)
{
    const std::map<std::string, std::string> figures{{"why.doppler_seen", "550"}, {"why.aberration_off", "1"},
        {"why.doppler_off", "2"}, {"why.headlight_off", "3"}, {"why.aberration_formula", "1"},
        {"why.aberration_numbers", "1"}, {"why.doppler_formula", "11"}, {"why.doppler_numbers", "11"},
        {"why.dilation_formula", "11"}, {"why.length_shorter", "1"}};
    for (const char* language : languages)
        for (const auto& [key, text] : file_of(language).items())
            if (key.starts_with("why.")) {
                const auto listed = figures.find(key);
                EXPECT_EQ(std::regex_replace(text.get<std::string>(), std::regex("[^0-9]"), ""),
                    listed == figures.end() ? "" : listed->second)
                    << language << " " << key;
            }
    EXPECT_EQ(example_nm, 550);
}

/// The formulas, as they stand on the pages, and the sentences above them.
TEST(WhyPages, FormulasAndSentencesAreTrue)
{
    for (const char* language : languages) {
        const nlohmann::json& all = file_of(language);
        EXPECT_EQ(all["why.aberration_formula"], "cos θ′ = (cos θ + β) / (1 + β cos θ)");
        EXPECT_EQ(all["why.doppler_formula"], "D = 1 / (γ (1 − β cos θ′)),   λ′ = λ / D");
        EXPECT_EQ(all["why.headlight_formula"], "L′ = D³ L");
        EXPECT_NE(all["why.delay_formula"].get<std::string>().find(" t − r/c,   Δt = γ (Δt′ + β Δx′/c)"), std::string::npos);
        EXPECT_EQ(all["why.dilation_formula"], "Δt = γ Δτ,   γ = 1 / √(1 − β²)");
        EXPECT_NE(all["why.length_formula"].get<std::string>().find("ℓ = | D₁ r₁ n₁ − D₂ r₂ n₂ |,"), std::string::npos);
        EXPECT_TRUE(all["why.length_formula"].get<std::string>().ends_with(": L / γ"));
    }
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 200; ++i) {
        const double speed = std::pow(10, std::uniform_real_distribution<double>(-2, 3)(random));
        const quad::V3 u{0, 0, quad::Q(speed)};
        const quad::Q gamma = quad::gamma(u), beta = speed / gamma;
        const quad::V3 n = quad::unit({normal(random), normal(random), normal(random)});
        const quad::Light seen = quad::camera_from_world(n, u);
        const auto near = [](quad::Q a, quad::Q b) { EXPECT_LT(std::abs(double(a / b - 1)), 1e-12); };
        near(1 + seen.n.z, 1 + (n.z + beta) / (1 + beta * n.z));
        near(seen.D, 1 / (gamma * (1 - beta * seen.n.z)));
        near(gamma, 1 / sqrtq(1 - beta * beta));
        // "Light falls from further ahead", and things abeam or a little behind are seen ahead.
        EXPECT_GT(double(seen.n.z), double(n.z));
        EXPECT_GT(double(quad::camera_from_world({1, 0, 0}, u).n.z), 0);
        EXPECT_GT(double(quad::camera_from_world(quad::unit({1, 0, -beta / 2}), u).n.z), 0);
        // "Flying towards light: bluer. Away from it: redder. Straight abeam redder, too: time dilation alone."
        EXPECT_GT(double(quad::camera_from_world({0, 0, 1}, u).D), 1);
        EXPECT_LT(double(quad::camera_from_world({0, 0, -1}, u).D), 1);
        near(1 / quad::world_from_camera({1, 0, 0}, u).D, gamma);
        // "More light arrives each second, and from a smaller part of the sky": D photons for one, from a patch that two
        // turns of the ray by a small angle span.
        const quad::V3 across = quad::unit(quad::cross(n, {0, 0, 1})), along = quad::cross(n, across);
        const quad::Q small = 1e-9;
        const quad::V3 a = quad::camera_from_world(n + across * small, u).n - seen.n,
                       b = quad::camera_from_world(n + along * small, u).n - seen.n;
        const quad::Q patch = quad::length(quad::cross(a, b)) / (small * small);
        EXPECT_NEAR(double(seen.D / patch / (seen.D * seen.D * seen.D)), 1, 1e-6) << "the patch is a small one";
        // "At one time on board another time there": events that are simultaneous on board, x' apart along the motion.
        const quad::Q apart = normal(random), later = normal(random);
        near(quad::boosted(u, {later, {0, 0, apart}}).t, gamma * (later + beta * apart));
        // A clock on board, and a rod: its ends at one time of the world.
        near(quad::boosted(u, {1, {0, 0, 0}}).t, gamma);
        near(quad::boosted(u, {-beta, {0, 0, 1}}).x.z, 1 / gamma);
    }
}

} // namespace why_test
