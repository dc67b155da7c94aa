#include "visitor_panel.h"
#include "config/model/named_words.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace starbow {
namespace {

constexpr double wide = 1 / panel_aspect, right_edge = wide - 0.12;

// The dial at the left, open below; angles clockwise from straight up, radians.
constexpr glm::dvec2 gauge_middle{0.62, 0.47};
constexpr double gauge_radius = 0.375, gauge_width = 0.055;
constexpr double gauge_end = 0.75 * std::numbers::pi; ///< from -gauge_end to gauge_end

constexpr double left_of_lines = 1.25, clock_radius = 0.1;
constexpr double first_baseline = 0.26, below_first = 0.28; ///< baselines

/// The two clocks: on board, and of the world at rest.
struct ClockPlace {
    double x; ///< the face's middle
    double text_x;
};
constexpr std::array<ClockPlace, 2> clocks{{{1.36, 1.53}, {2.86, 3.03}}};
constexpr double clocks_y = 0.19;

/// The width of a text in parts of the panel's height, as its size.
double width_of(const Typesetter& typesetter, const std::string& text, double size)
{
    constexpr int pixels = 200; // to the panel's height; enough to compare widths
    return typesetter.width_of(text, int(size * pixels)) / pixels;
}

/// The size at which a text fits, no smaller than the least.
double fitting(const Typesetter& typesetter, const std::string& text, double room, double largest)
{
    const double width = width_of(typesetter, text, largest);
    return width <= room ? largest : std::max(least_lettering, largest * room / width);
}

std::vector<std::string> lines_of(const Typesetter& typesetter, const std::string& text, double size)
{
    return wrapped(
        text, right_edge - left_of_lines, [&](const std::string& line) { return width_of(typesetter, line, size); });
}

/// Draws a shape by its distance function, which is negative within, in parts of the panel's height.
template <class Distance>
void draw_shape(Panel& panel, const glm::dvec2& low, const glm::dvec2& high, double strength, Distance distance)
{
    const double unit = panel.size.y;
    const glm::ivec2 from = glm::max(glm::ivec2(glm::floor(low * unit)), 0),
                     to = glm::min(glm::ivec2(glm::ceil(high * unit)), panel.size);
    for (int y = from.y; y < to.y; ++y)
        for (int x = from.x; x < to.x; ++x) {
            const double cover = std::clamp(0.5 - unit * distance((glm::dvec2(x, y) + 0.5) / unit), 0.0, 1.0);
            std::uint8_t& letter = panel.texels[2 * (std::size_t(y) * panel.size.x + x)];
            letter = std::max(letter, std::uint8_t(255 * strength * cover));
        }
}

/// Distance from a part of a ring, whose ends are cut straight.
double ring_distance(const glm::dvec2& at, double radius, double width, double from, double to)
{
    const double angle = std::atan2(at.x, -at.y), length = glm::length(at);
    const double outside = std::max(from - angle, angle - to) * length;
    return std::max(std::abs(length - radius) - 0.5 * width, outside);
}

double line_distance(const glm::dvec2& at, const glm::dvec2& end, double width)
{
    const double along = std::clamp(glm::dot(at, end) / glm::dot(end, end), 0.0, 1.0);
    return glm::length(at - along * end) - 0.5 * width;
}

void draw_speed_gauge(Panel& panel, double part)
{
    const glm::dvec2 reach(gauge_radius + gauge_width);
    const auto arc = [&](double from, double to, double strength) {
        draw_shape(panel, gauge_middle - reach, gauge_middle + reach, strength,
            [&](const glm::dvec2& at) { return ring_distance(at - gauge_middle, gauge_radius, gauge_width, from, to); });
    };
    const double now = gauge_end * (2 * part - 1);
    arc(-gauge_end, gauge_end, 0.35);
    arc(-gauge_end, now, 1);
    const glm::dvec2 way(std::sin(now), -std::cos(now));
    const glm::dvec2 tip = gauge_middle + (gauge_radius + 0.75 * gauge_width) * way,
                     back = gauge_middle + (gauge_radius - 0.9 * gauge_width) * way;
    draw_shape(panel, gauge_middle - reach, gauge_middle + reach, 1,
        [&](const glm::dvec2& at) { return line_distance(at - back, tip - back, 0.035); });
}

/// A clock's face with one hand, which turns once in a minute of its own time.
void draw_clock(Panel& panel, const ClockPlace& place, double s)
{
    const glm::dvec2 middle(place.x, clocks_y), reach(1.3 * clock_radius);
    constexpr double pi = std::numbers::pi;
    draw_shape(panel, middle - reach, middle + reach, 1,
        [&](const glm::dvec2& at) { return ring_distance(at - middle, clock_radius, 0.022, -pi, pi); });
    const double angle = 2 * pi * std::fmod(s, 60) / 60;
    const glm::dvec2 hand = 0.85 * clock_radius * glm::dvec2(std::sin(angle), -std::cos(angle));
    draw_shape(panel, middle - reach, middle + reach, 1,
        [&](const glm::dvec2& at) { return line_distance(at - middle, hand, 0.026); });
}

/// The numbers that a guide speaks of; of a very long way those that fit.
std::string guides_numbers(const Typesetter& typesetter, const Readings& r, const Words& words)
{
    std::string line = words("hud.gamma") + " " + shown_number(r.gamma, words) + "   " + words("hud.doppler_ahead") + " "
        + shown_number(r.doppler_ahead, words);
    const std::string with_way
        = line + "   " + words("hud.flown") + " " + shown_length(r.distance_m, r.light_speed_m_s, words);
    return width_of(typesetter, with_way, least_lettering) <= right_edge - left_of_lines ? with_way : line;
}

/// The effects that are switched off; empty where all are on.
std::string switched_off(const Effects& on, const Words& words)
{
    std::string list;
    constexpr auto effect_keys = keys_of_usual_effects("hud.");
    for (const EffectEntry& one : all_effects)
        if (one.usual && !on[one.which])
            list += (list.empty() ? "" : ", ") + words(effect_keys[std::size_t(one.which)]);
    return list.empty() ? "" : words("hud.off") + ": " + list;
}

} // namespace

