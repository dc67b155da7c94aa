#include "challenges.h"
#include "config/model/angles.h"
#include "hud.h"
#include "lab_plot.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

using Lines = std::vector<LabLine>;
constexpr std::array<const char*, 2> marks = {"mark_1", "mark_2"};

double at(const LabLine& line, const char* spot, const char* what) { return line[std::string(spot) + what]; }

/// Keeps the finding that is solved, or else nearer to what is right.
void keep(std::optional<Finding>& best, Finding one)
{
    const auto off = [](const Finding& f) {
        const double over = f.found - f.right;
        return f.kind == Finding::Right::at_most ? std::max(0.0, over) : std::abs(over);
    };
    one.solved = one.kind == Finding::Right::at_most ? one.found <= one.right : off(one) <= one.tolerance;
    // Of two that are solved the first one stays: it is the line that a student remembers.
    if (!best || (!best->solved && (one.solved || off(one) < off(*best))))
        best = one;
}

bool same_marks(const LabLine& a, const LabLine& b)
{
    return a["mark_1_number"] > 0 && a["mark_1_number"] == b["mark_1_number"] && a["mark_2_number"] == b["mark_2_number"];
}

double place_apart(const LabLine& a, const LabLine& b)
{
    return std::hypot(a["place_x_light_s"] - b["place_x_light_s"], a["place_y_light_s"] - b["place_y_light_s"],
        a["place_z_light_s"] - b["place_z_light_s"]);
}

/// A marked clock's ticks, over those of the clock on board.
std::optional<Finding> slow_clock(const Lines& lines)
{
    std::optional<Finding> best;
    for (std::size_t i = 1; i < lines.size(); ++i)
        for (const char* mark : marks) {
            const double ticks = at(lines[i], mark, "_clock_s") - at(lines[i - 1], mark, "_clock_s");
            if (at(lines[i], mark, "_number") == at(lines[i - 1], mark, "_number") && std::isfinite(ticks)
                && straight_on(lines[i - 1], lines[i]))
                keep(best,
                    {.line = lines[i].line,
                        .found = ticks / (lines[i]["ship_time_s"] - lines[i - 1]["ship_time_s"]),
                        .right = 0.1,
                        .tolerance = 0.01});
        }
    return best;
}

/// The direction in which D is 1.
std::optional<Finding> own_colour(const Lines& lines)
{
    std::optional<Finding> best;
    for (const LabLine& line : lines) {
        const double u = line["aim_relative_gamma_beta"], angle = line["aim_from_relative_motion_deg"];
        const double gamma = std::hypot(1.0, u), beta = u / gamma;
        if (line["aberration_on"] == 1 && beta >= 0.5 && std::isfinite(angle))
            keep(best,
                {.line = line.line, .found = angle, .right = std::acos((1 - 1 / gamma) / beta) / degree, .tolerance = 1});
    }
    return best;
}

/// Light of 650 nm, as it is seen.
std::optional<Finding> red_to_green(const Lines& lines)
{
    constexpr double red_nm = 650;
    std::optional<Finding> best;
    for (const LabLine& line : lines)
        if (line["aim_relative_gamma_beta"] > 0)
            keep(best, {.line = line.line, .found = red_nm / line["aim_doppler"], .right = 550, .tolerance = 20});
    return best;
}

/// The ship's times at which the two marks are seen straight abeam, at one velocity; NaN where the lines from `first` to
/// `last` do not show it. The cotangent of the angle is nearly a straight line in time.
std::array<double, 2> times_abeam(const Lines& lines, std::size_t first, std::size_t last)
{
    std::array<double, 2> times = {NAN, NAN};
    constexpr double widest_deg = 10;
    for (std::size_t i = first + 1; i <= last; ++i)
        for (std::size_t k = 0; k < 2; ++k) {
            const double before = at(lines[i - 1], marks[k], "_from_relative_motion_deg"),
                         now = at(lines[i], marks[k], "_from_relative_motion_deg");
            if (!(before < 90 && now >= 90 && now - before <= widest_deg))
                continue;
            const double a = 1 / std::tan(before * degree), b = 1 / std::tan(now * degree),
                         from = lines[i - 1]["ship_time_s"];
            times[k] = from + (lines[i]["ship_time_s"] - from) * a / (a - b);
        }
    return times;
}

/// A moving thing's length by the time that it takes to pass, of a thing that also looks at least a tenth longer or shorter.
std::optional<Finding> two_lengths(const Lines& lines)
{
    std::optional<Finding> best;
    for (std::size_t first = 0; first < lines.size();) {
        std::size_t last = first;
        while (
            last + 1 < lines.size() && same_marks(lines[last], lines[last + 1]) && straight_on(lines[last], lines[last + 1]))
            ++last;
        const auto [front, rear] = times_abeam(lines, first, last);
        const double u = lines[last]["marks_relative_gamma_beta"], beta = u / std::hypot(1.0, u);
        const double passed = beta * std::abs(rear - front), theory = lines[last]["marks_contracted_length_light_s"];
        bool looks_otherwise = false;
        for (std::size_t i = first; i <= last; ++i)
            looks_otherwise |= std::abs(lines[i]["marks_apparent_length_light_s"] / passed - 1) >= 0.1;
        if (std::isfinite(passed) && std::isfinite(theory) && looks_otherwise)
            keep(best, {.line = lines[last].line, .found = passed, .right = theory, .tolerance = 0.05 * theory});
        first = last + 1;
    }
    return best;
}

