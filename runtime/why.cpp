#include "why.h"
#include "hud.h"
#include "physics/physics.h"
#include <cmath>

namespace starbow {
namespace {

constexpr double degree = 3.14159265358979323846 / 180;

std::string text(const char* format, double value)
{
    std::array<char, 64> buffer;
    std::snprintf(buffer.data(), buffer.size(), format, value);
    std::string shown = buffer.data();
    if (shown.find_first_not_of("-0.") == shown.npos && shown.starts_with('-')) // no minus before nothing
        return shown.substr(1);
    return shown.starts_with('-') ? "−" + shown.substr(1) : shown;
}

std::string angle(double radians) { return text("%.2f°", radians / degree); }
std::string angle(const std::optional<double>& radians) { return radians ? angle(*radians) : "—"; }
std::string seconds(const std::optional<double>& s) { return s ? shown_duration(*s, 2) : "—"; }

std::string length(const std::optional<double>& s, double light_speed_m_s)
{
    return s ? shown_length(*s * light_speed_m_s, light_speed_m_s) : "—";
}

/// What eyes, or instruments, call a wavelength; nm.
std::string wavelength(double nm)
{
    return nm < 10   ? lab_text("beyond ultraviolet")
        : nm < 380   ? text("%.0f nm", nm) + " " + lab_text("ultraviolet")
        : nm < 780   ? text("%.0f nm", nm)
        : nm < 10000 ? text("%.0f nm", nm) + " " + lab_text("infrared")
        : nm < 1e9   ? shown_number(nm / 1000) + " µm"
                     : lab_text("radio");
}

} // namespace

const std::map<std::string, std::string>& lab_words()
{
    static const std::map<std::string, std::string> words = {
        // The readings.
        {"aim D", "D"},
        {"aim nm", "550 nm →"},
        {"aim angle", "θ′"},
        {"at rest", "at rest"},
        {"aim distance", "distance"},
        {"aim emitted", "light left"},
        {"aim clock", "clock"},
        {"aim light", "light"},
        {"marks angle", "○–◇"},
        {"marks length", "long"},
        {"marks length value", "{apparent} of {rest}"},
        {"marks clocks", "◇ minus ○"},
        {"marks first", "mark two things: X"},
        {"marks second", "mark another: X"},
        {"ultraviolet", "ultraviolet"},
        {"infrared", "infrared"},
        {"beyond ultraviolet", "X-rays"},
        {"radio", "radio waves"},
        {"sky", "the sky"},
        // What is laid over the picture.
        {"overlay aim", "θ′: angle from the motion, as seen; D = 1 at {unshifted}"},
        {"overlay aim rest", "at rest: D = 1 everywhere"},
        {"overlay grid", "the world's directions, every 15°; orange: the horizon"},
        {"overlay ring", "the ring where D = 1, at {unshifted} from the motion: bluer within, redder beyond"},
        {"overlay ring rest", "at rest nothing is shifted: D = 1 everywhere"},
        {"overlay distance", "how far the light came; lines at 1, 2, 5, 10 …"},
        {"overlay emission", "when the light left; a line every {step}, heavier every {five}"},
        // The log.
        {"logged", "line {line} is written to {file}"},
        {"no log", "nothing is logged: start with --log FILE.csv"},
        // The pages.
        {"aberration title", "Why do things crowd together ahead?"},
        {"aberration 1", "Light falls on a moving ship as rain on who runs: from further ahead."},
        {"aberration 2", "What stands abeam at rest, or behind, is seen before the ship."},
        {"aberration formula", "cos θ′ = (cos θ + β) / (1 + β cos θ)"},
        {"aberration numbers", "({cos} + {beta}) / (1 + {beta} · {cos}) = {result}"},
        {"aberration numbers 2", "θ = {theta} in the world, seen at θ′ = {seen}; β = v/c"},
        {"doppler title", "Why do the colours change?"},
        {"doppler 1", "Flying into the light's waves meets more of them: bluer. Away from them: redder."},
        {"doppler 2", "Straight abeam they are redder, too: that is time dilation alone."},
        {"doppler formula", "D = 1 / (γ (1 − β cos θ′)),   λ′ = λ / D"},
        {"doppler numbers", "1 / ({gamma} · (1 − {beta} · {cos})) = {D}"},
        {"doppler numbers 2", "so 550 nm are seen as {nm}"},
        {"headlight title", "Why is it so bright ahead, and dark behind?"},
        {"headlight 1", "More light arrives in each second, and from a smaller part of the sky."},
        {"headlight 2", "Together that is D³, for the photons that an eye counts."},
        {"headlight formula", "L′ = D³ L"},
        {"headlight numbers", "{D}³ = {cube}: so many times as bright as at rest"},
        {"headlight numbers off", "the headlight effect is switched off: 3 switches it on"},
        {"delay title", "Why do the clocks not agree?"},
        {"delay 1", "You see each clock as it was when its light left. In their world all show the same:"},
        {"delay 2", "what you see earlier is farther away. Moving, you call that another time there."},
        {"delay formula", "shows t − r/c,   Δt = γ (Δt′ + β Δx′/c)"},
        {"delay numbers", "now {now} − {way} on its way = {left}"},
        {"delay numbers none", "aim at something: the sky tells no distance"},
        {"delay numbers 2", "○ shows {first}, ◇ {second}: {apart} apart"},
        {"dilation title", "Why does less time pass on board?"},
        {"dilation 1", "A moving clock is slow, by the factor γ. So is everything that happens on board."},
        {"dilation 2", "The clock on board starts at the start; the world's goes on beside it."},
        {"dilation formula", "Δt = γ Δτ,   γ = 1 / √(1 − β²)"},
        {"dilation numbers", "γ = {gamma}: one second on board is {gamma} s of the world's"},
        {"dilation numbers 2", "on board {ship} since the start"},
        {"length title", "Why do things look shorter, or longer?"},
        {"length 1", "A moving thing is shorter by 1/γ along the motion. But both its ends are seen"},
        {"length 2", "as they were when their light left, and that was not at the same time."},
        {"length formula", "ℓ = | D₁ r₁ n₁ − D₂ r₂ n₂ |,   contracted: L / γ"},
        {"length numbers", "at rest {rest}, contracted {contracted}"},
        {"length numbers 2", "seen {apparent}"},
        {"length numbers none", "mark both its ends: X"},
    };
    return words;
}

std::string lab_text(const std::string& key, const std::map<std::string, std::string>& values)
{
    std::string filled = lab_words().at(key);
    for (const auto& [name, value] : values)
        for (std::size_t at = 0; (at = filled.find("{" + name + "}", at)) != filled.npos; at += value.size())
            filled.replace(at, name.size() + 2, value);
    return filled;
}

WhyPage why_page(Why why, const Measured& m)
{
    const double speed = glm::length(m.lookout.u), gamma = physics::gamma_of(m.lookout.u);
    const std::string beta = text("%.4f", speed / gamma), gammas = shown_number(gamma), D = shown_number(m.aim.ray.D);
    const auto cosine = [](const std::optional<double>& a) { return text("%.4f", a ? std::cos(*a) : 1); };
    const std::string name = why_names[std::size_t(why)];
    if (why == Why::none)
        return {};
    WhyPage page{lab_text(name + " title"), {lab_text(name + " 1"), lab_text(name + " 2")}, lab_text(name + " formula"), {}};
    const auto add = [&](const std::string& key, const std::map<std::string, std::string>& values = {}) {
        page.numbers.push_back(lab_text(key, values));
    };
    const SpotReading& aim = m.aim;
    switch (why) {
    case Why::none:
        break;
    case Why::aberration:
        add("aberration numbers",
            {{"cos", cosine(aim.from_motion_world_rad)}, {"beta", beta}, {"result", cosine(aim.from_motion_rad)}});
        add("aberration numbers 2", {{"theta", angle(aim.from_motion_world_rad)}, {"seen", angle(aim.from_motion_rad)}});
        break;
    case Why::doppler:
        add("doppler numbers", {{"gamma", gammas}, {"beta", beta}, {"cos", cosine(aim.from_motion_rad)}, {"D", D}});
        add("doppler numbers 2", {{"nm", wavelength(aim.seen_nm)}});
        break;
    case Why::headlight:
        add("headlight numbers", {{"D", D}, {"cube", shown_number(std::pow(aim.ray.D, 3))}});
        if (!m.effects.headlight)
            add("headlight numbers off");
        break;
    case Why::delay:
        if (aim.distance_s)
            add("delay numbers",
                {{"now", seconds(m.world_s)}, {"way", seconds(aim.distance_s)}, {"left", seconds(aim.emitted_s)}});
        else
            add("delay numbers none");
        if (m.pair && m.pair->clocks_s)
            add("delay numbers 2",
                {{"first", seconds(m.marks[0]->clock_s)}, {"second", seconds(m.marks[1]->clock_s)},
                    {"apart", seconds(std::abs(*m.pair->clocks_s))}});
        break;
    case Why::dilation:
        add("dilation numbers", {{"gamma", gammas}});
        add("dilation numbers 2", {{"ship", shown_duration(m.ship_s, 1)}});
        break;
    case Why::length:
        if (m.pair && m.pair->apparent_s) {
            add("length numbers",
                {{"rest", length(m.pair->rest_s, m.light_speed_m_s)},
                    {"contracted", length(*m.pair->contracted_s, m.light_speed_m_s)}});
            add("length numbers 2", {{"apparent", length(m.pair->apparent_s, m.light_speed_m_s)}});
        } else {
            add("length numbers none");
        }
    }
    return page;
}

std::array<std::pair<std::string, std::string>, 9> reading_fields(const Measured& m)
{
    const SpotReading& aim = m.aim;
    const std::string sky = lab_text("sky");
    std::array<std::pair<std::string, std::string>, 9> fields = {{
        {lab_text("aim D"), shown_number(aim.ray.D)},
        {lab_text("aim nm"), wavelength(aim.seen_nm)},
        {lab_text("aim angle"), aim.from_motion_rad ? angle(aim.from_motion_rad) : lab_text("at rest")},
        {lab_text("aim distance"), aim.distance_s ? length(aim.distance_s, m.light_speed_m_s) : sky},
        {aim.emitted_s ? lab_text("aim emitted") : "", aim.emitted_s ? seconds(aim.emitted_s) : ""},
        {lab_text("aim light"), aim.light ? shown_number(*aim.light) : "—"},
        {"", ""},
        {"", ""},
        {"", ""},
    }};
    if (aim.clock_s)
        fields[5] = {lab_text("aim clock"), seconds(aim.clock_s)};
    if (!m.pair) {
        fields[6] = {lab_text(m.marks[0] ? "marks second" : "marks first"), ""};
        return fields;
    }
    fields[6] = {lab_text("marks angle"), angle(m.pair->angle_rad)};
    fields[7] = {lab_text("marks length"), "—"};
    if (m.pair->apparent_s) {
        std::string apparent = length(m.pair->apparent_s, m.light_speed_m_s),
                    rest = length(m.pair->rest_s, m.light_speed_m_s);
        // The unit once, where both have the same.
        const auto unit = apparent.find(' ');
        if (unit != apparent.npos && rest.ends_with(apparent.substr(unit)))
            apparent.erase(unit);
        fields[7].second = lab_text("marks length value", {{"apparent", apparent}, {"rest", rest}});
    }
    if (m.pair->clocks_s)
        fields[8] = {lab_text("marks clocks"), seconds(m.pair->clocks_s)};
    return fields;
}

} // namespace starbow