double gauge_part(double beta_deficit) { return 1 - std::sqrt(beta_deficit / (2 - beta_deficit)); }

std::string shown_percent(double beta_deficit, const Words& words)
{
    constexpr int most_decimals = 3;
    const int nines = beta_deficit > 0 ? int(std::floor(-std::log10(beta_deficit) + 1e-9)) : most_decimals + 1;
    const int decimals = std::clamp(nines - 1, 0, most_decimals);
    const double step = std::pow(10.0, -decimals);
    const double percent = std::floor((100 - 100 * beta_deficit) / step + 1e-9) * step;
    return words("say.percent", {{"number", shown_number(std::min(percent, 100 - step), decimals, words)}});
}

std::string plain_sentence(const Readings& r, const Words& words)
{
    constexpr double ahead_cosine = 0.5; // within 60 degrees of the motion a visitor looks ahead, beyond 120 back
    const double beta = 1 - r.beta_deficit;
    const Effects& on = r.effects;
    if (r.filtered)
        return words("say.filter");
    if (on.comparison != Comparison::none)
        return words(on.comparison == Comparison::galilean ? "say.galilean"_key : "say.no_light_delay"_key);
    if (on[Effect::false_colours])
        return words("say.false_colours");
    if (r.frozen)
        return words("say.frozen");
    if (beta < 1e-6) // a ship that has stopped, to rounding
        return words("say.rest");
    if (beta < 0.25)
        return words("say.slow");
    if (!on[Effect::aberration])
        return words(on[Effect::doppler] && on[Effect::headlight] ? "say.no_aberration"_key
                : on[Effect::doppler]                             ? "say.colours_alone"_key
                : on[Effect::headlight]                           ? "say.brightness_alone"_key
                                                                  : "say.no_effects"_key);
    const bool colours = on[Effect::doppler] && on[Effect::headlight]; // what is said of them names both
    if (r.looked_cosine < -ahead_cosine)
        return words(colours ? "say.back_colours"_key : "say.back"_key);
    if (r.looked_cosine < ahead_cosine)
        return words(colours ? "say.aside_colours"_key : "say.aside"_key);
    if (r.beta_deficit < 1e-4)
        return words("say.limit");
    if (beta > 0.94)
        return words("say.beam");
    return words(beta > 0.7 && colours ? "say.colours"_key : "say.rain"_key);
}