/// The least angle between two marks that have come nearer since, over the angle before.
std::optional<Finding> half_size(const Lines& lines)
{
    std::optional<Finding> best;
    const LabLine* largest = nullptr; // since the marks were set
    for (const LabLine& line : lines) {
        const double angle = line["marks_angle_deg"];
        if (!(angle > 0) || line["aberration_on"] != 1)
            continue;
        if (!largest || !same_marks(*largest, line))
            largest = nullptr;
        if (largest && line["mark_1_distance_light_s"] < (*largest)["mark_1_distance_light_s"])
            keep(best,
                {.line = line.line,
                    .found = angle / (*largest)["marks_angle_deg"],
                    .right = 0.5,
                    .kind = Finding::Right::at_most});
        if (!largest || angle > (*largest)["marks_angle_deg"])
            largest = &line;
    }
    return best;
}

/// The change of a marked clock's reading with the speed alone: at nearly one place and time.
std::optional<Finding> same_light(const Lines& lines)
{
    constexpr double near_s = 0.5, least_change = 0.3;
    std::optional<Finding> best;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        // A log that writes itself has a line between those before and after the stop.
        for (std::size_t j = i; j-- > 0 && i - j <= 8;) {
            const double apart
                = place_apart(lines[i], lines[j]) + std::abs(lines[i]["world_time_s"] - lines[j]["world_time_s"]);
            if (!(apart <= near_s) || std::abs(lines[i]["beta"] - lines[j]["beta"]) < least_change)
                continue;
            for (const char* mark : marks)
                if (const double change = at(lines[i], mark, "_clock_s") - at(lines[j], mark, "_clock_s");
                    at(lines[i], mark, "_number") == at(lines[j], mark, "_number") && std::isfinite(change))
                    keep(best, {.line = lines[i].line, .found = change, .right = 0, .tolerance = apart + 1e-6});
        }
    }
    return best;
}

/// The ship's time over the world's, from a rest to the way back to that place.
std::optional<Finding> younger(const Lines& lines)
{
    constexpr double at_rest = 0.01, near_s = 2, away_s = 5, least_s = 10;
    std::optional<Finding> best;
    std::vector<std::size_t> begin = flights_begin(lines);
    begin.push_back(lines.size());
    for (std::size_t flight = 0; flight + 1 < begin.size(); ++flight) {
        const LabLine* departure = nullptr;
        double farthest = 0;
        for (std::size_t i = begin[flight]; i < begin[flight + 1]; ++i) {
            const LabLine& line = lines[i];
            const double apart = departure ? place_apart(line, *departure) : 0;
            farthest = std::max(farthest, apart);
            if (departure && apart <= near_s && farthest >= away_s
                && line["world_time_s"] - (*departure)["world_time_s"] >= least_s)
                keep(best,
                    {.line = line.line,
                        .found = (line["ship_time_s"] - (*departure)["ship_time_s"])
                            / (line["world_time_s"] - (*departure)["world_time_s"]),
                        .right = 0.5,
                        .kind = Finding::Right::at_most});
            // The last line before the ship leaves is the departure.
            if (line["beta"] < at_rest && (!departure || farthest < away_s || apart <= near_s))
                departure = &line, farthest = 0;
        }
    }
    return best;
}

/// The difference of two moving clocks that look alike.
std::optional<Finding> same_time(const Lines& lines)
{
    std::optional<Finding> best;
    for (const LabLine& line : lines)
        if (const double apart = line["marks_clock_2_minus_1_s"], u = line["marks_relative_gamma_beta"]; std::isfinite(apart)
            && u / std::hypot(1.0, u) >= 0.3 && line["marks_rest_length_light_s"] >= 5
            && line["marks_from_motion_at_rest_deg"] <= 45)
            keep(best, {.line = line.line, .found = apart, .right = 0, .tolerance = 0.2});
    return best;
}

/// D straight abeam.
std::optional<Finding> half_rate(const Lines& lines)
{
    std::optional<Finding> best;
    for (const LabLine& line : lines)
        for (const char* spot : {"aim", "mark_1", "mark_2"})
            if (std::abs(at(line, spot, "_from_relative_motion_deg") - 90) <= 1)
                keep(best, {.line = line.line, .found = at(line, spot, "_doppler"), .right = 0.5, .tolerance = 0.05});
    return best;
}

/// The seen angle from the motion of what stands far behind.
std::optional<Finding> behind_ahead(const Lines& lines)
{
    std::optional<Finding> best;
    for (const LabLine& line : lines)
        for (const char* spot : {"aim", "mark_1", "mark_2"})
            if (line["aberration_on"] == 1 && at(line, spot, "_from_motion_in_world_deg") >= 150)
                keep(best,
                    {.line = line.line,
                        .found = at(line, spot, "_from_motion_deg"),
                        .right = 45,
                        .kind = Finding::Right::at_most});
    return best;
}

