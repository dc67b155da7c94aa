#include "clock_face.h"
#include "config/model/angles.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace starbow {
namespace {

bool between(double low, double x, double high) { return x >= low && x <= high; }

/// The small dials' middles on the face.
const glm::dvec2 ten_seconds_at(-0.38, 0.06), hour_at(0.38, 0.06);
constexpr double small_radius = 0.25;

/// True on one of `count` strokes around the middle, one of them upwards.
bool stroke(const glm::dvec2& at, int count, double inner, double outer, double half_width)
{
    const double r = glm::length(at);
    if (!between(inner, r, outer))
        return false;
    const double apart = 2 * pi / count;
    return std::abs(std::remainder(std::atan2(at.x, at.y), apart)) * r <= half_width;
}

bool circle(const glm::dvec2& at, double radius, double half_width)
{
    return std::abs(glm::length(at) - radius) <= half_width;
}

struct Hand {
    double turn_s, reach, tail, root, tip; ///< root, tip: half widths
};
constexpr Hand minute{60, 0.82, 0.16, 0.034, 0.012};
constexpr Hand ten_seconds{10, 0.19, 0.05, 0.020, 0.008};
constexpr Hand hour{3600, 0.19, 0.05, 0.020, 0.008};

/// True if the hand, widened by `wider`, covers a point.
bool covers(const Hand& hand, const glm::dvec2& at, double reading_s, double wider = 0)
{
    const double angle = 2 * pi * std::fmod(reading_s, hand.turn_s) / hand.turn_s;
    const double along = at.x * std::sin(angle) + at.y * std::cos(angle);
    const double across = at.x * std::cos(angle) - at.y * std::sin(angle);
    const double half_width = std::lerp(hand.root, hand.tip, std::clamp(along / hand.reach, 0.0, 1.0)) + wider;
    return between(-hand.tail, along, hand.reach) && std::abs(across) <= half_width;
}

// The figures: each in a cell 1 wide, the point before the last one takes less. Strokes from the upper one clockwise, the
// middle one last.
constexpr double figures_y = -0.43, figures_wide = 0.84, widest_cell = 0.17, point_wide = 0.4;
constexpr std::array<const char*, 10> strokes
    = {"abcdef", "bc", "abged", "abgcd", "fbgc", "afgcd", "afgedc", "abc", "abcdefg", "abcdfg"};

bool box(const glm::dvec2& at, double half_width, double half_height)
{
    return std::abs(at.x) <= half_width && std::abs(at.y) <= half_height;
}

bool in_figure(const glm::dvec2& at, char figure)
{
    constexpr double x = 0.27, y = 0.33, thick = 0.1;
    const std::string lit = figure == '-' ? "g" : strokes[std::size_t(figure - '0')];
    for (char one : lit) {
        const bool level = one == 'a' || one == 'd' || one == 'g';
        const glm::dvec2 middle(one == 'b' || one == 'c' ? x
                : level                                  ? 0
                                                         : -x,
            one == 'a'                     ? 2 * y
                : one == 'd'               ? -2 * y
                : one == 'g'               ? 0
                : one == 'b' || one == 'f' ? y
                                           : -y);
        if (level ? box(at - middle, x, thick) : box(at - middle, thick, y))
            return true;
    }
    return false;
}

double cell(int count) { return std::min(widest_cell, figures_wide / (count + point_wide)); }

bool in_figures(const glm::dvec2& at, const std::string& figures)
{
    const int count = int(figures.size());
    const glm::dvec2 p = (at - glm::dvec2(0, figures_y)) / cell(count);
    const double from_left = p.x + 0.5 * (count + point_wide);
    const double point = from_left - (count - 1) - 0.5 * point_wide;
    if (std::abs(p.y) > 1 || from_left < 0 || from_left >= count + point_wide)
        return false;
    const double x = from_left < count - 1 ? from_left : std::max(from_left - point_wide, count - 1.0);
    const int k = std::min(int(x), count - 1);
    return in_figure({x - k - 0.5, p.y}, figures[std::size_t(k)]) || box({point, p.y + 2 * 0.33 - 0.03}, 0.13, 0.13);
}

bool in_plate(const glm::dvec2& at, int count, double margin)
{
    return box(
        at - glm::dvec2(0, figures_y), (0.5 * (count + point_wide) + margin) * cell(count), (0.8 + margin) * cell(count));
}

} // namespace

double mark(const glm::dvec2& at, double reading_s, const std::string& text)
{
    std::string figures;
    std::copy_if(text.begin(), text.end(), std::back_inserter(figures), [](char c) { return c != '.'; });
    const int count = int(figures.size());
    if (circle(at, 0, 0.035))
        return 0; // the pin that the hand turns on
    if (circle(at, 0, 0.075) || in_figures(at, figures))
        return 1;
    // The plate of the figures hides the hand.
    if (in_plate(at, count, 0.26))
        return in_plate(at, count, 0.2) ? 0 : 0.6;
    if (covers(minute, at, reading_s))
        return 1;
    if (covers(minute, at, reading_s, 0.02))
        return 0;
    if (stroke(at, 60, 0.90, 0.96, 0.005) || stroke(at, 12, 0.85, 0.96, 0.014))
        return 1;
    for (const Hand& hand : {ten_seconds, hour}) {
        const bool first = hand.turn_s == ten_seconds.turn_s;
        const glm::dvec2 small = at - (first ? ten_seconds_at : hour_at);
        if (covers(hand, small, reading_s) || stroke(small, first ? 10 : 12, 0.205, small_radius, 0.006)
            || circle(small, 0, 0.032))
            return 1;
        if (circle(small, small_radius, 0.006))
            return 0.6;
    }
    return 0;
}

} // namespace starbow