std::string minutes_sentence(const Readings& r, const Words& words)
{
    constexpr double said_s = 6, again_s = 18, tolerance = 0.04;
    const auto usual = [&](const EffectEntry& one) { return r.effects[one.which] == one.usual; };
    if (std::fmod(r.ship_s, again_s) < again_s - said_s || r.frozen || r.filtered || r.effects.comparison != Comparison::none
        || !std::ranges::all_of(all_effects, usual))
        return "";
    constexpr std::pair<int, int> minutes[]{{4, 5}, {3, 4}, {2, 3}, {1, 2}, {1, 3}, {1, 4}, {1, 5}, {1, 6}, {1, 7}, {1, 8},
        {1, 9}, {1, 10}, {1, 20}, {1, 50}, {1, 100}, {1, 1000}};
    for (const auto& [board, world] : minutes)
        if (std::abs(r.gamma * board / world - 1) <= tolerance)
            return words(board == 1 ? "say.minute"_key : "say.minutes"_key,
                {{"board", std::to_string(board)}, {"world", std::to_string(world)}});
    return "";
}

std::vector<Lettering> lettering_of(const Typesetter& typesetter, const Readings& readings, const Words& words)
{
    std::vector<Lettering> lines;
    const auto middle = [&](const std::string& text, double x, double baseline, double room, double largest) {
        const double size = fitting(typesetter, text, room, largest);
        lines.push_back({text, x - 0.5 * width_of(typesetter, text, size), baseline, size});
    };
    middle(shown_percent(readings.beta_deficit, words), gauge_middle.x, gauge_middle.y + 0.04, 0.52, 0.24);
    // "of" stands within the dial: below it is no room for all.
    const std::string of_light = words("say.of_light");
    const std::size_t first = of_light.find(' ');
    middle(of_light.substr(0, first), gauge_middle.x, 0.72, 0.4, least_lettering);
    if (first != std::string::npos)
        middle(of_light.substr(first + 1), gauge_middle.x, 0.94, 0.9, least_lettering);

    const double times_s[] = {readings.ship_s, readings.world_s};
    constexpr Key keys[] = {"say.clock_board", "say.clock_world"};
    for (int i = 0; i < 2; ++i) {
        const std::string text = words(keys[i], {{"time", shown_duration(times_s[i], words)}});
        const double room = (i == 0 ? clocks[1].x - clock_radius - 0.12 : right_edge) - clocks[i].text_x;
        lines.push_back({text, clocks[i].text_x, first_baseline, fitting(typesetter, text, room, 0.22)});
    }

    // A line below the clocks: the guides' numbers, and that brightness is compressed.
    const bool numbered = readings.information == Information::guide, guides = numbered || readings.range;
    if (guides) {
        std::string numbers
            = readings.range ? range_sentence(*readings.range, words) : guides_numbers(typesetter, readings, words);
        if (readings.range && numbered) {
            const std::string with_gamma = words("hud.gamma") + " " + shown_number(readings.gamma, words) + "   " + numbers;
            if (width_of(typesetter, with_gamma, least_lettering) <= right_edge - left_of_lines)
                numbers = with_gamma;
        }
        lines.push_back({numbers, left_of_lines, first_baseline + below_first,
            fitting(typesetter, numbers, right_edge - left_of_lines, 0.23)});
    }
    const std::string off = numbered ? switched_off(readings.effects, words) : "";
    const std::string minutes = minutes_sentence(readings, words);
    const std::string text = !readings.notice.empty() ? readings.notice
        : !readings.prompt.empty()                    ? readings.prompt
        : !off.empty()                                ? off
        : !minutes.empty()                            ? minutes
                                                      : plain_sentence(readings, words);
    // The largest size at which two lines hold the text. The guides' numbers leave less room.
    double size = guides ? 0.21 : 0.24;
    while (size > least_lettering && lines_of(typesetter, text, size).size() > 2)
        size -= 0.005;
    const std::vector<std::string> sentence = lines_of(typesetter, text, size);
    const double pitch = guides ? 0.205 : 0.29;
    double baseline = sentence.size() > 1 ? (guides ? 0.725 : 0.58) : (guides ? 0.85 : 0.7);
    for (const std::string& line : sentence) {
        lines.push_back({line, left_of_lines, baseline, size});
        baseline += pitch;
    }
    return lines;
}

void write_visitor_panel(Panel& panel, const Typesetter& typesetter, const Readings& readings, const Words& words)
{
    draw_speed_gauge(panel, gauge_part(readings.beta_deficit));
    draw_clock(panel, clocks[0], readings.ship_s);
    draw_clock(panel, clocks[1], readings.world_s);
    const double unit = panel.size.y;
    for (const Lettering& line : lettering_of(typesetter, readings, words))
        typesetter.write(panel, line.text, line.x * unit, line.baseline * unit, std::max(6, int(line.size * unit)), 1);
}

} // namespace starbow