constexpr Challenge all_challenges[] = {
    {"slow-clock", "--shot clocks-rest", "challenge.slow_clock", "challenge.slow_clock_ask", "challenge.slow_clock_tools",
        "challenge.slow_clock_check",
        {"challenge.slow_clock_hint_a", "challenge.slow_clock_hint_b", "challenge.slow_clock_hint_c"}, {}, 4, slow_clock},
    {"own-colour", "--shot avenue-gamma4", "challenge.own_colour", "challenge.own_colour_ask", "challenge.own_colour_tools",
        "challenge.own_colour_check",
        {"challenge.own_colour_hint_a", "challenge.own_colour_hint_b", "challenge.own_colour_hint_c"}, "angle.degrees", 2,
        own_colour},
    {"red-to-green", "--shot start", "challenge.red_to_green", "challenge.red_to_green_ask", "challenge.red_to_green_tools",
        "challenge.red_to_green_check",
        {"challenge.red_to_green_hint_a", "challenge.red_to_green_hint_b", "challenge.red_to_green_hint_c"}, "wave.visible",
        0, red_to_green},
    {"two-lengths", "--scene train", "challenge.two_lengths", "challenge.two_lengths_ask", "challenge.two_lengths_tools",
        "challenge.two_lengths_check",
        {"challenge.two_lengths_hint_a", "challenge.two_lengths_hint_b", "challenge.two_lengths_hint_c"}, "length.light_s",
        2, two_lengths},
    {"half-size", "--shot clocks-rest", "challenge.half_size", "challenge.half_size_ask", "challenge.half_size_tools",
        "challenge.half_size_check",
        {"challenge.half_size_hint_a", "challenge.half_size_hint_b", "challenge.half_size_hint_c"}, {}, 3, half_size},
    {"same-light", "--shot clocks-passing", "challenge.same_light", "challenge.same_light_ask", "challenge.same_light_tools",
        "challenge.same_light_check",
        {"challenge.same_light_hint_a", "challenge.same_light_hint_b", "challenge.same_light_hint_c"}, "time.s", 3,
        same_light},
    {"younger", "--shot start", "challenge.younger", "challenge.younger_ask", "challenge.younger_tools",
        "challenge.younger_check", {"challenge.younger_hint_a", "challenge.younger_hint_b", "challenge.younger_hint_c"}, {},
        3, younger},
    {"same-time", "--scene train", "challenge.same_time", "challenge.same_time_ask", "challenge.same_time_tools",
        "challenge.same_time_check",
        {"challenge.same_time_hint_a", "challenge.same_time_hint_b", "challenge.same_time_hint_c"}, "time.s", 2, same_time},
    {"half-rate", "--scene rainbow", "challenge.half_rate", "challenge.half_rate_ask", "challenge.half_rate_tools",
        "challenge.half_rate_check",
        {"challenge.half_rate_hint_a", "challenge.half_rate_hint_b", "challenge.half_rate_hint_c"}, {}, 3, half_rate},
    {"behind-ahead", "--shot start", "challenge.behind_ahead", "challenge.behind_ahead_ask", "challenge.behind_ahead_tools",
        "challenge.behind_ahead_check",
        {"challenge.behind_ahead_hint_a", "challenge.behind_ahead_hint_b", "challenge.behind_ahead_hint_c"}, "angle.degrees",
        1, behind_ahead},
};

} // namespace

std::span<const Challenge> challenges() { return all_challenges; }

std::vector<std::size_t> flights_begin(const std::vector<LabLine>& lines)
{
    std::vector<std::size_t> begin;
    for (std::size_t i = 0; i < lines.size(); ++i)
        if (i == 0 || lines[i]["ship_time_s"] < lines[i - 1]["ship_time_s"]
            || lines[i]["world_time_s"] < lines[i - 1]["world_time_s"])
            begin.push_back(i);
    return begin;
}

std::string said_of(const Challenge& challenge, const std::optional<Finding>& finding, const Words& words)
{
    if (!finding)
        return words("challenge.no_line");
    const auto shown = [&](double value) {
        const std::string number = shown_number(value, challenge.decimals, words);
        return challenge.unit ? words(challenge.unit, {{"number", number}}) : number;
    };
    const std::string right = finding->kind == Finding::Right::at_most
        ? words("challenge.at_most", {{"right", shown(finding->right)}})
        : words("challenge.about", {{"right", shown(finding->right)}, {"tolerance", shown(finding->tolerance)}});
    const std::string line = std::to_string(finding->line), found = shown(finding->found);
    // What is right is said afterwards only: it would answer some of the questions.
    return finding->solved ? words("challenge.done", {{"line", line}, {"found", found}, {"right", right}})
                           : words("challenge.not_yet", {{"line", line}, {"found", found}});
}

} // namespace starbow
